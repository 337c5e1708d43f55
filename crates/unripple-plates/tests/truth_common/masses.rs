//! A supported rectangle with a mass at a point: the sum over the modes of the bare plate.

use std::f64::consts::PI;

/// Half waves along each side up to which the static compliance is summed; those beyond add as in [`Compliance::of`].
const FAR: usize = 3000;
/// Half waves along each side up to which the rest is summed, whose terms fall as the eighth power of the wavenumber.
const NEAR: usize = 160;

/// ω² below `top` of a plate of sides (m), ρ_s ω² = D k⁴, with a mass at a place. `unit` is D/ρ_s (m⁴/s²), `mass` the mass over that of the
/// sheet; no two modes of the bare plate may have the same frequency, and none a node at the place.
pub fn squares(sides: [f64; 2], at: [f64; 2], unit: f64, mass: f64, top: f64) -> Vec<f64> {
    let along = |m: usize, axis: usize| m as f64 * PI / sides[axis];
    let shape =
        |m: usize, n: usize| 4.0 * ((along(m, 0) * at[0]).sin() * (along(n, 1) * at[1]).sin()).powi(2);
    let square = |m: usize, n: usize| unit * (along(m, 0).powi(2) + along(n, 1).powi(2)).powi(2);
    let pairs = |most: usize| (1..=most).flat_map(move |m| (1..=most).map(move |n| (m, n)));
    let terms: Vec<(f64, f64)> = pairs(NEAR).map(|(m, n)| (shape(m, n), square(m, n))).collect();
    let still = compliance(sides, shape, square, unit);
    // 1 = μ s Σ φ²/(s_n - s), with Σ φ²/s_n summed apart.
    let f = |s: f64| {
        let rest: f64 = terms.iter().map(|(p, q)| p * s / (q * (q - s))).sum();
        mass * s * (still + rest) - 1.0
    };
    let mut poles: Vec<f64> = terms.iter().map(|(_, q)| *q).filter(|q| *q < 2.0 * top).collect();
    poles.sort_by(f64::total_cmp);
    let mut found = Vec::new();
    let mut from = 0.0;
    for to in poles {
        let (mut low, mut high) = (from, to);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if f(middle) < 0.0 { low = middle } else { high = middle }
        }
        found.push(0.5 * (low + high));
        from = to;
    }
    found.retain(|s| *s < top);
    found
}

/// Σ φ²/s_n: the sum within an ellipse of wavenumbers, and an integral for those beyond, where φ² is 1 on average.
fn compliance(
    [a, b]: [f64; 2],
    shape: impl Fn(usize, usize) -> f64,
    square: impl Fn(usize, usize) -> f64,
    unit: f64,
) -> f64 {
    let far = FAR as f64 * PI / a.max(b);
    let mut sum = 0.0;
    for m in 1..=FAR {
        for n in 1..=FAR {
            let s = square(m, n);
            if s > unit * far.powi(4) {
                break;
            }
            sum += shape(m, n) / s;
        }
    }
    // A quarter of the plane of wavenumbers, a b/π² modes per area.
    sum + a * b / (PI * PI) * 0.25 * PI / (unit * far * far)
}
