//! Sines, tone bursts and clicks as waveforms, and resampled recordings.

use crate::FocusError;
use std::f64::consts::{PI, TAU};
use unripple_core::require;

/// Largest number of samples of a waveform that is made here: 208 s at 48 kHz. With twice this value, it lasts twice as long.
const MOST_SAMPLES: f64 = 1e7;

/// Zero crossings of the interpolating kernel on each side. With twice this value, the transition at half the rate is half
/// as wide, for twice the multiplications.
const REACH: f64 = 32.0;

/// A sine of `hz` (Hz) and amplitude `level` that lasts `seconds`, at `rate` samples per second, with raised-cosine
/// edges of two periods each, at most a quarter of the whole.
///
/// # Errors
/// [`FocusError::Range`] for numbers that are not positive, or too long.
pub fn sine(hz: f64, seconds: f64, level: f64, rate: f64) -> Result<Vec<f64>, FocusError> {
    let count = samples(seconds, rate)?;
    require(
        "frequency of a waveform (Hz)",
        hz > 0.0 && 2.0 * hz < rate,
        format!("above 0, below {}", rate / 2.0),
        hz,
    )?;
    let edge = (2.0 * rate / hz).min(count as f64 / 4.0).max(1.0);
    let share = |i: usize| (PI / 2.0 * (i.min(count - 1 - i) as f64 / edge).min(1.0)).sin().powi(2);
    Ok((0..count).map(|i| level * share(i) * (TAU * hz * i as f64 / rate).sin()).collect())
}

/// A tone burst: `cycles` periods (a number that need not be whole) of `hz` (Hz) and amplitude `level` under a
/// raised-cosine window, at `rate` samples per second.
///
/// # Errors
/// As [`sine`].
pub fn burst(hz: f64, cycles: f64, level: f64, rate: f64) -> Result<Vec<f64>, FocusError> {
    require(
        "frequency of a waveform (Hz)",
        hz > 0.0 && 2.0 * hz < rate,
        format!("above 0, below {}", rate / 2.0),
        hz,
    )?;
    let arch = click(cycles / hz, level, rate)?;
    let middle = (arch.len() as f64 - 1.0) / 2.0;
    // In sine about the middle it has no mean.
    Ok(arch.iter().enumerate().map(|(i, a)| a * (TAU * hz * (i as f64 - middle) / rate).sin()).collect())
}

/// A click: a pulse of height `level` in the shape of a raised cosine, `seconds` long, at `rate` samples per second.
///
/// # Errors
/// As [`sine`].
pub fn click(seconds: f64, level: f64, rate: f64) -> Result<Vec<f64>, FocusError> {
    let count = samples(seconds, rate)?;
    Ok((0..count).map(|i| level * (PI * (i as f64 + 0.5) / count as f64).sin().powi(2)).collect())
}

/// A signal resampled from `from` to `to` samples per second, by band-limited interpolation: a sinc under a
/// raised-cosine window, with 32 zero crossings on each side.
///
/// # Errors
/// [`FocusError::Range`] for rates that are not positive, or too long a result.
pub fn resampled(signal: &[f64], from: f64, to: f64) -> Result<Vec<f64>, FocusError> {
    for (what, x) in [("sample rate of a recording (Hz)", from), ("sample rate of the responses (Hz)", to)] {
        require(what, x.is_finite() && x > 0.0, "a positive number", x)?;
    }
    if from == to || signal.is_empty() {
        return Ok(signal.to_vec());
    }
    let count = samples(signal.len() as f64 / from, to)?;
    // Below one where the new rate is the lower: what it cannot hold is left out.
    let width = (to / from).min(1.0);
    let reach = REACH / width;
    let kernel = |x: f64| {
        let sinc = if x == 0.0 { 1.0 } else { (PI * width * x).sin() / (PI * width * x) };
        width * sinc * (PI / 2.0 * x / reach).cos().powi(2)
    };
    let at = |i: usize| {
        let middle = i as f64 * from / to;
        let first = (middle - reach).ceil().max(0.0) as usize;
        let end = ((middle + reach).floor() as usize + 1).min(signal.len());
        (first.min(end)..end).map(|j| signal[j] * kernel(middle - j as f64)).sum()
    };
    Ok((0..count).map(at).collect())
}

/// A duration (s) as a number of samples, refused if none or too many.
fn samples(seconds: f64, rate: f64) -> Result<usize, FocusError> {
    let count = (seconds * rate).round();
    let legal = (1.0..=MOST_SAMPLES).contains(&count);
    require(
        "length of a waveform (s)",
        legal,
        format!("{} to {}", 1.0 / rate, MOST_SAMPLES / rate),
        seconds,
    )?;
    Ok(count as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_keep_their_tones_at_another_rate() {
        for (from, to) in [(44_100.0, 48_000.0), (48_000.0, 12_000.0), (8_000.0, 48_000.0)] {
            let tone =
                |rate: f64| (0..(rate / 10.0) as usize).map(move |i| (TAU * 600.0 * i as f64 / rate).sin());
            let found = resampled(&tone(from).collect::<Vec<_>>(), from, to).unwrap();
            assert_eq!(found.len(), (to / 10.0) as usize);
            let middle = found.len() / 4..found.len() * 3 / 4;
            let worst = found.iter().zip(tone(to)).enumerate().filter(|(i, _)| middle.contains(i));
            let worst = worst.map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-4, "{from} to {to}: {worst}");
        }
    }

    #[test]
    fn bursts_have_no_mean_and_clicks_their_level() {
        let burst = burst(250.0, 5.0, 2.0, 48e3).unwrap();
        assert_eq!(burst.len(), 960);
        assert!(burst.iter().sum::<f64>().abs() < 1e-9);
        let click = click(2e-3, 3.0, 48e3).unwrap();
        assert!(click.iter().fold(0.0, |m: f64, x| m.max(*x)) > 2.99 && click[0] < 0.01);
        for bad in [sine(0.0, 1.0, 1.0, 48e3), sine(30e3, 1.0, 1.0, 48e3), sine(80.0, f64::NAN, 1.0, 48e3)] {
            assert!(matches!(bad, Err(FocusError::Range(_))));
        }
    }
}
