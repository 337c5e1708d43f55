//! The size field: edge length wanted at every place, with bounded growth.

use unripple_core::Point;
use unripple_core::plane::{Bounds, Node, Tree};

/// Where edges of some length are wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    /// Place around which the length is wanted, in metres.
    pub(super) at: Point,
    /// How far around it the length holds, in metres.
    pub(super) reach: f64,
    /// The length, in metres.
    pub(super) edge: f64,
}

/// How long edges should be, anywhere: as long as at the sources, growing with the distance from them.
#[derive(Clone, Debug)]
pub(super) struct Field {
    size: f64,
    sources: Vec<Source>,
    tree: Tree,
}

/// By how much edges grow per distance: along a line to a source each is e^0.65 = 1.9 times the one before.
/// Doubled, meshes have fewer triangles, of worse shape.
pub(super) const GROWTH: f64 = 0.65;
/// A source that wants nearly the common length, as a share of it, is none: it would cost a search at every
/// place for edges 15 % shorter.
const NEARLY: f64 = 0.85;

impl Field {
    /// A field of edges no longer than `size` (m).
    pub(super) fn new(size: f64, sources: impl IntoIterator<Item = Source>) -> Self {
        let sources: Vec<Source> = sources.into_iter().filter(|s| s.edge < NEARLY * size).collect();
        let boxes: Vec<(Bounds, f64)> =
            sources.iter().map(|s| (Bounds::around(&[s.at], s.reach), s.edge)).collect();
        Self { size, tree: Tree::new(&boxes), sources }
    }

    /// The edge length wanted at a point (m), in metres.
    pub(super) fn at(&self, p: Point) -> f64 {
        let mut least = self.size;
        let open = |least: &f64, node: &Node| node.least + GROWTH * node.bounds.distance(p) < *least;
        self.tree.search(&mut least, open, |least, i| {
            let s = &self.sources[i];
            *least = least.min(s.edge + GROWTH * (s.at.distance(p) - s.reach).max(0.0));
        });
        least
    }

    /// Whether edges of the common length are wanted all over a box.
    pub(super) fn is_even(&self, bounds: &Bounds) -> bool {
        let shorter = |edge: f64, apart: f64| edge + GROWTH * apart < self.size;
        let mut even = true;
        let open = |even: &bool, node: &Node| *even && shorter(node.least, node.bounds.apart(bounds));
        self.tree.search(&mut even, open, |even, i| {
            let s = &self.sources[i];
            *even &= !shorter(s.edge, (bounds.distance(s.at) - s.reach).max(0.0));
        });
        even
    }
}
