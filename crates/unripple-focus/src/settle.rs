//! Time until the free vibration of a surface has decayed.

use crate::schedule::MOST_SAMPLES;
use unripple_core::{Pole, Responses};

/// Number of samples until the slowest mode has decayed by `nepers`, or until sampled responses end; `None` for
/// modes that never decay so far.
pub(crate) fn settle(responses: &Responses, nepers: f64) -> Option<usize> {
    match responses {
        Responses::Modal(modal) => {
            let slowest = modal.poles.iter().map(slowest_decay).fold(f64::INFINITY, f64::min);
            let samples = nepers / slowest * modal.conditions.rate;
            (samples < MOST_SAMPLES as f64).then_some(samples.ceil() as usize)
        }
        Responses::Sampled(sampled) => Some(sampled.samples()),
    }
}

/// Decay rate of the slower of a mode's two exponentials, in 1/s.
fn slowest_decay(pole: &Pole) -> f64 {
    let square = (pole.sigma - pole.omega) * (pole.sigma + pole.omega);
    pole.sigma - square.max(0.0).sqrt()
}
