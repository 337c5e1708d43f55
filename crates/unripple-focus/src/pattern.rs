//! Shapes to be felt, sampled into points.

use crate::FocusError;
use std::f64::consts::PI;
use unripple_core::{Point, require};

/// Largest number of points of a sampled pattern: responses are computed for each. With twice this value,
/// the largest take twice the time.
const MOST_POINTS: usize = 100_000;

/// Chords of a circle, of a degree each: within 4e-5 of its radius. With twice this value, it is right within 1e-5.
const CHORDS: usize = 360;

/// A line in the plane, open or closed, as straight segments between vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Vertices of the line, in metres.
    pub points: Vec<Point>,
    /// Whether the line returns to its first vertex.
    pub closed: bool,
}

/// A shape to be felt: lines, stroked or filled, sampled into the points of a [`Target`](crate::Target).
///
/// ```
/// use unripple_core::Point;
/// use unripple_focus::Pattern;
///
/// let disc = Pattern::circle(Point::from_mm(75.0, 75.0), 0.02).filled();
/// let pitch = Pattern::pitch(0.0146);
/// let expected = 3.14159 * 0.02 * 0.02 / (pitch * pitch);
/// assert!((disc.sample(pitch)?.len() as f64 / expected - 1.0).abs() < 0.1);
/// # Ok::<(), unripple_focus::FocusError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// The lines of the pattern, open or closed.
    pub lines: Vec<Line>,
    /// Whether the pattern is the area that the lines enclose (by the even-odd rule), rather than the lines themselves.
    pub filled: bool,
}

impl Pattern {
    /// The outline of a polygon of these vertices, in metres.
    pub fn polygon(points: Vec<Point>) -> Self {
        Self { lines: vec![Line { points, closed: true }], filled: false }
    }

    /// The outline of a circle of `centre` (m) and `radius` (m), as a polygon of 360 sides.
    pub fn circle(centre: Point, radius: f64) -> Self {
        let on_rim = |i: usize| {
            let (sin, cos) = (2.0 * PI * i as f64 / CHORDS as f64).sin_cos();
            Point::new(centre.x + radius * cos, centre.y + radius * sin)
        };
        Self::polygon((0..CHORDS).map(on_rim).collect())
    }

    /// The outline of an equilateral triangle of this side length (m), its centroid at `centre` (m), one
    /// corner up.
    pub fn triangle(centre: Point, side: f64) -> Self {
        let radius = side / 3.0_f64.sqrt();
        let corner = |i: u8| {
            let (sin, cos) = (PI / 2.0 + 2.0 * PI / 3.0 * f64::from(i)).sin_cos();
            Point::new(centre.x + radius * cos, centre.y + radius * sin)
        };
        Self::polygon((0..3).map(corner).collect())
    }

    /// The pattern with the area that its lines enclose filled.
    pub fn filled(self) -> Self {
        Self { filled: true, ..self }
    }

    /// Recommended distance between sample points, in metres, for a shortest wavelength (m): λ_min/4.
    ///
    /// Fields hold no wave shorter than λ_min, so rows of foci closer than λ_min merge without ripple where they are
    /// straight and endless; a quarter of it keeps corners, ends and curves smooth too, and more points would add nothing
    /// that the surface can carry.
    pub fn pitch(lambda_min: f64) -> f64 {
        lambda_min / 4.0
    }

    /// The pattern as points `pitch` metres apart.
    ///
    /// Lines are divided evenly between their corners, as near to the pitch as that allows. Filled patterns are a square
    /// lattice centred on their bounding box; where the mean width, 2 · area / length of line, is under one pitch, their
    /// lines are taken instead.
    ///
    /// # Errors
    /// [`FocusError::Range`] for a pitch that is not positive, for vertices that are not finite and for too many
    /// points, [`FocusError::Count`] for a pattern without vertices.
    pub fn sample(&self, pitch: f64) -> Result<Vec<Point>, FocusError> {
        require("pitch (m)", pitch.is_finite() && pitch > 0.0, "a positive number", pitch)?;
        let vertices = || self.lines.iter().flat_map(|line| &line.points);
        if let Some(bad) = vertices().find(|p| !p.is_finite()) {
            let found = if bad.x.is_finite() { bad.y } else { bad.x };
            require("vertex of a pattern (m)", false, "a finite number", found)?;
        }
        if vertices().next().is_none() {
            return Err(FocusError::Count {
                what: "vertices of a pattern",
                expected: "at least 1".to_owned(),
                found: 0,
            });
        }
        let length: f64 = self.sides().map(|(a, b)| a.distance(b)).sum();
        if self.filled {
            let lattice = self.lattice(pitch)?;
            if 2.0 * lattice.len() as f64 * pitch > length {
                return Ok(lattice);
            }
        }
        within_bounds(length / pitch)?;
        let mut points: Vec<Point> = self.lines.iter().flat_map(|line| stroke(line, pitch)).collect();
        // Points that neighbouring lines share come once.
        points.dedup_by(|a, b| a.distance(*b) < 1e-9 * pitch);
        Ok(points)
    }

    /// Every side, lines closed as they must be for filling.
    fn sides(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        self.lines.iter().flat_map(move |line| {
            let last = if line.closed || self.filled {
                line.points.len()
            } else {
                line.points.len().saturating_sub(1)
            };
            let next = line.points.iter().cycle().skip(1);
            line.points.iter().zip(next).take(last).map(|(a, b)| (*a, *b))
        })
    }

    /// The points of a square lattice that the lines enclose.
    fn lattice(&self, pitch: f64) -> Result<Vec<Point>, FocusError> {
        let bound = |pick: fn(f64, f64) -> f64, start: f64, of: fn(&Point) -> f64| {
            self.lines.iter().flat_map(|line| &line.points).map(of).fold(start, pick)
        };
        let low = Point::new(bound(f64::min, f64::MAX, |p| p.x), bound(f64::min, f64::MAX, |p| p.y));
        let high = Point::new(bound(f64::max, f64::MIN, |p| p.x), bound(f64::max, f64::MIN, |p| p.y));
        let cells = |width: f64| (width / pitch).ceil().max(1.0);
        let (columns, rows) = (cells(high.x - low.x), cells(high.y - low.y));
        within_bounds(columns)?;
        within_bounds(rows)?;
        within_bounds(columns * rows / 10.0)?;
        let place = |middle: f64, count: f64, i: usize| middle + (i as f64 - (count - 1.0) / 2.0) * pitch;
        let mut points = Vec::new();
        for row in 0..rows as usize {
            let y = place((low.y + high.y) / 2.0, rows, row);
            let crossings = self.crossings(y);
            for column in 0..columns as usize {
                let x = place((low.x + high.x) / 2.0, columns, column);
                if crossings.iter().filter(|c| **c > x).count() % 2 == 1 {
                    points.push(Point::new(x, y));
                }
            }
        }
        within_bounds(points.len() as f64)?;
        Ok(points)
    }

    /// Where sides cross the horizontal through `y`.
    fn crossings(&self, y: f64) -> Vec<f64> {
        self.sides()
            .filter(|(a, b)| (a.y > y) != (b.y > y))
            .map(|(a, b)| a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y))
            .collect()
    }
}

fn within_bounds(found: f64) -> Result<(), FocusError> {
    let expected = format!("at most {MOST_POINTS}, by a larger pitch or a smaller pattern");
    Ok(require("points of a pattern", found <= MOST_POINTS as f64, expected, found)?)
}

/// Points along a line: equal steps between each two corners, with the corners and ends included.
fn stroke(line: &Line, pitch: f64) -> Vec<Point> {
    let mut path = line.points.clone();
    path.dedup();
    if line.closed && path.len() > 1 && path.first() != path.last() {
        path.push(path[0]);
    }
    if path.len() < 2 {
        return path;
    }
    let mut points = Vec::new();
    let mut start = 0;
    for end in 1..path.len() {
        if end + 1 == path.len() || is_corner(path[end - 1], path[end], path[end + 1]) {
            divide(&path[start..=end], pitch, &mut points);
            start = end;
        }
    }
    if !line.closed || points.is_empty() {
        points.push(path[path.len() - 1]);
    }
    points
}

/// Whether a path turns by more than 30 degrees.
fn is_corner(a: Point, b: Point, c: Point) -> bool {
    let along = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
    along < (PI / 6.0).cos() * a.distance(b) * b.distance(c)
}

/// Appends points at equal distances along a run, including its start but not its end.
fn divide(run: &[Point], pitch: f64, points: &mut Vec<Point>) {
    let length: f64 = run.windows(2).map(|side| side[0].distance(side[1])).sum();
    let steps = (length / pitch).round().max(1.0);
    let (mut done, mut next) = (0.0, 0.0);
    for side in run.windows(2) {
        let own = side[0].distance(side[1]);
        while next < steps && next * length / steps < done + own {
            let share = (next * length / steps - done) / own;
            points.push(Point::new(
                side[0].x + share * (side[1].x - side[0].x),
                side[0].y + share * (side[1].y - side[0].y),
            ));
            next += 1.0;
        }
        done += own;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spacing(points: &[Point]) -> (f64, f64) {
        let near = |i: usize| {
            let others = points.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, p)| p.distance(points[i])).fold(f64::MAX, f64::min)
        };
        (0..points.len()).map(near).fold((f64::MAX, 0.0), |(l, h), d| (d.min(l), d.max(h)))
    }

    #[test]
    fn filled_patterns_hold_area_over_pitch_squared() {
        let centre = Point::new(0.07, 0.05);
        let pitch = 1e-3;
        let side: f64 = 0.04;
        for (pattern, area) in [
            (Pattern::triangle(centre, side), side * side * 3.0_f64.sqrt() / 4.0),
            (Pattern::circle(centre, 0.02), PI * 4e-4),
        ] {
            let points = pattern.filled().sample(pitch).unwrap();
            assert!((points.len() as f64 * pitch * pitch / area - 1.0).abs() < 0.03, "{}", points.len());
            let (least, most) = spacing(&points);
            assert!((least - pitch).abs() < 1e-12 && (most - pitch).abs() < 1e-12);
            let x = points.iter().map(|p| p.x).sum::<f64>() / points.len() as f64;
            let y = points.iter().map(|p| p.y).sum::<f64>() / points.len() as f64;
            assert!(Point::new(x, y).distance(centre) < pitch / 2.0, "{x} {y}");
        }
    }

    #[test]
    fn holes_are_left_out() {
        let centre = Point::new(0.05, 0.05);
        let mut ring = Pattern::circle(centre, 0.02);
        ring.lines.extend(Pattern::circle(centre, 0.01).lines);
        let points = ring.filled().sample(1e-3).unwrap();
        assert!(points.iter().all(|p| (0.0099..0.0201).contains(&p.distance(centre))));
        assert!((points.len() as f64 * 1e-6 / (PI * 3e-4) - 1.0).abs() < 0.03);
    }

    #[test]
    fn strokes_are_even_and_keep_corners() {
        let triangle = Pattern::triangle(Point::new(0.05, 0.05), 0.03);
        let points = triangle.sample(3.64e-3).unwrap();
        assert_eq!(points.len(), 24);
        for corner in &triangle.lines[0].points {
            assert!(points.iter().any(|p| p.distance(*corner) < 1e-12));
        }
        let (least, most) = spacing(&points);
        assert!((least - 0.03 / 8.0).abs() < 1e-9 && (most - 0.03 / 8.0).abs() < 1e-9);
        let circle = Pattern::circle(Point::new(0.05, 0.05), 0.02).sample(3.64e-3).unwrap();
        assert_eq!(circle.len(), (2.0 * PI * 0.02 / 3.64e-3_f64).round() as usize);
        let (least, most) = spacing(&circle);
        assert!(most - least < 1e-5, "{least} {most}");
    }

    #[test]
    fn open_lines_have_both_ends_and_dots_are_one_point() {
        let ends = [Point::new(0.0, 0.0), Point::new(0.01, 0.0)];
        let line = Line { points: ends.to_vec(), closed: false };
        let points = Pattern { lines: vec![line], filled: false }.sample(2e-3).unwrap();
        assert_eq!(points.len(), 6);
        assert_eq!((points[0], points[5]), (ends[0], ends[1]));
        let dot = Pattern::polygon(vec![ends[1]; 3]).sample(1e-3).unwrap();
        assert_eq!(dot, [ends[1]]);
    }

    #[test]
    fn what_is_too_thin_to_fill_is_stroked() {
        let sliver = Pattern::polygon(vec![
            Point::new(0.0, 0.0),
            Point::new(0.02, 0.0),
            Point::new(0.02, 1e-4),
            Point::new(0.0, 1e-4),
        ]);
        let points = sliver.clone().filled().sample(1e-3).unwrap();
        assert_eq!(points, sliver.sample(1e-3).unwrap());
    }

    #[test]
    fn refuses_what_cannot_be_sampled() {
        let circle = Pattern::circle(Point::new(0.05, 0.05), 0.02);
        for pitch in [0.0, -1.0, f64::NAN, 1e-9] {
            assert!(circle.sample(pitch).is_err(), "{pitch}");
            assert!(circle.clone().filled().sample(pitch).is_err(), "{pitch}");
        }
        assert!(Pattern { lines: vec![], filled: true }.sample(1e-3).is_err());
        assert!(Pattern::circle(Point::new(f64::NAN, 0.0), 1.0).sample(1e-3).is_err());
    }
}
