//! Drives that make places move as asked (crosstalk cancellation): any waveform at each of several targets,
//! silence at others.

mod asked;
mod plan;
mod signal;
mod solve;
mod transfer;

use crate::{FocusError, Target, level, target};
pub use signal::{burst, click, resampled, sine};

use asked::Asked;
use plan::Plan;
use transfer::Transfer;
use unripple_core::{Drive, Point, Responses, require};

/// A waveform that a target is to follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    /// Where, in metres: a point, or a set of points that are all to move alike.
    pub points: Vec<Point>,
    /// How it moves, at the rate of the responses: metres, or m/s where velocity is asked for.
    pub samples: Vec<f64>,
    /// Seconds from the start of the first waveform to the start of this one; rounded to a sample.
    pub delay: f64,
}

impl Waveform {
    /// One point (m), without delay, and its samples in m or m/s.
    pub fn at(point: Point, samples: Vec<f64>) -> Self {
        Self { points: vec![point], samples, delay: 0.0 }
    }

    /// The same waveform, later by `delay` seconds.
    pub fn delayed(self, delay: f64) -> Self {
        Self { delay, ..self }
    }
}

/// What the samples of a waveform are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement, in metres.
    #[default]
    Displacement,
    /// Velocity, in m/s.
    Velocity,
}

/// How waveforms are played: quantity, band, regularisation and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayOptions {
    /// What the samples are: displacement or velocity.
    pub quantity: Quantity,
    /// Lowest and highest frequency that is played, in Hz; the responses' band where `None`. The highest tenth fades out.
    pub band: Option<[f64; 2]>,
    /// What drive energy costs against error: 1 spends on an error no more drive than a surface of usual response would need
    /// to make it, 1e-5 as good as follows whatever can be followed. See [`play`].
    pub energy_weight: f64,
    /// Seconds that the drive may begin before the first waveform and end after the last.
    pub lead: [f64; 2],
    /// Largest drive per actuator, in the drive's unit. A drive above it is scaled down as a whole.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// Largest residual of the optimum, as a share of what is asked, both as spectra over the usual response.
    pub tolerance: f64,
    /// Most iterations of the conjugate gradients.
    pub passes: usize,
}

impl Default for PlayOptions {
    /// Displacement over the whole band, 30 ms before and after, at a limit of 1.
    fn default() -> Self {
        Self {
            quantity: Quantity::Displacement,
            band: None,
            energy_weight: 1e-5,
            lead: [30e-3; 2],
            limit: 1.0,
            rms_limit: None,
            tolerance: 1e-3,
            passes: 100,
        }
    }
}

impl PlayOptions {
    fn check(&self) -> Result<(), FocusError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        for (what, x) in [("limit", self.limit), ("rms limit", self.rms_limit.unwrap_or(1.0))] {
            require(what, positive(x), "a positive number", x)?;
        }
        for (what, x) in [("energy weight", self.energy_weight), ("tolerance", self.tolerance)] {
            require(what, (1e-12..=1e12).contains(&x), "1e-12 to 1e12", x)?;
        }
        self.lead.iter().try_for_each(|lead| {
            Ok(require("lead of a waveform (s)", lead.is_finite() && *lead >= 0.0, "0 or more", *lead)?)
        })
    }
}

/// A drive that plays waveforms, and what it was asked to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Played {
    /// The drive that is to be sent.
    pub drive: Drive,
    /// Sample of the drive at which each waveform starts.
    pub starts: Vec<usize>,
    /// What each target was asked to do from the drive's first sample to its last: its waveform within the band, times
    /// `scale`; in the unit of the waveforms.
    pub asked: Vec<Vec<f64>>,
    /// Share of each waveform's energy that lies outside the band and was not asked for.
    pub lost: Vec<f64>,
    /// What the limits left of the levels asked for; 1 where they were not reached.
    pub scale: f64,
    /// The points of each target: those asked for, or the nearest ones whose responses are stored.
    pub points: Vec<Vec<Point>>,
    /// The points of silence, likewise.
    pub silent: Vec<Point>,
}

/// The drive of least energy whose waves follow waveforms at targets and cancel at points of silence.
///
/// With H(f) the responses of all K points to the N actuators as spectra, w(f) what is asked of them (nothing before, after, and
/// at points of silence), and g(f) the mean of |H|² over points, summed over actuators and smoothed over a thirtieth of the
/// band, the drive minimises
///
/// `Σ_f |H d − w|² / g + energy_weight · Σ_t |d|² / p`
///
/// with p(t) = 1 for as long as the drive may last, falling smoothly to nothing at its ends. It is found from the K rows of its
/// dual, `(H p Hᴴ / g + energy_weight) y = w / √g`, `d = p Hᴴ y / √g`, by conjugate gradients preconditioned with the solution
/// for a drive without end, a K x K system per frequency (Tikhonov-regularised multichannel inversion:
/// Kirkeby, Nelson, Hamada and Orduña-Bustamante, IEEE Trans. Speech Audio Process. 6, 1998). More than N
/// points are met in the least-squares sense.
///
/// # Errors
/// [`FocusError::Outside`], [`FocusError::Unknown`] and [`FocusError::Still`] for points that cannot be reached,
/// [`FocusError::Range`] and [`FocusError::Count`] for numbers without meaning, of absurd size, and modes that never die out.
pub fn play(
    responses: &Responses,
    waveforms: &[Waveform],
    silent: &[Point],
    options: &PlayOptions,
) -> Result<Played, FocusError> {
    options.check()?;
    check(waveforms, silent, responses)?;
    let plan = Plan::new(responses, waveforms, silent.len(), options)?;
    let sets: Vec<&[Point]> = waveforms.iter().map(|w| &w.points[..]).chain(silent.chunks(1)).collect();
    let mut transfer = Transfer::new(responses, &sets, waveforms.len(), options.quantity, &plan)?;
    let places = std::mem::take(&mut transfer.places);
    let asked = Asked::new(waveforms, &plan);
    let mut channels = solve::solve(&transfer, &asked.rows(waveforms, silent.len()), &plan, options);
    let scale = level::hold(&mut channels, options.limit, options.rms_limit);
    let names = responses.ports().iter().map(|port| port.name.clone()).collect();
    let drive = Drive::new(responses.conditions().rate, names, channels)?;
    let (points, rest) = places.split_at(waveforms.len());
    Ok(Played {
        drive,
        starts: plan.starts.clone(),
        asked: asked.signals(&plan, scale),
        lost: asked.lost,
        scale,
        points: points.to_vec(),
        silent: rest.iter().flatten().copied().collect(),
    })
}

fn check(waveforms: &[Waveform], silent: &[Point], responses: &Responses) -> Result<(), FocusError> {
    let targets = waveforms.iter().map(|w| w.points.clone()).chain(silent.iter().map(|p| vec![*p]));
    let targets: Vec<Target> = targets.map(Target::of).collect();
    target::check(&targets, &responses.conditions().outline)?;
    let count = |what, found| Err(FocusError::Count { what, expected: "at least 1".to_owned(), found });
    if waveforms.is_empty() {
        return count("waveforms", 0);
    }
    if responses.ports().is_empty() {
        return count("actuators", 0);
    }
    for (index, waveform) in waveforms.iter().enumerate() {
        if waveform.samples.is_empty() {
            return count("samples of a waveform", 0);
        }
        let what = format!("samples of waveform {}", index + 1);
        let bad = waveform.samples.iter().find(|x| !x.is_finite());
        bad.map_or(Ok(()), |x| require(what, false, "finite numbers", *x))?;
        let legal = waveform.delay.is_finite() && waveform.delay >= 0.0;
        require(format!("delay of waveform {} (s)", index + 1), legal, "0 or more", waveform.delay)?;
    }
    Ok(())
}
