//! What drives cost to compute and to evaluate, before anything is solved.

use super::{ActError, CELLS, JUDGED_BANDS, accuracy, judged_hz};
use crate::core::{Contact, Cost, Surface};
use crate::physics::design::expected_modes;
use crate::physics::{Medium, PhysicsError, ResponseOptions, response_cost};
use crate::plates::decay_rate;
use std::f64::consts::TAU;

/// Seconds of the contrasts with windows of several lengths, for each actuator and pair of modes.
const WINDOWS: f64 = 1e-7;

/// Seconds of reading a mode's shape at a point, as often as one evaluation does.
const READING: f64 = 1e-7;

/// Seconds of what is done with each sample of the field at a point: its peak, and how it is felt.
const SAMPLE: f64 = 8e-8;

/// Longest window that is assumed where losses are small, in s.
const LONGEST: f64 = 0.5;

/// Number of products of all shapes and samples that an evaluation takes: of velocity and of displacement, and of a coarser grid before.
const PRODUCTS: f64 = 2.0;

/// Memory for the motion of modes and for blocks of the field, in bytes.
const STATES: f64 = 1e8;

/// Speed of products in single precision, relative to double precision.
const SINGLE: f64 = 1.6;

/// The estimated cost of [`model`](super::model()).
///
/// # Errors
/// Those of [`model`](super::model()) that are known before solving.
pub fn model_cost(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Cost, ActError> {
    let contacts = contacts.to_vec();
    let options =
        ResponseOptions { max_hz, accuracy: accuracy(surface), contacts, ..ResponseOptions::default() };
    Ok(response_cost(surface, &options)?)
}

/// The estimated cost of [`windows`](super::windows()) on responses that are at hand.
pub fn window_cost(surface: &Surface) -> Cost {
    let modes = expected_modes(surface, surface.emission.band[1]);
    Cost { seconds: WINDOWS * modes * modes * surface.actuators.len() as f64, bytes: 0.0 }
}

/// The estimated cost of responses for evaluation and of evaluating `drives` on them, as far as the frequency `judge_hz` (Hz), or the default
/// one if that is within reach. Drives have a `window` in s, or the one that will be recommended, of which this assumes half of the decay time.
///
/// # Errors
/// Those of [`model`](super::model()) that are known before solving.
pub fn judging_cost(
    surface: &Surface,
    judge_hz: Option<f64>,
    contacts: &[Contact],
    window: Option<f64>,
    drives: usize,
) -> Result<Cost, ActError> {
    let top = judge_hz.unwrap_or_else(|| judged_hz(surface, JUDGED_BANDS));
    let (hz, model) = match model_cost(surface, Some(top), &[]) {
        // The modes of the band are at hand.
        Err(ActError::Physics(PhysicsError::TooLarge { .. })) if judge_hz.is_none() => {
            (surface.emission.band[1], Cost::default())
        }
        model => (top, model?),
    };
    let touched =
        if contacts.is_empty() { Cost::default() } else { model_cost(surface, Some(hz), contacts)? };
    let medium = Medium::of(&surface.sheet);
    let high = surface.emission.band[1];
    let cell = medium.lambda_min(high) / CELLS;
    let (modes, points) = (expected_modes(surface, hz), surface.outline.area() / (cell * cell));
    let wavenumber = medium.wavenumber(TAU * high);
    let rate = decay_rate(&surface.sheet.decay, TAU * high, medium.bending_share(wavenumber));
    let samples = 2.0 * window.unwrap_or((0.5 / rate).min(LONGEST)) * surface.emission.rate;
    let each = PRODUCTS * 2.0 * modes * points * samples / (SINGLE * Cost::RATE) + SAMPLE * points * samples;
    let bytes = STATES + 12.0 * points * modes;
    Ok(model + touched + Cost { seconds: drives as f64 * each + READING * points * modes, bytes })
}
