//! The functions of each number type, compiled here for all crates.

use crate::eigen::{divided, general_complex, general_real};
use crate::number::sealed;
use crate::{Entry, General, Number, lu};
use faer::linalg::solvers::PartialPivLu;
use faer::{Accum, Mat, MatMut, MatRef, Par, c64};

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
                divided(matrix)
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
                lu::solve(factors, right);
            }

            #[inline(never)]
            fn inverse(factors: &PartialPivLu<Self>) -> Mat<Self> {
                faer::linalg::solvers::DenseSolveCore::inverse(factors)
            }
        }
    )*};
}

numbers!(f32, f64, c64);
entries!(f64: general_real, c64: general_complex);
