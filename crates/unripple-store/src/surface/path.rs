//! Outlines as paths of lines and curves.

use super::range::of;
use super::reader::{Entry, Faults};
use super::ring::{MOST_SIDES, Ring, is_clockwise, millimetres, off_corner};
use unripple_core::{Point, Shape, Side};

/// How far apart the ends of sides that meet may be, in metres. So a file may write millimetres with six digits
/// behind the point.
const MEET: f64 = 1e-9;
/// Least area of a path, as a share of its bounding box's longer side squared: less than that of a thin slit.
pub(super) const LEAST_AREA: f64 = 1e-9;
/// What one side of `path_mm` is expected to be, for messages.
const SIDE: &str = "a side: a line [[x, y], [x, y]], a cubic curve of four points, or an arc \
                    { centre_mm, radius_mm, start_deg, sweep_deg }";

/// The sides of `path_mm` as an outline: anticlockwise, cornered at the origin.
pub(super) fn read(entry: &Entry, faults: &mut Faults) -> Option<Shape> {
    let sides = sides(entry, faults)?;
    let clockwise = is_clockwise(&sides).then(|| {
        let expected = "sides listed anticlockwise: reverse the list and each side";
        ("sides listed clockwise".into(), expected.into())
    });
    let ring = Ring::plain(sides.clone());
    let complaint = clockwise
        .or_else(|| off_corner(&ring.bounds(), "a path", "point"))
        .or_else(|| ring.complaint("a path", LEAST_AREA));
    let Some((found, expected)) = complaint else { return Some(Shape::Path(sides)) };
    faults.add(&entry.key, entry.span.clone(), found, expected, None);
    None
}

/// The sides of `path_mm` as the file lists them, meeting end to end.
pub(super) fn sides(entry: &Entry, faults: &mut Faults) -> Option<Vec<Side>> {
    let Some(items) = entry.items().filter(|items| !items.is_empty()) else {
        entry.refuse(format!("a list, each item {SIDE}"), None, faults);
        return None;
    };
    if items.len() > MOST_SIDES {
        entry.refuse(format!("at most {MOST_SIDES} sides"), None, faults);
        return None;
    }
    let read: Vec<Option<Side>> = items.iter().map(|item| side(item, faults)).collect();
    let sides = read.into_iter().collect::<Option<Vec<Side>>>()?;
    let next = sides.iter().cycle().skip(1);
    let gap = sides.iter().zip(next).position(|(a, b)| a.at(1.0).distance(b.at(0.0)) > MEET);
    if let Some(i) = gap {
        let after = (i + 1) % sides.len();
        let [end, start] = [sides[i].at(1.0), sides[after].at(0.0)]
            .map(|p| format!("[{}, {}]", millimetres(p.x), millimetres(p.y)));
        let found = format!("side {i} that ends at {end} and side {after} that starts at {start}");
        let expected = "sides that meet end to end, the last also with the first";
        faults.add(&entry.key, items[i].span.clone(), found, expected, None);
        return None;
    }
    Some(sides)
}

fn side(item: &Entry, faults: &mut Faults) -> Option<Side> {
    if item.is_table() {
        return arc(item, faults);
    }
    let points = item.items().filter(|points| matches!(points.len(), 2 | 4));
    let Some(points) = points else {
        item.refuse(SIDE, None, faults);
        return None;
    };
    let read: Vec<Option<[f64; 2]>> =
        points.iter().map(|p| p.numbers(&of::COORDINATE, "[x, y] in mm", faults)).collect();
    let read: Option<Vec<Point>> = read.into_iter().map(|p| p.map(|[x, y]| Point::new(x, y))).collect();
    let side = match read?.as_slice() {
        [from, to] => Side::Line { from: *from, to: *to },
        [a, b, c, d] => Side::Cubic([*a, *b, *c, *d]),
        _ => return None,
    };
    if side.length() > 0.0 {
        return Some(side);
    }
    item.refuse("a side with a length", None, faults);
    None
}

fn arc(item: &Entry, faults: &mut Faults) -> Option<Side> {
    let section = item.section(faults)?;
    let keys = ["centre_mm", "radius_mm", "start_deg", "sweep_deg"];
    section.check_keys(&keys, |_| None, faults);
    let shape = "[x, y] in mm";
    let centre =
        section.require(keys[0], shape, faults).and_then(|e| e.numbers(&of::COORDINATE, shape, faults));
    let radius = section.number(keys[1], &of::ARC_RADIUS, faults);
    let start = section.number(keys[2], &of::DIRECTION, faults);
    let entry = section.require(keys[3], &of::SWEEP.expected(), faults);
    let sweep = entry.and_then(|entry| {
        let sweep = entry.number(&of::SWEEP, faults)?;
        if sweep == 0.0 {
            entry.refuse("a number other than 0: positive anticlockwise, negative clockwise", None, faults);
        }
        (sweep != 0.0).then_some(sweep)
    });
    let [x, y] = centre?;
    Some(Side::Arc { centre: Point::new(x, y), radius: radius?, start: start?, sweep: sweep? })
}
