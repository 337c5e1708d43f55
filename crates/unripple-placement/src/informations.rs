//! What measurements at many places tell of some unknowns: their information matrices.

use crate::PlacementError;
use rayon::prelude::*;
use std::f64::consts::SQRT_2;
use unripple_linalg::{Cholesky, Mat, product, solve_lower_alone};

/// The Fisher information of a measurement at each of many places, and what is known without any of them.
///
/// Inside, unknowns are combined so that what is known before, with the mean of all measurements, is the identity: what is told well and what
/// is told badly differ by orders of magnitude, and determinants change by a known factor.
#[derive(Clone, Debug)]
pub struct Informations {
    unknowns: usize,
    /// L of L Lᵀ, what is known before plus the mean of all measurements.
    factor: Mat<f64>,
    /// What is known before, packed.
    base: Vec<f64>,
    /// The information of each place, packed: numbers x places.
    each: Mat<f64>,
    /// Logarithm of the determinant of L Lᵀ.
    offset: f64,
}

/// A packed matrix solved: its factor, inverse and determinant.
pub(crate) struct Solved {
    /// R of R Rᵀ.
    pub lower: Mat<f64>,
    /// The inverse, packed.
    pub inverse: Vec<f64>,
    /// Logarithm of the determinant.
    pub log_det: f64,
}

impl Informations {
    /// From what is known before (kept measurements and priors, or zeros) and the information of a measurement at each place, all symmetric
    /// and unknowns x unknowns, in inverse squared units of the unknowns.
    ///
    /// # Errors
    /// [`PlacementError::Few`] without places; [`PlacementError::Untold`] if all of this together is singular.
    ///
    /// # Panics
    /// If the sizes of matrices differ.
    pub fn new(before: &Mat<f64>, each: &[Mat<f64>]) -> Result<Self, PlacementError> {
        if each.is_empty() {
            return Err(PlacementError::Few { expected: 1, found: 0 });
        }
        let (unknowns, places) = (before.nrows(), each.len());
        let share = 1.0 / places as f64;
        let mean = Mat::from_fn(unknowns, unknowns, |i, j| {
            before[(i, j)] + share * each.iter().map(|one| one[(i, j)]).sum::<f64>()
        });
        let factor = Cholesky::new(mean.as_ref()).ok_or(PlacementError::Untold { places, unknowns })?;
        let factor = factor.lower().to_owned();
        let columns: Vec<Vec<f64>> = each.par_iter().map(|one| packed(&within(&factor, one))).collect();
        Ok(Self {
            unknowns,
            base: packed(&within(&factor, before)),
            each: Mat::from_fn(columns[0].len(), places, |i, place| columns[place][i]),
            offset: log_det(&factor),
            factor,
        })
    }

    /// Number of places.
    pub fn places(&self) -> usize {
        self.each.ncols()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Logarithm of the determinant of the information of measurements at some places, repeated ones counted as often, with what is known
    /// before, in inverse squared units of all unknowns; -∞ where it is singular.
    pub fn log_det(&self, places: &[usize]) -> f64 {
        let sum = self.sum(places.iter().map(|place| (*place, 1.0)));
        Solved::of(&sum, self.unknowns).map_or(f64::NEG_INFINITY, |solved| solved.log_det + self.offset)
    }

    /// Covariance of the unknowns with measurements at some places, unknowns x unknowns, in their squared units; `None` where some are not
    /// known at all.
    pub fn covariance(&self, places: &[usize]) -> Option<Mat<f64>> {
        let sum = self.sum(places.iter().map(|place| (*place, 1.0)));
        let solved = Solved::of(&sum, self.unknowns)?;
        let inverse = unpacked(&solved.inverse, self.unknowns);
        let mut back = Mat::<f64>::identity(self.unknowns, self.unknowns);
        solve_lower_alone(self.factor.as_ref(), back.as_mut());
        Some(product(product(back.transpose(), inverse.as_ref()).as_ref(), back.as_ref()))
    }

    /// What is known before, plus weighed measurements, packed.
    pub(crate) fn sum(&self, weighed: impl Iterator<Item = (usize, f64)>) -> Vec<f64> {
        let mut sum = self.base.clone();
        for (place, weight) in weighed {
            sum.iter_mut().zip(self.each.col(place).iter()).for_each(|(sum, x)| *sum += weight * x);
        }
        sum
    }

    /// The information of a measurement at a place, packed.
    pub(crate) fn one(&self, place: usize) -> Vec<f64> {
        self.each.col(place).iter().copied().collect()
    }

    /// What is known before, packed.
    pub(crate) fn base(&self) -> &[f64] {
        &self.base
    }

    /// Logarithm of the determinant of what all is counted in.
    pub(crate) fn offset(&self) -> f64 {
        self.offset
    }

    /// Trace of a symmetric packed matrix times the information of each place.
    pub(crate) fn traces(&self, matrix: &[f64]) -> Vec<f64> {
        let trace = |place: usize| self.each.col(place).iter().zip(matrix).map(|(x, y)| x * y).sum::<f64>();
        (0..self.places()).into_par_iter().map(trace).collect()
    }
}

impl Solved {
    /// Of a packed matrix, unknowns x unknowns; `None` if it is not positive definite.
    pub fn of(matrix: &[f64], unknowns: usize) -> Option<Self> {
        let factor = Cholesky::new(unpacked(matrix, unknowns).as_ref())?;
        let lower = factor.lower().to_owned();
        let log_det = log_det(&lower);
        log_det.is_finite().then(|| Self { inverse: packed(&factor.inverse()), log_det, lower })
    }
}

/// Logarithm of the determinant of L Lᵀ.
fn log_det(lower: &Mat<f64>) -> f64 {
    2.0 * (0..lower.nrows()).map(|i| lower[(i, i)].ln()).sum::<f64>()
}

/// Logarithm of the determinant of a packed matrix, unknowns x unknowns; -∞ if it is not positive definite.
pub(crate) fn log_det_of(matrix: &[f64], unknowns: usize) -> f64 {
    let factor = Cholesky::new(unpacked(matrix, unknowns).as_ref());
    factor.map_or(f64::NEG_INFINITY, |factor| {
        2.0 * (0..unknowns).map(|i| factor.lower()[(i, i)].ln()).sum::<f64>()
    })
}

/// L⁻¹ M L⁻ᵀ of a symmetric matrix M.
pub(crate) fn within(lower: &Mat<f64>, matrix: &Mat<f64>) -> Mat<f64> {
    let mut half = matrix.clone();
    solve_lower_alone(lower.as_ref(), half.as_mut());
    let mut whole = half.transpose().to_owned();
    solve_lower_alone(lower.as_ref(), whole.as_mut());
    whole
}

/// The lower triangle of a symmetric matrix, column by column, so that the inner product of two such lists is the trace of the matrices'
/// product.
pub(crate) fn packed(matrix: &Mat<f64>) -> Vec<f64> {
    let count = matrix.nrows();
    let entry = |(i, j): (usize, usize)| if i == j { matrix[(i, j)] } else { SQRT_2 * matrix[(i, j)] };
    (0..count).flat_map(|j| (j..count).map(move |i| (i, j))).map(entry).collect()
}

/// The symmetric matrix of such a list.
pub(crate) fn unpacked(list: &[f64], count: usize) -> Mat<f64> {
    let mut matrix = Mat::zeros(count, count);
    let mut next = list.iter();
    for j in 0..count {
        for i in j..count {
            let x = next.next().copied().unwrap_or(0.0);
            let entry = if i == j { x } else { x / SQRT_2 };
            (matrix[(i, j)], matrix[(j, i)]) = (entry, entry);
        }
    }
    matrix
}
