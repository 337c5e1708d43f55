//! The trait of all reports.

use serde::Serialize;
use unripple::act::Note;

/// The JSON schema (draft 2020-12) of the reports of all commands, with the records of their runs, for programs and editors that read them.
pub const REPORT_SCHEMA: &str = include_str!("../schema/report-1.json");

/// Name of [`REPORT_SCHEMA`] in records: its file name without the ending. The number changes if a key is
/// removed or comes to mean something else.
pub(crate) const SCHEMA_NAME: &str = "report-1";

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

/// A report as Markdown: its heading, its lines of text, and of `pictures`, names of files with what they show, those among `files`.
pub(crate) fn markdown(heading: &str, text: &str, files: &[String], pictures: &[(&str, &str)]) -> String {
    let mut all = format!("# {heading}\n\n```text\n{text}```\n");
    for (file, what) in pictures {
        if files.iter().any(|name| name == file) {
            all += &format!("\n![{what}]({file})\n");
        }
    }
    all
}

/// Adds notes to a text, each after an empty line.
pub(crate) fn add_notes(text: &mut String, notes: &[Note]) {
    notes.iter().for_each(|note| *text += &format!("\nnote ({}): {}\n", note.topic, note.text));
}
