//! Modes of the fitted sheet with actuators and masses on it.

use super::basis::Basis;
use super::layout::Values;
use super::sheet::{decay_rate, eigen};
use super::system::System;
use crate::CalibrateError;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{Point, Pole, Shapes};
use unripple_linalg::{Cholesky, ColRef, Mat, product, solve_lower_alone};
use unripple_physics::Modes;

/// The modes of a fitted sheet with all its loads: masses, dampers and coils.
#[derive(Clone, Debug)]
pub(super) struct LoadedModes {
    /// Decay rate (1/s) and damped angular frequency (rad/s) of each mode.
    pub poles: Vec<Pole>,
    /// Share of bending in the elastic energy of each mode, 0 to 1.
    pub bending_shares: Vec<f64>,
    /// Weights of the modes at the actuators, actuators x modes.
    pub weights: Mat<f64>,
    /// Shapes of the modes, mass-normalised, anywhere on the sheet.
    pub shapes: Arc<dyn Shapes>,
}

/// Mode shapes that are linear combinations of the nominal ones.
#[derive(Debug)]
struct Combined {
    base: Arc<Modes>,
    /// Coefficients of the combinations, nominal modes x modes.
    mixing: Mat<f64>,
}

impl Shapes for Combined {
    fn modes(&self) -> usize {
        self.mixing.ncols()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let all = self.at_all(&[point]);
        row.iter_mut().zip(all.row(0).iter()).for_each(|(r, w)| *r = *w);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        self.base.at_all(points).subcols(0, self.mixing.nrows()) * &self.mixing
    }
}

impl LoadedModes {
    /// Modes within `band` (Hz): eigenvectors of the stiffness K with the mass 1 + Σ μ b bᵀ, where μ is the
    /// mass of a load and b holds the modes' values at it. At each load one more coordinate represents the
    /// modes that are left out. Dampers, the inductances of coils and the housings of exciters are added to
    /// each mode in first order, as is right for light ones, and for housings whose resonance is below the
    /// modes; negative masses count as zero.
    pub fn new(
        basis: &Basis,
        system: &System,
        values: &Values,
        band: [f64; 2],
    ) -> Result<Self, CalibrateError> {
        let (modes, loaded) = (system.shapes.nrows(), system.layout.loaded());
        let all = modes + loaded;
        let felt = Mat::from_fn(all, loaded, |m, p| match m.checked_sub(modes) {
            None => system.shapes[(m, p)],
            Some(rest) => {
                if rest == p {
                    system.rest.weight.sqrt()
                } else {
                    0.0
                }
            }
        });
        let weighed = |by: &[f64]| {
            let scaled = Mat::from_fn(all, loaded, |m, p| felt[(m, p)] * by[p]);
            product(scaled.as_ref(), felt.transpose())
        };
        let mut mass = weighed(&values.masses.iter().map(|m| m.max(0.0)).collect::<Vec<_>>());
        (0..all).for_each(|m| mass[(m, m)] += 1.0);
        let squares: Vec<f64> =
            (0..all).map(|m| system.sheet.squares.get(m).copied().unwrap_or(system.rest.square)).collect();
        let factor = Cholesky::new(mass.as_ref()).ok_or_else(|| CalibrateError::Unsolvable {
            what: "mass of the fitted sheet",
            expected: "a positive mass everywhere",
            found: "a negative one".into(),
        })?;
        // With B = L Lᵀ and x = L⁻ᵀ y, K x = λ B x is L⁻¹ K L⁻ᵀ y = λ y.
        let mut inverse = Mat::<f64>::identity(all, all);
        solve_lower_alone(factor.lower(), inverse.as_mut());
        let scaled = Mat::from_fn(all, all, |i, m| inverse[(i, m)] * squares[m]);
        let stiff = product(scaled.as_ref(), inverse.transpose());
        let (found, vectors) = eigen(&stiff)?;
        let vectors = product(inverse.transpose(), vectors.as_ref());
        let low = found.partition_point(|square| square.max(0.0).sqrt() < TAU * band[0]);
        let high = found.partition_point(|square| square.max(0.0).sqrt() <= TAU * band[1] * (1.0 + 1e-9));
        let vectors = vectors.subcols(low, high.saturating_sub(low)).to_owned();
        let mixing = product(system.sheet.turn.as_ref(), vectors.subrows(0, modes));
        let bent = product(system.sheet.bending.as_ref(), mixing.as_ref());
        let loads = product(felt.transpose(), vectors.as_ref());
        let near_energy = system.rest.square * system.rest.bending_share;
        let (mut poles, mut bending_shares) = (Vec::new(), Vec::new());
        for (m, square) in found[low..high].iter().enumerate() {
            let [stiffness, rate] = hung(basis, values, loads.col(m), square.max(0.0).sqrt());
            let own: f64 = (0..modes).map(|i| system.sheet.sigmas[i] * vectors[(i, m)].powi(2)).sum();
            let own = own + rate;
            let omega = (square + stiffness).max(0.0).sqrt();
            poles.push(Pole::new(omega, own.max(0.01 * decay_rate(&values.knots, omega, system.top))));
            let near: f64 = (modes..all).map(|p| vectors[(p, m)].powi(2)).sum();
            bending_shares.push(bending_share(mixing.col(m), bent.col(m), near * near_energy, *square));
        }
        let weights = loads.subrows(0, system.layout.actuators).to_owned();
        let shapes = Arc::new(Combined { base: basis.modes.clone(), mixing });
        Ok(Self { poles, bending_shares, weights, shapes })
    }
}

/// Stiffness and decay rate that dampers and coil circuits add to a mode of unit modal mass, from its values at the loads.
fn hung(basis: &Basis, values: &Values, loads: ColRef<'_, f64>, omega: f64) -> [f64; 2] {
    let one = |(p, moved): (usize, &f64)| {
        let [stiffness, damping] = basis.coil(p).map_or([0.0; 2], |coil| coil.in_mode(omega));
        [stiffness, 0.5 * (values.resistances[p] + damping)].map(|x| x * moved.powi(2))
    };
    loads.iter().enumerate().map(one).fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y])
}

/// Share of bending in a mode's elastic energy, from its shape, the bending stiffness times its shape, and the bending energy close to
/// loads.
fn bending_share(shape: ColRef<'_, f64>, bent: ColRef<'_, f64>, near: f64, square: f64) -> f64 {
    let energy = near + shape.iter().zip(bent.iter()).map(|(x, b)| x * b).sum::<f64>();
    (energy / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}
