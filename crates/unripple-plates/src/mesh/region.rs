//! Inside and outside of closed polygons.

use unripple_core::Point;
use unripple_core::plane::{Bounds, Node, Tree, doubled};

/// The region within closed polygons.
#[derive(Clone, Debug)]
pub(super) struct Region {
    chords: Vec<[Point; 2]>,
    tree: Tree,
}

impl Region {
    /// The region to the left of chords (m) that form closed polygons.
    pub(super) fn new(chords: Vec<[Point; 2]>) -> Self {
        let boxes: Vec<(Bounds, f64)> = chords.iter().map(|ends| (Bounds::around(ends, 0.0), 0.0)).collect();
        Self { tree: Tree::new(&boxes), chords }
    }

    /// Whether a point (m) lies within the region.
    pub(super) fn contains(&self, p: Point) -> bool {
        let mut inside = false;
        let open = |_: &bool, node: &Node| {
            let b = &node.bounds;
            b.low.y <= p.y && p.y <= b.high.y && p.x <= b.high.x
        };
        self.tree.search(&mut inside, open, |inside, i| {
            let [a, b] = self.chords[i];
            if (a.y > p.y) != (b.y > p.y) && (doubled(a, b, p) > 0.0) == (b.y > a.y) {
                *inside = !*inside;
            }
        });
        inside
    }

    /// Whether a chord passes through a box.
    pub(super) fn cuts(&self, bounds: &Bounds) -> bool {
        let mut found = false;
        let open = |found: &bool, node: &Node| !*found && node.bounds.meets(bounds);
        self.tree.search(&mut found, open, |found, i| {
            *found |= Bounds::around(&self.chords[i], 0.0).meets(bounds);
        });
        found
    }
}
