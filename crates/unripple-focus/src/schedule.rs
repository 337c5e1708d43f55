//! When every target is in focus, and how long the drive is.

use crate::FocusError;
use unripple_core::require;

/// Largest number of samples of a drive over all channels: 400 MB of them. With twice this value, drives may be twice as long.
pub(crate) const MOST_SAMPLES: usize = 50_000_000;

/// The common period may be this many times the longest one; if it were longer, the longest one is used
/// instead. With twice this value, drives of unrelated rates are up to twice as long, and more of them
/// repeat exactly.
const MOST_PERIODS: usize = 8;

/// Focal instant and period of one target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Sample of the drive at which the target is in focus; for a repeated target, such a sample within the
    /// last full period.
    pub instant: usize,
    /// Repetition period of the focus, in samples; `None` if the target is in focus only once.
    pub period: Option<usize>,
}

/// When every target is in focus, and how long the drive is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Schedule {
    /// Number of samples in each channel.
    pub length: usize,
    /// When each target is in focus.
    pub timing: Vec<Timing>,
    /// Common period of all repeated targets, in samples; `None` if none is repeated.
    pub period: Option<usize>,
    /// Index n of the last sample of the window.
    window: usize,
}

/// Inputs from which a schedule is planned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Conditions {
    /// Samples per second.
    pub rate: f64,
    /// Index n of the last sample of the window.
    pub window: usize,
    /// Number of channels of the drive.
    pub channels: usize,
    /// Length of the drive requested, in samples.
    pub duration: Option<usize>,
    /// Samples after which free vibration has decayed; `None` if it never does.
    pub settle: Option<usize>,
}

impl Schedule {
    /// Plans the drive for targets that are repeated at these rates (Hz), or in focus once.
    ///
    /// Repeated targets are first in focus together, at sample n, and then at every multiple of their own
    /// period. The common period is their least common multiple, or the longest of them if that is over
    /// eight times as long. Without a requested duration, the drive lasts until earlier excitation has
    /// decayed by the start of the last full period, and half a period beyond a common focus. A target that
    /// is not repeated, among repeated ones, is in focus in the middle of the last full period.
    pub fn plan(rates: &[Option<f64>], conditions: Conditions) -> Result<Self, FocusError> {
        let window = conditions.window;
        let periods = rates.iter().map(|hz| hz.map(|hz| period(hz, conditions.rate)).transpose());
        let periods = periods.collect::<Result<Vec<_>, _>>()?;
        let Some(common) = common_period(periods.iter().flatten().copied()) else {
            let length = conditions.duration.unwrap_or(window + 1);
            at_least(length, window + 1, conditions)?;
            at_most(length, conditions)?;
            let once = Timing { instant: window, period: None };
            return Ok(Self { length, timing: vec![once; rates.len()], period: None, window });
        };
        let length = match conditions.duration {
            Some(length) => length,
            None => steady_length(common, conditions)?,
        };
        at_least(length, window + common, conditions)?;
        at_most(length, conditions)?;
        let timing = periods.iter().map(|&period| Timing {
            instant: period
                .map_or(length - 1 - common / 2, |period| last_focus(period, common, length, window)),
            period,
        });
        Ok(Self { length, timing: timing.collect(), period: Some(common), window })
    }

    /// All samples at which a target is in focus, ascending, including those after the drive's end if their
    /// window begins before it.
    pub fn instants(&self, timing: Timing) -> impl Iterator<Item = usize> + use<> {
        let (first, end) = match timing.period {
            Some(_) => (self.window, self.length + self.window),
            None => (timing.instant, timing.instant + 1),
        };
        (first..end).step_by(timing.period.unwrap_or(1))
    }
}

fn period(hz: f64, rate: f64) -> Result<usize, FocusError> {
    let longest = MOST_SAMPLES as f64;
    let period = (rate / hz).round();
    let legal = hz > 0.0 && 2.0 * hz <= rate && period <= longest;
    require("repetition rate (Hz)", legal, format!("{} to {}", rate / longest, rate / 2.0), hz)?;
    Ok(period as usize)
}

/// The period after which all repeat, in samples.
fn common_period(periods: impl Iterator<Item = usize> + Clone) -> Option<usize> {
    let longest = periods.clone().max()?;
    let multiple = periods
        .map(Some)
        .reduce(|a, b| {
            let (a, b) = (a?, b?);
            (a / gcd(a, b)).checked_mul(b).filter(|m| *m <= MOST_PERIODS * longest)
        })
        .flatten();
    Some(multiple.unwrap_or(longest))
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The least length, in samples, after which the last full period is steady.
fn steady_length(common: usize, conditions: Conditions) -> Result<usize, FocusError> {
    let Some(settle) = conditions.settle else {
        let expected = "one, since a mode without losses never reaches a steady state".to_owned();
        return Err(FocusError::Count { what: "duration of a repeated drive", expected, found: 0 });
    };
    let half = common / 2;
    let periods = settle.saturating_sub(half + 1).div_ceil(common) + 1;
    Ok(conditions.window.saturating_add(periods.saturating_mul(common)).saturating_add(half + 1))
}

/// The last focus at least half a period before the end, or the last focus of all if the former is before
/// the last full period.
fn last_focus(period: usize, common: usize, length: usize, window: usize) -> usize {
    let last_before = |end: usize| end.checked_sub(window).map(|past| window + past / period * period);
    last_before(length - 1 - period / 2)
        .filter(|instant| *instant + common >= length)
        .or_else(|| last_before(length - 1))
        .unwrap_or(window)
}

fn at_least(length: usize, least: usize, conditions: Conditions) -> Result<(), FocusError> {
    let seconds = |samples: usize| samples as f64 / conditions.rate;
    Ok(require("duration (s)", length >= least, format!("at least {}", seconds(least)), seconds(length))?)
}

fn at_most(length: usize, conditions: Conditions) -> Result<(), FocusError> {
    let found = length.saturating_mul(conditions.channels);
    if found <= MOST_SAMPLES {
        return Ok(());
    }
    let most = MOST_SAMPLES / conditions.channels.max(1);
    let expected = format!(
        "at most {MOST_SAMPLES} ({} channels of {} s)",
        conditions.channels,
        most as f64 / conditions.rate
    );
    Err(FocusError::Count { what: "samples of the drive", expected, found })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONDITIONS: Conditions =
        Conditions { rate: 1000.0, window: 30, channels: 2, duration: None, settle: Some(480) };

    #[test]
    fn once_is_the_window_itself() {
        let plan = Schedule::plan(&[None, None], CONDITIONS).unwrap();
        assert_eq!((plan.length, plan.period), (31, None));
        assert_eq!(plan.instants(plan.timing[1]).collect::<Vec<_>>(), [30]);
        let longer = Schedule::plan(&[None], Conditions { duration: Some(50), ..CONDITIONS }).unwrap();
        assert_eq!((longer.length, longer.timing[0].instant), (50, 30));
        let short = Schedule::plan(&[None], Conditions { duration: Some(30), ..CONDITIONS }).unwrap_err();
        assert_eq!(short.to_string(), "duration (s): expected at least 0.031, found 0.03");
    }

    #[test]
    fn five_and_two_hertz_meet_every_second() {
        let plan = Schedule::plan(&[Some(5.0), Some(2.0), None], CONDITIONS).unwrap();
        assert_eq!(plan.period, Some(1000));
        assert_eq!(plan.timing.iter().map(|t| t.period).collect::<Vec<_>>(), [Some(200), Some(500), None]);
        let start = plan.length - 1000;
        assert!(start >= 30 + 480, "steady from the start of the last full period");
        for timing in &plan.timing {
            assert!((start..plan.length).contains(&timing.instant));
            assert!(plan.instants(*timing).any(|instant| instant == timing.instant));
            assert!(plan.instants(*timing).all(|instant| instant >= 30 && instant - 30 < plan.length));
        }
    }

    #[test]
    fn every_focus_lies_in_the_last_full_period() {
        for hz in [0.7, 3.0, 7.0, 11.0, 100.0, 333.0, 500.0] {
            for duration in [None, Some(1500), Some(1517), Some(1999), Some(2600)] {
                let conditions = Conditions { duration, ..CONDITIONS };
                let Ok(plan) = Schedule::plan(&[Some(hz), Some(2.0 * hz.min(250.0))], conditions) else {
                    assert!(
                        duration.is_some_and(|d| (d as f64) < 1000.0 / hz * 2.0 + 100.0),
                        "{hz} {duration:?}"
                    );
                    continue;
                };
                for timing in &plan.timing {
                    let start = plan.length - plan.period.unwrap();
                    assert!((start..plan.length).contains(&timing.instant), "{hz} {duration:?} {plan:?}");
                }
            }
        }
    }

    #[test]
    fn incommensurate_rates_fall_back_to_the_longest_period() {
        let plan = Schedule::plan(&[Some(3.0), Some(7.0)], CONDITIONS).unwrap();
        assert_eq!(plan.period, Some(333));
    }

    #[test]
    fn refuses_the_absurd() {
        for hz in [0.0, -1.0, f64::NAN, f64::INFINITY, 501.0, 1e-9] {
            assert!(matches!(Schedule::plan(&[Some(hz)], CONDITIONS), Err(FocusError::Range(_))), "{hz}");
        }
        let slow = Schedule::plan(&[Some(3e-5)], CONDITIONS).unwrap_err().to_string();
        assert!(slow.contains("at most 50000000 (2 channels of 25000 s)"), "{slow}");
        let lossless = Conditions { settle: None, ..CONDITIONS };
        assert!(Schedule::plan(&[Some(5.0)], lossless).unwrap_err().to_string().contains("without losses"));
        assert!(Schedule::plan(&[Some(5.0)], Conditions { duration: Some(1000), ..lossless }).is_ok());
    }
}
