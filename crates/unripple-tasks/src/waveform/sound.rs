//! Samples of the waveforms in a request.

use super::{SoundAsk, WaveformAsk};
use crate::numbers::above_zero;
use crate::{TaskError, point};
use unripple::focus::Waveform;
use unripple::focus::waveform::{burst, click, resampled, sine};
use unripple_store::read_wav;

/// The waveform of a request, at the surface's sample rate (Hz).
pub(super) fn waveform(ask: &WaveformAsk, rate: f64) -> Result<Waveform, TaskError> {
    let level = above_zero(ask.level_m, "level_m", "m")?;
    let samples = match &ask.sound {
        SoundAsk::Sine { hz, length_s } => sine(*hz, *length_s, level, rate).map_err(refused)?,
        SoundAsk::Burst { hz, cycles } => burst(*hz, *cycles, level, rate).map_err(refused)?,
        SoundAsk::Click { length_s } => click(*length_s, level, rate).map_err(refused)?,
        SoundAsk::Wav { file } => {
            let wav = read_wav(file)?;
            let first = wav.channels.first().map_or(&[][..], |channel| channel);
            recorded(first, wav.rate, level, rate, &format!("{}: ", file.display()))?
        }
        SoundAsk::Samples { values, rate_hz } => {
            let values: Vec<f64> = values.clone();
            recorded(&values, *rate_hz, level, rate, "")?
        }
    };
    Ok(Waveform::at(point(&ask.at_m), samples))
}

fn refused(error: impl std::fmt::Display) -> TaskError {
    TaskError::Input(format!("`waveforms`: {error}"))
}

/// Samples resampled to the surface's rate and scaled so that the largest is `level`.
fn recorded(values: &[f64], from: f64, level: f64, rate: f64, file: &str) -> Result<Vec<f64>, TaskError> {
    let mut samples = resampled(values, from, rate).map_err(TaskError::input)?;
    let peak = samples.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if peak == 0.0 {
        return Err(TaskError::Input(format!("`waveforms`: {file}expected a sound, found silence")));
    }
    samples.iter_mut().for_each(|x| *x *= level / peak);
    Ok(samples)
}
