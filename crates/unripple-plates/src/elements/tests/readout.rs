//! Shapes anywhere.

use super::meshes;
use super::solve::{fabric, modes};
use crate::elements::{MeshShapes, Space};
use proptest::prelude::*;
use std::f64::consts::PI;
use unripple_core::{Edge, Point, Shapes};
use unripple_linalg::Mat;

#[test]
fn shapes_of_a_supported_square_are_sines() {
    let mesh = meshes::rectangle([1.0; 2], [8; 2], 0.2, [Edge::Supported; 4]);
    let space = Space::new(&mesh, true);
    let (_, vectors) = modes(&space.assemble(&fabric(1.0, 0.0, 0.3)), 0.0);
    let shapes = MeshShapes::new(space, vectors.subcols(0, 20));
    let points: Vec<Point> = (0..500)
        .map(|i| Point::new((0.7548 * f64::from(i)).fract(), (0.5698 * f64::from(i)).fract()))
        .collect();
    let all = shapes.at_all(&points);
    assert_eq!((all.nrows(), all.ncols(), shapes.modes()), (500, 20, 20));
    let centre = Point::new(0.5, 0.5);
    let mut row = vec![0.0; 20];
    shapes.at(centre, &mut row);
    let sign = row[0].signum();
    for (i, p) in points.iter().enumerate() {
        shapes.at(*p, &mut row);
        (0..20).for_each(|m| assert_eq!(row[m], all[(i, m)]));
        let (s, c) = ((PI * p.x).sin_cos(), (PI * p.y).sin_cos());
        let exact = [s.0 * c.0, PI * s.1 * c.0, PI * s.0 * c.1, -PI * PI * s.0 * c.0, PI * PI * s.1 * c.1];
        // Of a quintic u errs by h⁶, its second derivatives by h⁴.
        let most = [1e-5, 1e-3, 1e-3, 5e-2, 5e-2];
        for ((jet, exact), most) in shapes.jets_at(*p).iter().zip(exact).zip(most) {
            assert!((sign * jet[0] - 2.0 * exact).abs() < most, "{p}: {} {exact}", jet[0]);
        }
    }
    // The fourth mode stands alone: (2, 2).
    shapes.at(Point::new(0.25, 0.25), &mut row);
    assert!((row[3].abs() - 2.0).abs() < 1e-4);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_point_has_its_triangle(x in -1.0..3.0, y in -1.0..3.0) {
        let p = Point::new(x, y);
        let centre = Point::new(1.0, 1.0);
        for (mesh, outer, inner) in [
            (meshes::circle(1.0, 3, Edge::Free), 1.0, 0.0),
            (meshes::ring([0.4, 1.0], 2, 9, [Edge::Free; 2]), 1.0, 0.4),
        ] {
            let space = Space::new(&mesh, true);
            let (e, at) = space.locate(p);
            let r = p.distance(centre);
            let expected = r.clamp(inner, outer);
            prop_assert!(space.elements[e].depth(at) > -1e-8);
            prop_assert!((at.distance(centre) - expected).abs() < 1e-8);
            let moved = at.distance(p);
            prop_assert!((moved - (r - expected).abs()).abs() < 1e-8, "{moved}");
        }
    }
}

#[test]
fn strange_points_do_no_harm() {
    let space = Space::new(&meshes::circle(1.0, 2, Edge::Clamped), true);
    let coefficients = Mat::from_fn(space.unknowns(), 3, |i, j| (i + j) as f64);
    let shapes = MeshShapes::new(space, coefficients.as_ref());
    let mut row = [0.0; 3];
    for p in [Point::new(f64::NAN, 0.0), Point::new(f64::INFINITY, 1.0), Point::new(1e300, -1e300)] {
        shapes.at(p, &mut row);
    }
    assert_eq!(shapes.at_all(&[]).nrows(), 0);
}
