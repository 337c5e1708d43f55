//! What came of a run that was repeated: the report of its command.

use crate::TaskError;
use serde::Serialize;
use serde_json::value::RawValue;

/// The report of the command that was done again, whichever that is.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Report {
    /// The report with the record of the new run, as JSON.
    pub json: Box<RawValue>,
    /// The same for people.
    #[serde(skip)]
    pub text: String,
    /// Why it counts as failed although it has a report.
    #[serde(skip)]
    pub failure: Option<String>,
}

impl Report {
    /// The report of a command, of whose JSON the record is a part.
    ///
    /// # Errors
    /// [`TaskError::Work`] of text that is no JSON.
    pub fn of(report: &impl crate::Report, json: String) -> Result<Self, TaskError> {
        let json = RawValue::from_string(json).map_err(TaskError::work)?;
        Ok(Self { json, text: report.text(), failure: report.failure() })
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
