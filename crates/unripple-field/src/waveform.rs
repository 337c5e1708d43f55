//! How well a target follows its prescribed waveform.

use crate::{Field, FieldError, Trace};
use serde::Serialize;
use unripple_core::Point;
use unripple_dsp::Convolver;

/// A target, and the waveform prescribed for it, from the drive's first sample on.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Place of the target, in metres: a point, or a set of points that are all to have this motion.
    pub points: Vec<Point>,
    /// Prescribed motion, one value per sample from the drive's first, zero after the last; in metres or m/s.
    pub samples: Vec<f64>,
}

/// Metrics of how well a target follows its prescribed waveform.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WaveformFigures {
    /// The target's first point, in metres.
    pub at_m: [f64; 2],
    /// Number of points of the target; all metrics but `gain_range` are of their mean motion.
    pub points: usize,
    /// Gain of the motion found relative to the one prescribed, dimensionless: ∫found·prescribed /
    /// ∫prescribed².
    pub gain: f64,
    /// Least and greatest gain over a set of points; `None` for one point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gain_range: Option<[f64; 2]>,
    /// Rms of the difference between the motion found and the prescribed one, relative to the rms of the
    /// prescribed motion, in dB, over the whole time evaluated.
    pub error_db: f64,
    /// Crosstalk: the strongest of the other targets' waveforms, at any delay, in what remains of the target's motion after `gain`
    /// times its own waveform is subtracted, in dB relative to that other waveform; `None` for a single target.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crosstalk_db: Option<f64>,
    /// Largest magnitude of the target's motion, in metres or m/s.
    pub peak: f64,
}

/// Residual motion at a point of silence.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SilenceFigures {
    /// Position of the point of silence, in metres.
    pub at_m: [f64; 2],
    /// Rms of the motion at this point relative to the rms of the strongest prescribed waveform, in dB.
    pub level_db: f64,
}

impl Field<'_> {
    /// Evaluates how well targets follow their waveforms up to the time `until` (s), and the residual motion
    /// at the points of silence. `pick` takes displacement or velocity from a trace.
    ///
    /// # Errors
    /// As [`Field::traces`], and [`FieldError::Count`] for a target without points.
    pub fn followed(
        &self,
        wanted: &[Wanted],
        silent: &[Point],
        until: f64,
        pick: fn(&Trace) -> &[f64],
    ) -> Result<(Vec<WaveformFigures>, Vec<SilenceFigures>), FieldError> {
        if wanted.iter().any(|w| w.points.is_empty()) {
            let expected = "at least 1".to_owned();
            return Err(FieldError::Count { what: "points of a target", expected, found: 0 });
        }
        let traced = |points: &[Point]| -> Result<Vec<Vec<f64>>, FieldError> {
            Ok(self.traces(points, until)?.iter().map(|trace| pick(trace).to_vec()).collect())
        };
        let found = wanted.iter().map(|w| traced(&w.points)).collect::<Result<Vec<_>, _>>()?;
        let loudest = wanted.iter().map(|w| energy(&w.samples)).fold(0.0, f64::max);
        let still = |(at, trace): (&Point, &Vec<f64>)| SilenceFigures {
            at_m: [at.x, at.y],
            level_db: decibels(energy(trace) / loudest),
        };
        let followed = (0..wanted.len()).map(|i| figures(i, wanted, &found[i])).collect();
        Ok((followed, silent.iter().zip(&traced(silent)?).map(still).collect()))
    }
}

/// Metrics of the target with this index.
fn figures(index: usize, wanted: &[Wanted], found: &[Vec<f64>]) -> WaveformFigures {
    let Wanted { points, samples } = &wanted[index];
    let own = energy(samples);
    let gain = |trace: &Vec<f64>| trace.iter().zip(samples).map(|(a, b)| a * b).sum::<f64>() / own;
    let gains: Vec<f64> = found.iter().map(gain).collect();
    let range = gains.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], g| [l.min(*g), h.max(*g)]);
    let length = found.first().map_or(0, Vec::len);
    let mean: Vec<f64> =
        (0..length).map(|i| found.iter().map(|t| t[i]).sum::<f64>() / found.len() as f64).collect();
    let asked = |i: usize| samples.get(i).copied().unwrap_or(0.0);
    let error: Vec<f64> = mean.iter().enumerate().map(|(i, x)| x - asked(i)).collect();
    let level = gain(&mean);
    let rest: Vec<f64> = mean.iter().enumerate().map(|(i, x)| x - level * asked(i)).collect();
    let others = wanted.iter().enumerate().filter(|(i, _)| *i != index);
    let crosstalk = others.map(|(_, other)| likeness(&rest, &other.samples)).reduce(f64::max);
    WaveformFigures {
        at_m: [points[0].x, points[0].y],
        points: points.len(),
        gain: level,
        gain_range: (points.len() > 1).then_some(range),
        error_db: decibels(energy(&error) / own),
        crosstalk_db: crosstalk.map(|share| decibels(share * share)),
        peak: mean.iter().fold(0.0, |m, x| m.max(x.abs())),
    }
}

/// The largest share of `other` in a signal over all delays: their correlation over the energy of `other`.
fn likeness(signal: &[f64], other: &[f64]) -> f64 {
    let plan = Convolver::new(signal.len() + other.len());
    let mut product = plan.spectrum(signal.iter().copied());
    product.iter_mut().zip(plan.spectrum(other.iter().rev().copied())).for_each(|(a, b)| *a *= b);
    plan.signal(product).iter().fold(0.0, |m: f64, x| m.max(x.abs())) / energy(other)
}

fn energy(signal: &[f64]) -> f64 {
    signal.iter().map(|x| x * x).sum()
}

/// A ratio of powers in dB; a ratio of zero counts as -400 dB.
fn decibels(ratio: f64) -> f64 {
    10.0 * ratio.max(1e-40).log10()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn tone(cycles: f64, phase: f64) -> Vec<f64> {
        (0..4000).map(|i| (TAU * cycles * f64::from(i) / 4000.0 + phase).sin()).collect()
    }

    /// Levels, errors and cross-talk put in by hand are those that come out.
    #[test]
    fn finds_what_was_mixed() {
        let of = |samples| Wanted { points: vec![Point::default()], samples };
        let wanted = [of(tone(20.0, 0.0)), of(tone(7.0, 0.0))];
        let mix = |i: usize| 0.9 * tone(20.0, 0.0)[i] + 0.05 * tone(7.0, 1.0)[i];
        let found: Vec<f64> = (0..4000).map(mix).collect();
        let figures = figures(0, &wanted, &[found]);
        assert!((figures.gain - 0.9).abs() < 1e-9, "{}", figures.gain);
        let error = 10.0 * (0.1_f64 * 0.1 + 0.05 * 0.05).log10();
        assert!((figures.error_db - error).abs() < 1e-6, "{} {error}", figures.error_db);
        // A delay of one whole tone leaves part of it outside: within a tenth of the exact 0.05.
        let crosstalk = figures.crosstalk_db.unwrap();
        assert!((crosstalk - 20.0 * 0.05_f64.log10()).abs() < 1.0, "{crosstalk}");
    }

    #[test]
    fn sets_are_told_point_by_point() {
        let wanted = [Wanted { points: vec![Point::default(); 2], samples: tone(3.0, 0.0) }];
        let scaled = |by: f64| tone(3.0, 0.0).iter().map(|x| by * x).collect::<Vec<_>>();
        let figures = figures(0, &wanted, &[scaled(0.5), scaled(1.5)]);
        assert!((figures.gain - 1.0).abs() < 1e-12 && figures.error_db < -200.0);
        let range = figures.gain_range.unwrap();
        assert!((range[0] - 0.5).abs() < 1e-12 && (range[1] - 1.5).abs() < 1e-12);
        assert_eq!(figures.crosstalk_db, None);
    }
}
