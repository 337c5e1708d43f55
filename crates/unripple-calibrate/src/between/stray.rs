//! Expected error of kriging at one place; the share of stray waves is estimated by leaving out each of the
//! nearest points in turn.

use super::medium::{SpectralLine, Waves};
use super::system::{System, lower_triangle};
use unripple_linalg::{Mat, product};

/// Number of nearest points that are left out in turn and predicted from the others. With half as many,
/// chance decides; more lie too far away to represent the place.
const LEFT_OUT: usize = 12;

/// Number of frequencies on either side over which the squares of the differences are averaged: at a single
/// frequency they mostly depend on its distance from a resonance.
const BESIDE: usize = 2;

/// Errors of kriging at one frequency: the expected ones at a place and at the points around it, and the
/// actual ones at these points, each left out in turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StrayTrial {
    /// Share of stray waves with which the weights are computed.
    nugget: f64,
    /// Expected power of the error at the place relative to the field's power, with the share `nugget`.
    error: f64,
    /// Derivative of `error` by the share of stray waves.
    slope: f64,
    /// Mean square difference between the nearest points, each left out in turn, and their predictions from
    /// the others, relative to the expected mean square.
    off: f64,
    /// Derivative of the expected mean square by the share of stray waves, relative to that mean square.
    off_slope: f64,
}

impl StrayTrial {
    /// Computes the errors at one frequency. `apart` are the distances between the points, as
    /// [`System::factor`] takes them, `away` those from the place (m), the nearest first, and `values` the
    /// responses at the points, points x actuators, of mean square 1 + N. `None` if the covariance matrix is
    /// singular.
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

    /// Expected power of the interpolation error relative to the field's, at the frequencies of `trials`.
    /// The share of stray waves, 0 or more, is chosen so that the points around differ from their
    /// predictions by as much as expected.
    pub fn shares(trials: &[Self]) -> Vec<f64> {
        let near = |n: usize| &trials[n.saturating_sub(BESIDE)..(n + BESIDE + 1).min(trials.len())];
        // Least squares: a frequency at which the expected squares hardly grow with the share contains
        // little information about it.
        let more = |n: usize| {
            let sum =
                |of: fn(&Self) -> f64| near(n).iter().map(|trial| trial.off_slope * of(trial)).sum::<f64>();
            let (off, slope) = (sum(|trial| trial.off - 1.0), sum(|trial| trial.off_slope));
            if slope > 0.0 { (off / slope).max(-trials[n].nugget) } else { 0.0 }
        };
        (0..trials.len()).map(|n| (trials[n].error + more(n) * trials[n].slope).clamp(0.0, 1.0)).collect()
    }
}
