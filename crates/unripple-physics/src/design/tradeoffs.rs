//! Tables of predicted contrast (velocity at the focus over the rms elsewhere) against window, number of
//! actuators, bandwidth, rate of repetition and noise.

use super::Cavity;
use super::closed;
use super::digits::rounded;
use crate::Medium;
use unripple_core::Surface;

/// Number of steps of √2 from the recommended window to the shortest and to the longest in the table of
/// contrast: from a quarter of it to four times. Twice as many would span a factor of 256, where contrast
/// is flat at one end and useless at the other.
const STEPS: i32 = 4;

/// Significant digits of the other windows in the table of contrast: enough for steps of √2. One more is
/// harder to read.
const DIGITS: i32 = 2;

/// Bandwidths in the table, relative to the surface's band; 1 is the band itself, larger values show what a
/// wider band would give.
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
    /// Contrast for each number of actuators in [`Design::actuator_counts`](super::Design).
    pub contrast: Vec<f64>,
}

/// A row of the table of predicted contrast against bandwidth.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ByBand {
    /// Top of the band, in Hz.
    pub top_hz: f64,
    /// Shortest wavelength in this band, in metres.
    pub lambda_min_m: f64,
    /// Number of modes in the band, by Weyl's law scaled to the exact count of the surface's own band.
    pub modes: f64,
    /// Predicted contrast; points farther from the target than 4/3 of the shortest wavelength count as
    /// background.
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
    /// Predicted contrast, a ratio of amplitudes.
    pub contrast: f64,
}

/// A row of the table of predicted contrast against noise in recording or emission.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ByNoise {
    /// Rms of the noise relative to the rms of a response, both in the band and over the window.
    pub noise_ratio: f64,
    /// Predicted contrast, a ratio of amplitudes.
    pub contrast: f64,
}

/// Numbers of actuators to compare, ascending: one, then a quarter of, half of, once, twice and four times
/// the surface's own number.
pub(super) fn actuator_counts(own: usize) -> Vec<usize> {
    let mut counts = vec![1, own.div_ceil(4), own.div_ceil(2), own, 2 * own, 4 * own];
    counts.dedup();
    counts
}

/// Table of contrast (a ratio) for each number of actuators in `counts`, at windows around and including
/// the recommended one (s); `expected` computes the contrasts for numbers of actuators and a window in s.
pub(super) fn by_window(
    expected: impl Fn(&[f64], f64) -> Vec<f64>,
    recommended: f64,
    counts: &[usize],
) -> Vec<ByWindow> {
    let window = |step: i32| match step {
        0 => recommended,
        _ => rounded(recommended * 2f64.powf(0.5 * f64::from(step)), DIGITS),
    };
    let actuators: Vec<f64> = counts.iter().map(|n| *n as f64).collect();
    let row = |window_s: f64| ByWindow { window_s, contrast: expected(&actuators, window_s) };
    (-STEPS..=STEPS).map(window).map(row).collect()
}

/// Table of contrast for bands of other widths, below half the sample rate, with a window in s;
/// `first_mode_hz` is the frequency of the sheet's first mode (Hz). `scale` is the exact mode count
/// relative to Weyl's, `correction` the contrast in the surface's own band relative to the contrast by
/// statistics.
pub(super) fn by_band(
    surface: &Surface,
    first_mode_hz: f64,
    [scale, correction]: [f64; 2],
    actuators: f64,
    window: f64,
) -> Vec<ByBand> {
    let [low, top] = surface.emission.band;
    let medium = Medium::of(&surface.sheet);
    let tops = BANDS.iter().map(|share| low + share * (top - low));
    tops.filter(|hz| *hz < surface.emission.rate / 2.0)
        .map(|top_hz| {
            let counted = scale * Cavity::of(surface, top_hz).modes();
            let cavity = Cavity::ringing(surface, first_mode_hz, top_hz).counted(counted);
            let lambda_min_m = medium.lambda_min(top_hz);
            ByBand {
                top_hz,
                lambda_min_m,
                modes: cavity.modes(),
                contrast: correction * cavity.contrast(actuators, window),
                spot_diameter_m: closed::spot_diameter(lambda_min_m),
                pulse_duration_s: closed::pulse_duration(top_hz - low, cavity.growth()),
            }
        })
        .collect()
}

/// Table of contrast (a ratio) for the tabulated rates, with a window in s; `correction` is the contrast of
/// a single focus relative to the contrast of the cavity.
pub(super) fn by_rate(cavity: &Cavity, correction: f64, actuators: f64, window: f64) -> Vec<ByRate> {
    let contrast = |rate_hz: f64| correction * cavity.repeated(actuators, window, 1.0 / rate_hz);
    let row = |&rate_hz: &f64| ByRate { rate_hz, contrast: contrast(rate_hz) };
    RATES.iter().map(row).collect()
}

/// Table of contrast (a ratio) for the tabulated levels of noise, with a window in s; `correction` is the
/// contrast without noise relative to the contrast of the cavity.
pub(super) fn by_noise(cavity: &Cavity, correction: f64, actuators: f64, window: f64) -> Vec<ByNoise> {
    let contrast = |ratio: f64| {
        // Noise adds to 1/C² of the corrected contrast as it does to that of the cavity.
        let alone = cavity.contrast(actuators, window);
        let added = cavity.noisy(actuators, window, ratio).powi(-2) - alone.powi(-2);
        ((correction * alone).powi(-2) + added).powf(-0.5)
    };
    let row = |&noise_ratio: &f64| ByNoise { noise_ratio, contrast: contrast(noise_ratio) };
    NOISES.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::papers_surface;

    #[test]
    fn counts_are_about_the_own_number() {
        assert_eq!(actuator_counts(1), [1, 2, 4]);
        assert_eq!(actuator_counts(3), [1, 2, 3, 6, 12]);
        assert_eq!(actuator_counts(8), [1, 2, 4, 8, 16, 32]);
        assert_eq!(actuator_counts(48), [1, 12, 24, 48, 96, 192]);
    }

    #[test]
    fn windows_are_about_the_recommended_one() {
        let cavity = Cavity::of(&papers_surface(), 3000.0);
        let windows = |recommended: f64| -> Vec<f64> {
            by_window(|n, window| vec![cavity.contrast(n[0], window)], recommended, &[8])
                .iter()
                .map(|row| 1e3 * row.window_s)
                .collect()
        };
        let close = |found: Vec<f64>, expected: [f64; 9]| {
            assert_eq!(found.len(), expected.len());
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        };
        close(windows(0.0287), [7.2, 10.0, 14.0, 20.0, 28.7, 41.0, 57.0, 81.0, 110.0]);
        close(windows(0.00112), [0.28, 0.4, 0.56, 0.79, 1.12, 1.6, 2.2, 3.2, 4.5]);
    }
}
