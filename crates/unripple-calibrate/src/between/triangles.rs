//! Linear interpolation on a Delaunay triangulation.

use spade::{DelaunayTriangulation, FloatTriangulation, HasPosition, Point2, Triangulation};
use unripple_core::Point;

/// Delaunay triangulation of the measured points.
#[derive(Debug)]
pub(crate) struct Triangles {
    mesh: DelaunayTriangulation<Corner>,
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Point2<f64>,
    index: usize,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

impl Triangles {
    /// Triangulates `points`. Points whose coordinates are too large for the triangulation's arithmetic are left out.
    pub fn of(points: &[Point]) -> Self {
        let mut mesh = DelaunayTriangulation::new();
        for (index, point) in points.iter().enumerate() {
            let _ = mesh.insert(Corner { at: Point2::new(point.x, point.y), index });
        }
        Self { mesh }
    }

    /// Indices and barycentric weights of the corners of the triangle that contains a place; for a place
    /// beyond the convex hull, those of the two ends of the hull's nearest edge.
    pub fn weights(&self, place: Point) -> Vec<(usize, f64)> {
        let at = Point2::new(place.x, place.y);
        let mut corners = Vec::new();
        self.mesh.barycentric().get_weights(at, &mut corners);
        if !corners.is_empty() {
            return corners
                .iter()
                .map(|(corner, weight)| (self.mesh.vertex(*corner).data().index, *weight))
                .collect();
        }
        let edges = self.mesh.convex_hull().map(|edge| {
            let [a, b] = edge.positions();
            let [from, to] = edge.vertices().map(|corner| corner.data().index);
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            let square = (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
            let t = (((at.x - a.x) * dx + (at.y - a.y) * dy) / square).clamp(0.0, 1.0);
            let distance = place.distance(Point::new(a.x + t * dx, a.y + t * dy));
            (distance, vec![(from, 1.0 - t), (to, t)])
        });
        let closest = edges.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, weights)| weights);
        // A single point has no edge.
        closest.unwrap_or_else(|| self.mesh.vertices().map(|corner| (corner.data().index, 1.0)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_kept() {
        let points: Vec<Point> = (0..30)
            .map(|i| Point::new(f64::from(i % 6) * 0.01, f64::from(i / 6) * 0.013 + f64::from(i % 2) * 0.002))
            .collect();
        let plane = |p: Point| 3.0 * p.x - 2.0 * p.y + 0.1;
        let triangles = Triangles::of(&points);
        for i in 0..50 {
            let place = Point::new(0.001 + 0.00096 * f64::from(i), 0.003 + 0.00091 * f64::from((i * 7) % 50));
            let weights = triangles.weights(place);
            let value: f64 = weights.iter().map(|(i, w)| w * plane(points[*i])).sum();
            assert!((value - plane(place)).abs() < 1e-12, "{place}");
        }
    }

    #[test]
    fn beyond_the_hull_its_nearest_place_holds() {
        let points = [Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(0.0, 1.0)];
        let weights = Triangles::of(&points).weights(Point::new(0.25, -3.0));
        let of = |index| weights.iter().find(|(i, _)| *i == index).map_or(0.0, |(_, w)| *w);
        assert!((of(0) - 0.75).abs() < 1e-12 && (of(1) - 0.25).abs() < 1e-12 && of(2) == 0.0);
        assert_eq!(Triangles::of(&points[..1]).weights(Point::new(4.0, 4.0)), vec![(0, 1.0)]);
        assert!(Triangles::of(&[]).weights(Point::new(4.0, 4.0)).is_empty());
    }
}
