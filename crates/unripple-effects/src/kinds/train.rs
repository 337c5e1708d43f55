//! A train of pulses under a finger.

use crate::error::within;
use crate::play::{Beat, Maker, Moment, Out, Play};
use crate::{Act, Curve, EffectsError, limits};
use std::f64::consts::TAU;
use unripple_core::{Point, Random};

/// Pulses in time under a resting or moving finger.
#[derive(Clone, Debug, PartialEq)]
pub struct Train {
    /// Pulses per second.
    pub rate: f64,
    /// How many; without, as long as the finger is there.
    pub count: Option<u32>,
    /// Gain over the time since the touch, in s.
    pub envelope: Option<Curve>,
    /// How irregular they are: each comes later by up to this share of the period, and gains fall by up to this share.
    pub jitter: f64,
    /// How far from the finger they fall, evenly over the disc, in m.
    pub scatter: f64,
    /// Seed of the irregularity: the same gives the same pulses.
    pub seed: u64,
}

impl Train {
    /// Refuses a rate, count, curve or share that is not legal.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("rate of a pulse train", self.rate, limits::RATE)?;
        within("jitter of a pulse train", self.jitter, limits::SHARE)?;
        within("scatter of a pulse train", self.scatter, limits::SCATTER)?;
        let count = self.count.map_or(1.0, f64::from);
        within("count of a pulse train", count, [1.0, f64::from(limits::MOST_COUNT)])
    }

    /// Whether every pulse is like the one before, without end.
    fn is_steady(&self) -> bool {
        self.count.is_none() && self.envelope.is_none() && self.jitter == 0.0 && self.scatter == 0.0
    }

    /// What plays it under a finger.
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

/// A train without end is a comb, which the player repeats by itself.
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
    /// Where the finger is, and the next pulse.
    at: Option<(Point, Beat)>,
}

impl Beating {
    /// Shift in time, gain and place of one pulse, the same whenever asked.
    fn chance(&self, index: u64) -> (f64, f64, Point) {
        let mut random =
            Random::seeded(self.train.seed ^ self.contact.rotate_left(32) ^ index.rotate_left(48));
        let jitter = self.train.jitter;
        // Only later, by up to a period: pulses stay in order.
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
        // Also those that were cued ahead.
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
