//! Sample designs of a search: all that its plan names is named by one of them.

use crate::sweep::{self, step};
use serde_json::Value;
use std::path::{Path, PathBuf};
use unripple_store::{Axis, AxisValues, Designs, PlanFile, SearchFile, Varied, load_search};

/// Files that the plan in a file reads besides its own; of one with faults, which its reader tells, those of its surface.
pub(super) fn reads(plan: &Path) -> Vec<PathBuf> {
    match load_search(plan, &sweep::tasks()) {
        Ok(file) => sweep::reads_of(plan, &samples(&file)),
        Err(_) => sweep::reads(plan),
    }
}

/// The plan of a sweep over designs with all listed values of the unknowns, and with both ends of ranges.
pub(super) fn samples(file: &SearchFile) -> PlanFile {
    let design = |at: usize| -> Vec<(Varied, Value)> {
        let value = |axis: &Axis| step(&axis.values, at.min(last(axis)));
        file.axes.iter().map(|axis| (axis.varied.clone(), value(axis))).collect()
    };
    let most = file.axes.iter().map(last).max().unwrap_or_default();
    PlanFile {
        name: file.name.clone(),
        folder: file.folder.clone(),
        task: file.task.clone(),
        surface: file.surface.clone(),
        ask: file.ask.clone(),
        shard: file.shard,
        designs: Designs::List((0..=most).map(design).collect()),
        figures: file.figures.clone(),
    }
}

/// Index of the last listed value of an unknown, or of the greater end of its range.
fn last(axis: &Axis) -> usize {
    match &axis.values {
        AxisValues::List(values) => values.len().saturating_sub(1),
        AxisValues::Range { .. } => 1,
    }
}
