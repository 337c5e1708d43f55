//! Estimated costs of computations.

use std::iter::Sum;
use std::ops::Add;

/// The estimated cost of a computation, before it begins.
///
/// ```
/// use unripple_core::Cost;
///
/// let both = Cost { seconds: 2.0, bytes: 3e9 } + Cost { seconds: 5.0, bytes: 1e9 };
/// assert_eq!(both, Cost { seconds: 7.0, bytes: 3e9 });
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Processor time in seconds, on one processor of the machine on which the laws were measured: one that multiplies large matrices of
    /// double precision at [`Cost::RATE`].
    pub seconds: f64,
    /// Largest amount of memory in use at a time, in bytes.
    pub bytes: f64,
}

impl Cost {
    /// Floating-point operations per second of the machine on which the costs were measured, in large products of matrices of
    /// double precision on one processor.
    pub const RATE: f64 = 3e10;

    /// The cost of large products of matrices that take `operations` floating-point operations in all (a pure
    /// number).
    pub fn of_operations(operations: f64) -> Self {
        Self { seconds: operations / Self::RATE, bytes: 0.0 }
    }
}

impl Add for Cost {
    type Output = Self;

    /// The cost of one computation after the other.
    fn add(self, later: Self) -> Self {
        Self { seconds: self.seconds + later.seconds, bytes: self.bytes.max(later.bytes) }
    }
}

impl Sum for Cost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::default(), Add::add)
    }
}
