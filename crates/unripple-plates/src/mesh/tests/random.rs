//! Random polygons with holes.

use super::{check, least_angle};
use crate::PhysicsError;
use crate::mesh::{Mesh, Sizing, corners};
use proptest::prelude::*;
use std::f64::consts::TAU;
use unripple_core::{Hole, Outline, Point, Shape, Side};

/// Radii between 0.4 and 1 around a point, of as many vertices.
fn radii() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.4..1.0, 4..12)
}

/// A polygon that is seen whole from one point, about 0.1 m in radius.
fn polygon(radii: &[f64], turn: f64) -> Outline {
    let vertex = |(i, r): (usize, &f64)| {
        let a = TAU * (i as f64 + turn) / radii.len() as f64;
        Point::new(0.1 + 0.1 * r * a.cos(), 0.1 + 0.1 * r * a.sin())
    };
    Outline::new(Shape::Polygon(radii.iter().enumerate().map(vertex).collect()))
}

/// One of the holes around that point: round, rectangular or a slit.
fn hole(kind: u32, place: usize, size: f64) -> Hole {
    let a = TAU * place as f64 / 3.0;
    let at = Point::new(0.1 + 0.013 * a.cos(), 0.1 + 0.013 * a.sin());
    match kind {
        0 => Hole::new(&Shape::Circle { radius: size }, Point::new(at.x - size, at.y - size)),
        1 => Hole::new(&Shape::Rectangle { width: size, height: 0.3 * size }, at),
        _ => Hole::slit(at, Point::new(at.x + size, at.y + 0.5 * size), 0.01 * size),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_sheet_is_covered(
        radii in radii(),
        turn in 0.0..1.0,
        holes in prop::collection::vec((0u32..3, 2e-4..6e-3), 0..4),
        size in 0.008..0.05,
    ) {
        let holes = holes.into_iter().enumerate().map(|(i, (kind, size))| hole(kind, i, size));
        let outline = holes.fold(polygon(&radii, turn), Outline::with_hole);
        let sharpest = corners(&outline).unwrap().iter().map(|c| c.angle.to_degrees()).fold(180.0, f64::min);
        let mesh = Mesh::new(&outline, &Sizing::even(size)).unwrap();
        check(&mesh, &outline);
        let least = least_angle(&mesh);
        prop_assert!(least > (0.6 * sharpest).min(20.0), "{least} {sharpest}");
        let ratio = Mesh::estimate(&outline, &Sizing::even(size)).unwrap() as f64 / mesh.vertices.len() as f64;
        prop_assert!((0.67..1.5).contains(&ratio), "{ratio}");
    }

    #[test]
    fn any_refinement_is_met(radii in radii(), finest in 1e-9..1e-3, at in (0.06..0.14, 0.06..0.14)) {
        let outline = polygon(&radii, 0.0);
        let near = vec![(Point::new(at.0, at.1), 0.0, 10.0 * finest)];
        let corners = vec![finest; radii.len()];
        let sizing = Sizing { near, corners, ..Sizing::even(0.02) };
        let mesh = Mesh::new(&outline, &sizing).unwrap();
        check(&mesh, &outline);
        prop_assert!(least_angle(&mesh) > 15.0, "{}", least_angle(&mesh));
    }

    #[test]
    fn curved_sides_are_followed(
        radii in radii(),
        bends in prop::collection::vec((0.5..1.3, 0.5..1.3), 12),
        size in 0.008..0.05,
    ) {
        let n = radii.len();
        let at = |place: f64, r: f64| {
            let a = TAU * place / n as f64;
            Point::new(0.1 + 0.1 * r * a.cos(), 0.1 + 0.1 * r * a.sin())
        };
        let side = |i: usize| {
            let (place, (one, other)) = (i as f64, bends[i]);
            let inner = [at(place + 0.3, one * radii[i]), at(place + 0.7, other * radii[(i + 1) % n])];
            Side::Cubic([at(place, radii[i]), inner[0], inner[1], at(place + 1.0, radii[(i + 1) % n])])
        };
        let mut sides: Vec<Side> = (0..n).map(side).collect();
        // Exactly closed, as the angle's last bit does not make sure.
        if let (Side::Cubic(first), Side::Cubic(last)) = (sides[0], &mut sides[n - 1]) {
            last[3] = first[0];
        }
        let outline = Outline::new(Shape::Path(sides));
        let mesh = Mesh::new(&outline, &Sizing::even(size)).unwrap();
        check(&mesh, &outline);
        let sharpest = corners(&outline).unwrap().iter().map(|c| c.angle.to_degrees()).fold(180.0, f64::min);
        let least = least_angle(&mesh);
        prop_assert!(least > (0.6 * sharpest).min(20.0), "{least} {sharpest}");
    }

    #[test]
    fn random_vertices_give_a_mesh_or_a_fault(places in prop::collection::vec((0.0..0.1, 0.0..0.1), 3..9)) {
        let outline = Outline::new(Shape::Polygon(places.into_iter().map(|(x, y)| Point::new(x, y)).collect()));
        match Mesh::new(&outline, &Sizing::even(0.01)) {
            Ok(mesh) => check(&mesh, &outline),
            Err(fault) => prop_assert!(matches!(fault, PhysicsError::Outline { .. }), "{fault}"),
        }
    }
}
