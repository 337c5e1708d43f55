//! Rows of a sweep: the results of a design.

use super::flat;
use super::pairs::Pairs;
use super::{Design, Plan};
use crate::commands::{Command, Done};
use crate::{Progress, TaskError};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use unripple::core::{Cache, Observed};

/// Results of one design, or the error with which it failed. Rows contain no computing times, so that they
/// are equal to the last bit on whatever process or machine they are computed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Index of the design, counted from 0.
    pub index: usize,
    /// SHA-256, in hexadecimal digits, of task, surface, request and values.
    pub hash: String,
    /// Version of the program that computed the row.
    pub version: String,
    /// Values of the design by the names `surface:KEY` and `ask:FIELD`.
    pub values: Pairs,
    /// Figures of the report by their JSON pointers, in SI units.
    #[serde(default, skip_serializing_if = "Pairs::is_empty")]
    pub figures: Pairs,
    /// Number of long lists and texts of the report that are left out of the row.
    #[serde(default, skip_serializing_if = "is_none")]
    pub left_out: usize,
    /// Why the design failed; `None` if it did not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

impl Row {
    /// Runs the plan's task for a design. An error of the task, or a panic, becomes a row with that error.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`].
    pub(super) fn computed(
        plan: &Plan,
        index: usize,
        progress: &mut dyn Progress,
    ) -> Result<Self, TaskError> {
        let design = plan.design(index);
        let found = plan.ask(&design).and_then(|ask| attempt(plan.task()?, ask, progress));
        let done = match found {
            Ok(done) => done,
            Err(TaskError::Cancelled) => return Err(TaskError::Cancelled),
            Err(error) => return Ok(Self::failed(design, error.to_string())),
        };
        let report: Value = serde_json::from_str(&done.json).map_err(TaskError::work)?;
        let flat = flat::of(&report, &plan.file().figures);
        Ok(Self { figures: flat.figures, left_out: flat.left_out, error: done.failure, ..Self::of(design) })
    }

    /// The row of a design that failed.
    pub(super) fn failed(design: Design, error: String) -> Self {
        Self { error: Some(error), ..Self::of(design) }
    }

    fn of(design: Design) -> Self {
        let Design { index, values, hash, .. } = design;
        Self { index, hash, version: env!("CARGO_PKG_VERSION").into(), values, ..Self::default() }
    }
}

/// Performs a task; a panic is an error.
fn attempt(task: &Command, ask: Value, progress: &mut dyn Progress) -> Result<Done, TaskError> {
    let mut within = Within(progress);
    // Parts of one design are too short to be told.
    let run = || Observed::by(None).during(|| (task.run)(ask, &mut within));
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        Err(TaskError::Work(format!(
            "the task ended in a panic, which is an error in the program: {}",
            said(&*panic)
        )))
    })
}

/// The message of a panic.
fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

/// Progress of a task within a sweep: it can be cancelled, and what it says is not told a thousand times.
struct Within<'p>(&'p mut dyn Progress);

impl Progress for Within<'_> {
    fn cache(&self) -> Option<Arc<dyn Cache>> {
        self.0.cache()
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
