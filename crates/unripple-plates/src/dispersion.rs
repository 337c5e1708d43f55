//! The dispersion relation of a tensioned plate with air at its sides.

use std::f64::consts::{PI, TAU};
use unripple_core::{Air, Sheet};
use unripple_linalg::c64;

/// Density of air ρ_0 at 20 °C and 1013 hPa, in kg/m³. With twice this value, the added mass of the air beside a film would
/// double.
pub const AIR_DENSITY: f64 = 1.204;

/// Speed of sound c_0 in dry air at 20 °C, in m/s. With twice this value, the coincidence frequency of a plate would be four times as
/// high.
pub const AIR_CELERITY: f64 = 343.2;

/// The wave properties of a sheet: mass per area, tension, bending stiffness, and the number of sides in
/// contact with air.
///
/// A tensioned, isotropic Kirchhoff plate carries waves e^{j(ωt - kx)}. With air on n sides, a free wave of real wavenumber k
/// satisfies (Fahy and Gardonio, *Sound and Structural Vibration*, 2007, section 4)
///
/// ```text
/// ρ_s ω² + n ρ_0 ω²/γ = k² (R + D k²),   γ = √(k² - (ω/c_0)²)
/// ```
///
/// with ρ_s = ρh. For waves slower than sound, γ is real and the air is an added mass n ρ_0/γ. Faster waves radiate: γ
/// is near j√((ω/c_0)² - k²), the air is a resistance n ρ_0 c_0/√(1 - (k c_0/ω)²), and the imaginary part of ω is the decay
/// rate σ of the wave, [`Medium::radiation`]. The equation is a cubic in γ. It has one positive root, the slow wave, and if air is
/// light a pair of complex roots, the radiating wave. The wave that belongs to the sheet changes from one to the other at
/// coincidence, where the wave in vacuum is as fast as sound. Both roots are finite there, so that ω jumps by the share
/// (n ρ_0/ρ_s k)^{2/3}, about a per cent, and σ starts at about the same share of ω. The radiation of a finite sheet below
/// coincidence, from its edges, is neglected.
///
/// ```
/// use unripple_plates::Medium;
///
/// let film = Medium { areal_density: 0.175, tension: 200.0, bending_stiffness: 7.15e-4, air_sides: 0.0 };
/// let k = film.wavenumber(std::f64::consts::TAU * 3000.0);
/// assert!((film.omega(k) / std::f64::consts::TAU - 3000.0).abs() < 1e-9);
/// assert!((film.phase_celerity(0.0) - 33.81).abs() < 0.01);
/// assert!((film.lambda_min(3000.0) - 0.01455).abs() < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Mass per area ρ_s = ρh, in kg/m².
    pub areal_density: f64,
    /// Tension R, in N/m.
    pub tension: f64,
    /// Bending stiffness D = E h³ / 12(1 - ν²), in N·m.
    pub bending_stiffness: f64,
    /// Number of sides in contact with air: 0, 1 or 2.
    pub air_sides: f64,
}

impl Medium {
    /// The wave properties of a sheet with its nominal thickness and tension: mass per area, tension,
    /// bending stiffness and the number of its faces (0, 1 or 2) that touch air. Profiles and orthotropy are ignored.
    pub fn of(sheet: &Sheet) -> Self {
        Self {
            areal_density: sheet.density * sheet.thickness,
            tension: sheet.tension,
            bending_stiffness: sheet.young * sheet.thickness.powi(3) / (12.0 * (1.0 - sheet.poisson.powi(2))),
            air_sides: sheet.air.sides(),
        }
    }

    /// The same sheet, with the sides in contact with air replaced.
    pub fn with_air(mut self, air: Air) -> Self {
        self.air_sides = air.sides();
        self
    }

    /// Restoring force per area and per displacement, R k² + D k⁴, of a wave of wavenumber `k` (rad/m), in
    /// N/m³.
    pub fn stiffness(&self, k: f64) -> f64 {
        k * k * (self.tension + self.bending_stiffness * k * k)
    }

    /// Angular frequency ω of a free wave of wavenumber `k` (rad/m), in rad/s; for a radiating wave, the magnitude of its complex ω.
    pub fn omega(&self, k: f64) -> f64 {
        if let Some(gamma) = self.leaky(k) {
            return self.leaky_square(k, gamma).norm().sqrt();
        }
        let vacuum = self.omega_in_vacuum(k);
        if !(self.air_sides > 0.0 && k > 0.0) {
            return vacuum;
        }
        let stiffness = self.stiffness(k);
        root(0.0, vacuum.min(AIR_CELERITY * k), |omega| {
            omega * omega * self.effective_density(k, omega) - stiffness
        })
    }

    /// Decay rate σ, in 1/s, that radiation of sound into the air causes for a wave of wavenumber `k`
    /// (rad/m): 0 for waves slower than sound, about n ρ_0 c_0/(2ρ_s √(1 - (k c_0/ω)²)) far above
    /// coincidence.
    pub fn radiation(&self, k: f64) -> f64 {
        self.leaky(k).map_or(0.0, |gamma| self.leaky_square(k, gamma).sqrt().im.abs())
    }

    /// Wavenumber k of a wave at the angular frequency `omega` (rad/s), in rad/m: the inverse of [`Medium::omega`].
    ///
    /// With air, [`Medium::omega`] jumps by about a per cent at coincidence; for frequencies within the jump, this is the wavenumber of
    /// coincidence.
    pub fn wavenumber(&self, omega: f64) -> f64 {
        let vacuum = self.wavenumber_in_vacuum(omega);
        if !(self.air_sides > 0.0 && omega > 0.0) {
            return vacuum;
        }
        let lowest = vacuum.max(omega / AIR_CELERITY);
        let residual = |k: f64| self.stiffness(k) - omega * omega * self.effective_density(k, omega);
        let mut highest = 2.0 * lowest;
        while residual(highest) < 0.0 && highest.is_finite() {
            highest *= 2.0;
        }
        let slow = root(lowest, highest, residual);
        if self.leaky(slow).is_none() { slow } else { root(0.0, slow, |k| self.omega(k) - omega) }
    }

    /// Phase velocity c = ω/k, in m/s, at the wavenumber `k` (rad/m). For k = 0 it is the limit as k tends
    /// to 0: √(R/ρ_s) in vacuum, 0 in air.
    pub fn phase_celerity(&self, k: f64) -> f64 {
        if k > 0.0 {
            self.omega(k) / k
        } else if self.air_sides > 0.0 {
            0.0
        } else {
            (self.tension / self.areal_density).sqrt()
        }
    }

    /// Group velocity dω/dk, in m/s, at the wavenumber `k` (rad/m); in vacuum (R + 2Dk²)k/(ρ_s ω).
    pub fn group_celerity(&self, k: f64) -> f64 {
        if k <= 0.0 {
            return self.phase_celerity(k);
        }
        let omega = self.omega(k);
        let slope = 2.0 * k * (self.tension + 2.0 * self.bending_stiffness * k * k);
        if self.air_sides == 0.0 {
            return slope / (2.0 * self.areal_density * omega);
        }
        if let Some(gamma) = self.leaky(k) {
            return self.leaky_celerity(k, gamma, slope);
        }
        let gap = k * k - (omega / AIR_CELERITY).powi(2);
        let layer = self.air_sides * AIR_DENSITY * omega * omega / gap.powf(1.5);
        let density = self.effective_density(k, omega);
        (slope + layer * k) / (2.0 * omega * density + layer * omega / AIR_CELERITY.powi(2))
    }

    /// Coincidence frequency f_c in Hz, above which waves on the sheet in vacuum are faster than sound in
    /// air and radiate: k_c² = (ρ_s c_0² - R)/D, f_c = c_0 k_c / 2π. `None` if waves of all frequencies are
    /// faster than sound, or none are.
    pub fn coincidence_hz(&self) -> Option<f64> {
        self.coincidence_wavenumber().map(|k| AIR_CELERITY * k / TAU)
    }

    /// Shortest wavelength 2π/k in a band that ends at `top_hz` (Hz), in metres.
    pub fn lambda_min(&self, top_hz: f64) -> f64 {
        2.0 * PI / self.wavenumber(TAU * top_hz)
    }

    /// Share of bending in the elastic energy of a wave of wavenumber `k` (rad/m), D k²/(R + D k²), from 0
    /// to 1; the wave's loss factor is the material's times this share.
    pub fn bending_share(&self, k: f64) -> f64 {
        let bending = self.bending_stiffness * k * k;
        if bending > 0.0 { bending / (self.tension + bending) } else { 0.0 }
    }

    /// Moving mass per area, including the added mass of the air, in kg/m², at the wavenumber `k` (rad/m)
    /// and angular frequency `omega` (rad/s); infinite if the wave is as fast as sound or faster.
    pub fn effective_density(&self, k: f64, omega: f64) -> f64 {
        if self.air_sides == 0.0 {
            return self.areal_density;
        }
        let gap = (k * k - (omega / AIR_CELERITY).powi(2)).max(0.0);
        self.areal_density + self.air_sides * AIR_DENSITY / gap.sqrt()
    }

    fn omega_in_vacuum(&self, k: f64) -> f64 {
        (self.stiffness(k) / self.areal_density).sqrt()
    }

    /// The root k of D k⁴ + R k² = ρ_s ω², written so that no digits are lost for R = 0 or D = 0.
    fn wavenumber_in_vacuum(&self, omega: f64) -> f64 {
        if omega <= 0.0 || omega.is_nan() {
            return 0.0;
        }
        let inertia = self.areal_density * omega * omega;
        let discriminant = self.tension * self.tension + 4.0 * self.bending_stiffness * inertia;
        (2.0 * inertia / (self.tension + discriminant.sqrt())).sqrt()
    }

    /// The complex decay constant γ of the air's motion away from the sheet, in 1/m, for the radiating wave
    /// of wavenumber `k`; `None` if waves are slower than sound, or if the air is too heavy for a radiating
    /// wave.
    ///
    /// With a = ρ_s c_0², b = n ρ_0 c_0² and the stiffness S, the cubic is a γ³ + b γ² + (S - a k²) γ - b k² = 0; in
    /// y = γ/k, y³ + δy² + ey - δ = 0. Its positive root is found first and divided out.
    fn leaky(&self, k: f64) -> Option<c64> {
        if !(self.air_sides > 0.0 && k > 0.0) {
            return None;
        }
        let inertia = self.areal_density * (AIR_CELERITY * k).powi(2);
        let excess = self.stiffness(k) / inertia - 1.0;
        if excess < 0.0 {
            return None;
        }
        let delta = self.air_sides * AIR_DENSITY / (self.areal_density * k);
        let slow = root(0.0, 1.0, |y| y * (y * (y + delta) + excess) - delta);
        let half = 0.5 * (delta + slow);
        let square = excess + slow * (delta + slow) - half * half;
        (square > 0.0).then(|| c64::new(-half * k, square.sqrt() * k))
    }

    /// The complex ω² of the radiating wave: c_0² (k² - γ²).
    fn leaky_square(&self, k: f64, gamma: c64) -> c64 {
        (k * k - gamma * gamma) * AIR_CELERITY.powi(2)
    }

    /// Derivative of |ω| of the radiating wave with respect to k, by implicit differentiation of the cubic;
    /// `slope` is the derivative of the stiffness.
    fn leaky_celerity(&self, k: f64, gamma: c64, slope: f64) -> f64 {
        let a = self.areal_density * AIR_CELERITY.powi(2);
        let b = self.air_sides * AIR_DENSITY * AIR_CELERITY.powi(2);
        let by_gamma = gamma * gamma * (3.0 * a) + gamma * (2.0 * b) + (self.stiffness(k) - a * k * k);
        let by_k = gamma * (slope - 2.0 * a * k) - 2.0 * b * k;
        let bend = -by_k / by_gamma;
        let square = self.leaky_square(k, gamma);
        let rate = (k - gamma * bend) * (2.0 * AIR_CELERITY.powi(2));
        (square.conj() * rate).re / (2.0 * square.norm().powf(1.5))
    }

    /// Wavenumber at which waves in vacuum are as fast as sound in air, in rad/m.
    fn coincidence_wavenumber(&self) -> Option<f64> {
        let excess = self.areal_density * AIR_CELERITY * AIR_CELERITY - self.tension;
        (excess > 0.0 && self.bending_stiffness > 0.0).then(|| (excess / self.bending_stiffness).sqrt())
    }
}

/// The root of an increasing function between `low` and `high`, to the last bits, by bisection.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn media() -> Vec<Medium> {
        let film =
            Medium { areal_density: 0.175, tension: 200.0, bending_stiffness: 7.154e-4, air_sides: 0.0 };
        let glass = Medium { areal_density: 2.3, tension: 0.0, bending_stiffness: 6.04, air_sides: 0.0 };
        let membrane = Medium { bending_stiffness: 0.0, ..film };
        [film, glass, membrane]
            .into_iter()
            .flat_map(|m| [0.0, 1.0, 2.0].map(|air_sides| Medium { air_sides, ..m }))
            .collect()
    }

    #[test]
    fn wavenumber_inverts_omega() {
        for medium in media() {
            for hz in [1.0, 100.0, 3e3, 5e3, 3e4, 1e5] {
                let k = medium.wavenumber(TAU * hz);
                let back = medium.omega(k) / TAU;
                assert!((back / hz - 1.0).abs() < 1e-9, "{medium:?} {hz}: {back}");
            }
        }
    }

    #[test]
    fn group_celerity_is_the_slope() {
        for medium in media() {
            for k in [3.0, 30.0, 100.0, 400.0] {
                let d = 1e-5 * k;
                let slope = (medium.omega(k + d) - medium.omega(k - d)) / (2.0 * d);
                assert!((medium.group_celerity(k) / slope - 1.0).abs() < 1e-6, "{medium:?} {k}");
            }
        }
    }

    #[test]
    fn glass_coincides_near_twelve_kilohertz() {
        let glass = Medium { areal_density: 2.5, tension: 0.0, bending_stiffness: 6.3, air_sides: 0.0 };
        // f_c = c_0²/2π √(ρ_s/D), the textbook form.
        let textbook = AIR_CELERITY.powi(2) / TAU * (2.5f64 / 6.3).sqrt();
        assert!((glass.coincidence_hz().unwrap() / textbook - 1.0).abs() < 1e-12);
    }

    #[test]
    fn radiating_waves_solve_their_equation() {
        for medium in media().into_iter().filter(|m| m.air_sides > 0.0 && m.bending_stiffness > 1.0) {
            let coincidence = medium.coincidence_wavenumber().unwrap();
            for k in [1.0001, 1.01, 1.3, 3.0].map(|ratio| ratio * coincidence) {
                let gamma = medium.leaky(k).unwrap();
                let square = medium.leaky_square(k, gamma);
                let left = square * medium.areal_density + square * medium.air_sides * AIR_DENSITY / gamma;
                assert!((left - medium.stiffness(k)).norm() < 1e-9 * medium.stiffness(k), "{medium:?} {k}");
                assert!(gamma.im > 0.0 && square.im > 0.0 && medium.radiation(k) > 0.0);
                // Far above coincidence, the textbook's resistance.
                let omega = medium.omega(k);
                let slowness = (k * AIR_CELERITY / omega).powi(2);
                let textbook = medium.air_sides * AIR_DENSITY * AIR_CELERITY
                    / (2.0 * medium.areal_density * (1.0 - slowness).sqrt());
                let error = medium.radiation(k) / textbook - 1.0;
                assert!(k < 1.2 * coincidence || error.abs() < 5e-3, "{medium:?} {k}: {error}");
            }
        }
    }

    #[test]
    fn coincidence_is_a_jump_of_a_per_cent() {
        for medium in media().into_iter().filter(|m| m.air_sides > 0.0 && m.bending_stiffness > 1.0) {
            let k = medium.coincidence_wavenumber().unwrap();
            let jump = medium.omega(k * (1.0 + 1e-9)) / medium.omega(k * (1.0 - 1e-9)) - 1.0;
            let scale = (medium.air_sides * AIR_DENSITY / (medium.areal_density * k)).powf(2.0 / 3.0);
            assert!((0.5..1.5).contains(&(jump / scale)), "{medium:?}: {jump} {scale}");
            let sigma = medium.radiation(k * (1.0 + 1e-9)) / medium.omega(k);
            assert!((0.3..0.6).contains(&(sigma / scale)), "{medium:?}: {sigma} {scale}");
            let inside = medium.omega(k * (1.0 - 1e-9)) * (1.0 + 0.5 * jump);
            assert!((medium.wavenumber(inside) / k - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn no_wave_without_frequency() {
        for medium in media() {
            assert_eq!((medium.wavenumber(0.0), medium.omega(0.0)), (0.0, 0.0));
            assert!(medium.wavenumber(f64::NAN).abs() < 1.0);
        }
    }

    #[test]
    fn air_lowers_the_first_mode_of_the_papers_film() {
        // physics: about 160 Hz in vacuum towards 132 Hz with air on two sides, supported square of 150 mm.
        let k = 2f64.sqrt() * PI / 0.15;
        let film =
            Medium { areal_density: 0.175, tension: 200.0, bending_stiffness: 7.154e-4, air_sides: 0.0 };
        assert!((film.omega(k) / TAU - 159.614).abs() < 2e-3);
        let loaded = film.with_air(Air::BothSides).omega(k) / TAU;
        assert!((loaded - 132.0).abs() < 1.0, "{loaded}");
    }
}
