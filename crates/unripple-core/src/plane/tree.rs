//! Axis-aligned bounding boxes, and a tree of them (a bounding volume hierarchy) for searches.

use crate::Point;

/// Largest number of items in a leaf: with twice this value, the tree has about half the nodes and each search compares more items;
/// results stay the same.
const LEAF: usize = 4;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The lower-left corner, in metres.
    pub low: Point,
    /// The upper-right corner, in metres.
    pub high: Point,
}

impl Bounds {
    /// The box around some points, widened by `margin` (m) on each side.
    pub fn around(points: &[Point], margin: f64) -> Self {
        let mut bounds = Self {
            low: Point::new(f64::INFINITY, f64::INFINITY),
            high: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        for p in points {
            bounds.low = Point::new(bounds.low.x.min(p.x - margin), bounds.low.y.min(p.y - margin));
            bounds.high = Point::new(bounds.high.x.max(p.x + margin), bounds.high.y.max(p.y + margin));
        }
        bounds
    }

    fn join(self, other: Self) -> Self {
        Self::around(&[self.low, self.high, other.low, other.high], 0.0)
    }

    /// Centre of the box, in metres.
    pub fn centre(&self) -> Point {
        Point::new(0.5 * (self.low.x + self.high.x), 0.5 * (self.low.y + self.high.y))
    }

    /// Whether two boxes share a point.
    pub fn meets(&self, other: &Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
    }

    /// Distance from another box, in metres; 0 if they meet.
    pub fn apart(&self, other: &Self) -> f64 {
        let x = (self.low.x - other.high.x).max(other.low.x - self.high.x).max(0.0);
        let y = (self.low.y - other.high.y).max(other.low.y - self.high.y).max(0.0);
        (x * x + y * y).sqrt()
    }

    /// Distance from a point, in metres; 0 inside.
    pub fn distance(&self, p: Point) -> f64 {
        let x = (self.low.x - p.x).max(p.x - self.high.x).max(0.0);
        let y = (self.low.y - p.y).max(p.y - self.high.y).max(0.0);
        (x * x + y * y).sqrt()
    }
}

/// A node of a [`Tree`]: the bounding box of all its items, and the least of their weights.
#[derive(Clone, Debug)]
pub struct Node {
    /// The bounding box of all its items.
    pub bounds: Bounds,
    /// The least weight among its items.
    pub least: f64,
    items: [usize; 2],
    leaf: bool,
    after: usize,
}

/// A bounding volume hierarchy: a tree of boxes, each with a weight, for searches that skip whole branches.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    nodes: Vec<Node>,
    order: Vec<usize>,
}

impl Tree {
    /// A tree of items, each a box and a weight; searches return the indices of items in this list.
    pub fn new(items: &[(Bounds, f64)]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..items.len()).collect() };
        if !items.is_empty() {
            tree.grow(items, 0, items.len());
        }
        tree
    }

    /// Adds the node of the items `from..to` of `order`: a leaf, or two halves split along the longer side of the box.
    fn grow(&mut self, items: &[(Bounds, f64)], from: usize, to: usize) {
        let part = &mut self.order[from..to];
        let bounds = part.iter().map(|i| items[*i].0).reduce(Bounds::join);
        let Some(bounds) = bounds else { return };
        let least = part.iter().map(|i| items[*i].1).fold(f64::INFINITY, f64::min);
        let (index, leaf) = (self.nodes.len(), to - from <= LEAF);
        self.nodes.push(Node { bounds, least, items: [from, to], leaf, after: 0 });
        if !leaf {
            let part = &mut self.order[from..to];
            let wide = bounds.high.x - bounds.low.x > bounds.high.y - bounds.low.y;
            let place = |i: usize| if wide { items[i].0.centre().x } else { items[i].0.centre().y };
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, |i, j| place(*i).total_cmp(&place(*j)));
            self.grow(items, from, from + half);
            self.grow(items, from + half, to);
        }
        self.nodes[index].after = self.nodes.len();
    }

    /// Visits the tree from the root: calls `open` with each node reached, skips the branch if it returns false, and calls `item`
    /// with the index of each item in the leaves reached. `state` is passed to both.
    pub fn search<S>(
        &self,
        state: &mut S,
        open: impl Fn(&S, &Node) -> bool,
        mut item: impl FnMut(&mut S, usize),
    ) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if !open(state, node) {
                at = node.after;
                continue;
            }
            if node.leaf {
                self.order[node.items[0]..node.items[1]].iter().for_each(|i| item(state, *i));
            }
            at += 1;
        }
    }
}
