//! Level of a drive relative to its limits, and what decided it.

use crate::core::Drive;
use crate::focus::Options;
use serde::Serialize;

/// Relative distance from a limit below which a drive counts as being at the limit: rounding to float32 is
/// smaller.
const HELD: f64 = 1e-6;

/// What decided the level of a drive: linear theory, a limit, or the requested level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DecidedBy {
    /// Linear theory: no point moves by more than half the sheet's thickness, as found on a coarse grid.
    Thickness,
    /// Linear theory: slopes add a twentieth to the tension.
    Tension,
    /// Linear theory: the strain uses half of the margin between the strain at rest and yield.
    Yield,
    /// A limit of the drive.
    Limit,
    /// The requested displacement at the first target.
    PeakUm,
    /// The requested felt level at the first target.
    FeltDb,
    /// The requested levels of waveforms or of a stroke.
    Asked,
}

/// Level of a drive relative to its limits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Strength {
    /// What decided the level.
    pub decided_by: DecidedBy,
    /// Headroom of the drive below the limit that it is nearest to, in dB.
    pub below_limit_db: f64,
    /// Headroom of the drive as a ratio: the factor by which the drive could grow until it reaches the
    /// limit that it is nearest to.
    pub below_limit: f64,
    /// Each limit of the drive, and how much of it is used.
    pub limits: Vec<Headroom>,
    /// Factor by which linear theory would allow the drive to grow; only where the limit decided the level.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_theory_allows: Option<f64>,
}

/// A limit of the drive, and how much of it is used.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Headroom {
    /// Name of the limit: `peak` or `rms` of an actuator, or `total rms` of all together.
    pub limit: &'static str,
    /// The limit, in the drive's unit.
    pub allowed: f64,
    /// Value of the limited quantity (peak or rms) in the drive, in the drive's unit: for the actuator
    /// where it is largest, or for all together.
    pub used: f64,
    /// Headroom below the limit, in dB.
    pub below_db: f64,
    /// Headroom below the limit, as a factor.
    pub below: f64,
}

impl Headroom {
    fn of(limit: &'static str, allowed: f64, used: f64) -> Self {
        let below = if used > 0.0 { allowed / used } else { f64::INFINITY };
        Self { limit, allowed, used, below_db: 20.0 * below.log10(), below }
    }
}

impl Strength {
    /// Compares a drive with the limits of its options: on each sample, and on the rms over its whole length.
    pub fn of(drive: &Drive, options: &Options, decided_by: DecidedBy) -> Self {
        let square = |c: &Vec<f64>| c.iter().map(|d| d * d).sum::<f64>() / c.len().max(1) as f64;
        let squares: Vec<f64> = drive.channels().iter().map(square).collect();
        let most = squares.iter().copied().fold(0.0, f64::max).sqrt();
        let together = squares.iter().sum::<f64>().sqrt();
        let mut limits = vec![Headroom::of("peak", options.limit, drive.peak())];
        limits.extend(options.rms_limit.map(|rms| Headroom::of("rms", rms, most)));
        limits.extend(options.total_rms.map(|rms| Headroom::of("total rms", rms, together)));
        let below_limit = limits.iter().map(|limit| limit.below).fold(f64::INFINITY, f64::min);
        let below_limit_db = 20.0 * below_limit.log10();
        Self { decided_by, below_limit_db, below_limit, limits, linear_theory_allows: None }
    }

    /// Whether the drive is at one of its limits.
    pub(super) fn at_limit(&self) -> bool {
        self.below_limit < 1.0 + HELD
    }

    /// Adds the factor by which linear theory would allow the drive to grow.
    #[must_use]
    pub fn allowing(mut self, factor: Option<f64>) -> Self {
        self.linear_theory_allows = factor;
        self
    }

    /// The level in a sentence; `unit` is that of the drive, `thickness` the sheet's in m.
    pub fn text(&self, unit: &str, thickness: f64) -> String {
        let linear = |what: String| format!("{what}, well within linear theory");
        let what = match self.decided_by {
            DecidedBy::Thickness => {
                let half = round(0.5e6 * thickness);
                linear(format!("nothing moves by more than about half the sheet's thickness ({half} µm)"))
            }
            DecidedBy::Tension => linear("slopes add at most a twentieth to the tension".into()),
            DecidedBy::Yield => linear("strain uses at most half of the margin from rest to yield".into()),
            DecidedBy::Limit => "as strong as the limits allow".into(),
            DecidedBy::PeakUm => "the displacement asked for".into(),
            DecidedBy::FeltDb => "the level asked for as felt".into(),
            DecidedBy::Asked => "as asked for".into(),
        };
        let limits: Vec<String> = self.limits.iter().map(|limit| limit.text(unit)).collect();
        let more = match (self.decided_by, self.linear_theory_allows) {
            (DecidedBy::Thickness | DecidedBy::Tension | DecidedBy::Yield, _) => {
                " (--full-limit drives at the limit)".into()
            }
            (_, Some(factor)) => format!(" (linear theory would allow {} times as much)", round(factor)),
            _ => String::new(),
        };
        format!("level: {what}; {}{more}", limits.join(", "))
    }
}

impl Headroom {
    fn text(&self, unit: &str) -> String {
        let Self { limit, allowed, below, below_db, .. } = *self;
        match below_db < 0.05 {
            true => format!("at the {limit} limit of {} {unit}", round(allowed)),
            false => format!(
                "{below_db:.1} dB ({} times) below the {limit} limit of {} {unit}",
                round(below),
                round(allowed)
            ),
        }
    }
}

/// A number with three digits.
fn round(value: f64) -> String {
    format!("{value:.2e}").parse::<f64>().unwrap_or(value).to_string()
}
