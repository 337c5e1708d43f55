//! Regions in files of effects.

use super::path::{corners, place};
use super::range;
use crate::surface::reader::{Faults, Section};
use unripple_core::Point;
use unripple_effects::{Region, limits};

/// Keys of a region: exactly one shape is given by them.
const KEYS: [&str; 5] = ["rectangle_mm", "at_mm", "circle_mm", "centre_mm", "polygon_mm"];

/// A table with one shape.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Region> {
    section.check_keys(&KEYS, |_| None, faults);
    let shapes = [KEYS[0], KEYS[2], KEYS[4]].map(|key| section.get(key));
    let [rectangle, circle, polygon] = match shapes.iter().flatten().count() {
        1 => shapes,
        count => {
            let found = if count == 0 { "no shape" } else { "several shapes" };
            let expected = "exactly one of rectangle_mm, circle_mm, polygon_mm";
            faults.add(&section.key, section.span.clone(), found, expected, None);
            return None;
        }
    };
    let only = |key: &str, of: &str, is_of: bool, faults: &mut Faults| {
        if let Some(entry) = section.get(key).filter(|_| !is_of) {
            entry.refuse(format!("this key only beside {of}"), None, faults);
        }
    };
    only("at_mm", "rectangle_mm", rectangle.is_some(), faults);
    only("centre_mm", "circle_mm", circle.is_some(), faults);
    if let Some(entry) = rectangle {
        let size = entry.numbers::<2>(&range::LENGTH, "[width, height] in mm", faults);
        let corner = required(section, "at_mm", faults);
        let [width, height] = size?;
        return Some(Region::Rectangle { corner: corner?, width, height });
    }
    if let Some(entry) = circle {
        let radius = entry.number(&range::LENGTH, faults);
        let centre = required(section, "centre_mm", faults);
        return Some(Region::Circle { centre: centre?, radius: radius? });
    }
    corners(&polygon?, 3, limits::MOST_CORNERS, faults).map(Region::Polygon)
}

fn required(section: &Section, key: &str, faults: &mut Faults) -> Option<Point> {
    place(&section.require(key, "[x, y] in mm", faults)?, faults)
}
