//! Report of the task `place`.

use super::placed::{Best, Build, Layout, More, Number, Random, Restarts};
use super::{ByMethod, Second};
use serde::Serialize;
use unripple::act::Note;

/// The layout that was found, its contrast compared with other layouts, and contrast against the number of
/// actuators.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// Name of the surface.
    pub surface: String,
    /// The responses that were used, in words, where actuators of a library were chosen; absent for a surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judged_on: Option<String>,
    /// Number of actuators that were placed, or chosen.
    pub count: usize,
    /// Names of the kept actuators.
    pub kept: Vec<String>,
    /// Number of places, or of actuators of a library, from which the search chose.
    pub places: usize,
    /// Spacing of the grid of places, in m; absent where places were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch_m: Option<f64>,
    /// The objective that was maximised, in words; that of the first search, if there were two.
    pub objective: String,
    /// Window T, in s.
    pub window_s: f64,
    /// Reason for the default window; absent if the request sets the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_why: Option<String>,
    /// Number of targets that the layout was optimised for.
    pub placed_for: usize,
    /// Number of targets on which layouts are evaluated.
    pub evaluated_on: usize,
    /// Whether the evaluation targets are other ones than those that the layout was optimised for.
    pub held_out: bool,
    /// The layout that the surface has, or all actuators of the library; absent where it has no actuators, or some that cannot be compared
    /// with those placed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before: Option<Layout>,
    /// The layout that was found.
    pub after: Layout,
    /// Random layouts of as many actuators, at places of the grid; absent where none was found that keeps the least distance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub random: Option<Random>,
    /// Values of the objective that the search reached from each starting layout.
    pub restarts: Restarts,
    /// The best of all layouts on the grid, if there were few enough to compare all.
    pub certificate: Best,
    /// The search by what drives of a method reach; absent if none was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_search: Option<Second>,
    /// Layouts of every number of actuators, each made from the one before.
    pub each_number: Vec<Number>,
    /// Contrast with random errors of the actuators' places; empty for a library.
    pub mounting: Vec<Build>,
    /// The place where one more actuator would improve the objective most; absent if no place is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one_more: Option<More>,
    /// Results by method; empty if no method was asked for.
    pub methods: Vec<ByMethod>,
    /// Notes on the search.
    pub notes: Vec<Note>,
    /// Files in the output folder, beside the report and the surface or the names of actuators.
    pub files: Vec<String>,
}

impl Report {
    /// What was done with the actuators, in a word.
    pub(super) fn found(&self) -> &'static str {
        if self.judged_on.is_some() { "chosen" } else { "placed" }
    }

    /// What the layout is that was there before, in words.
    pub(super) fn own(&self) -> &'static str {
        match self.judged_on {
            Some(_) => "all of the library",
            None => "layout of the file",
        }
    }
}
