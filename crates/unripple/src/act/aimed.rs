//! Places and instants at which a drive is evaluated.

use crate::field::Aim;
use crate::focus::{Focused, Target};

/// Places and instants at which a drive is evaluated.
#[derive(Clone, Debug)]
pub(super) struct Aimed {
    /// Where and when the drive is evaluated.
    pub aims: Vec<Aim>,
    /// Period of a repeated drive, in samples.
    pub period: Option<usize>,
    /// End of the time that is evaluated, in seconds.
    pub until: f64,
    rate: f64,
}

impl Aimed {
    /// Those of a focus on some targets.
    pub fn of(targets: &[Target], focused: &Focused) -> Self {
        let rate = focused.drive.rate();
        let seconds = |samples: usize| samples as f64 / rate;
        let timed = targets.iter().zip(focused.instants());
        let aims = timed.map(|(target, instant)| Aim { points: target.points.clone(), instant }).collect();
        let last = focused.timing.iter().map(|timing| timing.instant).max().unwrap_or(0);
        let until = match focused.period {
            Some(_) => seconds(focused.drive.samples().saturating_sub(1)),
            None => 2.0 * seconds(last),
        };
        Self { aims, period: focused.period, until, rate }
    }

    /// The period, in seconds.
    pub fn seconds(&self) -> Option<f64> {
        self.period.map(|samples| samples as f64 / self.rate)
    }
}
