//! Amplitude and frequency of a waveform over time.

use crate::error::within;
use crate::{Curve, EffectsError, Wave, limits};
use std::f64::consts::{PI, TAU};

/// Duration of the fade-out of a waveform that would end abruptly, in s, so that its end does not click. With twice this value,
/// the fade becomes more noticeable.
const EDGE: f64 = 2e-3;
/// Least duration of the loop of a sine, in s: rounding the loop to whole samples changes its duration by at most half a
/// sample, and its frequency in proportion. With twice this value, the error is half as large, for twice the memory.
const LOOP: f64 = 0.25;

/// A waveform a(t) sin(2π∫f dt), given by its amplitude a and frequency f, both piecewise-linear functions of time.
///
/// ```
/// use unripple_effects::Envelope;
///
/// let swell = Envelope::new(vec![(0.0, 0.0), (0.5, 1.0), (1.0, 0.0)], vec![(0.0, 80.0), (1.0, 160.0)])?;
/// assert_eq!((swell.duration(), swell.amplitude().at(0.25)), (1.0, 0.5));
/// assert_eq!(swell.sampled(8000.0)?.samples.len(), 8001);
/// # Ok::<(), unripple_effects::EffectsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    amplitude: Curve,
    frequency: Curve,
}

impl Envelope {
    /// An envelope through points (time in s, amplitude 0 to 1) and (time in s, frequency in Hz). It lasts until the last point of
    /// the amplitude.
    ///
    /// # Errors
    /// As [`Curve::new`], for either curve; [`EffectsError::Range`] if it lasts less than 1 ms or more than [`limits::LONGEST`].
    pub fn new(amplitude: Vec<(f64, f64)>, frequency: Vec<(f64, f64)>) -> Result<Self, EffectsError> {
        let amplitude = Curve::new("time of an amplitude", amplitude, limits::TIME, limits::SHARE)?;
        let frequency = Curve::new("time of a frequency", frequency, limits::TIME, limits::FREQUENCY)?;
        within("duration of an envelope", amplitude.end(), [1e-3, limits::LONGEST])?;
        Ok(Self { amplitude, frequency })
    }

    /// A sine of the given frequency (Hz) with constant amplitude 1. It lasts a whole number of periods, and
    /// at least 0.25 s.
    ///
    /// # Errors
    /// [`EffectsError::Range`] if the frequency is not within [`limits::FREQUENCY`].
    pub fn sine(frequency: f64) -> Result<Self, EffectsError> {
        within("frequency", frequency, limits::FREQUENCY)?;
        let duration = (LOOP * frequency).ceil() / frequency;
        Self::new(vec![(0.0, 1.0), (duration, 1.0)], vec![(0.0, frequency)])
    }

    /// Amplitude over time, 0 to 1.
    pub fn amplitude(&self) -> &Curve {
        &self.amplitude
    }

    /// Frequency over time, in Hz.
    pub fn frequency(&self) -> &Curve {
        &self.frequency
    }

    /// Duration of the envelope, in s.
    pub fn duration(&self) -> f64 {
        self.amplitude.end()
    }

    /// Periods from the start to a time.
    fn periods(&self, time: f64) -> f64 {
        self.frequency.integral(time) - self.frequency.integral(0.0)
    }

    /// The samples of a(t) sin(2π∫f dt) to be played once, at `rate` samples per second, from the start to the end of the envelope.
    /// The waveform begins at zero; if its amplitude does not end at zero, it is faded out over the last 2 ms.
    ///
    /// # Errors
    /// [`EffectsError::Range`] if the rate is not within [`limits::SAMPLE_RATE`].
    pub fn sampled(&self, rate: f64) -> Result<Wave, EffectsError> {
        within("sample rate", rate, limits::SAMPLE_RATE)?;
        let duration = self.duration();
        let count = (duration * rate).round() as usize + 1;
        let abrupt = self.amplitude.at(duration) > 0.0;
        let edge = EDGE.min(0.5 * duration);
        let sample = |i: usize| {
            let time = (i as f64 / rate).min(duration);
            let left = (duration - time) / edge;
            let fall = if abrupt && left < 1.0 { 0.5 - 0.5 * (PI * left).cos() } else { 1.0 };
            (fall * self.amplitude.at(time) * (TAU * self.periods(time)).sin()) as f32
        };
        Ok(Wave { samples: (0..count).map(sample).collect(), rate })
    }

    /// The samples of a(t) sin(2π∫f dt) to be played in a loop, at `rate` samples per second. The frequency
    /// is scaled so that the envelope holds a whole number of periods (the nearest, at least one): the end
    /// then continues into the start at a zero crossing.
    ///
    /// # Errors
    /// [`EffectsError::Range`] if the rate is not within [`limits::SAMPLE_RATE`].
    pub fn looped(&self, rate: f64) -> Result<Wave, EffectsError> {
        within("sample rate", rate, limits::SAMPLE_RATE)?;
        let duration = self.duration();
        let count = ((duration * rate).round() as usize).max(2);
        let whole = self.periods(duration);
        let stretch = whole.round().max(1.0) / whole;
        let sample = |i: usize| {
            let time = duration * i as f64 / count as f64;
            (self.amplitude.at(time) * (TAU * stretch * self.periods(time)).sin()) as f32
        };
        Ok(Wave { samples: (0..count).map(sample).collect(), rate })
    }
}
