//! The part of a sheet's static response to a load at wavenumbers above those of the computed modes, taken
//! from an infinite sheet.

use crate::Medium;
use std::f64::consts::TAU;
use unripple_dsp::bessel_j;
use unripple_plates::gauss;

/// Largest distance from a load at which its deflection is tabulated, in 1/K; beyond, the deflection is
/// taken as zero. With twice this value, tables are twice as long for values that are smaller still.
const REACH: f64 = 25.0;
/// Step of the table, in 1/K: 126 steps for each wavelength, with cubic interpolation between them. With
/// twice this value, the interpolation error is 16 times as large.
const STEP: f64 = 0.05;

/// The part of an infinite sheet's static response to loads at wavenumbers above K.
#[derive(Debug)]
pub(super) struct Remainder {
    /// Mass, tension and stiffness of the infinite sheet.
    pub medium: Medium,
    /// The wavenumber K, in rad/m.
    pub above: f64,
    /// Least radius of a contact (m): the sheet's thickness, below which plate theory does not hold.
    pub finest: f64,
    /// Nodes (wavenumbers above K, in rad/m) and weights for the numerical integral.
    nodes: Vec<(f64, f64)>,
}

/// Table of deflection per force (m/N) against distance from a contact of uniform pressure.
#[derive(Debug)]
pub(super) struct Profile {
    step: f64,
    values: Vec<f64>,
}

impl Remainder {
    /// Prepares the integral over wavenumbers above `above` (rad/m), for contacts with a radius of at least
    /// `finest` (m).
    pub fn new(medium: Medium, above: f64, finest: f64) -> Self {
        let bent = if medium.bending_stiffness > 0.0 {
            (medium.tension / medium.bending_stiffness).sqrt()
        } else {
            f64::INFINITY
        };
        // Beyond this wavenumber a thousandth is left: the sheet is stiff by bending, or contacts average the waves away.
        let last = (30.0 * above.max(bent.min(1.0 / finest))).min(1e4 * above);
        let rule = gauss(4);
        let mut nodes = Vec::new();
        let mut k = above;
        while k < last {
            let width = (0.1 * above).max(0.04 * k);
            nodes.extend(rule.iter().map(|(x, w)| (k + 0.5 * width * (1.0 + x), 0.5 * width * w)));
            k += width;
        }
        Self { medium, above, finest, nodes }
    }

    /// The sum Σ φ φ'/ω^{2·power} over the modes above K for two uniform contacts with given radii (m) at a
    /// given distance (m): (1/2π) ∫_K^∞ J_0(k·distance) B(k·radius) B(k·radius') / (ρ_s ω^{2·power}) k dk,
    /// with B(x) = 2J_1(x)/x and ρ_s ω² = Rk² + Dk⁴.
    pub fn sum(&self, distance: f64, radii: [f64; 2], power: i32) -> f64 {
        let density = self.medium.areal_density;
        let term = |(k, weight): &(f64, f64)| {
            let square = self.medium.stiffness(*k) / density;
            let contacts = even(k * radii[0]) * even(k * radii[1]);
            weight * k * bessel_j(0, k * distance) * contacts / (density * square.powi(power))
        };
        self.nodes.iter().map(term).sum::<f64>() / TAU
    }

    /// Table of the deflection per force (m/N) caused by a uniform contact with a given radius (m), against
    /// distance.
    pub fn profile(&self, radius: f64) -> Profile {
        let weights: Vec<(f64, f64)> = self
            .nodes
            .iter()
            .map(|(k, weight)| (*k, weight * k * even(k * radius) / (TAU * self.medium.stiffness(*k))))
            .collect();
        let step = STEP / self.above;
        let at = |i: usize| weights.iter().map(|(k, w)| w * bessel_j(0, k * step * i as f64)).sum();
        Profile { step, values: (0..=(REACH / STEP) as usize).map(at).collect() }
    }
}

impl Profile {
    /// The deflection at a distance (m), in m/N, by cubic interpolation.
    pub fn at(&self, distance: f64) -> f64 {
        let x = distance / self.step;
        if x.is_nan() || x >= (self.values.len() + 2) as f64 {
            return 0.0;
        }
        let cell = x.floor();
        let t = x - cell;
        let value = |offset: i64| {
            let i = (cell as i64 + offset).unsigned_abs() as usize;
            self.values.get(i).copied().unwrap_or(0.0)
        };
        let [a, b, c, d] = [-1, 0, 1, 2].map(value);
        b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
    }
}

/// Average of a wave over a uniform disc: 2J_1(x)/x, x = k·radius.
fn even(x: f64) -> f64 {
    // For small x it is 1 within 1e-9.
    if x < 1e-4 { 1.0 } else { 2.0 * bessel_j(1, x) / x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn film() -> Medium {
        Medium { areal_density: 0.175, tension: 200.0, bending_stiffness: 7.154e-4, air_sides: 0.0 }
    }

    #[test]
    fn a_point_on_a_film_against_its_closed_form() {
        // (1/2π) ∫_K^∞ dk / (k (R + D k²)) = ln(1 + R/(D K²)) / 4πR.
        for above in [300.0, 700.0, 2000.0] {
            let found = Remainder::new(film(), above, 1e-9).sum(0.0, [1e-9; 2], 1);
            let exact = (1.0 + 200.0 / (7.154e-4 * above * above)).ln() / (4.0 * PI * 200.0);
            assert!((found / exact - 1.0).abs() < 2e-3, "{above}: {found} {exact}");
        }
    }

    #[test]
    fn profiles_are_sums_read_at_points() {
        let remainder = Remainder::new(film(), 700.0, 1e-4);
        let profile = remainder.profile(2e-3);
        for distance in [0.0, 0.3e-3, 1.7e-3, 5e-3, 20e-3] {
            let exact = remainder.sum(distance, [2e-3, 1e-9], 1);
            assert!((profile.at(distance) - exact).abs() < 1e-4 * profile.at(0.0).abs(), "{distance}");
        }
        assert_eq!(profile.at(1.0), 0.0);
        assert_eq!(profile.at(f64::INFINITY), 0.0);
    }
}
