//! Exact frequencies of round sheets, from Bessel functions.
#![allow(dead_code)]

use std::f64::consts::TAU;
use unripple_core::{Edge, Sheet};
use unripple_plates::Medium;

/// J_n(x) for n = 0 … `most`, by downward recurrence normalised with J_0 + 2ΣJ_2k = 1.
pub fn j(most: usize, x: f64) -> Vec<f64> {
    downward(most, x, -1.0)
}

/// e^{-x} I_n(x) for n = 0 … `most`, by downward recurrence normalised with I_0 + 2ΣI_k = e^x.
pub fn i(most: usize, x: f64) -> Vec<f64> {
    downward(most, x, 1.0)
}

fn downward(most: usize, x: f64, sign: f64) -> Vec<f64> {
    let start = 2 * ((most.max(x as usize) + 40) / 2 + 10);
    let (mut above, mut here) = (0.0, 1e-290);
    let (mut values, mut sum) = (vec![0.0; most + 1], 0.0);
    for n in (0..=start).rev() {
        if n <= most {
            values[n] = here;
        }
        let counted = sign > 0.0 || n % 2 == 0;
        sum += if n == 0 {
            here
        } else if counted {
            2.0 * here
        } else {
            0.0
        };
        // f_{n-1} = (2n/x) f_n ∓ f_{n+1}.
        (here, above) = (2.0 * n as f64 / x * here + sign * above, here);
        if here.abs() > 1e200 {
            (here, above, sum) = (here * 1e-200, above * 1e-200, sum * 1e-200);
            values.iter_mut().for_each(|v| *v *= 1e-200);
        }
    }
    values.iter().map(|v| v / sum).collect()
}

/// Value, first to third derivative (by the argument) of a Bessel function of order n, from the values of orders n and
/// n + 1: x²f'' + xf' ± (x² ∓ n²)f = 0, `sign` -1 for J, 1 for I.
fn derivatives(f: &[f64], n: usize, x: f64, sign: f64) -> [f64; 4] {
    let m = n as f64;
    let (f0, next) = (f[n], f[n + 1]);
    let f1 = m / x * f0 + sign * next;
    let q = |x: f64| sign + m * m / (x * x);
    let f2 = q(x) * f0 - f1 / x;
    let f3 = q(x) * f1 - 2.0 * m * m / x.powi(3) * f0 - f2 / x + f1 / (x * x);
    [f0, f1, f2, f3]
}

/// Steps in which roots are looked for, far shorter than their distance.
const STEPS: usize = 3000;

/// All frequencies of a round sheet of some radius below `max_hz`, in Hz, ascending; each with n > 0 nodal diameters
/// twice. Rigid modes are left out.
pub fn frequencies(sheet: &Sheet, radius: f64, edge: Edge, max_hz: f64) -> Vec<f64> {
    let mut all = Vec::new();
    for n in 0.. {
        let found = of_order(sheet, radius, edge, n, max_hz);
        if found.is_empty() && n > 2 {
            break;
        }
        let times = if n == 0 { 1 } else { 2 };
        all.extend(found.iter().flat_map(|hz| std::iter::repeat_n(*hz, times)));
    }
    all.sort_by(f64::total_cmp);
    all
}

/// The frequencies with n nodal diameters below `max_hz`, in Hz, ascending, each once.
pub fn of_order(sheet: &Sheet, radius: f64, edge: Edge, n: usize, max_hz: f64) -> Vec<f64> {
    let top = TAU * max_hz;
    // Not from 0, where the determinant is that of a rigid motion.
    let ends = [1e-3 * top / STEPS as f64, top];
    let found = roots(|omega| determinant(sheet, radius, edge, n, omega), ends, STEPS);
    found.iter().map(|omega| omega / TAU).collect()
}

/// What vanishes at a frequency of n nodal diameters: conditions at the rim of J_n(αr) and I_n(βr), scaled.
fn determinant(sheet: &Sheet, a: f64, edge: Edge, n: usize, omega: f64) -> f64 {
    let m = Medium::of(sheet);
    let (t, d, nu) = (m.tension, m.bending_stiffness, sheet.poisson);
    let root = (t * t + 4.0 * d * m.areal_density * omega * omega).sqrt();
    let (alpha, beta) =
        ((2.0 * m.areal_density * omega * omega / (t + root)).sqrt(), ((t + root) / (2.0 * d)).sqrt());
    let mm = (n * n) as f64;
    let conditions = |f: [f64; 4], k: f64| {
        let (u, u1, u2, u3) = (f[0], k * f[1], k * k * f[2], k.powi(3) * f[3]);
        let moment = u2 + nu * (u1 / a - mm * u / (a * a));
        // ∂_r∇²u + (1-ν)/r² ∂_θθ(u_r - u/r), the rim's force over -D, with the tension's share.
        let laplacian = u3 + u2 / a - u1 / (a * a) - mm * (u1 / (a * a) - 2.0 * u / a.powi(3));
        let force = laplacian - (1.0 - nu) * mm / (a * a) * (u1 - u / a) - t / d * u1;
        match edge {
            Edge::Clamped => [u, u1],
            Edge::Supported => [u, moment],
            _ => [moment, force],
        }
    };
    let [p, q] = conditions(derivatives(&j(n + 1, alpha * a), n, alpha * a, -1.0), alpha);
    let [r, s] = conditions(derivatives(&i(n + 1, beta * a), n, beta * a, 1.0), beta);
    let size = r.hypot(s);
    (p * s - q * r) / size
}

/// Roots between two places of a function that changes sign at each, by bisection between as many steps as are given.
pub fn roots(f: impl Fn(f64) -> f64, [from, to]: [f64; 2], steps: usize) -> Vec<f64> {
    let place = |i: usize| from + (to - from) * i as f64 / steps as f64;
    let mut found = Vec::new();
    let mut before = f(from);
    for i in 1..=steps {
        let after = f(place(i));
        if before * after < 0.0 {
            let (mut low, mut high) = (place(i - 1), place(i));
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if f(middle) * before < 0.0 { high = middle } else { low = middle }
            }
            found.push(0.5 * (low + high));
        }
        before = after;
    }
    found
}
