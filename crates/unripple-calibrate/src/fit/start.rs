//! Starting values of a fit, for surface files with larger errors than a descent can correct.

use super::forward::Answer;
use super::layout::{Unknown, Values};
use super::residual::Case;
use crate::CalibrateError;

/// Tensions and bending stiffnesses that are tried, as logarithms of the ratio to nominal: largest distance from nominal, and step.
const TENSION: (f64, f64) = (0.36, 0.03);
const BENDING: (f64, f64) = (0.3, 0.3);

/// Bending stiffnesses that are tried for a plate without tension: largest distance from nominal and step, as above.
const PLATE: (f64, f64) = (0.48, 0.03);

/// Largest number of starts that are fitted: pairs of tension and stiffness that explain the lowest modes about as well as the
/// best. Each costs a descent.
const FOLLOWED: usize = 3;

/// Largest residual power of a start that is fitted, relative to that of the best.
const WORTH: f64 = 2.0;

/// Smallest difference of a single channel's gain from the others, as a logarithm, at which the gain is
/// corrected before the fit: errors of places and tension, which are not fitted yet, cause half of that.
const ANOTHER: f64 = 0.4;

/// Trial values of the unknowns, and the power of their residual.
struct Try {
    values: Values,
    left: f64,
}

impl Case<'_> {
    /// Starting values for descents, the likeliest first: tension and bending stiffness with which the model
    /// explains the lowest modes best, and gains estimated with them.
    pub fn starts(&self, expected: &Values) -> Result<Vec<Values>, CalibrateError> {
        let steps = |(most, step): (f64, f64)| {
            let count = (most / step).round() as i32;
            (-count..=count).map(|n| f64::from(n) * step).collect::<Vec<_>>()
        };
        let stretched = self.basis.medium.tension > 0.0;
        let (tensions, bendings) =
            if stretched { (steps(TENSION), steps(BENDING)) } else { (vec![0.0], steps(PLATE)) };
        let mut rows = Vec::new();
        for bending in &bendings {
            let row = tensions.iter().map(|tension| {
                let mut values = expected.clone();
                values.tension += tension;
                values.bending += bending;
                self.levelled(values)
            });
            rows.push(row.collect::<Result<Vec<Try>, _>>()?);
        }
        if !stretched {
            rows = vec![rows.into_iter().flatten().collect()];
        }
        let mut best: Vec<Try> = rows.into_iter().flat_map(dips).collect();
        best.sort_unstable_by(|a, b| a.left.total_cmp(&b.left));
        let least = best.first().map_or(0.0, |t| t.left);
        best.retain(|t| t.left <= WORTH * least);
        best.truncate(FOLLOWED);
        best.into_iter().map(|t| self.balanced(t.values)).collect()
    }

    /// These values with the common gain that fits best, and the residual power.
    fn levelled(&self, mut values: Values) -> Result<Try, CalibrateError> {
        let products = self.products(&values)?;
        let sum = |k: usize| products.iter().map(|p| p.1[k]).sum::<f64>();
        let (both, own, all) = (sum(0), sum(1), sum(2));
        let mut left = all;
        if both > 0.0 && own > 0.0 {
            values.level += (both / own).ln();
            left -= both * both / own;
        }
        Ok(Try { values, left })
    }

    /// These values with gains of single channels where they differ from the others by more than [`ANOTHER`], and then with the
    /// best common gain.
    fn balanced(&self, mut values: Values) -> Result<Values, CalibrateError> {
        let count = self.layout.actuators;
        for sensors in [true, false] {
            let products = self.products(&values)?;
            for a in 0..count {
                let own = products.iter().filter(|(n, _)| if sensors { n % count } else { n / count } == a);
                let [both, power] = own.fold([0.0, 0.0], |s, (_, p)| [s[0] + p[0], s[1] + p[1]]);
                let gain = (both / power).ln();
                if both > 0.0 && gain.is_finite() && gain.abs() > ANOTHER {
                    let gains = if sensors { &mut values.sense } else { &mut values.drive };
                    gains[a] += gain;
                }
            }
        }
        Ok(self.levelled(values)?.values)
    }

    /// For each response between actuators its number and three inner products: of model and measurement, of the model with itself,
    /// of the measurement with itself. Taps have the number `usize::MAX`, since they determine no gains.
    fn products(&self, values: &Values) -> Result<Vec<(usize, [f64; 3])>, CalibrateError> {
        let answers = self.system(values)?.admittances(&self.spectra.frequencies);
        let answers: Vec<Answer> =
            answers.into_iter().map(|y| Answer { admittance: y, derivatives: Vec::new() }).collect();
        let numbers = (0..self.spectra.pairs.len()).filter(|n| !self.spectra.pairs[*n].is_empty());
        let sums = self.blocks(values, &answers, &[Unknown::Level]).into_iter().map(|block| {
            let pairs = block.columns[0].iter().zip(&block.values);
            pairs.fold([0.0; 3], |[both, own, all], (model, off)| {
                let measured = model - off;
                [both + model * measured, own + model * model, all + measured * measured]
            })
        });
        let taps = self.spectra.taps.len();
        Ok(numbers.chain(std::iter::repeat_n(usize::MAX, taps)).zip(sums).collect())
    }
}

/// Trials with a smaller residual than both their neighbours: local minima.
fn dips(row: Vec<Try>) -> Vec<Try> {
    let left: Vec<f64> = row.iter().map(|t| t.left).collect();
    let before = |n: usize| n.checked_sub(1).map_or(f64::INFINITY, |m| left[m]);
    let after = |n: usize| left.get(n + 1).copied().unwrap_or(f64::INFINITY);
    row.into_iter()
        .enumerate()
        .filter(|(n, t)| t.left <= before(*n) && t.left < after(*n))
        .map(|(_, t)| t)
        .collect()
}
