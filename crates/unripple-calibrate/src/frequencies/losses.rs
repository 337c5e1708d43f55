//! Damping of a fitted surface, from the decay times of its modes.

use super::{Explained, Heard};
use std::f64::consts::PI;
use unripple_core::{Decay, Surface};

/// Half of a 95 % interval in standard deviations of a mean: Student's t with 1, 2 and 3 degrees of freedom, and that of the normal
/// distribution.
const STUDENT: [f64; 3] = [12.7062, 4.3027, 3.1824];
const NORMAL: f64 = 1.959_964;

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

    /// The mean of the logarithms of loss factors. Their spread is known from themselves alone, so that its interval is Student's.
    fn factor(logs: &[f64]) -> Option<Self> {
        let count = logs.len() as f64;
        let mean = logs.iter().sum::<f64>() / count;
        let square = logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>();
        let half = student(logs.len().saturating_sub(1)) * (square / (count * (count - 1.0))).sqrt();
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

/// The 97.5 % quantile of Student's t: by its expansion in 1/n (Abramowitz and Stegun, 26.7.5), within 0.3 % from 4 degrees of freedom on.
fn student(freedom: usize) -> f64 {
    if freedom == 0 {
        return f64::INFINITY;
    }
    let (z, n) = (NORMAL, freedom as f64);
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    STUDENT.get(freedom - 1).copied().unwrap_or(z + (first + (second + third / n) / n) / n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        let tables = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];
        for (freedom, quantile) in (1..).zip(tables) {
            let found = student(freedom);
            assert!((found / quantile - 1.0).abs() < 3e-3, "{freedom}: {found} for {quantile}");
        }
        assert!((student(10_000) - 1.960).abs() < 1e-3);
    }

    #[test]
    fn an_interval_of_few_decay_times_is_wide() {
        let found = FittedLosses::factor(&[0.01_f64.ln(), 0.02_f64.ln()]);
        let Some(FittedLosses::LossFactor { value, interval: Some([low, high]) }) = found else {
            panic!("{found:?}")
        };
        // Two values are a factor of two apart: the deviation of the mean of their logarithms is half of ln 2.
        let half = 12.7062 * 0.5 * 2.0_f64.ln();
        assert!((value / 2e-4_f64.sqrt() - 1.0).abs() < 1e-12, "{value}");
        assert!(((value / low).ln() / half - 1.0).abs() < 1e-9, "{low}");
        assert!(((high / value).ln() / half - 1.0).abs() < 1e-9, "{high}");
        assert!(matches!(
            FittedLosses::factor(&[0.0]),
            Some(FittedLosses::LossFactor { interval: None, .. })
        ));
        assert_eq!(FittedLosses::factor(&[]), None);
    }
}
