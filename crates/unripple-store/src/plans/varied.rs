//! What varies from one design of a plan to the next: a key of the surface file, or a field of the task's request.

use super::value::near;
use crate::surface::reader::{Entry, Faults};
use serde::{Serialize, Serializer};
use std::fmt;

/// Most fields that a message lists, so that it stays a line.
const NAMED: usize = 30;

/// A key of the surface file or a field of the task's request, whose value varies from design to design.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Varied {
    /// Path of a key of the surface file, such as `sheet.tension_n_per_m`.
    Surface(String),
    /// Path of a field of the request, such as `window_s` or `points.0.at_m`.
    Ask(String),
}

impl Varied {
    /// The steps of its path: keys, and indices of lists as plain numbers.
    fn steps(&self) -> Vec<String> {
        let (kind, path) = match self {
            Self::Surface(key) => ("surface", key.replace('[', ".").replace(']', "")),
            Self::Ask(field) => ("ask", field.clone()),
        };
        let step = |step: &str| step.parse::<usize>().map_or_else(|_| step.to_owned(), |at| at.to_string());
        std::iter::once(kind.to_owned()).chain(path.split('.').map(step)).collect()
    }
}

/// Indices, in order, of two of some that would set the same value: they are equal, or one is a part of the other.
pub(super) fn overlap<'v>(all: impl Iterator<Item = &'v Varied>) -> Option<[usize; 2]> {
    let mut sorted: Vec<_> = all.enumerate().map(|(at, varied)| (varied.steps(), at)).collect();
    sorted.sort_unstable();
    // What a path is the beginning of follows it.
    let pair = sorted.windows(2).find(|pair| pair[1].0.starts_with(&pair[0].0))?;
    Some([pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1)])
}

/// What is wrong with `second`, which sets what `first` does; and what was expected.
pub(super) fn twice(first: &Varied, second: &Varied) -> (String, &'static str) {
    let found = match first == second {
        true => format!("{second} again"),
        false => format!("{second} beside {first}"),
    };
    (found, "each key and field once, and no part of one beside it")
}

impl fmt::Display for Varied {
    /// As lists of designs and tables name it: `surface:KEY` or `ask:FIELD`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Surface(key) => write!(f, "surface:{key}"),
            Self::Ask(field) => write!(f, "ask:{field}"),
        }
    }
}

impl Serialize for Varied {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The key of the surface file that a value names; otherwise a fault.
pub(super) fn key(entry: &Entry, faults: &mut Faults) -> Option<Varied> {
    entry.line("a key of the surface file, as \"sheet.tension_n_per_m\"", faults).map(Varied::Surface)
}

/// The field of the request that a value names; otherwise a fault. `fields` are those of the task, if it is known.
pub(super) fn field(entry: &Entry, fields: Option<&[&str]>, faults: &mut Faults) -> Option<Varied> {
    let path = entry.line("a field of the task's request, as \"window_s\"", faults)?;
    match unknown(&path, fields) {
        None => Some(Varied::Ask(path)),
        Some((expected, nearest)) => {
            entry.refuse(expected, nearest, faults);
            None
        }
    }
}

/// What was expected in place of the path of a field that the task does not have, and the nearest field; `None` if it has it.
pub(super) fn unknown(path: &str, fields: Option<&[&str]>) -> Option<(String, Option<String>)> {
    let fields = fields?;
    let first = path.split('.').next().unwrap_or_default();
    if fields.contains(&first) {
        return None;
    }
    let listed = match fields.len() {
        0 => "no field, since the task has none but its surface".to_owned(),
        1..=NAMED => format!("a field of the task's request: {}", fields.join(", ")),
        count => format!("one of the {count} fields of the task's request"),
    };
    Some((listed, near(first, fields)))
}
