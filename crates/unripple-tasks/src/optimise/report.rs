//! Report of the task `optimise`.

use super::course::Course;
use super::{End, EndedBy, Good, Search, Step};
use crate::TaskError;
use crate::several::several;
use crate::sweep::{FailedDesign, Named, listed, short};
use serde::Serialize;
use std::fmt::Write;
use unripple::act::Note;
use unripple_store::{Objective, Want};

/// Designs of the front that the text report has; JSON has all.
const LISTED: usize = 20;

/// Failures that the report has; more of them say little more.
const FAILURES: usize = 10;

/// Failures that the text report has.
const TOLD: usize = 3;

/// How far a search is, and what it has found.
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
    /// SHA-256 of the plan with its surface, but for the number of generations, in hexadecimal digits.
    pub plan_sha256: String,
    /// Name of the task that designs were given to.
    pub task: String,
    /// The surface as the plan names it.
    pub surface: String,
    /// The optimisers that asked for designs, as they call themselves, with their versions.
    pub optimisers: Vec<String>,
    /// What is to be most or least.
    pub objectives: Vec<Objective>,
    /// Number of generations of the plan.
    pub generations: usize,
    /// Number of generations whose designs all have a row.
    pub done: usize,
    /// The generation whose designs have to be asked for next, counted from 0; absent once the search is over.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_ask: Option<usize>,
    /// Why the search is over; absent while it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ended: Option<End>,
    /// Number of designs that have a row.
    pub designs: usize,
    /// How many of them failed.
    pub failed: usize,
    /// The first designs that failed.
    pub failures: Vec<FailedDesign>,
    /// With one objective: the best design that keeps all constraints; `None` if there is none.
    pub best: Option<Good>,
    /// The surface file of the best design; `None` if no unknown is a key of the surface file, or there is no best design.
    pub best_surface: Option<String>,
    /// The designs that keep all constraints and that no other one is better than, in their order.
    pub front: Vec<Good>,
    /// What each generation brought.
    pub history: Vec<Step>,
    /// Remarks on the search as a whole.
    pub notes: Vec<Note>,
    /// Files in the folder of the search, beside its generations, the plan and the report.
    pub files: Vec<String>,
}

impl Report {
    /// The report on what is known of a search.
    ///
    /// # Errors
    /// [`TaskError::Input`] of keys of the best design that cannot be set, which no plan that could be opened has.
    pub(super) fn of(search: &Search, course: &Course) -> Result<Self, TaskError> {
        let (file, names, told) = (search.file(), search.names(), &course.told);
        let failed = told.iter().filter(|told| told.losses.is_none());
        let failures = failed.clone().take(FAILURES).map(|told| FailedDesign {
            index: told.index,
            varied: names.iter().map(|name| Named { name: name.clone(), value: told.value(name) }).collect(),
            error: told.error.clone().unwrap_or_default(),
        });
        let front: Vec<Good> = course.front.places().iter().map(|at| Good::of(&told[*at], &names)).collect();
        let first = course.front.places().first().filter(|_| file.objectives.len() == 1);
        let best_surface = match first {
            Some(at) => search.surface_of(&told[*at].design(file))?,
            None => None,
        };
        Ok(Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "optimise",
            plan: file.name.clone(),
            plan_sha256: search.hash().to_owned(),
            task: file.task.clone(),
            surface: file.surface.clone(),
            optimisers: course.optimisers.clone(),
            objectives: file.objectives.clone(),
            generations: file.generations,
            done: course.steps.len(),
            to_ask: course.to_ask,
            ended: course.ended.clone(),
            designs: told.len(),
            failed: failed.count(),
            failures: failures.collect(),
            best: first.and_then(|_| front.first().cloned()),
            best_surface,
            front,
            history: course.steps.clone(),
            notes: notes(course),
            files: Vec::new(),
        })
    }

    /// Lines on the best design, or on those of the front.
    fn found(&self) -> String {
        let line = |good: &Good| {
            let (at, values, figures) = (good.index, listed(&good.varied), &good.figures);
            let objectives = figures.iter().take(self.objectives.len());
            let figures = objectives.map(|Named { name, value }| {
                let shown = value.as_f64().map_or_else(|| value.to_string(), short);
                format!("{name} = {shown}")
            });
            format!("design {at}: {} ({values})\n", figures.collect::<Vec<_>>().join(", "))
        };
        if let Some(best) = &self.best {
            return format!("  best, {}", line(best));
        }
        if self.objectives.len() == 1 || self.front.is_empty() {
            return String::new();
        }
        let front = several(self.front.len(), "design");
        let mut text = format!("  {front} that no other one is better than:\n");
        self.front.iter().take(LISTED).for_each(|good| text += &format!("    {}", line(good)));
        if self.front.len() > LISTED {
            let _ = writeln!(text, "    ... and {} more; --json lists all", self.front.len() - LISTED);
        }
        text
    }
}

/// Remarks on a search as a whole.
fn notes(course: &Course) -> Vec<Note> {
    let mut notes = Vec::new();
    let measured = course.told.iter().filter(|told| told.losses.is_some());
    let least = measured.min_by(|one, other| one.violation.total_cmp(&other.violation));
    if let Some(least) = least.filter(|_| course.front.places().is_empty()) {
        let text =
            format!("no design keeps all constraints; design {} is the least far from it", least.index);
        notes.push(Note { topic: "constraints", text });
    }
    if course.optimisers.len() > 1 {
        let all = course.optimisers.join(", ");
        let text = format!(
            "designs were asked for by several optimisers: {all}; none of them would have made this search alone"
        );
        notes.push(Note { topic: "optimisers", text });
    }
    notes
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let Self { plan, task, surface, done, generations, designs, .. } = self;
        let by = match self.optimisers.as_slice() {
            [] => String::new(),
            some => format!(" by {}", some.join(", ")),
        };
        let wanted = self.objectives.iter().map(|Objective { figure, want }| match want {
            Want::Most => format!("most {figure}"),
            Want::Least => format!("least {figure}"),
        });
        let wanted = wanted.collect::<Vec<_>>().join(", ");
        let mut text = format!("{plan}: {wanted} of `{task}` on {surface}{by}\n");
        let _ = writeln!(
            text,
            "  {done} of {}, {}, {} failed",
            several(*generations, "generation"),
            several(*designs, "design"),
            self.failed
        );
        for failed in self.failures.iter().take(TOLD) {
            let (at, values, error) = (failed.index, listed(&failed.varied), &failed.error);
            let _ = writeln!(text, "  design {at} failed ({values}): {error}");
        }
        if self.failed > TOLD {
            let _ = writeln!(text, "  ... and {} more failed", self.failed - TOLD);
        }
        text += &self.found();
        if let Some(generation) = self.to_ask {
            let _ = writeln!(text, "  generation {generation} has to be asked for");
        }
        if let Some(End { by, why }) = &self.ended
            && *by != EndedBy::Generations
        {
            let _ = writeln!(text, "  over before its last generation: {why}");
        }
        for note in &self.notes {
            let _ = writeln!(text, "note, {}: {}", note.topic, note.text);
        }
        text
    }

    fn failure(&self) -> Option<String> {
        let all = self.failed == self.designs && self.to_ask.is_none();
        let first = self.failures.first().filter(|_| all)?;
        let what = match self.designs {
            1 => "the one design failed".to_owned(),
            designs => format!("all {designs} designs failed, the first of them"),
        };
        Some(format!("{what}: {}", first.error))
    }
}
