//! The number types of matrices, and the functions that are compiled once for each.

use crate::General;
use faer::linalg::solvers::PartialPivLu;
use faer::traits::ComplexField;
use faer::{Accum, Mat, MatMut, MatRef, Par, c64};

/// Number types whose matrices can be multiplied: f32, f64 and c64.
pub trait Number: sealed::Products {}

/// Number types whose matrices can also be decomposed (eigenvalues, LU): f64 and c64.
pub trait Entry: Number + sealed::Decompositions {}

/// Functions without type parameters of their own. faer's are generic, so that each crate that calls one compiles it again with all that
/// it calls; calls of these functions compile nothing again.
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

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Number for $number {}

        impl sealed::Products for $number {
            #[inline(never)]
            fn multiply(
                out: MatMut<'_, Self>,
                accum: Accum,
                left: MatRef<'_, Self>,
                right: MatRef<'_, Self>,
                factor: Self,
                par: Par,
            ) {
                faer::linalg::matmul::matmul(out, accum, left, right, factor, par);
            }
        }
    )*};
}

macro_rules! entries {
    ($($number:ty: $general:path),*) => {$(
        impl Entry for $number {}

        impl sealed::Decompositions for $number {
            #[inline(never)]
            fn symmetric(matrix: MatRef<'_, Self>) -> Option<(Vec<f64>, Mat<Self>)> {
                crate::eigen::divided(matrix)
            }

            #[inline(never)]
            fn general(matrix: MatRef<'_, Self>) -> Option<General> {
                $general(matrix)
            }

            #[inline(never)]
            fn lu(matrix: MatRef<'_, Self>) -> PartialPivLu<Self> {
                PartialPivLu::new(matrix)
            }

            #[inline(never)]
            fn solve_lu(factors: &PartialPivLu<Self>, right: MatMut<'_, Self>) {
                crate::lu::solve(factors, right);
            }

            #[inline(never)]
            fn inverse(factors: &PartialPivLu<Self>) -> Mat<Self> {
                faer::linalg::solvers::DenseSolveCore::inverse(factors)
            }
        }
    )*};
}

numbers!(f32, f64, c64);
entries!(f64: crate::eigen::general_real, c64: crate::eigen::general_complex);
