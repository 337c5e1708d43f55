//! What came of a run that was repeated: the report of its command.

use crate::TaskError;
use crate::commands::Done;
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
    /// What came of a command, with the record of its new run.
    ///
    /// # Errors
    /// [`TaskError::Work`] of text that is no JSON.
    pub fn of(done: Done) -> Result<Self, TaskError> {
        let Done { json, text, failure } = done;
        Ok(Self { json: RawValue::from_string(json).map_err(TaskError::work)?, text, failure })
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
