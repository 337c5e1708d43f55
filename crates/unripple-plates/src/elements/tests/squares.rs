//! Squares against closed forms and published numbers.

use super::meshes::{rectangle, turned};
use super::solve::{fabric, omegas, surface};
use crate::elements::Space;
use crate::fabric::Fabric;
use std::f64::consts::PI;
use unripple_core::{Edge, Grain, Point, Scatterer, ScattererKind};

const ELASTIC: fn(f64, f64) -> Edge = |lift, tilt| Edge::Elastic { lift, tilt };

fn square(cells: usize, held: Edge, d: f64, t: f64, count: usize) -> Vec<f64> {
    let mesh = rectangle([1.0; 2], [cells; 2], 0.15, [held; 4]);
    omegas(&Space::new(&mesh, d > 0.0), &fabric(d, t, 0.3), 0.0, count)
}

/// ω of a supported unit square from a function of the wavenumbers squared along x and y.
fn supported(count: usize, square: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let k = |m: usize| (PI * m as f64).powi(2);
    let pairs = (1..20).flat_map(|m| (1..20).map(move |n| (m, n)));
    let mut all: Vec<f64> = pairs.map(|(m, n)| square(k(m), k(n)).sqrt()).collect();
    all.sort_by(f64::total_cmp);
    all.truncate(count);
    all
}

fn worst(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn supported_squares_converge_at_the_eighth_power() {
    for tension in [0.0, 100.0] {
        let exact = supported(10, |a, b| (a + b) * (a + b + tension));
        let of = |cells| worst(&square(cells, Edge::Supported, 1.0, tension, 10), &exact);
        let (coarse, fine) = (of(4), of(8));
        assert!(fine < 1e-5 && coarse / fine > 2f64.powf(7.5), "{tension}: {coarse:e} {fine:e}");
    }
}

#[test]
fn membranes_converge_at_the_tenth_power() {
    let exact = supported(10, |a, b| a + b);
    let of = |cells| worst(&square(cells, Edge::Clamped, 0.0, 1.0, 10), &exact);
    let (coarse, fine) = (of(4), of(8));
    assert!(fine < 2e-7 && coarse / fine > 2f64.powf(9.3), "{coarse:e} {fine:e}");
}

#[test]
fn a_clamped_square_has_its_published_frequencies() {
    let exact = [35.98519, 73.39385, 73.39385, 108.21650, 131.58077, 132.20479];
    let of = |cells| worst(&square(cells, Edge::Clamped, 1.0, 0.0, 6), &exact);
    let (coarse, fine) = (of(6), of(12));
    assert!(fine < 5e-6 && coarse / fine > 2f64.powf(6.8), "{coarse:e} {fine:e}");
}

#[test]
fn hard_springs_hold_and_soft_ones_move() {
    let of = |held| square(4, held, 1.0, 3.0, 6);
    let near = |a: &[f64], b: &[f64]| worst(a, b) < 1e-5;
    assert!(near(&of(ELASTIC(1e10, 0.0)), &of(Edge::Supported)));
    assert!(near(&of(ELASTIC(1e12, 1e8)), &of(Edge::Clamped)));
    // A membrane on springs all round: k tan(ka/2) = lift/T along each side.
    let (lift, tension) = (3.0, 2.0);
    let root = |low: f64, high: f64| {
        let f = |k: f64| k * (0.5 * k).sin() - lift / tension * (0.5 * k).cos();
        let (mut a, mut b) = (low, high);
        for _ in 0..80 {
            let middle = 0.5 * (a + b);
            if (f(a) < 0.0) == (f(middle) < 0.0) { a = middle } else { b = middle }
        }
        0.5 * (a + b)
    };
    let k = root(0.0, PI);
    let found = square(5, ELASTIC(lift, 0.0), 0.0, tension, 1)[0];
    assert!((found / (tension * 2.0 * k * k).sqrt() - 1.0).abs() < 1e-9);
}

#[test]
fn an_orthotropic_square_has_its_exact_frequencies() {
    let mut sheet = surface(1.0, 1.0, 5.0, 0.3);
    let young = sheet.sheet.young;
    let (across, shear) = (0.4 * young, 0.25 * young);
    // Of a sheet with D = 1: E h³/12 = 1 - ν².
    let unit = 0.91 / (1.0 - 0.09 * 0.4);
    let (d11, d12, d22, d66) = (unit, 0.3 * 0.4 * unit, 0.4 * unit, 0.25 * 0.91);
    let exact =
        supported(8, |a, b| d11 * a * a + 2.0 * (d12 + 2.0 * d66) * a * b + d22 * b * b + 5.0 * (a + b));
    let mesh = rectangle([1.0; 2], [8; 2], 0.1, [Edge::Supported; 4]);
    let mut of = |direction: f64, mesh| {
        sheet.sheet.uneven.grain = Some(Grain { direction, young_across: across, shear });
        omegas(&Space::new(mesh, true), &Fabric::of(&sheet).unwrap(), 0.0, 8)
    };
    assert!(worst(&of(0.0, &mesh), &exact) < 1e-5);
    assert!(worst(&of(PI / 2.0, &mesh), &exact) < 1e-5);
    // Mesh and grain turned together.
    assert!(worst(&of(0.7, &turned(&mesh, 0.7)), &of(0.0, &mesh)) < 1e-9);
}

#[test]
fn a_point_mass_shifts_a_supported_square_as_the_sum_over_its_modes_says() {
    let (at, mass) = (Point::new(0.4, 0.3), 0.2);
    let mut terms = Vec::new();
    for m in 1..1500 {
        for n in 1..1500 {
            let (m, n) = (f64::from(m) * PI, f64::from(n) * PI);
            let shape = 2.0 * (m * at.x).sin() * (n * at.y).sin();
            terms.push((shape * shape, (m * m + n * n).powi(2)));
        }
    }
    // 1 = m ω² Σ φ²/(ω_n² - ω²), below the first mode of the bare square.
    let sum = |square: f64| mass * square * terms.iter().map(|(p, s)| p / (s - square)).sum::<f64>();
    let (mut low, mut high) = (0.0, terms[0].1);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if sum(middle) < 1.0 { low = middle } else { high = middle }
    }
    let mut sheet = surface(1.0, 1.0, 0.0, 0.3);
    sheet.sheet.uneven.scatterers = vec![Scatterer { at, kind: ScattererKind::Mass(mass) }];
    let fabric = Fabric::of(&sheet).unwrap();
    let of = |cells| {
        let mesh = rectangle([1.0; 2], [cells; 2], 0.0, [Edge::Supported; 4]);
        omegas(&Space::new(&mesh, true), &fabric, 0.0, 1)[0] / low.sqrt() - 1.0
    };
    // The shape's r² ln r at the mass is met only as h².
    let (coarse, fine) = (of(5), of(10));
    assert!(fine > -1e-7 && fine < 1e-4 && coarse > 3.0 * fine, "{coarse:e} {fine:e}");
}
