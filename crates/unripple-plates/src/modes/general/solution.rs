//! The modes computed on one mesh.

use super::meshed::{mean_edge, meshed};
use super::rates::Level;
use super::sizing::Plan;
use crate::elements::Space;
use crate::fabric::Fabric;
use crate::modes::bounds::Bounds;
use crate::spectrum::Pairs;
use unripple_core::{Encoded, Surface};
use unripple_linalg::Mat;

/// The modes computed on one mesh.
pub(super) struct Solution {
    /// The plan of the mesh.
    pub(super) plan: Plan,
    pub(super) space: Space,
    pub(super) pairs: Pairs,
    /// Share of bending in each mode's elastic energy.
    pub(super) bending_shares: Vec<f64>,
    /// Mean edge length, see [`mean_edge`], in metres.
    pub(super) edge: f64,
}

impl Solution {
    /// Appends the bytes of all but the functions on the mesh, which follow from its plan.
    pub(super) fn encode(&self, to: &mut Vec<u8>) {
        let Pairs { values, vectors, residual } = &self.pairs;
        self.plan.numbers().encode(to);
        [self.edge, *residual].encode(to);
        values.encode(to);
        self.bending_shares.encode(to);
        vectors.encode(to);
    }

    /// Takes a solution of a surface off the front; `None` if it is not one.
    pub(super) fn decode(
        from: &mut &[u8],
        surface: &Surface,
        fabric: &Fabric,
        bounds: &Bounds,
    ) -> Option<Self> {
        let plan = Plan::new(surface, fabric, bounds).ok()?.with_numbers(&Vec::decode(from)?)?;
        let [edge, residual] = <[f64; 2]>::decode(from)?;
        let (values, bending_shares) = <(Vec<f64>, Vec<f64>)>::decode(from)?;
        let vectors = Mat::decode(from)?;
        let (mesh, space) = meshed(surface, fabric, &plan).ok()?;
        // Another mathematical library may place a vertex elsewhere, by the last digit.
        let same = mean_edge(&mesh).to_bits() == edge.to_bits() && vectors.nrows() == space.unknowns();
        let fits = same && vectors.ncols() == values.len() && bending_shares.len() == values.len();
        let pairs = Pairs { values, vectors, residual };
        fits.then_some(Self { plan, space, pairs, bending_shares, edge })
    }

    /// The edge length and the frequencies, for a comparison with later meshes.
    pub(super) fn level(&self) -> Level {
        Level { edge: self.edge, squares: self.pairs.values.clone() }
    }
}
