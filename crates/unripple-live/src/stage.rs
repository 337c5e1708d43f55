use crate::pinging::Pinging;
use crate::{Conductor, Feeler, Feeling, Follower, LiveError, Percentiles};
use std::time::Instant;
use unripple_calibrate::Drift;
use unripple_core::{Phase, Point};
use unripple_touch::{Heard, Sources};

/// Who is told of all that is heard, and when (s of the device's clock).
pub type Listener = Box<dyn FnMut(f64, &Heard) + Send>;

/// All of a surface being played that is not the audio thread's: who touches it, what that sets off, what it does to the fingers.
pub struct Stage {
    pub(crate) conductor: Conductor,
    pub(crate) sources: Sources,
    pub(crate) feeler: Option<Feeler>,
    pub(crate) follower: Option<Follower>,
    /// What following said last.
    pub(crate) drift: Option<Drift>,
    pub(crate) pinging: Option<Pinging>,
    pub(crate) listener: Option<Listener>,
    pub(crate) rate: f64,
    pub(crate) block: usize,
    pub(crate) window: f64,
    pub(crate) predict: bool,
    pub(crate) heard: Heard,
    pub(crate) computing: Percentiles,
    pub(crate) clock: u64,
}

impl Stage {
    /// Hears all touches up to the clock.
    pub(crate) fn listen(&mut self) -> Result<(), LiveError> {
        self.heard.clear();
        let now = self.clock as f64 / self.rate;
        self.sources.poll(now, &mut self.heard);
        if let Some(listener) = &mut self.listener {
            listener(now, &self.heard);
        }
        if let Some(feeler) = &mut self.feeler {
            self.heard.touches.iter().try_for_each(|touch| feeler.touch(touch))?;
            feeler.follow()?;
        }
        if self.predict {
            for touch in self.heard.touches.iter_mut().filter(|touch| touch.phase == Phase::Move) {
                let there = self.sources.predict(touch.finger, now, self.window);
                touch.at = there.unwrap_or(touch.at);
            }
        }
        Ok(())
    }

    /// Plays what was heard.
    pub(crate) fn conduct(&mut self, now: u64, until: u64) -> Result<(), LiveError> {
        let began = Instant::now();
        self.conductor.step(&self.heard, now, until)?;
        if let Some(pinging) = &mut self.pinging {
            pinging.step(now, self.sources.fingers().next().is_some(), &mut self.conductor);
        }
        if !self.heard.touches.is_empty() {
            self.computing.add(began.elapsed().as_secs_f64());
        }
        Ok(())
    }

    /// What every finger felt since the last look; nothing on a surface that cannot tell.
    pub fn feelings(&mut self) -> Vec<Feeling> {
        self.feeler.as_mut().map_or_else(Vec::new, Feeler::look)
    }

    /// Where fingers are.
    pub fn fingers(&self) -> Vec<(u64, Point)> {
        self.sources.fingers().map(|(finger, motion)| (finger, motion.at())).collect()
    }

    /// What turns touches into commands, and what became of them.
    pub fn conductor(&self) -> &Conductor {
        &self.conductor
    }

    /// The same, to be told what to keep.
    pub fn conductor_mut(&mut self) -> &mut Conductor {
        &mut self.conductor
    }

    /// Where touches come from.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// What following the tension said last.
    pub fn drift(&self) -> Option<&Drift> {
        self.drift.as_ref()
    }

    /// Time from touches to commands sent, of each step in which there were touches, in s.
    pub fn computing(&self) -> &Percentiles {
        &self.computing
    }

    /// Seconds played.
    pub fn time(&self) -> f64 {
        self.clock as f64 / self.rate
    }

    /// Follows tension by a block, and goes over to drives for the surface as it is.
    pub(crate) fn follow(&mut self, drive: &[f32], heard: &[f32]) -> Result<(), LiveError> {
        let Some(follower) = &mut self.follower else { return Ok(()) };
        let touched = self.sources.fingers().next().is_some();
        follower.take(drive, heard, self.block, touched);
        let maker = follower.observe()?;
        self.drift = follower.last().copied();
        match maker {
            Some(maker) => self.conductor.renew(maker, self.clock),
            None => Ok(()),
        }
    }
}
