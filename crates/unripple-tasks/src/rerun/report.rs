//! Report of a repeated run: the report of its command.

use crate::TaskError;
use crate::commands::Done;
use serde::Serialize;
use serde_json::value::RawValue;

/// Report of a repeated run: the report of its command, whichever that is.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Report {
    /// The report with the record of the new run, as JSON.
    pub json: Box<RawValue>,
    /// The report as text for people.
    #[serde(skip)]
    pub text: String,
    /// Reason why the run counts as failed although it has a report; `None` if it succeeded.
    #[serde(skip)]
    pub failure: Option<String>,
}

impl Report {
    /// Makes the report from the result of the repeated command.
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
