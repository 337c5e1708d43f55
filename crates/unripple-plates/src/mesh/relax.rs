//! Mesh smoothing: vertices are moved until triangles are well shaped, with unchanged connectivity.

use super::field::Field;
use super::front::Cloud;
use std::f64::consts::PI;
use unripple_core::Point;
use unripple_core::plane::{along, middle, minus, norm, sharpness, turned};

/// Cotangent of the smallest angle (34°) above which triangles count as well shaped, so that the angle may
/// become smaller in favour of their neighbours. With twice this value, angles down to 19° would be left
/// unchanged.
const FAIR: f64 = 1.46;

/// The triangles around each vertex.
pub(super) struct Stars {
    first: Vec<usize>,
    triangles: Vec<[usize; 3]>,
}

impl Stars {
    /// The triangles around each of `vertices` vertices; each triangle (of vertex indices) is listed with
    /// that vertex first.
    pub(super) fn new(vertices: usize, triangles: &[[usize; 3]]) -> Self {
        let mut first = vec![0; vertices + 1];
        triangles.iter().flatten().for_each(|v| first[v + 1] += 1);
        (0..vertices).for_each(|v| first[v + 1] += first[v]);
        let (mut next, mut sorted) = (first.clone(), vec![[0; 3]; 3 * triangles.len()]);
        for t in triangles {
            for i in 0..3 {
                sorted[next[t[i]]] = [t[i], t[(i + 1) % 3], t[(i + 2) % 3]];
                next[t[i]] += 1;
            }
        }
        Self { first, triangles: sorted }
    }

    /// The triangles around the vertex with this index, as indices of vertices, that vertex first.
    pub(super) fn of(&self, vertex: usize) -> &[[usize; 3]] {
        &self.triangles[self.first[vertex]..self.first[vertex + 1]]
    }

    /// Cotangent of the smallest angle of the triangles around a vertex if it were at the point `p`.
    fn sharpness(&self, vertex: usize, p: Point, points: &[Point]) -> f64 {
        let each = self.of(vertex).iter().map(|t| sharpness([p, points[t[1]], points[t[2]]]));
        each.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Moves each vertex to where its edges have the desired lengths on average (the balance of springs of
/// Persson and Strang, *SIAM Rev.* 46, 329, 2004), unless the smallest angle would decrease; `sweeps` is
/// the number of passes over all vertices.
pub(super) fn relax(cloud: &mut Cloud, triangles: &[[usize; 3]], field: &Field, sweeps: usize) {
    let stars = Stars::new(cloud.points.len(), triangles);
    for _ in 0..sweeps {
        for v in cloud.fixed..cloud.points.len() {
            let star = stars.of(v);
            if star.is_empty() {
                continue;
            }
            let p = cloud.points[v];
            let mut sum = Point::new(0.0, 0.0);
            for t in star {
                let q = cloud.points[t[1]];
                let away = minus(p, q);
                let wanted = 0.5 * (cloud.sizes[v] + cloud.sizes[t[1]]);
                sum = along(along(sum, q, 1.0), away, wanted / norm(away).max(f64::MIN_POSITIVE));
            }
            let mean = Point::new(sum.x / star.len() as f64, sum.y / star.len() as f64);
            let before = stars.sharpness(v, p, &cloud.points);
            let better = [mean, middle(p, mean)]
                .into_iter()
                .find(|q| stars.sharpness(v, *q, &cloud.points) <= before.max(FAIR));
            if let Some(q) = better {
                cloud.points[v] = q;
                cloud.sizes[v] = field.at(q);
            }
        }
    }
}

/// Moves the vertices of sharp triangles so that the least angle around them increases; `sweeps` is the number
/// of passes.
pub(super) fn widen(cloud: &mut Cloud, triangles: &[[usize; 3]], sweeps: usize) {
    let stars = Stars::new(cloud.points.len(), triangles);
    for _ in 0..sweeps {
        for v in cloud.fixed..cloud.points.len() {
            let mut best = stars.sharpness(v, cloud.points[v], &cloud.points);
            let mut step = 0.25 * cloud.sizes[v];
            while best > FAIR && step > 0.01 * cloud.sizes[v] {
                let from = cloud.points[v];
                let around =
                    |i: i32| along(from, turned(Point::new(1.0, 0.0), f64::from(i) * PI / 4.0), step);
                let trial = (0..8)
                    .map(|i| (around(i), stars.sharpness(v, around(i), &cloud.points)))
                    .min_by(|a, b| a.1.total_cmp(&b.1));
                match trial {
                    Some((p, trial)) if trial < best => (cloud.points[v], best) = (p, trial),
                    _ => step *= 0.5,
                }
            }
        }
    }
}
