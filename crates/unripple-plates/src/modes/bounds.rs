//! The request for modes: top frequency, accuracy, and the wave properties of the sheet.

use super::found::Errors;
use crate::damping::decay_rate;
use crate::{Accuracy, Medium, PhysicsError};
use std::f64::consts::TAU;
use unripple_core::{Decay, Edge, Surface, require};

/// Largest wavenumber at the top frequency, in rad/m: waves of 6 nm, shorter than the grains and molecules
/// of any sheet. With twice this value, numbers of modes still fit into a machine word.
const LARGEST_WAVENUMBER: f64 = 1e9;

/// Largest relative error of a decay time that is stated. Twice as much would be as large as the decay time itself.
const LARGEST: f64 = 0.5;

/// Number of steps, to either side of a frequency up to its error, in which the decay rate there is looked at.
const ACROSS: i32 = 2;

/// The request for the modes of a sheet: the top frequency and the accuracy, with the properties of the
/// sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// The wave properties of the sheet, with its air.
    pub(crate) medium: Medium,
    /// Poisson's ratio of the sheet, dimensionless.
    pub(crate) poisson: f64,
    /// Top frequency, in Hz.
    pub(crate) max_hz: f64,
    /// Wavenumber at the top frequency, with air, in rad/m.
    pub(crate) k_top: f64,
    /// Relative accuracy of the frequencies that is aimed at.
    pub(crate) accuracy: f64,
    /// Largest relative error of the frequencies that is accepted if `accuracy` cannot be reached.
    pub(crate) most: f64,
    /// Whether decay times follow from a loss factor, for which modes that it couples matter.
    pub(crate) lossy: bool,
}

impl Bounds {
    /// The request for a surface's modes up to `max_hz` (Hz), with a given accuracy of their frequencies.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a value out of its range.
    pub(crate) fn of(surface: &Surface, max_hz: f64, accuracy: Accuracy) -> Result<Self, PhysicsError> {
        let sheet = &surface.sheet;
        let medium = Medium::of(sheet);
        let positive = "a positive finite number";
        require("top frequency in Hz", max_hz > 0.0, positive, max_hz)?;
        require("mass per area in kg/m²", medium.areal_density > 0.0, positive, medium.areal_density)?;
        require("tension in N/m", medium.tension >= 0.0, "0 or more", medium.tension)?;
        let poisson = sheet.poisson;
        require("Poisson's ratio", poisson > -1.0 && poisson <= 0.5, "more than -1, at most 0.5", poisson)?;
        require(
            "bending stiffness in N·m",
            medium.bending_stiffness >= 0.0,
            "0 or more",
            medium.bending_stiffness,
        )?;
        let stiff = medium.tension + medium.bending_stiffness;
        require("tension and bending stiffness together", stiff > 0.0, "more than 0", stiff)?;
        let Accuracy { aim, most } = accuracy;
        require("accuracy", (1e-12..=0.1).contains(&aim), "between 1e-12 and 0.1", aim)?;
        require("largest error accepted", most >= aim, "at least the accuracy aimed at", most)?;
        let k_top = medium.wavenumber(TAU * max_hz);
        require(
            "top frequency in Hz",
            k_top > 0.0 && k_top <= LARGEST_WAVENUMBER,
            "a frequency whose waves are longer than 7 nm",
            max_hz,
        )?;
        let lossy = matches!(sheet.decay, Decay::LossFactor(eta) if eta > 0.0);
        Ok(Self { medium, poisson, max_hz, k_top, accuracy: aim, most, lossy })
    }

    /// The wave properties of the sheet without its air.
    pub(crate) fn vacuum(&self) -> Medium {
        Medium { air_sides: 0.0, ..self.medium }
    }

    /// ω² in vacuum at the top wavenumber, in 1/s².
    pub(crate) fn top_square(&self) -> f64 {
        self.vacuum().omega(self.k_top).powi(2)
    }

    /// Width √(D/T) in metres of the boundary layer at an edge, where bending gives way to tension: infinite without tension, 0 without bending
    /// stiffness. `None` if the edge does not resist rotation.
    pub(crate) fn layer(&self, edge: Edge) -> Option<f64> {
        let resists = match edge {
            Edge::Clamped => true,
            Edge::Elastic { tilt, .. } => tilt > 0.0,
            Edge::Free | Edge::Supported => false,
        };
        resists.then(|| (self.medium.bending_stiffness / self.medium.tension).sqrt())
    }

    /// The angular frequency in air (rad/s) of a mode, given its ω² in vacuum: that of a plane wave in air
    /// with the wavenumber that the mode has in vacuum. Rigid-body modes stay at 0.
    pub(crate) fn omega_in_air(&self, square: f64) -> f64 {
        let omega = square.sqrt();
        if self.medium.air_sides > 0.0 { self.medium.omega(self.vacuum().wavenumber(omega)) } else { omega }
    }

    /// Angular frequency (rad/s) with the added mass of air, given ω² in vacuum, and the factor by which
    /// that mass changes a mass-normalised shape: √(ρ_s/ρ_eff) = ω/ω_vacuum.
    pub(crate) fn loaded(&self, square: f64) -> (f64, f64) {
        let omega = self.omega_in_air(square);
        (omega, if square > 0.0 { omega / square.sqrt() } else { 1.0 })
    }

    /// Decay rate (1/s) of a mode with given frequency in air (rad/s) and share of bending: by the sheet's
    /// damping and, above coincidence, by radiation.
    pub(crate) fn decay_rate(&self, decay: &Decay, omega: f64, bending_share: f64) -> f64 {
        decay_rate(decay, omega, bending_share) + self.radiated(omega)
    }

    /// The part of a decay rate (1/s) that is due to radiation, at a frequency in air (rad/s).
    fn radiated(&self, omega: f64) -> f64 {
        if self.medium.air_sides > 0.0 { self.medium.radiation(self.medium.wavenumber(omega)) } else { 0.0 }
    }

    /// A bound of the relative error of a decay time with the rate of [`Bounds::decay_rate`], from those of the mode: `None` if there is
    /// none or if it would be more than a half, as where a loss mixes modes so close that they have no decay times of their own.
    pub(super) fn decay_error(
        &self,
        decay: &Decay,
        omega: f64,
        bending_share: f64,
        errors: &Errors,
    ) -> Option<f64> {
        let rate = self.decay_rate(decay, omega, bending_share);
        if rate == 0.0 {
            return Some(0.0);
        }
        let own = match decay {
            Decay::LossFactor(eta) if *eta > 0.0 => {
                (1.0 + errors.share) * (1.0 + eta * eta * errors.second) - 1.0
            }
            _ => 0.0,
        };
        let mut places: Vec<f64> = (-ACROSS..=ACROSS)
            .map(|i| omega * (1.0 + errors.frequency * f64::from(i) / f64::from(ACROSS)))
            .collect();
        if let Decay::Table(table) = decay {
            let [low, high] =
                [1.0 - errors.frequency, 1.0 + errors.frequency].map(|share| share * omega / TAU);
            places.extend(
                table.iter().map(|(hz, _)| *hz).filter(|hz| (low..high).contains(hz)).map(|hz| TAU * hz),
            );
        }
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for place in places {
            let (law, radiated) = (decay_rate(decay, place, bending_share), self.radiated(place));
            least = least.min(law * (1.0 - own) + radiated);
            most = most.max(law * (1.0 + own) + radiated);
        }
        let error = (most / rate - 1.0).max(rate / least - 1.0).max(0.0);
        (least > 0.0 && error <= LARGEST).then_some(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Air, Sheet, Uneven};

    /// A film of BoPET in vacuum.
    fn bounds(air: Air) -> Bounds {
        let sheet = Sheet {
            material: "BoPET".into(),
            young: 4e9,
            density: 1400.0,
            poisson: 0.3,
            strength: None,
            thickness: 0.125e-3,
            tension: 200.0,
            decay: Decay::Time(0.07),
            air,
            uneven: Uneven::default(),
        };
        let medium = Medium::of(&sheet);
        Bounds { medium, poisson: 0.3, max_hz: 3e3, k_top: 400.0, accuracy: 1e-4, most: 1e-2, lossy: false }
    }

    #[test]
    fn decay_errors_are_what_frequencies_and_shares_leave_open() {
        let errors = Errors { frequency: 1e-3, share: 2e-3, shape: 0.0, second: 0.5 };
        let of = |decay: &Decay, hz: f64| bounds(Air::None).decay_error(decay, TAU * hz, 0.3, &errors);
        assert_eq!(of(&Decay::Time(0.07), 500.0), Some(0.0));
        // 0.1 s at 500 Hz, falling by 1 ms in 1 Hz up to an entry within the error.
        let table = Decay::Table(vec![(400.0, 0.2), (500.2, 0.0998), (600.0, 0.0997)]);
        let found = of(&table, 500.0).unwrap();
        let exact = 0.5 * 0.001 / 0.1;
        assert!(found > 0.999 * exact && found < 1.02 * exact, "{found:e} {exact:e}");
        let found = of(&Decay::LossFactor(0.02), 500.0).unwrap();
        let sum = 1e-3 + 2e-3 + 0.5 * 4e-4;
        assert!(found >= sum && found < 1.01 * sum, "{found:e} {sum:e}");
    }

    #[test]
    fn decay_times_that_mixing_makes_uncertain_are_not_stated() {
        let errors = Errors { frequency: 1e-6, share: 0.0, shape: 0.0, second: 1e4 };
        let of = |eta: f64| bounds(Air::None).decay_error(&Decay::LossFactor(eta), 3e3, 0.3, &errors);
        assert!(of(0.001).is_some_and(|error| (1e-2..1.1e-2).contains(&error)));
        assert_eq!([of(0.02), of(0.0)], [None, Some(0.0)]);
        let unknown = Errors { second: f64::INFINITY, ..errors };
        let bounds = bounds(Air::BothSides);
        assert_eq!(bounds.decay_error(&Decay::LossFactor(0.02), 3e3, 0.3, &unknown), None);
        assert!(bounds.decay_error(&Decay::Time(0.07), 3e3, 0.3, &unknown).is_some_and(|error| error < 1e-5));
    }
}
