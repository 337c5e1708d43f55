//! Size of the focus in space and time, compared with the closed forms.

use super::contrast::{mean, over};
use super::{ContrastModel, Sampling};
use std::f64::consts::TAU;
use unripple_core::{Point, Surface, window_samples};
use unripple_linalg::{ColRef, Mat, MatRef, product, times_column};
use unripple_physics::design::{Cavity, closed};

/// Directions in which a spot is measured, 22.5 degrees apart; their mean changes little with more.
const DIRECTIONS: usize = 16;

/// Number of radii at which a spot is measured, and the largest radius in shortest wavelengths.
const RADII: usize = 40;
const REACH: f64 = 1.0;

/// Simulated size of a focus in space and time, with the predictions of the closed forms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Mean full width of the foci at half maximum in space, in metres.
    pub spot_diameter_m: f64,
    /// Spot diameter by [`closed::spot_diameter`], in metres.
    pub spot_predicted_m: f64,
    /// Mean full width of the foci at half maximum in time, in seconds.
    pub pulse_duration_s: f64,
    /// Pulse duration by [`closed::pulse_duration`], in seconds.
    pub pulse_predicted_s: f64,
}

/// Size of foci in space (m) and time (s) for a number of actuators and a window (s), averaged over placements and
/// targets. Foci that do not fall to half within a shortest wavelength, or within a period of the top of the band, are
/// left out.
pub fn size(
    model: &ContrastModel,
    surface: &Surface,
    (actuators, window): (usize, f64),
    sampling: &Sampling,
) -> Size {
    let replay = model.once(window);
    let lag = window_samples(1.0 / model.conditions().band[1], model.conditions().rate);
    let rings = model.rings(window + lag as f64 / model.conditions().rate);
    let found = over(model, actuators, sampling, |_, draw, inputs| {
        let sizes = |target: &Point| {
            let outside = model.outside(*target);
            let states = model.states(&replay, inputs, &outside);
            let spot = spot(model, *target, states.col(actuators.saturating_sub(1)));
            let shapes = model.shapes_at(&[*target]);
            vec![spot, pulse(model, inputs, shapes.as_ref(), rings.as_ref(), lag)]
        };
        draw.targets.iter().map(sizes).collect()
    });
    let average = |i: usize| mean(found.iter().map(|row| row[i]).filter(|width| width.is_finite()));
    let [low, top] = surface.emission.band;
    let growth = Cavity::of(surface, top).growth();
    Size {
        spot_diameter_m: average(0),
        spot_predicted_m: closed::spot_diameter(model.conditions().lambda_min),
        pulse_duration_s: average(1),
        pulse_predicted_s: closed::pulse_duration(top - low, growth),
    }
}

/// Twice the mean radius at which a state falls to half, over all directions, in metres.
fn spot(model: &ContrastModel, target: Point, state: ColRef<'_, f64>) -> f64 {
    let step = REACH * model.conditions().lambda_min / RADII as f64;
    let place = |direction: usize, ring: usize| {
        let (sin, cos) = (TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
        let radius = step * ring as f64;
        Point::new(target.x + radius * cos, target.y + radius * sin)
    };
    let places: Vec<Point> =
        (0..DIRECTIONS).flat_map(|d| (0..=RADII).map(move |r| (d, r))).map(|(d, r)| place(d, r)).collect();
    let field = times_column(model.shapes_at(&places).as_ref(), state);
    let radius = |d: usize| {
        let ray: Vec<f64> = (0..=RADII).map(|r| field[d * (RADII + 1) + r]).collect();
        step * half_at(&ray)
    };
    2.0 * mean((0..DIRECTIONS).map(radius))
}

/// Full width at half maximum of the velocity at the target around the focal instant, in seconds.
///
/// The velocity is the sum of the responses' autocorrelations: `Σ_l h[l + s] h[l]` at s samples after that instant, likewise before.
fn pulse(
    model: &ContrastModel,
    inputs: MatRef<'_, f64>,
    target: MatRef<'_, f64>,
    rings: MatRef<'_, f64>,
    lag: usize,
) -> f64 {
    let weights = Mat::from_fn(rings.ncols(), inputs.nrows(), |m, a| inputs[(a, m)] * target[(0, m)]);
    let responses = product(rings, weights.as_ref());
    let last = responses.nrows() - 1 - lag;
    let sum = |range: std::ops::RangeInclusive<usize>, s: usize| -> f64 {
        let product =
            |a: usize| -> f64 { range.clone().map(|l| responses[(l + s, a)] * responses[(l, a)]).sum() };
        (0..responses.ncols()).map(product).sum()
    };
    let after: Vec<f64> = (0..=lag).map(|s| sum(0..=last, s)).collect();
    let before: Vec<f64> = (0..=lag.min(last)).map(|s| sum(0..=last - s, s)).collect();
    (half_at(&after) + half_at(&before)) / model.conditions().rate
}

/// Where values first fall to half of the first, in steps, between samples linearly; NaN if they never do.
fn half_at(values: &[f64]) -> f64 {
    let half = values.first().map_or(0.0, |top| top / 2.0);
    let crossing = values.windows(2).position(|pair| pair[1] <= half);
    crossing.map_or(f64::NAN, |i| i as f64 + (values[i] - half) / (values[i] - values[i + 1]))
}
