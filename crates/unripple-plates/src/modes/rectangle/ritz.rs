//! The Rayleigh-Ritz eigenvalue problem, one symmetry class at a time.

use super::super::eigen::{orthonormalised, product};
use super::plate::Plate;
use super::product::{Product, Symmetry};
use unripple_linalg::{Accum, Cholesky, Mat, Par, exact_symmetric, multiply};

/// Modes are computed up to this share above the top ω², so that the modes that are left out are well
/// separated from those that are kept. Halved, they are closer, and each iteration removes less of them.
pub(crate) const ABOVE: f64 = 0.3;

/// Number of times that the inverse is applied to the vectors (subspace iteration). Each time, rounding
/// errors along vectors of high energy shrink by the ratio of that energy to the top energy; one more
/// changes only the last digits.
const SWEEPS: usize = 2;

/// Number of products of a class from which its modes are those of a sparse problem: below, a full decomposition takes a fraction of a
/// second.
pub(crate) const LARGE: usize = 600;

/// Modes of one symmetry class, in order of ascending frequency.
#[derive(Debug)]
pub(crate) struct BlockModes {
    /// The products of basis functions of which mode shapes are sums.
    pub(crate) products: Vec<Product>,
    /// ω² of each mode, ascending, in 1/s².
    pub(crate) squares: Vec<f64>,
    /// Share of bending in the elastic energy of each mode; 0 for rigid-body modes.
    pub(crate) bending_shares: Vec<f64>,
    /// Coefficients, products x modes; columns are orthonormal.
    pub(crate) coefficients: Mat<f64>,
    /// Largest relative error of a frequency for want of further products, estimated; infinite if the products are too few to reach the
    /// top frequency.
    pub(crate) error: f64,
    /// A bound of the relative error of a squared frequency by rounding.
    pub(crate) rounded: f64,
}

impl BlockModes {
    /// The same modes with x and y exchanged.
    pub(crate) fn mirrored(&self) -> Self {
        Self {
            products: self.products.iter().map(|p| p.mirrored()).collect(),
            squares: self.squares.clone(),
            bending_shares: self.bending_shares.clone(),
            coefficients: self.coefficients.clone(),
            error: self.error,
            rounded: self.rounded,
        }
    }
}

/// The modes of one symmetry class with ω² up to `top`, without rigid-body modes. The error is estimated
/// from additional functions beyond those of the class.
///
/// `None` if the eigenvalue iteration does not converge.
pub(crate) fn solve_block(plate: &Plate, symmetry: Symmetry, top: f64, par: Par) -> Option<BlockModes> {
    let products = plate.products(symmetry);
    let energy = plate.stiffness(&products, &products);
    let (squares, coefficients) = lowest(&energy, top, par)?;
    let mut further = plate.products(symmetry.further(&plate.lines));
    further.retain(|p| p.x >= symmetry.x.end || p.y >= symmetry.y.end);
    let error = missing(plate, &further, &products, (&squares, &coefficients), top, par);
    let inside = squares.partition_point(|v| *v <= top);
    let squares = squares[..inside].to_vec();
    let coefficients = coefficients.subcols(0, inside).to_owned();
    let bending_shares = bending_shares(plate, &products, &squares, &coefficients, par);
    let rounded = squares.first().map_or(0.0, |lowest| plate.rounded(*lowest));
    Some(BlockModes { products, squares, bending_shares, coefficients, error, rounded })
}

/// The share of bending in each mode's elastic energy: 1 minus that of tension and springs.
fn bending_shares(
    plate: &Plate,
    products: &[Product],
    squares: &[f64],
    coefficients: &Mat<f64>,
    par: Par,
) -> Vec<f64> {
    if !plate.is_held_by_more_than_bending() {
        return vec![1.0; squares.len()];
    }
    let others = plate.without_bending().stiffness(products, products);
    let forces = product(others.as_ref(), coefficients.as_ref(), par);
    let pairs = coefficients.col_iter().zip(forces.col_iter());
    pairs
        .zip(squares)
        .map(|((shape, force), square)| {
            let energy: f64 = shape.iter().zip(force.iter()).map(|(c, f)| c * f).sum();
            (1.0 - energy / square).clamp(0.0, 1.0)
        })
        .collect()
}

/// Eigenvalues up to the share [`ABOVE`] above `top`, and their vectors.
///
/// The largest eigenvalues of the energy matrix H are 10¹⁰ times the lowest, and the rounding errors of its decomposition
/// would be relative to the largest. Therefore (H + top)⁻¹ is decomposed, whose largest eigenvalues belong to the modes in
/// question. Applying it to their vectors again removes the parts of highest energy that rounding left; the error of the
/// rest is made second order by a final Rayleigh-Ritz step with H between these vectors (subspace iteration; Parlett, *The
/// Symmetric Eigenvalue Problem*, 1998, chapter 14).
fn lowest(energy: &Mat<f64>, top: f64, par: Par) -> Option<(Vec<f64>, Mat<f64>)> {
    let n = energy.nrows();
    let mut shifted = energy.clone();
    (0..n).for_each(|i| shifted[(i, i)] += top);
    let inverse = Cholesky::new(shifted.as_ref())?.inverse();
    let (values, mut vectors) = at_least(&inverse, 1.0 / (top * (2.0 + ABOVE)))?;
    for _ in 0..SWEEPS {
        let mut swept = product(inverse.as_ref(), vectors.as_ref(), par);
        for (column, value) in swept.col_iter_mut().zip(&values) {
            column.iter_mut().for_each(|v| *v /= value);
        }
        vectors = orthonormalised(swept, par);
    }
    let forces = product(energy.as_ref(), vectors.as_ref(), par);
    let between = product(vectors.transpose(), forces.as_ref(), par);
    let (values, rotation) = exact_symmetric(between.as_ref())?;
    Some((values, product(vectors.as_ref(), rotation.as_ref(), par)))
}

/// The eigenvalues of at least `least` of a symmetric matrix, descending, and their vectors.
fn at_least(matrix: &Mat<f64>, least: f64) -> Option<(Vec<f64>, Mat<f64>)> {
    let (values, vectors) = exact_symmetric((-matrix).as_ref())?;
    let kept = values.partition_point(|value| -value >= least);
    Some((values[..kept].iter().map(|value| -value).collect(), vectors.subcols(0, kept).to_owned()))
}

/// Estimated largest relative error of a frequency: the change by a quarter more functions along each side, doubled to
/// account for all further ones.
///
/// To second order ω² falls by rᵀ(H - ω²)⁻¹r, with r the force of a mode on the further products and H the energy
/// of all products, the computed modes projected out (Löwdin, *J. Math. Phys.* 3, 969, 1962). They are projected out by
/// shifting their energy above the top. Infinite if the further products have more modes below the top.
fn missing(
    plate: &Plate,
    further: &[Product],
    products: &[Product],
    (squares, coefficients): (&[f64], &Mat<f64>),
    top: f64,
    par: Par,
) -> f64 {
    let (n, all) = (products.len(), products.len() + further.len());
    if n == all || squares.is_empty() {
        return 0.0;
    }
    let both = [products, further].concat();
    let mut lifted = plate.lower_stiffness(&both, top);
    let inner = lifted.as_mut().submatrix_mut(0, 0, n, n);
    multiply(inner, Accum::Add, coefficients.as_ref(), coefficients.transpose(), 2.0 * top, par);
    let Some(factor) = Cholesky::new(lifted.as_ref()) else {
        return f64::INFINITY;
    };
    let mut force = Mat::zeros(all, squares.len());
    let rest = force.as_mut().subrows_mut(n, further.len());
    let between = plate.stiffness(further, products);
    multiply(rest, Accum::Replace, between.as_ref(), coefficients.as_ref(), 1.0, par);
    let mut response = force.clone();
    factor.solve(response.as_mut());
    let inside = squares.partition_point(|square| *square <= top);
    (0..inside)
        .map(|m| {
            let change: f64 = force.col(m).iter().zip(response.col(m).iter()).map(|(f, u)| f * u).sum();
            change / squares[m]
        })
        .fold(0.0, f64::max)
}
