//! A mesh of an outline: advancing front, constrained Delaunay triangulation, smoothing.

use super::cells::Quick;
use super::delaunay::triangulate;
use super::estimate::check_count;
use super::front::Front;
use super::region::Region;
use super::relax::{relax, widen};
use super::rim::{Cut, cut};
use super::sizing::Sizing;
use super::{Mesh, MeshEdge, Span, Triangle, Vertex};
use crate::PhysicsError;
use unripple_core::plane::{Rims, circumcircle, cross, doubled, middle, minus, norm};
use unripple_core::{Outline, Point};

/// Circumradius of a triangle, relative to the desired edge length, above which there is room for another
/// vertex: for an equilateral triangle it is 0.58. Larger, more wide triangles stay; at 0.58 even good
/// triangles would get another vertex.
const WIDE: f64 = 0.8;
/// Least distance from other vertices of a vertex placed halfway between two rims, relative to the width
/// between the rims: its distance from the two rims is 0.5. Above 0.5 no vertex would ever be placed there,
/// and triangles would reach from rim to rim.
const BETWEEN: f64 = 0.4;
/// Largest number of rounds in which vertices are added, each followed by a new triangulation; it ends when
/// a round adds none.
const FILLS: usize = 3;
/// Number of rounds of smoothing, each followed by a new triangulation. With twice this value, meshes take
/// longer and triangles change little.
const ROUNDS: usize = 4;
/// Number of times that rims are cut into edges, each time twice as finely on curves and in narrow places,
/// before meshing is given up.
const TRIES: i32 = 4;

/// A preliminary mesh: triangles and the positions of their vertices.
pub(super) struct Sketch {
    /// Positions of the vertices, in metres: those on the rims first.
    pub(super) points: Vec<Point>,
    /// Indices of each triangle's vertices, anticlockwise.
    pub(super) triangles: Vec<[usize; 3]>,
}

impl Mesh {
    /// A mesh of a sheet with the given edge lengths.
    ///
    /// # Errors
    /// [`PhysicsError::Outline`] if the outline is invalid or cannot be meshed; [`PhysicsError::Range`] for lengths that are not
    /// positive, or that need more than 1e7 vertices.
    pub(crate) fn new(outline: &Outline, sizing: &Sizing) -> Result<Self, PhysicsError> {
        sizing.check()?;
        let rims = Rims::new(outline)?;
        check_count(&rims, outline.area(), sizing)?;
        for i in 0..TRIES {
            let cut = cut(&rims, sizing, sizing.finer * 2.0_f64.powi(i));
            let made = sketch(&rims, &cut, sizing).and_then(|sketch| assemble(&rims, &cut, sketch));
            if let Some(mesh) = made {
                return Ok(mesh);
            }
        }
        Err(PhysicsError::Outline {
            expected: "rims that triangles can follow",
            found: "rims too near each other for their curvature".to_owned(),
        })
    }
}

/// The triangles of a preliminary mesh; `None` if the rims' chords cross.
fn sketch(rims: &Rims, cut: &Cut, sizing: &Sizing) -> Option<Sketch> {
    let ends: Vec<[usize; 2]> = cut.edges.iter().map(|(ends, _)| *ends).collect();
    let chord = |ends: &[usize; 2]| ends.map(|i| cut.vertices[i].at);
    let region = Region::new(ends.iter().map(chord).collect());
    let places: Vec<Point> = sizing.near.iter().map(|(at, _, _)| *at).collect();
    let mut front = Front::new(rims, cut, &region, &places);
    front.advance();
    let mut triangles = triangulate(&front.cloud.points, &ends)?;
    for _ in 0..FILLS {
        let before = front.cloud.points.len();
        fill(&mut front, &triangles, cut);
        if front.cloud.points.len() == before {
            break;
        }
        triangles = triangulate(&front.cloud.points, &ends)?;
    }
    let mut cloud = front.cloud;
    for _ in 0..ROUNDS {
        relax(&mut cloud, &triangles, &cut.field, 2);
        triangles = triangulate(&cloud.points, &ends)?;
    }
    widen(&mut cloud, &triangles, 2);
    triangles = triangulate(&cloud.points, &ends)?;
    widen(&mut cloud, &triangles, 2);
    Some(Sketch { points: cloud.points, triangles })
}

/// Adds vertices in triangles that are too large, and on edges that reach from rim to rim.
fn fill(front: &mut Front, triangles: &[[usize; 3]], cut: &Cut) {
    let rims = cut.vertices.len();
    let known: Quick<(usize, usize), ()> = cut.edges.iter().map(|(ends, _)| (key(*ends), ())).collect();
    for t in triangles {
        let [a, b, c] = t.map(|i| front.cloud.points[i]);
        let (centre, radius) = circumcircle(a, b, c);
        if radius.is_finite() && radius > WIDE * cut.field.at(centre) {
            let _ = front.put(centre);
        } else if t.iter().all(|i| *i < rims) {
            let pairs = [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].into_iter();
            for [i, j] in pairs.filter(|pair| !known.contains_key(&key(*pair))) {
                let [p, q] = [i, j].map(|i| front.cloud.points[i]);
                let _ = front.put_apart(middle(p, q), BETWEEN * p.distance(q));
            }
        }
    }
}

/// Key of an edge that does not depend on the order of its ends.
fn key([a, b]: [usize; 2]) -> (usize, usize) {
    (a.min(b), a.max(b))
}

/// Least distance of a vertex from the tangents of the opposite curved edge, relative to the triangle's
/// height: above 0 the quadrature weights of the cone from that vertex are positive, half leaves a margin.
/// At 1 only straight edges would pass.
const CLEAR: f64 = 0.5;

/// Whether a triangle is star-shaped with respect to the vertex opposite its curved edge, with a margin: that vertex lies well to
/// the left of all tangents.
fn is_clear(rims: &Rims, span: &Span, [a, b, top]: [Point; 3]) -> bool {
    let side = &rims.sides[span.side].0;
    let height = doubled(a, b, top) / a.distance(b);
    (0..=8).all(|i| {
        let t = span.from + (span.to - span.from) * f64::from(i) / 8.0;
        let (p, d) = (side.at(t), side.derivative(t));
        cross(d, minus(top, p)) > CLEAR * height * norm(d)
    })
}

/// Makes the mesh from a preliminary one; `None` if a triangle is inverted or cut too much by its curved
/// edge.
fn assemble(rims: &Rims, cut: &Cut, sketch: Sketch) -> Option<Mesh> {
    let inner = |p: &Point| Vertex { at: *p, on: Vec::new() };
    let mut vertices = cut.vertices.clone();
    vertices.extend(sketch.points[vertices.len()..].iter().map(inner));
    let mut edges: Vec<MeshEdge> =
        cut.edges.iter().map(|(ends, span)| MeshEdge { ends: *ends, span: Some(*span) }).collect();
    let mut known: Quick<(usize, usize), usize> =
        edges.iter().enumerate().map(|(i, edge)| (key(edge.ends), i)).collect();
    let mut triangles = Vec::with_capacity(sketch.triangles.len());
    for t in &sketch.triangles {
        let [a, b, c] = t.map(|i| vertices[i].at);
        if doubled(a, b, c) <= 0.0 {
            return None;
        }
        let own = [([t[0], t[1]], [a, b, c]), ([t[1], t[2]], [b, c, a]), ([t[2], t[0]], [c, a, b])];
        let own = own.map(|(ends, corners)| {
            let edge = *known.entry(key(ends)).or_insert_with(|| {
                edges.push(MeshEdge { ends, span: None });
                edges.len() - 1
            });
            let clear = edges[edge].span.is_none_or(|span| is_clear(rims, &span, corners));
            clear.then_some(edge)
        });
        let [Some(e), Some(f), Some(g)] = own else { return None };
        triangles.push(Triangle { vertices: *t, edges: [e, f, g] });
    }
    Some(Mesh { sides: rims.sides.clone(), vertices, edges, triangles })
}
