//! Complex poles of the damped system, in state-space form.

use super::conservative::Conservative;
use crate::loads::Circuit;
use crate::{Load, PhysicsError};
use unripple_linalg::{General, Lu, Mat, MatRef, c64, general};

/// Off-diagonal damping below this share of the largest diagonal element counts as zero: it is some hundred
/// rounding errors. Larger, weakly coupled modes would count as normal modes.
const PROPORTIONAL: f64 = 1e-13;

/// One exponential e^{st} of the coupled system: displacement Σ_m shape_m ψ_m · input_a · e^{st} per unit
/// impulse of drive. Of a pair of complex conjugates only the one with positive frequency is stored.
#[derive(Clone, Debug)]
pub(super) struct Root {
    /// Complex frequency s, in 1/s.
    pub s: c64,
    /// Complex displacement of each conservative mode.
    pub shape: Vec<c64>,
    /// Complex amplitude that a unit impulse of each drive excites.
    pub input: Vec<c64>,
}

/// How drives act on the state: as forces on the conservative modes, and as voltages on coils.
#[derive(Debug)]
pub(super) struct Drives {
    /// Forces per unit of drive, drives x conservative modes.
    pub forces: Mat<f64>,
    /// For each drive that is a coil's voltage, the index of the load that has the coil.
    pub coils: Vec<Option<usize>>,
}

/// Whether damping does not couple the conservative modes, so that each mode decays on its own.
pub(super) fn proportional(modes: &Conservative, loads: &[Load]) -> bool {
    let damping = modes.damping.as_ref();
    let count = damping.nrows();
    let largest = (0..count).map(|i| damping[(i, i)]).fold(0.0, f64::max);
    let alone =
        (0..count).all(|i| (0..count).all(|j| i == j || damping[(i, j)].abs() <= PROPORTIONAL * largest));
    alone && loads.iter().all(|load| load.inductive_coil().is_none())
}

/// All exponentials of the coupled system, from the eigenvalues of its state matrix; `max_hz` (Hz) is only used in
/// error messages.
///
/// The state is √Λ z, ż and √L i of every inductive coil, so that the sum of its squares is twice the energy and the matrix is
/// skew-symmetric except for dissipation. In this scaling the matrix is well balanced for the eigensolver.
///
/// # Errors
/// [`PhysicsError::NotConverged`] if the decomposition fails.
pub(super) fn roots(
    modes: &Conservative,
    loads: &[Load],
    drives: &Drives,
    max_hz: f64,
) -> Result<Vec<Root>, PhysicsError> {
    let failed = || PhysicsError::NotConverged { max_hz, expected: 1e-12, found: f64::INFINITY };
    let coils: Vec<(usize, Circuit)> =
        loads.iter().enumerate().filter_map(|(j, load)| Some((j, load.inductive_coil()?))).collect();
    let matrix = matrix(modes, &coils);
    let General { values, vectors: right } = general(matrix.as_ref()).ok_or_else(failed)?;
    let left = Lu::new(right.as_ref()).inverse();
    let root = |k: usize| Root {
        s: values[k],
        shape: displacement(modes, right.as_ref(), k, values[k]),
        input: inputs(modes.omegas.len(), &coils, drives, left.as_ref(), k),
    };
    Ok((0..matrix.nrows()).filter(|k| values[*k].im >= 0.0).map(root).collect())
}

/// The state matrix, in 1/s, which gives the time derivatives of √Λ z, ż and √L i.
fn matrix(modes: &Conservative, coils: &[(usize, Circuit)]) -> Mat<f64> {
    let count = modes.omegas.len();
    let mut matrix = Mat::zeros(2 * count + coils.len(), 2 * count + coils.len());
    for (i, omega) in modes.omegas.iter().enumerate() {
        matrix[(i, count + i)] = *omega;
        matrix[(count + i, i)] = -omega;
        for j in 0..count {
            matrix[(count + i, count + j)] = -modes.damping[(i, j)];
        }
    }
    for (c, (load, circuit)) in coils.iter().enumerate() {
        let row = 2 * count + c;
        matrix[(row, row)] = -circuit.resistance / circuit.inductance;
        let coupling = circuit.force_constant / circuit.inductance.sqrt();
        for i in 0..count {
            matrix[(count + i, row)] = coupling * modes.at_loads[(*load, i)];
            matrix[(row, count + i)] = -coupling * modes.at_loads[(*load, i)];
        }
    }
    matrix
}

/// Displacement z of the modes in one eigenvector: from √Λ z or from ż = s z, whichever is larger.
fn displacement(modes: &Conservative, right: MatRef<'_, c64>, column: usize, s: c64) -> Vec<c64> {
    let count = modes.omegas.len();
    let of = |(i, omega): (usize, &f64)| {
        if s.norm() >= *omega { right[(count + i, column)] / s } else { right[(i, column)] / *omega }
    };
    modes.omegas.iter().enumerate().map(of).collect()
}

/// Complex amplitude of one eigenvector after a unit impulse of each drive: the row of the inverse of the eigenvectors times the
/// state just after the impulse.
fn inputs(
    count: usize,
    coils: &[(usize, Circuit)],
    drives: &Drives,
    left: MatRef<'_, c64>,
    row: usize,
) -> Vec<c64> {
    let of = |drive: usize| {
        let forced: c64 = (0..count).map(|i| left[(row, count + i)] * drives.forces[(drive, i)]).sum();
        let place = drives.coils[drive].and_then(|load| coils.iter().position(|(j, _)| *j == load));
        let flux = place.map(|c| left[(row, 2 * count + c)] / coils[c].1.inductance.sqrt());
        forced + flux.unwrap_or_default()
    };
    (0..drives.coils.len()).map(of).collect()
}
