//! Placement of inner vertices so that they form equilateral triangles with existing ones, from the rims inwards (advancing
//! front: Löhner and Parikh, *Int. J. Numer. Meth. Fluids* 8, 1135, 1988). Only points are made; they are triangulated later.

use super::cells::{Cells, Near, Quick};
use super::field::Field;
use super::region::Region;
use super::rim::{Cut, fan};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::{FRAC_PI_2, PI};
use unripple_core::Point;
use unripple_core::plane::{Rims, along, doubled, middle, minus, norm, turned};

/// An existing vertex nearer than this share of the edge length is used instead of a new vertex. Doubled
/// (above 1), no new vertex would ever be far enough from existing ones.
const SAME: f64 = 0.72;

/// Points that become vertices: first those of the rims, then others that must stay in place, then all
/// others.
#[derive(Clone, Debug)]
pub(super) struct Cloud {
    /// Positions of the points, in metres.
    pub(super) points: Vec<Point>,
    /// Desired edge length at each point, in metres.
    pub(super) sizes: Vec<f64>,
    /// Number of points that must stay in place.
    pub(super) fixed: usize,
}

/// The points placed so far, and what is needed to place more (the advancing front).
pub(super) struct Front<'a> {
    /// The points placed so far.
    pub(super) cloud: Cloud,
    /// A spatial hash of the points, to find those too near a position.
    pub(super) cells: Cells,
    field: &'a Field,
    region: &'a Region,
    /// Pairs of points to whose left a third point is to be placed, in order of length, then of age.
    waiting: BinaryHeap<Reverse<(i32, usize, [usize; 2])>>,
    seen: Quick<(usize, usize), ()>,
}

impl<'a> Front<'a> {
    /// A front that starts from the rims, and from vertices at the points `places` (m).
    pub(super) fn new(rims: &Rims, cut: &'a Cut, region: &'a Region, places: &[Point]) -> Self {
        let points: Vec<Point> = cut.vertices.iter().map(|v| v.at).collect();
        let mut sizes = vec![f64::INFINITY; points.len()];
        for (ends, _) in &cut.edges {
            let length = points[ends[0]].distance(points[ends[1]]);
            ends.iter().for_each(|i| sizes[*i] = sizes[*i].min(length));
        }
        let cloud = Cloud { fixed: points.len(), points, sizes };
        let (waiting, seen) = (BinaryHeap::new(), Quick::default());
        let mut front = Self { cloud, cells: Cells::default(), field: &cut.field, region, waiting, seen };
        for (i, p) in front.cloud.points.iter().enumerate() {
            front.cells.add(i, *p, front.cloud.sizes[i]);
        }
        for (ends, _) in &cut.edges {
            front.cells.guard(front.cloud.points[ends[0]], front.cloud.points[ends[1]]);
        }
        front.put_places(places);
        front.put_fans(rims, cut);
        cut.edges.iter().for_each(|(ends, _)| front.wait(*ends));
        front
    }

    /// Places vertices at the given points, each with six vertices around it.
    fn put_places(&mut self, places: &[Point]) {
        let centres: Vec<usize> = places.iter().filter_map(|p| self.put(*p).ok()).collect();
        self.cloud.fixed = self.cloud.points.len();
        for centre in centres {
            let (at, size) = (self.cloud.points[centre], self.cloud.sizes[centre]);
            let around = |i: i32| along(at, turned(Point::new(1.0, 0.0), f64::from(i) * PI / 3.0), size);
            let ring: Vec<Option<usize>> = (0..6).map(|i| self.put(around(i)).ok()).collect();
            for i in 0..6 {
                if let (Some(a), Some(b)) = (ring[(i + 1) % 6], ring[i]) {
                    self.wait([a, b]);
                }
            }
        }
    }

    /// Places vertices that divide wide corners into equal angles.
    fn put_fans(&mut self, rims: &Rims, cut: &Cut) {
        let mut corners: Vec<usize> = (0..cut.starts.len()).collect();
        corners.sort_by(|i, j| self.cloud.sizes[cut.starts[*i]].total_cmp(&self.cloud.sizes[cut.starts[*j]]));
        for side in corners {
            let (corner, count) = (cut.starts[side], fan(rims.angles[side]));
            let Some(((_, after), (before, _))) = cut
                .edges
                .iter()
                .find(|(ends, _)| ends[0] == corner)
                .zip(cut.edges.iter().find(|(ends, _)| ends[1] == corner))
                .map(|((a, _), (b, _))| ((a[0], a[1]), (b[0], b[1])))
            else {
                continue;
            };
            let at = self.cloud.points[corner];
            let first = minus(self.cloud.points[after], at);
            let length = 0.5 * (norm(first) + self.cloud.points[before].distance(at));
            let mut last = Some(after);
            for i in 1..count {
                let way = turned(first, rims.angles[side] * i as f64 / count as f64);
                let ray = self.put(along(at, way, length / norm(way))).ok();
                last.zip(ray).into_iter().for_each(|(a, b)| self.wait([b, a]));
                last = ray;
            }
            last.into_iter().for_each(|a| self.wait([before, a]));
        }
    }

    /// Adds a point (m) and returns its index, unless the point is outside the region or too near others.
    pub(super) fn put(&mut self, p: Point) -> Result<usize, Near> {
        self.put_apart(p, SAME * self.field.at(p))
    }

    /// Adds a point (m) and returns its index, unless the point is outside the region or others are nearer
    /// than `apart` (m).
    pub(super) fn put_apart(&mut self, p: Point, apart: f64) -> Result<usize, Near> {
        let size = self.field.at(p);
        match self.cells.near(p, size, apart) {
            Near::Nothing if self.region.contains(p) => {
                let index = self.cloud.points.len();
                self.cells.add(index, p, size);
                self.cloud.points.push(p);
                self.cloud.sizes.push(size);
                Ok(index)
            }
            near => Err(near),
        }
    }

    /// Queues a pair of points to which a third point is to be added, unless the pair was queued before.
    fn wait(&mut self, pair: [usize; 2]) {
        let [a, b] = pair.map(|i| self.cloud.points[i]);
        let (length, size) = (a.distance(b), self.field.at(middle(a, b)));
        if length < 1.5 * size && self.seen.insert((pair[0], pair[1]), ()).is_none() {
            let rank = (2.0 * length.log2()).floor() as i32;
            self.waiting.push(Reverse((rank, self.seen.len(), pair)));
        }
    }

    /// Fills the region with points, the shortest pairs first.
    pub(super) fn advance(&mut self) {
        while let Some(Reverse((_, _, pair))) = self.waiting.pop() {
            let third = match self.put(self.apex(pair)) {
                Ok(third) | Err(Near::Vertex(third)) => third,
                Err(_) => continue,
            };
            let [a, b, c] = [pair[0], pair[1], third].map(|i| self.cloud.points[i]);
            if doubled(a, b, c) > 0.0 {
                self.wait([pair[0], third]);
                self.wait([third, pair[1]]);
            }
        }
    }

    /// The position of a third point that makes the triangle equilateral, or as nearly so as the growth of
    /// edges allows.
    fn apex(&self, pair: [usize; 2]) -> Point {
        let [a, b] = pair.map(|i| self.cloud.points[i]);
        let (ab, m) = (minus(b, a), middle(a, b));
        let (length, inward) = (norm(ab), turned(ab, FRAC_PI_2));
        let top = along(m, inward, 0.75_f64.sqrt());
        let size = 0.5 * (self.field.at(m) + self.field.at(top));
        let leg = size.clamp(0.75 * length, 1.4 * length);
        along(m, inward, (leg * leg - 0.25 * length * length).sqrt() / length)
    }
}
