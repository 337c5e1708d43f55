use super::range::of;
use super::reader::{Entry, Faults};
use crate::decimal;
use unripple_core::Point;

/// Most vertices of an outline: what crosses itself is looked for side by side.
const MOST_VERTICES: usize = 4096;
/// How far from the origin the corner of the bounding box may lie, in metres.
const CORNER: f64 = 1e-9;
/// Least area of an outline, as a share of its bounding box's longer side squared.
const LEAST_AREA: f64 = 1e-6;

/// The vertices of `polygon_mm`.
pub(super) fn read(entry: &Entry, faults: &mut Faults) -> Option<Vec<Point>> {
    let Some(items) = entry.items() else {
        entry.refuse("a list of vertices, [[x, y], …] in mm", None, faults);
        return None;
    };
    if items.len() > MOST_VERTICES {
        entry.refuse(format!("at most {MOST_VERTICES} vertices"), None, faults);
        return None;
    }
    let read: Vec<Option<[f64; 2]>> =
        items.iter().map(|item| item.numbers(&of::COORDINATE, "[x, y] in mm", faults)).collect();
    let vertices: Option<Vec<Point>> = read.into_iter().map(|v| v.map(|[x, y]| Point::new(x, y))).collect();
    check(entry, vertices?, faults)
}

/// The same vertices, if they make a simple anticlockwise polygon cornered at the origin.
pub(super) fn check(entry: &Entry, vertices: Vec<Point>, faults: &mut Faults) -> Option<Vec<Point>> {
    let complaint = if vertices.len() < 3 {
        Some((format!("{} vertices", vertices.len()), "at least 3 vertices".into()))
    } else if vertices.len() > MOST_VERTICES {
        Some((format!("{} vertices", vertices.len()), format!("at most {MOST_VERTICES} vertices")))
    } else {
        shapeless(&vertices).or_else(|| off_corner(&vertices)).or_else(|| crossing(&vertices))
    };
    let Some((found, expected)) = complaint else { return Some(vertices) };
    faults.add(&entry.key, entry.span.clone(), found, expected, None);
    None
}

/// What is wrong with the area, if anything: none of it, repeated vertices, or the wrong way round.
fn shapeless(vertices: &[Point]) -> Option<(String, String)> {
    let next = |i: usize| vertices[(i + 1) % vertices.len()];
    if let Some(i) = (0..vertices.len()).find(|&i| vertices[i] == next(i)) {
        let after = (i + 1) % vertices.len();
        return Some((
            format!("vertices {i} and {after} in the same place"),
            "different vertices: the last side back to the first vertex is drawn by itself".into(),
        ));
    }
    let (least, greatest) = bounds(vertices);
    let size = (greatest.x - least.x).max(greatest.y - least.y);
    let area = (0..vertices.len())
        .map(|i| {
            let (a, b) = (vertices[i], next(i));
            (a.x - least.x) * (b.y - least.y) - (b.x - least.x) * (a.y - least.y)
        })
        .sum::<f64>()
        / 2.0;
    if area.abs() < LEAST_AREA * size * size {
        return Some(("a polygon without area".into(), "a polygon that encloses something".into()));
    }
    (area < 0.0).then(|| {
        ("vertices listed clockwise".into(), "vertices listed anticlockwise: reverse the list".into())
    })
}

/// What is wrong with the place, if anything.
fn off_corner(vertices: &[Point]) -> Option<(String, String)> {
    let (corner, _) = bounds(vertices);
    let (x, y) = (millimetres(corner.x), millimetres(corner.y));
    (corner.x.abs() > CORNER || corner.y.abs() > CORNER).then(|| {
        let expected = "a polygon whose bounding box starts at [0, 0]: take that much from every vertex";
        (format!("a polygon whose bounding box starts at [{x}, {y}] mm"), expected.into())
    })
}

fn millimetres(metres: f64) -> String {
    decimal::text((metres * 1e9).round() / 1e6, 0)
}

fn bounds(vertices: &[Point]) -> (Point, Point) {
    let start = (Point::new(f64::MAX, f64::MAX), Point::new(f64::MIN, f64::MIN));
    vertices.iter().fold(start, |(least, greatest), p| {
        (Point::new(least.x.min(p.x), least.y.min(p.y)), Point::new(greatest.x.max(p.x), greatest.y.max(p.y)))
    })
}

/// The first pair of sides that meet where they should not.
fn crossing(vertices: &[Point]) -> Option<(String, String)> {
    let count = vertices.len();
    let side = |i: usize| (vertices[i], vertices[(i + 1) % count]);
    for i in 0..count {
        for j in i + 1..count {
            let meet = if j == i + 1 {
                folds_back(side(i).0, side(i).1, side(j).1)
            } else if (j + 1) % count == i {
                folds_back(side(j).0, side(j).1, side(i).1)
            } else {
                touch(side(i), side(j))
            };
            if meet {
                return Some((
                    format!("sides {i} and {j} that cross or touch"),
                    "a polygon that does not meet itself".into(),
                ));
            }
        }
    }
    None
}

/// Twice the signed area of a triangle; positive when anticlockwise.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Whether the side from `b` to `c` runs back over the side from `a` to `b`.
fn folds_back(a: Point, b: Point, c: Point) -> bool {
    let dot = (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y);
    turn(a, b, c).abs() <= 1e-12 * a.distance(b) * b.distance(c) && dot > 0.0
}

fn touch((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let apart = |p: f64, q: f64, r: f64, s: f64| p.max(q) < r.min(s) || r.max(s) < p.min(q);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let split = |p: f64, q: f64| (p <= 0.0 && q >= 0.0) || (p >= 0.0 && q <= 0.0);
    split(turn(a, b, c), turn(a, b, d)) && split(turn(c, d, a), turn(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[(f64, f64)]) -> Vec<Point> {
        points.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn sees_crossings_and_spikes() {
        let bow = polygon(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.5)]);
        assert!(crossing(&bow).is_some());
        let spike = polygon(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.0), (0.5, 1.0)]);
        assert!(crossing(&spike).is_some());
        let notch = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.2), (0.0, 1.0)]);
        assert!(crossing(&notch).is_none());
        let pinched = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.0), (0.0, 1.0)]);
        assert!(crossing(&pinched).is_some());
    }
}
