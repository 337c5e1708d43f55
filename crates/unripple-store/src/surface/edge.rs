//! How edges are held, in a surface file.

use super::range::of;
use super::reader::{Entry, Faults, Section};
use crate::decimal;
use unripple_core::{Edge, Edges};

/// The edge conditions that have names in files.
pub(super) const EDGES: [(&str, Edge); 3] =
    [("clamped", Edge::Clamped), ("supported", Edge::Supported), ("free", Edge::Free)];

/// Keys of an edge on springs: stiffness against displacement and against rotation, per length.
const SPRING_KEYS: [&str; 2] = ["lift_n_per_mm2", "tilt_n"];
/// A strip of adhesive under the rim, which is springs too.
const ADHESIVE_KEYS: [&str; 3] = ["adhesive_young_mpa", "adhesive_width_mm", "adhesive_thickness_mm"];

/// The sides that a list of edges is for.
pub(super) struct SidesListed {
    /// Number of sides.
    pub count: usize,
    /// At which side counting starts and in which direction it goes, in words.
    pub order: &'static str,
}

/// Reads the key `edge` of a table; `default` if there is none. Where `sides` is `None`, because the sides themselves are faulty, a list
/// is checked but not used.
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
            format!(
                "{}, or springs {{ lift_n_per_mm2 = …, tilt_n = … }} or {{ {} = …, … }}",
                words.join(", "),
                ADHESIVE_KEYS[0]
            ),
            None,
            faults,
        );
        return None;
    }
    let springs = entry.section(faults)?;
    springs.check_keys(&[&SPRING_KEYS[..], &ADHESIVE_KEYS].concat(), |_| None, faults);
    if ADHESIVE_KEYS.iter().any(|key| springs.get(key).is_some()) {
        return adhesive(&springs, faults);
    }
    let lift = springs.number(SPRING_KEYS[0], &of::LIFT, faults);
    let tilt = springs.number_or(SPRING_KEYS[1], 0.0, &of::TILT, faults);
    Some(Edge::Elastic { lift: lift?, tilt: tilt? })
}

/// A strip of adhesive as springs. With Young's modulus E (for a wide thin strip rather its constrained modulus),
/// width w and thickness t its stiffness per length of rim is E w / t against displacement and E w³ / (12 t) against
/// rotation, if each slice of it is stretched as the sheet above it moves.
fn adhesive(strip: &Section, faults: &mut Faults) -> Option<Edge> {
    if let Some(other) = SPRING_KEYS.iter().find_map(|key| strip.get(key)) {
        let expected = format!("either {}, or {}", SPRING_KEYS.join(" and "), ADHESIVE_KEYS.join(", "));
        other.refuse(expected, None, faults);
        return None;
    }
    let young = strip.number(ADHESIVE_KEYS[0], &of::ADHESIVE_YOUNG, faults);
    let width = strip.number(ADHESIVE_KEYS[1], &of::ADHESIVE_WIDTH, faults);
    let thickness = strip.number(ADHESIVE_KEYS[2], &of::ADHESIVE_THICKNESS, faults);
    let (young, width, thickness) = (young?, width?, thickness?);
    let lift = young * width / thickness;
    let tilt = lift * width * width / 12.0;
    if of::LIFT.hold(lift) && of::TILT.hold(tilt) {
        return Some(Edge::Elastic { lift, tilt });
    }
    let written = |value: f64| decimal::plain(&format!("{value:.3e}"));
    let found = format!("a strip whose springs are {} N/mm² and {} N", written(lift / 1e6), written(tilt));
    let expected = format!(
        "a strip whose springs are at most {} N/mm² against displacement and {} N against rotation",
        written(of::LIFT.greatest),
        written(of::TILT.greatest)
    );
    faults.add(&strip.key, strip.span.clone(), found, expected, Some("\"clamped\"".into()));
    None
}
