//! The trait of all reports.

use serde::Serialize;

/// Results of a task: serialised for programs, with keys in SI units, and as text for people.
pub trait Report: Serialize {
    /// The report for people, as lines of text.
    fn text(&self) -> String;

    /// Reason for which the task counts as failed although it has a report, such as a doubtful library; `None` if it
    /// succeeded.
    fn failure(&self) -> Option<String> {
        None
    }
}
