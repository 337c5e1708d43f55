//! Sectors of a circle with supported straight edges: products of Bessel functions of fractional order and sines of the angle.

use super::bessel::{Jet, series};
use crate::round_common::roots;
use std::f64::consts::PI;

/// Number of places at which a determinant is looked at for each unit of the largest wavenumber times the radius: zeros lie about π
/// apart.
const PLACES: f64 = 40.0;

/// All wavenumbers up to `k_top` of a membrane fixed along a sector of some angle (rad) and unit radius, ascending.
pub fn membrane(angle: f64, k_top: f64) -> Vec<f64> {
    all(angle, k_top, |order, k| series(order, k, 1.0, -1.0)[0])
}

/// All wavenumbers (ρ_s ω² = D k⁴) up to `k_top` of a plate of unit radius, supported along the straight edges of a sector of some angle
/// (rad) and clamped along the arc, ascending.
///
/// Deflections of finite bending energy vary at the corner as r to a power above 1: of J_ν, J_-ν, I_ν and I_-ν with ν = nπ/angle below 1
/// only their differences I_ν - J_ν and I_-ν - J_-ν, above 1 J_ν and I_ν.
pub fn plate(angle: f64, k_top: f64) -> Vec<f64> {
    all(angle, k_top, |order, k| {
        let [a, b] = if order < 1.0 {
            [difference(order, k), difference(-order, k)]
        } else {
            [series(order, k, 1.0, -1.0), series(order, k, 1.0, 1.0)]
        };
        let size = |f: Jet| f[0].hypot(f[1] / k);
        (a[0] * b[1] - a[1] * b[0]) / (k * size(a) * size(b))
    })
}

fn difference(order: f64, k: f64) -> Jet {
    let [i, j] = [1.0, -1.0].map(|sign| series(order, k, 1.0, sign));
    std::array::from_fn(|n| i[n] - j[n])
}

/// The zeros of a function of order and wavenumber for all orders nπ/angle.
fn all(angle: f64, k_top: f64, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let mut found = Vec::new();
    for n in 1.. {
        let order = f64::from(n) * PI / angle;
        let of_order = roots(|k| f(order, k), [0.5, k_top], (PLACES * k_top) as usize);
        // No wavenumber lies below its order.
        if of_order.is_empty() && order > k_top {
            break;
        }
        found.extend(of_order);
    }
    found.sort_by(f64::total_cmp);
    found
}
