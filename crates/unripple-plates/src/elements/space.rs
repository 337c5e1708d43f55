//! The finite-element space of continuously differentiable (C1) piecewise quintics on a mesh.

use super::border::Border;
use super::corner::Corner;
use super::element::{Element, Middle, Seen};
use super::grid::Grid;
use super::rigid::Relative;
use super::topology::Topology;
use crate::mesh::Mesh;
use rayon::prelude::*;
use unripple_core::{Edge, Point};
use unripple_linalg::Mat;

/// Continuously differentiable quintics on a mesh that satisfy the essential boundary conditions.
///
/// Along straight sides the conditions hold exactly. Along clamped and supported curves, u (and ∂u/∂n where clamped) vanishes with its
/// derivatives at the vertices, and at points between them. Eigenvalues converge as h⁸, those of membranes as h¹⁰, on curved rims too.
#[derive(Clone, Debug)]
pub(crate) struct Space {
    /// The triangles with their quintics, in the mesh's order.
    pub(super) elements: Vec<Element>,
    /// The grid for finding the triangle that contains a point.
    pub(super) grid: Grid,
    pub(super) unknowns: usize,
    /// The unknowns that are relative to a free corner.
    pub(super) relative: Relative,
}

impl Space {
    /// The space on a mesh; `bending` if the sheet has bending stiffness: without it, clamped edges do not
    /// fix the slope.
    pub(crate) fn new(mesh: &Mesh, bending: bool) -> Self {
        let topology = Topology::of(mesh);
        let corners: Vec<Corner> = (0..mesh.vertices.len())
            .into_par_iter()
            .map(|v| Corner::of(mesh, &topology, v, bending))
            .collect();
        let mut unknowns = 0;
        let mut next = |count: usize| {
            unknowns += count;
            unknowns - count
        };
        let firsts: Vec<usize> = corners.iter().map(|corner| next(corner.count)).collect();
        let middles: Vec<Middle> = (0..mesh.edges.len())
            .map(|e| {
                let middle = middle(mesh, e);
                let held = held(mesh, e);
                let zero = bending && held == Some(Edge::Clamped);
                Middle { unknown: (!zero).then(|| next(1)), ..middle }
            })
            .collect();
        let relative = if bending {
            Relative::new((mesh, &topology), &corners, &firsts, &middles, unknowns)
        } else {
            Relative::default()
        };
        let elements: Vec<Element> = (0..mesh.triangles.len())
            .into_par_iter()
            .map(|t| {
                let triangle = mesh.triangles[t];
                let seen = triangle.vertices.map(|v| Seen {
                    at: mesh.vertices[v].at,
                    first: firsts[v],
                    corner: &corners[v],
                });
                let borders = [0, 1, 2].map(|i| {
                    let ends = [seen[i].at, seen[(i + 1) % 3].at];
                    border(mesh, triangle.edges[i], ends)
                });
                Element::new(t, seen, borders, triangle.edges.map(|e| middles[e]))
            })
            .collect();
        let grid = Grid::new(mesh, &elements);
        Self { elements, grid, unknowns, relative }
    }

    /// Number of unknowns n: the size of all matrices.
    pub(crate) fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Turns vectors of the matrices' unknowns, unknowns x vectors, into nodal values, which are the unknowns of [`Space::weights`]: around
    /// free corners the matrices' unknowns are relative to the motion of the corner.
    pub(crate) fn nodal(&self, vectors: &mut Mat<f64>) {
        self.relative.nodal(vectors);
    }

    /// Index of the triangle that contains a point (m), and the point itself; for a point outside the
    /// sheet, the nearest point of the rim and its triangle.
    pub(crate) fn locate(&self, point: Point) -> (usize, Point) {
        self.grid.locate(&self.elements, point)
    }

    /// Indices and weights of the unknowns whose weighted sum is u at a point (m), or for a point outside
    /// the sheet at the nearest point of the rim.
    pub(crate) fn weights(&self, point: Point) -> (&[usize], Vec<f64>) {
        let (element, point) = self.locate(point);
        let Some(element) = self.elements.get(element) else { return (&[], Vec::new()) };
        (&element.unknowns, element.values(point))
    }

    #[cfg(test)]
    /// Indices of unknowns and six rows of weights, as by [`Space::weights`], for u, u_x, u_y (1/m), u_xx,
    /// u_xy and u_yy (1/m²).
    pub(crate) fn derivatives(&self, point: Point) -> (&[usize], [Vec<f64>; 6]) {
        let (element, point) = self.locate(point);
        let Some(element) = self.elements.get(element) else { return (&[], Default::default()) };
        (&element.unknowns, element.jets(point, element.covering(point)))
    }
}

/// The edge condition of a mesh edge on a rim; `None` for an edge inside the sheet.
fn held(mesh: &Mesh, edge: usize) -> Option<Edge> {
    let span = mesh.edges[edge].span?;
    mesh.sides.get(span.side).map(|(_, edge)| *edge)
}

/// A mesh edge as a triangle's border, running from the first to the second of the points `ends`.
fn border(mesh: &Mesh, edge: usize, ends: [Point; 2]) -> Border {
    let straight = Border { held: held(mesh, edge), ..Border::line(ends[0], ends[1]) };
    let Some(span) = mesh.edges[edge].span else { return straight };
    match mesh.sides.get(span.side) {
        Some((side, held)) if !side.is_straight() => {
            Border { side: *side, from: span.from, to: span.to, held: Some(*held) }
        }
        _ => straight,
    }
}

/// The middle of a mesh edge; on a curved side, the point halfway in the parameter of the curve.
pub(super) fn middle(mesh: &Mesh, edge: usize) -> Middle {
    let ends = mesh.edges[edge].ends.map(|v| mesh.vertices[v].at);
    let border = border(mesh, edge, ends);
    Middle {
        at: border.at(0.5),
        normal: border.directions(0.5).1,
        length: ends[0].distance(ends[1]),
        unknown: None,
    }
}
