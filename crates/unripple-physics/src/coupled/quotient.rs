//! Complex modes of a sheet whose loads are few, by Rayleigh quotient iteration from the undamped modes.
//!
//! With displacements q = e^{st} the coupled system is T(s) q = 0, T(s) = s²M + sC + K. Beside the loads its matrices are diagonal,
//! but for a small block of combinations of high modes, so that T(s)⁻¹ costs little by Woodbury's identity. The matrices are symmetric,
//! so that the scalar equation qᵀT(s)q = 0 has errors of second order and the iteration converges cubically (Parlett, *Math. Comp.*
//! 28, 679, 1974; Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use super::active::Active;
use super::conservative::Conservative;
use super::state::{Drives, Root};
use crate::Load;
use rayon::prelude::*;
use unripple_core::Observed;
use unripple_linalg::{Accum, Lu, Mat, Par, c64, multiply, product};

/// Least number of modes for which this pays: the eigenvalues of smaller state matrices take milliseconds.
const WORTHWHILE: usize = 48;

/// Number of modes for each load from which this pays. A step costs the square of the number of loads times the number of modes, and
/// the eigenvalues of the state matrix some two hundred times the cube of the latter.
const PER_LOAD: usize = 4;

/// Largest number of steps of a mode. From a mode of light damping two or three are enough; one that needs more than this many is on
/// its way to another mode.
const STEPS: usize = 12;

/// Relative change of s at which a mode has converged: some thousand rounding errors. Since convergence is cubic, the change of one
/// step more would be a rounding error.
const CONVERGED: f64 = 2e-13;

/// Largest residual ‖T(s)q‖ of a mode, relative to 2|s|²‖q‖: far above rounding errors, far below that of a mode that has not
/// converged.
const RESIDUAL: f64 = 1e-9;

/// Largest error of the sums of s and of s² over all modes, relative to the sum of the magnitudes of their terms. A mode that was found
/// twice and one that was missed differ by more, unless both sums agree by chance.
const SUMS: f64 = 1e-10;

/// The sheet and its loads in the coordinates of [`Active`].
struct System<'a> {
    /// Number of leading coordinates that are single modes.
    single: usize,
    /// ω² and 2σ of the single modes.
    squares: Vec<f64>,
    dampings: Vec<f64>,
    /// Stiffness and damping between the other coordinates.
    stiffness: Mat<f64>,
    damping: Mat<f64>,
    /// Mode shapes at the loads, loads x coordinates.
    at_loads: &'a Mat<f64>,
    /// Mass, damping and stiffness of each load.
    loads: Vec<[f64; 3]>,
}

/// A mode: its complex frequency s, its displacement in the coordinates, and qᵀT'(s)q.
struct Found {
    s: c64,
    q: Vec<c64>,
    norm: c64,
}

/// All exponentials of the coupled system, as [`state::roots`](super::state::roots) gives them; `None` where this is not worthwhile or
/// not sure to find all: with inductive coils, with modes damped too strongly to oscillate, or if the modes found are not all different.
pub(super) fn roots(
    active: &Active,
    modes: &Conservative,
    loads: &[Load],
    drives: &Drives,
) -> Option<Vec<Root>> {
    let count = modes.omegas.len();
    let few = count >= WORTHWHILE && count >= PER_LOAD * loads.len();
    if !few || loads.iter().any(|load| load.inductive_coil().is_some()) {
        return None;
    }
    let system = System::of(active, loads);
    let observed = Observed::here();
    let steps = observed.steps(count);
    let found: Option<Vec<Found>> =
        (0..count).into_par_iter().map(|m| system.mode(modes, m)).inspect(|_| steps.take(1.0)).collect();
    let found = found?;
    (adds_up(modes, &found) && system.all_differ(&found)).then(|| system.in_modes(modes, drives, found))
}

/// Whether the sums of s and of s² over all modes are the traces of the system's matrices: -tr C and tr C² - 2 tr Λ.
fn adds_up(modes: &Conservative, found: &[Found]) -> bool {
    let count = modes.omegas.len();
    let damped: f64 = (0..count).map(|m| modes.damping[(m, m)]).sum();
    let squared: f64 = modes.damping.col_iter().map(|c| c.iter().map(|x| x * x).sum::<f64>()).sum();
    let stiff: f64 = modes.omegas.iter().map(|omega| omega * omega).sum();
    let first: f64 = found.iter().map(|mode| 2.0 * mode.s.re).sum();
    let second: f64 = found.iter().map(|mode| 2.0 * (mode.s * mode.s).re).sum();
    (first + damped).abs() <= SUMS * damped.abs()
        && (second - squared + 2.0 * stiff).abs() <= SUMS * (2.0 * stiff + squared)
}

impl<'a> System<'a> {
    fn of(active: &'a Active, loads: &[Load]) -> Self {
        let (single, count) = (active.single, active.at_loads.ncols());
        let diagonal = |matrix: &Mat<f64>| (0..single).map(|i| matrix[(i, i)]).collect();
        let block =
            |matrix: &Mat<f64>| matrix.submatrix(single, single, count - single, count - single).to_owned();
        Self {
            single,
            squares: diagonal(&active.stiffness),
            dampings: diagonal(&active.damping),
            stiffness: block(&active.stiffness),
            damping: block(&active.damping),
            at_loads: &active.at_loads,
            loads: loads
                .iter()
                .map(|load| [load.mass, load.damping + load.direct_coil_damping(), load.stiffness])
                .collect(),
        }
    }

    /// The damped mode that the undamped mode of index `m` becomes; `None` if it does not oscillate or the iteration does not converge.
    fn mode(&self, modes: &Conservative, m: usize) -> Option<Found> {
        let (omega, decay) = (modes.omegas[m], 0.5 * modes.damping[(m, m)]);
        let mut q: Vec<c64> = modes.shapes.col(m).iter().map(|x| c64::new(*x, 0.0)).collect();
        if modes.is_rigid(m) {
            // Its frequency is one by convention, which no iteration finds.
            let still = modes.damping.col(m).iter().all(|c| c.abs() <= SUMS * omega);
            let s = c64::new(0.0, omega);
            return still.then(|| Found { s, q, norm: s * 2.0 });
        }
        if decay >= omega {
            return None;
        }
        let mut s = c64::new(-decay, ((omega - decay) * (omega + decay)).sqrt());
        for _ in 0..STEPS {
            let (next, residual) = self.solved(s, &self.derivative(s, &q));
            q = next;
            let [mass, damping, stiffness] = self.forms(&q);
            let half = damping / (mass * 2.0);
            let root = (half * half - stiffness / mass).sqrt();
            let [one, other] = [-half + root, -half - root];
            let nearest = if (one - s).norm() <= (other - s).norm() { one } else { other };
            let change = (nearest - s).norm() / nearest.norm();
            s = nearest;
            // False where a solution is not finite.
            if change <= CONVERGED && residual <= RESIDUAL {
                let norm = mass * s * 2.0 + damping;
                return (s.im > 0.0 && norm.norm() > 0.0).then_some(Found { s, q, norm });
            }
        }
        None
    }

    /// Displacements at the loads.
    fn seen(&self, q: &[c64]) -> Vec<c64> {
        let mut at_loads = vec![c64::new(0.0, 0.0); self.loads.len()];
        for (column, q) in self.at_loads.col_iter().zip(q) {
            at_loads.iter_mut().zip(column.iter()).for_each(|(sum, w)| *sum += q * *w);
        }
        at_loads
    }

    /// Adds the forces of the loads on the coordinates.
    fn add_forces(&self, forces: &[c64], sum: &mut [c64]) {
        for (column, sum) in self.at_loads.col_iter().zip(sum) {
            *sum += column.iter().zip(forces).map(|(w, force)| force * *w).sum::<c64>();
        }
    }

    /// A block of the sheet's matrices times the coordinates that are no single modes.
    fn block(&self, block: &Mat<f64>, q: &[c64]) -> Vec<c64> {
        let mut sum = vec![c64::new(0.0, 0.0); q.len() - self.single];
        for (column, q) in block.col_iter().zip(&q[self.single..]) {
            sum.iter_mut().zip(column.iter()).for_each(|(sum, value)| *sum += q * *value);
        }
        sum
    }

    /// T'(s) q = (2sM + C) q.
    fn derivative(&self, s: c64, q: &[c64]) -> Vec<c64> {
        let mut sum: Vec<c64> = q.iter().map(|q| s * q * 2.0).collect();
        for ((sum, q), damping) in sum.iter_mut().zip(q).zip(&self.dampings) {
            *sum += q * *damping;
        }
        let block = self.block(&self.damping, q);
        sum[self.single..].iter_mut().zip(block).for_each(|(sum, force)| *sum += force);
        let forces: Vec<c64> = (self.seen(q).iter().zip(&self.loads))
            .map(|(v, [mass, damping, _])| v * (s * 2.0 * *mass + *damping))
            .collect();
        self.add_forces(&forces, &mut sum);
        sum
    }

    /// qᵀMq, qᵀCq and qᵀKq.
    fn forms(&self, q: &[c64]) -> [c64; 3] {
        let square = |q: &[c64]| q.iter().map(|q| q * q).sum::<c64>();
        let single = |values: &[f64]| q.iter().zip(values).map(|(q, value)| q * q * *value).sum::<c64>();
        let block = |matrix: &Mat<f64>| {
            self.block(matrix, q).iter().zip(&q[self.single..]).map(|(a, q)| a * q).sum::<c64>()
        };
        let at_loads = self.seen(q);
        let loads = |i: usize| at_loads.iter().zip(&self.loads).map(|(v, load)| v * v * load[i]).sum::<c64>();
        [
            square(q) + loads(0),
            single(&self.dampings) + block(&self.damping) + loads(1),
            single(&self.squares) + block(&self.stiffness) + loads(2),
        ]
    }

    /// T(s)⁻¹ `right`, of norm 1, and its residual relative to |s|².
    ///
    /// With A the sheet alone, W the shapes at the loads and Z = s²μ + sβ + κ: T⁻¹ = A⁻¹ - A⁻¹Wᵀ Z (I + W A⁻¹ Wᵀ Z)⁻¹ W A⁻¹.
    fn solved(&self, s: c64, right: &[c64]) -> (Vec<c64>, f64) {
        let count = self.loads.len();
        let inverse: Vec<c64> = (self.squares.iter().zip(&self.dampings))
            .map(|(square, damping)| {
                let stiff = s * (s + *damping) + *square;
                // At the frequency of a mode without loads, as far as rounding tells.
                let least = f64::EPSILON * s.norm_sqr();
                if stiff.norm() < least { c64::new(1.0 / least, 0.0) } else { 1.0 / stiff }
            })
            .collect();
        let block = (self.single < right.len()).then(|| {
            let entry = |i: usize, j: usize| {
                let own = if i == j { s * s } else { c64::new(0.0, 0.0) };
                own + s * self.damping[(i, j)] + self.stiffness[(i, j)]
            };
            let size = right.len() - self.single;
            Lu::new(Mat::from_fn(size, size, entry).as_ref())
        });
        let alone = |right: &[c64]| {
            let mut solution: Vec<c64> = right.iter().zip(&inverse).map(|(r, i)| r * i).collect();
            if let Some(block) = &block {
                let mut rest = Mat::from_fn(right.len() - self.single, 1, |i, _| right[self.single + i]);
                block.solve(rest.as_mut());
                solution.extend(rest.col(0).iter().copied());
            }
            solution
        };
        let impedance: Vec<c64> = self
            .loads
            .iter()
            .map(|[mass, damping, stiffness]| s * (s * *mass + *damping) + *stiffness)
            .collect();
        let admittance = self.at_loads_of(&inverse, block.as_ref());
        let mut solution = alone(right);
        let matrix = Mat::from_fn(count, count, |i, j| {
            let own = if i == j { c64::new(1.0, 0.0) } else { c64::new(0.0, 0.0) };
            own + admittance[(i, j)] * impedance[j]
        });
        let seen = self.seen(&solution);
        let mut forces = Mat::from_fn(count, 1, |i, _| seen[i]);
        Lu::new(matrix.as_ref()).solve(forces.as_mut());
        let forces: Vec<c64> = (0..count).map(|i| -impedance[i] * forces[(i, 0)]).collect();
        let mut pushed = vec![c64::new(0.0, 0.0); right.len()];
        self.add_forces(&forces, &mut pushed);
        solution.iter_mut().zip(alone(&pushed)).for_each(|(sum, moved)| *sum += moved);
        let length = |v: &[c64]| v.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let norm = length(&solution);
        let residual = length(right) / (norm * s.norm_sqr());
        solution.iter_mut().for_each(|x| *x /= norm);
        (solution, residual)
    }

    /// W A⁻¹ Wᵀ, loads x loads, from the inverse of the single modes' diagonal and the factors of the block.
    fn at_loads_of(&self, inverse: &[c64], block: Option<&Lu<c64>>) -> Mat<c64> {
        let shapes = self.at_loads.subcols(0, self.single);
        let count = self.loads.len();
        let half = |part: fn(&c64) -> f64| {
            let weighted = Mat::from_fn(count, self.single, |i, m| shapes[(i, m)] * part(&inverse[m]));
            let mut sum = Mat::zeros(count, count);
            multiply(sum.as_mut(), Accum::Replace, weighted.as_ref(), shapes.transpose(), 1.0, Par::Seq);
            sum
        };
        let (real, imaginary) = (half(|x| x.re), half(|x| x.im));
        let mut sum = Mat::from_fn(count, count, |i, j| c64::new(real[(i, j)], imaginary[(i, j)]));
        if let Some(block) = block {
            let others = self.at_loads.subcols(self.single, self.at_loads.ncols() - self.single);
            let complex = Mat::from_fn(others.ncols(), count, |m, i| c64::new(others[(i, m)], 0.0));
            let mut moved = complex.clone();
            block.solve(moved.as_mut());
            multiply(
                sum.as_mut(),
                Accum::Add,
                complex.transpose(),
                moved.as_ref(),
                c64::new(1.0, 0.0),
                Par::Seq,
            );
        }
        sum
    }

    /// Whether no mode was found twice: qᵀ((s + s')M + C)q' vanishes between two different modes.
    fn all_differ(&self, found: &[Found]) -> bool {
        let mut order: Vec<&Found> = found.iter().collect();
        order.sort_by(|a, b| a.s.im.total_cmp(&b.s.im));
        order.windows(2).all(|pair| {
            let [a, b] = [pair[0], pair[1]];
            if (a.s - b.s).norm() > 1e-7 * b.s.norm() {
                return true;
            }
            let half = self.derivative((a.s + b.s) * 0.5, &b.q);
            let between: c64 = a.q.iter().zip(half).map(|(q, force)| q * force).sum();
            between.norm_sqr() < 1e-4 * a.norm.norm() * b.norm.norm()
        })
    }

    /// The modes in the coordinates of the undamped ones, with what each drive excites: z = Ψᵀ M q.
    fn in_modes(&self, modes: &Conservative, drives: &Drives, found: Vec<Found>) -> Vec<Root> {
        let heavy = |found: &Found| {
            let mut sum = found.q.clone();
            let forces: Vec<c64> =
                self.seen(&found.q).iter().zip(&self.loads).map(|(v, [mass, ..])| v * *mass).collect();
            self.add_forces(&forces, &mut sum);
            sum
        };
        let moved: Vec<Vec<c64>> = found.par_iter().map(heavy).collect();
        let count = modes.omegas.len();
        let half = |part: fn(&c64) -> f64| {
            let columns = Mat::from_fn(count, count, |i, k| part(&moved[k][i]));
            product(modes.shapes.transpose(), columns.as_ref())
        };
        let (real, imaginary) = (half(|x| x.re), half(|x| x.im));
        let root = |(k, found): (usize, &Found)| {
            let shape: Vec<c64> = (0..count).map(|i| c64::new(real[(i, k)], imaginary[(i, k)])).collect();
            let excited = |drive: usize| {
                let force: c64 = shape.iter().enumerate().map(|(i, z)| z * drives.forces[(drive, i)]).sum();
                force / found.norm
            };
            let input = (0..drives.forces.nrows()).map(excited).collect();
            Root { s: found.s, shape, input }
        };
        found.iter().enumerate().map(root).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::basis::split;
    use super::super::state;
    use super::*;
    use crate::Footprint;
    use std::f64::consts::TAU;
    use unripple_core::{Point, Pole, Random};

    /// Modes with losses in proportion to their frequency, three loads with the given damping, and two drives.
    fn system(damping: f64) -> (Active, Conservative, Vec<Load>, Drives) {
        let mut random = Random::seeded(7);
        let poles: Vec<Pole> = (1..=150)
            .map(|m| {
                let omega = TAU * (100.0 + 20.0 * f64::from(m) + 8.0 * random.uniform());
                Pole::new(omega, 0.01 * omega)
            })
            .collect();
        let shapes = Mat::from_fn(3, poles.len(), |_, _| random.between(-1.0, 1.0));
        let load = |mass: f64, stiffness: f64| Load {
            footprint: Footprint::point(Point::new(0.0, 0.0)),
            mass,
            damping,
            stiffness,
            circuit: None,
            housing: None,
        };
        let loads = vec![load(0.02, 0.0), load(0.0, 3e4), load(0.1, 1e3)];
        let (shaped, _) = split(&poles, shapes.as_ref());
        // The upper modes are combined.
        let active = Active::of(&shaped, shapes.as_ref(), TAU * 2400.0);
        assert!(active.single < active.at_loads.ncols() && active.single > 100);
        let modes = Conservative::of(&active, &loads, 2400.0).unwrap();
        let forces = Mat::from_fn(2, modes.omegas.len(), |_, _| random.between(-1.0, 1.0));
        (active, modes, loads, Drives { forces, coils: vec![None; 2] })
    }

    #[test]
    fn the_same_as_the_eigenvalues_of_the_state_matrix() {
        for damping in [0.0, 0.3, 20.0] {
            let (active, modes, loads, drives) = system(damping);
            let mut found = roots(&active, &modes, &loads, &drives).unwrap();
            let mut known = state::roots(&modes, &loads, &drives, 2400.0).unwrap();
            for list in [&mut found, &mut known] {
                list.sort_by(|a, b| a.s.im.total_cmp(&b.s.im));
            }
            assert_eq!(found.len(), known.len());
            for (a, b) in found.iter().zip(&known) {
                assert!((a.s - b.s).norm() < 1e-11 * b.s.norm(), "{damping}: {} {}", a.s, b.s);
                // Shape times input does not depend on the scale of either.
                let largest = |root: &Root| root.shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
                let most = largest(b) * b.input.iter().map(|x| x.norm()).fold(0.0, f64::max);
                for (i, j) in [(0, 0), (40, 1), (90, 0)] {
                    let [x, y] = [a, b].map(|root| root.shape[i] * root.input[j]);
                    assert!((x - y).norm() < 1e-9 * most, "{damping}, {}: {x} {y}", a.s);
                }
            }
        }
    }

    #[test]
    fn left_to_the_state_matrix_where_modes_do_not_oscillate() {
        let (active, modes, loads, drives) = system(1e5);
        assert!(roots(&active, &modes, &loads, &drives).is_none());
    }
}
