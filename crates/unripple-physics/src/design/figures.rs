//! All figures of a design, in SI units.

use super::ground::Ground;
use super::tradeoffs::{actuator_counts, by_band, by_noise, by_rate, by_window};
use super::{
    ByBand, ByNoise, ByRate, ByWindow, Deformation, Note, PaperFigures, Touch, Wave, WithActuators, closed,
};
use super::{LatticeFigures, lattice::lattices};
use super::{deformation::deformation, touch::own_touches, waves::waves};
use std::f64::consts::TAU;

/// Rows of the dispersion table, evenly spaced in frequency. With twice this value, the table is twice as long.
const WAVES: usize = 12;

/// The design figures of a surface, which `unripple design` prints, in SI units.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Design {
    /// Name of the surface, for people.
    pub surface: String,
    /// Number of actuators N.
    pub actuators: usize,
    /// Lowest and highest frequency of the band, in Hz.
    pub band_hz: [f64; 2],
    /// Phase velocity at the bottom of the band, in m/s; the phase velocity of the first mode if it is zero
    /// at the bottom, as for plates at 0 Hz.
    pub celerity_min_m_s: f64,
    /// Phase velocity at the top of the band, in m/s.
    pub celerity_max_m_s: f64,
    /// Shortest wavelength of the band, in metres.
    pub lambda_min_m: f64,
    /// Coincidence frequency in Hz, above which waves on the sheet are faster than sound in air and
    /// radiate; `None` if there is none.
    pub coincidence_hz: Option<f64>,
    /// The dispersion relation, as a table of waves at frequencies over the band.
    pub dispersion: Vec<Wave>,
    /// Number of modes in the band, counted after solving for the modes; `None` where modes cannot be
    /// computed.
    pub mode_count_exact: Option<usize>,
    /// Why there is no exact count, in words; `None` if there is one.
    pub mode_count_exact_reason: Option<String>,
    /// Number of modes in the band by Weyl's law: Sk²/4π plus a term for each edge, which depends on how
    /// the edge reflects waves (-Pk/4π for the fixed edge of a membrane, larger for a clamped plate).
    pub mode_count_weyl: f64,
    /// Frequency of the first mode, in Hz; by Weyl's law where modes cannot be computed.
    pub first_mode_hz: f64,
    /// Modes with the actuators on the sheet, which the mode counts, first mode and decay time in this
    /// struct ignore; `None` if no actuator loads the sheet, or if modes cannot be computed.
    pub with_actuators: Option<WithActuators>,
    /// Waves in each lattice of resonators on the sheet, in the surface's order; all other waves are those of the sheet alone.
    pub lattices: Vec<LatticeFigures>,
    /// Heisenberg time n̄ = M/B, in seconds: the mean number of modes per hertz over the band, which is the
    /// time needed to resolve neighbouring modes.
    pub heisenberg_time_s: f64,
    /// Heisenberg time at the top of the band, in seconds: the number of modes per hertz there by Weyl's
    /// law.
    pub heisenberg_time_top_s: f64,
    /// Decay time of the amplitude, in seconds: the reciprocal of the mean decay rate of the modes, by damping and by radiation of sound.
    pub decay_time_s: f64,
    /// Recommended window: the shortest that reaches nine tenths of the largest contrast ([`Windows`](super::Windows)), in seconds.
    pub window_recommended_s: f64,
    /// Why this window is recommended, in words.
    pub window_recommended_why: String,
    /// Exponent p, dimensionless, of the contrast as a function T^p of the window T around the recommended
    /// window; ½ for the √T law.
    pub window_exponent: f64,
    /// Predicted contrast at the recommended window: the mean over many targets, computed from the modes
    /// with the surface's own actuators ([`Windows`](super::Windows)), or by
    /// [`Cavity::contrast`](super::Cavity::contrast) where modes are not known.
    pub contrast_predicted: f64,
    /// The 5 % and 95 % quantiles of the contrast over targets, at the recommended window; `None` where
    /// modes are not known.
    pub contrast_interval: Option<[f64; 2]>,
    /// How `contrast_predicted` was computed.
    pub contrast_from: Predicted,
    /// Contrast at the recommended window by the simplest closed form ([`closed::contrast`]).
    pub contrast_plain: f64,
    /// Predicted contrast as in `contrast_predicted`, but at the window that gives the largest contrast.
    pub contrast_endless: f64,
    /// Numbers of actuators that are compared, ascending and without repetition: 1, N/4, N/2 (both rounded
    /// up), N, 2N and 4N, with N the number of actuators of the surface.
    pub actuator_counts: Vec<usize>,
    /// Table of predicted contrast against window, from a quarter of the recommended window to four times
    /// that, and number of actuators.
    pub contrast_by_window: Vec<ByWindow>,
    /// Table of predicted contrast against bandwidth, for the surface's number of actuators and the
    /// recommended window.
    pub contrast_by_band: Vec<ByBand>,
    /// Table of predicted contrast against noise, for the surface's number of actuators and the recommended
    /// window.
    pub contrast_by_noise: Vec<ByNoise>,
    /// Table of predicted contrast against the rate at which the focus is repeated, for the surface's
    /// number of actuators and the recommended window.
    pub contrast_by_rate: Vec<ByRate>,
    /// Full width at half maximum of a focus in space, in metres.
    pub spot_diameter_m: f64,
    /// Full width at half maximum of a focus of the highest frequency alone, in metres.
    pub spot_diameter_one_frequency_m: f64,
    /// Full width at half maximum of a focus in time, in seconds.
    pub pulse_duration_s: f64,
    /// Bending and strain of the sheet at several amplitudes, and the limits of linear theory.
    pub deformation: Deformation,
    /// Power needed to move a finger by 10 µm, on a strip of this sheet, at the sheet's shortest wavelength
    /// and at twice that.
    pub touch: Vec<Touch>,
    /// Notes on the limits of these figures, and on what they leave out for this surface.
    pub notes: Vec<Note>,
    /// What the paper (Hudin et al. 2012) says about this surface; `None` for every surface but the paper's
    /// own film.
    pub paper: Option<PaperFigures>,
}

/// How a predicted contrast was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Predicted {
    /// From the surface's own modes with its actuators, at many targets: a simulation of time reversal.
    Modes,
    /// From statistics of the band: its modal density and decay times.
    Statistics,
}

impl Design {
    /// The recommended window in words: its length in milliseconds, and why it is recommended.
    pub fn window_text(&self) -> String {
        let ms = super::window::milliseconds(self.window_recommended_s);
        format!("{ms} ms, {}", self.window_recommended_why)
    }

    /// Computes all figures except the notes and those of the paper, which comment on the other figures.
    pub(super) fn on(ground: &Ground) -> Self {
        let Ground { surface, medium, cavity, actuators: n, window, .. } = ground;
        let (n, chosen, window) = (*n, window, window.seconds);
        let lambda_min = TAU / ground.k_top;
        let [low, top] = surface.emission.band;
        let contrast = ground.contrast();
        let correction = ground.correction();
        let counts = actuator_counts(surface.actuators.len());
        Self {
            surface: surface.name.clone(),
            actuators: surface.actuators.len(),
            band_hz: [low, top],
            celerity_min_m_s: ground.celerity_min(),
            celerity_max_m_s: medium.phase_celerity(ground.k_top),
            lambda_min_m: lambda_min,
            coincidence_hz: medium.coincidence_hz(),
            dispersion: waves(surface, WAVES),
            mode_count_exact: ground.counted.as_ref().ok().copied(),
            mode_count_exact_reason: ground.counted.as_ref().err().cloned(),
            mode_count_weyl: ground.weyl_count(),
            first_mode_hz: ground.first_mode_hz,
            with_actuators: None,
            lattices: lattices(surface),
            heisenberg_time_s: cavity.modes() / (top - low),
            heisenberg_time_top_s: ground.density_at_top(),
            decay_time_s: cavity.decay_time(),
            window_recommended_s: window,
            window_recommended_why: chosen.why.clone(),
            window_exponent: ground.exponent(),
            contrast_predicted: contrast,
            contrast_interval: ground.windows.interval(window),
            contrast_from: if ground.loaded_contrast.is_some() {
                Predicted::Modes
            } else {
                Predicted::Statistics
            },
            contrast_plain: closed::contrast(n, top - low, cavity.decay_time(), window, cavity.modes()),
            contrast_endless: contrast * chosen.largest / chosen.contrast,
            contrast_by_window: by_window(|n, window| ground.expected(n, window), window, &counts),
            actuator_counts: counts,
            contrast_by_band: by_band(surface, ground.first_mode_hz, [ground.scale, correction], n, window),
            contrast_by_noise: by_noise(cavity, correction, n, window),
            contrast_by_rate: by_rate(cavity, correction, n, window),
            spot_diameter_m: closed::spot_diameter(lambda_min),
            spot_diameter_one_frequency_m: closed::spot_of_one_frequency(lambda_min),
            pulse_duration_s: closed::pulse_duration(top - low, cavity.growth()),
            deformation: deformation(surface),
            touch: own_touches(surface, lambda_min),
            notes: Vec::new(),
            paper: None,
        }
    }
}
