//! Piecewise-linear functions.

use crate::EffectsError;
use crate::error::{counted, within};
use crate::limits::MOST_POINTS;

/// A piecewise-linear function: linear between its points, constant beyond its ends. Two points of equal abscissa make a
/// step, where the function has the value of the later point.
///
/// ```
/// use unripple_effects::Curve;
///
/// let ramp = Curve::new("time", vec![(0.0, 0.0), (0.2, 1.0)], [0.0, 10.0], [0.0, 1.0])?;
/// assert_eq!((ramp.at(-1.0), ramp.at(0.1), ramp.at(5.0)), (0.0, 0.5, 1.0));
/// # Ok::<(), unripple_effects::EffectsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    points: Vec<(f64, f64)>,
    /// Integral from the first point to each.
    area: Vec<f64>,
}

impl Curve {
    /// The curve through points (abscissa, value) in order of non-decreasing abscissa. `along` and `values` are the allowed ranges
    /// of abscissae and values, in the curve's own units; `what` names the abscissa in error messages.
    ///
    /// # Errors
    /// [`EffectsError::Size`] if there are no points or more than [`MOST_POINTS`], [`EffectsError::Order`] if an abscissa is less than the
    /// one before, [`EffectsError::Range`] if a coordinate is out of its range.
    pub fn new(
        what: &'static str,
        points: Vec<(f64, f64)>,
        along: [f64; 2],
        values: [f64; 2],
    ) -> Result<Self, EffectsError> {
        counted("points of a curve", points.len(), 1, MOST_POINTS)?;
        for (x, y) in &points {
            within(what, *x, along)?;
            within("value of a curve", *y, values)?;
        }
        if let Some(pair) = points.windows(2).find(|pair| pair[1].0 < pair[0].0) {
            return Err(EffectsError::Order { what, before: pair[0].0, found: pair[1].0 });
        }
        Ok(Self::through(points))
    }

    /// A constant function, its value in the curve's unit.
    pub fn constant(value: f64) -> Self {
        Self::through(vec![(0.0, value)])
    }

    /// The curve through points that have been checked, with its integral at each.
    fn through(points: Vec<(f64, f64)>) -> Self {
        let mut area = vec![0.0; points.len()];
        for i in 1..points.len() {
            let ((x0, y0), (x1, y1)) = (points[i - 1], points[i]);
            area[i] = area[i - 1] + 0.5 * (x1 - x0) * (y0 + y1);
        }
        Self { points, area }
    }

    /// The points (abscissa, value) that define the curve, in the curve's units.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Whether the function is constant.
    pub fn is_constant(&self) -> bool {
        self.points.iter().all(|(_, y)| *y == self.points[0].1)
    }

    /// Abscissa of the last point, in the unit of the curve's abscissa.
    pub fn end(&self) -> f64 {
        self.points[self.points.len() - 1].0
    }

    /// The value at the abscissa `x`, in the curve's unit.
    pub fn at(&self, x: f64) -> f64 {
        let after = self.points.partition_point(|p| p.0 <= x);
        match after {
            0 => self.points[0].1,
            n if n == self.points.len() => self.points[n - 1].1,
            n => {
                let ((x0, y0), (x1, y1)) = (self.points[n - 1], self.points[n]);
                y0 + (y1 - y0) * (x - x0) / (x1 - x0)
            }
        }
    }

    /// Integral of the function from the abscissa of its first point to `x` (for a smaller `x`, minus the
    /// integral from `x` to the first point), in the unit of the value times that of the abscissa.
    pub fn integral(&self, x: f64) -> f64 {
        let n = self.points.partition_point(|p| p.0 <= x).saturating_sub(1);
        let (x0, y0) = self.points[n];
        let mean = if x < x0 { y0 } else { 0.5 * (y0 + self.at(x)) };
        self.area[n] + mean * (x - x0)
    }
}
