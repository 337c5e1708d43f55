//! The modes computed on one mesh.

use super::meshed::{mean_edge, meshed};
use super::rates::{self, Level};
use super::sizing::Plan;
use crate::elements::Space;
use crate::fabric::Fabric;
use crate::modes::bounds::Bounds;
use crate::modes::found::{Errors, PURE};
use crate::spectrum::Pairs;
use unripple_core::{Encoded, Surface};
use unripple_linalg::Mat;

/// The error of a shape over ε^¾, for an error ε of its frequency: where frequencies converge with the eighth power of the edge length,
/// the curvatures of quintic functions do with the fourth, and deflections with the sixth (Nitsche). Their ratio is 1.4 where all three are
/// as on a smooth sheet; with twice this value, shapes would count as much as the drift of phases after a few periods.
const SHAPE: f64 = 2.0;

/// The modes computed on one mesh.
pub(super) struct Solution {
    /// The plan of the mesh.
    pub(super) plan: Plan,
    pub(super) space: Space,
    pub(super) pairs: Pairs,
    /// Share of bending in each mode's elastic energy.
    pub(super) bending_shares: Vec<f64>,
    /// What is known of the errors of each mode.
    pub(super) errors: Vec<Errors>,
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
        self.errors.encode(to);
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
        let (errors, vectors) = <(Vec<Errors>, Mat<f64>)>::decode(from)?;
        let (mesh, space) = meshed(surface, fabric, &plan).ok()?;
        // Another mathematical library may place a vertex elsewhere, by the last digit.
        let same = mean_edge(&mesh).to_bits() == edge.to_bits() && vectors.nrows() == space.unknowns();
        let fits = vectors.ncols() == values.len() && bending_shares.len() == values.len();
        let fits = same && fits && errors.len() == values.len();
        let pairs = Pairs { values, vectors, residual };
        fits.then_some(Self { plan, space, pairs, bending_shares, errors, edge })
    }

    /// The edge length, the frequencies and the shares of bending, for a comparison with later meshes.
    pub(super) fn level(&self) -> Level {
        Level { edge: self.edge, squares: self.pairs.values.clone(), shares: self.bending_shares.clone() }
    }

    /// States the errors of each mode, from meshes of which the last is that of this solution, with an error of `unresolved` of every
    /// frequency that these do not show.
    pub(super) fn state(&mut self, levels: &[Level], unresolved: f64) {
        let known = [rates::of_frequencies(levels), rates::of_shares(levels)];
        let [frequencies, shares] = known.map(Option::unwrap_or_default);
        // Modes that only the last mesh has are as those before them.
        let of = |errors: &[f64], m: usize| {
            errors.get(m).or(errors.last()).copied().unwrap_or(f64::INFINITY) + unresolved
        };
        for (m, errors) in self.errors.iter_mut().enumerate().filter(|(m, _)| self.pairs.values[*m] > 0.0) {
            errors.frequency = of(&frequencies, m);
            errors.shape = SHAPE * errors.frequency.powf(0.75);
            if 1.0 - self.bending_shares[m] > PURE {
                errors.share = of(&shares, m) + 2.0 * errors.frequency;
            }
        }
    }
}
