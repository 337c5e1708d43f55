//! Expected error of kriging at one place, with as large a share of stray waves as the nearest points show when each is left out.

use super::medium::{SpectralLine, Waves};
use super::system::{System, lower_triangle};
use unripple_linalg::{Mat, product};

/// Number of nearest points that are predicted from the others. With half as many chance decides; more lie too far away to tell of the
/// place.
const LEFT_OUT: usize = 12;

/// Number of frequencies on either side over which the squares of the differences are averaged: at one alone they mostly tell how far it
/// is from a resonance.
const BESIDE: usize = 2;

/// What kriging is expected to leave at one frequency, at a place and at the points around, and what it does leave at those.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StrayTrial {
    /// Share of stray waves with which the weights are computed.
    nugget: f64,
    /// Expected power of the error at the place over the field's, with that share.
    error: f64,
    /// By how much it grows with the share of stray waves.
    slope: f64,
    /// Mean square by which the nearest points, each left out, differ from what the others predict, over the expected one.
    off: f64,
    /// By how much the expected one grows with the share of stray waves, relative to what it is.
    off_slope: f64,
}

impl StrayTrial {
    /// Trial at one frequency. `apart` are the distances between the points, as [`System::factor`] takes them, `away` those from the
    /// place (m), the nearest first, and `values` the responses at the points, points x actuators, of mean square 1 + N. `None` if the
    /// covariance matrix is singular.
    ///
    /// A point i left out differs from what the others predict by (K + N)⁻¹ y over the diagonal element of that inverse, and by the
    /// reciprocal of the latter in mean square (Rasmussen and Williams 2006, eqs. 5.10 to 5.12). The covariances K = K₀ + n D are linear in
    /// the share n of stray waves, and so is what fixed weights w leave: 1 - 2 wᵀ k + wᵀ (K + N) w.
    pub fn of(
        waves: &Waves,
        line: &SpectralLine,
        apart: &[f64],
        away: &[f64],
        values: &Mat<f64>,
    ) -> Option<Self> {
        let (points, some) = (away.len(), LEFT_OUT.min(away.len()));
        let system = System::factor(waves, line, apart, points)?;
        // D is symmetric with 0 on its diagonal: wᵀ D w is twice that of its lower triangle.
        let stray = lower_triangle(apart, points, |distance| waves.stray(line, distance));
        let covariances: Vec<f64> = away.iter().map(|distance| waves.covariance(line, *distance)).collect();
        let mut weights = Mat::from_fn(points, some + 1, |i, j| match j {
            0 => covariances[i],
            j => f64::from(u8::from(i + 1 == j)),
        });
        system.solve(weights.as_mut());
        let (strays, found) =
            (product(stray.as_ref(), weights.as_ref()), product(weights.transpose(), values.as_ref()));
        let among = |j: usize| 2.0 * (0..points).map(|i| weights[(i, j)] * strays[(i, j)]).sum::<f64>();
        let mut trial = Self { nugget: line.nugget, error: 1.0, slope: among(0), off: 0.0, off_slope: 0.0 };
        for i in 0..points {
            trial.error -= weights[(i, 0)] * covariances[i];
            trial.slope -= 2.0 * weights[(i, 0)] * waves.stray(line, away[i]);
        }
        for i in 0..some {
            let scale = 1.0 / (weights[(i, i + 1)] * some as f64);
            let squares: f64 = (0..values.ncols()).map(|a| found[(i + 1, a)].powi(2)).sum();
            trial.off += scale * squares / values.ncols() as f64;
            trial.off_slope += scale * among(i + 1);
        }
        Some(trial)
    }

    /// Expected power of the error over the field's at the frequencies of `trials`, with the share of stray waves, 0 or more, with which
    /// the points around are off by as much as expected.
    pub fn shares(trials: &[Self]) -> Vec<f64> {
        let near = |n: usize| &trials[n.saturating_sub(BESIDE)..(n + BESIDE + 1).min(trials.len())];
        // Least squares: a frequency at which the expected squares hardly grow with the share tells little of it.
        let more = |n: usize| {
            let sum =
                |of: fn(&Self) -> f64| near(n).iter().map(|trial| trial.off_slope * of(trial)).sum::<f64>();
            let (off, slope) = (sum(|trial| trial.off - 1.0), sum(|trial| trial.off_slope));
            if slope > 0.0 { (off / slope).max(-trials[n].nugget) } else { 0.0 }
        };
        (0..trials.len()).map(|n| (trials[n].error + more(n) * trials[n].slope).clamp(0.0, 1.0)).collect()
    }
}
