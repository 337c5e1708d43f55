//! Places in a surface file, and whether they lie on the sheet.

use super::bounds::Bounds;
use super::range::of;
use super::reader::{Entry, Faults, Section};
use unripple_core::plane::{Piece, from_segment, pieces};
use unripple_core::{Outline, Point, Shape, Side};

/// Step of the coordinates suggested to people, in metres. A micrometre: finer steps make longer numbers, coarser
/// ones may miss the sheet.
const STEP: f64 = 1e-6;

/// This near to a curve, in metres, a place is on it, as [`Shape::contains`] has it. Rounding of coordinates up to a
/// metre is a thousand times finer.
const ON: f64 = 1e-12;
/// Pieces of a curve this straight are not split any more, in metres. A hundredth of the distance that counts as on
/// the curve.
const STRAIGHT: f64 = 1e-14;

/// A closed curve prepared for quick tests of which points are inside.
struct Fence {
    shape: Shape,
    sides: Vec<Side>,
    bounds: Bounds,
    pieces: Vec<Piece>,
}

/// Where a place is.
#[derive(Clone, Copy, PartialEq)]
enum Where {
    Inside,
    Outside,
    On,
}

impl Fence {
    fn new(shape: Shape) -> Self {
        let sides = shape.sides();
        Self {
            bounds: Bounds::of_sides(&sides),
            pieces: sides.iter().enumerate().flat_map(|(i, side)| pieces(side, i)).collect(),
            sides,
            shape,
        }
    }

    /// Counts crossings of a ray with the chords, split until the place is not between a chord and the curve.
    fn place(&self, p: Point) -> Where {
        if !self.bounds.hold(p, ON) {
            return Where::Outside;
        }
        let mut inside = false;
        let mut left: Vec<Piece> = Vec::new();
        for piece in self.pieces.iter().filter(|piece| may_matter(piece, p)) {
            left.push(*piece);
            while let Some(piece) = left.pop() {
                let [from, to] = piece.ends;
                if from_segment(p, from, to) > piece.sagitta + ON {
                    inside ^= crosses_ray(piece.ends, p);
                } else if piece.sagitta > STRAIGHT {
                    left.extend(piece.halves(&self.sides[piece.side]));
                } else {
                    return Where::On;
                }
            }
        }
        if inside { Where::Inside } else { Where::Outside }
    }
}

/// Whether a piece may cross the ray that runs from a point to the right, or come near the point.
fn may_matter(piece: &Piece, p: Point) -> bool {
    let ([a, b], reach) = (piece.ends, piece.sagitta + ON);
    p.y <= a.y.max(b.y) + reach && p.y >= a.y.min(b.y) - reach && p.x <= a.x.max(b.x) + reach
}

/// Whether a chord crosses the ray that runs from a point to the right.
fn crosses_ray([a, b]: [Point; 2], p: Point) -> bool {
    (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)
}

/// The sheet as far as the file is without fault, to tell which places are on it.
pub(super) struct Ground {
    outline: Outline,
    rim: Fence,
    holes: Vec<Fence>,
}

impl Ground {
    /// The sheet of an outline with its holes, prepared for fast tests of points.
    pub fn new(outline: Outline) -> Self {
        let holes = outline.holes.iter().map(|hole| Fence::new(Shape::Path(hole.sides()))).collect();
        Self { rim: Fence::new(outline.shape.clone()), holes, outline }
    }

    /// Width and height of the sheet, in metres.
    pub fn extent(&self) -> (f64, f64) {
        self.outline.extent()
    }

    /// The outline with its holes.
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    fn within_rim(&self, p: Point) -> bool {
        match self.rim.place(p) {
            Where::Inside => true,
            Where::Outside => false,
            // A rectangle and round shapes are compared exactly.
            Where::On => match self.rim.shape {
                Shape::Polygon(_) | Shape::Path(_) => true,
                _ => self.rim.shape.contains(p),
            },
        }
    }

    /// The hole that a place lies in, not on the rim of.
    fn hole_at(&self, p: Point) -> Option<&Fence> {
        self.holes.iter().find(|hole| hole.place(p) == Where::Inside)
    }

    /// As [`Outline::contains`], in less time.
    fn contains(&self, p: Point) -> bool {
        self.within_rim(p) && self.hole_at(p).is_none()
    }

    /// The place `at_mm` of a table as a point in metres, or a fault if it is not on the sheet. Where `ground` is `None`, because the
    /// outline itself is faulty, every place is accepted.
    pub fn read(ground: Option<&Self>, section: &Section, faults: &mut Faults) -> Option<Point> {
        let shape = "[x, y] in mm";
        let entry = section.require("at_mm", shape, faults)?;
        let [x, y] = entry.numbers(&of::COORDINATE, shape, faults)?;
        let point = Point::new(x, y);
        match ground {
            Some(ground) if !ground.contains(point) => {
                ground.refuse(&entry, point, faults);
                None
            }
            _ => Some(point),
        }
    }

    /// Whether one of the places of an entry is on the sheet; adds a fault if not. `which` is its number among them,
    /// counted from 0. Where `ground` is `None`, because the outline itself is faulty, every place is accepted.
    pub fn accepts(
        ground: Option<&Self>,
        entry: &Entry,
        (which, point): (usize, Point),
        faults: &mut Faults,
    ) -> bool {
        let on = ground.is_none_or(|ground| ground.contains(point));
        if !on {
            let written = |v: f64| (v * 1e6).round() / 1e3 + 0.0;
            let found = format!("its place {} at [{}, {}] mm", which + 1, written(point.x), written(point.y));
            faults.add(&entry.key, entry.span.clone(), found, "places on the sheet", None);
        }
        on
    }

    fn refuse(&self, entry: &Entry, point: Point, faults: &mut Faults) {
        if faults.are_plenty() {
            entry.refuse("a point on the sheet", None, faults);
            return;
        }
        let hole = if self.within_rim(point) { self.hole_at(point) } else { None };
        let rim = hole.unwrap_or(&self.rim).shape.nearest_on_rim(point);
        let away = point.distance(rim) * 1e3;
        let expected = if hole.is_some() {
            format!("a point on the sheet: this one is in a hole, {away:.3} mm from its rim")
        } else {
            let (width, height) = self.outline.extent();
            format!(
                "a point inside the outline, which spans {:.4} x {:.4} mm and is {away:.3} mm away",
                width * 1e3,
                height * 1e3
            )
        };
        entry.refuse(expected, self.nearest_legal(rim), faults);
    }

    /// A point on the sheet with short coordinates, near a point of a rim, as a file writes it in mm.
    fn nearest_legal(&self, rim: Point) -> Option<String> {
        let around = |v: f64| {
            let base = (v / STEP).floor();
            (-1..=2).map(move |i| base + f64::from(i))
        };
        around(rim.x)
            .flat_map(|x| around(rim.y).map(move |y| (x, y)))
            .map(|(x, y)| (x / 1e3, y / 1e3))
            .map(|(x, y)| (Point::from_mm(x, y), format!("[{}, {}]", x + 0.0, y + 0.0)))
            .filter(|(point, _)| self.contains(*point))
            .min_by(|(a, _), (b, _)| a.distance(rim).total_cmp(&b.distance(rim)))
            .map(|(_, text)| text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Hole, Side};

    /// The same judgement as the outline's own, inside, outside, on rims and close to them.
    #[test]
    fn agrees_with_the_outline() {
        let p = Point::new;
        let leaf = vec![
            Side::Cubic([p(0.0, 0.05), p(0.05, -0.01), p(0.1, 0.02), p(0.15, 0.05)]),
            Side::Cubic([p(0.15, 0.05), p(0.1, 0.12), p(0.05, 0.12), p(0.0, 0.05)]),
        ];
        let shapes = [
            Shape::Rectangle { width: 0.15, height: 0.1 },
            Shape::Stadium { straight: 0.05, radius: 0.05 },
            Shape::Polygon(vec![p(0.0, 0.0), p(0.15, 0.0), p(0.12, 0.1), p(0.01, 0.09)]),
            Shape::Path(leaf),
        ];
        for shape in shapes {
            let outline = Outline::new(shape)
                .with_hole(Hole::new(&Shape::Circle { radius: 0.01 }, p(0.06, 0.04)))
                .with_hole(Hole::slit(p(0.09, 0.05), p(0.11, 0.06), 0.002));
            let rims: Vec<Side> = outline.loops().iter().flat_map(|rim| &rim.sides).map(|s| s.0).collect();
            let ground = Ground::new(outline.clone());
            let grid = (0..900).map(|i| p(f64::from(i % 30) * 0.005, f64::from(i / 30) * 0.0035));
            let near = rims.iter().flat_map(|side| {
                (0..=20).flat_map(move |i| {
                    let (on, d) = (side.at(f64::from(i) / 20.0), side.derivative(f64::from(i) / 20.0));
                    let speed = d.x.hypot(d.y);
                    [0.0, 1e-11, -1e-11, 1e-9, -1e-9, 1e-5, -1e-5]
                        .map(|by| p(on.x - by * d.y / speed, on.y + by * d.x / speed))
                })
            });
            for q in grid.chain(near) {
                assert_eq!(ground.contains(q), outline.contains(q), "{:?} {q:?}", outline.shape);
            }
        }
    }
}
