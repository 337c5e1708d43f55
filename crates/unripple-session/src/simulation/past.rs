//! Past states of the surface, as displacement or velocity.

use super::lens::product;
use unripple::core::Surface;
use unripple::physics::stepper::History;

/// States that are remembered per period of the highest frequency. Two are the least by sampling theory; four leave a
/// trace smooth. Twice as many take twice the memory.
const STATES: f64 = 4.0;

/// Largest memory for the stored states of a surface, in bytes: enough for one second of 2800 modes at
/// frequencies up to 3 kHz. Twice as much holds twice the time or twice as many modes.
pub const MOST_BYTES: usize = 256 << 20;

/// Number of states of `modes` modes that fit in [`MOST_BYTES`]: each has a displacement and a velocity of four bytes for every mode.
pub fn room(modes: usize) -> usize {
    MOST_BYTES / (8 * modes.max(1))
}

/// Interval of the stored states of a surface, in samples.
pub fn stride(surface: &Surface) -> usize {
    (surface.emission.rate / (STATES * surface.emission.band[1])).floor().max(1.0) as usize
}

/// Reader of the stored states of a surface, as displacement or as velocity.
pub struct Past<'a> {
    /// The stored states of the modes.
    pub history: &'a History,
    /// Samples per second.
    pub rate: f64,
    /// Whether states are read as velocity rather than displacement.
    pub velocity: bool,
}

impl Past<'_> {
    /// Number of the stored state nearest to a time (s), counted back from the newest; that of the oldest if the time
    /// lies before it.
    pub fn back(&self, time: f64) -> usize {
        let samples = (self.history.newest() as f64 - time * self.rate).max(0.0);
        let states = (samples / self.history.stride() as f64).round() as usize;
        states.min(self.history.len().saturating_sub(1))
    }

    /// State of the modes at index `back` from the newest: one value per mode; `None` if it is not stored.
    pub fn state(&self, back: usize) -> Option<&[f32]> {
        let (displacement, velocity) = self.history.state(back)?;
        Some(if self.velocity { velocity } else { displacement })
    }

    /// Number of stored states in the time span of `seconds` that ends with the state at index `back`, that state
    /// included.
    pub fn span(&self, back: usize, seconds: f64) -> usize {
        let states = (seconds * self.rate / self.history.stride() as f64) as usize;
        states.min(self.history.len() - back)
    }

    /// Motion of a place with these readout weights, over `span` states up to the one at index `back`, in m or m/s.
    pub fn trace(&self, weights: &[f32], back: usize, span: usize) -> Vec<f32> {
        let states = (back..back + span).rev().filter_map(|back| self.state(back));
        states.map(|state| product(weights, state)).collect()
    }
}
