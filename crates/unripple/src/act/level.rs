use super::error::{ActError, LevelKind};
use super::judge::known;
use crate::core::{Drive, Responses};
use crate::field::{Aim, Field};

/// How loud a drive is to be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Level {
    /// As loud as the drive limit allows.
    #[default]
    Limit,
    /// By the largest displacement of the first target's mean, in metres.
    Peak(f64),
    /// By the level felt at the first target, in dB above the threshold of touch.
    Felt(f64),
}

impl Level {
    /// The factor on a drive at its limit that brings it to this level; `None` for the limit itself.
    ///
    /// The field is that of `responses`; displacements count up to `until` (s), or in the last `period` samples.
    ///
    /// # Errors
    /// [`ActError::Level`] for numbers without meaning, levels above what the drive limit gives, a target that does not
    /// move; those of [`Field::traces`] and [`Field::measure`].
    pub fn gain(
        self,
        responses: &Responses,
        drive: &Drive,
        aims: &[Aim],
        period: Option<usize>,
        until: f64,
    ) -> Result<Option<f64>, ActError> {
        match self {
            Self::Limit => Ok(None),
            Self::Peak(wanted) => {
                let legal = wanted.is_finite() && wanted > 0.0;
                let found = || micrometres(wanted);
                refuse(!legal, LevelKind::Peak, "a number above 0 µm", found)?;
                let most = largest(responses, drive, aims, period, until)?;
                let expected = format!("at most {:.4} µm, which the drive limit gives", most * 1e6);
                refuse(wanted > most, LevelKind::Peak, expected, found)?;
                Ok(Some(wanted / most))
            }
            Self::Felt(wanted) => {
                let period = period.map(|samples| samples as f64 / drive.rate());
                felt_gain(wanted, responses, drive, aims, period).map(Some)
            }
        }
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

/// The factor on a drive at its limit that puts the first target at `wanted` dB above the threshold of touch.
fn felt_gain(
    wanted: f64,
    responses: &Responses,
    drive: &Drive,
    aims: &[Aim],
    period: Option<f64>,
) -> Result<f64, ActError> {
    let found = || wanted.to_string();
    refuse(!wanted.is_finite(), LevelKind::Felt, "a finite number of dB", found)?;
    let field = Field::new(responses, drive, 1.0)?;
    let first = &aims[..aims.len().min(1)];
    let targets = field.measure(first, period)?.targets;
    let Some(most) = targets.first().and_then(|target| target.felt_level_db) else {
        return Err(ActError::Level {
            what: LevelKind::Felt,
            expected: "a first target that the drive moves".into(),
            found: "silence there".into(),
        });
    };
    let expected = format!("at most {most:.2} dB above threshold, which the drive limit gives");
    refuse(wanted > most, LevelKind::Felt, expected, found)?;
    Ok(10f64.powf((wanted - most) / 20.0))
}

/// Largest displacement of the first target's mean over the time measured, in metres.
fn largest(
    responses: &Responses,
    drive: &Drive,
    aims: &[Aim],
    period: Option<usize>,
    until: f64,
) -> Result<f64, ActError> {
    let field = Field::new(responses, drive, 1.0)?;
    let points = aims.first().map_or(&[][..], |aim| &aim.points);
    let traces = field.traces(points, until.min(known(&field)))?;
    let first = period.map_or(0, |period| drive.samples().saturating_sub(period));
    let samples = traces.first().map_or(0, |trace| trace.displacement.len());
    let mean = |i: usize| traces.iter().map(|t| t.displacement[i]).sum::<f64>() / traces.len() as f64;
    Ok((first..samples).map(|i| mean(i).abs()).fold(0.0, f64::max))
}
