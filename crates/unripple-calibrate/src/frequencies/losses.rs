//! Damping of a fitted surface, from the decay times of its modes.

use super::{Explained, Heard};
use std::f64::consts::PI;
use unripple_core::{Decay, Surface};

/// Half of a 95 % interval in standard deviations of a mean.
const HALF: f64 = 1.96;

/// Least loss factor that a surface file may have.
const LEAST: f64 = 1e-6;

/// Damping that was found from decay times.
#[derive(Clone, Debug, PartialEq)]
pub enum FittedLosses {
    /// The loss factor of the material, the geometric mean over the modes, and its 95 % interval if there are several.
    LossFactor {
        /// Loss factor, a ratio.
        value: f64,
        /// Ends of the interval.
        interval: Option<[f64; 2]>,
    },
    /// Decay times by frequency: pairs of Hz and s, ascending.
    DecayTimes(Vec<(f64, f64)>),
}

impl FittedLosses {
    /// The damping that the decay times of a surface's modes tell, by the law of its file: a loss factor, or decay times. `None` if no mode
    /// has one, or if no mode bends, where a loss factor has no effect.
    pub(super) fn of(explained: &Explained, heard: &[Heard], bending: &[f64]) -> Option<Self> {
        let timed = explained.modes.iter().filter_map(|mode| Some((mode, heard[mode.heard].decay_time?)));
        if let Decay::LossFactor(_) = explained.surface.sheet.decay {
            let factor = |(mode, time): (&super::MatchedMode, f64)| {
                let share = bending.get(mode.mode).copied().unwrap_or(1.0);
                (share > 0.01).then(|| (1.0 / (PI * mode.measured_hz * time * share)).ln())
            };
            return Self::factor(&timed.filter_map(factor).collect::<Vec<f64>>());
        }
        let mut rows: Vec<(f64, f64)> = timed.map(|(mode, time)| (mode.measured_hz, time)).collect();
        rows.dedup_by(|later, earlier| later.0 <= earlier.0);
        (!rows.is_empty()).then_some(Self::DecayTimes(rows))
    }

    /// The mean of the logarithms of loss factors.
    fn factor(logs: &[f64]) -> Option<Self> {
        let count = logs.len() as f64;
        let mean = logs.iter().sum::<f64>() / count;
        let square = logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>();
        let half = HALF * (square / (count * (count - 1.0))).sqrt();
        let interval = (logs.len() > 1).then(|| [(mean - half).exp(), (mean + half).exp()]);
        (!logs.is_empty()).then(|| Self::LossFactor { value: mean.exp(), interval })
    }

    /// Gives a surface this damping.
    pub(super) fn put(&self, surface: &mut Surface) {
        surface.sheet.decay = match self {
            Self::LossFactor { value, .. } => Decay::LossFactor(value.clamp(LEAST, 1.0)),
            Self::DecayTimes(rows) => match rows[..] {
                [(_, time)] => Decay::Time(time),
                _ => Decay::Table(rows.clone()),
            },
        };
    }
}
