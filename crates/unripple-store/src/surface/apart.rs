//! Whether an outline with its holes bounds a sheet: what [`Outline::faults`] says, in the words and places of the file.

use super::hole::Cut;
use super::outline::{MOST_HOLES, Rim, count_expected};
use super::reader::Faults;
use super::ring::place;
use unripple_core::{Outline, OutlineFault, Shape};

/// Largest number of sides of all rims together: each is compared with those near it, and past this number nothing is compared.
const MOST_SIDES: usize = 16_384;

/// Which holes lie on the sheet and apart from each other; there is a fault for each that does not, or for what kept all
/// from being judged. Nothing if the outer rim itself is at fault; holes are not checked then.
pub(super) fn check(rim: &Rim, cuts: &[Cut], faults: &mut Faults) -> Option<Vec<bool>> {
    let shape = rim.shape.as_ref()?;
    if cuts.len() > MOST_HOLES {
        let last = &cuts[MOST_HOLES];
        faults.add(&last.key, last.span.clone(), format!("{} holes", cuts.len()), count_expected(), None);
        return None;
    }
    let mut sides = shape.sides().len();
    for cut in cuts {
        sides += cut.hole.sides.len();
        if sides > MOST_SIDES {
            let expected = format!("at most {MOST_SIDES} sides of all rims together");
            faults.add(&cut.key, cut.span.clone(), "a hole past that", expected, None);
            return None;
        }
    }
    judge(rim, shape, cuts, faults)
}

fn judge(rim: &Rim, shape: &Shape, cuts: &[Cut], faults: &mut Faults) -> Option<Vec<bool>> {
    let mut outline = Outline::new(shape.clone());
    outline.holes = cuts.iter().map(|cut| cut.hole.clone()).collect();
    let mut good = vec![true; cuts.len()];
    let mut sound = true;
    for fault in outline.faults() {
        // Too many sides to compare: the fault is put where the last rim is.
        let rim_at_fault = fault.rim().unwrap_or(cuts.len());
        let Some(cut) = rim_at_fault.checked_sub(1).and_then(|hole| cuts.get(hole)) else {
            sound = false;
            faults.add("outline", rim.shape_span.clone(), fault.found(), fault.expected(), None);
            continue;
        };
        let first = std::mem::replace(&mut good[rim_at_fault - 1], false);
        if first {
            let (found, expected) = words(&fault, cuts);
            faults.add(&cut.key, cut.span.clone(), found, expected, None);
        }
    }
    sound.then_some(good)
}

/// The fault of a hole in words, and what is expected.
fn words(fault: &OutlineFault, cuts: &[Cut]) -> (String, String) {
    let expected = "a hole inside the outline, at least 0.001 mm from its rim and from every other hole";
    let found = match fault {
        OutlineFault::Meeting { rims: [0, _], .. } => "a hole that touches or crosses the rim".to_owned(),
        OutlineFault::Meeting { rims: [one, other], at, .. } if one == other => {
            return (
                format!("a rim that meets itself at {}", place(*at)),
                "a rim that does not meet itself".to_owned(),
            );
        }
        OutlineFault::Meeting { rims: [other, _], .. } => {
            format!("a hole that touches or overlaps {}", name(&cuts[other - 1]))
        }
        OutlineFault::Outside { .. } => "a hole outside the outline".to_owned(),
        OutlineFault::Nested { within, .. } => format!("a hole within {}", name(&cuts[within - 1])),
        other => return (other.found(), other.expected().to_owned()),
    };
    (found, expected.to_owned())
}

/// The table a hole is in, as `hole[3]`, or the key that drew it.
fn name(cut: &Cut) -> &str {
    let table = cut.key.rsplit_once('.').map_or(cut.key.as_str(), |(table, _)| table);
    if table.starts_with("hole") { table } else { &cut.key }
}
