//! Exponentials in a signal by the shift invariance of its signal subspace: ESPRIT (Roy and Kailath, *IEEE Trans. ASSP* 37, 984, 1989).

use unripple_linalg::{Lu, Mat, adjoint_times, c64, general, symmetric, times_adjoint};

/// Most rows of the matrix of shifted samples: as many as resolve what the refinement can, in a few ms.
const ROWS: usize = 100;

/// Most exponentials of a sub-band.
const MOST: usize = 24;

/// An eigenvalue belongs to the signal if it is this many times that of noise; with a lower one, noise is taken for modes, and later
/// refused.
const ABOVE: f64 = 8.0;

/// Least share of the largest eigenvalue that counts as noise, where there is none: rounding.
const ROUNDING: f64 = 1e-13;

/// Factors by which the exponentials in a signal change from sample to sample; none if the signal is too short or has none.
pub(super) fn factors(samples: &[c64]) -> Vec<c64> {
    let rows = (samples.len() / 3).min(ROWS);
    if rows < 6 {
        return Vec::new();
    }
    let shifted = Mat::from_fn(rows, samples.len() - rows + 1, |i, j| samples[i + j]);
    let Some((values, vectors)) = symmetric(times_adjoint(shifted.as_ref(), shifted.as_ref()).as_ref())
    else {
        return Vec::new();
    };
    let largest = values.last().copied().unwrap_or(0.0);
    // The middle of the lower half: no more than half of the eigenvalues are those of the signal.
    let noise = values[rows / 4].max(ROUNDING * largest);
    let count = values.iter().filter(|value| **value > ABOVE * noise).count().min(MOST).min(rows / 3);
    if count == 0 {
        return Vec::new();
    }
    let part = |from: usize| Mat::from_fn(rows - 1, count, |i, j| vectors[(i + from, rows - count + j)]);
    let (first, second) = (part(0), part(1));
    let square = adjoint_times(first.as_ref(), first.as_ref());
    let mut shift = adjoint_times(first.as_ref(), second.as_ref());
    Lu::new(square.as_ref()).solve(shift.as_mut());
    general(shift.as_ref()).map_or(Vec::new(), |found| found.values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_of_exponentials_are_found() {
        let truth = [c64::new(-0.02, 0.4), c64::new(-0.05, 0.45), c64::new(-0.01, -1.0)];
        let sample = |n: u32| truth.iter().map(|log| (*log * f64::from(n)).exp()).sum::<c64>();
        let samples: Vec<c64> = (0..150).map(sample).collect();
        let found = factors(&samples);
        for log in truth {
            let near = found.iter().map(|factor| (factor - log.exp()).norm()).fold(f64::INFINITY, f64::min);
            assert!(near < 1e-6, "{log}: {found:?}");
        }
    }
}
