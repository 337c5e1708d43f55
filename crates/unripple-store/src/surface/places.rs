//! Where the actuators of one table are: at a point, in a row, round a ring, on a grid.

use super::place::Ground;
use super::range::of;
use super::reader::{Entry, Faults, Section};
use std::f64::consts::TAU;
use unripple_core::Point;

/// Largest number of actuators of a surface: a bound on what a small file may cost. The model's memory grows with their number.
pub(super) const MOST_ACTUATORS: usize = 4096;

/// The keys that say where actuators are.
pub(super) const PLACE_KEYS: [&str; 5] = ["at_mm", "row_mm", "ring", "grid_mm", "count"];

/// The keys of which a table has exactly one.
const WAYS: [&str; 4] = ["at_mm", "row_mm", "ring", "grid_mm"];

/// Keys of the table `ring`: where it is, how large, and from where to where it goes.
const RING_KEYS: [&str; 4] = ["centre_mm", "radius_mm", "start_deg", "sweep_deg"];

/// A sweep this near to a full turn, in radians, is one: degrees become radians by rounding.
const TURN: f64 = 1e-9;

/// The places that a table stands for.
pub(super) struct Places {
    /// Places in metres, in the order of the channels.
    pub at: Vec<Point>,
    several: bool,
}

impl Places {
    /// Whether the table describes a row, a ring or a grid of places, even one with a single place.
    pub fn are_several(&self) -> bool {
        self.several
    }
}

/// The places of a table, all of them on the sheet. Where `ground` is `None`, because the outline itself is faulty, every place is
/// accepted.
pub(super) fn read(section: &Section, ground: Option<&Ground>, faults: &mut Faults) -> Option<Places> {
    let given: Vec<(&str, Entry)> = WAYS.iter().filter_map(|key| Some((*key, section.get(key)?))).collect();
    if let [(first, _), (second, entry), ..] = given.as_slice() {
        let expected = format!("exactly one of {}", WAYS.join(", "));
        faults.add(&entry.key, entry.span.clone(), format!("{first} and {second}"), expected, None);
        return None;
    }
    let Some((way, entry)) = given.into_iter().next().filter(|(way, _)| *way != "at_mm") else {
        if let Some(count) = section.get("count") {
            count.refuse("this key only beside row_mm, ring or grid_mm", None, faults);
        }
        return Ground::read(ground, section, faults).map(|at| Places { at: vec![at], several: false });
    };
    let at = match way {
        "row_mm" => row(section, &entry, faults),
        "ring" => ring(section, &entry, faults),
        _ => grid(section, &entry, faults),
    }?;
    let on: Vec<bool> = at
        .iter()
        .enumerate()
        .map(|(i, place)| Ground::accepts(ground, &entry, (i, *place), faults))
        .collect();
    on.into_iter().all(|on| on).then_some(Places { at, several: true })
}

/// From the first end to the second, both included, evenly.
fn row(section: &Section, entry: &Entry, faults: &mut Faults) -> Option<Vec<Point>> {
    let ends = ends(entry, faults);
    let count = count(section, 2, faults);
    let ([from, to], count) = (ends?, count?);
    Some((0..count).map(|i| between(from, to, share(i, count))).collect())
}

/// Round a centre, evenly: a full turn without its end, which is its beginning, or from one end of an arc to the other.
fn ring(section: &Section, entry: &Entry, faults: &mut Faults) -> Option<Vec<Point>> {
    let count = count(section, 1, faults);
    let ring = entry.section(faults)?;
    ring.check_keys(&RING_KEYS, |_| None, faults);
    let shape = "[x, y] in mm";
    let centre = ring
        .require(RING_KEYS[0], shape, faults)
        .and_then(|entry| entry.numbers::<2>(&of::COORDINATE, shape, faults));
    let radius = ring.number(RING_KEYS[1], &of::ARC_RADIUS, faults);
    let start = ring.number_or(RING_KEYS[2], 0.0, &of::DIRECTION, faults);
    let sweep = ring.number_or(RING_KEYS[3], TAU, &of::SWEEP, faults);
    let (count, [x, y], radius, start, sweep) = (count?, centre?, radius?, start?, sweep?);
    let whole = (sweep.abs() - TAU).abs() < TURN;
    let angle = |i: usize| {
        let share = if whole { i as f64 / count as f64 } else { share(i, count) };
        start + sweep * share
    };
    let at = |angle: f64| Point::new(x + radius * angle.cos(), y + radius * angle.sin());
    Some((0..count).map(|i| at(angle(i))).collect())
}

/// Between opposite corners, both included: the row of the first corner first, each row from that corner's side on.
fn grid(section: &Section, entry: &Entry, faults: &mut Faults) -> Option<Vec<Point>> {
    let ends = ends(entry, faults);
    let shape = "two whole numbers, [along x, along y]";
    let counts = section.require("count", shape, faults).and_then(|entry| {
        let Some([x, y]) = entry.items().and_then(|items| <[Entry; 2]>::try_from(items).ok()) else {
            entry.refuse(shape, None, faults);
            return None;
        };
        let (x, y) = (x.count(1, MOST_ACTUATORS, faults), y.count(1, MOST_ACTUATORS, faults));
        x.zip(y).filter(|(x, y)| {
            let few = x * y <= MOST_ACTUATORS;
            if !few {
                entry.refuse(format!("at most {MOST_ACTUATORS} places in all"), None, faults);
            }
            few
        })
    });
    let ([from, to], (columns, rows)) = (ends?, counts?);
    let at = |i: usize, j: usize| {
        let (x, y) = (between(from, to, share(i, columns)).x, between(from, to, share(j, rows)).y);
        Point::new(x, y)
    };
    Some((0..rows).flat_map(|j| (0..columns).map(move |i| at(i, j))).collect())
}

/// How many places a table stands for.
fn count(section: &Section, least: usize, faults: &mut Faults) -> Option<usize> {
    let expected = format!("a whole number from {least} to {MOST_ACTUATORS}");
    section.require("count", &expected, faults)?.count(least, MOST_ACTUATORS, faults)
}

/// Two points.
fn ends(entry: &Entry, faults: &mut Faults) -> Option<[Point; 2]> {
    let shape = "[[x, y], [x, y]] in mm";
    let Some(items) = entry.items().and_then(|items| <[Entry; 2]>::try_from(items).ok()) else {
        entry.refuse(shape, None, faults);
        return None;
    };
    let [from, to] = items.map(|item| {
        item.numbers::<2>(&of::COORDINATE, "[x, y] in mm", faults).map(|[x, y]| Point::new(x, y))
    });
    Some([from?, to?])
}

/// Which share of the way place `i` of `count` has gone; a single one stays at the beginning.
fn share(i: usize, count: usize) -> f64 {
    i as f64 / count.saturating_sub(1).max(1) as f64
}

/// A point on the way from one to another, which both are met to the last bit.
fn between(from: Point, to: Point, share: f64) -> Point {
    let mixed = |a: f64, b: f64| a * (1.0 - share) + b * share;
    Point::new(mixed(from.x, to.x), mixed(from.y, to.y))
}
