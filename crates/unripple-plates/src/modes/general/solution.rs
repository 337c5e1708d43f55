//! The modes computed on one mesh.

use super::rates::Level;
use crate::elements::Space;
use crate::spectrum::Pairs;

/// The modes computed on one mesh.
pub(super) struct Solution {
    pub(super) space: Space,
    pub(super) pairs: Pairs,
    /// Share of bending in each mode's elastic energy.
    pub(super) bending_shares: Vec<f64>,
    /// Mean edge length, see [`mean_edge`](super::mean_edge), in metres.
    pub(super) edge: f64,
}

impl Solution {
    /// The edge length and the frequencies, for a comparison with later meshes.
    pub(super) fn level(&self) -> Level {
        Level { edge: self.edge, squares: self.pairs.values.clone() }
    }
}
