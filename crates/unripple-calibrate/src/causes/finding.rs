//! The likeliest causes of a difference, the likeliest first.

use super::agreement::Agreement;
use super::lines::Spectrum;
use super::{Cause, Model, Suspect, gains, saturation, tension, wires};
use crate::CalibrateError;

/// Share of the recordings' amplitude up to which a difference is not searched for causes: interpolated responses and the
/// gains of good amplifiers leave as much.
const SMALL: f64 = 0.03;

/// Multiple of what the noise leaves above which a difference counts as one.
const CLEAR: f64 = 3.0;

/// Share of the unexplained energy that a cause may leave and be suspected: half the energy explained by one number is
/// not by chance.
const SUSPECTED: f64 = 0.5;

/// Share of what the best other cause leaves, in energy, below which separate gains are suspected. With a number for each
/// actuator they explain a bit of anything.
const GAINS_BETTER: f64 = 0.5;

/// A drive that was played, and what was recorded at each place of a [`Model`].
#[derive(Clone, Copy, Debug)]
pub struct Played<'a> {
    /// The drive as it was sent, actuators x samples, in the actuators' unit.
    pub drive: &'a [Vec<f64>],
    /// Recorded velocity at each place (places x samples), in m/s, or in any unit that all places share.
    pub full: &'a [Vec<f64>],
    /// Recordings of the same drive at a lower level, and that level relative to the first; `None` if there are none.
    pub quiet: Option<(f64, &'a [Vec<f64>])>,
    /// Energy of the noise of all recordings together in the band of the model's lines: the sum of its squares over all
    /// samples, in the recordings' unit squared.
    pub noise: f64,
}

/// What recordings have in common with their prediction, and why they differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Factor on the prediction that fits the recordings best.
    pub gain: f64,
    /// Delay of the recordings, in samples.
    pub delay: f64,
    /// Amplitude of what gain and delay leave unexplained, as a share of the recordings'.
    pub left: f64,
    /// Amplitude of the noise as a share of the recordings'.
    pub noise: f64,
    /// Amplitude of what the recordings have less or more than quieter ones scaled up, as a share; `None` without quieter ones.
    pub nonlinearity: Option<f64>,
    /// Least-squares gain of each actuator, relative to the prediction; empty where they are not known.
    pub gains: Vec<f64>,
    /// Suspected causes, the likeliest first; empty if nothing is left unexplained, or nothing explains it.
    pub suspects: Vec<Suspect>,
}

/// Recordings as spectra.
struct Heard<'a> {
    model: &'a Model,
    drive: Vec<Spectrum>,
    full: Vec<Spectrum>,
    quiet: Option<(f64, Vec<Spectrum>)>,
}

/// Finds why recordings differ from their prediction.
///
/// Where recordings at two levels differ by more than their noise, an amplifier saturates; other causes are then sought in the
/// quieter ones. Each cause has a prediction of its own, with free gain and delay: other tensions, permutations and signs of
/// the drive's channels, a gain for each actuator.
///
/// # Errors
/// [`CalibrateError::Count`] for recordings or drives whose number is not that of the model's places and actuators.
pub fn find(model: &Model, played: &Played<'_>) -> Result<Findings, CalibrateError> {
    let heard = Heard::of(model, played)?;
    let responses = model.responses(1.0);
    let predicted = model.sums(&responses, &heard.drive);
    let full = Agreement::of(model.lines(), &heard.full, &predicted);
    let noise = share(played.noise, full.total);
    let nonlinearity = heard.quiet.as_ref().map(|(level, quiet)| {
        // Scaled up, the quieter recording's noise is, too.
        let floor = CLEAR * noise * (1.0 + 1.0 / (level * level)).sqrt();
        (saturation::nonlinearity(&heard.full, quiet, *level), floor)
    });
    let saturates = nonlinearity.is_some_and(|(found, floor)| found > floor.max(SMALL));
    let mut suspects = Vec::new();
    if saturates {
        let (clip, then) = saturation::search(model, &heard.full, played.drive);
        suspects.push(Suspect { cause: Cause::Saturation { clip }, left: then.share() });
    }
    let (linear, noise_there) = match heard.quiet.as_ref().filter(|_| saturates) {
        Some((level, quiet)) => (quiet, noise / level),
        None => (&heard.full, noise),
    };
    let agreement = Agreement::of(model.lines(), linear, &predicted);
    let by_gain = gains::search(model, linear, &responses, &heard.drive, &agreement);
    if agreement.share() > SMALL.max(CLEAR * noise_there) {
        suspects.extend(heard.linear(linear, &responses, agreement, by_gain.as_ref().map(|(_, then)| then)));
    } else if full.share() > SMALL && !saturates {
        let left = (full.share().powi(2) - noise * noise).max(0.0).sqrt();
        suspects.push(Suspect { cause: Cause::Noise, left });
    }
    Ok(Findings {
        gain: full.gain,
        delay: full.delay,
        left: full.share(),
        noise,
        nonlinearity: nonlinearity.map(|(found, _)| found),
        gains: by_gain.map_or_else(Vec::new, |(gains, _)| gains),
        suspects,
    })
}

/// Amplitude of an energy as a share of that of another.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { (part.max(0.0) / whole).sqrt() } else { 0.0 }
}

impl<'a> Heard<'a> {
    fn of(model: &'a Model, played: &Played<'_>) -> Result<Self, CalibrateError> {
        let same = |what, expected: usize, found: usize| match expected == found {
            true => Ok(()),
            false => Err(CalibrateError::Count { what, expected: format!("{expected}"), found }),
        };
        same("channels of the drive", model.actuators(), played.drive.len())?;
        same("recordings", model.places(), played.full.len())?;
        if let Some((_, quiet)) = played.quiet {
            same("quieter recordings", model.places(), quiet.len())?;
        }
        let lines = model.lines();
        let weighted = |all: &[Vec<f64>]| all.iter().map(|line| lines.weighted(line)).collect::<Vec<_>>();
        Ok(Self {
            model,
            drive: played.drive.iter().map(|line| lines.plain(line)).collect(),
            full: weighted(played.full),
            quiet: played.quiet.map(|(level, quiet)| (level, weighted(quiet))),
        })
    }

    /// The causes, other than saturation, that explain recordings, the likeliest first; `by_gain` is the agreement with a gain
    /// for each actuator.
    fn linear(
        &self,
        heard: &[Spectrum],
        responses: &[Spectrum],
        before: Agreement,
        by_gain: Option<&Agreement>,
    ) -> Vec<Suspect> {
        let mut found = Vec::new();
        if self.model.has_tension() {
            let (ratio, then) = tension::search(self.model, heard, &self.drive);
            found.push((Cause::Tension { ratio }, then));
        }
        let (faults, then) = wires::search(self.model, heard, responses, &self.drive, before);
        if !faults.is_empty() {
            found.push((Cause::Wires(faults), then));
        }
        let best = found.iter().map(|(_, then)| then.left).fold(before.left, f64::min);
        if let Some(then) = by_gain.filter(|then| then.left < GAINS_BETTER * best) {
            found.push((Cause::Gains, *then));
        }
        found.retain(|(_, then)| then.left < SUSPECTED * before.left);
        found.sort_by(|a, b| a.1.left.total_cmp(&b.1.left));
        found.into_iter().map(|(cause, then)| Suspect { cause, left: then.share() }).collect()
    }
}
