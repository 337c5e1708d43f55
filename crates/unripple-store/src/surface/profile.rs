//! Quantities that vary over the surface.

use super::range::Limits;
use super::reader::{Entry, Faults};
use unripple_core::Profile;

/// Largest number of nodes of a profile: as many as 256 rows of 256.
const MOST_NODES: usize = 1 << 16;

/// A quantity over the surface: rows of numbers, the lowest first.
pub(super) fn read(entry: &Entry, limits: &Limits, faults: &mut Faults) -> Option<Profile> {
    let shape = "rows of numbers, [[…], [… ]], the lowest first, each from left to right";
    let rows: Option<Vec<Vec<Entry>>> =
        entry.items().and_then(|rows| rows.iter().map(Entry::items).collect());
    let Some(rows) = rows.filter(|rows| rows.first().is_some_and(|row| !row.is_empty())) else {
        entry.refuse(shape, None, faults);
        return None;
    };
    let nodes: usize = rows.iter().map(Vec::len).sum();
    if nodes > MOST_NODES {
        let expected = format!("at most {MOST_NODES} numbers");
        faults.add(&entry.key, entry.span.clone(), format!("{nodes} numbers"), expected, None);
        return None;
    }
    let columns = rows[0].len();
    if let Some(i) = rows.iter().position(|row| row.len() != columns) {
        let found = format!("{} numbers in row {i}", rows[i].len());
        let expected = format!("rows of equal length, so {columns} numbers as in row 0");
        faults.add(&format!("{}[{i}]", entry.key), entry.span.clone(), found, expected, None);
        return None;
    }
    let read: Vec<Vec<Option<f64>>> =
        rows.iter().map(|row| row.iter().map(|item| item.number(limits, faults)).collect()).collect();
    let rows: Option<Vec<Vec<f64>>> = read.into_iter().map(|row| row.into_iter().collect()).collect();
    Profile::new(&rows?)
}

/// As [`read`], or one number for the whole surface.
pub(super) fn read_or_number(entry: &Entry, limits: &Limits, faults: &mut Faults) -> Option<Profile> {
    if entry.is_number() {
        let value = entry.number(limits, faults)?;
        return Profile::new(&[vec![value]]);
    }
    if entry.items().is_none() {
        entry.refuse(
            format!("{}, or rows of such numbers, [[…], …], the lowest first", limits.expected()),
            None,
            faults,
        );
        return None;
    }
    read(entry, limits, faults)
}
