//! How often each fault came, and how long it took until all was well again.

use crate::faults::Fault;
use crate::program::Task;
use serde_json::Value;
use std::collections::BTreeMap;
use std::time::Duration;

/// Of each fault its number, and the longest time until all was well again.
#[derive(Default)]
pub struct Tally(BTreeMap<Fault, (usize, Duration)>);

impl Tally {
    /// Notes that a fault comes.
    pub fn comes(&mut self, fault: Fault) {
        self.0.entry(fault).or_default().0 += 1;
    }

    /// Notes how long it took until all was well after it.
    pub fn lasted(&mut self, fault: Fault, took: Duration) {
        let longest = &mut self.0.entry(fault).or_default().1;
        *longest = took.max(*longest);
    }

    /// How often a fault came.
    pub fn count(&self, fault: Fault) -> usize {
        self.0.get(&fault).map_or(0, |(count, _)| *count)
    }

    /// Prints a line for each fault, with what the program counted in all that may tell of it.
    pub fn print(&self, task: Task, counted: &Value) {
        for (fault, (count, longest)) in &self.0 {
            let name = format!("{fault:?}");
            let told = fault.counted(task).iter().map(|key| match counted.pointer(key) {
                Some(value) => format!(", {} {value}", key.trim_start_matches('/')),
                None => format!(", no {key}"),
            });
            let told: String = told.collect();
            println!(
                "{task:?}: {name:<8}{count:>5} times, well again after {:.1} s at most{told}",
                longest.as_secs_f64()
            );
        }
    }
}
