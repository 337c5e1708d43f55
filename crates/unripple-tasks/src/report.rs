//! What every report offers.

use serde::Serialize;

/// What came of a task: keys in SI units for programs, text for people.
pub trait Report: Serialize {
    /// The report for people, as lines of text.
    fn text(&self) -> String;

    /// Why the task counts as failed although it has a report, as a doubtful library; nothing where it does not.
    fn failure(&self) -> Option<String> {
        None
    }
}
