//! Outlines as polygons.

use super::bounds::Bounds;
use super::range::of;
use super::reader::{Entry, Faults};
use super::ring::{Complaint, MOST_SIDES, Ring, is_clockwise, off_corner};
use unripple_core::{Point, Shape, Side};

/// Least area of a polygon, as a share of its bounding box's longer side squared.
const LEAST_AREA: f64 = 1e-6;

/// The vertices of `polygon_mm` as an outline: anticlockwise, cornered at the origin.
pub(super) fn read(entry: &Entry, faults: &mut Faults) -> Option<Vec<Point>> {
    let vertices = vertices(entry, faults)?;
    let complaint = sides_complaint(&vertices)
        .or_else(|| {
            let clockwise = is_clockwise(&lines(&vertices));
            clockwise.then(|| {
                ("vertices listed clockwise".into(), "vertices listed anticlockwise: reverse the list".into())
            })
        })
        .or_else(|| off_corner(&Bounds::of_points(&vertices), "a polygon", "vertex"))
        .or_else(|| Ring::plain(lines(&vertices)).crossing("a polygon"));
    let Some((found, expected)) = complaint else { return Some(vertices) };
    faults.add(&entry.key, entry.span.clone(), found, expected, None);
    None
}

/// The vertices of `polygon_mm` as a hole: either way round, anywhere.
pub(super) fn ring(entry: &Entry, faults: &mut Faults) -> Option<Ring> {
    let vertices = vertices(entry, faults)?;
    if let Some((found, expected)) = sides_complaint(&vertices) {
        faults.add(&entry.key, entry.span.clone(), found, expected, None);
        return None;
    }
    Some(Ring::plain(lines(&vertices)))
}

fn vertices(entry: &Entry, faults: &mut Faults) -> Option<Vec<Point>> {
    let Some(items) = entry.items() else {
        entry.refuse("a list of vertices, [[x, y], …] in mm", None, faults);
        return None;
    };
    if items.len() > MOST_SIDES {
        entry.refuse(format!("at most {MOST_SIDES} vertices"), None, faults);
        return None;
    }
    let read: Vec<Option<[f64; 2]>> =
        items.iter().map(|item| item.numbers(&of::COORDINATE, "[x, y] in mm", faults)).collect();
    read.into_iter().map(|v| v.map(|[x, y]| Point::new(x, y))).collect()
}

fn lines(vertices: &[Point]) -> Vec<Side> {
    Shape::Polygon(vertices.to_vec()).sides()
}

/// What is wrong with the vertices whichever way they run, if anything: too few, repeated, or without area.
fn sides_complaint(vertices: &[Point]) -> Option<Complaint> {
    if vertices.len() < 3 {
        return Some((format!("{} vertices", vertices.len()), "at least 3 vertices".into()));
    }
    let next = |i: usize| vertices[(i + 1) % vertices.len()];
    if let Some(i) = (0..vertices.len()).find(|&i| vertices[i] == next(i)) {
        let after = (i + 1) % vertices.len();
        return Some((
            format!("vertices {i} and {after} in the same place"),
            "different vertices: the last side back to the first vertex is drawn by itself".into(),
        ));
    }
    let bounds = Bounds::of_points(vertices);
    let (least, size) = (bounds.least, bounds.size());
    let doubled: f64 = (0..vertices.len())
        .map(|i| {
            let (a, b) = (vertices[i], next(i));
            (a.x - least.x) * (b.y - least.y) - (b.x - least.x) * (a.y - least.y)
        })
        .sum();
    (doubled.abs() / 2.0 < LEAST_AREA * size * size)
        .then(|| ("a polygon without area".into(), "a polygon that encloses something".into()))
}
