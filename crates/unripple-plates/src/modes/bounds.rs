//! The request for modes: top frequency, accuracy, and the wave properties of the sheet.

use crate::damping::decay_rate;
use crate::{Accuracy, Medium, PhysicsError};
use std::f64::consts::TAU;
use unripple_core::{Decay, Edge, Surface, require};

/// Largest wavenumber at the top frequency, in rad/m: waves of 6 nm, shorter than the grains and molecules
/// of any sheet. With twice this value, numbers of modes still fit into a machine word.
const LARGEST_WAVENUMBER: f64 = 1e9;

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
        Ok(Self { medium, poisson, max_hz, k_top, accuracy: aim, most })
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
        let radiated = if self.medium.air_sides > 0.0 {
            self.medium.radiation(self.medium.wavenumber(omega))
        } else {
            0.0
        };
        decay_rate(decay, omega, bending_share) + radiated
    }
}
