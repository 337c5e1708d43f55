//! A ring of past modal states.

use crate::PhysicsError;
use unripple_core::require;

/// The states of the modes that a surface has gone through lately, one after every so many samples.
///
/// A state is kept in f32: displacement and velocity of each mode, in m·√kg and √J. Displacement anywhere is its product with what a
/// point reads of the modes ([`Plant::footing`](super::Plant::footing)).
#[derive(Clone, Debug)]
pub struct History {
    modes: usize,
    stride: usize,
    most: usize,
    /// Samples until the next state is kept.
    wait: usize,
    /// Sample after which the newest state was taken.
    newest: u64,
    /// States ever kept.
    count: u64,
    displacement: Vec<f32>,
    velocity: Vec<f32>,
}

impl History {
    /// A ring of `most` states of so many modes, one after every `stride` samples, begun at sample `now`.
    pub(super) fn new(modes: usize, stride: usize, most: usize, now: u64) -> Result<Self, PhysicsError> {
        require("samples from one state to the next", stride > 0, "at least 1", stride as f64)?;
        let room = (1..=1 << 20).contains(&most);
        require("states to be remembered", room, "between 1 and 1048576", most as f64)?;
        let zeros = vec![0.0; modes * most];
        let velocity = zeros.clone();
        Ok(Self { modes, stride, most, wait: stride, newest: now, count: 0, displacement: zeros, velocity })
    }

    /// Number of samples from each state to the next.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Number of states that can be read.
    pub fn len(&self) -> usize {
        self.count.min(self.most as u64) as usize
    }

    /// Whether there is none yet.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Number of samples that the surface had taken in at the newest state.
    pub fn newest(&self) -> u64 {
        self.newest
    }

    /// Displacement (m·√kg) and velocity (√J) of every mode, `back` states before the newest; `None` beyond
    /// what is remembered.
    pub fn state(&self, back: usize) -> Option<(&[f32], &[f32])> {
        if back >= self.len() {
            return None;
        }
        let slot = ((self.count - 1 - back as u64) % self.most as u64) as usize * self.modes;
        Some((&self.displacement[slot..slot + self.modes], &self.velocity[slot..slot + self.modes]))
    }

    /// Number of samples that may pass until a state is due.
    pub(super) fn wait(&self) -> usize {
        self.wait
    }

    /// Takes in a state `frames` samples after the last, and keeps it if it is due.
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
