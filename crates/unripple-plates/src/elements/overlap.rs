//! The parts of a triangle that lie under discs and outside them, bounded by pieces of the triangle's edges
//! and of the discs' rims.

use super::border::Border;
use super::element::Element;
use super::grid::bounds;
use crate::fabric::Disc;
use std::f64::consts::TAU;
use unripple_core::{Point, Side};

/// Number of pieces of a curved edge each of which is searched for a crossing with a disc's rim. Two
/// crossings within one piece are missed; with twice as many, pieces are half as long.
const PIECES: usize = 24;

/// The boundary, anticlockwise, of the part of a triangle under a disc; empty if the disc does not overlap
/// the triangle.
pub(crate) fn overlap(element: &Element, disc: &Disc) -> Vec<Border> {
    if !is_near(element, disc) {
        return Vec::new();
    }
    let mut kept = Vec::new();
    for border in &element.borders {
        let pieces = cut(border, crossings(border, disc));
        kept.extend(pieces.into_iter().filter(|piece| piece.at(0.5).distance(disc.at) < disc.radius));
    }
    kept.extend(arcs(element, disc));
    kept
}

/// The boundary of the part of a triangle that lies under none of the given discs, which do not touch each
/// other.
pub(crate) fn uncovered(element: &Element, discs: &[&Disc]) -> Vec<Border> {
    let mut kept = Vec::new();
    for border in &element.borders {
        let mut cuts: Vec<f64> = discs.iter().flat_map(|disc| crossings(border, disc)).collect();
        cuts.sort_by(f64::total_cmp);
        let outside =
            |piece: &Border| discs.iter().all(|disc| piece.at(0.5).distance(disc.at) >= disc.radius);
        kept.extend(cut(border, cuts).into_iter().filter(outside));
    }
    for arc in discs.iter().flat_map(|disc| arcs(element, disc)) {
        kept.push(Border { from: arc.to, to: arc.from, ..arc });
    }
    kept
}

/// Whether a disc's rim passes through a triangle.
pub(crate) fn crosses(element: &Element, disc: &Disc) -> bool {
    is_near(element, disc) && !arcs(element, disc).is_empty()
}

/// Whether a disc reaches the bounding box of a triangle.
fn is_near(element: &Element, disc: &Disc) -> bool {
    let [low, high] = bounds(element);
    let nearest = Point::new(disc.at.x.clamp(low.x, high.x), disc.at.y.clamp(low.y, high.y));
    nearest.distance(disc.at) <= disc.radius
}

/// The pieces of a border that result from cutting it at the given parameters.
fn cut(border: &Border, mut cuts: Vec<f64>) -> Vec<Border> {
    cuts.insert(0, 0.0);
    cuts.push(1.0);
    cuts.windows(2).map(|w| border.piece(w[0], w[1])).collect()
}

/// The arcs of a disc's rim within a triangle, anticlockwise around the disc.
fn arcs(element: &Element, disc: &Disc) -> Vec<Border> {
    let at_cut = |(border, s): (&Border, f64)| {
        let p = border.at(s);
        (p.y - disc.at.y).atan2(p.x - disc.at.x)
    };
    let cuts = |border| crossings(border, disc).into_iter().map(move |s| (border, s));
    let mut angles: Vec<f64> = element.borders.iter().flat_map(cuts).map(at_cut).collect();
    angles.sort_by(f64::total_cmp);
    let first = angles.first().copied().unwrap_or(0.0);
    let ends = angles.iter().skip(1).copied().chain([first + TAU]);
    let starts = angles.iter().copied().chain(angles.is_empty().then_some(0.0));
    let whole = starts.zip(ends).map(|(start, end)| {
        let side = Side::Arc { centre: disc.at, radius: disc.radius, start, sweep: end - start };
        Border { side, from: 0.0, to: 1.0, held: None }
    });
    whole.filter(|arc| element.depth(arc.at(0.5)) > 0.0).collect()
}

/// Parameters at which a border crosses a disc's rim, ascending.
fn crossings(border: &Border, disc: &Disc) -> Vec<f64> {
    let outside = |s: f64| border.at(s).distance(disc.at) - disc.radius;
    // On a straight edge the distance is least at the foot of the centre, with at most one crossing on each side of it.
    let mut places: Vec<f64> = if border.is_straight() {
        let (p, d) = (border.at(0.0), border.derivative(0.0));
        let foot = ((disc.at.x - p.x) * d.x + (disc.at.y - p.y) * d.y) / (d.x * d.x + d.y * d.y);
        vec![0.0, foot.clamp(0.0, 1.0), 1.0]
    } else {
        (0..=PIECES).map(|i| i as f64 / PIECES as f64).collect()
    };
    places.dedup();
    let crossed = places.windows(2).filter(|w| (outside(w[0]) < 0.0) != (outside(w[1]) < 0.0));
    crossed.map(|w| root(w[0], w[1], outside)).collect()
}

/// The argument at which a function changes its sign, by bisection to the last bits.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let sign = f(low) < 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == sign {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
