//! Undamped modes of sheet and loads: a symmetric eigenvalue problem.

use super::active::Active;
use crate::{Load, PhysicsError};
use unripple_linalg::{Mat, product, singular};

/// Frequency assigned to rigid-body motion, relative to the highest frequency, so that displacement follows
/// from the state: far below any frequency that can be heard or felt. With twice this value, rigid bodies
/// oscillate at twice that frequency.
const RIGID: f64 = 1e-8;

/// Undamped modes of the sheet with the masses and springs of its loads: q = Ψz, z̈ + C ż + Λz = Ψᵀ(force), where the damping C may
/// couple them.
#[derive(Debug)]
pub(super) struct Conservative {
    /// Angular frequencies √Λ, in rad/s, ascending.
    pub omegas: Vec<f64>,
    /// The matrix Ψ of mode shapes, coordinates x modes.
    pub shapes: Mat<f64>,
    /// Mode shapes averaged over the loads' footprints, loads x modes.
    pub at_loads: Mat<f64>,
    /// The damping matrix C of the sheet and of the loads' dampers, modes x modes, in 1/s.
    pub damping: Mat<f64>,
}

impl Conservative {
    /// Solves for the modes with the loads' masses and springs. The damping includes the loads' dampers and
    /// their coils of negligible inductance; `max_hz` (Hz) is only used in error messages.
    ///
    /// # Errors
    /// [`PhysicsError::NotConverged`] if a decomposition fails.
    pub fn of(active: &Active, loads: &[Load], max_hz: f64) -> Result<Self, PhysicsError> {
        let failed = || PhysicsError::NotConverged { max_hz, expected: 1e-12, found: f64::INFINITY };
        let unweighted = lightened(active, loads).ok_or_else(failed)?;
        let springs = weighted(&active.at_loads, loads, |load| load.stiffness);
        let whole = &active.stiffness + springs;
        let half = product(unweighted.as_ref(), whole.as_ref());
        let stiffness = product(half.as_ref(), unweighted.as_ref());
        let (squares, vectors) = unripple_linalg::exact_symmetric(stiffness.as_ref()).ok_or_else(failed)?;
        let top = squares.last().map_or(0.0, |square| square.max(0.0).sqrt());
        let shapes = product(unweighted.as_ref(), vectors.as_ref());
        let dampers = weighted(&active.at_loads, loads, |load| load.damping + load.direct_coil_damping());
        let whole = &active.damping + dampers;
        let half = product(shapes.transpose(), whole.as_ref());
        let damping = product(half.as_ref(), shapes.as_ref());
        Ok(Self {
            omegas: squares.iter().map(|square| square.max(0.0).sqrt().max(RIGID * top)).collect(),
            at_loads: product(active.at_loads.as_ref(), shapes.as_ref()),
            shapes,
            damping,
        })
    }

    /// Whether a mode is a rigid-body motion: its frequency is 0, for which [`Conservative::of`] puts a small
    /// value.
    pub fn is_rigid(&self, mode: usize) -> bool {
        self.omegas[mode] <= 1.5 * RIGID * self.omegas.last().copied().unwrap_or(0.0)
    }
}

/// The matrix M^{-1/2} for the mass matrix M = I + Σ μ w wᵀ: the identity except for the few directions
/// that have added mass.
fn lightened(active: &Active, loads: &[Load]) -> Option<Mat<f64>> {
    let count = active.at_loads.ncols();
    let mut root = Mat::<f64>::identity(count, count);
    let heavy: Vec<usize> = (0..loads.len()).filter(|j| loads[*j].mass > 0.0).collect();
    if heavy.is_empty() || count == 0 {
        return Some(root);
    }
    let weights =
        Mat::from_fn(count, heavy.len(), |i, j| active.at_loads[(heavy[j], i)] * loads[heavy[j]].mass.sqrt());
    let svd = singular(weights.as_ref())?;
    let factors: Vec<f64> = svd.values.iter().map(|s| 1.0 / (1.0 + s * s).sqrt() - 1.0).collect();
    let directions = &svd.left;
    let scaled = Mat::from_fn(count, factors.len(), |i, j| directions[(i, j)] * factors[j]);
    root += product(scaled.as_ref(), directions.transpose());
    Some(root)
}

/// Σ value·w wᵀ over the loads.
fn weighted(at_loads: &Mat<f64>, loads: &[Load], value: impl Fn(&Load) -> f64) -> Mat<f64> {
    let scaled = Mat::from_fn(at_loads.nrows(), at_loads.ncols(), |j, i| at_loads[(j, i)] * value(&loads[j]));
    product(at_loads.transpose(), scaled.as_ref())
}
