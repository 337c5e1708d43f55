//! Report of the task `check`.

use crate::cost::Estimate;
use serde::Serialize;
use std::fmt::Write;
use unripple::act::Note;
use unripple_store::{Fault, FileFaults};

/// All faults of a surface file.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The surface as the request names it.
    pub surface: String,
    /// Whether the file has no fault.
    pub ok: bool,
    /// Each fault with line and column, in the file's order; at most a hundred.
    pub faults: Vec<Fault>,
    /// Number of faults beyond those in `faults`; absent for a file without faults.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub omitted: Option<usize>,
    /// Remarks on a file without faults, if any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
    /// What the modes of the band cost on this machine, and a drive with its evaluation, or why that is not known. In the text alone,
    /// since the JSON of a surface is the same everywhere.
    #[serde(skip)]
    pub costs: Option<Result<Costs, String>>,
    /// The faults together with the lines of the file that they are in, for the text report.
    #[serde(skip)]
    pub file: Option<Box<FileFaults>>,
    /// Name of the surface in its file and its number of actuators; `None` if the file has faults.
    #[serde(skip)]
    pub named: Option<(String, usize)>,
}

/// Estimated costs of the shortest tasks on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// Of the modes in the band, with the actuators on the sheet.
    pub modes: Estimate,
    /// Of a drive that focuses, and of evaluating it.
    pub focus: Estimate,
}

impl crate::Report for Report {
    fn text(&self) -> String {
        match (&self.named, &self.file) {
            (Some((name, count)), _) => {
                let mut text = format!("{}: no faults (\"{name}\", {count} actuators)", self.surface);
                let _ = match &self.costs {
                    Some(Ok(Costs { modes, focus })) => {
                        write!(text, "\nmodes take {}; a focus {}", modes.text(), focus.text())
                    }
                    Some(Err(why)) => write!(text, "\nwhat it costs is not known: {why}"),
                    None => Ok(()),
                };
                for note in &self.notes {
                    let _ = write!(text, "\nnote, {}: {}", note.topic, note.text);
                }
                text
            }
            (None, Some(faults)) => format!("{faults:#}"),
            (None, None) => String::new(),
        }
    }

    fn failure(&self) -> Option<String> {
        self.file.as_ref().map(|faults| faults.to_string())
    }
}
