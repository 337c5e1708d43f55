//! Pencils whose eigenvalues are known, and checks of what is found.

mod exact;
mod faults;
mod random;

use super::{Pairs, below, count_below};
use unripple_core::Observed;
use unripple_linalg::sparse::{SparseColMat, Triplet};
use unripple_linalg::{product, sparse_times};

type Sparse = SparseColMat<usize, f64>;

/// Entries of a matrix by row and column; those at the same place add up.
#[derive(Clone)]
struct Entries {
    n: usize,
    list: Vec<(usize, usize, f64)>,
}

impl Entries {
    fn identity(n: usize) -> Self {
        Self { n, list: (0..n).map(|i| (i, i, 1.0)).collect() }
    }

    /// Second differences times -1, on `n` places between two that are held, or whose ends are free.
    fn second_difference(n: usize, free: bool) -> Self {
        let mut list: Vec<(usize, usize, f64)> = (0..n).map(|i| (i, i, 2.0)).collect();
        list.extend((1..n).flat_map(|i| [(i, i - 1, -1.0), (i - 1, i, -1.0)]));
        if free {
            list.extend([(0, 0, -1.0), (n - 1, n - 1, -1.0)]);
        }
        Self { n, list }
    }

    fn scaled(mut self, factor: f64) -> Self {
        self.list.iter_mut().for_each(|(.., v)| *v *= factor);
        self
    }

    fn plus(mut self, other: Self) -> Self {
        self.list.extend(other.list);
        self
    }

    /// The Kronecker product.
    fn times(&self, other: &Self) -> Self {
        let pairs = self.list.iter().flat_map(|a| other.list.iter().map(move |b| (a, b)));
        let list = pairs.map(|(a, b)| (a.0 * other.n + b.0, a.1 * other.n + b.1, a.2 * b.2)).collect();
        Self { n: self.n * other.n, list }
    }

    fn matrix(&self) -> Sparse {
        let triplets: Vec<_> = self.list.iter().map(|(i, j, v)| Triplet::new(*i, *j, *v)).collect();
        SparseColMat::try_new_from_triplets(self.n, self.n, &triplets).expect("entries within the matrix")
    }
}

/// Eigenvalues of [`Entries::second_difference`], ascending.
fn second_differences(n: usize, free: bool) -> Vec<f64> {
    let step = if free { 1.0 / n as f64 } else { 1.0 / (n + 1) as f64 };
    let first = usize::from(!free);
    (first..n + first).map(|i| 4.0 * (0.5 * std::f64::consts::PI * i as f64 * step).sin().powi(2)).collect()
}

/// All sums of one of `a` and one of `b`.
fn sums(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().flat_map(|a| b.iter().map(move |b| a + b)).collect()
}

/// Those below a bound, ascending.
fn ascending(mut values: Vec<f64>, top: f64) -> Vec<f64> {
    values.retain(|v| *v < top);
    values.sort_by(f64::total_cmp);
    values
}

/// A bound near a value, in the widest of some spaces between values there.
fn bound_near(values: &[f64], near: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = sorted.partition_point(|v| *v < near).clamp(1, sorted.len() - 1);
    let spaces = sorted[at - 1..sorted.len().min(at + 40)].windows(2);
    let widest = spaces.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    widest.map_or(near, |w| 0.5 * (w[0] + w[1]))
}

/// Finds all below a bound and compares with what is expected: values relatively, but not below `floor`.
fn check(stiffness: &Sparse, mass: &Sparse, top: f64, expected: &[f64], tolerance: f64, floor: f64) -> Pairs {
    assert_eq!(count_below(stiffness.as_ref(), mass.as_ref(), top), Ok(expected.len()));
    let pairs = below(stiffness.as_ref(), mass.as_ref(), top, &Observed::default()).expect("eigenpairs");
    assert_eq!(pairs.values.len(), expected.len());
    let worst = pairs.values.iter().zip(expected).map(|(a, b)| (a - b).abs() / b.abs().max(floor));
    let worst = worst.fold(0.0, f64::max);
    assert!(worst < tolerance, "values off by {worst:e}");
    assert!(pairs.residual < 1e-8, "residual {:e}", pairs.residual);
    let off = disorder(mass, &pairs);
    assert!(off < 1e-8, "orthonormal to {off:e}");
    pairs
}

/// Largest entry of XᵀMX - 1.
fn disorder(mass: &Sparse, pairs: &Pairs) -> f64 {
    let weighed = sparse_times(mass.as_ref(), pairs.vectors.as_ref());
    let gram = product(pairs.vectors.transpose(), weighed.as_ref());
    let mut worst = 0.0_f64;
    for i in 0..gram.nrows() {
        for j in 0..gram.ncols() {
            worst = worst.max((gram[(i, j)] - f64::from(i == j)).abs());
        }
    }
    worst
}
