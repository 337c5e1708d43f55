//! How edges are held, in a surface file.

use super::range::of;
use super::reader::{Entry, Faults, Section};
use unripple_core::{Edge, Edges};

/// The edge conditions that have names.
pub(super) const EDGES: [(&str, Edge); 3] =
    [("clamped", Edge::Clamped), ("supported", Edge::Supported), ("free", Edge::Free)];

const SPRING_KEYS: [&str; 2] = ["lift_n_per_mm2", "tilt_n"];

/// The sides that a list of edges is for.
pub(super) struct SidesListed {
    /// How many there are.
    pub count: usize,
    /// Where counting starts and which way it goes.
    pub order: &'static str,
}

/// What `edge` of a table says; `default` if nothing. Without `sides`, which are at fault then, a list is only read.
pub(super) fn read(
    section: &Section,
    default: Edge,
    sides: Option<&SidesListed>,
    expand: impl Fn(Vec<Edge>) -> Edges,
    faults: &mut Faults,
) -> Option<Edges> {
    let Some(entry) = section.get("edge") else { return Some(Edges::All(default)) };
    let Some(items) = entry.items() else {
        return one(&entry, faults).map(Edges::All);
    };
    let list: Vec<Option<Edge>> = items.iter().map(|item| one(item, faults)).collect();
    let SidesListed { count, order } = sides?;
    if list.len() != *count {
        let found = format!("a list of {}", list.len());
        let expected = format!("one word, or a list of {count}, one per side {order}");
        faults.add(&entry.key, entry.span.clone(), found, expected, None);
        return None;
    }
    list.into_iter().collect::<Option<Vec<Edge>>>().map(expand)
}

/// A word or springs.
fn one(entry: &Entry, faults: &mut Faults) -> Option<Edge> {
    if entry.is_text() {
        return entry.choice(&EDGES, faults);
    }
    if !entry.is_table() {
        let words: Vec<String> = EDGES.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        entry.refuse(
            format!("{}, or springs {{ lift_n_per_mm2 = …, tilt_n = … }}", words.join(", ")),
            None,
            faults,
        );
        return None;
    }
    let springs = entry.section(faults)?;
    springs.check_keys(&SPRING_KEYS, |_| None, faults);
    let lift = springs.number(SPRING_KEYS[0], &of::LIFT, faults);
    let tilt = springs.number_or(SPRING_KEYS[1], 0.0, &of::TILT, faults);
    Some(Edge::Elastic { lift: lift?, tilt: tilt? })
}
