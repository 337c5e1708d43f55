//! The focusing window that is used by default.

use crate::core::{ModalResponses, Pole, Responses, Surface};
use crate::physics::design::{Recommended, Windows};
use std::f64::consts::TAU;

/// The default window, in seconds: the one that `unripple design` recommends for the surface, or the length of its
/// responses if that is shorter.
pub fn recommended_window(surface: &Surface, responses: &Responses) -> f64 {
    chosen_window(surface, responses).seconds
}

/// The default window, with the contrast to be expected and the reason for the choice. Where the responses are measured, it solves for
/// the modes of the surface, so call it once.
///
/// See [`recommended_window`] for the window alone.
pub fn chosen_window(surface: &Surface, responses: &Responses) -> Recommended {
    chosen_among(&windows(surface, responses), responses)
}

/// The contrast of a surface with windows of several lengths, from its responses without fingers where these are of the modes of its band;
/// else, as for measured responses, from those that it computes.
pub fn windows(surface: &Surface, responses: &Responses) -> Windows {
    let own = |modal: &ModalResponses| {
        let top = TAU * surface.emission.band[1];
        // Real poles, which do not oscillate, may lie anywhere.
        let within = |pole: &Pole| pole.omega <= top * (1.0 + 1e-9) || pole.sigma >= pole.omega;
        let same =
            modal.ports.len() == surface.actuators.len() && modal.conditions.band == surface.emission.band;
        same && modal.poles.iter().all(within)
    };
    match responses {
        Responses::Modal(modal) if own(modal) => Windows::on(surface, responses),
        _ => Windows::of(surface),
    }
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
