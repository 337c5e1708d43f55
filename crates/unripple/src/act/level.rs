//! Level that a drive is brought to: by linear theory, by the drive limit, by peak displacement, or by felt
//! level.

use super::Readouts;
use super::aimed::Aimed;
use super::beyond::Beyond;
use super::error::{ActError, LevelKind};
use super::judge::{known, linear};
use super::strength::DecidedBy;
use crate::core::{Drive, Surface};
use crate::field::Readout;
use crate::physics::design::{LinearBound, LinearLevel};

/// Level that a drive is brought to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Level {
    /// The highest level at which linear theory holds ([`LinearLevel`]: displacements of at most half the
    /// sheet's thickness, and small slopes and strains), but at most that of the drive limit.
    #[default]
    Linear,
    /// The level at which the drive reaches its limit.
    Limit,
    /// A level with this peak displacement of the first target (the mean over its points), in metres.
    Peak(f64),
    /// A level with this felt level at the first target, in dB above the threshold of touch.
    Felt(f64),
}

/// The factor that brings a drive to a level, and what decides it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// Factor on the drive; above 1 for a level above that of the drive.
    pub factor: f64,
    /// What decides the factor.
    pub by: DecidedBy,
}

impl Level {
    /// The factor that brings a drive to this level; `None` for the limit, and where no bound of linear theory is
    /// known.
    ///
    /// # Errors
    /// [`ActError::Level`] for levels that are not legal numbers and a target that does not move; those of
    /// [`Field::traces`] and [`Field::measure`].
    pub(super) fn step(
        self,
        surface: &Surface,
        on: &Readouts<'_>,
        drive: &Drive,
        aimed: &Aimed,
    ) -> Result<Option<Step>, ActError> {
        Ok(match self {
            Self::Limit => None,
            Self::Linear => {
                let found = |readout: &Readout<'_>| -> Result<Option<LinearLevel>, ActError> {
                    let reach = readout.field(drive)?.reach(&aimed.aims, aimed.seconds())?;
                    Ok(LinearLevel::of(surface, &linear(surface, &reach)))
                };
                let level = match found(on.coarse()?)? {
                    Some(level) if level.bound != LinearBound::Thickness => found(on.fine()?)?,
                    level => level,
                };
                level.map(Step::from)
            }
            Self::Peak(wanted) => {
                let legal = wanted.is_finite() && wanted > 0.0;
                let found = || micrometres(wanted);
                refuse(!legal, LevelKind::Peak, "a number above 0 µm", found)?;
                Some(Step { factor: wanted / largest(on, drive, aimed)?, by: DecidedBy::PeakUm })
            }
            Self::Felt(wanted) => {
                refuse(!wanted.is_finite(), LevelKind::Felt, "a finite number of dB", || wanted.to_string())?;
                let found = felt(on, drive, aimed)?;
                Some(Step { factor: 10f64.powf((wanted - found) / 20.0), by: DecidedBy::FeltDb })
            }
        })
    }

    /// Returns an error if the requested level is above that of the drive at its limit.
    ///
    /// # Errors
    /// [`ActError::Level`].
    pub(super) fn within(self, step: Step) -> Result<(), ActError> {
        match self.beyond(step) {
            None => Ok(()),
            Some(Beyond { what, most, wanted, .. }) => {
                let expected = format!("at most {most}, which the drive limit gives");
                Err(ActError::Level { what, expected, found: wanted })
            }
        }
    }

    /// By what the requested level exceeds that of the drive at its limit; `None` if it does not.
    pub(super) fn beyond(self, step: Step) -> Option<Beyond> {
        let found = match self {
            Self::Linear | Self::Limit => return None,
            Self::Peak(wanted) => Beyond {
                what: LevelKind::Peak,
                most: format!("{:.4} µm", wanted / step.factor * 1e6),
                wanted: micrometres(wanted),
                unit: "µm",
            },
            Self::Felt(wanted) => Beyond {
                what: LevelKind::Felt,
                most: format!("{:.1} dB above threshold", below(wanted - 20.0 * step.factor.log10())),
                wanted: wanted.to_string(),
                unit: "dB",
            },
        };
        (step.factor > 1.0).then_some(found)
    }
}

impl From<LinearLevel> for Step {
    fn from(level: LinearLevel) -> Self {
        let by = match level.bound {
            LinearBound::Thickness => DecidedBy::Thickness,
            LinearBound::Tension => DecidedBy::Tension,
            LinearBound::Yield => DecidedBy::Yield,
        };
        Self { factor: level.factor, by }
    }
}

fn refuse(
    wrong: bool,
    what: LevelKind,
    expected: impl Into<String>,
    found: impl Fn() -> String,
) -> Result<(), ActError> {
    if wrong { Err(ActError::Level { what, expected: expected.into(), found: found() }) } else { Ok(()) }
}

/// Micrometres without the digits that the change of unit may have added.
fn micrometres(metres: f64) -> String {
    let um = metres * 1e6;
    format!("{um:.12e}").parse::<f64>().unwrap_or(um).to_string()
}

/// A level rounded down to tenths of a dB, so that it can be reached.
fn below(db: f64) -> f64 {
    (10.0 * db).floor() / 10.0
}

/// Sensation level at the first target, in dB above the threshold of touch.
fn felt(on: &Readouts<'_>, drive: &Drive, aimed: &Aimed) -> Result<f64, ActError> {
    let field = on.fewest()?.field(drive)?;
    let first = &aimed.aims[..aimed.aims.len().min(1)];
    let targets = field.measure(first, aimed.seconds())?.targets;
    targets.first().and_then(|target| target.felt_level_db).ok_or_else(|| ActError::Level {
        what: LevelKind::Felt,
        expected: "a first target that the drive moves".into(),
        found: "silence there".into(),
    })
}

/// Largest displacement of the first target (the mean over its points) over the evaluated time, in metres.
fn largest(on: &Readouts<'_>, drive: &Drive, aimed: &Aimed) -> Result<f64, ActError> {
    // Traces read no grid.
    let field = on.fine()?.field(drive)?;
    let points = aimed.aims.first().map_or(&[][..], |aim| &aim.points);
    let traces = field.traces(points, aimed.until.min(known(&field)))?;
    let first = aimed.period.map_or(0, |period| drive.samples().saturating_sub(period));
    let samples = traces.first().map_or(0, |trace| trace.displacement.len());
    let mean = |i: usize| traces.iter().map(|t| t.displacement[i]).sum::<f64>() / traces.len() as f64;
    Ok((first..samples).map(|i| mean(i).abs()).fold(0.0, f64::max))
}
