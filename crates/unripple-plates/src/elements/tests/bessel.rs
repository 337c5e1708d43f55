//! Round plates and membranes in closed form: roots of determinants of J_n and I_n.

use std::f64::consts::PI;

/// How a round plate of radius 1 is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rim {
    Clamped,
    Supported,
    Free,
    Membrane,
}

/// (1/π) ∫ f over [0, π] of a function even and periodic there, spectrally by the trapezoidal rule.
fn mean(f: impl Fn(f64) -> f64) -> f64 {
    let count = 128;
    let inner: f64 = (1..count).map(|i| f(PI * f64::from(i) / f64::from(count))).sum();
    (inner + 0.5 * (f(0.0) + f(PI))) / f64::from(count)
}

pub(super) fn j(n: u32, x: f64) -> f64 {
    mean(|a| (f64::from(n) * a - x * a.sin()).cos())
}

fn j_slope(n: u32, x: f64) -> f64 {
    mean(|a| a.sin() * (f64::from(n) * a - x * a.sin()).sin())
}

/// e^-x I_n(x).
fn i(n: u32, x: f64) -> f64 {
    mean(|a| (x * (a.cos() - 1.0)).exp() * (f64::from(n) * a).cos())
}

fn i_slope(n: u32, x: f64) -> f64 {
    mean(|a| a.cos() * (x * (a.cos() - 1.0)).exp() * (f64::from(n) * a).cos())
}

/// What vanishes at the rim: two rows of a function w with ∇²w = s w, of its value and slope at r = 1.
fn rows(rim: Rim, n: u32, s: f64, poisson: f64, tension: f64, [w, slope]: [f64; 2]) -> [f64; 2] {
    let n2 = f64::from(n * n);
    // Moment ∇²w - (1 - ν)(w' - n² w), and shear (∇²w)' - (1 - ν) n² (w' - w), less what tension carries.
    let moment = s * w - (1.0 - poisson) * (slope - n2 * w);
    match rim {
        Rim::Clamped => [w, slope],
        Rim::Supported => [w, moment],
        Rim::Free => [moment, s * slope - (1.0 - poisson) * n2 * (slope - w) - tension * slope],
        Rim::Membrane => [w, 0.0],
    }
}

fn determinant(rim: Rim, n: u32, k: f64, poisson: f64, tension: f64) -> f64 {
    if rim == Rim::Membrane {
        return j(n, k);
    }
    let g = (k * k + tension).sqrt();
    let [a, c] = rows(rim, n, -k * k, poisson, tension, [j(n, k), k * j_slope(n, k)]);
    let [b, d] = rows(rim, n, g * g, poisson, tension, [i(n, g), g * i_slope(n, g)]);
    a * d - b * c
}

/// All ω below a wavenumber, ascending and as often as they occur, of radius 1, unit mass per area and D = 1 with a
/// tension, or of a membrane of unit tension. Rigid modes are left out.
pub(super) fn omegas(rim: Rim, poisson: f64, tension: f64, k_top: f64) -> Vec<f64> {
    let mut all = Vec::new();
    for n in 0..(k_top as u32 + 4) {
        let f = |k: f64| determinant(rim, n, k, poisson, tension);
        let step = 0.1;
        // No root of any of them lies below n.
        let mut low = f64::max(0.6, 0.95 * f64::from(n));
        while low < k_top {
            let (mut a, mut b) = (low, low + step);
            if (f(a) < 0.0) != (f(b) < 0.0) {
                for _ in 0..50 {
                    let middle = 0.5 * (a + b);
                    if (f(a) < 0.0) == (f(middle) < 0.0) {
                        a = middle;
                    } else {
                        b = middle;
                    }
                }
                let k = 0.5 * (a + b);
                let omega = if rim == Rim::Membrane { k } else { k * (k * k + tension).sqrt() };
                all.extend(std::iter::repeat_n(omega, if n == 0 { 1 } else { 2 }));
            }
            low += step;
        }
    }
    all.sort_by(f64::total_cmp);
    all
}
