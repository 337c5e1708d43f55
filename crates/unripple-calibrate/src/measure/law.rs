//! Shift of natural frequencies with a small change of tension or stiffness.

use unripple_core::Sheet;
use unripple_physics::Medium;

/// Number of frequencies at which the share of bending is tabulated; linear interpolation between them is accurate to
/// 1e-4.
const POINTS: usize = 256;

/// Shift of a sheet's natural frequencies with its tension, each by the share of tension in its elastic
/// energy; those of a plate without tension shift with its stiffness (temperature), all by the same share.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Law {
    step: f64,
    /// Relative change of the square of a frequency per relative change of tension or stiffness, from 0 to 1.
    follows: Vec<f64>,
    /// Whether the changes are changes of tension; otherwise they are changes of bending stiffness.
    pub tension: bool,
}

impl Law {
    /// Computes the frequency shifts of a sheet, up to `top` Hz.
    pub fn of(sheet: &Sheet, top: f64) -> Self {
        let (medium, tension) = (Medium::of(sheet), sheet.tension > 0.0);
        let step = top / (POINTS - 1) as f64;
        let follows = |i: usize| {
            let omega = std::f64::consts::TAU * step * i as f64;
            if tension { 1.0 - medium.bending_share(medium.wavenumber(omega)) } else { 1.0 }
        };
        Self { step, follows: (0..POINTS).map(follows).collect(), tension }
    }

    fn ratio(&self, hz: f64, change: f64) -> f64 {
        let place = (hz / self.step).clamp(0.0, (POINTS - 1) as f64);
        let left = place as usize;
        let part = place - left as f64;
        let right = (left + 1).min(POINTS - 1);
        let follows = self.follows[left] * (1.0 - part) + self.follows[right] * part;
        (1.0 + change * follows).max(0.25).sqrt()
    }

    /// The frequency (Hz) to which `hz` moves under a relative change of tension or stiffness, and its derivative by
    /// `hz`.
    pub fn changed(&self, hz: f64, change: f64) -> [f64; 2] {
        self.sloped(hz, |hz| hz * self.ratio(hz, change))
    }

    /// The frequency (Hz) that moves to `hz` under a relative change of tension or stiffness, and its
    /// derivative by `hz`. Accurate to first order in the change of the share of bending.
    pub fn unchanged(&self, hz: f64, change: f64) -> [f64; 2] {
        if !self.tension {
            let ratio = self.ratio(hz, change);
            return [hz / ratio, 1.0 / ratio];
        }
        self.sloped(hz, |hz| hz / self.ratio(hz / self.ratio(hz, change), change))
    }

    fn sloped(&self, hz: f64, to: impl Fn(f64) -> f64) -> [f64; 2] {
        let near = (0.01 * hz).max(1e-3);
        [to(hz), (to(hz + near) - to(hz - near)) / (2.0 * near)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_physics::design::papers_surface;

    #[test]
    fn a_film_moves_as_its_dispersion_relation_says_and_a_plate_as_a_whole() {
        let mut sheet = papers_surface().sheet;
        let law = Law::of(&sheet, 4000.0);
        let medium = Medium::of(&sheet);
        let tighter = Medium { tension: sheet.tension * 1.005, ..medium };
        for hz in [160.0, 1000.0, 3000.0] {
            let truth = tighter.omega(medium.wavenumber(std::f64::consts::TAU * hz)) / std::f64::consts::TAU;
            let [found, slope] = law.changed(hz, 0.005);
            assert!((found - truth).abs() < 2e-6 * hz, "{hz}: {found} {truth}");
            assert!((slope - 1.0).abs() < 0.005);
            assert!((law.unchanged(found, 0.005)[0] - hz).abs() < 1e-6 * hz);
        }
        sheet.tension = 0.0;
        let plate = Law::of(&sheet, 4000.0);
        assert!(!plate.tension && (plate.changed(500.0, 0.01)[0] - 500.0 * 1.01_f64.sqrt()).abs() < 1e-9);
    }
}
