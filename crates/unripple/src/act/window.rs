use crate::core::{Responses, Surface};
use crate::physics::design;

/// The window that is taken where none is asked for, in seconds: the one recommended for the surface, with its modes as
/// counted, or the longest that its responses last.
pub fn recommended_window(surface: &Surface, responses: &Responses) -> f64 {
    let (modes, longest) = match responses {
        Responses::Modal(modal) => (Some(modal.poles.len()), f64::INFINITY),
        Responses::Sampled(sampled) => {
            (None, sampled.samples().saturating_sub(1) as f64 / sampled.conditions.rate)
        }
    };
    design::recommended_window(surface, modes).min(longest)
}
