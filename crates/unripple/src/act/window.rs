//! The focusing window that is used by default.

use crate::core::{Responses, Surface};
use crate::physics::design::{Recommended, Windows};

/// The default window, in seconds: the one that `unripple design` recommends for the surface, or the length of its
/// responses if that is shorter.
pub fn recommended_window(surface: &Surface, responses: &Responses) -> f64 {
    chosen_window(surface, responses).seconds
}

/// The default window, with the contrast to be expected and the reason for the choice. Computing it solves a coarse
/// model for the modes, so call it once.
///
/// See [`recommended_window`] for the window alone.
pub fn chosen_window(surface: &Surface, responses: &Responses) -> Recommended {
    chosen_among(&Windows::of(surface), responses)
}

/// The default window as [`chosen_window`] returns it, from `windows`: the contrast of the surface with
/// windows of several lengths, computed earlier.
pub fn chosen_among(windows: &Windows, responses: &Responses) -> Recommended {
    windows.recommended().within(lasting(responses), windows)
}

/// Length of the responses, in seconds, which is the longest window that they can be used with; infinite for modal
/// responses.
pub fn lasting(responses: &Responses) -> f64 {
    match responses {
        Responses::Modal(_) => f64::INFINITY,
        Responses::Sampled(sampled) => sampled.samples().saturating_sub(1) as f64 / sampled.conditions.rate,
    }
}
