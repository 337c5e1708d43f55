//! Curved rims against closed forms, and the rates at which they are approached.

use super::bessel::{self, Rim};
use super::meshes;
use super::solve::{fabric, omegas};
use crate::elements::Space;
use crate::mesh::Mesh;
use std::f64::consts::PI;
use unripple_core::{Edge, Point, Side};

fn edge(rim: Rim) -> Edge {
    match rim {
        Rim::Clamped | Rim::Membrane => Edge::Clamped,
        Rim::Supported => Edge::Supported,
        Rim::Free => Edge::Free,
    }
}

/// Relative errors of the frequencies of a circle below a wavenumber.
fn errors(rim: Rim, tension: f64, rings: usize, k_top: f64) -> Vec<f64> {
    let (d, t) = if rim == Rim::Membrane { (0.0, 1.0) } else { (1.0, tension) };
    let space = Space::new(&meshes::circle(1.0, rings, edge(rim)), d > 0.0);
    let exact = bessel::omegas(rim, 0.3, tension, k_top);
    let rigid = match rim {
        Rim::Free if tension > 0.0 => 1,
        Rim::Free => 3,
        _ => 0,
    };
    let found = omegas(&space, &fabric(d, t, 0.3), 1.0, exact.len() + rigid);
    exact.iter().zip(&found[rigid..]).map(|(e, f)| f / e - 1.0).collect()
}

#[test]
fn determinants_agree_with_published_numbers() {
    // Leissa, *Vibration of Plates*, 1969, tables 2.1, 2.2 and 2.6; the zeros of J.
    let cases: [(Rim, f64, &[f64]); 4] = [
        (Rim::Clamped, 0.3, &[10.2158, 21.26, 21.26, 34.88, 34.88, 39.771]),
        (Rim::Supported, 0.3, &[4.9351, 13.898, 13.898, 25.613, 25.613, 29.720]),
        (Rim::Free, 0.33, &[5.2620, 5.2620, 9.0689, 12.2440, 12.2440]),
        (Rim::Membrane, 0.0, &[2.404826, 3.831706, 3.831706, 5.135622]),
    ];
    for (rim, poisson, published) in cases {
        let found = bessel::omegas(rim, poisson, 0.0, 7.0);
        for (f, p) in found.iter().zip(published) {
            assert!((f / p - 1.0).abs() < 1e-3, "{rim:?} {f} {p}");
        }
    }
}

#[test]
fn circles_converge_at_their_rates() {
    let cases = [
        (Rim::Membrane, 0.0, 9.0, 1e-7),
        (Rim::Clamped, 0.0, 7.5, 2e-6),
        (Rim::Supported, 0.0, 7.5, 1e-6),
        (Rim::Free, 0.0, 7.5, 1e-6),
        (Rim::Clamped, 10.0, 7.0, 3e-6),
        (Rim::Free, 10.0, 7.0, 3e-6),
    ];
    for (rim, tension, rate, most) in cases {
        let worst = |rings| errors(rim, tension, rings, 6.5).into_iter().map(f64::abs).fold(0.0, f64::max);
        let (coarse, fine) = (worst(3), worst(5));
        let found = (coarse / fine).ln() / (5.0f64 / 3.0).ln();
        assert!(found > rate && fine < most, "{rim:?} {tension}: rate {found}, {coarse:e} {fine:e}");
    }
}

#[test]
fn held_curves_give_frequencies_from_above() {
    // What quintics alone miss of a held curve makes frequencies too low by 1e-3 here.
    for rim in [Rim::Membrane, Rim::Clamped, Rim::Supported] {
        let least = errors(rim, 0.0, 3, 9.0).into_iter().fold(1.0, f64::min);
        assert!(least > -1e-9, "{rim:?} {least:e}");
    }
}

/// ω of modes and the number of their diameters.
type Modes = [(f64, usize); 4];

/// Relative errors of the first modes of a ring of radii 0.5 and 1, each mode of several diameters counted once.
fn ring_errors(held: [Edge; 2], d: f64, t: f64, cells: [usize; 2], exact: &[(f64, usize)]) -> f64 {
    let mesh: Mesh = meshes::ring([0.5, 1.0], cells[0], cells[1], held);
    let found = omegas(&Space::new(&mesh, d > 0.0), &fabric(d, t, 0.3), 0.0, 2 * exact.len());
    let all = exact.iter().flat_map(|(e, n)| std::iter::repeat_n(*e, if *n == 0 { 1 } else { 2 }));
    all.zip(found).map(|(e, f)| (f / e - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn rims_of_holes_bend_inwards() {
    use Edge::{Clamped, Free, Supported};
    // Roots of the determinants in J, Y, I and K, outer and inner rim, Poisson's ratio 0.3; with the numbers of diameters.
    let plates: [(&str, [Edge; 2], f64, Modes); 6] = [
        (
            "cc",
            [Clamped, Clamped],
            0.0,
            [(89.25075097, 0), (90.23026851, 1), (93.32120047, 2), (98.9279905, 3)],
        ),
        (
            "cf",
            [Clamped, Free],
            0.0,
            [(17.71451434, 0), (22.01457502, 1), (32.11553446, 2), (45.81222974, 3)],
        ),
        ("ss", [Supported; 2], 0.0, [(40.04313067, 0), (41.79732766, 1), (47.08872376, 2), (55.95658623, 3)]),
        (
            "sc",
            [Supported, Clamped],
            0.0,
            [(59.81994826, 0), (60.98703173, 1), (64.63133252, 2), (71.10654249, 3)],
        ),
        ("fs", [Free, Supported], 0.0, [(4.12095899, 0), (4.86159669, 1), (7.98609128, 2), (14.03477765, 3)]),
        (
            "cs",
            [Clamped, Supported],
            50.0,
            [(79.57816314, 0), (81.38177805, 1), (86.81195128, 2), (95.90408592, 3)],
        ),
    ];
    for (name, held, tension, exact) in plates {
        let coarse = ring_errors(held, 1.0, tension, [2, 16], &exact);
        let fine = ring_errors(held, 1.0, tension, [3, 24], &exact);
        assert!(fine < 2e-4 && coarse / fine > 1.5f64.powf(6.0), "{name} {coarse:e} {fine:e}");
    }
    let membrane = [(6.246061839, 0), (6.393156762, 1), (6.813842853, 2), (7.457740136, 3)];
    let coarse = ring_errors([Clamped; 2], 0.0, 1.0, [2, 16], &membrane);
    let fine = ring_errors([Clamped; 2], 0.0, 1.0, [3, 24], &membrane);
    assert!(fine < 1e-7 && coarse / fine > 1.5f64.powf(7.5), "{coarse:e} {fine:e}");
}

#[test]
fn a_stadium_agrees_with_itself_refined() {
    // Its curvature jumps where straights meet ends: were H continuous there, slopes would be held at four points.
    for (held, bending) in [(Edge::Supported, 1.0), (Edge::Clamped, 1.0), (Edge::Clamped, 0.0)] {
        let sheet = fabric(bending, 1.0, 0.3);
        let of =
            |rings| omegas(&Space::new(&meshes::stadium(1.0, rings, held), bending > 0.0), &sheet, 0.0, 8);
        let [coarse, middle, fine] = [2, 3, 5].map(of);
        let worst =
            |found: &[f64]| found.iter().zip(&fine).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max);
        let (coarse, middle) = (worst(&coarse), worst(&middle));
        assert!(middle < 1e-4 && coarse > 3.0 * middle, "{held:?} {bending}: {coarse:e} {middle:e}");
    }
}

#[test]
fn a_kink_of_rounded_coordinates_holds_no_slope() {
    let sheet = fabric(0.0, 1.0, 0.3);
    // The left half's arc has its centre moved to the right by the kink.
    let of = |kink: f64| {
        let mut mesh = meshes::circle(1.0, 3, Edge::Clamped);
        let arc = |x: f64, start: f64, sweep: f64| Side::Arc {
            centre: Point::new(1.0 + x, 1.0),
            radius: 1f64.hypot(x),
            start,
            sweep,
        };
        let left = arc(kink, PI / 2.0 + kink.atan(), PI - 2.0 * kink.atan());
        mesh.sides = vec![(arc(0.0, -PI / 2.0, PI), Edge::Clamped), (left, Edge::Clamped)];
        for edge in &mut mesh.edges {
            let Some(span) = edge.span.as_mut() else { continue };
            let side = usize::from(span.from > 0.49);
            let part = |t: f64| 2.0 * t - side as f64;
            *span = crate::mesh::Span { side, from: part(span.from), to: part(span.to) };
            mesh.vertices[edge.ends[0]].at = mesh.sides[side].0.at(span.from);
        }
        omegas(&Space::new(&mesh, false), &sheet, 0.0, 1)[0]
    };
    let (plain, kinked) = (of(0.0), of(1e-5));
    assert!((plain / 2.404825557695773 - 1.0).abs() < 1e-9 && (kinked / plain - 1.0).abs() < 1e-5);
}
