//! Report of the task `place`.

use super::ByMethod;
use super::placed::{Best, Build, Layout, More, Number, Random, Restarts};
use serde::Serialize;
use unripple::act::Note;

/// A layout, how good it is beside others, and how many actuators would be enough.
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
    /// Number of actuators that were placed.
    pub count: usize,
    /// Names of the actuators that stay where they are.
    pub kept: Vec<String>,
    /// Number of places that were chosen from.
    pub places: usize,
    /// Spacing of the grid of places, in m; absent where places were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch_m: Option<f64>,
    /// What was made large, in words.
    pub objective: String,
    /// Window T, in s.
    pub window_s: f64,
    /// Reason for the default window; absent if the request sets the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_why: Option<String>,
    /// Number of targets that the actuators were placed for.
    pub placed_for: usize,
    /// Number of targets on which layouts are evaluated.
    pub evaluated_on: usize,
    /// Whether these are other targets.
    pub held_out: bool,
    /// The layout that the surface has; absent where it has no actuators, or some that cannot be compared with those placed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before: Option<Layout>,
    /// The layout that was found.
    pub after: Layout,
    /// Random layouts of as many actuators, at places of the grid; absent where none was found that keeps the least distance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub random: Option<Random>,
    /// What the search reached from each beginning.
    pub restarts: Restarts,
    /// How good any layout on the grid can be, as far as that is known.
    pub certificate: Best,
    /// Layouts of every number of actuators, each made from the one before.
    pub each_number: Vec<Number>,
    /// What errors of the places cost.
    pub mounting: Vec<Build>,
    /// Where one actuator more would help most; absent where no place is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one_more: Option<More>,
    /// Results by method; empty if no method was asked for.
    pub methods: Vec<ByMethod>,
    /// Notes on the search.
    pub notes: Vec<Note>,
    /// Files in the output folder, beside the surface and the report.
    pub files: Vec<String>,
}
