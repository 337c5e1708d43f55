//! Dense linear algebra whose results do not depend on the number of threads, to the last bit.
//!
//! faer's products of matrices are shared among threads row by row and column by column, so that each number is summed in one order
//! whatever their number. Its products with a single column, eigenvalues and singular values are not: with threads, sums are cut in parts.
//! These run on one thread here; whoever has many of them shares them among threads whole.
//!
//! ```
//! use faer::{Mat, mat};
//! use unripple_linalg::{product, symmetric};
//!
//! let stiffness = mat![[2.0, -1.0], [-1.0, 2.0_f64]];
//! let (values, vectors) = symmetric(stiffness.as_ref()).unwrap();
//! assert!((values[0] - 1.0).abs() < 1e-12 && (values[1] - 3.0).abs() < 1e-12);
//! let turned: Mat<f64> = product(stiffness.as_ref(), vectors.as_ref());
//! let scaled = Mat::from_fn(2, 2, |i, j| vectors[(i, j)] * values[j]);
//! assert!((turned - scaled).norm_l2() < 1e-12);
//! ```

mod eigen;
mod product;
mod singular;
mod solve;

pub use eigen::{General, exact_symmetric, general, symmetric};
pub use product::product;
pub use singular::{Singular, singular};
pub use solve::{solve_cholesky, solve_lower, solve_lu};
