//! Truth: shapes at many points are those at each point alone.

use crate::modes_common;

use modes_common::*;
use unripple_core::*;
use unripple_plates::Modes;

#[test]
fn many_points_read_as_each_alone() {
    let mut surface = film(Edges::All(Edge::Clamped));
    let sides = [
        Edges::All(Edge::Clamped),
        Edges::All(Edge::Free),
        Edges::PerSide(vec![Edge::Free, Edge::Clamped, Edge::Clamped, Edge::Free]),
        Edges::PerSide(vec![Edge::Supported, Edge::Clamped, Edge::Supported, Edge::Free]),
    ];
    for edges in sides {
        surface.outline = surface.outline.with_edges(edges);
        let modes = Modes::solve(&surface, 900.0, 1e-4).unwrap();
        // Rows of a grid with a gap, the same point twice, and points that share nothing.
        let mut random = Random::seeded(5);
        let mut points: Vec<Point> = (0..300)
            .map(|i| Point::from_mm(f64::from(i % 23) * 6.5, f64::from(i / 23) * 11.0))
            .filter(|point| point.x < 0.05 || point.x > 0.07)
            .collect();
        points.push(points[7]);
        points.extend((0..40).map(|_| Point::new(random.between(0.0, 0.15), random.between(0.0, 0.15))));
        let all = modes.at_all(&points);
        let mut row = vec![0.0; modes.poles().len()];
        let most = all.col_iter().flat_map(|c| c.iter()).fold(0.0_f64, |most, w| most.max(w.abs()));
        for (p, point) in points.iter().enumerate() {
            modes.at(*point, &mut row);
            let apart = row.iter().zip(all.row(p).iter()).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f64::max) < 1e-12 * most, "{point:?}");
        }
    }
}
