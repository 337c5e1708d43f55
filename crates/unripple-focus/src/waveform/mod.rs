//! Drives that impose a waveform at each of several targets and silence at others (crosstalk cancellation).

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

/// A target, and the waveform that its motion is to follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    /// Where, in metres: a point, or a set of points that are all to move alike.
    pub points: Vec<Point>,
    /// Samples of the motion, at the sample rate of the responses: metres, or m/s where velocity is asked for.
    pub samples: Vec<f64>,
    /// Seconds from the start of the first waveform to the start of this one; rounded to a sample.
    pub delay: f64,
}

impl Waveform {
    /// A waveform at one point (m), without delay, with samples in m or m/s.
    pub fn at(point: Point, samples: Vec<f64>) -> Self {
        Self { points: vec![point], samples, delay: 0.0 }
    }

    /// The same waveform, later by `delay` seconds.
    pub fn delayed(self, delay: f64) -> Self {
        Self { delay, ..self }
    }
}

/// Physical quantity of the samples of a waveform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement, in metres.
    #[default]
    Displacement,
    /// Velocity, in m/s.
    Velocity,
}

/// Options of [`play`]: quantity, band, regularisation and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayOptions {
    /// Quantity of the samples: displacement or velocity.
    pub quantity: Quantity,
    /// Lowest and highest frequency that is played, in Hz; the responses' band where `None`. The highest tenth fades out.
    pub band: Option<[f64; 2]>,
    /// Weight λ of the drive's energy against the error, dimensionless; see [`play`]. A single target whose response
    /// has the mean strength g is followed at 1/(1 + λ) of its amplitude: half at 1, practically all at 1e-5.
    pub energy_weight: f64,
    /// Time that the drive may begin before the first waveform and end after the last, in seconds.
    pub lead: [f64; 2],
    /// Largest drive per actuator, in the drive's unit. A drive above it is scaled down as a whole.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// The iteration ends when the residual of the dual equations is at most this share of their right-hand side
    /// (Euclidean norms); see [`play`].
    pub tolerance: f64,
    /// Largest number of iterations of the conjugate gradients.
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

/// A drive that plays waveforms, and the motion that it was computed for.
#[derive(Clone, Debug, PartialEq)]
pub struct Played {
    /// The drive to be sent to the actuators.
    pub drive: Drive,
    /// Sample of the drive at which each waveform starts.
    pub starts: Vec<usize>,
    /// Motion prescribed at each target, from the drive's first sample to its last (targets x samples, in the unit of
    /// the waveforms): the waveform within the band, times `scale`.
    pub asked: Vec<Vec<f64>>,
    /// Share of each waveform's energy, 0 to 1, that lies outside the band and is left out.
    pub lost: Vec<f64>,
    /// Factor by which the limits reduced all waveforms; 1 where no limit was reached.
    pub scale: f64,
    /// The points of each target: those asked for, or the nearest ones whose responses are stored.
    pub points: Vec<Vec<Point>>,
    /// The points of silence: those asked for, or the nearest ones whose responses are stored.
    pub silent: Vec<Point>,
}

/// The drive that makes targets follow waveforms and keeps points of silence still, by regularised least squares.
///
/// With H(f) the K x N matrix of transfer functions from N actuators to K points, w(f) the prescribed motion (zero at
/// points of silence, and before and after the waveforms), and g(f) the mean of |H|² over points, summed over actuators
/// and smoothed over a thirtieth of the band, the drive d minimises
///
/// `Σ_f |H d − w|² / g + energy_weight · Σ_t |d|² / p`
///
/// with p(t) = 1 while the drive may last, falling smoothly to zero at its ends. It is found from the dual problem,
/// which has K unknowns per frequency, `(H p Hᴴ / g + energy_weight) y = w / √g`, `d = p Hᴴ y / √g`, by conjugate
/// gradients preconditioned with the solution for p = 1 at all times, a K x K system per frequency
/// (Tikhonov-regularised multichannel inversion: Kirkeby, Nelson, Hamada and Orduña-Bustamante, IEEE Trans. Speech
/// Audio Process. 6, 1998). More than N points are met in the least-squares sense.
///
/// # Errors
/// [`FocusError::Outside`], [`FocusError::Unknown`] and [`FocusError::Still`] for points that cannot be reached,
/// [`FocusError::Range`] for numbers out of range, [`FocusError::Count`] for counts out of range and for modes that
/// never decay.
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
