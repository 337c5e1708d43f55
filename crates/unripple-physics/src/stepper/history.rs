//! A ring buffer of past modal states.

use crate::PhysicsError;
use unripple_core::require;

/// The most recent modal states of a running surface, recorded at intervals of a fixed number of samples.
///
/// A state is stored in f32: displacement and velocity of each mode, in m·√kg and √J. The displacement at a point is the sum of modal
/// displacements times the mode shapes there ([`Plant::readout`](super::Plant::readout)).
#[derive(Clone, Debug)]
pub struct History {
    modes: usize,
    stride: usize,
    most: usize,
    /// Number of samples until the next state is recorded.
    wait: usize,
    /// Number of samples that the surface had processed when the newest state was recorded.
    newest: u64,
    /// Number of states recorded so far.
    count: u64,
    displacement: Vec<f32>,
    velocity: Vec<f32>,
}

impl History {
    /// A ring buffer for at most `most` states of `modes` modes, one recorded after every `stride` samples;
    /// `now` is the number of samples processed before the first interval.
    pub(super) fn new(modes: usize, stride: usize, most: usize, now: u64) -> Result<Self, PhysicsError> {
        require("samples from one state to the next", stride > 0, "at least 1", stride as f64)?;
        let room = (1..=1 << 20).contains(&most);
        require("states to be remembered", room, "between 1 and 1048576", most as f64)?;
        let zeros = vec![0.0; modes * most];
        let velocity = zeros.clone();
        Ok(Self { modes, stride, most, wait: stride, newest: now, count: 0, displacement: zeros, velocity })
    }

    /// Number of samples between one recorded state and the next.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Number of states that the buffer holds now.
    pub fn len(&self) -> usize {
        self.count.min(self.most as u64) as usize
    }

    /// Whether no state is stored yet.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Number of samples that the surface had processed when the newest state was recorded.
    pub fn newest(&self) -> u64 {
        self.newest
    }

    /// Displacement (m·√kg) and velocity (√J) of every mode in a recorded state: 0 for `back` is the newest
    /// state, 1 the one before it; `None` if the state is not stored.
    pub fn state(&self, back: usize) -> Option<(&[f32], &[f32])> {
        if back >= self.len() {
            return None;
        }
        let slot = ((self.count - 1 - back as u64) % self.most as u64) as usize * self.modes;
        Some((&self.displacement[slot..slot + self.modes], &self.velocity[slot..slot + self.modes]))
    }

    /// Number of samples until the next state is recorded.
    pub(super) fn wait(&self) -> usize {
        self.wait
    }

    /// Counts `frames` samples as processed, and records the given state if an interval is complete.
    pub(super) fn take(&mut self, frames: usize, displacement: &[f64], velocity: &[f64]) {
        self.wait -= frames.min(self.wait);
        if self.wait > 0 {
            return;
        }
        let slot = (self.count % self.most as u64) as usize * self.modes;
        let kept = self.displacement[slot..slot + self.modes].iter_mut().zip(displacement);
        kept.for_each(|(to, from)| *to = *from as f32);
        let kept = self.velocity[slot..slot + self.modes].iter_mut().zip(velocity);
        kept.for_each(|(to, from)| *to = *from as f32);
        self.count += 1;
        self.newest += self.stride as u64;
        self.wait = self.stride;
    }
}
