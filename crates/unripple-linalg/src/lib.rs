//! Dense and sparse linear algebra on faer's matrices, compiled once for all crates. Unless said otherwise, results do not depend on the
//! number of threads, to the last bit.
//!
//! Only this crate uses faer directly. All others take its matrices ([`Mat`], [`MatRef`], [`MatMut`] …) from here, and call the functions
//! here for everything beyond reading, writing, adding and scaling entries. faer's algorithms are generic, so that each crate that calls
//! one, even as `a * b`, compiles it again, and so does each of its test programs: hundreds of kilobytes for an eigenvalue problem. The
//! functions here are compiled with this crate, for f64 and, where it is used, f32 and [`c64`].
//!
//! In a matrix product, faer shares the entries of the result among threads, so that each is summed in one order whatever the number of
//! threads. In products with a single row or column, and for eigenvalues and singular values, it splits sums among threads. Here these
//! run on one thread; a caller that has many of them can run several at a time. The exception is [`multiply`] with several threads, where
//! faer splits large products with a single row or column.
//!
//! # In reading order
//!
//! [`Mat`] and its view [`MatRef`] are the matrices, [`product()`] multiplies two of them, and [`multiply()`] does so into a third with a
//! choice of threads. [`Cholesky`] and [`Lu`] solve linear systems, [`symmetric()`] and [`general()`] eigenvalue problems, [`singular()`]
//! gives singular values and vectors. [`non_negative()`] minimises a quadratic form over numbers that are not negative. [`sparse`] factors
//! large symmetric matrices most of whose entries are zero.
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
mod chunks;
mod eigen;
mod eigenpairs;
mod instances;
mod lu;
mod non_negative;
mod number;
mod product;
mod singular;
pub mod sparse;

pub use cholesky::{Cholesky, CholeskyInPlace, solve_lower, solve_lower_alone, solve_upper_alone};
pub use chunks::{all_threads, col_chunks, row_chunks};
pub use eigen::{exact_symmetric, general, symmetric};
pub use eigenpairs::General;
pub use faer::{Accum, Col, ColMut, ColRef, Mat, MatMut, MatRef, Par, RowRef, Scale, c64, mat};
pub use lu::Lu;
pub use non_negative::non_negative;
pub use number::{Entry, Number};
pub use product::{
    add_square, adjoint_times, multiply, norm, product, sparse_times, squared_norm, times_adjoint,
    times_column,
};
pub use singular::{Singular, singular};
