//! Rows of the dispersion table: wavelength, phase velocity and group velocity against frequency.

use super::weyl::Weyl;
use crate::Medium;
use std::f64::consts::TAU;
use unripple_core::{Sheet, Surface};
use unripple_plates::decay_rate;

/// A wave of one frequency in the band: one row of the dispersion table.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Wave {
    /// Frequency, in Hz.
    pub frequency_hz: f64,
    /// Wavelength λ = 2π/k, in metres.
    pub wavelength_m: f64,
    /// Phase velocity ω/k, in m/s.
    pub phase_celerity_m_s: f64,
    /// Group velocity dω/dk, in m/s.
    pub group_celerity_m_s: f64,
    /// Modes per hertz by Weyl's law, with the perimeter term for the edge conditions.
    pub modes_per_hz: f64,
    /// Mean spacing of modes 1/(dM/df), in Hz; `None` where Weyl's law gives no modes.
    pub mode_spacing_hz: Option<f64>,
    /// Decay time of the amplitude, in seconds, by damping and by radiation of sound.
    pub decay_time_s: f64,
}

/// Table of waves at evenly spaced frequencies from the bottom to the top of the band, in `steps` (a number
/// of) intervals; 0 Hz is left out.
pub(super) fn waves(surface: &Surface, steps: usize) -> Vec<Wave> {
    let [low, top] = surface.emission.band;
    let law = Weyl::of(surface);
    (0..=steps)
        .map(|i| low + (top - low) * i as f64 / steps as f64)
        .filter(|hz| *hz > 0.0)
        .map(|hz| wave(surface, &law, hz))
        .collect()
}

/// The wave of one frequency (Hz), with modes counted by Weyl's law.
fn wave(surface: &Surface, law: &Weyl, hz: f64) -> Wave {
    let medium = Medium::of(&surface.sheet);
    let k = medium.wavenumber(TAU * hz);
    let group = medium.group_celerity(k);
    let density = TAU * law.per_wavenumber(k) / group;
    Wave {
        frequency_hz: hz,
        wavelength_m: TAU / k,
        phase_celerity_m_s: medium.phase_celerity(k),
        group_celerity_m_s: group,
        modes_per_hz: density.max(0.0),
        mode_spacing_hz: (density > 0.0).then(|| 1.0 / density),
        decay_time_s: 1.0 / wave_decay_rate(&surface.sheet, &medium, k, TAU * hz),
    }
}

/// Decay rate of the amplitude, in 1/s, of a wave of wavenumber `k` (rad/m) and angular frequency `omega` (rad/s): by the damping of
/// the sheet and, where it is faster than sound in the air beside it, by radiation.
pub(super) fn wave_decay_rate(sheet: &Sheet, medium: &Medium, k: f64, omega: f64) -> f64 {
    decay_rate(&sheet.decay, omega, medium.bending_share(k)) + medium.radiation(k)
}
