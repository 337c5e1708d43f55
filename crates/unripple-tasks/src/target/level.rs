//! Level of a drive in a request.

use crate::TaskError;
use crate::numbers::above_zero;
use serde::{Deserialize, Serialize};
use unripple::act::Level;

/// Level to which a drive is scaled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LevelAsk {
    /// Nowhere is the displacement above about half the sheet's thickness, up to which linear theory holds;
    /// it is lower if the drive limit is reached first.
    #[default]
    Linear,
    /// The level at which the drive reaches its limit, though linear theory may not hold there.
    Limit,
    /// Peak displacement of the first target, in m.
    PeakM(f64),
    /// Felt level at the first target: displacement over the threshold of vibrotactile detection, in dB.
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

    /// Converts the level to a [`Level`] for responses; if their scale is unknown (`why` states the
    /// reason), only the drive limit can be requested.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of an absolute level on responses of unknown scale.
    pub fn level_on(self, why: Option<&str>) -> Result<Level, TaskError> {
        let without = |field: &'static str, why: &str| {
            Err(TaskError::ask(field, "a library whose scale is known", format!("one without: {why}")))
        };
        match (self, why) {
            (Self::PeakM(_), Some(why)) => without("peak_m", why),
            (Self::FeltDb(_), Some(why)) => without("felt_db", why),
            (Self::Linear | Self::Limit, Some(_)) => Ok(Level::Limit),
            (asked, None) => asked.level(),
        }
    }
}
