//! Random placements of actuators and targets, from a seed.

use super::Random;
use unripple_core::{Outline, Point};

/// Number of straight pieces of a round edge along which actuators are placed: half a degree of a circle
/// each.
const RIM_STEPS: usize = 720;

/// Largest number of draws of a place; after these, a place is used that does not meet all conditions.
const TRIES: usize = 1000;

/// A random sample of placements: actuators near the edge and targets inside, from a seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// Number of placements of the actuators.
    pub placements: usize,
    /// Number of targets for each placement.
    pub targets: usize,
    /// Least and greatest distance of actuators from the edge, in metres.
    pub depth: [f64; 2],
    /// Least distance of targets from the edge, in metres.
    pub margin: f64,
    /// Seed of the placements and targets.
    pub seed: u64,
}

impl Default for Sampling {
    /// 24 placements with 4 targets each: actuators 6 to 12 mm from the edge, as on the paper's surface, and targets at
    /// least 20 mm from it.
    fn default() -> Self {
        Self { placements: 24, targets: 4, depth: [6e-3, 12e-3], margin: 20e-3, seed: 1 }
    }
}

/// One placement: positions of actuators and targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Positions of the actuators, in m.
    pub actuators: Vec<Point>,
    /// Positions of the targets, in m.
    pub targets: Vec<Point>,
}

impl Sampling {
    /// Draws all placements, with `actuators` actuators each, on an outline. The first k actuators of a
    /// placement do not depend on how many follow.
    pub fn draws(&self, outline: &Outline, actuators: usize) -> Vec<Draw> {
        let rim = outline.rim(RIM_STEPS);
        let draw = |placement: usize| {
            let seed = self.seed.wrapping_mul(1_000_003).wrapping_add(2 * placement as u64);
            let (mut at_rim, mut inside) = (Random::seeded(seed), Random::seeded(seed + 1));
            Draw {
                actuators: (0..actuators).map(|_| self.peripheral(outline, &rim, &mut at_rim)).collect(),
                targets: (0..self.targets).map(|_| self.inner(outline, &rim, &mut inside)).collect(),
            }
        };
        (0..self.placements).map(draw).collect()
    }

    /// A place beside the rim, evenly along it and in depth.
    fn peripheral(&self, outline: &Outline, rim: &[Point], random: &mut Random) -> Point {
        let [low, high] = self.depth;
        let mut draw = || beside(rim, random.between(0.0, outline.perimeter()), random.between(low, high));
        // Close to a corner, a place may be nearer to the next side than to its own.
        let legal = |p: &Point| outline.contains(*p) && depth(rim, *p) >= low * (1.0 - 1e-6);
        (0..TRIES).map(|_| draw()).find(legal).unwrap_or_else(&mut draw)
    }

    /// A place inside, evenly over the area.
    fn inner(&self, outline: &Outline, rim: &[Point], random: &mut Random) -> Point {
        let (width, height) = outline.extent();
        let mut draw = || Point::new(random.between(0.0, width), random.between(0.0, height));
        let legal = |p: &Point| outline.contains(*p) && depth(rim, *p) >= self.margin;
        (0..TRIES).map(|_| draw()).find(legal).unwrap_or(Point::new(width / 2.0, height / 2.0))
    }
}

/// The place `along` metres along an anticlockwise rim and `depth` metres inwards.
fn beside(rim: &[Point], along: f64, depth: f64) -> Point {
    let mut left = along;
    for (a, b) in sides(rim) {
        let length = a.distance(b);
        if left <= length && length > 0.0 {
            let (dx, dy) = ((b.x - a.x) / length, (b.y - a.y) / length);
            return Point::new(a.x + left * dx - depth * dy, a.y + left * dy + depth * dx);
        }
        left -= length;
    }
    rim.first().copied().unwrap_or_default()
}

/// Distance to the rim.
fn depth(rim: &[Point], p: Point) -> f64 {
    let to_side = |(a, b): (Point, Point)| {
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let square = (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
        let t = (((p.x - a.x) * dx + (p.y - a.y) * dy) / square).clamp(0.0, 1.0);
        p.distance(Point::new(a.x + t * dx, a.y + t * dy))
    };
    sides(rim).map(to_side).fold(f64::INFINITY, f64::min)
}

fn sides(rim: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    rim.iter().copied().zip(rim.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Shape;

    #[test]
    fn places_are_where_they_should_be() {
        for shape in [Shape::Rectangle { width: 0.15, height: 0.1 }, Shape::Circle { radius: 0.07 }] {
            let outline = Outline::new(shape);
            let rim = outline.rim(RIM_STEPS);
            for draw in Sampling::default().draws(&outline, 32) {
                assert_eq!((draw.actuators.len(), draw.targets.len()), (32, 4));
                for p in draw.actuators {
                    let depth = depth(&rim, p);
                    assert!((5.99e-3..12.01e-3).contains(&depth) && outline.contains(p), "{p} {depth}");
                }
                assert!(draw.targets.iter().all(|p| outline.contains(*p) && depth(&rim, *p) >= 0.02));
            }
        }
    }

    #[test]
    fn fewer_actuators_are_the_first_of_more() {
        let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
        let sampling = Sampling::default();
        let (few, many) = (sampling.draws(&outline, 3), sampling.draws(&outline, 9));
        assert!(
            few.iter().zip(&many).all(|(f, m)| f.actuators == m.actuators[..3] && f.targets == m.targets)
        );
    }
}
