//! The objective that a search for places maximises.

use crate::PlacementError;
use unripple_core::require;

/// The objective to be maximised: mean, least value or a quantile of the contrasts at all targets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Objective {
    /// The weighted mean of the contrasts.
    #[default]
    Mean,
    /// The least contrast.
    Worst,
    /// The contrast that this share (0 to 1) of the targets, by weight, stays below.
    Quantile(f64),
}

impl Objective {
    /// Checks that the share of a quantile is from 0 to 1.
    ///
    /// # Errors
    /// [`PlacementError::Range`] for a share that is not 0 to 1.
    pub fn check(self) -> Result<(), PlacementError> {
        if let Self::Quantile(share) = self {
            require("share of a quantile", (0.0..=1.0).contains(&share), "0 to 1", share)?;
        }
        Ok(())
    }

    /// The value of the objective for some contrasts and their weights, whose sum is 1; itself a contrast
    /// (ratio).
    ///
    /// ```
    /// use unripple_placement::Objective;
    ///
    /// let (contrasts, weights) = ([30.0, 10.0, 20.0, 40.0], [0.25; 4]);
    /// assert_eq!(Objective::Mean.of(&contrasts, &weights), 25.0);
    /// assert_eq!(Objective::Worst.of(&contrasts, &weights), 10.0);
    /// assert_eq!(Objective::Quantile(0.4).of(&contrasts, &weights), 20.0);
    /// ```
    pub fn of(self, contrasts: &[f64], weights: &[f64]) -> f64 {
        match self {
            Self::Mean => contrasts.iter().zip(weights).map(|(contrast, weight)| contrast * weight).sum(),
            Self::Worst => contrasts.iter().copied().fold(f64::INFINITY, f64::min),
            Self::Quantile(share) => {
                let mut order: Vec<usize> = (0..contrasts.len()).collect();
                order.sort_by(|a, b| contrasts[*a].total_cmp(&contrasts[*b]));
                let mut below = 0.0;
                let found = order.iter().find(|i| {
                    below += weights[**i];
                    // Sums of weights have rounding errors.
                    below >= share - 1e-9
                });
                found.or(order.last()).map_or(0.0, |i| contrasts[*i])
            }
        }
    }
}
