//! Rows of a sweep: the results of a design.

use super::flat;
use super::pairs::Pairs;
use super::{Design, Plan};
use crate::commands::{Command, Done};
use crate::{Progress, TaskError, machine};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use unripple::core::{Cache, Observed};

/// Version of the program that computes rows.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What came of one design. Rows hold no times, so that they are equal to the last bit whoever computes them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Index of the design, counted from 0.
    pub index: usize,
    /// SHA-256, in hexadecimal digits, of task, surface, request, values, and the files that these name.
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
    /// Whether memory was lacking while other processes of the sweep ran beside, so that the design is tried once more; of no row of a
    /// shard that is done.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lacks_memory: bool,
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
            Err(error) => {
                let lacks_memory = matches!(error, TaskError::Memory(_));
                return Ok(Self { lacks_memory, ..Self::failed(design, error.to_string()) });
            }
        };
        let report: Value = serde_json::from_str(&done.json).map_err(TaskError::work)?;
        let flat = flat::of(&report, &plan.file().figures);
        Ok(Self { figures: flat.figures, left_out: flat.left_out, error: done.failure, ..Self::of(design) })
    }

    /// As [`computed`](Self::computed), with the memory that there is by now: what is lacking then is an error as any other.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`].
    pub(super) fn settled(plan: &Plan, index: usize, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let row = machine::memory().during(|| Self::computed(plan, index, progress))?;
        Ok(Self { lacks_memory: false, ..row })
    }

    /// The row of a design that failed.
    pub(super) fn failed(design: Design, error: String) -> Self {
        Self { error: Some(error), ..Self::of(design) }
    }

    /// The row of another design that is equal to the one that this is the row of, as this version computes it; `None` if it is not.
    pub(super) fn again(&self, design: Design) -> Option<Self> {
        let equal = self.hash == design.hash && self.version == VERSION;
        equal.then(|| {
            let Self { figures, left_out, lacks_memory, error, .. } = self.clone();
            Self { figures, left_out, lacks_memory, error, ..Self::of(design) }
        })
    }

    /// Whether it is the row of a design as this version computes it.
    pub(super) fn is_of(&self, design: &Design) -> bool {
        self.index == design.index && self.hash == design.hash && self.version == VERSION
    }

    fn of(design: Design) -> Self {
        let Design { index, values, hash, .. } = design;
        Self { index, hash, version: VERSION.into(), values, ..Self::default() }
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
