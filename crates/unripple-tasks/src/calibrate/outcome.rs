//! The report of a calibration: of a library, of recordings, or of levels.

use super::{Levels, report};
use crate::TaskError;
use serde::Serialize;
use serde_json::Value;
use unripple_store::Library;

/// Report of a calibration; its content depends on whether a library was measured, recordings were read, or
/// levels were checked.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Report {
    /// The report as JSON: the quality of a library; with recordings made elsewhere also which are missing
    /// or unusable; after a check of levels, the level of each channel.
    pub found: Value,
    #[serde(skip)]
    text: String,
    #[serde(skip)]
    failure: Option<String>,
}

impl Report {
    /// Report on a library that was measured; `failure` states why the calibration counts as failed, if it
    /// does.
    pub(super) fn of_library(report: &report::Report, failure: Option<String>) -> Result<Self, TaskError> {
        let found = serde_json::to_value(report).map_err(TaskError::work)?;
        Ok(Self { found, text: report.text(), failure })
    }

    /// Report on a calibration with recordings made elsewhere.
    pub(super) fn of_tape(found: Value, text: String, failure: Option<String>) -> Self {
        Self { found, text, failure }
    }

    /// Report on a check of levels.
    pub(super) fn of_levels(levels: &Levels) -> Result<Self, TaskError> {
        let found = serde_json::to_value(levels).map_err(TaskError::work)?;
        Ok(Self { found, text: levels.text(), failure: levels.failure() })
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        self.text.clone()
    }

    fn failure(&self) -> Option<String> {
        self.failure.clone()
    }
}

/// Why a library is doubtful, if it is: all reasons.
pub(super) fn doubted(library: &Library) -> Option<String> {
    let doubts: Vec<String> = library.doubts().iter().map(|doubt| format!("  {doubt}")).collect();
    if doubts.is_empty() {
        return None;
    }
    Some(format!("{} is doubtful:\n{}", library.path().display(), doubts.join("\n")))
}
