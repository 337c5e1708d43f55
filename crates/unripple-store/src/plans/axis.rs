//! One axis of a plan: what varies along it, and its values.

use super::value::{ANY, LARGEST_WHOLE, MOST_DESIGNS, flag, json};
use super::varied::{self, Varied};
use crate::surface::reader::{Entry, Faults, Section};
use serde::Serialize;
use serde_json::Value;

/// Keys of an axis.
const KEYS: [&str; 8] = ["key", "ask", "values", "from", "to", "steps", "log", "whole"];

/// Who chooses values on the axes of a plan.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Chosen {
    /// The plan: those of a list, or so many between two ends.
    Here,
    /// Sobol points between two ends.
    BySobol,
    /// A search: of a list, or anywhere between two ends.
    BySearch,
}

/// What varies along an axis, and over which values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// The key of the surface file or the field of the request.
    pub varied: Varied,
    /// The values of the axis.
    pub values: AxisValues,
}

/// The values of an axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum AxisValues {
    /// One after the other, as listed.
    List(Vec<Value>),
    /// Numbers between two ends.
    Range {
        /// The least value, in the unit of the key or field.
        from: f64,
        /// The greatest value, above the least.
        to: f64,
        /// Number of values, at least 2, both ends among them; `None` where Sobol points or a search choose them.
        steps: Option<usize>,
        /// Whether ratios of neighbours are equal, rather than differences; both ends are then above 0.
        log: bool,
        /// Whether values are whole numbers.
        whole: bool,
    },
}

impl Axis {
    /// Number of values of the axis; 1 where Sobol points or a search choose them between two ends.
    pub fn count(&self) -> usize {
        match &self.values {
            AxisValues::List(list) => list.len(),
            AxisValues::Range { steps, .. } => steps.unwrap_or(1),
        }
    }
}

/// An axis from its table; `fields` are those of the task, if it is known.
pub(super) fn read(
    section: &Section,
    chosen: Chosen,
    fields: Option<&[&str]>,
    faults: &mut Faults,
) -> Option<Axis> {
    section.check_keys(&KEYS, |_| None, faults);
    let varied = varied(section, fields, faults);
    let values = values(section, chosen, faults);
    Some(Axis { varied: varied?, values: values? })
}

fn varied(section: &Section, fields: Option<&[&str]>, faults: &mut Faults) -> Option<Varied> {
    match (section.get("key"), section.get("ask")) {
        (Some(key), None) => varied::key(&key, faults),
        (None, Some(field)) => varied::field(&field, fields, faults),
        (Some(_), Some(field)) => {
            field.refuse("key or ask, not both", None, faults);
            None
        }
        (None, None) => {
            let expected = "key, a key of the surface file, or ask, a field of the task's request";
            faults.add(&section.key, section.span.clone(), "neither key nor ask", expected, None);
            None
        }
    }
}

fn values(section: &Section, chosen: Chosen, faults: &mut Faults) -> Option<AxisValues> {
    let (from, to) = (section.get("from"), section.get("to"));
    match (section.get("values"), from, to) {
        (Some(entry), None, None) if chosen == Chosen::BySobol => {
            entry.refuse("from and to, between which Sobol points lie", None, faults);
            None
        }
        (Some(entry), None, None) if chosen == Chosen::BySearch => choices(&entry, faults),
        (Some(entry), None, None) => list(&entry, faults),
        (Some(entry), ..) => {
            entry.refuse("values, or from and to, not both", None, faults);
            None
        }
        (None, Some(from), Some(to)) => range(section, [&from, &to], chosen, faults),
        (None, ..) => {
            let expected = match chosen {
                Chosen::Here => "values, or from, to and steps",
                Chosen::BySobol => "from and to",
                Chosen::BySearch => "values, or from and to",
            };
            faults.add(&section.key, section.span.clone(), "no range of values", expected, None);
            None
        }
    }
}

fn list(entry: &Entry, faults: &mut Faults) -> Option<AxisValues> {
    let Some(items) = entry.items().filter(|items| !items.is_empty()) else {
        entry.refuse("a list of at least one value", None, faults);
        return None;
    };
    let read: Vec<_> = items.iter().map(|item| json(item, faults)).collect();
    read.into_iter().collect::<Option<_>>().map(AxisValues::List)
}

/// The values among which a search chooses: two at least, each once. Numbers among them leave room for differences, as those of a range do.
fn choices(entry: &Entry, faults: &mut Faults) -> Option<AxisValues> {
    let Some(AxisValues::List(values)) = list(entry, faults) else { return None };
    let items = entry.items()?;
    let numbers = items.iter().filter(|item| item.is_number());
    let numbers: Vec<Option<f64>> = numbers.map(|item| item.number(&ANY, faults)).collect();
    if numbers.contains(&None) {
        return None;
    }
    let is_second = |at: usize| values[..at].contains(&values[at]);
    if values.len() < 2 || (0..values.len()).any(is_second) {
        entry.refuse("a list of at least two values to choose from, each once", None, faults);
        return None;
    }
    Some(AxisValues::List(values))
}

fn range(section: &Section, ends: [&Entry; 2], chosen: Chosen, faults: &mut Faults) -> Option<AxisValues> {
    let [from, to] = ends.map(|end| end.number(&ANY, faults));
    let (log, whole) = (flag(section.get("log"), faults), flag(section.get("whole"), faults));
    let steps = steps(section, chosen, faults);
    let (from, to, log, whole, steps) = (from?, to?, log?, whole?, steps?);
    if from >= to {
        ends[1].refuse(format!("a number above from = {from}: an empty range has no values"), None, faults);
        return None;
    }
    if log && from <= 0.0 {
        ends[0].refuse("a number above 0 where log = true", None, faults);
        return None;
    }
    let is_whole = |end: f64| end.fract() == 0.0 && end.abs() <= LARGEST_WHOLE;
    if whole && !(is_whole(from) && is_whole(to)) {
        ends[usize::from(is_whole(from))].refuse("a whole number where whole = true", None, faults);
        return None;
    }
    if whole && steps.is_some_and(|steps| steps as f64 > to - from + 1.0) {
        let most = format!("at most {} steps, since there are no more whole numbers", to - from + 1.0);
        section.get("steps")?.refuse(most, None, faults);
        return None;
    }
    Some(AxisValues::Range { from, to, steps, log, whole })
}

/// The number of steps: `Some(None)` where the plan does not choose the values.
fn steps(section: &Section, chosen: Chosen, faults: &mut Faults) -> Option<Option<usize>> {
    match (section.get("steps"), chosen) {
        (None, Chosen::BySobol | Chosen::BySearch) => Some(None),
        (Some(entry), Chosen::BySobol) => {
            entry.refuse("no steps: count in [sobol] says how many designs there are", None, faults);
            None
        }
        (Some(entry), Chosen::BySearch) => {
            entry.refuse("no steps: the search chooses any value between from and to", None, faults);
            None
        }
        (Some(entry), Chosen::Here) => entry.count(2, MOST_DESIGNS, faults).map(Some),
        (None, Chosen::Here) => {
            let expected = format!("a whole number from 2 to {MOST_DESIGNS}");
            section.require("steps", &expected, faults);
            None
        }
    }
}
