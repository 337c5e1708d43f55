//! The matrix pencil K x = λ M x, scaled and ordered for factorisation.

use super::error::{SpectrumError, indefinite};
use super::panel::{NONE, Row, add};
use pulp::{Arch, NullaryFnOnce};
use unripple_linalg::sparse::{
    SparseColMatRef, SymbolicCholesky, SymbolicCholeskyRaw, SymbolicSparseColMat, SymbolicSupernodalCholesky,
    analyse,
};

/// The pencil K x = λ M x with its unknowns scaled and ordered: K ← SPᵀKPS, and M likewise.
///
/// S scales the diagonal of M to about one, by powers of two, so that scaling causes no rounding errors. P keeps the factors of
/// K - σM sparse (approximate minimum degree).
#[derive(Debug)]
pub(super) struct Pencil {
    /// Original index of the unknown in each position of the new order.
    pub(super) order: Vec<usize>,
    /// The scale factors S, in the new order.
    pub(super) scale: Vec<f64>,
    /// The lower triangles of K and M, with a common sparsity pattern.
    pub(super) lower: Lower,
    /// All entries of M, row by row.
    rows: Rows,
    symbolic: SymbolicCholesky<usize>,
    /// The SIMD instruction set of the processor.
    pub(super) arch: Arch,
}

/// Lower triangles of two symmetric matrices, column by column.
#[derive(Debug)]
pub(super) struct Lower {
    /// The common sparsity pattern of both matrices.
    pub(super) pattern: SymbolicSparseColMat<usize>,
    /// Entries of K, in the pattern's order.
    pub(super) stiffness: Vec<f64>,
    /// Entries of M, in the pattern's order.
    pub(super) mass: Vec<f64>,
}

#[derive(Debug)]
struct Rows {
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Pencil {
    /// The pencil of two matrices that are given with both triangles; only entries on or below the diagonal
    /// in the new order are read.
    ///
    /// # Errors
    /// [`SpectrumError::Matrices`] unless both are square, of equal size and finite, and M's diagonal is positive.
    pub(super) fn new(
        stiffness: SparseColMatRef<usize, f64>,
        mass: SparseColMatRef<usize, f64>,
    ) -> Result<Self, SpectrumError> {
        check(stiffness, mass)?;
        let n = stiffness.nrows();
        let given: Vec<usize> = (0..n).collect();
        let unscaled = Lower::new(stiffness, mass, &given, &vec![1.0; n])?;
        let diagonal: Vec<f64> = (0..n).map(|j| unscaled.mass[unscaled.pattern.col_ptr()[j]]).collect();
        if let Some(bad) = diagonal.iter().find(|d| **d <= 0.0) {
            return Err(indefinite(*bad));
        }
        let symbolic = analyse(unscaled.pattern.as_ref()).ok_or_else(|| too_large(n))?;
        let order = symbolic.perm().map_or(given, |p| p.arrays().0.to_vec());
        let scale: Vec<f64> = order.iter().map(|i| (-0.5 * diagonal[*i].log2()).round().exp2()).collect();
        let lower = Lower::new(stiffness, mass, &order, &scale)?;
        let rows = lower.mass_rows();
        Ok(Self { order, scale, lower, rows, symbolic, arch: Arch::new() })
    }

    /// Number of unknowns n: the size of both matrices.
    pub(super) fn len(&self) -> usize {
        self.order.len()
    }

    /// The supernodal structure of the factors, n x n.
    pub(super) fn supernodes(&self) -> Result<&SymbolicSupernodalCholesky<usize>, SpectrumError> {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(supernodes) => Ok(supernodes),
            SymbolicCholeskyRaw::Simplicial(_) => Err(self.too_large()),
        }
    }

    /// Number of bytes of the factors at one shift.
    pub(super) fn factor_bytes(&self) -> usize {
        self.supernodes().map_or(0, |s| s.len_val() * size_of::<f64>())
    }

    /// The error for factors that do not fit into memory.
    pub(super) fn too_large(&self) -> SpectrumError {
        too_large(self.len())
    }

    /// The product Z = M W, rows x lanes.
    pub(super) fn weigh(&self, w: &[Row], z: &mut [Row]) {
        self.arch.dispatch(Weigh { rows: &self.rows, w, z });
    }
}

struct Weigh<'a> {
    rows: &'a Rows,
    w: &'a [Row],
    z: &'a mut [Row],
}

impl NullaryFnOnce for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (z, ends) in self.z.iter_mut().zip(self.rows.starts.windows(2)) {
            let mut sum = NONE;
            let columns = &self.rows.columns[ends[0]..ends[1]];
            for (j, m) in columns.iter().zip(&self.rows.values[ends[0]..ends[1]]) {
                add(&mut sum, *m, &self.w[*j as usize]);
            }
            *z = sum;
        }
    }
}

impl Lower {
    /// The entries of both matrices on and below the diagonal in the new order.
    fn new(
        stiffness: SparseColMatRef<usize, f64>,
        mass: SparseColMatRef<usize, f64>,
        order: &[usize],
        scale: &[f64],
    ) -> Result<Self, SpectrumError> {
        let n = order.len();
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(new, old)| place[*old] = new);
        let (mut starts, mut rows) = (vec![0], Vec::new());
        let (mut k, mut m) = (Vec::new(), Vec::new());
        let mut column: Vec<(usize, f64, f64)> = Vec::new();
        for (j, old) in order.iter().enumerate() {
            column.clear();
            let below = |i: &usize| place[*i] >= j;
            let stiff = stiffness.row_idx_of_col(*old).zip(stiffness.val_of_col(*old));
            let heavy = mass.row_idx_of_col(*old).zip(mass.val_of_col(*old));
            column.push((j, 0.0, 0.0));
            column.extend(stiff.filter(|(i, _)| below(i)).map(|(i, v)| (place[i], *v, 0.0)));
            column.extend(heavy.filter(|(i, _)| below(i)).map(|(i, v)| (place[i], 0.0, *v)));
            column.sort_unstable_by_key(|(i, ..)| *i);
            for same in column.chunk_by(|a, b| a.0 == b.0) {
                let (i, factor) = (same[0].0, scale[same[0].0] * scale[j]);
                rows.push(i);
                k.push(factor * same.iter().map(|(_, v, _)| v).sum::<f64>());
                m.push(factor * same.iter().map(|(.., v)| v).sum::<f64>());
            }
            starts.push(rows.len());
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        Ok(Self { pattern, stiffness: k, mass: m })
    }

    /// All entries of M, row by row, from its lower triangle.
    fn mass_rows(&self) -> Rows {
        let n = self.pattern.ncols();
        let lower = || {
            (0..n).flat_map(move |j| {
                self.pattern.col_range(j).map(move |at| (self.pattern.row_idx()[at], j, self.mass[at]))
            })
        };
        let mut starts = vec![0; n + 1];
        for (i, j, m) in lower() {
            if m != 0.0 {
                starts[i + 1] += 1;
                starts[j + 1] += usize::from(i != j);
            }
        }
        (0..n).for_each(|i| starts[i + 1] += starts[i]);
        let mut next = starts.clone();
        let (mut columns, mut values) = (vec![0; starts[n]], vec![0.0; starts[n]]);
        let mut put = |i: usize, j: usize, m: f64| {
            columns[next[i]] = j as u32;
            values[next[i]] = m;
            next[i] += 1;
        };
        for (i, j, m) in lower() {
            if m != 0.0 {
                put(i, j, m);
                if i != j {
                    put(j, i, m);
                }
            }
        }
        Rows { starts, columns, values }
    }
}

fn check(
    stiffness: SparseColMatRef<usize, f64>,
    mass: SparseColMatRef<usize, f64>,
) -> Result<(), SpectrumError> {
    let n = stiffness.nrows();
    for matrix in [stiffness, mass] {
        if (matrix.nrows(), matrix.ncols()) != (n, n) {
            return Err(SpectrumError::Matrices {
                what: "size of a matrix",
                expected: format!("{n} x {n}"),
                found: format!("{} x {}", matrix.nrows(), matrix.ncols()),
            });
        }
        if let Some(bad) = (0..n).flat_map(|j| matrix.val_of_col(j)).find(|v| !v.is_finite()) {
            return Err(SpectrumError::Matrices {
                what: "entry of a matrix",
                expected: "a finite number".to_owned(),
                found: bad.to_string(),
            });
        }
    }
    if n >= u32::MAX as usize { Err(too_large(n)) } else { Ok(()) }
}

fn too_large(n: usize) -> SpectrumError {
    SpectrumError::Matrices {
        what: "unknowns",
        expected: "as many as memory and indices hold".to_owned(),
        found: n.to_string(),
    }
}
