//! Exact frequencies of sheets by routes that share nothing with the finite elements: closed forms, radial and tensor-product Ritz
//! sums, series in Bessel functions of fractional order, and particular solutions.
#![allow(dead_code)]

pub mod bessel;
pub mod cases;
pub mod line;
pub mod masses;
pub mod more;
pub mod particular;
pub mod radial;
pub mod ritz;
pub mod sectors;
pub mod sheets;
pub mod strips;

use unripple_linalg::{Cholesky, Mat, exact_symmetric, solve_lower_alone};

/// The eigenvalues λ of K x = λ M x, ascending, from those of (K + shift M)⁻¹M, of which the largest keep all digits.
pub fn pencil(stiffness: &Mat<f64>, mass: &Mat<f64>, shift: f64) -> Vec<f64> {
    let n = mass.nrows();
    let shifted = Mat::from_fn(n, n, |i, j| stiffness[(i, j)] + shift * mass[(i, j)]);
    let factor = Cholesky::new(shifted.as_ref()).unwrap();
    let mut half = mass.clone();
    solve_lower_alone(factor.lower(), half.as_mut());
    let mut both = half.transpose().to_owned();
    solve_lower_alone(factor.lower(), both.as_mut());
    let (values, _) = exact_symmetric(both.as_ref()).unwrap();
    values.iter().rev().map(|v| 1.0 / v - shift).collect()
}
