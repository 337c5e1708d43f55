//! Drives that impose a waveform at each of several targets and silence at others (crosstalk cancellation).

mod asked;
mod motion;
mod options;
mod plan;
mod signal;
mod solve;
mod transfer;

use crate::{FocusError, Target, level};
pub use motion::{Quantity, Waveform};
pub use options::PlayOptions;
pub(crate) use plan::MOST_SAMPLES;
pub use signal::{burst, click, resampled, sine};

use asked::Asked;
use plan::Plan;
use transfer::Transfer;
use unripple_core::{Drive, Point, Responses, require};

/// A drive that makes targets follow waveforms, and the motion that was prescribed at the targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Played {
    /// The drive to be sent to the actuators.
    pub drive: Drive,
    /// Sample of the drive at which each waveform starts.
    pub starts: Vec<usize>,
    /// Motion prescribed at each target, from the drive's first sample to its last (targets x samples, in the unit of
    /// the waveforms): the waveform within the band, times `scale`.
    pub prescribed: Vec<Vec<f64>>,
    /// Share of each waveform's energy, 0 to 1, that lies outside the band and is left out.
    pub lost: Vec<f64>,
    /// Factor by which the limits reduced all waveforms; 1 where no limit was reached.
    pub scale: f64,
    /// The points of each target: those requested or, with sampled responses, the nearest stored ones.
    pub points: Vec<Vec<Point>>,
    /// The points kept still: those requested or, with sampled responses, the nearest stored ones.
    pub silent: Vec<Point>,
}

/// Computes the drive that makes targets follow waveforms and keeps the points `silent` still, by
/// regularised least squares.
///
/// With H(f) the K x N matrix of transfer functions from N actuators to K points, w(f) the prescribed motion (zero at
/// points of silence, and before and after the waveforms), and g(f) the mean of |H|² over points, summed over actuators
/// and smoothed over a thirtieth of the band, the drive d minimises
///
/// `Σ_f |H d − w|² / g + energy_weight · Σ_t |d|² / p`
///
/// with p(t) = 1 for the duration of the drive, falling smoothly to zero at its ends. It is found from the
/// dual problem, which has K unknowns per frequency, `(H p Hᴴ / g + energy_weight) y = w / √g`, `d = p Hᴴ y
/// / √g`, by conjugate gradients preconditioned with the solution for p = 1 at all times, a K x K system per
/// frequency (Tikhonov-regularised multichannel inversion: Kirkeby, Nelson, Hamada and Orduña-Bustamante,
/// IEEE Trans. Speech Audio Process. 6, 1998). More than N points are met in the least-squares sense.
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
        prescribed: asked.signals(&plan, scale),
        lost: asked.lost,
        scale,
        points: points.to_vec(),
        silent: rest.iter().flatten().copied().collect(),
    })
}

fn check(waveforms: &[Waveform], silent: &[Point], responses: &Responses) -> Result<(), FocusError> {
    let targets = waveforms.iter().map(|w| w.points.clone()).chain(silent.iter().map(|p| vec![*p]));
    let targets: Vec<Target> = targets.map(Target::of).collect();
    Target::check(&targets, &responses.conditions().outline)?;
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
