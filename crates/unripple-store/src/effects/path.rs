//! Places in files of effects.

use super::range;
use crate::surface::reader::{Entry, Faults};
use unripple_core::Point;

/// `[x, y]` in mm.
pub(super) fn place(entry: &Entry, faults: &mut Faults) -> Option<Point> {
    entry.numbers(&range::PLACE, "[x, y] in mm", faults).map(|[x, y]| Point::new(x, y))
}

/// `[[x, y], …]` in mm.
pub(super) fn corners(entry: &Entry, least: usize, most: usize, faults: &mut Faults) -> Option<Vec<Point>> {
    let Some(items) = entry.items().filter(|items| (least..=most).contains(&items.len())) else {
        entry.refuse(format!("{least} to {most} corners, [[x, y], …] in mm"), None, faults);
        return None;
    };
    let read: Vec<Option<Point>> = items.iter().map(|item| place(item, faults)).collect();
    read.into_iter().collect()
}
