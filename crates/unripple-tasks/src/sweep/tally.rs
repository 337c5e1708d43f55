//! What is true of all rows together: columns, failures, extremes.

use super::counted::{Extreme, FailedDesign, Named};
use super::{Plan, Row};
use std::collections::{BTreeSet, HashMap};
use unripple::act::Note;

/// Failures that a report tells one by one; more of them say little more.
const TOLD: usize = 10;

/// What rows have shown so far.
#[derive(Default)]
pub(super) struct Tally {
    /// Figures that rows have, in the order in which they came first.
    pub columns: Vec<String>,
    /// Place of each figure among the columns.
    places: HashMap<String, usize>,
    /// Least and greatest value of each column that holds numbers.
    extremes: Vec<Option<Extreme>>,
    /// Whether a column has a value that is known.
    known: Vec<bool>,
    /// Number of rows with an error.
    pub failed: usize,
    /// The first failures.
    pub failures: Vec<FailedDesign>,
    /// Most lists and texts that were left out of a row.
    pub left_out: usize,
    versions: BTreeSet<String>,
}

impl Tally {
    /// Takes a row into account.
    pub fn take(&mut self, row: &Row) {
        if let Some(error) = &row.error {
            self.failed += 1;
            if self.failures.len() < TOLD {
                let varied = row.values.0.iter().cloned().map(|(name, value)| Named { name, value });
                self.failures.push(FailedDesign {
                    index: row.index,
                    varied: varied.collect(),
                    error: error.clone(),
                });
            }
        }
        self.left_out = self.left_out.max(row.left_out);
        if !self.versions.contains(&row.version) {
            self.versions.insert(row.version.clone());
        }
        for (name, value) in &row.figures.0 {
            let place = self.place(name);
            self.known[place] |= !value.is_null();
            let number = value.as_f64().filter(|_| row.error.is_none());
            match (&mut self.extremes[place], number) {
                (_, None) => {}
                (Some(extreme), Some(number)) => extreme.take(number, row.index),
                (empty, Some(number)) => *empty = Some(Extreme::first(name, number, row.index)),
            }
        }
    }

    /// The place of a figure among the columns, which it comes into.
    fn place(&mut self, name: &str) -> usize {
        if let Some(place) = self.places.get(name) {
            return *place;
        }
        let place = self.columns.len();
        self.places.insert(name.to_owned(), place);
        self.columns.push(name.to_owned());
        self.extremes.push(None);
        self.known.push(false);
        place
    }

    /// The place of a figure among the columns; `None` if no row has it.
    pub fn place_of(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    /// Least and greatest values of the figures that are numbers, in the order of the columns.
    pub fn extremes(&self) -> Vec<Extreme> {
        self.extremes.iter().flatten().cloned().collect()
    }

    /// Remarks on the rows as a whole.
    pub fn notes(&self, plan: &Plan) -> Vec<Note> {
        let mut notes = Vec::new();
        let chosen = &plan.file().figures;
        let below = |pointer: &String| {
            let start = format!("{pointer}/");
            self.columns
                .iter()
                .zip(&self.known)
                .any(|(name, known)| *known && (name == pointer || name.starts_with(&start)))
        };
        for pointer in chosen.iter().filter(|pointer| !self.columns.is_empty() && !below(pointer)) {
            notes.push(Note {
                topic: "figures",
                text: format!("no report has a number or short text at {pointer}"),
            });
        }
        if self.versions.len() > 1 {
            let versions = self.versions.iter().cloned().collect::<Vec<_>>().join(", ");
            let text = format!("rows were computed by several versions of the program: {versions}");
            notes.push(Note { topic: "version", text });
        }
        if self.left_out > 0 {
            let text = format!(
                "up to {} long lists and texts of each report are left out of the table",
                self.left_out
            );
            notes.push(Note { topic: "left out", text });
        }
        notes
    }
}
