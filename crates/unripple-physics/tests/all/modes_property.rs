//! Truth: what holds for every sheet.

use crate::modes_common;

use modes_common::*;
use proptest::prelude::*;
use std::f64::consts::PI;
use unripple_core::*;
use unripple_physics::{Medium, Modes, PhysicsError, ResponseOptions, responses, sample};

fn edge() -> impl Strategy<Value = Edge> {
    prop_oneof![Just(Edge::Clamped), Just(Edge::Supported), Just(Edge::Free)]
}

/// Random sheets: sides, thickness, tension (or none), Poisson's ratio, edges.
fn surfaces() -> impl Strategy<Value = Surface> {
    let tension = prop_oneof![Just(0.0), 20.0..500.0];
    (0.08..0.2, 0.08..0.2, 0.1e-3..1e-3, tension, 0.0..0.48, proptest::collection::vec(edge(), 4)).prop_map(
        |(width, height, thickness, tension, poisson, edges)| {
            let mut surface = film(Edges::PerSide(edges));
            surface.outline.shape = Shape::Rectangle { width, height };
            let sheet = &mut surface.sheet;
            (sheet.thickness, sheet.tension, sheet.poisson) = (thickness, tension, poisson);
            surface
        },
    )
}

/// The frequency where about 12 radians fit a 0.1 m side: some ten modes.
fn top(surface: &Surface) -> f64 {
    Medium::of(&surface.sheet).omega(100.0) / (2.0 * PI)
}

/// Gauss–Legendre nodes and weights on [0, side].
fn gauss(count: usize, side: f64) -> Vec<(f64, f64)> {
    (0..count)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..20 {
                let (mut below, mut p) = (1.0, x);
                for k in 2..=count {
                    let k = k as f64;
                    (below, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * below) / k);
                }
                slope = count as f64 * (x * p - below) / (x * x - 1.0);
                x -= p / slope;
            }
            (side * (1.0 + x) / 2.0, side / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn shapes_are_orthonormal_in_mass(surface in surfaces()) {
        let modes = Modes::solve(&surface, top(&surface), 1e-4).unwrap();
        let (width, height) = surface.outline.extent();
        let (xs, ys) = (gauss(48, width), gauss(48, height));
        let points: Vec<Point> =
            xs.iter().flat_map(|x| ys.iter().map(move |y| Point::new(x.0, y.0))).collect();
        let weights: Vec<f64> = xs.iter().flat_map(|x| ys.iter().map(move |y| x.1 * y.1)).collect();
        let shapes = modes.at_all(&points);
        let density = Medium::of(&surface.sheet).areal_density;
        for a in 0..shapes.ncols() {
            for b in 0..=a {
                let product: f64 =
                    weights.iter().enumerate().map(|(p, w)| density * w * shapes[(p, a)] * shapes[(p, b)]).sum();
                prop_assert!((product - f64::from(u8::from(a == b))).abs() < 1e-9, "{a} {b}: {product}");
            }
        }
    }

    #[test]
    fn one_point_reads_as_many(surface in surfaces(), u in 0.0..1.0, v in 0.0..1.0) {
        let modes = Modes::solve(&surface, top(&surface), 1e-3).unwrap();
        let (width, height) = surface.outline.extent();
        let point = Point::new(u * width, v * height);
        let mut row = vec![0.0; modes.poles().len()];
        modes.at(point, &mut row);
        let all = modes.at_all(&vec![point; 200]);
        let size = 1.0 / (width * height * Medium::of(&surface.sheet).areal_density).sqrt();
        for (m, value) in row.iter().enumerate() {
            for p in [0, 199] {
                prop_assert!((value - all[(p, m)]).abs() < 1e-11 * size);
            }
        }
    }

    #[test]
    fn held_sides_hold(surface in surfaces(), along in 0.05..0.95) {
        let modes = Modes::solve(&surface, top(&surface), 1e-3).unwrap();
        let (width, height) = surface.outline.extent();
        // A place on each side, and the way in.
        let sides = [
            (along * width, 0.0, 0.0, 1.0),
            (width, along * height, -1.0, 0.0),
            (along * width, height, 0.0, -1.0),
            (0.0, along * height, 1.0, 0.0),
        ];
        let size = 2.0 / (width * height * Medium::of(&surface.sheet).areal_density).sqrt();
        for (side, (x, y, in_x, in_y)) in sides.into_iter().enumerate() {
            let step = 1e-6 * width;
            let shapes = modes.at_all(&[Point::new(x, y), Point::new(x + step * in_x, y + step * in_y)]);
            for m in 0..shapes.ncols() {
                let (at, inside) = (shapes[(0, m)].abs() / size, shapes[(1, m)].abs() / size);
                match surface.outline.edge(side) {
                    Edge::Free | Edge::Elastic { .. } => {}
                    Edge::Supported => prop_assert!(at < 1e-10),
                    // A slope of order one would show as 1e-6 here.
                    Edge::Clamped => prop_assert!(at < 1e-10 && inside < 1e-8, "{inside}"),
                }
            }
        }
    }

    #[test]
    fn more_tension_raises_every_frequency(surface in surfaces()) {
        let mut tighter = surface.clone();
        tighter.sheet.tension = 1.2 * surface.sheet.tension + 5.0;
        let (accuracy, max_hz) = (1e-4, top(&surface));
        let low = Modes::solve(&surface, max_hz, accuracy).unwrap().frequencies_hz();
        let high = Modes::solve(&tighter, max_hz, accuracy).unwrap().frequencies_hz();
        prop_assert!(high.len() <= low.len());
        for (low, high) in low.iter().zip(&high) {
            prop_assert!(*high >= low * (1.0 - accuracy));
        }
    }

    #[test]
    fn holding_a_side_raises_every_frequency(surface in surfaces(), side in 0usize..4) {
        let with = |edge: Edge| {
            let list = (0..4).map(|i| if i == side { edge } else { surface.outline.edge(i) }).collect();
            let mut surface = surface.clone();
            surface.outline.edges = Edges::PerSide(list);
            Modes::solve(&surface, top(&surface), 1e-4).unwrap().frequencies_hz()
        };
        let [free, supported, clamped] = [Edge::Free, Edge::Supported, Edge::Clamped].map(with);
        prop_assert!(clamped.len() <= supported.len() && supported.len() <= free.len());
        for (low, high) in free.iter().zip(&supported).chain(supported.iter().zip(&clamped)) {
            prop_assert!(*high >= low * (1.0 - 1e-4), "{low} {high}");
        }
    }

    #[test]
    fn turning_the_sheet_changes_nothing(surface in surfaces(), u in 0.0..1.0, v in 0.0..1.0) {
        let (width, height) = surface.outline.extent();
        let mut turned = surface.clone();
        turned.outline.shape = Shape::Rectangle { width: height, height: width };
        turned.outline.edges = Edges::PerSide((0..4).map(|i| surface.outline.edge((i + 3) % 4)).collect());
        // Some mixed edges are refused at this accuracy, which the error names: what cannot be had cannot be compared.
        let solved = [&surface, &turned].map(|s| Modes::solve(s, top(&surface), 1e-5));
        if solved.iter().any(|solved| matches!(solved, Err(PhysicsError::NotConverged { .. }))) {
            return Err(TestCaseError::reject("refused at this accuracy"));
        }
        let [here, there] = solved.map(Result::unwrap);
        prop_assert_eq!(here.poles().len(), there.poles().len());
        // A quarter turn anticlockwise takes (x, y) to (height - y, x).
        let (x, y) = (u * width, v * height);
        let [a, b] = [(&here, Point::new(x, y)), (&there, Point::new(height - y, x))].map(|(modes, point)| {
            let mut row = vec![0.0; modes.poles().len()];
            modes.at(point, &mut row);
            row
        });
        let poles = here.poles();
        let alone = |m: usize| {
            let clear = |n: usize| (poles[n].omega - poles[m].omega).abs() > 1e-3 * poles[m].omega;
            (m == 0 || clear(m - 1)) && (m + 1 == poles.len() || clear(m + 1))
        };
        for m in 0..poles.len() {
            prop_assert!((poles[m].omega - there.poles()[m].omega).abs() <= 1e-7 * (1.0 + poles[m].omega));
            if alone(m) && poles[m].omega > 0.0 {
                let size = 2.0 / (width * height * Medium::of(&surface.sheet).areal_density).sqrt();
                prop_assert!((a[m].abs() - b[m].abs()).abs() < 1e-4 * size, "{m}: {} {}", a[m], b[m]);
            }
        }
    }

    #[test]
    fn responses_are_reciprocal(surface in surfaces(), places in proptest::collection::vec((0.05..0.95, 0.05..0.95), 2)) {
        let (width, height) = surface.outline.extent();
        let mut surface = surface;
        surface.emission.band[1] = top(&surface);
        surface.emission.rate = 4.1 * top(&surface);
        let points: Vec<Point> = places.iter().map(|(u, v)| Point::new(u * width, v * height)).collect();
        surface.actuators = points
            .iter()
            .enumerate()
            .map(|(i, at)| Actuator { name: format!("a{i}"), at: *at, kind: ActuatorKind::Force, contact_radius: 0.0 })
            .collect();
        let options = ResponseOptions { accuracy: 1e-3.into(), ..Default::default() };
        let Responses::Modal(modal) = responses(&surface, &options).unwrap() else { panic!("not modal") };
        let sampled = sample(&modal, &points, 200);
        let (there, back) = (sampled.response(0, 1), sampled.response(1, 0));
        // A driven point moves at once, with half its inverse local mass of the band: Σφ².
        let start: f64 = (0..modal.poles.len()).map(|m| modal.input[(0, m)].powi(2)).sum();
        prop_assert!((f64::from(sampled.response(0, 0)[0]) - start).abs() <= 4e-6 * start);
        for (a, b) in there.iter().zip(back) {
            prop_assert!((f64::from(*a) - f64::from(*b)).abs() <= 4e-6 * (1e-9 + start));
        }
    }
}

#[test]
fn doubles_are_doubles_and_stay_in_order() {
    for sides in ["cccc", "ffff"] {
        let mut surface = film(edges(sides));
        surface.sheet.tension = 50.0;
        let modes = Modes::solve(&surface, 500.0, 1e-7).unwrap();
        let hz = modes.frequencies_hz();
        assert!(hz.is_sorted());
        let pairs: Vec<usize> =
            (1..hz.len()).filter(|m| hz[*m] > 0.0 && (hz[*m] / hz[m - 1] - 1.0).abs() < 1e-9).collect();
        assert!(pairs.len() >= 5, "{sides}: {}", pairs.len());
        // Even along x comes first: mirror x -> -x leaves it as it is, and turns the other.
        let points = [Point::new(0.031, 0.047), Point::new(0.15 - 0.031, 0.047)];
        let shapes = modes.at_all(&points);
        for m in pairs {
            assert!((shapes[(0, m - 1)] - shapes[(1, m - 1)]).abs() < 1e-8, "{sides} {m}");
            assert!((shapes[(0, m)] + shapes[(1, m)]).abs() < 1e-8, "{sides} {m}");
        }
    }
}
