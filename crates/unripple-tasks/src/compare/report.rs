//! What `compare` found.

use super::row::{Conditions, table};
use super::{Front, Row};
use serde::Serialize;
use unripple::act::Level;

/// All methods, one row each, and what a method's knob trades.
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
    /// Reason for the window, where nobody asked for one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_why: Option<String>,
    /// Highest frequency of the modes that drives were evaluated on, in Hz.
    pub judged_to_hz: f64,
    /// Every method, time reversal first.
    pub methods: Vec<Row>,
    /// What turning a method's knob gives.
    pub fronts: Vec<Front>,
    /// What is felt elsewhere against the drive that it takes, time reversal first.
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
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = table(&self.methods, self.conditions());
        if let Some(window) = &self.window_text {
            text += &format!("\nwindow {window}\n");
        }
        text
    }
}
