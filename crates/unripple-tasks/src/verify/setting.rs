//! Everything that is known before the drive is played: what is sent, where the probe records, and what is predicted there.

use super::beside::Beside;
use super::{Ask, places};
use crate::judge::{self, RESPONSES};
use crate::numbers::above_zero;
use crate::{Place, Progress, TaskError, field, go_on, point, source};
use std::f64::consts::PI;
use unripple::act::Note;
use unripple::core::{Drive, Point, Responses, Surface};
use unripple::field::{Field, fits};
use unripple_calibrate::signals::Band;

/// Decay times that are recorded after the drive: a quarter of a per cent of its last waves is left then.
const DECAYS: f64 = 6.0;

/// Longest recording after the drive, in s: longer ones tell nothing more of a focus.
const LONGEST: f64 = 2.0;

/// Ratio of the upper edge of the band in which signals are compared, where it has faded out, to where it begins to.
const EDGE: f64 = 1.2;

/// What is known before a drive is played.
pub(super) struct Setting {
    /// The surface, as its file or its library describes it.
    pub surface: Surface,
    /// The responses by which it is predicted what a probe records.
    pub responses: Responses,
    /// Highest frequency of the modes, in Hz.
    pub hz: f64,
    /// Whether absolute velocities are predicted.
    pub scaled: bool,
    /// The drive at its full level, as it is sent.
    pub drive: Drive,
    /// Samples that are recorded, besides the latency.
    pub samples: usize,
    /// The target, then the other places, in m.
    pub places: Vec<Point>,
    /// Instant of the focus, in s.
    pub instant: f64,
    /// Radius of the focal disc, in m.
    pub disc: f64,
    /// Predicted velocity at each place in the band, places x samples, in m/s.
    pub predicted: Vec<Vec<f64>>,
    /// Notes on target and responses.
    pub notes: Vec<Note>,
}

impl Setting {
    /// Reads surface and drive, and predicts.
    ///
    /// # Errors
    /// Those of [`run`](super::run) that come before a device is opened.
    pub fn of(ask: &Ask, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        check(ask)?;
        let source = source::open(&ask.surface, progress)?;
        source.allows(&[("judge_hz", ask.judge_hz.is_some())])?;
        let drive = field::drive(&ask.drive, &source.surface)?.scaled(ask.level).as_emitted();
        fitting(&source.surface, &drive)?;
        limited(ask, &source.surface, &drive)?;
        judge::reaches(&source.surface, ask.judge_hz)?;
        let beside = Beside::of(&ask.drive);
        let target = point(&target(ask, &beside)?);
        let places = places::all(ask, &source, target)?;
        let (disc, scaled) = (places::disc(&source), source.without_scale().is_none());
        let mut notes = notes(ask, &beside);
        go_on(progress)?;
        progress.stage(RESPONSES);
        let (surface, responses, hz) = match source.stored {
            Some(_) => {
                let (surface, responses, told) = source.respond(&places, ask.between)?;
                notes.extend(told.into_iter().flat_map(|(_, notes)| notes));
                let hz = surface.emission.band[1];
                (surface, responses, hz)
            }
            None => {
                let (models, judging) = judge::models(&source.surface, ask.judge_hz, &[], &source.solved)?;
                notes.extend(judging.note.iter().chain(&judging.inexact).cloned());
                (source.surface, models.free, judging.hz)
            }
        };
        let mut predicted = predict(&responses, &drive, &places)?;
        let samples = predicted[0].len();
        let band = band(hz, drive.rate());
        predicted.iter_mut().try_for_each(|line| band.limit(line, drive.rate())).map_err(TaskError::input)?;
        let instant = instant(ask, &beside, &predicted[0], drive.rate())?;
        Ok(Self { surface, responses, hz, scaled, drive, samples, places, instant, disc, predicted, notes })
    }

    /// The band in which signals are compared.
    pub fn band(&self) -> Band {
        band(self.hz, self.drive.rate())
    }

    /// Sample of the focal instant.
    pub fn focal_sample(&self) -> usize {
        (self.instant * self.drive.rate()).round() as usize
    }
}

/// The band of modes up to `hz`, at a sample rate, both in Hz.
fn band(hz: f64, rate: f64) -> Band {
    let high = hz.min(rate / (2.0 * EDGE));
    Band { low: [0.0; 2], high: [high, EDGE * high] }
}

/// Returns an error for numbers that make no sense.
fn check(ask: &Ask) -> Result<(), TaskError> {
    if above_zero(ask.level, "level", "of the drive")? > 1.0 {
        return Err(TaskError::ask("level", "at most 1", ask.level));
    }
    if let Some(scale) = ask.probe_scale.filter(|scale| !scale.is_finite() || *scale == 0.0) {
        return Err(TaskError::ask("probe_scale", "a number other than 0, in m/s", scale));
    }
    if let Some(instant) = ask.instant_s.filter(|instant| !(instant.is_finite() && *instant >= 0.0)) {
        return Err(TaskError::ask("instant_s", "a time from 0, in s", instant));
    }
    places::check(ask)
}

/// Returns an error for a drive that is not for a surface.
fn fitting(surface: &Surface, drive: &Drive) -> Result<(), TaskError> {
    let names: Vec<&str> = surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
    fits(&names, surface.emission.rate, drive).map_err(TaskError::input)
}

/// Returns an error for a drive above the limit of the surface.
fn limited(ask: &Ask, surface: &Surface, drive: &Drive) -> Result<(), TaskError> {
    let (peak, limit) = (drive.peak(), surface.emission.limit);
    // A drive at its limit is rounded to float32.
    if peak <= limit * (1.0 + 1e-6) {
        return Ok(());
    }
    let most = ask.level * limit / peak;
    Err(TaskError::ask(
        "level",
        format!("at most {most:.4}, so that the drive stays within {limit}"),
        ask.level,
    ))
}

fn target(ask: &Ask, beside: &Beside) -> Result<Place, TaskError> {
    ask.target_m.or(beside.target).ok_or_else(|| {
        let expected = "a place, or `report.json` of `focus` beside the drive, which has it";
        TaskError::ask("target_m", expected, "neither")
    })
}

fn notes(ask: &Ask, beside: &Beside) -> Vec<Note> {
    let several = ask.target_m.is_none() && beside.targets > 1;
    let text = format!("the first of {} targets is the focus", beside.targets);
    several.then_some(Note { topic: "target", text }).into_iter().collect()
}

/// The velocity at each place under a drive, in m/s, for as long as is recorded: as far as a library's responses tell it, by modes until the
/// waves have decayed.
fn predict(responses: &Responses, drive: &Drive, places: &[Point]) -> Result<Vec<Vec<f64>>, TaskError> {
    let field = Field::new(responses, drive, 1.0).map_err(TaskError::input)?;
    let samples = match responses {
        Responses::Sampled(_) => field.known(),
        Responses::Modal(modal) => {
            let slowest = modal.poles.iter().map(|pole| pole.sigma).fold(f64::INFINITY, f64::min);
            let tail = (DECAYS / slowest.max(f64::MIN_POSITIVE)).min(LONGEST);
            drive.samples() + (tail * drive.rate()).ceil() as usize
        }
    };
    let traces = field.traces(places, (samples - 1) as f64 / drive.rate()).map_err(TaskError::input)?;
    Ok(traces.into_iter().map(|trace| trace.velocity).collect())
}

/// The instant of the focus, in s.
fn instant(ask: &Ask, beside: &Beside, target: &[f64], rate: f64) -> Result<f64, TaskError> {
    // What stands beside the drive is of its own target.
    let said = beside.instant.filter(|_| ask.target_m.is_none() || ask.target_m == beside.target);
    let end = (target.len() - 1) as f64 / rate;
    match ask.instant_s.or(said) {
        Some(instant) if instant > end => {
            Err(TaskError::ask("instant_s", format!("at most {end:.4} s, the end of the recording"), instant))
        }
        Some(instant) => Ok(instant),
        None => {
            let fastest = target.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
            Ok(fastest.map_or(0, |(i, _)| i) as f64 / rate)
        }
    }
}

/// Full width at half maximum of a focus, in m, from velocities at places around it: that of the Gaussian through the centre and a place,
/// the median of all places in the focal disc whose share of the velocity at the centre tells it. `None` without such a place.
pub(super) fn spot(places: &[Point], velocities: &[f64], disc: f64) -> Option<f64> {
    let (centre, fastest) = (places.first()?, velocities.first()?.abs());
    let width = |(place, v): (&Point, &f64)| {
        let (r, share) = (place.distance(*centre), v.abs() / fastest);
        // Nearer to 1 noise decides, and nearer to 0 the side lobes.
        ((0.0..disc).contains(&r) && r > 0.0 && (0.2..0.95).contains(&share))
            .then_some(2.0 * r * (2f64.ln() / -share.ln()).sqrt())
    };
    let near = places.iter().zip(velocities).skip(1);
    unripple::dsp::median(near.filter_map(width)).filter(|width| width.is_finite() && *width < PI * disc)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spot_is_that_of_a_gaussian() {
        let places = [0.0, 4.0, -6.0, 40.0].map(|x| Point::from_mm(50.0 + x, 50.0));
        // exp(-4 ln 2 (r/w)²) with w = 10 mm.
        let velocities =
            [0.0, 4.0, -6.0, 40.0].map(|x: f64| -2.0 * (-4.0 * 2f64.ln() * (x / 10.0).powi(2)).exp());
        let width = spot(&places, &velocities, 0.02).unwrap();
        assert!((width - 0.010).abs() < 1e-9, "{width}");
        assert!(spot(&places[..1], &velocities[..1], 0.02).is_none());
    }
}
