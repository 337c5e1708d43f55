//! Sparse supernodal LDLᵀ factor, and Sylvester's inertia count.

use super::SpectrumError;
use super::panel::TILE;
use super::pencil::Pencil;
use unripple_linalg::Par;
use unripple_linalg::sparse::{
    SparseColMatRef, SupernodalLdltRef, SymbolicSupernodalCholesky, Unfactored, factor_ldlt,
};

/// The factors of K - σM = L D Lᵀ, without pivoting other than the pencil's ordering.
#[derive(Debug)]
pub(super) struct Factor<'a> {
    /// The shift σ.
    pub(super) shift: f64,
    /// Number of negative pivots: by Sylvester's law of inertia, the number of eigenvalues below σ.
    pub(super) below: usize,
    /// Largest ratio, over the diagonal, of |L||D||Lᵀ| to the matrix: the factor by which the factorisation
    /// amplifies rounding errors.
    pub(super) growth: f64,
    /// L and D, supernode by supernode.
    pub(super) nodes: Nodes<'a>,
}

/// The factors L and D supernode by supernode, each in tiles of rows, so that solving reads memory once
/// forwards and once backwards.
#[derive(Debug)]
pub(super) struct Nodes<'a> {
    supernodes: &'a SymbolicSupernodalCholesky<usize>,
    tiles: Vec<[f64; TILE]>,
    /// Index where each supernode's tiles start.
    starts: Vec<usize>,
    inverse_pivots: Vec<f64>,
}

/// One supernode: neighbouring columns of L with a common pattern of rows.
pub(super) struct Node<'a> {
    /// Index of the supernode's first column.
    pub(super) start: usize,
    /// Number of columns in the supernode.
    pub(super) width: usize,
    /// Indices of the supernode's rows below its triangle.
    pub(super) pattern: &'a [usize],
    /// The supernode's unit triangle: the tile of rows 4t to 4t + 3 has 4t + 4 columns.
    pub(super) top: &'a [[f64; TILE]],
    /// The rows below the triangle; each tile has all columns.
    pub(super) below: &'a [[f64; TILE]],
    /// Inverses 1/D of the pivots, one per column.
    pub(super) inverse_pivots: &'a [f64],
}

impl<'a> Factor<'a> {
    /// Factors K - σM at one shift σ (in λ's unit, 1/s²); `None` if a pivot is zero or not finite.
    ///
    /// # Errors
    /// [`SpectrumError::Matrices`] if memory does not hold them.
    pub(super) fn new(pencil: &'a Pencil, shift: f64, par: Par) -> Result<Option<Self>, SpectrumError> {
        let supernodes = pencil.supernodes()?;
        let lower = &pencil.lower;
        let shifted: Vec<f64> = lower.stiffness.iter().zip(&lower.mass).map(|(k, m)| k - shift * m).collect();
        let matrix = SparseColMatRef::new(lower.pattern.as_ref(), &shifted);
        let values = match factor_ldlt(supernodes, matrix, par) {
            Ok(values) => values,
            Err(Unfactored::Pivot) => return Ok(None),
            Err(Unfactored::Memory) => return Err(pencil.too_large()),
        };
        let factor = SupernodalLdltRef::new(supernodes, &values);
        let starts = &lower.pattern.col_ptr()[..pencil.len()];
        let sizes = starts.iter().map(|at| lower.stiffness[*at] + shift.abs() * lower.mass[*at]);
        let Some((below, growth)) = pivots(factor, &sizes.collect::<Vec<_>>()) else { return Ok(None) };
        Ok(Some(Self { shift, below, growth, nodes: Nodes::new(supernodes, factor) }))
    }
}

/// Number of negative pivots, and the largest ratio on the diagonal of |L||D||Lᵀ| to `diagonal`; `None` if
/// a pivot is zero or not finite.
fn pivots(factor: SupernodalLdltRef<usize, f64>, diagonal: &[f64]) -> Option<(usize, f64)> {
    let mut below = 0;
    let mut sizes = vec![0.0; diagonal.len()];
    for s in 0..factor.symbolic().n_supernodes() {
        let node = factor.supernode(s);
        let columns = node.val();
        let width = columns.ncols();
        for (j, column) in columns.col_iter().enumerate() {
            let pivot = column[j];
            if pivot == 0.0 || !pivot.is_finite() {
                return None;
            }
            below += usize::from(pivot < 0.0);
            sizes[node.start() + j] += pivot.abs();
            let places = (node.start() + j + 1..node.start() + width).chain(node.pattern().iter().copied());
            for (i, l) in places.zip(column.subrows(j + 1, column.nrows() - j - 1).iter()) {
                sizes[i] += l * l * pivot.abs();
            }
        }
    }
    let growth = sizes.iter().zip(diagonal).map(|(size, d)| size / d.abs().max(f64::MIN_POSITIVE));
    Some((below, growth.fold(0.0, f64::max)))
}

impl<'a> Nodes<'a> {
    /// Copies a factor, which is stored column by column, into tiles of rows.
    fn new(supernodes: &'a SymbolicSupernodalCholesky<usize>, factor: SupernodalLdltRef<usize, f64>) -> Self {
        let mut tiles = Vec::with_capacity(factor.values().len().div_ceil(TILE) * 9 / 8);
        let (mut starts, mut inverse_pivots) = (Vec::new(), Vec::new());
        for s in 0..supernodes.n_supernodes() {
            starts.push(tiles.len());
            let columns = factor.supernode(s).val();
            let (height, width) = columns.shape();
            for first in (0..width).step_by(TILE) {
                let high = TILE.min(width - first);
                tiles.extend((0..first + TILE).map(|j| {
                    let mut tile = [0.0; TILE];
                    if j < width {
                        for (t, l) in tile[..high].iter_mut().enumerate() {
                            *l = columns[(first + t, j)];
                        }
                    }
                    tile
                }));
            }
            for first in (width..height).step_by(TILE) {
                let high = TILE.min(height - first);
                tiles.extend(columns.subrows(first, high).col_iter().map(|column| {
                    let mut tile = [0.0; TILE];
                    tile.iter_mut().zip(column.iter()).for_each(|(l, v)| *l = *v);
                    tile
                }));
            }
            inverse_pivots.extend((0..width).map(|j| 1.0 / columns[(j, j)]));
        }
        starts.push(tiles.len());
        Self { supernodes, tiles, starts, inverse_pivots }
    }

    /// Number of supernodes.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The supernode with index `s`.
    #[inline(always)]
    pub(super) fn at(&self, s: usize) -> Node<'_> {
        let start = self.supernodes.supernode_begin()[s];
        let width = self.supernodes.supernode_end()[s] - start;
        let pattern = self.supernodes.supernode(s).pattern();
        let count = width.div_ceil(TILE);
        let (top, below) =
            self.tiles[self.starts[s]..self.starts[s + 1]].split_at(TILE * count * (count + 1) / 2);
        let inverse_pivots = &self.inverse_pivots[start..start + width];
        Node { start, width, pattern, top, below, inverse_pivots }
    }
}
