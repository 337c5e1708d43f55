//! Contrast from the field at the focal instant alone, for callers that need no other metric.

use crate::{Field, FieldError};
use unripple_core::Point;

/// Velocity at a target and outside the focal discs, at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Velocity at the target, the mean over its points, in m/s.
    pub velocity: f64,
    /// Root mean square of the velocity over the field's points outside the focal discs, in m/s; 0 without
    /// such points.
    pub rms_outside: f64,
}

impl Instant {
    /// Contrast: magnitude of the velocity at the target over the rms outside, a ratio; `None` where nothing
    /// moves outside.
    pub fn contrast(&self) -> Option<f64> {
        (self.rms_outside > 0.0).then(|| self.velocity.abs() / self.rms_outside)
    }
}

impl Field<'_> {
    /// Mean velocity of a target's points (m) and rms velocity outside the focal discs, at an instant (s)
    /// that is rounded to a sample. Points outside are farther than the focal radius from each point of
    /// `focused`: the points of this target and of all others that are in focus at the same time.
    ///
    /// # Errors
    /// Those of [`Field::traces`] and [`Field::snapshots`].
    pub fn at_instant(
        &self,
        instant: f64,
        target: &[Point],
        focused: &[Point],
    ) -> Result<Instant, FieldError> {
        let traces = self.traces(target, instant)?;
        let last = traces.iter().filter_map(|trace| trace.velocity.last());
        let velocity = last.sum::<f64>() / traces.len().max(1) as f64;
        let radius = self.conditions.focal_radius();
        let outside = |point: &Point| focused.iter().all(|at| at.distance(*point) > radius);
        let shots = self.snapshots(&[instant])?;
        let values = shots.iter().flat_map(|shot| self.points().iter().zip(&shot.velocity));
        let (count, squares) = values
            .filter(|(point, _)| outside(point))
            .fold((0usize, 0.0), |(count, sum), (_, v)| (count + 1, sum + f64::from(*v).powi(2)));
        Ok(Instant { velocity, rms_outside: (squares / count.max(1) as f64).sqrt() })
    }
}
