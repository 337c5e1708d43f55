//! Tables of predicted contrast against window, number of actuators, bandwidth, rate of repetition and noise.

use super::Cavity;
use super::closed;
use crate::Medium;
use unripple_core::Surface;

/// Numbers of actuators in the table of contrast, in powers of two, since contrast grows with their square root.
pub const ACTUATORS: [usize; 6] = [1, 2, 4, 8, 16, 32];

/// Windows in the table of contrast, in seconds: from too short for most surfaces to longer than the decay of most.
pub const WINDOWS: [f64; 8] = [0.005, 0.010, 0.020, 0.030, 0.050, 0.075, 0.100, 0.150];

/// Bandwidths in the table, as shares of the surface's band; 1 is the band itself, more shows what a wider one would give.
const BANDS: [f64; 6] = [0.125, 0.25, 0.5, 0.75, 1.0, 1.5];

/// Rates of repetition in the table, in Hz: from single foci to pulses that overlap on most surfaces.
const RATES: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// Levels of noise in the table, rms of noise over rms of responses: from clean recordings to noise three times the
/// signal.
const NOISES: [f64; 5] = [0.01, 0.1, 0.3, 1.0, 3.0];

/// A row of the table of predicted contrast against window and number of actuators.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ByWindow {
    /// Window T, in seconds.
    pub window_s: f64,
    /// Contrast for each number of actuators in [`ACTUATORS`].
    pub contrast: Vec<f64>,
}

/// A row of the table of predicted contrast against bandwidth.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ByBand {
    /// Top of the band, in Hz.
    pub top_hz: f64,
    /// Shortest wavelength, in metres.
    pub lambda_min_m: f64,
    /// Number of modes in the band, by Weyl's law scaled to the exact count of the surface's own band.
    pub modes: f64,
    /// Predicted contrast, outside a focal disc of a radius of 4/3 of the shortest wavelength.
    pub contrast: f64,
    /// Full width at half maximum of a focus in space, in metres.
    pub spot_diameter_m: f64,
    /// Full width at half maximum of a focus in time, in seconds.
    pub pulse_duration_s: f64,
}

/// A row of the table of predicted contrast against the rate at which a focus is repeated.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ByRate {
    /// Repetitions per second.
    pub rate_hz: f64,
    /// Contrast with the decay times of the surface.
    pub contrast: f64,
    /// Contrast with the decay time T/N that the paper recommends.
    pub contrast_at_papers_decay: f64,
}

/// A row of the table of predicted contrast against noise in recording or emission.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ByNoise {
    /// Rms of the noise over rms of a response, in the band and over the window.
    pub noise_ratio: f64,
    /// Predicted contrast, a ratio of amplitudes.
    pub contrast: f64,
}

/// Contrast (a ratio) for every tabulated window and number of actuators.
pub(super) fn by_window(cavity: &Cavity) -> Vec<ByWindow> {
    let row = |window: f64| ACTUATORS.map(|n| cavity.contrast(n as f64, window)).to_vec();
    WINDOWS.iter().map(|&window_s| ByWindow { window_s, contrast: row(window_s) }).collect()
}

/// Contrast for bands of other widths, below half the sample rate, with a window in s; `scale` is the exact
/// mode count over Weyl's.
pub(super) fn by_band(surface: &Surface, scale: f64, actuators: f64, window: f64) -> Vec<ByBand> {
    let [low, top] = surface.emission.band;
    let medium = Medium::of(&surface.sheet);
    let tops = BANDS.iter().map(|share| low + share * (top - low));
    tops.filter(|hz| *hz < surface.emission.rate / 2.0)
        .map(|top_hz| {
            let by_law = Cavity::of(surface, top_hz);
            let counted = scale * by_law.modes();
            let cavity = by_law.counted(counted);
            let lambda_min_m = medium.lambda_min(top_hz);
            ByBand {
                top_hz,
                lambda_min_m,
                modes: cavity.modes(),
                contrast: cavity.contrast(actuators, window),
                spot_diameter_m: closed::spot_diameter(lambda_min_m),
                pulse_duration_s: closed::pulse_duration(top_hz - low, cavity.growth()),
            }
        })
        .collect()
}

/// Contrast for the tabulated rates, with the surface's decay and with another; window and decay time in s.
pub(super) fn by_rate(cavity: &Cavity, actuators: f64, window: f64, decay_time: f64) -> Vec<ByRate> {
    let dead = cavity.clone().with_decay_time(decay_time);
    RATES
        .iter()
        .map(|&rate_hz| ByRate {
            rate_hz,
            contrast: cavity.repeated(actuators, window, 1.0 / rate_hz),
            contrast_at_papers_decay: dead.repeated(actuators, window, 1.0 / rate_hz),
        })
        .collect()
}

/// Contrast (a ratio) for the tabulated levels of noise, with a window in s.
pub(super) fn by_noise(cavity: &Cavity, actuators: f64, window: f64) -> Vec<ByNoise> {
    let row =
        |&noise_ratio: &f64| ByNoise { noise_ratio, contrast: cavity.noisy(actuators, window, noise_ratio) };
    NOISES.iter().map(row).collect()
}
