//! Drives felt at the targets and least elsewhere: regularised least squares with bounds at control points.

use super::FeltOptions;
use super::background::Actuation;
use super::control::{Control, Lattice};
use super::lines::{Lines, felt_top};
use super::reduced::Reduced;
use super::solve::{Held, Programme};
use super::splines::Splines;
use super::watch::Watch;
use crate::magnitude::{energy, peak};
use crate::schedule::MOST_SAMPLES;
use crate::{FocusError, Focused, Method, Shaping, Target, Timing};
use std::f64::consts::{PI, TAU};
use unripple_core::{Drive, ModalResponses, OutOfRange, Point, Responses, require, window_samples};
use unripple_linalg::{Cholesky, Mat, MatRef, product, solve_lower};

/// Largest number of spline coefficients of a drive, over all actuators: the quadratic form in them is a
/// square matrix, half a GiB at this size. With twice this value, it takes four times the memory and eight
/// times the time.
const MOST_COEFFICIENTS: usize = 8000;

/// Largest number of values of a plan, up to a GiB of them. With twice this value, a plan may take twice that.
const MOST_VALUES: usize = 1 << 27;

/// Modes below this multiple of the highest frequency felt are computed individually, all others as static
/// flexibility. With twice this value, more modes are computed although the flexibility is accurate enough.
const HEARD: f64 = 2.0;

/// The same multiple in the search for the largest felt displacement, where fewer modes are used for speed:
/// the error is within the tolerance of that search. With twice this value, more modes are taken, for memory
/// in proportion.
const WATCHED: f64 = 0.8;

/// A shape weight below this share of the largest is rounding error, not motion. Larger, targets close to a
/// held edge would be refused.
const REST: f64 = 1e-9;

/// Computes drives that are felt at the targets and as little as possible elsewhere
/// ([`Method::Felt`]); what does not depend on the targets is computed once.
///
/// What is felt is the displacement filtered by 1/threshold(f) with zero phase, in units of the threshold. Let B² be
/// its square, averaged over the surface, integrated over all time and divided by twice the window; W its largest
/// magnitude at control points outside every target's disc of (4/3) λ_min, at instants around the focal one; and E the
/// energy of the drive. The drive is the one of least
///
/// `(1 − worst) B² + worst · W² + economy · E · tr B² / tr E`
///
/// among cubic splines with two knots per period of the highest frequency that counts as felt, where what is felt at
/// each target at the focal instant is held in proportion to its gain. The traces are sums over drives of one spline
/// each. This is a convex quadratic programme: with `worst` at 0 one linear system, factored in advance, otherwise its
/// dual over the few points and instants that reach W.
#[derive(Debug)]
pub struct FeltPlan<'r> {
    responses: &'r ModalResponses,
    heard: Reduced<'r>,
    options: FeltOptions,
    focal: usize,
    splines: Splines,
    /// Lower triangular Cholesky factor of the quadratic form without W, in spline coefficients
    /// `[actuator][spline]`.
    factor: Mat<f64>,
    /// What is felt of each mode at the focal instant, per whitened coefficient: coefficients x modes.
    level: Mat<f64>,
    control: Control,
    watch: Watch,
    /// Largest shape weight on the surface.
    usual: f64,
}

/// Sizes of a plan.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    /// Last sample of the drive.
    window: usize,
    /// Highest frequency that counts as felt, in Hz.
    top: f64,
    splines: Splines,
    /// Number of modes that matter for what is felt.
    heard: usize,
    /// Number of modes used in the search for the largest felt displacement.
    watched: usize,
    lattice: Lattice,
}

impl<'r> FeltPlan<'r> {
    /// Prepares the computation of drives for a surface with these responses and for the window and weights
    /// of `options`.
    ///
    /// # Errors
    /// [`FocusError::Range`] for options out of range, [`FocusError::NeedsModes`] for sampled responses,
    /// [`FocusError::Count`] without actuators or modes, for a window of no sample, and for more coefficients or values
    /// than a plan may have.
    pub fn new(responses: &'r Responses, options: &FeltOptions) -> Result<Self, FocusError> {
        options.check()?;
        let Responses::Modal(responses) = responses else {
            return Err(FocusError::NeedsModes("what is felt everywhere"));
        };
        let sizes = sizes(responses, options)?;
        let conditions = &responses.conditions;
        let heard = Reduced::new(responses, sizes.heard);
        let watched = Reduced::new(responses, sizes.watched);
        let (control, products) = Control::read(&conditions.outline, sizes.lattice, &watched, &heard);
        let poles = &responses.poles[..sizes.heard];
        let lines = Lines::new(&options.threshold, conditions.rate, sizes.window, poles, sizes.top);
        let splines = sizes.splines;
        let mut actuation = Actuation {
            lines: &lines,
            splines: (0..splines.count()).map(|k| lines.of(&splines.signal(k))).collect(),
            modes: heard.lines(&lines),
            input: heard.input(),
        };
        let background = actuation.background(products.as_ref());
        let factor = factor(background, splines, sizes.window, options, responses)?;
        let focal = sizes.window - window_samples(options.lead, conditions.rate).min(sizes.window);
        let level = level(&actuation, factor.as_ref(), focal);
        (actuation.modes, actuation.input) = (watched.lines(&lines), watched.input());
        let watch = Watch::new(&actuation, factor.as_ref(), focal, sizes.top);
        let usual = f64::from(
            (0..control.shapes.ncols())
                .flat_map(|p| control.shapes.col_as_slice(p))
                .fold(0.0_f32, |m, x| m.max(x.abs())),
        );
        let options = options.clone();
        Ok(Self { responses, heard, options, focal, splines, factor, level, control, watch, usual })
    }

    /// Computes the drive that is felt at these targets and as little as possible elsewhere, scaled to the
    /// limits.
    ///
    /// What is felt at target k at the focal instant, averaged over its points, is its gain times a level common to all
    /// targets, which the limits set. A gain of 0 imposes silence there at that instant. Repeated targets are refused.
    ///
    /// # Errors
    /// [`FocusError::Outside`] and [`FocusError::Still`] for targets that cannot be reached,
    /// [`FocusError::Inseparable`] for targets too close to each other for different levels,
    /// [`FocusError::Range`] for repeated targets and for numbers out of range, [`FocusError::Count`] for no
    /// target, a target without points, or too many points.
    pub fn focus(&self, targets: &[Target]) -> Result<Focused, FocusError> {
        let channels = self.limited(self.channels(&self.coefficients(targets)?))?;
        let names = self.responses.ports.iter().map(|port| port.name.clone()).collect();
        Ok(Focused {
            drive: Drive::new(self.responses.conditions.rate, names, channels)?,
            timing: vec![Timing { instant: self.focal, period: None }; targets.len()],
            period: None,
            points: targets.iter().map(|target| target.points.clone()).collect(),
            method: Method::Felt,
            shaping: Shaping::Unshaped,
        })
    }

    /// The drive before it is scaled to the limits, as spline coefficients `[actuator][spline]`.
    fn coefficients(&self, targets: &[Target]) -> Result<Vec<f64>, FocusError> {
        Target::check(targets, &self.responses.conditions.outline)?;
        let rows = targets.iter().enumerate().map(|(k, target)| self.felt_at(k, target));
        let rows = rows.collect::<Result<Vec<_>, _>>()?;
        let levels: Vec<f64> = targets.iter().map(|target| target.gain).collect();
        let held = Held::new(&rows, &levels)?;
        let programme = Programme {
            watch: &self.watch,
            control: &self.control,
            factor: self.factor.as_ref(),
            worst: self.options.worst,
        };
        Ok(programme.solve(&held, &self.outside(targets)))
    }

    /// The control points outside all targets' discs.
    fn outside(&self, targets: &[Target]) -> Vec<usize> {
        let points: Vec<Point> = targets.iter().flat_map(|target| target.points.iter().copied()).collect();
        self.control.outside(&points, self.responses.conditions.focal_radius())
    }

    fn channels(&self, coefficients: &[f64]) -> Vec<Vec<f64>> {
        coefficients.chunks_exact(self.splines.count()).map(|own| self.splines.sum(own)).collect()
    }

    /// What is felt at a target at the focal instant, per whitened coefficient.
    fn felt_at(&self, index: usize, target: &Target) -> Result<Vec<f64>, FocusError> {
        if let Some(hz) = target.rate_hz {
            let what = format!("repetition of target {} (Hz)", index + 1);
            let none = "none, what is felt is designed to come once";
            return Err(OutOfRange::new(what, none, hz).into());
        }
        let shapes = self.heard.at_all(&target.points);
        let mean = |m: usize| {
            (0..target.points.len()).map(|p| shapes[(p, m)]).sum::<f64>() / target.points.len() as f64
        };
        let mean = Mat::from_fn(self.level.ncols(), 1, |m, _| mean(m));
        if mean.col_as_slice(0)[..self.heard.kept].iter().all(|w| w.abs() <= REST * self.usual) {
            return Err(FocusError::Still { target: index, at: target.points[0] });
        }
        Ok(product(self.level.as_ref(), mean.as_ref()).col_as_slice(0).to_vec())
    }

    /// Scales the drive so that its peak equals `limit`, then down if a channel's rms exceeds `rms_limit`.
    fn limited(&self, mut channels: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, FocusError> {
        let peak = channels.iter().map(|channel| peak(channel)).fold(0.0, f64::max);
        let usable = peak.is_finite() && peak > 0.0;
        require("peak of the unscaled drive", usable, "a positive finite number", peak)?;
        let limit = self.options.limit;
        channels.iter_mut().flatten().for_each(|d| *d = *d / peak * limit);
        let rms = |channel: &Vec<f64>| (energy(channel) / channel.len() as f64).sqrt();
        let rms = channels.iter().map(rms).fold(0.0, f64::max);
        if let Some(most) = self.options.rms_limit.filter(|most| rms > *most) {
            channels.iter_mut().flatten().for_each(|d| *d *= most / rms);
        }
        Ok(channels)
    }
}

/// Computes the sizes of a plan, and refuses too large ones before anything is allocated.
fn sizes(responses: &ModalResponses, options: &FeltOptions) -> Result<Sizes, FocusError> {
    let conditions = &responses.conditions;
    let count =
        |what, expected: &str, found| Err(FocusError::Count { what, expected: expected.to_owned(), found });
    if responses.ports.is_empty() {
        return count("actuators", "at least 1", 0);
    }
    if responses.poles.is_empty() {
        return count("modes", "at least 1", 0);
    }
    let window = window_samples(options.window, conditions.rate);
    if window == 0 {
        return count("samples of the window after the first", "at least 1", 0);
    }
    if window >= MOST_SAMPLES / responses.ports.len() {
        let most = MOST_SAMPLES / responses.ports.len() - 1;
        return count("samples of the window after the first", &format!("at most {most}"), window);
    }
    let top = felt_top(&options.threshold, conditions.band[1].min(0.4 * conditions.rate));
    let step = ((conditions.rate / (2.0 * top)) as usize).clamp(1, (window / 8).max(1));
    let splines = Splines { step, samples: window + 1 };
    let coefficients = responses.ports.len().saturating_mul(splines.count());
    if coefficients > MOST_COEFFICIENTS {
        let most = format!("at most {MOST_COEFFICIENTS} (a shorter window, fewer actuators)");
        return count("coefficients of the drive", &most, coefficients);
    }
    let below = |hz: f64| {
        let last = responses.poles.iter().rposition(|pole| pole.omega <= TAU * hz);
        last.map_or(1, |last| last + 1)
    };
    let (heard, watched) = (below(HEARD * top), below(WATCHED * top));
    // From the number of modes below the top: the shortest wavelength that is felt.
    let felt_length = (PI * conditions.outline.area() / below(top) as f64).sqrt();
    let lattice = Lattice::new(&conditions.outline, (felt_length / 4.0).max(conditions.lambda_min / 2.0));
    let times = Watch::times(conditions.rate, top).len();
    let ports = responses.ports.len();
    // Each line has a real and an imaginary part.
    let lines = 2 * Lines::sizes(conditions.rate, window, &responses.poles[..heard], top)[1];
    for [rows, columns] in [
        [times * coefficients, watched + ports],
        [lattice.count(), watched],
        [heard, heard],
        [lines, splines.count() + heard],
        [lines, ports * ports],
    ] {
        let found = rows.saturating_mul(columns);
        if found > MOST_VALUES {
            return count("values of the plan", &format!("at most {MOST_VALUES}"), found);
        }
    }
    Ok(Sizes { window, top, splines, heard, watched, lattice })
}

/// The lower triangular Cholesky factor of the quadratic form, without the term of the largest felt
/// displacement.
fn factor(
    mut form: Mat<f64>,
    splines: Splines,
    window: usize,
    options: &FeltOptions,
    responses: &ModalResponses,
) -> Result<Mat<f64>, FocusError> {
    let span = 2.0 * window as f64 / responses.conditions.rate;
    let (count, size) = (splines.count(), form.nrows());
    let trace = (0..size).map(|i| form[(i, i)]).sum::<f64>() / span;
    let usable = trace.is_finite() && trace > 0.0;
    require("what is felt of the actuators", usable, "a positive finite number", trace)?;
    let products = splines.products();
    let products_trace = (0..size).map(|i| products[(i % count, i % count)]).sum::<f64>();
    let weight = options.economy * trace / products_trace;
    for j in 0..size {
        for i in 0..size {
            let energy = if i / count == j / count { products[(i % count, j % count)] } else { 0.0 };
            form[(i, j)] = (1.0 - options.worst) * form[(i, j)] / span + weight * energy;
        }
    }
    let factor = Cholesky::new(form.as_ref()).ok_or_else(|| {
        FocusError::Range(OutOfRange::new(
            "economy",
            "more, so that the drive is determined",
            options.economy,
        ))
    })?;
    Ok(factor.lower().to_owned())
}

/// What is felt of each mode at the focal instant, per whitened coefficient.
fn level(actuation: &Actuation<'_>, factor: MatRef<'_, f64>, focal: usize) -> Mat<f64> {
    let splines = actuation.splines.len();
    let phases = actuation.phases(&[focal as i64]);
    let mut level = Mat::zeros(factor.nrows(), actuation.modes.len());
    for m in 0..actuation.modes.len() {
        let motion = actuation.motion(m, &phases);
        let weight = |i: usize| actuation.input[(i / splines, m)];
        level
            .col_as_slice_mut(m)
            .iter_mut()
            .enumerate()
            .for_each(|(i, x)| *x = weight(i) * motion[(0, i % splines)]);
    }
    solve_lower(factor, level.as_mut());
    level
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
