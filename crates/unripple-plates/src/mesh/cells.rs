//! A spatial hash of vertices and rim edges, to find those near a point in constant time.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};
use unripple_core::Point;

/// A hash function for small numbers, by multiplication.
#[derive(Default)]
pub(super) struct Mix(u64);

impl Hasher for Mix {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|b| self.write_u64(u64::from(*b)));
    }

    fn write_u64(&mut self, x: u64) {
        let mixed = (self.0.rotate_left(23) ^ x).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 29);
    }

    fn write_i64(&mut self, x: i64) {
        self.write_u64(x as u64);
    }

    fn write_i32(&mut self, x: i32) {
        self.write_u64(x as u64);
    }

    fn write_usize(&mut self, x: usize) {
        self.write_u64(x as u64);
    }
}

/// A hash map with the hash function [`Mix`].
pub(super) type Quick<K, V> = HashMap<K, V, BuildHasherDefault<Mix>>;

/// A point from which new vertices must keep a distance: a vertex, or the middle of a rim's edge.
#[derive(Clone, Copy, Debug)]
struct Site {
    at: Point,
    /// Index of the vertex if the point is one; `None` for the middle of a rim's edge, from which vertices
    /// keep the distance `clear`.
    vertex: Option<usize>,
    clear: f64,
}

/// The result of a search for vertices or rims too near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Near {
    /// Nothing is too near.
    Nothing,
    /// The nearest vertex, by its index, is too near.
    Vertex(usize),
    /// An edge of a rim is too near.
    Rim,
}

/// Sites in square cells whose width is a power of two that fits the edge length there.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    cells: Quick<(i32, i64, i64), Vec<Site>>,
    levels: Vec<i32>,
}

/// The exponent of two of a cell's width, for places where edges have the length `size` (m).
fn level(size: f64) -> i32 {
    size.log2().ceil() as i32
}

fn width(level: i32) -> f64 {
    f64::from(level).exp2()
}

impl Cells {
    /// Adds a vertex at a place (m) where edges have the length `size` (m).
    pub(super) fn add(&mut self, vertex: usize, at: Point, size: f64) {
        self.push(Site { at, vertex: Some(vertex), clear: 0.0 }, size);
    }

    /// Adds a rim edge between two points (m): no vertex may lie in the circle around it.
    pub(super) fn guard(&mut self, a: Point, b: Point) {
        let length = a.distance(b);
        let at = Point::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y));
        // A little more than the circle whose diameter is the edge: a vertex in it would form an obtuse
        // angle with the edge.
        self.push(Site { at, vertex: None, clear: 0.55 * length }, length);
    }

    /// Puts a site into its cell, at the cell width for edges of the length `size` (m).
    fn push(&mut self, site: Site, size: f64) {
        let level = level(size);
        let w = width(level);
        let cell = (level, (site.at.x / w).floor() as i64, (site.at.y / w).floor() as i64);
        self.cells.entry(cell).or_default().push(site);
        if let Err(i) = self.levels.binary_search(&level) {
            self.levels.insert(i, level);
        }
    }

    /// Searches for a vertex nearer to a point (m) than `radius` (m), or a rim edge too near to it, where
    /// edges have the length `size` (m).
    pub(super) fn near(&self, p: Point, size: f64, radius: f64) -> Near {
        let own = level(size);
        let (mut best, mut found) = (radius * radius, Near::Nothing);
        for level in self.levels.iter().copied().filter(|l| (own - 2..=own + 2).contains(l)) {
            let w = width(level);
            // Sites of a level keep others away by no more than its width.
            let reach = radius.max(0.56 * w);
            let cell = |x: f64| (x / w).floor() as i64;
            for i in cell(p.x - reach)..=cell(p.x + reach) {
                for j in cell(p.y - reach)..=cell(p.y + reach) {
                    for site in self.cells.get(&(level, i, j)).into_iter().flatten() {
                        let (x, y) = (site.at.x - p.x, site.at.y - p.y);
                        let apart = x * x + y * y;
                        match site.vertex {
                            Some(vertex) if apart < best => (best, found) = (apart, Near::Vertex(vertex)),
                            None if apart < site.clear * site.clear && found == Near::Nothing => {
                                found = Near::Rim
                            }
                            _ => {}
                        }
                    }
                }
            }
        }
        found
    }
}
