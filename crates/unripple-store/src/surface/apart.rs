use super::bounds::Bounds;
use super::hole::{Cut, MOST_HOLES, count_expected};
use super::meet;
use super::reader::Faults;
use unripple_core::{Shape, Side};

/// Rims are at least this far apart, in metres.
const CLEAR: f64 = 1e-6;
/// Most sides of all rims together.
const MOST_SIDES: usize = 16_384;

/// Which holes lie on the sheet and apart from each other; there is a fault for each that does not, or for what kept all
/// from being judged. Without a shape, which is at fault then, holes are compared with each other alone.
pub(super) fn check(shape: Option<&Shape>, cuts: &[Cut], faults: &mut Faults) -> Vec<bool> {
    match met(shape, cuts, faults) {
        Some((curves, met)) => judge(shape, cuts, &curves, &met, faults),
        None => vec![false; cuts.len()],
    }
}

/// The curves of the rim and the holes, and for each the first before it that it meets.
type Met = (Vec<Vec<Side>>, Vec<Option<usize>>);

fn met(shape: Option<&Shape>, cuts: &[Cut], faults: &mut Faults) -> Option<Met> {
    if cuts.is_empty() {
        return None;
    }
    if cuts.len() > MOST_HOLES {
        let last = &cuts[MOST_HOLES];
        faults.add(&last.key, last.span.clone(), format!("{} holes", cuts.len()), count_expected(), None);
        return None;
    }
    let rim = shape.map_or_else(Vec::new, Shape::sides);
    let curves: Vec<Vec<Side>> =
        std::iter::once(rim).chain(cuts.iter().map(|cut| cut.hole.sides())).collect();
    let mut sides = 0;
    for (curve, cut) in curves.iter().skip(1).zip(cuts) {
        sides += curve.len();
        if sides + curves[0].len() > MOST_SIDES {
            let expected = format!("at most {MOST_SIDES} sides of all rims together");
            faults.add(&cut.key, cut.span.clone(), "a hole past that", expected, None);
            return None;
        }
    }
    let Some(met) = meet::between(&curves, CLEAR) else {
        if let Some(cut) = cuts.last() {
            let found = "rims that lie along each other in too many places to compare";
            faults.add(&cut.key, cut.span.clone(), found, "holes apart from each other", None);
        }
        return None;
    };
    Some((curves, met))
}

fn judge(
    shape: Option<&Shape>,
    cuts: &[Cut],
    curves: &[Vec<Side>],
    met: &[Option<usize>],
    faults: &mut Faults,
) -> Vec<bool> {
    let bounds: Vec<Bounds> = curves.iter().map(|curve| Bounds::of_sides(curve)).collect();
    let mut one = |i: usize, cut: &Cut| {
        let found: Option<String> = match met[i + 1] {
            Some(0) => Some("a hole that touches or crosses the rim".into()),
            Some(other) => Some(format!("a hole that touches or overlaps {}", name(&cuts[other - 1]))),
            None => misplaced(shape, (curves, met), &bounds, i, cuts),
        };
        let Some(found) = found else { return true };
        let expected = "a hole inside the outline, at least 0.001 mm from its rim and from every other hole";
        faults.add(&cut.key, cut.span.clone(), found, expected, None);
        false
    };
    cuts.iter().enumerate().map(|(i, cut)| one(i, cut)).collect()
}

/// What is wrong with a hole that touches nothing: it is outside, or within another.
fn misplaced(
    shape: Option<&Shape>,
    (curves, met): (&[Vec<Side>], &[Option<usize>]),
    bounds: &[Bounds],
    index: usize,
    cuts: &[Cut],
) -> Option<String> {
    let start = curves[index + 1].first()?.at(0.0);
    if shape.is_some_and(|shape| !shape.contains(start)) {
        return Some("a hole outside the outline".into());
    }
    // Of two that meet, the later one is told of.
    let others = (0..cuts.len()).filter(|other| *other != index && met[other + 1] != Some(index + 1));
    let around = others.into_iter().find(|other| {
        meet::may_nest(&bounds[index + 1], &bounds[other + 1])
            && Shape::Path(curves[other + 1].clone()).contains(start)
    });
    around.map(|other| format!("a hole within {}", name(&cuts[other])))
}

/// The table a hole is in, as `hole[3]`, or the key that drew it.
fn name(cut: &Cut) -> &str {
    let table = cut.key.rsplit_once('.').map_or(cut.key.as_str(), |(table, _)| table);
    if table.starts_with("hole") { table } else { &cut.key }
}
