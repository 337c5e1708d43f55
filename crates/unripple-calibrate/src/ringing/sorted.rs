//! What the exponentials of a recording are: modes, mains hum, or steady tones.

use super::refined::{CLEAR, Exponential};
use super::sub_band::SubBand;
use std::f64::consts::{PI, TAU};

/// Least quality factor of a mode: what decays faster is the hit itself, or an edge of the sub-band.
const LEAST_Q: f64 = 3.0;

/// What decays by less than this share of its amplitude in the time that was heard is steady.
const STEADY: f64 = 0.1;

/// Half-width of the part of a sub-band that is taken from it, in its widths: neighbours overlap by a little.
const TAKEN: f64 = 0.46;

/// Most harmonics of the mains that are looked for.
const HARMONICS: f64 = 40.0;

/// Deviation of the mains from its nominal frequency that is allowed for, a ratio, and the width in Hz of any line.
const OFF: f64 = 2e-3;
const WIDTH: f64 = 0.1;

/// An exponential of a recording, with its deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tone {
    /// Frequency and its standard deviation, in Hz.
    pub hz: [f64; 2],
    /// Decay rate and its standard deviation, in 1/s.
    pub decay: [f64; 2],
    /// Amplitude, in the unit of the recording.
    pub amplitude: f64,
    /// Amplitude over its standard deviation.
    pub clarity: f64,
    /// How long it was heard, in s.
    pub seconds: f64,
    /// Number of the sub-band.
    band: usize,
}

impl Tone {
    /// The exponential of a sub-band `width` Hz wide; `None` if it lies beyond its middle part or is not clear of the noise.
    pub fn of(found: &Exponential, band: &SubBand, width: f64, number: usize) -> Option<Self> {
        let away = found.log.im / TAU * band.rate;
        let clarity = found.clarity();
        let spread = found.spread * band.rate;
        let tone = Self {
            hz: [band.centre + away, spread / TAU],
            decay: [-found.log.re * band.rate, spread],
            // A real oscillation is half of two complex ones.
            amplitude: 2.0 * found.amplitude.norm(),
            clarity,
            seconds: band.samples.len() as f64 / band.rate,
            band: number,
        };
        (away.abs() <= TAKEN * width && clarity >= CLEAR && tone.hz[0] > 0.0).then_some(tone)
    }

    /// Whether it does not decay.
    pub fn is_steady(&self) -> bool {
        self.decay[0].abs() < (STEADY / self.seconds).max(3.0 * self.decay[1])
    }

    /// Whether it rings as a mode does: it decays, but not at once.
    pub fn rings(&self) -> bool {
        !self.is_steady() && self.decay[0] > 0.0 && PI * self.hz[0] / self.decay[0] >= LEAST_Q
    }

    /// Whether it is a harmonic of the mains at `mains` Hz.
    pub fn is_hum(&self, mains: f64) -> bool {
        let order = (self.hz[0] / mains).round();
        let near = OFF * self.hz[0] + WIDTH + 3.0 * self.hz[1];
        self.is_steady() && (1.0..=HARMONICS).contains(&order) && (self.hz[0] - order * mains).abs() < near
    }

    /// Whether it is the other one, found in another sub-band.
    fn is(&self, other: &Self) -> bool {
        let near = 4.0 * (self.hz[1] + other.hz[1]) + 0.1 / self.seconds.min(other.seconds);
        self.band != other.band && (self.hz[0] - other.hz[0]).abs() < near
    }
}

/// Tones by their frequency, each once: of those found twice, the clearer one.
pub(super) fn once(mut tones: Vec<Tone>) -> Vec<Tone> {
    tones.sort_by(|a, b| b.clarity.total_cmp(&a.clarity));
    let mut kept: Vec<Tone> = Vec::new();
    for tone in tones {
        if kept.iter().all(|other| !tone.is(other)) {
            kept.push(tone);
        }
    }
    kept.sort_by(|a, b| a.hz[0].total_cmp(&b.hz[0]));
    kept
}

/// The nominal frequency of the mains in Hz, by the steady tones: 50 or 60, whichever has the stronger harmonics; `None` if neither has
/// any.
pub(super) fn mains(tones: &[Tone]) -> Option<f64> {
    let power = |mains: f64| {
        tones.iter().filter(|tone| tone.is_hum(mains)).map(|tone| tone.amplitude.powi(2)).sum::<f64>()
    };
    let [european, american] = [power(50.0), power(60.0)];
    (european + american > 0.0).then_some(if european >= american { 50.0 } else { 60.0 })
}
