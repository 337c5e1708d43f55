//! The size field: the desired edge length at each place, with bounded growth.

use unripple_core::Point;
use unripple_core::plane::{Bounds, Node, Tree};

/// A place around which edges of a given length are desired.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    /// The place, in metres.
    pub(super) at: Point,
    /// Radius around the place within which the desired length applies, in metres.
    pub(super) reach: f64,
    /// The desired edge length, in metres.
    pub(super) edge: f64,
}

/// The desired edge length at any point: the length of each source, growing with the distance from it.
#[derive(Clone, Debug)]
pub(super) struct Field {
    size: f64,
    growth: f64,
    sources: Vec<Source>,
    tree: Tree,
}

/// Largest growth of the edge length per distance: along a line away from a source each edge is e^0.65 =
/// 1.9 times as long as the edge before. With twice this value, meshes have fewer triangles, of worse
/// shape.
pub(crate) const GROWTH: f64 = 0.65;
/// Sources with an edge length above this share of the common length are ignored: they would cost a search
/// at every point for edges at most 15 % shorter.
const NEARLY: f64 = 0.85;

impl Field {
    /// A field of edges no longer than `size` (m), whose length grows by `growth` per distance from each
    /// source.
    pub(super) fn new(size: f64, growth: f64, sources: impl IntoIterator<Item = Source>) -> Self {
        let sources: Vec<Source> = sources.into_iter().filter(|s| s.edge < NEARLY * size).collect();
        let boxes: Vec<(Bounds, f64)> =
            sources.iter().map(|s| (Bounds::around(&[s.at], s.reach), s.edge)).collect();
        Self { size, growth, tree: Tree::new(&boxes), sources }
    }

    /// The desired edge length at a point (m), in metres.
    pub(super) fn at(&self, p: Point) -> f64 {
        self.below(p, self.size)
    }

    /// The desired edge length (m) at a place at a distance `apart` (m) from another, where it is `there` (m). The search begins with the
    /// most that it may have grown from there, which spares it most of the sources.
    pub(super) fn near(&self, p: Point, there: f64, apart: f64) -> f64 {
        self.below(p, self.size.min(there + self.growth * apart))
    }

    /// The desired edge length (m) at a point, if it is at most `bound`, else `bound`.
    fn below(&self, p: Point, bound: f64) -> f64 {
        let mut least = bound;
        let open = |least: &f64, node: &Node| node.least + self.growth * node.bounds.distance(p) < *least;
        self.tree.search(&mut least, open, |least, i| {
            let s = &self.sources[i];
            *least = least.min(s.edge + self.growth * (s.at.distance(p) - s.reach).max(0.0));
        });
        least
    }

    /// Whether an edge length is the common one, which no source shortens.
    pub(super) fn is_common(&self, edge: f64) -> bool {
        edge == self.size
    }

    /// Whether the desired edge length is the common length everywhere in a box.
    pub(super) fn is_even(&self, bounds: &Bounds) -> bool {
        let shorter = |edge: f64, apart: f64| edge + self.growth * apart < self.size;
        let mut even = true;
        let open = |even: &bool, node: &Node| *even && shorter(node.least, node.bounds.apart(bounds));
        self.tree.search(&mut even, open, |even, i| {
            let s = &self.sources[i];
            *even &= !shorter(s.edge, (bounds.distance(s.at) - s.reach).max(0.0));
        });
        even
    }
}
