//! Complex poles of the damped system, in state-space form.

use super::conservative::Conservative;
use crate::loads::Circuit;
use crate::{Load, PhysicsError};
use unripple_linalg::{General, Lu, Mat, MatRef, c64, general, product};

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

/// The state y of the coupled system: √Λ z, ż and √L i of every inductive coil, so that the sum of its squares is twice the energy. Its matrix
/// A, with ẏ = A y, is skew-symmetric except for dissipation. In this scaling the matrix is well balanced for the eigensolver. With the signs
/// J = diag(-1, 1, -1) of the three parts JA is symmetric, so that yᵀJy' vanishes between two eigenvectors.
pub(super) struct State<'a> {
    /// The undamped modes, whose motion the state is.
    pub modes: &'a Conservative,
    /// The inductive coils, with the index of the load of each.
    pub coils: Vec<(usize, Circuit)>,
    drives: &'a Drives,
}

impl<'a> State<'a> {
    /// The state of modes, of the loads on them and of what drives them.
    pub fn of(modes: &'a Conservative, loads: &[Load], drives: &'a Drives) -> Self {
        let coil = |(j, load): (usize, &Load)| Some((j, load.inductive_coil()?));
        Self { modes, coils: loads.iter().enumerate().filter_map(coil).collect(), drives }
    }

    /// Number of values of the state.
    pub fn size(&self) -> usize {
        2 * self.modes.omegas.len() + self.coils.len()
    }

    /// All exponentials of the coupled system, from the eigenvalues of its state matrix; `max_hz` (Hz) is only used in error messages.
    ///
    /// # Errors
    /// [`PhysicsError::NotConverged`] if the decomposition fails.
    pub fn roots(&self, max_hz: f64) -> Result<Vec<Root>, PhysicsError> {
        let failed = || PhysicsError::NotConverged { max_hz, expected: 1e-12, found: f64::INFINITY };
        let General { values, vectors: right } = general(self.matrix().as_ref()).ok_or_else(failed)?;
        let left = Lu::new(right.as_ref()).inverse();
        let root = |k: usize| Root {
            s: values[k],
            shape: self.displacement(values[k], |i| right[(i, k)]),
            input: self.inputs(|i| left[(k, i)]),
        };
        Ok((0..self.size()).filter(|k| values[*k].im >= 0.0).map(root).collect())
    }

    /// The matrix A, in 1/s.
    fn matrix(&self) -> Mat<f64> {
        let (count, size) = (self.modes.omegas.len(), self.size());
        let mut matrix = Mat::zeros(size, size);
        for (i, omega) in self.modes.omegas.iter().enumerate() {
            matrix[(i, count + i)] = *omega;
            matrix[(count + i, i)] = -omega;
            for j in 0..count {
                matrix[(count + i, count + j)] = -self.modes.damping[(i, j)];
            }
        }
        for c in 0..self.coils.len() {
            let row = 2 * count + c;
            matrix[(row, row)] = -self.rate(c);
            for i in 0..count {
                matrix[(count + i, row)] = self.coupling(c, i);
                matrix[(row, count + i)] = -self.coupling(c, i);
            }
        }
        matrix
    }

    /// R/L of a coil, in 1/s.
    pub fn rate(&self, coil: usize) -> f64 {
        let circuit = self.coils[coil].1;
        circuit.resistance / circuit.inductance
    }

    /// Coupling bl/√L of a coil to the velocity of a mode, in 1/s.
    pub fn coupling(&self, coil: usize, mode: usize) -> f64 {
        let (load, circuit) = self.coils[coil];
        circuit.force_constant / circuit.inductance.sqrt() * self.modes.at_loads[(load, mode)]
    }

    /// The product A Y of the state matrix A and the matrix Y whose columns are states.
    pub fn moved(&self, states: MatRef<'_, f64>) -> Mat<f64> {
        let count = self.modes.omegas.len();
        let damped = product(self.modes.damping.as_ref(), states.subrows(count, count));
        Mat::from_fn(self.size(), states.ncols(), |row, k| {
            if row < count {
                return self.modes.omegas[row] * states[(count + row, k)];
            }
            if row < 2 * count {
                let mode = row - count;
                let currents =
                    (0..self.coils.len()).map(|c| self.coupling(c, mode) * states[(2 * count + c, k)]);
                return currents.sum::<f64>()
                    - self.modes.omegas[mode] * states[(mode, k)]
                    - damped[(mode, k)];
            }
            let coil = row - 2 * count;
            let induced = (0..count).map(|m| self.coupling(coil, m) * states[(count + m, k)]).sum::<f64>();
            -induced - self.rate(coil) * states[(row, k)]
        })
    }

    /// The element (1 or -1) for the value `row` of the state in J, the diagonal matrix of signs with which J
    /// A is symmetric.
    pub fn sign(&self, row: usize) -> f64 {
        let count = self.modes.omegas.len();
        if (count..2 * count).contains(&row) { 1.0 } else { -1.0 }
    }

    /// The state of the mode `shape` at its complex frequency `s`.
    pub fn vector(&self, s: c64, shape: &[c64]) -> Vec<c64> {
        let displacements = shape.iter().zip(&self.modes.omegas).map(|(z, omega)| z * *omega);
        let velocities = shape.iter().map(|z| z * s);
        let current = |coil: usize| {
            let induced: c64 = shape.iter().enumerate().map(|(m, z)| z * s * self.coupling(coil, m)).sum();
            -induced / (s + self.rate(coil))
        };
        displacements.chain(velocities).chain((0..self.coils.len()).map(current)).collect()
    }

    /// Displacement z of the modes in an eigenvector of eigenvalue `s`: from √Λ z or from ż = s z, whichever is larger.
    pub fn displacement(&self, s: c64, vector: impl Fn(usize) -> c64) -> Vec<c64> {
        let count = self.modes.omegas.len();
        let of = |(i, omega): (usize, &f64)| {
            if s.norm() >= *omega { vector(count + i) / s } else { vector(i) / *omega }
        };
        self.modes.omegas.iter().enumerate().map(of).collect()
    }

    /// Complex amplitude of an eigenvector after a unit impulse of each drive: the left eigenvector times the state just after the impulse.
    pub fn inputs(&self, left: impl Fn(usize) -> c64) -> Vec<c64> {
        let count = self.modes.omegas.len();
        let of = |drive: usize| {
            let forced: c64 = (0..count).map(|i| left(count + i) * self.drives.forces[(drive, i)]).sum();
            let place =
                self.drives.coils[drive].and_then(|load| self.coils.iter().position(|(j, _)| *j == load));
            let flux = place.map(|c| left(2 * count + c) / self.coils[c].1.inductance.sqrt());
            forced + flux.unwrap_or_default()
        };
        (0..self.drives.coils.len()).map(of).collect()
    }

    /// Complex amplitude of the mode `shape`, whose frequency is `s` and whose qᵀT'(s)q is `norm`, after a unit impulse of each drive.
    pub fn excited(&self, s: c64, shape: &[c64], norm: c64) -> Vec<c64> {
        let of = |drive: usize| {
            let forced: c64 = shape.iter().enumerate().map(|(i, z)| z * self.drives.forces[(drive, i)]).sum();
            let coil = self.drives.coils[drive].and_then(|load| self.coils.iter().find(|(j, _)| *j == load));
            let Some((load, circuit)) = coil else { return forced / norm };
            let moved: c64 = shape.iter().enumerate().map(|(i, z)| z * self.modes.at_loads[(*load, i)]).sum();
            let force = moved * circuit.force_constant * circuit.admittance(s);
            (forced + force) / norm
        };
        (0..self.drives.coils.len()).map(of).collect()
    }

    /// Whether the sums of s and of s² over all exponentials are the traces of A and of A², within a share `tolerance` of their terms.
    pub fn adds_up(&self, roots: &[Root], tolerance: f64) -> bool {
        let modes = self.modes;
        let sum = |of: &dyn Fn(c64) -> f64| {
            let twice = |root: &Root| if root.s.im == 0.0 { 1.0 } else { 2.0 };
            roots.iter().map(|root| twice(root) * of(root.s)).sum::<f64>()
        };
        let coils = 0..self.coils.len();
        let damped: f64 = (0..modes.omegas.len()).map(|m| modes.damping[(m, m)]).sum();
        let damped = damped + coils.clone().map(|c| self.rate(c)).sum::<f64>();
        let squared: f64 = modes.damping.col_iter().map(|c| c.iter().map(|x| x * x).sum::<f64>()).sum();
        let squared = squared + coils.clone().map(|c| self.rate(c).powi(2)).sum::<f64>();
        let stiff: f64 = modes.omegas.iter().map(|omega| omega * omega).sum();
        let coupled =
            coils.map(|c| (0..modes.omegas.len()).map(|m| self.coupling(c, m).powi(2)).sum::<f64>());
        let stiff = stiff + coupled.sum::<f64>();
        (sum(&|s| s.re) + damped).abs() <= tolerance * damped.abs()
            && (sum(&|s| (s * s).re) - squared + 2.0 * stiff).abs() <= tolerance * (2.0 * stiff + squared)
    }
}
