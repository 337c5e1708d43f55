//! Report of the task `compare`.

use super::row::{Conditions, markdown, table};
use super::{Failed, Front, Row};
use serde::Serialize;
use unripple::act::Level;

/// Results of all methods, one row each, and the tradeoff curves of their parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// The surface's own name.
    pub surface: String,
    /// Window T, in s.
    pub window_s: f64,
    /// Reason for the default window; absent if the ask gave a window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_why: Option<String>,
    /// Highest frequency of the modes that drives were evaluated on, in Hz.
    pub judged_to_hz: f64,
    /// Results of every method that did not fail, time reversal first.
    pub methods: Vec<Row>,
    /// Methods that failed, each with the reason.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<Failed>,
    /// Tradeoff curves of the methods that have a parameter; empty if the ask has `no_tradeoffs`.
    pub fronts: Vec<Front>,
    /// Results of the method `felt` for increasing weights of the drive's energy, after those of time reversal; empty if the ask has
    /// `no_tradeoffs`.
    pub felt: Vec<Row>,
    /// Files in the output folder.
    pub files: Vec<String>,
    #[serde(skip)]
    pub(super) level: Level,
    /// The line on the window, where the caller gave none.
    #[serde(skip)]
    pub(super) window_text: Option<String>,
}

impl Report {
    /// What all rows have in common.
    pub(super) fn conditions(&self) -> Conditions {
        Conditions { window: self.window_s, judged_to: self.judged_to_hz, level: self.level }
    }

    /// The report as Markdown, with a link to its picture if there is one.
    pub(super) fn markdown(&self) -> String {
        let mut text = markdown(&self.surface, &self.methods, self.conditions());
        for Failed { method, why } in &self.failed {
            text += &format!("\n**{method}** failed: {why}\n");
        }
        if self.files.iter().any(|file| file == "compare.png") {
            text += "\n![Contrast against energy, and against the peak at the drive limit](compare.png)\n";
        }
        text
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = table(&self.methods, self.conditions());
        for Failed { method, why } in &self.failed {
            text += &format!("\n{method} failed: {why}\n");
        }
        if let Some(window) = &self.window_text {
            text += &format!("\nwindow {window}\n");
        }
        text
    }
}
