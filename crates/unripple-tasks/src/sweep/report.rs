//! Report of the task `sweep`.

use super::Plan;
use super::counted::{Extreme, FailedDesign, Named};
use super::tally::Tally;
use crate::cost::Estimate;
use serde::Serialize;
use std::fmt::Write;
use unripple::act::Note;

/// Figures whose extremes the text report has; JSON has all.
const LISTED: usize = 20;

/// Failures that the text report has; JSON has more.
const TOLD: usize = 3;

/// Report on a sweep: designs done, failed and missing, and the least and greatest value of each result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the command.
    pub command: &'static str,
    /// Name of the plan.
    pub plan: String,
    /// SHA-256 of the plan with its surface, in hexadecimal digits.
    pub plan_sha256: String,
    /// Name of the task that is run for each design.
    pub task: String,
    /// The surface as the plan names it.
    pub surface: String,
    /// Number of designs of the plan.
    pub designs: usize,
    /// Number of shards of the plan.
    pub shards: usize,
    /// Estimated cost of computing the modes of the first design on this machine; absent unless designs are
    /// only counted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_modes: Option<Estimate>,
    /// The shard that was requested, counted from 0; absent if all were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shard: Option<usize>,
    /// Number of designs that have a row.
    pub done: usize,
    /// Number of designs without a row yet.
    pub missing: usize,
    /// Number of rows with an error: of all rows once none is missing; before that, of the requested shard.
    pub failed: usize,
    /// The first designs that failed.
    pub failures: Vec<FailedDesign>,
    /// Where each figure is least and greatest, among the designs that did not fail.
    pub extremes: Vec<Extreme>,
    /// Remarks on the rows as a whole.
    pub notes: Vec<Note>,
    /// Files in the folder of the sweep, beside the rows, the plan and the report.
    pub files: Vec<String>,
}

impl Report {
    /// The report on a plan of which nothing is computed.
    pub(super) fn counted(plan: &Plan) -> Self {
        Self { first_modes: plan.estimate(), ..Self::of(plan, &Tally::default(), plan.len()) }
    }

    /// The report on rows that have been tallied, while so many designs are missing.
    pub(super) fn of(plan: &Plan, tally: &Tally, missing: usize) -> Self {
        let file = plan.file();
        Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "sweep",
            plan: file.name.clone(),
            plan_sha256: plan.hash().to_owned(),
            task: file.task.clone(),
            surface: file.surface.clone(),
            designs: plan.len(),
            shards: plan.shards(),
            first_modes: None,
            shard: None,
            done: plan.len().saturating_sub(missing),
            missing,
            failed: tally.failed,
            failures: tally.failures.clone(),
            extremes: tally.extremes(),
            notes: tally.notes(plan),
            files: Vec::new(),
        }
    }

    /// Lines on the least and greatest values of the first figures that vary.
    fn ranges(&self) -> String {
        let varying: Vec<&Extreme> = self.extremes.iter().filter(|e| e.least < e.greatest).collect();
        let Some(wide) = varying.iter().take(LISTED).map(|e| e.figure.chars().count()).max() else {
            return String::new();
        };
        let wide = wide.max("figure".len());
        let mut text = format!(
            "  {:wide$} {:>14} {:>9} {:>14} {:>9}\n",
            "figure", "least", "design", "greatest", "design"
        );
        for Extreme { figure, least, least_at, greatest, greatest_at } in varying.iter().take(LISTED) {
            let (least, greatest) = (short(*least), short(*greatest));
            let _ =
                writeln!(text, "  {figure:wide$} {least:>14} {least_at:>9} {greatest:>14} {greatest_at:>9}");
        }
        if varying.len() > LISTED {
            let _ = writeln!(text, "  ... and {} more figures; --json lists all", varying.len() - LISTED);
        }
        text
    }
}

/// A number in at most six digits.
pub(crate) fn short(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 => "0".into(),
        size if (1e-4..1e9).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The values of a design, as `name = value`.
pub(crate) fn written(values: &[Named]) -> String {
    values.iter().map(|Named { name, value }| format!("{name} = {value}")).collect::<Vec<_>>().join(", ")
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let Self { plan, task, surface, designs, shards, .. } = self;
        let mut text = format!("{plan}: `{task}` on {surface}, {designs} designs in {shards} shards\n");
        if let Some(cost) = &self.first_modes {
            let _ = writeln!(text, "  the modes of the first design take {}", cost.text());
        }
        if let Some(shard) = self.shard {
            let _ = writeln!(text, "  shard {shard} is done");
        }
        let _ = writeln!(text, "  {} done, {} failed, {} missing", self.done, self.failed, self.missing);
        for failed in self.failures.iter().take(TOLD) {
            let _ = writeln!(
                text,
                "  design {} failed ({}): {}",
                failed.index,
                written(&failed.varied),
                failed.error
            );
        }
        if self.failed > TOLD {
            let _ = writeln!(text, "  ... and {} more failed", self.failed - TOLD);
        }
        text += &self.ranges();
        for note in &self.notes {
            let _ = writeln!(text, "note, {}: {}", note.topic, note.text);
        }
        text
    }

    fn failure(&self) -> Option<String> {
        let all = self.failed == self.designs && self.missing == 0;
        let first = self.failures.first().filter(|_| all)?;
        Some(format!("all {} designs failed, the first of them: {}", self.designs, first.error))
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 21.523_456_7, 1.0e-7, 123_456_789.0, -0.5, 3.0e12].map(short);
        assert_eq!(texts, ["0", "21.5235", "1e-7", "123457000", "-0.5", "3e12"]);
    }
}
