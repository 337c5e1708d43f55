//! Constrained Delaunay triangulation of given points, by `spade`.

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use unripple_core::Point;

type Triangles = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The constrained Delaunay triangles to the left of closed chains of edges, anticlockwise, as indices of
/// points (m); `None` if points coincide or edges cross.
pub(super) fn triangulate(points: &[Point], rims: &[[usize; 2]]) -> Option<Vec<[usize; 3]>> {
    let places = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let mut crossed = false;
    let made = Triangles::try_bulk_load_cdt(places, rims.to_vec(), |_| crossed = true).ok()?;
    if crossed || made.num_vertices() != points.len() || made.num_constraints() != rims.len() {
        return None;
    }
    let mut inside = vec![false; made.num_all_faces()];
    let mut waiting = Vec::new();
    for &[a, b] in rims {
        let [a, b] = [a, b].map(spade::handles::FixedVertexHandle::from_index);
        waiting.push(made.get_edge_from_neighbors(a, b)?.fix());
    }
    while let Some(edge) = waiting.pop() {
        let edge = made.directed_edge(edge);
        let face = edge.face().as_inner()?;
        if !std::mem::replace(&mut inside[face.index()], true) {
            let beyond = face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge());
            waiting.extend(beyond.map(|e| e.rev().fix()));
        }
    }
    let within = made.inner_faces().filter(|face| inside[face.index()]);
    Some(within.map(|face| face.vertices().map(|v| v.index())).collect())
}
