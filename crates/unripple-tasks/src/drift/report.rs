//! Report of the task `drift`: change of tension, and its rate.

use super::Cost;
use super::known::Known;
use serde::{Serialize, Serializer};
use std::fmt::Write;
use unripple_calibrate::{Drift, Ping};

/// Number of standard errors above which a change or a rate counts as real.
const SURE: f64 = 3.0;

/// Relative change of tension per minute below which a sheet counts as steady: it turns the phases of waves
/// at 3 kHz that ring for 70 ms by half a radian, which a focus hardly notices.
const STEADY: f64 = 1e-3;

/// Relative change of tension per minute above which the estimate counts as wrong: a film under a warm hand
/// changes by a hundredth or so. A model that does not fit, as that of a surface file which was never
/// fitted, follows what it cannot explain at such rates.
const FASTEST: f64 = 0.1;

/// Expected relative error of the rate of change: rates come out low by a sixth where the band ends at 1
/// kHz, and by less in wider bands.
const RATE: f64 = 0.2;

/// Share of its peak and contrast that a focus must keep for the change of tension to need no action.
const KEPT: f64 = 0.95;

/// Verdict on a sheet's tension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The tension is constant, at its earlier value or at another.
    Steady,
    /// The tension keeps changing.
    Drifting,
    /// No tension explains the sensors' signals, or only one that changes faster than that of any sheet.
    Unexplained,
}

impl Verdict {
    /// Name of the verdict in reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::Drifting => "drifting",
            Self::Unexplained => "unexplained",
        }
    }
}

impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// Estimate of the tension after one ping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Time from the start of the first ping to the end of this ping's observation, in s.
    pub time_s: f64,
    /// Relative change of tension since the reference; `None` if no tension explains the sensors' signals.
    pub change: Option<f64>,
    /// Rms residual of the sensors' signals after the fit of the tension, relative to the rms expected from
    /// noise and model error (ratio).
    pub excess: f64,
    #[serde(skip)]
    error: f64,
    #[serde(skip)]
    limit: Option<f64>,
}

impl Step {
    /// Makes the estimate from an observation that ended at `time_s` (s).
    pub(super) fn of(time_s: f64, drift: &Drift) -> Self {
        match *drift {
            Drift::Followed { tension, error, excess, .. } => {
                Self { time_s, change: Some(tension - 1.0), excess, error, limit: None }
            }
            Drift::Unexplained { excess, limit, .. } => {
                Self { time_s, change: None, excess, error: f64::NAN, limit: Some(limit) }
            }
        }
    }
}

/// Tension of a sheet compared with the tension that its responses assume, in SI units.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    program: &'static str,
    version: &'static str,
    command: &'static str,
    surface: String,
    /// Name of the reference that the tension is compared with.
    pub against: String,
    /// Verdict on the tension.
    #[serde(rename = "state")]
    pub verdict: Verdict,
    /// Relative change of tension at the end of the measurement; absent where no tension explains the
    /// sensors' signals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change: Option<f64>,
    /// Standard error of `change`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change_error: Option<f64>,
    /// Rate of the relative change of tension, per minute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change_per_min: Option<f64>,
    /// Standard error of `change_per_min`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change_per_min_error: Option<f64>,
    /// Tension that the responses assume, and the measured one, in N/m.
    tension_assumed_n_per_m: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    tension_n_per_m: Option<f64>,
    /// Rms residual of the last ping, relative to the rms expected from noise and model error (ratio).
    excess: f64,
    /// Share of the sensors' signals that the model may leave unexplained.
    model_error: f64,
    /// Rms noise of the sensors' signals, in the sensors' unit.
    pub noise: f64,
    /// Latency from drive to sensor signal, in samples.
    pub latency_samples: f64,
    /// Largest felt level of a ping anywhere, in dB above the threshold of touch.
    ping_felt_db: f64,
    /// Peak and contrast of a focus that was computed for the earlier tension, before and after the change.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub focus: Option<Cost>,
    /// Estimates of the tension after each ping.
    pub pings: Vec<Step>,
    /// The estimated rate of change per minute, if it is above [`FASTEST`].
    #[serde(skip)]
    too_fast: Option<f64>,
}

impl Report {
    /// Report on all pings. `missed` is the relative change of tension that the model's error may be
    /// mistaken for; `law` is the relative error of the law by which modes depend on tension.
    pub(super) fn of(known: &Known, ping: &Ping, pings: Vec<Step>, (missed, law): (f64, f64)) -> Self {
        let last = pings.last().copied();
        let followed = last.and_then(|step| step.change.map(|change| (step, change)));
        // What is left beyond what the model may leave is the model's error as well.
        let missed = missed * last.map_or(1.0, |step| step.excess.max(1.0));
        let change_error = followed.map(|(step, change)| step.error.hypot(missed).hypot(law * change));
        let line = followed.and_then(|_| slope(&pings));
        let (change_per_min, change_per_min_error) = line.map_or((None, None), |[rate, error]| {
            // What the model misses is nearly the same at each ping; it is allowed to be another at the last than at the first.
            let time = last.map_or(1.0, |step| step.time_s);
            (Some(60.0 * rate), Some(60.0 * error.hypot(missed / time).hypot(RATE * rate)))
        });
        let too_fast = change_per_min.filter(|rate| rate.abs() > FASTEST);
        let verdict = match change_per_min.zip(change_per_min_error) {
            None => Verdict::Unexplained,
            Some(_) if too_fast.is_some() => Verdict::Unexplained,
            Some((rate, error)) if rate.abs() > STEADY.max(SURE * error) => Verdict::Drifting,
            Some(_) => Verdict::Steady,
        };
        let assumed = known.tension();
        let change = followed.map(|(_, change)| change).filter(|_| too_fast.is_none());
        Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "drift",
            surface: known.surface.name.clone(),
            against: known.against.clone(),
            verdict,
            change,
            change_error,
            change_per_min,
            change_per_min_error,
            tension_assumed_n_per_m: assumed,
            tension_n_per_m: change.map(|change| assumed * (1.0 + change)),
            excess: last.map_or(0.0, |step| step.excess),
            model_error: known.unexplained(),
            noise: 0.0,
            latency_samples: 0.0,
            ping_felt_db: ping.felt_db,
            focus: None,
            pings,
            too_fast,
        }
    }

    /// The likely reason why no tension explains the sensors' signals, with what to do.
    fn blame(&self) -> &'static str {
        match self.against == super::known::FILE {
            true => "a surface file alone seldom fits a real sheet: calibrate it, then give the library",
            false => "the sheet has changed in other ways than its tension: calibrate again",
        }
    }

    /// What to do about the change of tension.
    fn advice(&self) -> String {
        let little = self.focus.is_none_or(|focus| focus.contrast_share().min(focus.peak_share) >= KEPT);
        match self.verdict {
            Verdict::Unexplained => "calibrate again".into(),
            Verdict::Drifting => {
                "let `play` follow it (`follow_tension`), or wait until it is steady, and calibrate then"
                    .into()
            }
            Verdict::Steady if little => "nothing need be done".into(),
            Verdict::Steady => match self.tension_n_per_m {
                Some(tension) if self.against == super::known::FILE => format!(
                    "set the surface file's `tension_n_per_m` to {tension:.2}, or let `play` follow it (`follow_tension`)"
                ),
                _ => "calibrate again, or let `play` follow it (`follow_tension`)".into(),
            },
        }
    }
}

/// Rate of the relative change and its standard error (1/s): the slope of a least-squares line through the
/// estimates of single pings, and its error from their scatter. The first estimate is left out, since it
/// contains nothing of the rate yet.
fn slope(pings: &[Step]) -> Option<[f64; 2]> {
    let known: Vec<[f64; 2]> =
        pings.iter().skip(1).filter_map(|step| Some([step.time_s, step.change?])).collect();
    let count = known.len() as f64;
    let mean = |axis: usize| known.iter().map(|point| point[axis]).sum::<f64>() / count;
    let (time, change) = (mean(0), mean(1));
    let square = known.iter().map(|[t, _]| (t - time).powi(2)).sum::<f64>();
    if square <= 0.0 {
        return None;
    }
    let rate = known.iter().map(|[t, x]| (t - time) * (x - change)).sum::<f64>() / square;
    let left = known.iter().map(|[t, x]| (x - change - rate * (t - time)).powi(2)).sum::<f64>();
    Some([rate, (left / (count - 2.0).max(1.0) / square).sqrt()])
}

/// A share and its error as text, such as `+0.500 ± 0.001 %`.
fn percent(share: f64, error: f64) -> String {
    format!("{:+.4} ± {:.4} %", 100.0 * share, 100.0 * error)
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = format!(
            "{}: {}, from {} pings {:.0} dB below the threshold of touch\n",
            self.surface,
            self.verdict.name(),
            self.pings.len(),
            -self.ping_felt_db
        );
        if let Some((change, error)) = self.change.zip(self.change_error) {
            let sure = if change.abs() > SURE * error { "" } else { ", not significantly different from 0" };
            let _ = writeln!(text, "  tension   {} against {}{sure}", percent(change, error), self.against);
        }
        if let Some((rate, error)) = self.change_per_min.zip(self.change_per_min_error) {
            let _ = writeln!(text, "  rate      {} a minute", percent(rate, error));
        }
        if let Some(tension) = self.tension_n_per_m {
            let _ = writeln!(
                text,
                "            {tension:.3} N/m, where the responses assume {:.3}",
                self.tension_assumed_n_per_m
            );
        }
        if let Some(focus) = &self.focus {
            let [x, y] = focus.at_m.map(|metres| metres * 1e3);
            let _ = writeln!(
                text,
                "  focus     computed for the assumed tension, at {x:.0},{y:.0} mm: {:.0} % of its peak, contrast {:.1} instead of {:.1}",
                100.0 * focus.peak_share,
                focus.contrast_now,
                focus.contrast_before
            );
        }
        let _ = writeln!(text, "  to do     {}", self.advice());
        text
    }

    fn failure(&self) -> Option<String> {
        if let Some(rate) = self.too_fast {
            return Some(format!(
                "no tension explains what the sensors receive: it would change by {:.0} % a minute, and no sheet drifts so fast; {}",
                100.0 * rate,
                self.blame()
            ));
        }
        let limit = self.pings.last().and_then(|step| step.limit)?;
        Some(format!(
            "no tension explains what the sensors receive: the residual is {:.1} times what noise and the model's error explain, at most \
             {limit:.0} times is accepted; {}",
            self.excess,
            self.blame()
        ))
    }
}
