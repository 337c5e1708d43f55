//! Amplitude and frequency of a waveform over time.

use crate::error::within;
use crate::{Curve, EffectsError, Wave, limits};
use std::f64::consts::{PI, TAU};

/// Time over which a waveform that would end abruptly falls, in s: so that its end does not click. Doubled,
/// waveforms fade more audibly.
const EDGE: f64 = 2e-3;
/// Least time of a steady tone's loop, in s: its frequency is off by at most half a sample in that time.
/// Doubled, half as much, for twice the memory.
const LOOP: f64 = 0.25;

/// Amplitude and frequency over time, both piecewise linear: how a waveform is drawn.
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
    /// An envelope of points (s, amplitude 0 to 1) and (s, Hz); it lasts until the last point of the amplitude.
    ///
    /// # Errors
    /// If a curve is empty, runs back, or leaves its range; if it lasts no time.
    pub fn new(amplitude: Vec<(f64, f64)>, frequency: Vec<(f64, f64)>) -> Result<Self, EffectsError> {
        let amplitude = Curve::new("time of an amplitude", amplitude, limits::TIME, limits::SHARE)?;
        let frequency = Curve::new("time of a frequency", frequency, limits::TIME, limits::FREQUENCY)?;
        within("duration of an envelope", amplitude.end(), [1e-3, limits::LONGEST])?;
        Ok(Self { amplitude, frequency })
    }

    /// A whole number of periods of a sine of a frequency in Hz, at least a quarter of a second.
    ///
    /// # Errors
    /// If the frequency is out of its range.
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

    /// How long it lasts, in s.
    pub fn duration(&self) -> f64 {
        self.amplitude.end()
    }

    /// Periods from the start to a time.
    fn periods(&self, time: f64) -> f64 {
        self.frequency.integral(time) - self.frequency.integral(0.0)
    }

    /// The waveform played once, at `rate` samples per second, its first sample at its start and its last at
    /// its end: a(t) sin 2π∫f dt. It begins at zero; if the amplitude does not end at zero, it falls over the
    /// last 2 ms.
    ///
    /// # Errors
    /// If the rate is out of its range.
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

    /// The waveform as a loop at `rate` samples per second: its frequency moves by less than half a period in
    /// its duration, so that it meets itself at a zero.
    ///
    /// # Errors
    /// If the rate is out of its range.
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
