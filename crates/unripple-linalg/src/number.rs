//! The number types of matrices, and the functions that each must have.

use crate::General;
use faer::linalg::solvers::PartialPivLu;
use faer::traits::ComplexField;
use faer::{Accum, Mat, MatMut, MatRef, Par};

/// Number types whose matrices can be multiplied: f32, f64 and c64.
pub trait Number: sealed::Products {}

/// Number types whose matrices can also be decomposed (eigenvalues, LU): f64 and c64.
pub trait Entry: Number + sealed::Decompositions {}

/// Functions without type parameters of their own. Those of faer are generic, so that each crate that calls
/// one compiles it again, with all that it calls; a call of one of these functions compiles nothing again.
pub(crate) mod sealed {
    use super::*;

    /// The functions of a [`Number`].
    pub trait Products: ComplexField + Copy {
        fn multiply(
            out: MatMut<'_, Self>,
            accum: Accum,
            left: MatRef<'_, Self>,
            right: MatRef<'_, Self>,
            factor: Self,
            par: Par,
        );
    }

    /// The functions of an [`Entry`].
    pub trait Decompositions: Products {
        fn symmetric(matrix: MatRef<'_, Self>) -> Option<(Vec<f64>, Mat<Self>)>;
        fn general(matrix: MatRef<'_, Self>) -> Option<General>;
        fn lu(matrix: MatRef<'_, Self>) -> PartialPivLu<Self>;
        fn solve_lu(factors: &PartialPivLu<Self>, right: MatMut<'_, Self>);
        fn inverse(factors: &PartialPivLu<Self>) -> Mat<Self>;
    }
}
