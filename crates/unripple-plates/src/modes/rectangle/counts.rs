//! Numbers of functions along the sides of a rectangle.

use super::polynomials::order;
use super::problem::Problem;
use std::f64::consts::{PI, SQRT_2};
use unripple_core::Edge;

/// Half of the phase k·side from which the number of polynomials is that of many waves. Below, a second round of a few more takes a fraction
/// of a second; with twice this value, a second round of large problems takes most of the time.
const MANY: f64 = 50.0;

/// The error of frequencies relative to the square of the coefficient of the highest polynomial, for many waves: 0.04 to 0.06 on clamped and
/// free plates. With twice this value, there are two per cent more polynomials.
const SHARE: f64 = 0.05;

/// Number of functions for each further one by which the error is estimated. With twice this value, fewer are seen to be missing.
pub(super) const FURTHER: usize = 4;

/// Initial number of functions along each side, for waves up to the wavenumber `k` (rad/m).
///
/// Sines: all that can have an energy below the top, with the bending stiffness D(1-ν²), the least that a strip can have.
/// Polynomials: about k·side/2 resolve the wave; beyond this number, the error falls by about e^1.5 for each at first, and for many waves as
/// the square of the coefficient of such a wave in Legendre polynomials, exp(-(4√2/3) δ^1.5 / √(k·side/2)) at the degree k·side/2 + δ
/// (from Debye's expansion of the Bessel functions; DLMF 10.19).
pub(super) fn first_counts(problem: &Problem, k: f64) -> [usize; 2] {
    let mut soft = problem.bounds.vacuum();
    let square = soft.omega(k);
    soft.bending_stiffness *= 1.0 - problem.bounds.poisson * problem.bounds.poisson;
    [0, 1].map(|axis| {
        let side = problem.sides[axis];
        if problem.edges[axis] == [Edge::Supported; 2] {
            return (soft.wavenumber(square) * side / PI) as usize + 1;
        }
        let half = 0.5 * k * side;
        let accuracy = problem.bounds.accuracy;
        if half > MANY {
            let digits = -(accuracy / SHARE).ln().min(0.0);
            let zeros: i32 = problem.edges[axis].iter().map(|edge| order(*edge)).sum();
            let beyond = (digits * 3.0 / (4.0 * SQRT_2)).powf(2.0 / 3.0) * half.cbrt();
            return ((half + beyond - f64::from(zeros)).ceil() as usize).next_multiple_of(2);
        }
        let free = f64::from(u8::from(problem.edges[axis].iter().any(|edge| edge.moves())));
        let margin = 2.5 * free - half.cbrt() - accuracy.ln() / 1.5;
        ((half + margin).ceil().max(4.0) as usize).next_multiple_of(2)
    })
}

/// Number of basis functions, beyond the first `count`, from which the error is estimated.
pub(super) fn further(count: usize) -> usize {
    (count / FURTHER).max(4).next_multiple_of(2)
}
