//! Hum: a steady waveform under the finger.

use crate::error::within;
use crate::play::{Maker, Moment, Out, Play, Sounding};
use crate::{Act, Curve, EffectsError, Envelope, Wave, limits};

/// Least change of the gain for which a cue is given, as a share of full gain: 0.17 dB at full gain. Halved, there are twice
/// as many cues, for finer steps.
const CHANGE: f64 = 0.02;

/// A hum: a waveform played at the finger, and moved with it, while the finger is in the region.
#[derive(Clone, Debug, PartialEq)]
pub struct Hum {
    /// The waveform that is played.
    pub tone: Tone,
    /// Gain (0 to 1) as a function of the finger's speed in m/s.
    pub speed_gain: Curve,
    /// Duration of the fade-in and of the fade-out, in s.
    pub fade: f64,
}

/// The waveform of a hum: a sine, or an envelope.
#[derive(Clone, Debug, PartialEq)]
pub enum Tone {
    /// A continuous sine of a frequency in Hz.
    Sine(f64),
    /// The waveform of an envelope, played once.
    Once(Envelope),
    /// The waveform of an envelope, repeated.
    Looped(Envelope),
}

impl Tone {
    fn envelope(&self) -> Result<Envelope, EffectsError> {
        match self {
            Self::Sine(frequency) => Envelope::sine(*frequency),
            Self::Once(envelope) | Self::Looped(envelope) => Ok(envelope.clone()),
        }
    }

    fn wave(&self, rate: f64) -> Result<Wave, EffectsError> {
        let envelope = self.envelope()?;
        if self.is_looped() { envelope.looped(rate) } else { envelope.sampled(rate) }
    }

    fn is_looped(&self) -> bool {
        !matches!(self, Self::Once(_))
    }
}

impl Hum {
    /// Refuses a waveform or fade that is out of range.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("fade of a hum", self.fade, limits::FADE)?;
        self.tone.envelope().map(|_| ())
    }

    /// Duration of the hum's waveform, in s.
    pub(super) fn sounding(&self) -> f64 {
        self.tone.envelope().map_or(0.0, |envelope| envelope.duration())
    }

    /// The function that starts it under a finger, with its waveform at `rate` samples per second.
    pub(super) fn maker(&self, rate: f64) -> Result<Maker, EffectsError> {
        let (hum, wave) = (self.clone(), self.tone.wave(rate)?);
        Ok(Box::new(move |_| Box::new(Humming { hum: hum.clone(), wave: wave.clone(), on: None })))
    }
}

struct Humming {
    hum: Hum,
    wave: Wave,
    /// The finger at its last touch event, and the last gain for which a cue was given.
    on: Option<(Moment, f64)>,
}

impl Humming {
    /// Adds a cue for the gain at a speed (m/s), if it changed by more than [`CHANGE`].
    fn follow(&mut self, at: f64, speed: f64, out: &mut Out) {
        let Some((_, told)) = &mut self.on else { return };
        let gain = self.hum.speed_gain.at(speed);
        if (gain - *told).abs() > CHANGE || (gain == 0.0 && *told != 0.0) {
            *told = gain;
            let gain = out.level.scaled(gain);
            out.push(0, at, Act::Gain { gain });
        }
    }
}

impl Play for Humming {
    fn enter(&mut self, now: &Moment, _touched: bool, out: &mut Out) {
        let gain = self.hum.speed_gain.at(now.speed_at(now.time));
        let (wave, looped) = (self.wave.clone(), self.hum.tone.is_looped());
        out.wave(0, now.time, now.at, Sounding { wave, gain, looped, fade: self.hum.fade });
        self.on = Some((*now, gain));
    }

    fn step(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        if from.at != to.at {
            out.push(0, to.time, Act::Move { place: to.at });
        }
        self.follow(to.time, to.speed_at(to.time), out);
        if let Some((last, _)) = &mut self.on {
            *last = *to;
        }
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        if self.on.take().is_some() {
            out.stop(0, now.time, self.hum.fade);
        }
    }

    fn due(&mut self, until: f64, out: &mut Out) {
        let Some((last, _)) = self.on else { return };
        // A finger that rests may send no touch events.
        let rest = last.time + limits::HOLD;
        if until > rest {
            self.follow(rest, 0.0, out);
        }
    }
}
