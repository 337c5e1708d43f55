//! The part of live play outside the audio thread: touches, effects, what fingers feel.

use crate::pinging::Pinging;
use crate::touch_input::TouchBatch;
use crate::{Conductor, Follower, LiveError, Percentiles};
use unripple_calibrate::Drift;
use unripple_core::clock::Instant;
use unripple_core::{Phase, Point, Touch};
use unripple_devices::{Feeler, Feeling};
use unripple_touch::{Counts, Heard};

/// Function that is called with new touches and requests, and with the time at which they came, in s of the
/// device's clock.
pub type Listener = Box<dyn FnMut(f64, &Heard) + Send>;

/// The part of live play outside the audio thread: touches, effects, what fingers feel, drift of the tension.
pub struct Stage {
    pub(crate) conductor: Conductor,
    pub(crate) feeler: Option<Feeler>,
    pub(crate) follower: Option<Follower>,
    /// The latest estimate of the tension.
    pub(crate) drift: Option<Drift>,
    pub(crate) pinging: Option<Pinging>,
    pub(crate) listener: Option<Listener>,
    pub(crate) rate: f64,
    /// Samples that the device takes at a time.
    pub(crate) block: usize,
    pub(crate) heard: Heard,
    pub(crate) fingers: Vec<(u64, Point)>,
    pub(crate) counts: Counts,
    pub(crate) computing: Percentiles,
    pub(crate) clock: u64,
}

impl Stage {
    /// Processes new touches and requests.
    pub(crate) fn take(&mut self, batch: TouchBatch) -> Result<(), LiveError> {
        if let Some(listener) = &mut self.listener {
            listener(batch.now, &batch.heard);
        }
        if let Some(feeler) = &mut self.feeler {
            batch.heard.touches.iter().try_for_each(|touch| feeler.touch(touch))?;
        }
        (self.fingers, self.counts) = (batch.fingers, batch.counts);
        let old = self.heard.touches.len();
        batch.aimed.into_iter().for_each(|touch| self.put(touch, old));
        self.heard.wishes.extend(batch.heard.wishes);
        Ok(())
    }

    /// Adds a touch to be played. Of the moves of a finger that there was no time for, the `old` touches, only the
    /// last is worth playing.
    fn put(&mut self, touch: Touch, old: usize) {
        let before =
            self.heard.touches.iter_mut().enumerate().rev().find(|(_, was)| was.finger == touch.finger);
        match before {
            Some((at, was)) if at < old && touch.phase == Phase::Move && was.phase == Phase::Move => {
                *was = touch
            }
            _ => self.heard.touches.push(touch),
        }
    }

    /// Plays the effects of touches and requests.
    pub(crate) fn conduct(&mut self, now: u64, until: u64) -> Result<(), LiveError> {
        if let Some(feeler) = &mut self.feeler {
            feeler.follow()?;
        }
        let began = Instant::now();
        self.conductor.step(&self.heard, now, until)?;
        if let Some(pinging) = &mut self.pinging {
            pinging.step(now, !self.fingers.is_empty(), &mut self.conductor);
        }
        if !self.heard.touches.is_empty() {
            self.computing.add(began.elapsed().as_secs_f64());
        }
        self.heard.clear();
        Ok(())
    }

    /// What every finger felt since the last call. Empty on a real surface, where it is unknown.
    pub fn feelings(&mut self) -> Vec<Feeling> {
        self.feeler.as_mut().map_or_else(Vec::new, Feeler::look)
    }

    /// Whether what fingers feel is computed, which is possible only on a virtual surface.
    pub fn tells_feelings(&self) -> bool {
        self.feeler.is_some()
    }

    /// Numbers of the fingers on the surface, and their places in m.
    pub fn fingers(&self) -> Vec<(u64, Point)> {
        self.fingers.clone()
    }

    /// The conductor, which turns touches into commands, with its counts.
    pub fn conductor(&self) -> &Conductor {
        &self.conductor
    }

    /// Mutable access to the conductor.
    pub fn conductor_mut(&mut self) -> &mut Conductor {
        &mut self.conductor
    }

    /// Counts of what all sources of touches accepted and refused, as far as they have reported.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The latest estimate of the tension; `None` before the first observation.
    pub fn drift(&self) -> Option<&Drift> {
        self.drift.as_ref()
    }

    /// Times from touches to commands sent, in s, one for each step in which there were touches.
    pub fn computing(&self) -> &Percentiles {
        &self.computing
    }

    /// Duration played so far, in s.
    pub fn time(&self) -> f64 {
        self.clock as f64 / self.rate
    }

    /// Gives a block to the follower of tension, and changes to new drives if the tension has changed.
    pub(crate) fn follow(&mut self, drive: &[f32], heard: &[f32]) -> Result<(), LiveError> {
        let Some(follower) = &mut self.follower else { return Ok(()) };
        follower.take(drive, heard, self.block, !self.fingers.is_empty());
        let maker = follower.observe()?;
        self.drift = follower.last().copied();
        match maker {
            Some(maker) => self.conductor.renew(maker, self.clock),
            None => Ok(()),
        }
    }
}
