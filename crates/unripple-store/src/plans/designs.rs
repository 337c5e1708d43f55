//! The designs of a plan: a grid, Sobol points or a list.

use super::axis::{self, Axis, Chosen};
use super::value::{MOST_DESIGNS, json};
use super::varied::{Varied, overlap, twice, unknown};
use crate::surface::reader::{Entry, Faults, Section};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeSet;
use std::ops::Range;

/// Most Sobol points: as many as the generator's sequence has.
const MOST_POINTS: usize = 1 << 16;

/// Most axes of a plan: a grid of two values on each of so many has more designs than are allowed.
const MOST_AXES: usize = 64;

/// Keys of the table of Sobol points.
const SOBOL: [&str; 2] = ["count", "seed"];

/// The seed of Sobol points where a plan does not say. Any other gives other points that lie as evenly.
const SEED: usize = 1;

/// The designs of a plan, in their order.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Designs {
    /// Every combination of the axes' values, those of the last axis first.
    Grid(Vec<Axis>),
    /// Sobol points, scrambled by a seed, between the ends of the axes.
    Sobol {
        /// The axes, each with two ends.
        axes: Vec<Axis>,
        /// Number of points.
        count: usize,
        /// Seed of the scrambling.
        seed: u32,
    },
    /// Designs one by one, each with values of its own.
    List(Vec<Vec<(Varied, Value)>>),
}

impl Designs {
    /// Number of designs.
    pub fn len(&self) -> usize {
        match self {
            Self::Grid(axes) => axes.iter().map(Axis::count).product(),
            Self::Sobol { count, .. } => *count,
            Self::List(list) => list.len(),
        }
    }

    /// Whether there is no design; a plan has at least one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The keys and fields that vary, each once: in the order of the axes, or of first mention in the list.
    pub fn varied(&self) -> Vec<&Varied> {
        match self {
            Self::Grid(axes) | Self::Sobol { axes, .. } => axes.iter().map(|axis| &axis.varied).collect(),
            Self::List(list) => {
                let mut seen = BTreeSet::new();
                let all = list.iter().flatten().map(|(varied, _)| varied);
                all.filter(|varied| seen.insert(*varied)).collect()
            }
        }
    }
}

/// The designs that the plan's axes, Sobol points or list make; `fields` are those of the task, if it is known.
pub(super) fn read(root: &Section, fields: Option<&[&str]>, faults: &mut Faults) -> Option<Designs> {
    let expected = "tables headed [[axis]], with [sobol] for points between their ends, or [[design]]";
    let sobol = root.get("sobol");
    match (root.get("axis"), root.get("design")) {
        (Some(axes), None) => {
            let points = sobol.as_ref().map(|entry| points(entry, faults));
            let chosen = if sobol.is_some() { Chosen::BySobol } else { Chosen::Here };
            let read = axes_of(&axes, chosen, fields, faults);
            match points {
                None => grid(&axes, read?, faults),
                Some(points) => {
                    let (count, seed) = points?;
                    Some(Designs::Sobol { axes: read?, count, seed })
                }
            }
        }
        (None, Some(list)) => {
            if let Some(entry) = sobol {
                entry.refuse("no [sobol] beside [[design]]: Sobol points need axes", None, faults);
            }
            designs(&list, fields, faults).map(Designs::List)
        }
        (Some(_), Some(list)) => {
            list.refuse("[[axis]] or [[design]], not both", None, faults);
            None
        }
        (None, None) => {
            faults.add("axis", 0..0, "no designs", expected, None);
            None
        }
    }
}

/// The axes from their tables, no two of which set the same.
pub(super) fn axes_of(
    entry: &Entry,
    chosen: Chosen,
    fields: Option<&[&str]>,
    faults: &mut Faults,
) -> Option<Vec<Axis>> {
    let Some(items) = entry.items().filter(|items| (1..=MOST_AXES).contains(&items.len())) else {
        entry.refuse(format!("1 to {MOST_AXES} tables headed [[axis]]"), None, faults);
        return None;
    };
    let read: Vec<_> =
        items.iter().map(|item| axis::read(&item.section(faults)?, chosen, fields, faults)).collect();
    let axes = read.into_iter().collect::<Option<Vec<_>>>()?;
    let Some([first, second]) = overlap(axes.iter().map(|axis| &axis.varied)) else { return Some(axes) };
    let section = items[second].section(faults)?;
    let named = section.get("key").or_else(|| section.get("ask"))?;
    let (found, expected) = twice(&axes[first].varied, &axes[second].varied);
    faults.add(&named.key, named.span.clone(), found, expected, None);
    None
}

/// The grid of some axes, unless it has too many designs.
fn grid(entry: &Entry, axes: Vec<Axis>, faults: &mut Faults) -> Option<Designs> {
    let count = axes.iter().fold(1u128, |count, axis| count.saturating_mul(axis.count() as u128));
    if count <= MOST_DESIGNS as u128 {
        return Some(Designs::Grid(axes));
    }
    let expected = format!("at most {MOST_DESIGNS} designs");
    faults.add(&entry.key, entry.span.clone(), format!("{count} designs"), expected, None);
    None
}

/// Number and seed of Sobol points.
fn points(entry: &Entry, faults: &mut Faults) -> Option<(usize, u32)> {
    let section = entry.section(faults)?;
    section.check_keys(&SOBOL, |_| None, faults);
    let expected = format!("a whole number from 1 to {MOST_POINTS}");
    let count =
        section.require("count", &expected, faults).and_then(|entry| entry.count(1, MOST_POINTS, faults));
    let seed = match section.get("seed") {
        Some(entry) => entry.count(0, u32::MAX as usize, faults),
        None => Some(SEED),
    };
    Some((count?, u32::try_from(seed?).ok()?))
}

/// Designs one by one.
fn designs(entry: &Entry, fields: Option<&[&str]>, faults: &mut Faults) -> Option<Vec<Vec<(Varied, Value)>>> {
    let Some(items) = entry.items().filter(|items| (1..=MOST_DESIGNS).contains(&items.len())) else {
        entry.refuse("at least one table headed [[design]]", None, faults);
        return None;
    };
    let read: Vec<_> = items.iter().map(|item| design(&item.section(faults)?, fields, faults)).collect();
    read.into_iter().collect()
}

/// One design: values by `surface:KEY` and `ask:FIELD`, no two of which set the same.
fn design(section: &Section, fields: Option<&[&str]>, faults: &mut Faults) -> Option<Vec<(Varied, Value)>> {
    let mut one = |(name, span, entry): (String, Range<usize>, Entry)| {
        let (expected, nearest) = match name.split_once(':') {
            Some(("surface", key)) if !key.is_empty() => {
                return Some((Varied::Surface(key.into()), json(&entry, faults)?));
            }
            Some(("ask", field)) if !field.is_empty() => match unknown(field, fields) {
                None => return Some((Varied::Ask(field.into()), json(&entry, faults)?)),
                Some((expected, nearest)) => (expected, nearest.map(|name| format!("\"ask:{}", &name[1..]))),
            },
            _ => ("\"surface:KEY\" or \"ask:FIELD\"".to_owned(), Some(format!("\"surface:{name}\""))),
        };
        faults.add(&entry.key, span, format!("`{name}`"), expected, nearest);
        None
    };
    let entries = section.entries();
    let spans: Vec<Range<usize>> = entries.iter().map(|(_, span, _)| span.clone()).collect();
    let read: Vec<_> = entries.into_iter().map(&mut one).collect();
    let read = read.into_iter().collect::<Option<Vec<_>>>()?;
    let Some([one, other]) = overlap(read.iter().map(|(varied, _)| varied)) else { return Some(read) };
    let [first, second] = if spans[one].start < spans[other].start { [one, other] } else { [other, one] };
    let (found, expected) = twice(&read[first].0, &read[second].0);
    faults.add(&format!("{}.{}", section.key, read[second].0), spans[second].clone(), found, expected, None);
    None
}
