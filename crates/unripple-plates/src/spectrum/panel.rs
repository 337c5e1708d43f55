//! Panels of [`LANES`] vectors stored row by row, so that one entry of a matrix acts on all of them at
//! once.

use pulp::{Arch, NullaryFnOnce};

/// Number of vectors of a panel: a 512-bit register holds as many f64. With twice this value, a matrix is read half as often, and bases
/// grow in coarser steps than needed.
pub(super) const LANES: usize = 8;

/// One entry of each vector of a panel.
pub(super) type Row = [f64; LANES];

/// A block of [`LANES`] vectors, row by row.
pub(super) type Panel = Vec<Row>;

/// A small matrix that relates two panels, row by row.
pub(super) type Square = [Row; LANES];

/// A row of zeros, the starting value of sums.
pub(super) const NONE: Row = [0.0; LANES];

/// Number of rows of a panel that stay in the first-level cache: 8 KiB of each of two panels. With twice this value, results
/// stay the same except for rounding.
const CHUNK: usize = 128;

/// Number of rows processed at once, so that their sums stay in registers: eight of AVX2's sixteen. With twice this value,
/// they would take all.
pub(super) const TILE: usize = 4;

/// Adds a row times a factor: sum ← sum + factor · row.
#[inline(always)]
pub(super) fn add(sum: &mut Row, factor: f64, row: &Row) {
    for (s, r) in sum.iter_mut().zip(row) {
        *s = factor.mul_add(*r, *s);
    }
}

/// Gram matrices XᵀZ of each panel X with the panel Z, each lanes x lanes.
pub(super) fn project<'a>(arch: Arch, panels: impl IntoIterator<Item = &'a Panel>, z: &[Row]) -> Vec<Square> {
    let panels: Vec<&Panel> = panels.into_iter().collect();
    arch.dispatch(Project { panels: &panels, z })
}

/// Subtracts combinations of panels: W ← W - Σ X C over the given panels X and factors C.
pub(super) fn subtract(arch: Arch, panels: &[Panel], factors: &[Square], w: &mut [Row]) {
    arch.dispatch(Subtract { panels, factors, w });
}

/// Replaces W by W C, a panel times a small matrix.
pub(super) fn transform(arch: Arch, factor: &Square, w: &mut [Row]) {
    arch.dispatch(Transform { factor, w });
}

struct Project<'a> {
    panels: &'a [&'a Panel],
    z: &'a [Row],
}

impl NullaryFnOnce for Project<'_> {
    type Output = Vec<Square>;

    #[inline(always)]
    fn call(self) -> Vec<Square> {
        let mut out = vec![[NONE; LANES]; self.panels.len()];
        for (chunk, z) in self.z.chunks(CHUNK).enumerate() {
            for (panel, out) in self.panels.iter().zip(&mut out) {
                add_product(&panel[chunk * CHUNK..][..z.len()], z, out);
            }
        }
        out
    }
}

/// Adds the product of two panels to a small matrix: C ← C + XᵀZ.
#[inline(always)]
fn add_product(x: &[Row], z: &[Row], out: &mut Square) {
    for (tile, out) in out.chunks_exact_mut(TILE).enumerate() {
        let mut sums = [NONE; TILE];
        for (x, z) in x.iter().zip(z) {
            for (t, sum) in sums.iter_mut().enumerate() {
                add(sum, x[tile * TILE + t], z);
            }
        }
        for (out, sum) in out.iter_mut().zip(&sums) {
            add(out, 1.0, sum);
        }
    }
}

struct Subtract<'a> {
    panels: &'a [Panel],
    factors: &'a [Square],
    w: &'a mut [Row],
}

impl NullaryFnOnce for Subtract<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (chunk, w) in self.w.chunks_mut(CHUNK).enumerate() {
            for (panel, factor) in self.panels.iter().zip(self.factors) {
                subtract_product(&panel[chunk * CHUNK..][..w.len()], factor, w);
            }
        }
    }
}

/// Subtracts a combination of one panel: W ← W - X C.
#[inline(always)]
fn subtract_product(x: &[Row], factor: &Square, w: &mut [Row]) {
    let (rows, last_rows) = x.as_chunks::<TILE>();
    let (tiles, last) = w.as_chunks_mut::<TILE>();
    for (w, x) in tiles.iter_mut().zip(rows) {
        let mut sums = *w;
        for (lane, factor) in factor.iter().enumerate() {
            for (sum, x) in sums.iter_mut().zip(x) {
                add(sum, -x[lane], factor);
            }
        }
        *w = sums;
    }
    for (w, x) in last.iter_mut().zip(last_rows) {
        for (x, factor) in x.iter().zip(factor) {
            add(w, -x, factor);
        }
    }
}

struct Transform<'a> {
    factor: &'a Square,
    w: &'a mut [Row],
}

impl NullaryFnOnce for Transform<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for w in self.w {
            let mut sum = NONE;
            for (x, factor) in w.iter().zip(self.factor) {
                add(&mut sum, *x, factor);
            }
            *w = sum;
        }
    }
}

const _: () = assert!(LANES.is_multiple_of(TILE));
