//! How strong a drive is to be, as a request gives it.

use crate::TaskError;
use crate::numbers::above_zero;
use serde::{Deserialize, Serialize};
use unripple::act::Level;

/// How strong a drive is to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LevelAsk {
    /// No place moves by more than about half the sheet's thickness, which linear theory allows; less where the drive
    /// limit is reached first.
    #[default]
    Linear,
    /// As strong as the drive limit allows, though linear theory may not hold there.
    Limit,
    /// Peak displacement of the first target, in m.
    PeakM(f64),
    /// Level of the first target as felt, in dB above the threshold of touch.
    FeltDb(f64),
}

impl LevelAsk {
    /// Converts the level to a [`Level`].
    ///
    /// # Errors
    /// [`TaskError::Ask`] of a displacement that is not above 0.
    pub fn level(self) -> Result<Level, TaskError> {
        Ok(match self {
            Self::Linear => Level::Linear,
            Self::Limit => Level::Limit,
            Self::PeakM(metres) => Level::Peak(above_zero(metres, "peak_m", "m")?),
            Self::FeltDb(db) => Level::Felt(db),
        })
    }

    /// Converts the level for responses whose scale is unknown for the reason `why`, if there is one: then only the
    /// drive limit can be asked for.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of an absolute level on responses of unknown scale.
    pub fn level_on(self, why: Option<&str>) -> Result<Level, TaskError> {
        let without = |field: &'static str, why: &str| {
            Err(TaskError::ask(field, "a library whose level is known", format!("one without: {why}")))
        };
        match (self, why) {
            (Self::PeakM(_), Some(why)) => without("peak_m", why),
            (Self::FeltDb(_), Some(why)) => without("felt_db", why),
            (Self::Linear | Self::Limit, Some(_)) => Ok(Level::Limit),
            (asked, None) => asked.level(),
        }
    }
}
