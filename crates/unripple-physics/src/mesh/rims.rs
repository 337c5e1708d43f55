use super::piece::{Piece, pieces};
use super::tree::{Bounds, Node, Tree};
use super::vector::{along, angle, cross, minus, norm};
use crate::PhysicsError;
use std::f64::consts::PI;
use std::ops::Range;
use unripple_core::{Edge, Outline, Point, Side};

/// How far apart sides may end and start that are to meet, as a share of the extent.
const OPEN: f64 = 1e-9;

/// All rims of an outline: closed, apart from each other, the sheet to their left.
#[derive(Clone, Debug)]
pub(super) struct Rims {
    /// All sides and how they are held, rim by rim.
    pub(super) sides: Vec<(Side, Edge)>,
    /// The sides of each rim, the outer one first.
    pub(super) loops: Vec<Range<usize>>,
    /// The angle of the sheet where each side starts, 0 to 2π.
    pub(super) angles: Vec<f64>,
    /// The sides cut into pieces.
    pub(super) pieces: Vec<Piece>,
    /// The boxes of the pieces.
    pub(super) tree: Tree,
    /// The longer side of the bounding box, in metres.
    pub(super) extent: f64,
}

impl Rims {
    /// The rims of an outline.
    ///
    /// # Errors
    /// [`PhysicsError::Outline`] if they do not bound a sheet.
    pub(super) fn new(outline: &Outline) -> Result<Self, PhysicsError> {
        let (mut sides, mut loops) = (Vec::new(), Vec::new());
        for rim in outline.loops() {
            loops.push(sides.len()..sides.len() + rim.sides.len());
            sides.extend(rim.sides);
        }
        check_sides(&sides, &loops)?;
        let pieces: Vec<Piece> =
            sides.iter().enumerate().flat_map(|(i, (side, _))| pieces(side, i)).collect();
        let boxes: Vec<(Bounds, f64)> = pieces.iter().map(|piece| (piece.bounds(0.0), 0.0)).collect();
        let all = pieces.iter().flat_map(|piece| piece.ends).collect::<Vec<_>>();
        let bounds = Bounds::around(&all, 0.0);
        let extent = (bounds.high.x - bounds.low.x).max(bounds.high.y - bounds.low.y);
        let tree = Tree::new(&boxes);
        let mut rims = Self { sides, loops, angles: Vec::new(), pieces, tree, extent };
        rims.angles = (0..rims.sides.len()).map(|i| rims.angle(i)).collect();
        rims.check_closed()?;
        super::check::check(&rims)?;
        Ok(rims)
    }

    fn rim_of(&self, side: usize) -> Range<usize> {
        self.loops.iter().find(|rim| rim.contains(&side)).cloned().unwrap_or(0..0)
    }

    /// The side that follows on the same rim.
    pub(super) fn next(&self, side: usize) -> usize {
        let rim = self.rim_of(side);
        if side + 1 < rim.end { side + 1 } else { rim.start }
    }

    /// The side before on the same rim.
    pub(super) fn previous(&self, side: usize) -> usize {
        let rim = self.rim_of(side);
        if side > rim.start { side - 1 } else { rim.end - 1 }
    }

    fn angle(&self, side: usize) -> f64 {
        let before = tangent(&self.sides[self.previous(side)].0, 1.0);
        PI - angle(before, tangent(&self.sides[side].0, 0.0))
    }

    fn check_closed(&self) -> Result<(), PhysicsError> {
        for (i, (side, _)) in self.sides.iter().enumerate() {
            let (end, start) = (self.sides[self.previous(i)].0.at(1.0), side.at(0.0));
            if end.distance(start) > OPEN * self.extent {
                return Err(PhysicsError::Outline {
                    expected: "sides that meet end to end",
                    found: format!("a side that ends at {end} before one that starts at {start}"),
                });
            }
        }
        Ok(())
    }

    /// How far it is across the sheet from a place on a side along a direction, up to `most`; infinite if farther. What
    /// the narrowing of the sheet towards a corner of the side lets expect does not count.
    pub(super) fn gap(&self, side: usize, t: f64, direction: Point, most: f64) -> f64 {
        let from = self.sides[side].0.at(t);
        let beam = Bounds::around(&[from, along(from, direction, most)], 0.0);
        let mut found = f64::INFINITY;
        let open = |_: &f64, node: &Node| node.bounds.meets(&beam);
        self.tree.search(&mut found, open, |found, i| {
            let piece = &self.pieces[i];
            let beside = piece.side == side && piece.span[0] <= t && t <= piece.span[1];
            let [a, b] = piece.ends;
            let (chord, to) = (minus(b, a), minus(a, from));
            // The rim opposite runs the other way: it crosses the beam from its left to its right or not at all.
            let facing = cross(direction, chord);
            let (far, share) = (cross(to, chord) / facing, cross(to, direction) / facing);
            if facing > 0.0 && !beside && far > 0.0 && far < *found && (0.0..=1.0).contains(&share) {
                let far = (far - piece.sagitta).max(0.5 * far);
                if !self.expected(side, from, piece, far) {
                    *found = far;
                }
            }
        });
        if found <= most { found } else { f64::INFINITY }
    }

    /// Whether the distance to a piece is what the corner between its side and another lets expect there.
    fn expected(&self, side: usize, from: Point, piece: &Piece, far: f64) -> bool {
        let narrow = |corner: usize| {
            let opening = self.angles[corner];
            let apart = from.distance(self.sides[corner].0.at(0.0));
            opening < 0.5 * PI && far > 0.5 * apart * opening.sin()
        };
        let next = self.next(side);
        let same = piece.side == side && far < piece.sagitta + 0.1 * piece.ends[0].distance(piece.ends[1]);
        same || (piece.side == next && narrow(next)) || (piece.side == self.previous(side) && narrow(side))
    }
}

/// Direction of travel at a parameter, also where the derivative vanishes.
pub(super) fn tangent(side: &Side, t: f64) -> Point {
    let d = side.derivative(t);
    if norm(d) > 1e-9 * side.length() {
        return d;
    }
    minus(side.at((t + 1e-3).min(1.0)), side.at((t - 1e-3).max(0.0)))
}

fn check_sides(sides: &[(Side, Edge)], loops: &[Range<usize>]) -> Result<(), PhysicsError> {
    let fault = |expected, found| Err(PhysicsError::Outline { expected, found });
    if loops.iter().any(Range::is_empty) {
        return fault("rims of at least one side", "a rim without sides".to_owned());
    }
    for (i, (side, _)) in sides.iter().enumerate() {
        let whole = match side {
            Side::Line { from, to } => from.is_finite() && to.is_finite(),
            Side::Arc { centre, radius, start, sweep } => {
                centre.is_finite()
                    && radius.is_finite()
                    && *radius > 0.0
                    && start.is_finite()
                    && sweep.is_finite()
            }
            Side::Cubic(p) => p.iter().all(|p| p.is_finite()),
        };
        if !whole {
            return fault("finite coordinates and positive radii", format!("side {i}, {side:?}"));
        }
        if side.length() <= 0.0 {
            return fault("sides that have a length", format!("a side without length at {}", side.at(0.0)));
        }
    }
    Ok(())
}
