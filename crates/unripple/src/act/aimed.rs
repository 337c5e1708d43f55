//! Places and instants at which a drive is evaluated.

use crate::field::Aim;
use crate::focus::{Focused, Target, Timing};

/// Places and instants at which a drive is evaluated.
#[derive(Clone, Debug)]
pub(super) struct Aimed {
    /// Where and when the drive is evaluated.
    pub aims: Vec<Aim>,
    /// Period of a repeated drive, in samples.
    pub period: Option<usize>,
    /// End of the time that is evaluated, in seconds.
    pub until: f64,
    /// End of the traces, in seconds.
    pub traced: f64,
    rate: f64,
}

impl Aimed {
    /// Places and instants for the evaluation of a focus on `targets`, made with a window of `window`
    /// seconds.
    pub fn of(targets: &[Target], focused: &Focused, window: f64) -> Self {
        let rate = focused.drive.rate();
        let seconds = |samples: usize| samples as f64 / rate;
        let timed = targets.iter().zip(focused.instants());
        let aims = timed.map(|(target, instant)| Aim { points: target.points.clone(), instant }).collect();
        let last = focused.timing.iter().map(|timing| timing.instant).max().unwrap_or(0);
        let until = match focused.period {
            Some(_) => seconds(focused.drive.samples().saturating_sub(1)),
            None => 2.0 * seconds(last),
        };
        let traced = until.max(seconds(last_focus(focused)) + window / 2.0);
        Self { aims, period: focused.period, until, traced, rate }
    }

    /// The period, in seconds.
    pub fn seconds(&self) -> Option<f64> {
        self.period.map(|samples| samples as f64 / self.rate)
    }
}

/// The last sample of a drive at which a target is in focus.
fn last_focus(focused: &Focused) -> usize {
    let end = focused.drive.samples().saturating_sub(1);
    let last = |timing: &Timing| {
        let repeats = timing.period.map_or(0, |period| end.saturating_sub(timing.instant) / period * period);
        timing.instant + repeats
    };
    focused.timing.iter().map(last).max().unwrap_or(0)
}
