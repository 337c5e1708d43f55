//! Bounds of the errors of impulse responses: by the errors of the modes, and by modes above the band.

use crate::Medium;
use std::f64::consts::{PI, TAU};
use unripple_core::{ActuatorKind, ModalResponses, ModeError, Pole, Surface};
use unripple_linalg::Mat;

/// Modes above the band are counted up to this multiple of the number in the band, and this many more: beyond, a mode moves within the band
/// as the inverse square of its frequency, and all of them by a few per cent of those counted. With twice this value, a per cent.
const COUNTED: (usize, usize) = (20, 500);

/// Safety factor of the share of modes above the band: where they lie is known on average alone, and actuators excite each of them more or
/// less. For bands that end between modes, what is true lies between 0.5 and 1.8 times the average.
const SAFETY: f64 = 2.0;

/// Modes that may lie right above the band, so that half of the resonance of each is within: two, as on sheets with a symmetry. With twice
/// this value, the share of a band of ten modes is a third larger.
const AT_THE_TOP: f64 = 2.0;

/// A bound of the relative error of impulse responses within their band, root mean square over the first `seconds` (s), over all points of
/// the sheet and all actuators together; `None` if the errors of the modes are not known (with loads, in measured responses) or if nothing
/// moves.
///
/// Oscillations with a relative error ε of their frequency and δ of their decay time drift apart as εωt and δσt, each weighed with its
/// decay, and shapes are wrong at both places. These parts are added for each mode; modes, whose errors differ, add as squares. Modes
/// above the band are not in the responses: see [`left_out`].
///
/// The peak at a focus of time reversal, the sum of products of response and drive, has at most the same relative error.
///
/// ```
/// use unripple_core::{Edge, Edges, Responses};
/// use unripple_physics::{ResponseOptions, design::papers_surface, left_out, response_error, responses};
///
/// let mut film = papers_surface();
/// film.emission.band = [0.0, 1000.0];
/// let Responses::Modal(clamped) = responses(&film, &ResponseOptions::default())? else { unreachable!() };
/// let error = response_error(&clamped, 0.03).unwrap();
/// assert!(error > 1e-6 && error < 1e-2);
/// // Supported, its modes are exact, but those above the band are left out as well.
/// film.outline.edges = Edges::All(Edge::Supported);
/// let Responses::Modal(exact) = responses(&film, &ResponseOptions::default())? else { unreachable!() };
/// assert_eq!(response_error(&exact, 0.03), Some(0.0));
/// assert!(left_out(&film, &exact, 0.03).is_some_and(|share| share > 0.05 && share < 0.5));
/// # Ok::<(), unripple_physics::PhysicsError>(())
/// ```
pub fn response_error(responses: &ModalResponses, seconds: f64) -> Option<f64> {
    let ModalResponses { poles, input, conditions, mode_errors, .. } = responses;
    if mode_errors.len() != poles.len() {
        return None;
    }
    let inside = poles.partition_point(|pole| pole.omega <= TAU * conditions.band[1]);
    let (mut wrong, mut all) = (0.0, 0.0);
    for (m, (pole, error)) in poles.iter().zip(mode_errors).enumerate().take(inside) {
        let weight = weight(input, m);
        let [length, spread] = moments(pole.sigma, seconds);
        wrong += weight * deviation(pole, *error, [length, spread])?.powi(2);
        all += weight * length;
    }
    let error = (wrong / all).sqrt();
    error.is_finite().then_some(error)
}

/// A bound of the share of the modes above the band, root mean square within the band, in the motion that forces cause: modes that are
/// left out of responses, which respond almost as springs there. As in [`response_error()`], it is relative to the responses in the band
/// in the first `seconds` (s) and means all points and actuators together. `None` unless the sheet is uniform, all actuators are forces,
/// no resonator stands on it, and something moves.
///
/// Modes above are as many as Weyl's law says: S k²/4π below the wavenumber k on an area S. Each has the mean square weight of those in the
/// band, and the mobility jω/(ω_n² - ω²) there. Two more may lie right above the band, where it may end just under modes.
pub fn left_out(surface: &Surface, responses: &ModalResponses, seconds: f64) -> Option<f64> {
    let ModalResponses { poles, input, conditions, .. } = responses;
    let forces = surface.actuators.iter().all(|actuator| actuator.kind == ActuatorKind::Force);
    let uneven = &surface.sheet.uneven;
    if !forces || !uneven.is_uniform() || uneven.resonates() {
        return None;
    }
    let (medium, area) = (Medium::of(&surface.sheet), surface.outline.area());
    let top = TAU * conditions.band[1];
    let inside = poles.partition_point(|pole| pole.omega <= top);
    let last = poles[..inside].last()?;
    let weights = || (0..inside).map(move |m| weight(input, m));
    let within: f64 =
        weights().zip(poles).map(|(weight, pole)| 0.5 * weight * moments(pole.sigma, seconds)[0]).sum();
    let mean = weights().sum::<f64>() / inside as f64;
    let highest = medium.wavenumber(top);
    let each = |n: usize| {
        let k = (highest * highest + 4.0 * PI * (n as f64 + 0.5) / area).sqrt();
        // Nearer than its own width it moves no more.
        let omega = medium.omega(k).max(top + last.sigma);
        let apart = 0.5 * top / ((omega - top) * (omega + top));
        apart - 0.25 / omega * ((omega + top) / (omega - top)).ln()
    };
    let above: f64 = (0..COUNTED.0 * inside + COUNTED.1).map(each).sum();
    // Half of the integral π/4σ over a resonance; as much of it as rings in the time.
    let halves = AT_THE_TOP * PI / 4.0 * moments(last.sigma, seconds)[0];
    let share = SAFETY * (mean * (above + halves) / PI / within).sqrt();
    share.is_finite().then_some(share)
}

/// The sum of the squared weights of a mode over all actuators.
fn weight(input: &Mat<f64>, mode: usize) -> f64 {
    input.col(mode).iter().map(|weight| weight * weight).sum()
}

/// ∫e^{-2σt} and ∫t² e^{-2σt} over the first `seconds`, in s and s³.
fn moments(sigma: f64, seconds: f64) -> [f64; 2] {
    let (a, x) = (2.0 * sigma, 2.0 * sigma * seconds);
    if x < SHORT {
        return [seconds * (1.0 - 0.5 * x), seconds.powi(3) * (1.0 / 3.0 - 0.25 * x)];
    }
    [-(-x).exp_m1() / a, (2.0 - (-x).exp() * (2.0 + x * (2.0 + x))) / a.powi(3)]
}

/// Below, two terms of a series are used in place of differences of nearly equal numbers. With ten times this value, they would be wrong by
/// three in 1e5.
const SHORT: f64 = 1e-3;

/// Root of the integral of the squared deviation of one mode's envelope, from [`moments`], in √s; `None` if its decay is not known.
fn deviation(pole: &Pole, error: ModeError, [length, spread]: [f64; 2]) -> Option<f64> {
    // Oscillations that have drifted apart differ by no more than twice their amplitude.
    let drift = (pole.omega * error.frequency * spread.sqrt()).min(2.0 * length.sqrt());
    let decay = if pole.sigma > 0.0 { error.decay? * pole.sigma * spread.sqrt() } else { 0.0 };
    Some(drift + decay + 2.0 * error.shape * length.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deviation of one oscillation from another, by the rectangle rule.
    fn apart(wrong: Pole, exact: Pole, seconds: f64) -> [f64; 2] {
        let steps = 20_000;
        let dt = seconds / f64::from(steps);
        (0..steps).fold([0.0; 2], |[difference, all], i| {
            let t = (f64::from(i) + 0.5) * dt;
            let (a, b) = (wrong.velocity(t), exact.velocity(t));
            [difference + (a - b) * (a - b) * dt, all + b * b * dt]
        })
    }

    #[test]
    fn oscillations_deviate_as_they_drift_apart() {
        let exact = Pole::new(TAU * 1000.0, 20.0);
        for (frequency, decay, seconds) in
            [(1e-4, 0.0, 0.1), (0.0, 1e-2, 0.1), (1e-4, 0.0, 0.004), (1e-3, 1e-3, 0.05), (0.5, 0.0, 0.1)]
        {
            let wrong = Pole::new(exact.omega * (1.0 + frequency), exact.sigma * (1.0 + decay));
            let [difference, all] = apart(wrong, exact, seconds);
            let error = ModeError { frequency, decay: Some(decay), shape: 0.0 };
            let [length, spread] = moments(exact.sigma, seconds);
            let bound = deviation(&exact, error, [length, spread]).unwrap() / length.sqrt();
            let found = (difference / all).sqrt();
            assert!(found < 1.01 * bound && bound < 1.6 * found, "{frequency} {decay}: {found:e} {bound:e}");
        }
    }

    #[test]
    fn moments_join_their_series() {
        let [short, long] = [0.999, 1.001].map(|x| moments(0.5 * x * SHORT / 0.02, 0.02));
        for (i, (short, long)) in short.into_iter().zip(long).enumerate() {
            assert!((short / long - 1.0).abs() < 1e-5, "{i}: {short:e} {long:e}");
        }
        assert_eq!(moments(0.0, 3.0), [3.0, 9.0]);
    }

    #[test]
    fn what_decays_in_an_unknown_time_has_an_unknown_error() {
        let error = ModeError { frequency: 1e-3, decay: None, shape: 0.0 };
        assert_eq!(deviation(&Pole::new(1e3, 1.0), error, [1.0; 2]), None);
        assert!(deviation(&Pole::new(1e3, 0.0), error, [1.0; 2]).is_some());
    }
}
