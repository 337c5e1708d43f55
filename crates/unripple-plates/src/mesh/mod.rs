//! Graded triangular meshes of a sheet.

mod build;
mod cells;
mod corner;
mod delaunay;
mod estimate;
mod field;
mod front;
mod region;
mod relax;
mod rim;
mod sizing;
#[cfg(test)]
mod tests;
mod williams;

use unripple_core::{Edge, Point, Side};

pub(crate) use corner::{Corner, corners, growth, singular, unresolved};
pub(crate) use field::GROWTH;
pub(crate) use sizing::Sizing;

/// A mesh of triangles that conforms to the outline; along a curved side, an edge represents a piece of the
/// curve.
#[derive(Clone, Debug)]
pub(crate) struct Mesh {
    /// All sides of all rims, with the sheet to their left, and their edge conditions.
    pub(crate) sides: Vec<(Side, Edge)>,
    /// The vertices; those on a rim lie on their sides exactly.
    pub(crate) vertices: Vec<Vertex>,
    /// Edges of the triangles; an edge shared by two triangles is listed once.
    pub(crate) edges: Vec<MeshEdge>,
    /// Triangles, anticlockwise, that cover the sheet.
    pub(crate) triangles: Vec<Triangle>,
}

/// A vertex of a mesh.
#[derive(Clone, Debug)]
pub(crate) struct Vertex {
    /// Position of the vertex, in metres.
    pub(crate) at: Point,
    /// The sides on which the vertex lies, with the side's parameter there: none inside the sheet, one on a
    /// side, two where sides meet (for a single closed side, its end and its start).
    #[cfg_attr(not(test), allow(dead_code))] // What tests of meshes are made of.
    pub(crate) on: Vec<(usize, f64)>,
}

/// An edge of a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshEdge {
    /// Indices of the vertices at the edge's ends. On a rim they are in the direction of the side, so that
    /// the sheet is to the left.
    pub(crate) ends: [usize; 2],
    /// The piece of a side that the edge represents; `None` for an edge inside the sheet.
    pub(crate) span: Option<Span>,
}

/// A piece of a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    /// Index of the side among [`Mesh::sides`].
    pub(crate) side: usize,
    /// Curve parameter of the side at the edge's first end.
    pub(crate) from: f64,
    /// Curve parameter of the side at the edge's second end.
    pub(crate) to: f64,
}

/// A triangle of a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// Indices of the triangle's vertices, anticlockwise.
    pub(crate) vertices: [usize; 3],
    /// Indices of the triangle's edges: the i-th joins vertices i and i + 1 (mod 3).
    pub(crate) edges: [usize; 3],
}
