//! A time window with half-cosine edges, and the onset of a response.

use super::positive;
use std::f64::consts::PI;
use unripple_dsp::DspError;

/// A window in time that is flat between half cosines; its times are in samples from the start of the signal.
///
/// ```
/// use unripple_calibrate::signals::Gate;
///
/// let mut signal = [1.0; 8];
/// Gate { begin: 1.0, rise: 2.0, end: 7.0, fall: 2.0 }.apply(&mut signal);
/// assert_eq!([signal[0], signal[1], signal[3], signal[5], signal[7]], [0.0, 0.0, 1.0, 1.0, 0.0]);
/// assert!((signal[2] - 0.5).abs() < 1e-12 && (signal[6] - 0.5).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    /// Sample at which the window begins to open.
    pub begin: f64,
    /// Duration of the opening, in samples.
    pub rise: f64,
    /// Sample at which the window is closed again.
    pub end: f64,
    /// Duration of the closing, in samples.
    pub fall: f64,
}

impl Gate {
    /// Weight of the window at a sample, from 0 to 1.
    pub fn at(&self, sample: f64) -> f64 {
        let (since, left) = (sample - self.begin, self.end - sample);
        if since < 0.0 || left < 0.0 {
            return 0.0;
        }
        let edge = |part: f64, whole: f64| {
            if part < whole { (1.0 - (PI * part / whole).cos()) / 2.0 } else { 1.0 }
        };
        edge(since, self.rise) * edge(left, self.fall)
    }

    /// Multiplies the samples of a signal by the window, in place.
    pub fn apply(&self, signal: &mut [f64]) {
        signal.iter_mut().enumerate().for_each(|(i, x)| *x *= self.at(i as f64));
    }
}

/// Onset of a response, in samples: where its magnitude first passes `db` below its largest, interpolated linearly
/// between samples. `None` for silence.
///
/// # Errors
/// [`DspError::Range`] if `db` is not positive.
///
/// ```
/// let response = [0.0, 0.0, 0.0, 1.0, -0.8, 0.6];
/// assert_eq!(unripple_calibrate::signals::onset(&response, 6.0206)?.map(|at| (at * 100.0).round()), Some(250.0));
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
pub fn onset(response: &[f64], db: f64) -> Result<Option<f64>, DspError> {
    positive("dB below the peak", db)?;
    let peak = response.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if peak.is_nan() || peak <= 0.0 {
        return Ok(None);
    }
    let level = peak * 10f64.powf(-db / 20.0);
    let Some(first) = response.iter().position(|x| x.abs() >= level) else { return Ok(None) };
    let Some(before) = first.checked_sub(1) else { return Ok(Some(0.0)) };
    let [low, high] = [response[before].abs(), response[first].abs()];
    Ok(Some(before as f64 + (level - low) / (high - low)))
}
