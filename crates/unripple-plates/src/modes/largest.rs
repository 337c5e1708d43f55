//! The largest eigenvalues of a dense symmetric matrix, by block Lanczos iteration.

use super::eigen::{Method, product, symmetric};
use unripple_core::Random;
use unripple_linalg::{Accum, Cholesky, Mat, MatMut, MatRef, Par, multiply, solve_lower_alone};

/// Number of vectors in a block. With twice this value, there are half as many products, of matrices that are no faster to multiply, and
/// more vectors than needed at the end.
const BLOCK: usize = 32;

/// Number of blocks from one look at the eigenvalues to the next. With twice this value, half as many small problems are solved, and up to
/// four blocks more are computed than needed.
const PATIENCE: usize = 4;

/// Largest residual |Ax - θx| of an eigenpair, relative to θ. Rounding is some 1e-15; ten times more would be seen in the last digits of
/// mode shapes.
const RESIDUAL: f64 = 1e-12;

/// Largest relative residual of the first eigenvalue below the bound: it has been separated from those above, so that none of them is
/// still on its way. Smaller, more blocks are computed for a vector that is not needed.
const BEYOND: f64 = 1e-3;

/// Part of all vectors beyond which a full decomposition takes less time than the iteration.
const LARGEST_PART: usize = 3;

/// All eigenvalues of at least `least` of a symmetric n x n matrix, descending, and their orthonormal vectors, n x pairs.
///
/// The Krylov space of 32 random vectors is enlarged, with all of it kept orthonormal, until the residuals of these pairs are rounding
/// (Golub and Van Loan, *Matrix Computations*, 2013, section 10.3.6). The time is that of some products with the matrix, where a full
/// decomposition passes through it once for each row.
///
/// `None` if that takes more than a third of all n vectors, or they become dependent: a full decomposition is then the better choice.
pub(super) fn largest(matrix: MatRef<'_, f64>, least: f64, par: Par) -> Option<(Vec<f64>, Mat<f64>)> {
    let n = matrix.nrows();
    let most = n / LARGEST_PART / BLOCK;
    let mut random = Random::seeded(1);
    let start = Mat::from_fn(n, BLOCK, |_, _| random.normal());
    let mut basis = Mat::zeros(n, (most + 1) * BLOCK);
    // The matrix between the vectors of the basis, its upper triangle.
    let mut projected = Mat::zeros((most + 1) * BLOCK, (most + 1) * BLOCK);
    let mut block = product(matrix, start.as_ref(), par);
    orthonormalise(&mut block)?;
    let mut next = PATIENCE;
    for j in 0..most {
        let (from, to) = (j * BLOCK, (j + 1) * BLOCK);
        basis.as_mut().subcols_mut(from, BLOCK).copy_from(&block);
        block = product(matrix, block.as_ref(), par);
        let known = basis.as_ref().subcols(0, to);
        let along = removed(known, block.as_mut(), par);
        removed(known, block.as_mut(), par);
        let left = orthonormalise(&mut block)?;
        projected.as_mut().submatrix_mut(0, from, to, BLOCK).copy_from(&along);
        if j + 1 < next {
            continue;
        }
        let inner = projected.as_ref().submatrix(0, 0, to, to);
        let (values, vectors) = symmetric(inner.transpose(), Method::Exact)?;
        let ends = product(left.as_ref(), vectors.as_ref().subrows(from, BLOCK), Par::Seq);
        let residual = |k: usize| ends.col(k).iter().map(|v| v * v).sum::<f64>().sqrt() / values[k];
        let first = values.partition_point(|value| *value < least);
        let separated = first > 0 && values[first - 1] > 0.0 && residual(first - 1) < BEYOND;
        if separated && (first..to).all(|k| residual(k) < RESIDUAL) {
            let wanted: Vec<usize> = (first..to).rev().collect();
            let chosen = Mat::from_fn(to, wanted.len(), |i, k| vectors[(i, wanted[k])]);
            let values = wanted.iter().map(|k| values[*k]).collect();
            return Some((values, product(basis.as_ref().subcols(0, to), chosen.as_ref(), par)));
        }
        // A basis of fewer than one and a half times as many vectors has never all of them.
        next = (j + 1 + PATIENCE).max((to - first) * 3 / 2 / BLOCK);
        if next > most {
            return None;
        }
    }
    None
}

/// Removes from the columns of `block` their parts along an orthonormal basis, and returns these parts, basis x columns.
fn removed(basis: MatRef<'_, f64>, block: MatMut<'_, f64>, par: Par) -> Mat<f64> {
    let along = product(basis.transpose(), block.as_ref(), par);
    multiply(block, Accum::Add, basis, along.as_ref(), -1.0, par);
    along
}

/// Makes the columns of a block X orthonormal, Q, and returns R with X = QR; `None` if the columns are dependent.
///
/// Twice by the Cholesky factor of the columns' products, since once leaves an error as the square of their condition (Yamamoto,
/// Nakatsukasa, Yanagisawa and Fukaya, *Electron. Trans. Numer. Anal.* 44, 306, 2015).
fn orthonormalise(block: &mut Mat<f64>) -> Option<Mat<f64>> {
    let norms: Vec<f64> = block.col_iter().map(|x| x.iter().map(|v| v * v).sum::<f64>().sqrt()).collect();
    for (column, norm) in block.as_mut().col_iter_mut().zip(&norms) {
        column.iter_mut().for_each(|v| *v /= norm);
    }
    let mut whole = Mat::from_fn(norms.len(), norms.len(), |i, j| if i == j { norms[i] } else { 0.0 });
    for _ in 0..2 {
        let gram = product(block.transpose(), block.as_ref(), Par::Seq);
        let factor = Cholesky::new(gram.as_ref())?;
        let mut rows = block.transpose().to_owned();
        solve_lower_alone(factor.lower(), rows.as_mut());
        *block = rows.transpose().to_owned();
        whole = product(factor.lower().transpose(), whole.as_ref(), Par::Seq);
    }
    Some(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix whose eigenvalues are given, with vectors from a random reflection.
    fn matrix(values: &[f64]) -> Mat<f64> {
        let mut random = Random::seeded(3);
        let along: Vec<f64> = values.iter().map(|_| random.normal()).collect();
        let square: f64 = along.iter().map(|v| v * v).sum();
        let n = values.len();
        let reflect = Mat::from_fn(n, n, |i, j| f64::from(i == j) - 2.0 * along[i] * along[j] / square);
        let scaled = Mat::from_fn(n, n, |i, j| reflect[(i, j)] * values[j]);
        product(scaled.as_ref(), reflect.transpose(), Par::Seq)
    }

    #[test]
    fn the_largest_are_found_with_their_vectors() {
        // As of an inverse: many orders of magnitude, and a few that are equal or nearly so.
        let mut values: Vec<f64> = (0..1200).map(|i| 1.0 / (1.0 + 0.02 * f64::from(i)).powi(4)).collect();
        (values[5], values[17], values[40]) = (values[4], values[16] * (1.0 - 1e-9), values[39]);
        let matrix = matrix(&values);
        let least = 0.12;
        let expected: Vec<f64> = values.iter().copied().filter(|v| *v >= least).collect();
        let (found, vectors) = largest(matrix.as_ref(), least, Par::Seq).unwrap();
        assert_eq!(found.len(), expected.len());
        let worst = found.iter().zip(&expected).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-13, "{worst}");
        let gram = product(vectors.transpose(), vectors.as_ref(), Par::Seq);
        let applied = product(matrix.as_ref(), vectors.as_ref(), Par::Seq);
        for k in 0..found.len() {
            let rest: f64 = (0..1200).map(|i| (applied[(i, k)] - found[k] * vectors[(i, k)]).powi(2)).sum();
            assert!(rest.sqrt() < 1e-11 * found[k], "{k}: {}", rest.sqrt());
            assert!((0..=k).all(|j| (gram[(j, k)] - f64::from(j == k)).abs() < 1e-13));
        }
    }

    #[test]
    fn what_takes_a_full_decomposition_is_left_to_it() {
        let values: Vec<f64> = (0..300).map(|i| 2.0 - f64::from(i) / 300.0).collect();
        assert!(largest(matrix(&values).as_ref(), 1.2, Par::Seq).is_none());
        // Three directions alone: the second block depends on the first.
        let flat: Vec<f64> = (0..400).map(|i| f64::from(u8::from(i < 3))).collect();
        assert!(largest(matrix(&flat).as_ref(), 0.5, Par::Seq).is_none_or(|(found, _)| found.len() == 3));
    }
}
