//! Shortest duration of a drive or a response that carries a wave of the band.

use super::ActError;
use crate::core::Conditions;

/// Returns an error for a duration (s) shorter than one period at the top of the band: no wave of the band
/// fits into it, so a drive of that length cannot focus, and responses of that length contain nothing to
/// focus with.
///
/// # Errors
/// [`ActError::Short`], with the shortest duration allowed.
pub fn carries(conditions: &Conditions, seconds: f64) -> Result<(), ActError> {
    let top = conditions.band[1];
    // A rounded period is as good as an exact one.
    if seconds * top >= 1.0 - 1e-9 {
        Ok(())
    } else {
        Err(ActError::Short { least: 1.0 / top, top, found: seconds })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::{Outline, Shape};

    #[test]
    fn a_period_of_the_top_is_enough_and_less_is_not() {
        let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
        let conditions = Conditions { rate: 48e3, band: [100.0, 3000.0], lambda_min: 0.015, outline };
        for enough in [1.0 / 3000.0, 0.0004, 1.0] {
            assert_eq!(carries(&conditions, enough), Ok(()));
        }
        for short in [0.0, 1.0 / 48e3, 0.9999 / 3000.0] {
            let error = carries(&conditions, short).unwrap_err();
            assert!(error.is_failed_work(), "{error}");
            assert!(error.to_string().contains("at least 0.3333 ms"), "{error}");
        }
    }
}
