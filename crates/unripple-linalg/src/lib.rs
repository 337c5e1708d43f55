//! Linear algebra, compiled once for all crates, whose results do not depend on the number of threads, to the last bit.
//!
//! This crate alone knows faer; all others take its matrices ([`Mat`], [`MatRef`], [`MatMut`] …) from here and leave to the functions here
//! what is more than reading, writing, adding and scaling entries. faer's algorithms have type parameters, so that each crate that calls
//! one, be it as `a * b`, compiles it again, and so does each of its test programs: hundreds of kilobytes for an eigenvalue problem. The
//! functions here are compiled with this crate, for f64 and, where it is used, f32 and [`c64`].
//!
//! faer's products of matrices are shared among threads row by row and column by column, so that each number is summed in one order
//! whatever their number. Its products with a single column, eigenvalues and singular values are not: with threads, sums are cut in parts.
//! These run on one thread here; whoever has many of them shares them among threads whole. Only [`times`] has large products with a single
//! column as faer has them.
//!
//! ```
//! use unripple_linalg::{Mat, mat, norm, product, symmetric};
//!
//! let stiffness = mat![[2.0, -1.0], [-1.0, 2.0_f64]];
//! let (values, vectors) = symmetric(stiffness.as_ref()).unwrap();
//! assert!((values[0] - 1.0).abs() < 1e-12 && (values[1] - 3.0).abs() < 1e-12);
//! let turned: Mat<f64> = product(stiffness.as_ref(), vectors.as_ref());
//! let scaled = Mat::from_fn(2, 2, |i, j| vectors[(i, j)] * values[j]);
//! assert!(norm((turned - scaled).as_ref()) < 1e-12);
//! ```

mod cholesky;
mod eigen;
mod lu;
mod number;
mod product;
mod singular;
pub mod sparse;

pub use cholesky::{Cholesky, CholeskyInPlace, solve_lower, solve_lower_alone, solve_upper_alone};
pub use eigen::{General, exact_symmetric, general, symmetric};
pub use faer::{Accum, Col, ColMut, ColRef, Mat, MatMut, MatRef, Par, RowRef, Scale, c64, mat};
pub use lu::Lu;
pub use number::{Entry, Number};
pub use product::{
    add_square, adjoint_times, multiply, norm, product, sparse_times, squared_norm, times, times_adjoint,
    times_column,
};
pub use singular::{Singular, singular};
