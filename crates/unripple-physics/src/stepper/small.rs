//! Small vectors and matrices over ports, in SIMD lanes.

use pulp::Simd;
use std::ops::Range;

/// Number of ports processed together: a 512-bit register holds as many f64. With twice this value, more empty ports are
/// processed.
pub(super) const OCT: usize = 8;

/// One value for each of eight ports.
pub(super) type Oct = [f64; OCT];

/// Number of groups of eight that vectors over `ports` ports take.
pub(super) fn octs(ports: usize) -> usize {
    ports.div_ceil(OCT)
}

/// Number of registers that hold eight values.
#[inline(always)]
pub(super) fn registers<S: Simd>() -> usize {
    OCT / S::F64_LANES
}

/// The register at index `i` of eight values.
#[inline(always)]
pub(super) fn get<S: Simd>(oct: &Oct, i: usize) -> S::f64s {
    S::as_simd_f64s(oct).0[i]
}

/// Sets the register at index `i` of eight values.
#[inline(always)]
pub(super) fn set<S: Simd>(oct: &mut Oct, i: usize, value: S::f64s) {
    S::as_mut_simd_f64s(oct).0[i] = value;
}

/// Adds `values` to `to`, entry by entry.
#[inline(always)]
pub(super) fn add<S: Simd>(simd: S, to: &mut [Oct], values: &[Oct]) {
    for (to, value) in to.iter_mut().zip(values) {
        for i in 0..registers::<S>() {
            set::<S>(to, i, simd.add_f64s(get::<S>(to, i), get::<S>(value, i)));
        }
    }
}

/// A square matrix of up to `size` rows, stored eight rows at a time: the values of eight rows for every
/// column, then those of the next eight rows.
#[derive(Clone, Debug)]
pub(super) struct Small {
    size: usize,
    cells: Vec<Oct>,
}

impl Small {
    /// A matrix of zeros.
    pub(super) fn zeros(size: usize) -> Self {
        Self { size, cells: vec![[0.0; OCT]; octs(size) * size] }
    }

    /// One entry, by the indices of its row and column.
    #[inline(always)]
    pub(super) fn get(&self, row: usize, column: usize) -> f64 {
        self.cells[row / OCT * self.size + column][row % OCT]
    }

    /// Sets one entry, by the indices of its row and column.
    #[inline(always)]
    pub(super) fn set(&mut self, row: usize, column: usize, value: f64) {
        self.cells[row / OCT * self.size + column][row % OCT] = value;
    }

    /// Sets all entries to zero.
    pub(super) fn clear(&mut self) {
        self.cells.fill([0.0; OCT]);
    }

    /// The product `out = M x`, over as many columns of the matrix as `x` has elements.
    #[inline(always)]
    pub(super) fn product<S: Simd>(&self, simd: S, x: &[f64], out: &mut [Oct]) {
        let n = registers::<S>();
        for (out, cells) in out.iter_mut().zip(self.cells.chunks_exact(self.size.max(1))) {
            // Two sums, so that the processor need not wait for each addition.
            let (mut even, mut odd) = ([simd.splat_f64s(0.0); OCT], [simd.splat_f64s(0.0); OCT]);
            let (pairs, last) = cells[..x.len()].as_chunks::<2>();
            let (amounts, end) = x.as_chunks::<2>();
            for (cells, x) in pairs.iter().zip(amounts) {
                let x = [simd.splat_f64s(x[0]), simd.splat_f64s(x[1])];
                for i in 0..n {
                    even[i] = simd.mul_add_e_f64s(get::<S>(&cells[0], i), x[0], even[i]);
                    odd[i] = simd.mul_add_e_f64s(get::<S>(&cells[1], i), x[1], odd[i]);
                }
            }
            for (cell, x) in last.iter().zip(end) {
                let x = simd.splat_f64s(*x);
                for (i, even) in even.iter_mut().enumerate().take(n) {
                    *even = simd.mul_add_e_f64s(get::<S>(cell, i), x, *even);
                }
            }
            for (i, (even, odd)) in even.into_iter().zip(odd).enumerate().take(n) {
                set::<S>(out, i, simd.add_f64s(even, odd));
            }
        }
    }
}

/// Trace of `D A D` above which systems are solved by Cholesky factors rather than by the inverse, whose
/// rounding errors would be too large: at 1e5, eleven digits are left. With twice this value, stiffer loads
/// are solved by the inverse, with a third of a digit less.
const STIFF: f64 = 1e5;

/// Solves `(1 + D A D) x = r`, with A symmetric and positive semidefinite and D diagonal, by an inverse that is updated when
/// the last ports are added, removed or changed.
///
/// The inverse N grows by one port at a time (bordering): with `k` the new column and κ its diagonal entry, `w = N k` and
/// `s = κ - kᵀw ≥ 1`, it becomes `N + w wᵀ/s` bordered by `-w/s` and `1/s`. So a change of the last port costs two products,
/// and N stays symmetric and positive semidefinite whatever the rounding. For loads so stiff that the rounding of N would
/// matter, the system is solved by Cholesky factorisation, which is slower but backward stable.
#[derive(Clone, Debug)]
pub(super) struct Inverse {
    now: Small,
    fixed: Small,
    column: Vec<Oct>,
    image: Vec<Oct>,
    /// The lower Cholesky factor, valid if `stiff`.
    factor: Small,
    stiff: bool,
}

/// A solution x, D x and A D x.
#[derive(Clone, Debug)]
pub(super) struct Solution {
    /// The solution x, one number per port.
    pub(super) x: Vec<Oct>,
    /// The scaled solution D x.
    pub(super) scaled: Vec<Oct>,
    /// The product A D x of the matrix and the scaled solution.
    pub(super) image: Vec<Oct>,
}

impl Solution {
    /// Zeros, with room for a number of ports.
    pub(super) fn zeros(ports: usize) -> Self {
        let zeros = vec![[0.0; OCT]; octs(ports)];
        Self { x: zeros.clone(), scaled: zeros.clone(), image: zeros }
    }

    /// Computes D x and A D x from the solution x.
    #[inline(always)]
    fn follow<S: Simd>(&mut self, simd: S, matrix: &Small, scale: &[Oct], ports: usize) {
        for ((scaled, x), scale) in self.scaled.iter_mut().zip(&self.x).zip(scale) {
            for i in 0..registers::<S>() {
                set::<S>(scaled, i, simd.mul_f64s(get::<S>(scale, i), get::<S>(x, i)));
            }
        }
        matrix.product(simd, &self.scaled.as_flattened()[..ports], &mut self.image);
    }
}

impl Inverse {
    /// The inverse for zero ports, with room for `size` ports.
    pub(super) fn new(size: usize) -> Self {
        let vector = vec![[0.0; OCT]; octs(size)];
        Self {
            now: Small::zeros(size),
            fixed: Small::zeros(size),
            column: vector.clone(),
            image: vector,
            factor: Small::zeros(size),
            stiff: false,
        }
    }

    /// Computes the inverse anew for the first `count` ports, which do not change afterwards.
    pub(super) fn fix<S: Simd>(&mut self, simd: S, count: usize, matrix: &Small, scale: &[f64]) {
        self.fixed.clear();
        self.extend(simd, 0..count, matrix, scale);
        self.fixed.cells.copy_from_slice(&self.now.cells);
    }

    /// Computes the inverse for the fixed ports followed by the ports with the given indices.
    #[inline(always)]
    pub(super) fn extend<S: Simd>(&mut self, simd: S, ports: Range<usize>, matrix: &Small, scale: &[f64]) {
        self.now.cells.copy_from_slice(&self.fixed.cells);
        let trace: f64 = (0..ports.end).map(|n| scale[n] * matrix.get(n, n) * scale[n]).sum();
        self.stiff = trace > STIFF;
        if self.stiff {
            (0..ports.end).for_each(|port| self.eliminate(port, matrix, scale));
            return;
        }
        for port in ports {
            self.border(simd, port, matrix, scale);
        }
    }

    /// Solves the system for a right-hand side, one number per port.
    #[inline(always)]
    pub(super) fn solve<S: Simd>(
        &self,
        simd: S,
        (matrix, scale): (&Small, &[Oct]),
        right: &[Oct],
        ports: usize,
        solution: &mut Solution,
    ) {
        if self.stiff {
            self.substitute(&right.as_flattened()[..ports], solution.x.as_flattened_mut());
        } else {
            self.now.product(simd, &right.as_flattened()[..ports], &mut solution.x);
        }
        solution.follow(simd, matrix, scale, ports);
    }

    /// Computes a row of the Cholesky factor.
    fn eliminate(&mut self, n: usize, matrix: &Small, scale: &[f64]) {
        for j in 0..=n {
            let inner: f64 = (0..j).map(|k| self.factor.get(n, k) * self.factor.get(j, k)).sum();
            let entry = scale[n] * matrix.get(n, j) * scale[j] - inner;
            // Never below 1 but by rounding.
            let entry = if j < n { entry / self.factor.get(j, j) } else { (1.0 + entry).max(1.0).sqrt() };
            self.factor.set(n, j, entry);
        }
    }

    /// Solves with the Cholesky factor and its transpose.
    fn substitute(&self, right: &[f64], x: &mut [f64]) {
        for n in 0..right.len() {
            let inner: f64 = (0..n).map(|k| self.factor.get(n, k) * x[k]).sum();
            x[n] = (right[n] - inner) / self.factor.get(n, n);
        }
        for n in (0..right.len()).rev() {
            let inner: f64 = (n + 1..right.len()).map(|k| self.factor.get(k, n) * x[k]).sum();
            x[n] = (x[n] - inner) / self.factor.get(n, n);
        }
    }

    /// Adds one port to the inverse, by bordering.
    #[inline(always)]
    fn border<S: Simd>(&mut self, simd: S, n: usize, matrix: &Small, scale: &[f64]) {
        let column = &mut self.column.as_flattened_mut()[..n];
        for ((j, k), factor) in column.iter_mut().enumerate().zip(scale) {
            *k = factor * matrix.get(j, n) * scale[n];
        }
        let column = &self.column.as_flattened()[..n];
        self.now.product(simd, column, &mut self.image);
        let image = &self.image.as_flattened()[..n];
        let inner: f64 = column.iter().zip(image).map(|(k, w)| k * w).sum();
        let diagonal = 1.0 + scale[n] * matrix.get(n, n) * scale[n];
        // Never below 1 but by rounding.
        let inverse = 1.0 / (diagonal - inner).max(1.0);
        for (cells, w) in self.now.cells.chunks_exact_mut(self.now.size).zip(&self.image) {
            for (cell, other) in cells.iter_mut().zip(image) {
                let factor = simd.splat_f64s(other * inverse);
                for i in 0..registers::<S>() {
                    set::<S>(cell, i, simd.mul_add_e_f64s(get::<S>(w, i), factor, get::<S>(cell, i)));
                }
            }
        }
        for (j, w) in image.iter().enumerate() {
            self.now.set(j, n, -w * inverse);
            self.now.set(n, j, -w * inverse);
        }
        self.now.set(n, n, inverse);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_solve_however_the_inverse_grew() {
        let (n, simd) = (11, pulp::Scalar::new());
        let factor = |i: usize, j: usize| (((3 * i + 5 * j) % 11) as f64 - 5.0) / 5.0;
        for (rank, stiffness) in [(20, 0), (20, 3), (4, 3), (1, 5)] {
            let mut matrix = Small::zeros(n);
            for i in 0..n {
                for j in 0..n {
                    matrix.set(i, j, (0..rank).map(|k| factor(i, k) * factor(j, k)).sum());
                }
            }
            let mut scale = vec![[0.0; OCT]; 2];
            for i in 0..n {
                scale[i / OCT][i % OCT] = 10f64.powi(stiffness * (i as i32 % 3 - 1));
            }
            let flat = scale.as_flattened();
            let mut inverse = Inverse::new(n);
            inverse.fix(simd, 4, &matrix, flat);
            (0..3).for_each(|_| inverse.extend(simd, 4..n, &matrix, flat));
            let mut right = vec![[0.0; OCT]; 2];
            (0..n).for_each(|i| right[i / OCT][i % OCT] = factor(i, 3));
            let mut solution = Solution::zeros(n);
            inverse.solve(simd, (&matrix, &scale), &right, n, &mut solution);
            let x = solution.x.as_flattened();
            for i in 0..n {
                let back = x[i] + (0..n).map(|j| flat[i] * matrix.get(i, j) * flat[j] * x[j]).sum::<f64>();
                let size = (0..n).map(|j| (flat[i] * matrix.get(i, j) * flat[j] * x[j]).abs()).sum::<f64>();
                let right = right[i / OCT][i % OCT];
                let rounding = if inverse.stiff { 1e-14 * (1.0 + size) } else { 1e-11 };
                assert!((back - right).abs() < rounding, "{rank} {i}: {back} {right}");
            }
        }
    }
}
