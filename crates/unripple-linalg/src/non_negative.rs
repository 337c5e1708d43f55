//! A non-negative quadratic programme by an active-set method.

use crate::{Cholesky, Mat};

/// Slopes below this share of the largest slope count as zero: it lies above rounding errors. With twice
/// this value, the descent stops a little earlier.
const LEVEL: f64 = 1e-9;

/// The vector λ ≥ 0 that minimises ½ λᵀQλ − bᵀλ for a positive definite matrix Q (`form`) and b = `slope`,
/// by the active-set method of Lawson and Hanson (1974), Solving Least Squares Problems, chapter 23. The
/// search starts from `guess`, in which negative and missing elements count as 0.
///
/// `form` returns the elements of Q by row and column. If rounding errors would make the active set repeat
/// itself, the search stops and returns the λ ≥ 0 reached by then.
///
/// ```
/// use unripple_linalg::{mat, non_negative};
///
/// let form = mat![[2.0, 1.0], [1.0, 2.0_f64]];
/// let found = non_negative(|i, j| form[(i, j)], &[1.0, -1.0], vec![0.0; 2]);
/// assert!((found[0] - 0.5).abs() < 1e-12 && found[1] == 0.0);
/// ```
pub fn non_negative(form: impl Fn(usize, usize) -> f64, slope: &[f64], mut guess: Vec<f64>) -> Vec<f64> {
    let count = slope.len();
    guess.resize(count, 0.0);
    guess.iter_mut().for_each(|value| *value = value.max(0.0));
    let mut found = Descent { form, slope, value: guess, free: Vec::new() };
    found.free = (0..count).filter(|i| found.value[*i] > 0.0).collect();
    found.settle();
    let enough = LEVEL * slope.iter().fold(0.0, |m: f64, b| m.max(b.abs()));
    for _ in 0..4 * count {
        let held = (0..count).filter(|i| !found.free.contains(i));
        let steepest = held.map(|i| (i, found.ascent(i))).max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((next, _)) = steepest.filter(|(_, ascent)| *ascent > enough) else { break };
        found.free.push(next);
        found.settle();
    }
    found.value
}

struct Descent<'a, F> {
    form: F,
    slope: &'a [f64],
    value: Vec<f64>,
    /// Indices of the elements that are not held at zero.
    free: Vec<usize>,
}

impl<F: Fn(usize, usize) -> f64> Descent<'_, F> {
    /// Rate at which the objective falls if element `i`, now held at zero, rises.
    fn ascent(&self, i: usize) -> f64 {
        self.slope[i] - self.free.iter().map(|j| (self.form)(i, *j) * self.value[*j]).sum::<f64>()
    }

    /// Moves to the optimum over the free elements; an element that would fall below zero on the way is
    /// held at zero.
    fn settle(&mut self) {
        while !self.free.is_empty() {
            let free = &self.free;
            let form = Mat::from_fn(free.len(), free.len(), |i, j| (self.form)(free[i], free[j]));
            let Some(factor) = Cholesky::new(form.as_ref()) else { return };
            let mut optimum = Mat::from_fn(free.len(), 1, |i, _| self.slope[free[i]]);
            factor.solve(optimum.as_mut());
            let low = (0..free.len()).filter(|i| optimum[(*i, 0)] <= 0.0);
            let reach = |i: usize| {
                let from = self.value[free[i]];
                from / (from - optimum[(i, 0)]).max(f64::MIN_POSITIVE)
            };
            let first = low.map(|i| (i, reach(i))).min_by(|a, b| a.1.total_cmp(&b.1));
            let step = first.map_or(1.0, |(_, reach)| reach.clamp(0.0, 1.0));
            for (i, at) in free.iter().enumerate() {
                let value = self.value[*at];
                self.value[*at] = (value + step * (optimum[(i, 0)] - value)).max(0.0);
            }
            let Some((held, _)) = first else { return };
            let held = self.free.remove(held);
            self.value[held] = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// What makes it the optimum: no slope where λ > 0, none downwards where λ = 0.
        #[test]
        fn is_at_rest(
            rows in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 6), 1..14),
            slope in prop::collection::vec(-1.0..1.0_f64, 14), guess in prop::collection::vec(-1.0..1.0_f64, 14),
        ) {
            let n = rows.len();
            let form = |i: usize, j: usize| {
                rows[i].iter().zip(&rows[j]).map(|(a, b)| a * b).sum::<f64>() + if i == j { 0.01 } else { 0.0 }
            };
            let guess = guess[..n].iter().map(|g| g.max(0.0)).collect();
            let found = non_negative(form, &slope[..n], guess);
            for i in 0..n {
                let gradient = (0..n).map(|j| form(i, j) * found[j]).sum::<f64>() - slope[i];
                prop_assert!(found[i] >= 0.0);
                prop_assert!(gradient > -1e-7 && (found[i] == 0.0 || gradient.abs() < 1e-7), "{i}: {gradient}");
            }
        }
    }
}
