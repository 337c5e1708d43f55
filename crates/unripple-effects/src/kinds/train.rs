//! Pulse train: pulses at a rate in time under a finger.

use crate::error::within;
use crate::play::{Beat, Maker, Moment, Out, Play};
use crate::{Act, Curve, EffectsError, limits};
use std::f64::consts::TAU;
use unripple_core::{Point, Random};

/// A pulse train: pulses at a fixed rate in time under a resting or moving finger.
#[derive(Clone, Debug, PartialEq)]
pub struct Train {
    /// Pulses per second.
    pub rate: f64,
    /// Number of pulses; `None` for pulses as long as the finger is in the region.
    pub count: Option<u32>,
    /// Gain as a function of the time in s since the finger entered the region; `None` for a constant gain of 1.
    pub envelope: Option<Curve>,
    /// Random variation, 0 to 1: each pulse is delayed by up to this share of the period, and its gain reduced by up to this share.
    pub jitter: f64,
    /// Radius of the disc around the finger, in m, over which the places of pulses are uniformly distributed.
    pub scatter: f64,
    /// Seed of the random variation: the same seed and touches give the same pulses.
    pub seed: u64,
}

impl Train {
    /// Refuses a rate, count or share that is out of range.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("rate of a pulse train", self.rate, limits::RATE)?;
        within("jitter of a pulse train", self.jitter, limits::SHARE)?;
        within("scatter of a pulse train", self.scatter, limits::SCATTER)?;
        let count = self.count.map_or(1.0, f64::from);
        within("count of a pulse train", count, [1.0, f64::from(limits::MOST_COUNT)])
    }

    /// Whether the train is periodic without end or variation.
    fn is_steady(&self) -> bool {
        self.count.is_none() && self.envelope.is_none() && self.jitter == 0.0 && self.scatter == 0.0
    }

    /// The function that starts it under a finger.
    pub(super) fn maker(&self) -> Maker {
        let train = self.clone();
        Box::new(move |contact| {
            if train.is_steady() {
                Box::new(Steady { rate: train.rate })
            } else {
                Box::new(Beating { train: train.clone(), contact, start: 0.0, at: None })
            }
        })
    }
}

/// A train without end or variation: one comb, which the player repeats by itself.
struct Steady {
    rate: f64,
}

impl Play for Steady {
    fn enter(&mut self, now: &Moment, _touched: bool, out: &mut Out) {
        out.push(0, now.time, Act::Comb { place: now.at, rate: self.rate, gain: out.level });
    }

    fn step(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        if from.at != to.at {
            out.push(0, to.time, Act::Move { place: to.at });
        }
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        out.stop(0, now.time, 0.0);
    }
}

struct Beating {
    train: Train,
    contact: u64,
    start: f64,
    /// The place of the finger, and the times of the pulses.
    at: Option<(Point, Beat)>,
}

impl Beating {
    /// Random delay (s), gain and offset (m) of the pulse of this number, the same at every call.
    fn chance(&self, index: u64) -> (f64, f64, Point) {
        let mut random =
            Random::seeded(self.train.seed ^ self.contact.rotate_left(32) ^ index.rotate_left(48));
        let jitter = self.train.jitter;
        // Delays of up to one period keep the pulses in order.
        let shift = jitter * random.uniform() / self.train.rate;
        let gain = 1.0 - jitter * random.uniform();
        let (radius, angle) = (self.train.scatter * random.uniform().sqrt(), TAU * random.uniform());
        (shift, gain, Point::new(radius * angle.cos(), radius * angle.sin()))
    }
}

impl Play for Beating {
    fn enter(&mut self, now: &Moment, _touched: bool, _out: &mut Out) {
        self.start = now.time;
        self.at = Some((now.at, Beat::new(now.time, 1.0 / self.train.rate)));
    }

    fn step(&mut self, _from: &Moment, to: &Moment, _out: &mut Out) {
        if let Some((place, _)) = &mut self.at {
            *place = to.at;
        }
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        // This also cancels pulses that were cued ahead.
        if self.at.take().is_some() {
            out.stop(0, now.time, 0.0);
        }
    }

    fn due(&mut self, until: f64, out: &mut Out) {
        let Some((place, mut beat)) = self.at else { return };
        while !out.is_full() {
            let Some((index, time)) = beat.next(until) else { break };
            if self.train.count.is_some_and(|count| index >= u64::from(count)) {
                break;
            }
            let (shift, gain, off) = self.chance(index);
            let drawn = self.train.envelope.as_ref().map_or(1.0, |curve| curve.at(time - self.start));
            out.pulse(time + shift, Point::new(place.x + off.x, place.y + off.y), gain * drawn);
        }
        self.at = Some((place, beat));
    }
}
