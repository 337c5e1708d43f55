//! Sums over modes with SIMD instructions.
//!
//! Everything here is inlined into the block loop, which is compiled once for each kind of processor. The order of additions
//! depends on the width of its registers, so that results may differ in their last bits between processors.

use pulp::{Simd, as_arrays};

/// Number of modes processed together: two cache lines. Rows are padded with zeros to a multiple of this;
/// doubled, more zeros are processed.
pub(super) const LANES: usize = 16;

/// One value for each of sixteen modes.
pub(super) type Lanes = [f64; LANES];

/// Alignment of rows in bytes, that of a cache line: reads that cross a cache line take twice as long.
const LINE: usize = 64;

/// Rows of values for each mode, padded with zeros.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    data: Vec<f64>,
    first: usize,
    length: usize,
}

impl Rows {
    /// Rows of zeros, rows x modes.
    pub(super) fn zeros(rows: usize, modes: usize) -> Self {
        let length = modes.next_multiple_of(LANES);
        let data = vec![0.0; rows * length + LINE / size_of::<f64>()];
        let first = data.as_ptr().align_offset(LINE).min(LINE / size_of::<f64>());
        Self { data, first, length }
    }

    /// One row, by its index, padded with zeros.
    #[inline(always)]
    pub(super) fn row(&self, row: usize) -> &[f64] {
        &self.data[self.first + row * self.length..][..self.length]
    }

    /// One row, by its index, mutable.
    #[inline(always)]
    pub(super) fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.data[self.first + row * self.length..][..self.length]
    }

    /// Copies values into a row and pads it with zeros.
    pub(super) fn fill(&mut self, row: usize, values: &[f64]) {
        let row = self.row_mut(row);
        let (head, tail) = row.split_at_mut(values.len().min(row.len()));
        head.iter_mut().zip(values).for_each(|(to, value)| *to = *value);
        tail.fill(0.0);
    }
}

/// Weights stored in columns: the values of sixteen modes for every column, then those of the next sixteen.
#[derive(Clone, Debug)]
pub(super) struct Tiles {
    data: Vec<f64>,
    first: usize,
    groups: usize,
    columns: usize,
}

impl Tiles {
    /// Storage for up to `columns` columns of `modes` weights; no column is in use at first.
    pub(super) fn zeros(columns: usize, modes: usize) -> Self {
        let groups = modes.div_ceil(LANES);
        let data = vec![0.0; groups * columns * LANES + LINE / size_of::<f64>()];
        let first = data.as_ptr().align_offset(LINE).min(LINE / size_of::<f64>());
        Self { data, first, groups, columns: 0 }
    }

    /// Changes the number of columns in use, whose weights must all be set afterwards.
    pub(super) fn resize(&mut self, columns: usize) {
        self.columns = columns;
    }

    /// Number of columns in use.
    #[inline(always)]
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Sets the weights of a column.
    #[inline(always)]
    pub(super) fn set(&mut self, column: usize, row: &[f64]) {
        let size = self.columns * LANES;
        let tiles = self.data[self.first..].chunks_exact_mut(size);
        for (tile, row) in tiles.zip(row.chunks_exact(LANES)) {
            tile[column * LANES..][..LANES].copy_from_slice(row);
        }
    }

    /// All weights: for each group of sixteen modes, column by column.
    #[inline(always)]
    pub(super) fn all(&self) -> &[Lanes] {
        as_arrays::<LANES, _>(&self.data[self.first..][..self.groups * self.columns * LANES]).0
    }
}

/// Adds forces or impulses on columns to the modes: `to[m] += Σ_k w_k[m] amounts[k]`, over the columns from
/// index `first` on.
#[inline(always)]
pub(super) fn gather<S: Simd>(
    simd: S,
    tiles: &[Lanes],
    [columns, first]: [usize; 2],
    amounts: &[f64],
    to: &mut [Lanes],
) {
    // Two groups at a time, so that the processor can work on enough sums in parallel.
    let (pairs, last) = to.split_at_mut(to.len() / 2 * 2);
    let whole = pairs.len() * columns;
    for (tiles, to) in tiles.chunks_exact(2 * columns).zip(pairs.chunks_exact_mut(2)) {
        let (one, other) = tiles.split_at(columns);
        let (mut sum, mut second) = (begun::<S>(simd, &to[0]), begun::<S>(simd, &to[1]));
        for ((one, other), amount) in one[first..].iter().zip(&other[first..]).zip(amounts) {
            let amount = simd.splat_f64s(*amount);
            weigh(simd, one, amount, &mut sum);
            weigh(simd, other, amount, &mut second);
        }
        keep::<S>(&sum, &mut to[0]);
        keep::<S>(&second, &mut to[1]);
    }
    if let [to] = last {
        let mut sum = begun::<S>(simd, to);
        for (weights, amount) in tiles[whole..][first..].iter().zip(amounts) {
            weigh(simd, weights, simd.splat_f64s(*amount), &mut sum);
        }
        keep::<S>(&sum, to);
    }
}

/// Does what [`gather`] does for two arrays of amounts at once: the first acts on all columns, the second
/// on those from index `first` on.
#[inline(always)]
pub(super) fn gather_both<S: Simd>(
    simd: S,
    tiles: &[Lanes],
    [columns, first]: [usize; 2],
    amounts: [&[f64]; 2],
    to: [&mut [Lanes]; 2],
) {
    let [to, second] = to;
    let (plain, rest) = amounts[0].split_at(first);
    for (tile, (to, second)) in tiles.chunks_exact(columns).zip(to.iter_mut().zip(second)) {
        let (struck, loaded) = tile.split_at(first);
        let (mut sum, mut other) = (begun::<S>(simd, to), begun::<S>(simd, second));
        for (weights, amount) in struck.iter().zip(plain) {
            weigh(simd, weights, simd.splat_f64s(*amount), &mut sum);
        }
        for ((weights, amount), force) in loaded.iter().zip(rest).zip(amounts[1]) {
            let (amount, force) = (simd.splat_f64s(*amount), simd.splat_f64s(*force));
            let weights = S::as_simd_f64s(weights).0;
            for i in 0..vectors::<S>() {
                sum[i] = simd.mul_add_e_f64s(weights[i], amount, sum[i]);
                other[i] = simd.mul_add_e_f64s(weights[i], force, other[i]);
            }
        }
        keep::<S>(&sum, to);
        keep::<S>(&other, second);
    }
}

/// Loads sixteen sums into registers.
#[expect(clippy::manual_memcpy, reason = "a copy of slices may be left a call that goes through memory")]
#[inline(always)]
fn begun<S: Simd>(simd: S, from: &Lanes) -> [S::f64s; LANES] {
    let mut sums = [simd.splat_f64s(0.0); LANES];
    let from = S::as_simd_f64s(from).0;
    for i in 0..vectors::<S>() {
        sums[i] = from[i];
    }
    sums
}

/// Stores sixteen sums from registers.
#[expect(clippy::manual_memcpy, reason = "a copy of slices may be left a call that goes through memory")]
#[inline(always)]
fn keep<S: Simd>(sums: &[S::f64s; LANES], to: &mut Lanes) {
    let to = S::as_mut_simd_f64s(to).0;
    for i in 0..vectors::<S>() {
        to[i] = sums[i];
    }
}

#[inline(always)]
fn weigh<S: Simd>(simd: S, weights: &Lanes, amount: S::f64s, sums: &mut [S::f64s; LANES]) {
    let weights = S::as_simd_f64s(weights).0;
    for i in 0..vectors::<S>() {
        sums[i] = simd.mul_add_e_f64s(weights[i], amount, sums[i]);
    }
}

/// Adds the motion of groups of modes to the columns: `sums[k] += Σ_m w_k[m] x[m]`, as sixteen partial sums
/// each; `sums` holds those of the columns from index `first` on.
#[inline(always)]
pub(super) fn accumulate<S: Simd>(
    simd: S,
    tiles: &[Lanes],
    [columns, first]: [usize; 2],
    x: &[Lanes],
    sums: &mut [Lanes],
) {
    let mut pairs = sums.chunks_exact_mut(2);
    let mut column = first;
    for to in &mut pairs {
        let (mut sum, mut second) = (begun::<S>(simd, &to[0]), begun::<S>(simd, &to[1]));
        for (tile, x) in tiles.chunks_exact(columns).zip(x) {
            if let [one, other] = &tile[column..column + 2] {
                let (one, other) = (S::as_simd_f64s(one).0, S::as_simd_f64s(other).0);
                let x = S::as_simd_f64s(x).0;
                for i in 0..vectors::<S>() {
                    sum[i] = simd.mul_add_e_f64s(one[i], x[i], sum[i]);
                    second[i] = simd.mul_add_e_f64s(other[i], x[i], second[i]);
                }
            }
        }
        keep::<S>(&sum, &mut to[0]);
        keep::<S>(&second, &mut to[1]);
        column += 2;
    }
    if let [to] = pairs.into_remainder() {
        let mut sum = begun::<S>(simd, to);
        for (tile, x) in tiles.chunks_exact(columns).zip(x) {
            let (weights, x) = (S::as_simd_f64s(&tile[column]).0, S::as_simd_f64s(x).0);
            for i in 0..vectors::<S>() {
                sum[i] = simd.mul_add_e_f64s(weights[i], x[i], sum[i]);
            }
        }
        keep::<S>(&sum, to);
    }
}

/// Does what [`accumulate`] does for two kinds of motion (m and m/s) and their sums at once.
#[inline(always)]
pub(super) fn accumulate_both<S: Simd>(
    simd: S,
    tiles: &[Lanes],
    [columns, first]: [usize; 2],
    x: [&[Lanes]; 2],
    sums: [&mut [Lanes]; 2],
) {
    let [firsts, seconds] = sums;
    let (mut ones, mut others) = (firsts.chunks_exact_mut(2), seconds.chunks_exact_mut(2));
    let mut column = first;
    for (to, too) in (&mut ones).zip(&mut others) {
        let (mut sum, mut second) = (begun::<S>(simd, &to[0]), begun::<S>(simd, &to[1]));
        let (mut third, mut fourth) = (begun::<S>(simd, &too[0]), begun::<S>(simd, &too[1]));
        for (tile, (x, y)) in tiles.chunks_exact(columns).zip(x[0].iter().zip(x[1])) {
            if let [one, other] = &tile[column..column + 2] {
                let (one, other) = (S::as_simd_f64s(one).0, S::as_simd_f64s(other).0);
                let (x, y) = (S::as_simd_f64s(x).0, S::as_simd_f64s(y).0);
                for i in 0..vectors::<S>() {
                    sum[i] = simd.mul_add_e_f64s(one[i], x[i], sum[i]);
                    second[i] = simd.mul_add_e_f64s(other[i], x[i], second[i]);
                    third[i] = simd.mul_add_e_f64s(one[i], y[i], third[i]);
                    fourth[i] = simd.mul_add_e_f64s(other[i], y[i], fourth[i]);
                }
            }
        }
        keep::<S>(&sum, &mut to[0]);
        keep::<S>(&second, &mut to[1]);
        keep::<S>(&third, &mut too[0]);
        keep::<S>(&fourth, &mut too[1]);
        column += 2;
    }
    accumulate(simd, tiles, [columns, column], x[0], ones.into_remainder());
    accumulate(simd, tiles, [columns, column], x[1], others.into_remainder());
}

/// Adds the motion of groups of modes to the partial sums of a single row of weights, like [`accumulate`].
#[inline(always)]
pub(super) fn read_out<S: Simd>(simd: S, row: &[Lanes], x: &[Lanes], to: &mut Lanes) {
    let mut sum = begun::<S>(simd, to);
    for (weights, x) in row.iter().zip(x) {
        let (weights, x) = (S::as_simd_f64s(weights).0, S::as_simd_f64s(x).0);
        for i in 0..vectors::<S>() {
            sum[i] = simd.mul_add_e_f64s(weights[i], x[i], sum[i]);
        }
    }
    keep::<S>(&sum, to);
}

/// Adds up the partial sums of [`accumulate`]: one number per column.
#[inline(always)]
pub(super) fn total<S: Simd>(simd: S, sums: &[Lanes], out: &mut [f64]) {
    for (out, sum) in out.iter_mut().zip(sums) {
        let parts = S::as_simd_f64s(sum).0;
        let mut sum = parts[0];
        for part in &parts[1..vectors::<S>()] {
            sum = simd.add_f64s(sum, *part);
        }
        *out = simd.reduce_sum_f64s(sum);
    }
}

/// Number of registers that hold sixteen values.
#[inline(always)]
pub(super) fn vectors<S: Simd>() -> usize {
    LANES / S::F64_LANES
}

/// The sum `Σ_m first[m] second[m]`, and that sum with each of two factors:
/// `Σ_m first[m] second[m] factor[m]`.
#[inline(always)]
pub(super) fn grams<S: Simd>(simd: S, first: &[f64], second: &[f64], factors: [&[f64]; 2]) -> [f64; 3] {
    let [first, second] = [first, second].map(|row| S::as_simd_f64s(row).0);
    let [strike, push] = factors.map(|row| S::as_simd_f64s(row).0);
    let mut sums = [simd.splat_f64s(0.0); 3];
    for ((first, second), (strike, push)) in first.iter().zip(second).zip(strike.iter().zip(push)) {
        let product = simd.mul_f64s(*first, *second);
        sums[0] = simd.add_f64s(sums[0], product);
        sums[1] = simd.mul_add_e_f64s(product, *strike, sums[1]);
        sums[2] = simd.mul_add_e_f64s(product, *push, sums[2]);
    }
    sums.map(|sum| simd.reduce_sum_f64s(sum))
}
