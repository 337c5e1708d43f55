//! Rayleigh quotients, with compensated summation.

use super::panel::{LANES, NONE, Panel, Row};
use super::pencil::{Lower, Pencil};
use pulp::NullaryFnOnce;

/// Rayleigh quotients xᵀKx / xᵀMx of the vectors of a panel.
///
/// The error of the quotients is of second order in the error of the vectors, so that rounding errors in the factors of K - σM have no effect.
/// In a stiff pencil the terms of xᵀKx are larger than their sum by many orders of magnitude, so that it is accumulated with
/// twice the digits (Ogita, Rump and Oishi, *SIAM J. Sci. Comput.* 26, 1955, 2005, algorithm 5.3).
pub(super) fn quotients(pencil: &Pencil, panel: &Panel) -> Row {
    pencil.arch.dispatch(Quotients { lower: &pencil.lower, x: panel })
}

struct Quotients<'a> {
    lower: &'a Lower,
    x: &'a [Row],
}

impl NullaryFnOnce for Quotients<'_> {
    type Output = Row;

    #[inline(always)]
    fn call(self) -> Row {
        let Self { lower, x } = self;
        let (mut stiff, mut heavy) = (Sum::default(), NONE);
        for (x_j, ends) in x.iter().zip(lower.pattern.col_ptr().windows(2)) {
            let rows = &lower.pattern.row_idx()[ends[0]..ends[1]];
            let stiffness = &lower.stiffness[ends[0]..ends[1]];
            let mass = &lower.mass[ends[0]..ends[1]];
            let (mut force, mut weight) = (Sum::default(), NONE);
            for (number, ((i, k), m)) in rows.iter().zip(stiffness).zip(mass).enumerate() {
                // The diagonal comes first; the others stand for two entries each.
                let twice = if number == 0 { 1.0 } else { 2.0 };
                force.add(&[twice * k; LANES], &x[*i]);
                for (weight, x) in weight.iter_mut().zip(&x[*i]) {
                    *weight = (twice * m).mul_add(*x, *weight);
                }
            }
            stiff.add(&force.high, x_j);
            for lane in 0..LANES {
                stiff.low[lane] = force.low[lane].mul_add(x_j[lane], stiff.low[lane]);
                heavy[lane] = weight[lane].mul_add(x_j[lane], heavy[lane]);
            }
        }
        std::array::from_fn(|lane| (stiff.high[lane] + stiff.low[lane]) / heavy[lane])
    }
}

/// A sum in each lane and its accumulated rounding error (compensated summation).
#[derive(Clone, Copy)]
struct Sum {
    high: Row,
    low: Row,
}

impl Default for Sum {
    fn default() -> Self {
        Self { high: NONE, low: NONE }
    }
}

impl Sum {
    /// Adds the products of two rows to the sums.
    #[inline(always)]
    fn add(&mut self, a: &Row, b: &Row) {
        for lane in 0..LANES {
            let product = a[lane] * b[lane];
            let below = a[lane].mul_add(b[lane], -product);
            let before = self.high[lane];
            let sum = before + product;
            let part = sum - before;
            let lost = (before - (sum - part)) + (product - part);
            self.high[lane] = sum;
            self.low[lane] += lost + below;
        }
    }
}
