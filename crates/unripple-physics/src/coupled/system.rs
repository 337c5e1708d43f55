//! The coupled system T(s) q = 0 of a sheet and its loads at complex frequencies s, and its inverse.

use super::active::Active;
use crate::Load;
use crate::loads::Circuit;
use unripple_linalg::{Accum, Lu, Mat, Par, c64, multiply};

/// Largest number of Newton steps for the frequency at which a displacement is in balance; where it converges at all, four are enough.
const NEWTON: usize = 8;

/// The sheet and its loads in the coordinates of [`Active`], T(s) = s²M + sC + K + Σ s (bl)²/(R + sL) w wᵀ. Beside the loads its matrices
/// are diagonal, but for a small block of combinations of high modes, so that T(s)⁻¹ costs little by Woodbury's identity.
pub(super) struct System<'a> {
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
    loads: Vec<Reaction>,
}

/// How a load reacts to its displacement.
struct Reaction {
    mass: f64,
    damping: f64,
    stiffness: f64,
    /// Its coil, if the inductance of that is not negligible.
    coil: Option<Circuit>,
}

impl Reaction {
    fn of(load: &Load) -> Self {
        let damping = load.damping + load.direct_coil_damping();
        Self { mass: load.mass, damping, stiffness: load.stiffness, coil: load.inductive_coil() }
    }

    /// Force per displacement at the complex frequency `s`.
    fn at(&self, s: c64) -> c64 {
        let coil = s * Circuit::reaction(self.coil.as_ref(), s);
        s * (s * self.mass + self.damping) + self.stiffness + coil
    }

    /// The derivative of [`Reaction::at`].
    fn slope(&self, s: c64) -> c64 {
        let coil = self.coil.map_or(ZERO, |coil| coil.damping_slope(s));
        s * 2.0 * self.mass + self.damping + coil
    }
}

/// No force, to begin sums with.
const ZERO: c64 = c64::new(0.0, 0.0);

impl Circuit {
    /// The derivative of s (bl)²/(R + sL).
    fn damping_slope(&self, s: c64) -> c64 {
        let share = self.admittance(s) * self.force_constant;
        share * share * self.resistance
    }
}

impl<'a> System<'a> {
    pub(super) fn of(active: &'a Active, loads: &[Load]) -> Self {
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
            loads: loads.iter().map(Reaction::of).collect(),
        }
    }

    /// M q.
    pub(super) fn heavy(&self, q: &[c64]) -> Vec<c64> {
        let forces: Vec<c64> = self.seen(q).iter().zip(&self.loads).map(|(v, load)| v * load.mass).collect();
        let mut sum = q.to_vec();
        self.add_forces(&forces, &mut sum);
        sum
    }

    /// T'(s) q.
    pub(super) fn derivative(&self, s: c64, q: &[c64]) -> Vec<c64> {
        let mut sum: Vec<c64> = q.iter().map(|q| s * q * 2.0).collect();
        for ((sum, q), damping) in sum.iter_mut().zip(q).zip(&self.dampings) {
            *sum += q * *damping;
        }
        let block = self.block(&self.damping, q);
        sum[self.single..].iter_mut().zip(block).for_each(|(sum, force)| *sum += force);
        let forces: Vec<c64> =
            self.seen(q).iter().zip(&self.loads).map(|(v, load)| v * load.slope(s)).collect();
        self.add_forces(&forces, &mut sum);
        sum
    }

    /// The root of qᵀT(s)q near `s`, and qᵀT'(s)q there.
    pub(super) fn balanced(&self, q: &[c64], mut s: c64) -> (c64, c64) {
        let ([mass, damping, stiffness], coils) = (self.forms(q), self.coils(q));
        if coils.is_empty() {
            let half = damping / (mass * 2.0);
            let root = (half * half - stiffness / mass).sqrt();
            let [one, other] = [-half + root, -half - root];
            let nearest = if (one - s).norm() <= (other - s).norm() { one } else { other };
            return (nearest, mass * nearest * 2.0 + damping);
        }
        let sum = |part: &dyn Fn(&Circuit) -> c64| coils.iter().map(|(v, coil)| v * part(coil)).sum::<c64>();
        let slope = |s: c64| mass * s * 2.0 + damping + sum(&|coil| coil.damping_slope(s));
        for _ in 0..NEWTON {
            let value = s * (s * mass + damping + sum(&|coil| Circuit::reaction(Some(coil), s))) + stiffness;
            let step = value / slope(s);
            s -= step;
            if step.norm() <= f64::EPSILON * s.norm() {
                break;
            }
        }
        (s, slope(s))
    }

    /// Squared displacements at the loads whose coils have an inductance, and these coils.
    fn coils(&self, q: &[c64]) -> Vec<(c64, Circuit)> {
        if self.loads.iter().all(|load| load.coil.is_none()) {
            return Vec::new();
        }
        let seen = self.seen(q);
        seen.iter().zip(&self.loads).filter_map(|(v, load)| Some((v * v, load.coil?))).collect()
    }

    /// T(s)⁻¹ `right`, of norm 1, and its residual relative to |s|².
    ///
    /// With A the sheet alone, W the shapes at the loads and Z their reactions: T⁻¹ = A⁻¹ - A⁻¹Wᵀ Z (I + W A⁻¹ Wᵀ Z)⁻¹ W A⁻¹.
    pub(super) fn solved(&self, s: c64, right: &[c64]) -> (Vec<c64>, f64) {
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
                let own = if i == j { s * s } else { ZERO };
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
        let impedance: Vec<c64> = self.loads.iter().map(|load| load.at(s)).collect();
        let admittance = self.at_loads_of(&inverse, block.as_ref());
        let mut solution = alone(right);
        let matrix = Mat::from_fn(count, count, |i, j| {
            let own = if i == j { c64::new(1.0, 0.0) } else { ZERO };
            own + admittance[(i, j)] * impedance[j]
        });
        let seen = self.seen(&solution);
        let mut forces = Mat::from_fn(count, 1, |i, _| seen[i]);
        Lu::new(matrix.as_ref()).solve(forces.as_mut());
        let forces: Vec<c64> = (0..count).map(|i| -impedance[i] * forces[(i, 0)]).collect();
        let mut pushed = vec![ZERO; right.len()];
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
            let unit = c64::new(1.0, 0.0);
            multiply(sum.as_mut(), Accum::Add, complex.transpose(), moved.as_ref(), unit, Par::Seq);
        }
        sum
    }

    /// Displacements at the loads.
    fn seen(&self, q: &[c64]) -> Vec<c64> {
        let mut at_loads = vec![ZERO; self.loads.len()];
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
        let mut sum = vec![ZERO; q.len() - self.single];
        for (column, q) in block.col_iter().zip(&q[self.single..]) {
            sum.iter_mut().zip(column.iter()).for_each(|(sum, value)| *sum += q * *value);
        }
        sum
    }

    /// qᵀMq, qᵀCq and qᵀKq, but for coils whose inductance is not negligible.
    fn forms(&self, q: &[c64]) -> [c64; 3] {
        let square = |q: &[c64]| q.iter().map(|q| q * q).sum::<c64>();
        let single = |values: &[f64]| q.iter().zip(values).map(|(q, value)| q * q * *value).sum::<c64>();
        let block = |matrix: &Mat<f64>| {
            self.block(matrix, q).iter().zip(&q[self.single..]).map(|(a, q)| a * q).sum::<c64>()
        };
        let at_loads = self.seen(q);
        let loads = |part: fn(&Reaction) -> f64| {
            at_loads.iter().zip(&self.loads).map(|(v, load)| v * v * part(load)).sum::<c64>()
        };
        [
            square(q) + loads(|load| load.mass),
            single(&self.dampings) + block(&self.damping) + loads(|load| load.damping),
            single(&self.squares) + block(&self.stiffness) + loads(|load| load.stiffness),
        ]
    }
}
