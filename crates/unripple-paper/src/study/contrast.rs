//! Simulated contrast compared with the closed forms, one parameter varied at a time.

use super::{ContrastModel, Draw, Random, Replay, Sampling, StudyError};
use rayon::prelude::*;
use unripple_core::{Point, Surface};
use unripple_linalg::{Mat, MatRef, product};
use unripple_physics::design::{Cavity, closed};

/// A simulated contrast, with the predictions of the closed forms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// Number of actuators N.
    pub actuators: usize,
    /// Value of the parameter that was varied: a window (s), a period (s), the top of a band (Hz), or a
    /// noise-to-response ratio of rms.
    pub varied: f64,
    /// Mean of the simulated contrast over placements and targets.
    pub simulated: f64,
    /// Contrast by [`Cavity`], the refined closed form.
    pub predicted: f64,
    /// Contrast by [`closed`], the plain closed form.
    pub plain: f64,
}

/// Contrast of a single focus, one row for each window (s, ascending) and number of actuators.
///
/// ```
/// # use unripple_paper::study::{ContrastModel, CELLS, Sampling, against_window};
/// let surface = unripple_physics::design::papers_surface();
/// let sampling = Sampling { placements: 4, ..Sampling::default() };
/// let rows = against_window(&ContrastModel::of(&surface, CELLS)?, &surface, &[0.030], &[8], &sampling);
/// assert!((rows[0].simulated / rows[0].predicted - 1.0).abs() < 0.2);
/// # Ok::<(), unripple_paper::study::StudyError>(())
/// ```
pub fn against_window(
    model: &ContrastModel,
    surface: &Surface,
    windows: &[f64],
    actuators: &[usize],
    sampling: &Sampling,
) -> Vec<Compared> {
    let form = Form::of(model, surface);
    let replays: Vec<_> = windows.iter().map(|window| model.once(*window)).collect();
    let means = means(model, &replays, actuators, sampling);
    let row = |(window, n, simulated): (f64, usize, f64)| Compared {
        actuators: n,
        varied: window,
        simulated,
        predicted: form.cavity.contrast(n as f64, window),
        plain: form.plain(n, window),
    };
    spread(windows, actuators, &means).map(row).collect()
}

/// Contrast of a focus repeated with a period, with a window (s): one row for each period (s) and number of actuators.
pub fn against_period(
    model: &ContrastModel,
    surface: &Surface,
    window: f64,
    periods: &[f64],
    actuators: &[usize],
    sampling: &Sampling,
) -> Vec<Compared> {
    let form = Form::of(model, surface);
    let replays: Vec<_> = periods.iter().map(|period| model.repeated(window, *period)).collect();
    let means = means(model, &replays, actuators, sampling);
    let row = |(period, n, simulated): (f64, usize, f64)| Compared {
        actuators: n,
        varied: period,
        simulated,
        predicted: form.cavity.repeated(n as f64, window, period),
        plain: form.plain_repeated(n, window, period),
    };
    spread(periods, actuators, &means).map(row).collect()
}

/// Contrast of a single focus, one row for each top of the band (Hz), at one number of actuators and one window (s).
/// The focal disc grows with the shortest wavelength.
///
/// # Errors
/// [`StudyError::Field`] if a band is so narrow that its grid has no cells.
pub fn against_band(
    model: &ContrastModel,
    surface: &Surface,
    tops: &[f64],
    (actuators, window): (usize, f64),
    sampling: &Sampling,
) -> Result<Vec<Compared>, StudyError> {
    let row = |top: &f64| {
        let narrow = model.up_to(surface, *top)?;
        let mut surface = surface.clone();
        surface.emission.band[1] = *top;
        let mut rows = against_window(&narrow, &surface, &[window], &[actuators], sampling);
        rows.iter_mut().for_each(|row| row.varied = *top);
        Ok(rows)
    };
    Ok(tops.iter().map(row).collect::<Result<Vec<_>, StudyError>>()?.concat())
}

/// Contrast of a single focus where white noise is added to the recorded responses or to the drive, one row for each
/// noise ratio, at one number of actuators and one window (s). The ratio is the rms of the noise within the band over
/// the rms of the responses over the window, without unit.
pub fn against_noise(
    model: &ContrastModel,
    surface: &Surface,
    ratios: &[f64],
    (actuators, window): (usize, f64),
    sampling: &Sampling,
) -> Vec<Compared> {
    let form = Form::of(model, surface);
    let replay = model.once(window);
    let rings = model.rings(window);
    let found = over(model, actuators, sampling, |index, draw, inputs| {
        let mut random = Random::seeded(sampling.seed.wrapping_mul(7919).wrapping_add(index as u64));
        let noise = noise_state(model, inputs, rings.as_ref(), &mut random);
        let replayed = |target: &Point| {
            let outside = model.outside(*target);
            let states = model.states(&replay, inputs, &outside);
            let state = states.col(actuators.saturating_sub(1));
            let level = noise_level(model, outside.at_target(state.as_mat())[0], actuators, window);
            let noisy =
                Mat::from_fn(state.nrows(), ratios.len(), |m, r| state[m] + ratios[r] * level * noise[m]);
            model.contrasts(noisy.as_ref(), &outside)
        };
        draw.targets.iter().map(replayed).collect()
    });
    ratios
        .iter()
        .enumerate()
        .map(|(r, ratio)| Compared {
            actuators,
            varied: *ratio,
            simulated: mean(found.iter().map(|row| row[r])),
            predicted: form.cavity.noisy(actuators as f64, window, *ratio),
            plain: form.plain_noisy(actuators, window, *ratio),
        })
        .collect()
}

/// Velocity of each mode at the focal instant due to white noise of unit variance on every channel.
fn noise_state(
    model: &ContrastModel,
    inputs: MatRef<'_, f64>,
    rings: MatRef<'_, f64>,
    random: &mut Random,
) -> Vec<f64> {
    let noise = Mat::from_fn(rings.nrows(), inputs.nrows(), |_, _| random.normal());
    let left = product(rings.transpose(), noise.as_ref());
    let rate = model.conditions().rate;
    (0..rings.ncols())
        .map(|m| (0..inputs.nrows()).map(|a| inputs[(a, m)] * left[(m, a)]).sum::<f64>() / rate)
        .collect()
}

/// Standard deviation of the white samples whose rms within the band is that of the responses over the window.
///
/// The velocity at a focus is the energy Σ∫h² of the responses from which it was computed.
fn noise_level(model: &ContrastModel, velocity: f64, actuators: usize, window: f64) -> f64 {
    let conditions = model.conditions();
    let share = 2.0 * (conditions.band[1] - conditions.band[0]) / conditions.rate;
    (velocity / actuators as f64 / window / share).sqrt()
}

/// Parameters of the closed forms for a model.
struct Form {
    cavity: Cavity,
    bandwidth: f64,
    decay_time: f64,
    modes: f64,
}

impl Form {
    fn of(model: &ContrastModel, surface: &Surface) -> Self {
        let modes = model.modes() as f64;
        let [low, top] = surface.emission.band;
        let cavity = Cavity::of(surface, top).counted(modes);
        Self { decay_time: cavity.decay_time(), cavity, bandwidth: top - low, modes }
    }

    fn plain(&self, actuators: usize, window: f64) -> f64 {
        closed::contrast(actuators as f64, self.bandwidth, self.decay_time, window, self.modes)
    }

    fn plain_repeated(&self, actuators: usize, window: f64, period: f64) -> f64 {
        let n = actuators as f64;
        closed::repeated(n, self.bandwidth, self.decay_time, window, self.modes, period)
    }

    fn plain_noisy(&self, actuators: usize, window: f64, ratio: f64) -> f64 {
        let noise = closed::noise_share(actuators as f64, self.bandwidth, window, ratio);
        (self.plain(actuators, window).powi(-2) + noise).powf(-0.5)
    }
}

/// Mean contrasts, maps x numbers of actuators.
fn means(
    model: &ContrastModel,
    replays: &[Replay],
    actuators: &[usize],
    sampling: &Sampling,
) -> Vec<Vec<f64>> {
    let most = actuators.iter().copied().max().unwrap_or(0);
    let found = over(model, most, sampling, |_, draw, inputs| {
        draw.targets
            .iter()
            .map(|target| {
                let outside = model.outside(*target);
                let contrasts = |replay: &Replay| {
                    // Of as many states as there are actuators, those of the numbers that are asked for.
                    let states = model.states(replay, inputs, &outside);
                    let asked = Mat::from_fn(states.nrows(), actuators.len(), |m, j| {
                        states[(m, actuators[j].saturating_sub(1))]
                    });
                    model.contrasts(asked.as_ref(), &outside)
                };
                replays.iter().flat_map(contrasts).collect()
            })
            .collect()
    });
    let at = |i: usize, j: usize| mean(found.iter().map(|row| row[i * actuators.len() + j]));
    (0..replays.len()).map(|i| (0..actuators.len()).map(|j| at(i, j)).collect()).collect()
}

/// Calls `evaluate` for every random placement, and returns a row of values per target.
pub(super) fn over<F>(
    model: &ContrastModel,
    actuators: usize,
    sampling: &Sampling,
    evaluate: F,
) -> Vec<Vec<f64>>
where
    F: Fn(usize, &Draw, MatRef<'_, f64>) -> Vec<Vec<f64>> + Sync,
{
    let draws = sampling.draws(model.outline(), actuators);
    let found: Vec<_> = draws
        .par_iter()
        .enumerate()
        .map(|(i, draw)| evaluate(i, draw, model.shapes_at(&draw.actuators).as_ref()))
        .collect();
    found.concat()
}

pub(super) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    sum / count
}

/// Every value with every number of actuators and its mean.
fn spread<'a>(
    values: &'a [f64],
    actuators: &'a [usize],
    means: &'a [Vec<f64>],
) -> impl Iterator<Item = (f64, usize, f64)> + 'a {
    values
        .iter()
        .zip(means)
        .flat_map(move |(value, row)| actuators.iter().zip(row).map(move |(n, mean)| (*value, *n, *mean)))
}
