//! The focusing window that is taken where none is asked for.

use crate::core::{Responses, Surface};
use crate::physics::design::{Recommended, Windows};

/// The window that is taken where none is asked for, in seconds: the one that `unripple design` recommends for the surface, or the
/// longest that its responses last.
pub fn recommended_window(surface: &Surface, responses: &Responses) -> f64 {
    chosen_window(surface, responses).seconds
}

/// The recommended window, with what is to be expected of it and why it is that. It takes a coarse solution for the
/// modes: to be asked for once.
///
/// It takes a coarse solution for the modes: to be asked for once.
pub fn chosen_window(surface: &Surface, responses: &Responses) -> Recommended {
    let windows = Windows::of(surface);
    windows.recommended().within(lasting(responses), &windows)
}

/// How long responses last, in seconds: the longest window that they serve.
pub fn lasting(responses: &Responses) -> f64 {
    match responses {
        Responses::Modal(_) => f64::INFINITY,
        Responses::Sampled(sampled) => sampled.samples().saturating_sub(1) as f64 / sampled.conditions.rate,
    }
}
