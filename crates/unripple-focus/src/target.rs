//! Where a focus is wanted: points and shapes, with gain and repetition rate.

use crate::FocusError;
use unripple_core::{Outline, Point, require};

/// Largest number of points over all targets: responses are computed for each. With twice this value, the
/// largest targets take twice the time.
const MOST_POINTS: usize = 100_000;

/// A target to focus on: a point, or a set of points focused on together, with gain and repetition rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The points, in metres. The reversed responses of all points are superposed.
    pub points: Vec<Point>,
    /// Level of the focus relative to those of other targets, dimensionless; negative inverts its sign.
    ///
    /// Time reversal weights the reversed response of a point by the gain, so that its velocity at the focal instant is
    /// gain · Σ∫h², up to the scale that all targets share. The sum over a set of points is first scaled so that the
    /// mean velocity of the set is what its points would have one by one, however densely they lie: gain times the mean
    /// of Σ∫h². Other methods make the velocity (for [`Method::Felt`](crate::Method::Felt), what is felt) proportional
    /// to the gain.
    pub gain: f64,
    /// Repetition rate of the focus, in Hz; `None` for a single focus. Periods are whole samples,
    /// `round(rate / rate_hz)`.
    pub rate_hz: Option<f64>,
}

impl Target {
    /// A target of one point (m) with gain 1, not repeated.
    pub fn at(point: Point) -> Self {
        Self::of(vec![point])
    }

    /// A target of a set of points (m) with gain 1, not repeated.
    pub fn of(points: Vec<Point>) -> Self {
        Self { points, gain: 1.0, rate_hz: None }
    }

    /// This target with another gain (dimensionless).
    pub fn with_gain(self, gain: f64) -> Self {
        Self { gain, ..self }
    }

    /// This target with its focus repeated at a rate in Hz.
    pub fn repeated(self, rate_hz: f64) -> Self {
        Self { rate_hz: Some(rate_hz), ..self }
    }

    /// Checks targets against the outline. Refuses an empty list, targets without points or outside the
    /// outline, and gains that are not finite or all 0.
    ///
    /// # Errors
    /// [`FocusError::Outside`] with the nearest point of the surface; [`FocusError::Count`] and [`FocusError::Range`].
    pub fn check(targets: &[Self], outline: &Outline) -> Result<(), FocusError> {
        let count = |what, found| FocusError::Count { what, expected: format!("1 to {MOST_POINTS}"), found };
        let points: usize = targets.iter().map(|t| t.points.len()).sum();
        if targets.is_empty() {
            return Err(count("targets", 0));
        }
        if points > MOST_POINTS {
            return Err(count("points over all targets", points));
        }
        for (index, target) in targets.iter().enumerate() {
            if target.points.is_empty() {
                return Err(count("points of a target", 0));
            }
            if let Some(&at) = target.points.iter().find(|p| !outline.contains(**p)) {
                return Err(FocusError::Outside { target: index, at, nearest: outline.nearest(at) });
            }
            require(
                format!("gain of target {}", index + 1),
                target.gain.is_finite(),
                "a finite number",
                target.gain,
            )?;
        }
        Ok(require("gains", targets.iter().any(|t| t.gain != 0.0), "at least one that is not 0", 0.0)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Shape;

    #[test]
    fn says_what_is_wrong_and_what_would_be_right() {
        let sheet = Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 });
        let refused = |targets: &[Target]| Target::check(targets, &sheet).unwrap_err().to_string();
        let good = Target::at(Point::from_mm(50.0, 20.0));
        assert_eq!(Target::check(std::slice::from_ref(&good), &sheet), Ok(()));
        assert_eq!(refused(&[]), "targets: expected 1 to 100000, found 0");
        assert!(refused(&[Target::of(vec![])]).starts_with("points of a target: expected 1"));
        assert_eq!(
            refused(&[good.clone(), Target::at(Point::from_mm(120.0, 20.0))]),
            "target 2: (120.0000, 20.0000) mm is outside the surface, nearest legal point (100.0000, 20.0000) mm"
        );
        assert!(refused(&[Target::at(Point::new(f64::NAN, 0.0))]).contains("nearest legal point (50.0000"));
        assert!(
            refused(&[good.clone().with_gain(f64::INFINITY)]).contains("gain of target 1: expected a finite")
        );
        assert!(refused(&[good.clone().with_gain(0.0)]).contains("at least one that is not 0"));
        assert!(refused(&[Target::of(vec![Point::default(); 100_001])]).contains("found 100001"));
    }
}
