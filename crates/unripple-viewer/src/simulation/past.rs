//! Past states of the surface, as displacement or velocity.

use super::lens::product;
use unripple::core::Surface;
use unripple::physics::stepper::History;

/// States that are remembered per period of the highest frequency. Two are the least by sampling theory; four leave a
/// trace smooth. Twice as many take twice the memory.
const STATES: f64 = 4.0;

/// Samples from one state that is remembered of a surface to the next.
pub fn stride(surface: &Surface) -> usize {
    (surface.emission.rate / (STATES * surface.emission.band[1])).floor().max(1.0) as usize
}

/// Past states of a surface, as displacement or as velocity.
pub struct Past<'a> {
    /// The states that are remembered.
    pub history: &'a History,
    /// Samples per second.
    pub rate: f64,
    /// Whether velocity is looked at.
    pub velocity: bool,
}

impl Past<'_> {
    /// The state nearest to a time (s), counted back from the newest; the oldest where it is forgotten.
    pub fn back(&self, time: f64) -> usize {
        let samples = (self.history.newest() as f64 - time * self.rate).max(0.0);
        let states = (samples / self.history.stride() as f64).round() as usize;
        states.min(self.history.len().saturating_sub(1))
    }

    /// The modes so many states before the newest.
    pub fn state(&self, back: usize) -> Option<&[f32]> {
        let (displacement, velocity) = self.history.state(back)?;
        Some(if self.velocity { velocity } else { displacement })
    }

    /// States that there are within `seconds` before the one so far back, itself included.
    pub fn span(&self, back: usize, seconds: f64) -> usize {
        let states = (seconds * self.rate / self.history.stride() as f64) as usize;
        states.min(self.history.len() - back)
    }

    /// What a place that reads the modes by `weights` did over so many states up to the one so far back.
    pub fn trace(&self, weights: &[f32], back: usize, span: usize) -> Vec<f32> {
        let states = (back..back + span).rev().filter_map(|back| self.state(back));
        states.map(|state| product(weights, state)).collect()
    }
}
