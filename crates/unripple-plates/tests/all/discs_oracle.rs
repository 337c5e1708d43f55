//! Truth: modes of round sheets against closed forms, a problem along the radius, and meshes.

use crate::modes_common;
use crate::round_common;
use crate::truth_common::radial;

use modes_common::film;
use round_common::{frequencies, j, roots};
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_plates::{Medium, Modes, PhysicsError, gauss};

const RADIUS: f64 = 0.07;

const HELD: [Edge; 3] = [Edge::Free, Edge::Clamped, Edge::Supported];

fn round(edge: Edge, tension: f64, thickness: f64) -> Surface {
    let outline = Outline::new(Shape::Circle { radius: RADIUS }).with_edges(Edges::All(edge));
    let mut surface = Surface { outline, ..film(Edges::All(edge)) };
    (surface.sheet.tension, surface.sheet.thickness) = (tension, thickness);
    surface
}

/// The same on a mesh: two half circles without straight sides between them.
fn meshed(mut surface: Surface) -> Surface {
    surface.outline.shape = Shape::Stadium { straight: 0.0, radius: RADIUS };
    surface
}

/// Solves at several accuracies, and checks the frequencies (Hz, ascending, without rigid modes) and the number of rigid modes.
fn check(surface: &Surface, top: f64, exact: &[f64], rigid: usize) {
    for accuracy in [1e-2, 1e-5, 1e-9] {
        let modes = Modes::solve(surface, top, accuracy).unwrap();
        let found = modes.frequencies_hz();
        assert_eq!(found.len(), rigid + exact.len(), "{:?}", surface.outline.edge(0));
        assert!(found[..rigid].iter().all(|hz| *hz == 0.0));
        let apart = found[rigid..].iter().zip(exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max);
        // The determinants have rounding errors too.
        assert!(apart <= modes.error() + 2e-12, "{apart:e} off, {:e} stated", modes.error());
        assert!(modes.error() <= accuracy);
    }
}

#[test]
fn plates_and_films_have_the_roots_of_their_determinants() {
    for edge in HELD {
        for (tension, thickness, top) in
            [(0.0, 1e-3, 12e3), (0.0, 1e-3, 60e3), (200.0, 0.125e-3, 4e3), (1e3, 1e-3, 12e3)]
        {
            let surface = round(edge, tension, thickness);
            let exact = frequencies(&surface.sheet, RADIUS, edge, top);
            let rigid = match (edge, tension > 0.0) {
                (Edge::Free, false) => 3,
                (Edge::Free, true) => 1,
                _ => 0,
            };
            assert!(exact.len() > 100);
            check(&surface, top, &exact, rigid);
        }
    }
}

#[test]
fn membranes_have_the_zeros_of_bessel_functions() {
    let mut surface = round(Edge::Clamped, 200.0, 0.125e-3);
    surface.sheet.young = 0.0;
    let speed = Medium::of(&surface.sheet).omega(1.0);
    let reach = 70.0;
    let mut exact: Vec<f64> = Vec::new();
    for n in 0..71 {
        let zeros = roots(|x| j(n, x)[n], [0.5, reach], 2000);
        let times = if n == 0 { 1 } else { 2 };
        exact.extend(zeros.iter().flat_map(|x| std::iter::repeat_n(x * speed / RADIUS / TAU, times)));
    }
    exact.sort_by(f64::total_cmp);
    assert!(exact.len() > 1000);
    check(&surface, reach * speed / RADIUS / TAU, &exact, 0);
}

#[test]
fn springs_at_the_rim_agree_with_a_problem_along_the_radius() {
    for (tension, lift, tilt) in
        [(0.0, 1e4, 0.0), (0.0, 1e4, 2.0), (300.0, 5e3, 0.1), (0.0, 0.0, 1.0), (100.0, 0.0, 1.0)]
    {
        let edge = Edge::Elastic { lift, tilt };
        let surface = round(edge, tension, 1e-3);
        let medium = Medium::of(&surface.sheet);
        let piece = radial::Piece {
            radii: [0.0, RADIUS],
            bending: medium.bending_stiffness,
            poisson: surface.sheet.poisson,
            tension,
            mass: medium.areal_density,
        };
        let exact = radial::frequencies(&[piece], [Edge::Free, edge], 2400.0);
        let modes = Modes::solve(&surface, 2400.0, 1e-6).unwrap();
        let found = modes.frequencies_hz();
        let rigid = usize::from(lift == 0.0);
        assert_eq!(found.len(), rigid + exact.len(), "{edge:?}");
        let apart = found[rigid..].iter().zip(&exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max);
        // That problem is solved to about 1e-9.
        assert!(apart < 1e-8, "{edge:?} {apart:e}");
    }
}

/// Widths of the boundary layer from a hundredth to a five-thousandth of the radius.
#[test]
fn stated_errors_are_bounds_where_boundary_layers_are_thin() {
    for share in [1e-2, 1e-3, 2e-4] {
        let mut surface = round(Edge::Clamped, 200.0, 0.01e-3);
        let bending = 200.0 * (share * RADIUS).powi(2);
        let sheet = &mut surface.sheet;
        sheet.young = bending * 12.0 * (1.0 - sheet.poisson.powi(2)) / sheet.thickness.powi(3);
        let top = Medium::of(sheet).omega(10.0 / RADIUS) / TAU;
        let exact = frequencies(&surface.sheet, RADIUS, Edge::Clamped, 1.01 * top);
        for accuracy in [1e-2, 1e-3, 1e-4] {
            let modes = Modes::solve(&surface, top, accuracy).unwrap();
            let found = modes.frequencies_hz();
            let apart = found.iter().zip(&exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max);
            println!(
                "{share:e}, asked {accuracy:e}: {} modes, {:e} stated, {apart:e} off",
                found.len(),
                modes.error()
            );
            assert!(found.len() > 15 && apart <= modes.error() + 1e-8 && modes.error() <= accuracy);
        }
    }
}

#[test]
fn springs_as_hard_as_rock_clamp() {
    let clamped = Modes::solve(&round(Edge::Clamped, 0.0, 1e-3), 6e3, 1e-8).unwrap().frequencies_hz();
    let surface = round(Edge::Elastic { lift: 1e14, tilt: 1e9 }, 0.0, 1e-3);
    let modes = Modes::solve(&surface, 6e3, 1e-4).unwrap();
    for (hard, rock) in modes.frequencies_hz().iter().zip(clamped) {
        assert!((hard / rock - 1.0).abs() < 1e-4, "{hard} {rock}");
    }
}

#[test]
fn shapes_have_unit_mass_and_nothing_in_common() {
    for (edge, tension) in [(Edge::Free, 0.0), (Edge::Clamped, 200.0), (Edge::Supported, 0.0)] {
        let surface = round(edge, tension, 0.5e-3);
        let modes = Modes::solve(&surface, 3000.0, 1e-6).unwrap();
        let count = modes.poles().len();
        let around = 128;
        let density = Medium::of(&surface.sheet).areal_density;
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for (t, w) in gauss(60) {
            let r = 0.5 * (1.0 + t) * RADIUS;
            for i in 0..around {
                let angle = TAU * f64::from(i) / f64::from(around);
                points.push(Point::new(RADIUS + r * angle.cos(), RADIUS + r * angle.sin()));
                weights.push(density * 0.5 * w * RADIUS * r * TAU / f64::from(around));
            }
        }
        let shapes = modes.at_all(&points);
        for m in 0..count {
            for n in 0..count {
                let mass: f64 = (0..points.len()).map(|p| weights[p] * shapes[(p, m)] * shapes[(p, n)]).sum();
                let exact = f64::from(u8::from(m == n));
                assert!((mass - exact).abs() < 1e-10, "{edge:?} {m} {n}: {mass}");
            }
        }
    }
}

/// Compares what each frequency's modes carry from one point to others, which does not depend on how modes of equal frequency are combined.
#[test]
fn shapes_are_those_of_a_mesh() {
    for (edge, tension) in
        [(Edge::Free, 0.0), (Edge::Clamped, 200.0), (Edge::Elastic { lift: 1e4, tilt: 1.0 }, 0.0)]
    {
        let surface = round(edge, tension, 0.5e-3);
        let points: Vec<Point> =
            [(0.07, 0.07), (0.09, 0.03), (0.1, 0.1), (0.01, 0.07), (0.07, 0.139), (0.05, 0.06)]
                .map(|(x, y)| Point::new(x, y))
                .into();
        let [disc, mesh] =
            [surface.clone(), meshed(surface)].map(|surface| Modes::solve(&surface, 1500.0, 1e-6).unwrap());
        let [a, b] = [&disc, &mesh].map(|modes| modes.at_all(&points));
        let hz = disc.frequencies_hz();
        assert_eq!(hz.len(), mesh.frequencies_hz().len());
        let (shares, others) = (disc.bending_shares(), mesh.bending_shares());
        let largest = a.col_iter().flat_map(|c| c.iter()).fold(0.0_f64, |most, w| most.max(w * w));
        let mut first = 0;
        for cluster in hz.chunk_by(|a, b| b - a <= 1e-4 * b) {
            let range = first..first + cluster.len();
            first = range.end;
            for p in 0..points.len() {
                let carried = |shapes: &unripple_linalg::Mat<f64>| -> f64 {
                    range
                        .clone()
                        .map(|m| shapes[(0, m)] * shapes[(p, m)] + shapes[(1, m)] * shapes[(p, m)])
                        .sum()
                };
                assert!(
                    (carried(&a) - carried(&b)).abs() < 1e-5 * largest,
                    "{edge:?} {cluster:?} at {:?}",
                    points[p]
                );
            }
            range.for_each(|m| assert!((shares[m] - others[m]).abs() < 1e-4, "{} {}", shares[m], others[m]));
        }
    }
}

#[test]
fn many_points_read_as_each_alone_and_those_outside_as_the_nearest() {
    let modes = Modes::solve(&round(Edge::Free, 0.0, 1e-3), 6e3, 1e-6).unwrap();
    let mut random = Random::seeded(3);
    let mut points: Vec<Point> =
        (0..300).map(|_| Point::new(random.between(0.0, 0.14), random.between(0.0, 0.14))).collect();
    points.push(Point::new(RADIUS, RADIUS));
    let all = modes.at_all(&points);
    let mut row = vec![0.0; modes.poles().len()];
    for (p, point) in points.iter().enumerate() {
        let (x, y) = (point.x - RADIUS, point.y - RADIUS);
        let shrink = (RADIUS / x.hypot(y)).min(1.0);
        modes.at(Point::new(RADIUS + shrink * x, RADIUS + shrink * y), &mut row);
        row.iter().zip(all.row(p).iter()).for_each(|(a, b)| assert!((a - b).abs() < 1e-9, "{point:?}"));
    }
}

#[test]
fn a_circle_too_large_is_refused_beforehand_with_its_size() {
    let error = Modes::solve(&round(Edge::Clamped, 200.0, 0.125e-3), 4e6, 1e-3).unwrap_err();
    let PhysicsError::TooLarge { needed_gib, limit_gib, nearest_hz, .. } = error else { panic!("{error}") };
    assert!(needed_gib > limit_gib && (1e5..4e6).contains(&nearest_hz), "{needed_gib} {nearest_hz}");
}
