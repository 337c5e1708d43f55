//! Two foci repeated at different rates: the drive, and the motion of five points.

use crate::reproduce::PaperSetup;
use crate::reproduce::fields::cells;
use serde::Serialize;
use unripple::core::{Drive, Point, window_samples};
use unripple::field::{self, Field, Snapshot, Trace};
use unripple::focus::{Focused, Focuser, Options, Target};
use unripple_dsp::rms;
use unripple_tasks::TaskError;
use unripple_tasks::judge::CELLS;

/// Repetition rates at E and D, in Hz.
pub(super) const RATES: [f64; 2] = [5.0, 2.0];

/// The second focus, and three points that are no foci.
const D: Point = Point::new(0.100, 0.048);
const OTHERS: [(&str, Point); 3] =
    [("A", Point::new(0.034, 0.038)), ("B", Point::new(0.078, 0.124)), ("C", Point::new(0.122, 0.084))];

/// Amplitude of the pulses in the paper, in metres.
pub(super) const AMPLITUDE: f64 = 40e-6;

/// Largest number of rounds in which the pulses of the two foci are made equal, and relative difference
/// below which they count as equal.
const ROUNDS: usize = 6;
const EQUAL: f64 = 1e-4;

/// Length of the drive after its first common focus, in seconds. It contains two common periods, and the
/// interval that is drawn begins late in the first.
pub(super) const LASTS: f64 = 2.35;

/// Start of the interval that is drawn and measured, in seconds after the first common focus.
pub(super) const STEADY: f64 = 0.9;

/// Time on either side of a focus that does not count as noise, in seconds. Twice as long would leave out
/// noise, half as long would count the pulse itself.
const PULSE: f64 = 2e-3;

/// The drive of two repeated foci, its field, and the motion of five points.
pub(super) struct Repeated {
    pub(super) drive: Drive,
    /// Common period of both foci, in seconds.
    pub(super) period: f64,
    pub(super) cells: field::Grid,
    /// The field at the extreme of E's pulse when D is in focus too.
    pub(super) shot: Snapshot,
    pub(super) points: Vec<Tracked>,
    pub(super) pulses: Vec<Pulse>,
    pub(super) rounds: usize,
}

/// Contrast of one pulse of a repeated focus.
#[derive(Serialize)]
pub(super) struct Pulse {
    pub(super) name: &'static str,
    /// Whether the other focus falls on the same instant.
    pub(super) together: bool,
    /// Velocity at the focal instant over the rms outside every focal disc.
    pub(super) contrast: f64,
    /// Displacement at its extreme over the rms outside every focal disc at that instant.
    pub(super) displacement_contrast: f64,
}

/// A point whose motion is evaluated.
pub(super) struct Tracked {
    pub(super) name: &'static str,
    pub(super) at: Point,
    /// Repetition rate of the focus at the point, in Hz; `None` if the point is no focus.
    pub(super) hz: Option<f64>,
    velocity: Vec<f64>,
    pub(super) displacement: Vec<f64>,
}

impl Tracked {
    /// Sample within [`PULSE`] of a focus at which the displacement is largest.
    fn extreme(&self, setup: &PaperSetup, focus: usize) -> usize {
        let reach = window_samples(PULSE, setup.rate);
        let larger = |best: usize, i: usize| {
            if self.displacement[i].abs() > self.displacement[best].abs() { i } else { best }
        };
        (focus.saturating_sub(reach)..(focus + reach + 1).min(self.displacement.len())).fold(focus, larger)
    }

    /// Samples from `first` on at which the point is in focus, the first common focus being sample `origin`.
    fn foci(&self, origin: usize, first: usize, rate: f64) -> Vec<usize> {
        let Some(hz) = self.hz else { return Vec::new() };
        let period = (rate / hz).round() as usize;
        (origin..self.displacement.len()).step_by(period.max(1)).filter(|i| *i >= first).collect()
    }

    /// Height of each pulse: the largest magnitude within [`PULSE`] of each focus, in metres.
    pub(super) fn pulses(&self, setup: &PaperSetup) -> Vec<f64> {
        let foci = self.foci(window_samples(setup.window, setup.rate), steady(setup), setup.rate);
        foci.into_iter().map(|focus| self.displacement[self.extreme(setup, focus)].abs()).collect()
    }

    /// Displacement of the point in the steady state, without its own pulses.
    pub(super) fn noise(&self, setup: &PaperSetup) -> Vec<f64> {
        let (origin, reach) = (window_samples(setup.window, setup.rate), window_samples(PULSE, setup.rate));
        let (from, foci) = (steady(setup), self.foci(origin, origin, setup.rate));
        let free = |i: &usize| foci.iter().all(|f| f.abs_diff(*i) > reach);
        (from..self.displacement.len()).filter(free).map(|i| self.displacement[i]).collect()
    }
}

/// First sample of the interval that counts as the steady state.
pub(super) fn steady(setup: &PaperSetup) -> usize {
    window_samples(setup.window + STEADY, setup.rate)
}

/// The mean of `values`; 0 if there are none.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

impl Repeated {
    /// Computes the drive, and evaluates the motion of all points.
    pub(super) fn make(setup: &PaperSetup) -> Result<Self, TaskError> {
        let options = Options {
            window: setup.window,
            limit: setup.surface.emission.limit,
            duration: Some(setup.window + LASTS),
            ..Options::default()
        };
        let focuser = Focuser::new(&setup.responses, &options).map_err(TaskError::work)?;
        let (focused, rounds) = levelled(setup, &focuser)?;
        let period = focused.period.map_or(f64::NAN, |samples| samples as f64 / setup.rate);
        let drive = focused.drive;
        let field = Field::new(&setup.responses, &drive, CELLS).map_err(TaskError::work)?;
        let points = tracked(setup, &field)?;
        let (pulses, shot) = pulses(setup, &field, &points, period)?;
        let cells = cells(&field)?;
        drop(field);
        Ok(Self { drive, period, cells, shot, points, pulses, rounds })
    }

    /// The points that are foci.
    pub(super) fn foci(&self) -> impl Iterator<Item = &Tracked> {
        self.points.iter().filter(|point| point.hz.is_some())
    }

    /// The points that are no foci.
    pub(super) fn others(&self) -> impl Iterator<Item = &Tracked> {
        self.points.iter().filter(|point| point.hz.is_none())
    }
}

/// Names and places of all points, with the repetition rates of the foci, which come first.
fn places(setup: &PaperSetup) -> Vec<(&'static str, Point, Option<f64>)> {
    let foci = [("E", setup.target, Some(RATES[0])), ("D", D, Some(RATES[1]))];
    foci.into_iter().chain(OTHERS.map(|(name, at)| (name, at, None))).collect()
}

fn tracked(setup: &PaperSetup, field: &Field) -> Result<Vec<Tracked>, TaskError> {
    let places = places(setup);
    let points: Vec<Point> = places.iter().map(|(_, at, _)| *at).collect();
    let traces: Vec<Trace> = field.traces(&points, setup.window + LASTS).map_err(TaskError::work)?;
    let pairs = places.into_iter().zip(traces);
    Ok(pairs
        .map(|((name, at, hz), trace)| Tracked {
            name,
            at,
            hz,
            velocity: trace.velocity,
            displacement: trace.displacement,
        })
        .collect())
}

/// Pulses of E and of D, alone and together, after the first period; and the film at the extreme of E's when together.
fn pulses(
    setup: &PaperSetup,
    field: &Field,
    points: &[Tracked],
    period: f64,
) -> Result<(Vec<Pulse>, Snapshot), TaskError> {
    let [e, d, ..] = points else { return Err(TaskError::Work("expected two foci".into())) };
    let common = window_samples(setup.window + period, setup.rate);
    let after = |hz: f64| common + window_samples(1.0 / hz, setup.rate);
    let asked =
        [(e, common, true), (d, common, true), (e, after(RATES[0]), false), (d, after(RATES[1]), false)];
    let extremes = asked.map(|(point, focus, _)| point.extreme(setup, focus));
    let instants: Vec<f64> = asked
        .iter()
        .map(|(_, focus, _)| *focus)
        .chain(extremes)
        .map(|sample| sample as f64 / setup.rate)
        .collect();
    let mut shots = field.snapshots(&instants).map_err(TaskError::work)?;
    let radius = setup.responses.conditions().focal_radius();
    let outside: Vec<bool> =
        field.points().iter().map(|p| [e, d].iter().all(|focus| focus.at.distance(*p) > radius)).collect();
    let noise = |values: &[f32]| {
        let beyond = values.iter().zip(&outside).filter(|(_, outside)| **outside);
        rms(&beyond.map(|(v, _)| f64::from(*v)).collect::<Vec<_>>())
    };
    let pulse = |(i, (point, focus, together)): (usize, &(&Tracked, usize, bool))| Pulse {
        name: point.name,
        together: *together,
        contrast: point.velocity[*focus].abs() / noise(&shots[i].velocity),
        displacement_contrast: point.displacement[extremes[i]].abs()
            / noise(&shots[i + asked.len()].displacement),
    };
    let pulses = asked.iter().enumerate().map(pulse).collect();
    Ok((pulses, shots.swap_remove(asked.len())))
}

/// The drive whose pulses at both foci have the paper's height on average, and the number of rounds; gain
/// and level are found from the emitted drive.
fn levelled(setup: &PaperSetup, focuser: &Focuser) -> Result<(Focused, usize), TaskError> {
    let (mut gain, mut round) = (1.0, 0);
    loop {
        round += 1;
        let targets =
            [Target::at(setup.target).repeated(RATES[0]), Target::at(D).with_gain(gain).repeated(RATES[1])];
        let mut focused = focuser.focus(&targets).map_err(TaskError::work)?;
        let heights = |drive: &Drive| -> Result<Vec<f64>, TaskError> {
            let field = Field::new(&setup.responses, drive, CELLS).map_err(TaskError::work)?;
            let points = tracked(setup, &field)?;
            Ok(points.iter().filter(|p| p.hz.is_some()).map(|p| mean(&p.pulses(setup))).collect())
        };
        let unscaled = heights(&focused.drive)?;
        focused.drive = focused.drive.scaled(AMPLITUDE / unscaled[0]).as_emitted();
        if (unscaled[1] / unscaled[0] - 1.0).abs() < EQUAL || round == ROUNDS {
            return Ok((focused, round));
        }
        gain *= unscaled[0] / unscaled[1];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::fields::largest;

    #[test]
    fn pulses_are_equal_and_on_time() {
        let setup = PaperSetup::new().unwrap();
        let repeated = Repeated::make(&setup).unwrap();
        assert_eq!(repeated.period, 1.0);
        for (point, hz) in repeated.foci().zip(RATES) {
            let pulses = point.pulses(&setup);
            assert_eq!(pulses.len(), ((LASTS * hz).floor() - (STEADY * hz).ceil()) as usize + 1);
            assert!((mean(&pulses) / AMPLITUDE - 1.0).abs() < 1e-3, "{}: {pulses:?}", point.name);
            assert!(largest(&point.noise(&setup)) < AMPLITUDE / 2.0);
        }
        let of = |together: bool| {
            mean(
                &repeated
                    .pulses
                    .iter()
                    .filter(|p| p.together == together)
                    .map(|p| p.contrast)
                    .collect::<Vec<_>>(),
            )
        };
        let gain = of(false) / of(true);
        assert!((gain / 2.0_f64.sqrt() - 1.0).abs() < 0.15, "two foci cost {gain}");
    }
}
