//! Impulse responses from actuators to points, sampled or as modes (poles and residues).

use crate::{CoreError, Outline, Point, Pole};
use std::sync::Arc;
use unripple_linalg::{Mat, MatRef, product};

/// Impulse responses from the actuators to points of the surface: as modes (poles and residues), or as samples.
#[derive(Clone, Debug)]
pub enum Responses {
    /// Responses in modal form, which can be evaluated at any point.
    Modal(ModalResponses),
    /// Sampled responses at a fixed set of points.
    Sampled(SampledResponses),
}

impl Responses {
    /// Frequency band, sample rate, shortest wavelength λ_min and region for which the responses are valid.
    pub fn conditions(&self) -> &Conditions {
        match self {
            Self::Modal(r) => &r.conditions,
            Self::Sampled(r) => &r.conditions,
        }
    }

    /// The actuators (names and places), in channel order.
    pub fn ports(&self) -> &[Port] {
        match self {
            Self::Modal(r) => &r.ports,
            Self::Sampled(r) => &r.ports,
        }
    }
}

/// The sample rate, frequency band and region for which responses are valid.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Samples per second.
    pub rate: f64,
    /// Lowest and highest frequency, in Hz.
    pub band: [f64; 2],
    /// Shortest wavelength in the band, in metres: 2π/k at the highest frequency.
    pub lambda_min: f64,
    /// The outline of the sheet: the region in which points may lie.
    pub outline: Outline,
}

/// Radius of the focal disc around a target, as a multiple of the shortest wavelength. The disc holds the main lobe and
/// the first side lobe of a focus; only points beyond it count as outside. Halved, the first side lobe would count as
/// noise and every contrast would fall; doubled, less of the surface would be left to compare with.
pub const FOCAL_RADIUS: f64 = 4.0 / 3.0;

impl Conditions {
    /// Radius of the focal disc, in metres: [`FOCAL_RADIUS`] times the shortest wavelength.
    pub fn focal_radius(&self) -> f64 {
        FOCAL_RADIUS * self.lambda_min
    }
}

/// An actuator of a set of responses: its name and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    /// Name of the actuator.
    pub name: String,
    /// Where the actuator acts on the sheet, in metres.
    pub at: Point,
}

/// Readout weights of all modes at any point of the surface, in 1/√kg: mass-normalised mode shapes, or linear combinations of
/// them where loads couple the modes.
pub trait Shapes: Send + Sync + std::fmt::Debug {
    /// Number of modes n, the length of a row of weights.
    fn modes(&self) -> usize;

    /// Writes the weights of every mode at one point (m), in 1/√kg, into `row` of length [`Shapes::modes`].
    fn at(&self, point: Point, row: &mut [f64]);

    /// The weights of every mode at many points (m), in 1/√kg, as a matrix of points x modes.
    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mut weights = Mat::zeros(points.len(), self.modes());
        let mut row = vec![0.0; self.modes()];
        for (i, point) in points.iter().enumerate() {
            self.at(*point, &mut row);
            row.iter().enumerate().for_each(|(m, w)| weights[(i, m)] = *w);
        }
        weights
    }

    /// The shapes of which these are combinations, where they are: at many points, reading those costs less. `None` otherwise.
    fn mixture(&self) -> Option<Mixture<'_>> {
        None
    }
}

/// Mode shapes as combinations of others: shape m is the sum of `mixing[(b, columns[m])]` times shape b of `base`.
///
/// ```
/// use unripple_core::{Mixture, Point, Shapes};
/// use unripple_linalg::mat;
///
/// /// Deflections 1 and x.
/// #[derive(Debug)]
/// struct Rigid;
///
/// impl Shapes for Rigid {
///     fn modes(&self) -> usize {
///         2
///     }
///
///     fn at(&self, point: Point, row: &mut [f64]) {
///         row.copy_from_slice(&[1.0, point.x]);
///     }
/// }
///
/// // Three modes, of the shapes x, 1 + 2x and x.
/// let mixing = mat![[1.0, 0.0], [2.0, 1.0_f64]];
/// let mixture = Mixture { base: &Rigid, mixing: mixing.as_ref(), columns: &[1, 0, 1] };
/// let moved = mixture.of_base(mat![[1.0], [10.0], [100.0]].as_ref());
/// assert_eq!((moved[(0, 0)], moved[(1, 0)]), (10.0, 2.0 * 10.0 + 101.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mixture<'a> {
    /// The shapes that are combined.
    pub base: &'a dyn Shapes,
    /// Coefficients of the combinations, base shapes x columns.
    pub mixing: MatRef<'a, f64>,
    /// The column of each shape; several shapes may share one.
    pub columns: &'a [usize],
}

impl Mixture<'_> {
    /// The motion of the base shapes (base shapes x samples) that is equal to a `motion` of the combined ones (shapes x samples).
    ///
    /// # Panics
    /// If `motion` has fewer rows than there are `columns`, or one of these is not a column of `mixing`.
    pub fn of_base(&self, motion: MatRef<'_, f64>) -> Mat<f64> {
        let mut joined = Mat::zeros(self.mixing.ncols(), motion.ncols());
        for (mut sums, motion) in joined.as_mut().col_iter_mut().zip(motion.col_iter()) {
            self.columns.iter().enumerate().for_each(|(m, column)| sums[*column] += motion[m]);
        }
        product(self.mixing, joined.as_ref())
    }
}

/// Impulse responses in modal form. The velocity at a point x after a unit impulse at actuator a is
/// `h(t) = Σ_m input[a, m] · shapes[m](x) · velocity_m(t)`, with [`Pole::velocity`] of each mode m.
#[derive(Clone, Debug)]
pub struct ModalResponses {
    /// The actuators, in channel order.
    pub ports: Vec<Port>,
    /// The poles of the modes, in order of ascending frequency.
    pub poles: Vec<Pole>,
    /// Input weights of the actuators (modal force per unit of drive), actuators x modes.
    pub input: Mat<f64>,
    /// Readout weights at any point: mode shapes, in 1/√kg.
    pub shapes: Arc<dyn Shapes>,
    /// Frequency band, sample rate and region for which the responses are valid.
    pub conditions: Conditions,
    /// Upper bound of the relative error of the sheet's computed natural frequencies; 0 if they are exact,
    /// or were not computed but fitted to measurements.
    pub frequency_error: f64,
    /// Bounds of the errors of each mode, as many as there are poles; empty where they are not known, as where loads change the modes.
    pub mode_errors: Vec<ModeError>,
}

/// Upper bounds of the relative errors of one computed mode; 0 where there are rounding errors alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModeError {
    /// That of the natural frequency.
    pub frequency: f64,
    /// That of the decay time; `None` where no bound is known.
    pub decay: Option<f64>,
    /// That of the shape, root mean square over the sheet. What neighbouring modes exchange counts as errors of their frequencies, since
    /// as much of it is seen in a response as these have drifted apart.
    pub shape: f64,
}

/// Sampled impulse responses at fixed points, as float32 values in m/s per unit impulse, stored as `[point][actuator][sample]`. Clones
/// share the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledResponses {
    /// The actuators, in channel order.
    pub ports: Vec<Port>,
    /// The points, in the order in which their responses are stored.
    pub points: Vec<Point>,
    /// Frequency band, sample rate and region for which the responses are valid.
    pub conditions: Conditions,
    samples: usize,
    data: Arc<Vec<f32>>,
}

impl SampledResponses {
    /// Responses from an array `data` of values in m/s per unit impulse, in the order `[point][actuator][sample]`, with
    /// `samples` values in each response.
    ///
    /// # Errors
    /// [`CoreError::Size`] if the length of `data` is not the product of the numbers of points, actuators and samples.
    pub fn new(
        ports: Vec<Port>,
        points: Vec<Point>,
        conditions: Conditions,
        samples: usize,
        data: Vec<f32>,
    ) -> Result<Self, CoreError> {
        let expected = ports.len() * points.len() * samples;
        if data.len() != expected {
            return Err(CoreError::Size { what: "response samples", expected, found: data.len() });
        }
        Ok(Self { ports, points, conditions, samples, data: Arc::new(data) })
    }

    /// Number of samples in each response.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// All samples, in m/s per unit impulse, as `[point][actuator][sample]`.
    pub fn data(&self) -> &[f32] {
        &self.data
    }

    /// The response from one actuator to one point, given by their indices: samples in m/s per unit impulse.
    pub fn response(&self, actuator: usize, point: usize) -> &[f32] {
        let start = (point * self.ports.len() + actuator) * self.samples;
        &self.data[start..start + self.samples]
    }

    /// The responses at a subset of the points: those with the indices `chosen`, in the order of that list.
    ///
    /// # Errors
    /// [`CoreError::Size`] for an index that is not below the number of points.
    pub fn select(&self, chosen: &[usize]) -> Result<Self, CoreError> {
        let expected = self.points.len();
        if let Some(found) = chosen.iter().copied().find(|point| *point >= expected) {
            return Err(CoreError::Size { what: "points that are chosen from", expected, found: found + 1 });
        }
        let each = self.ports.len() * self.samples;
        let data = chosen.iter().flat_map(|point| &self.data[point * each..][..each]).copied().collect();
        Ok(Self {
            ports: self.ports.clone(),
            points: chosen.iter().map(|point| self.points[*point]).collect(),
            conditions: self.conditions.clone(),
            samples: self.samples,
            data: Arc::new(data),
        })
    }

    /// Appends the points of another set of responses and their responses. Both sets must have the same numbers of actuators
    /// and samples; ports and conditions stay those of `self`.
    ///
    /// # Errors
    /// [`CoreError::Size`] if the numbers of actuators or of samples differ.
    pub fn joined(mut self, other: Self) -> Result<Self, CoreError> {
        for (what, expected, found) in [
            ("actuators of the responses to be joined", self.ports.len(), other.ports.len()),
            ("samples of the responses to be joined", self.samples, other.samples),
        ] {
            if expected != found {
                return Err(CoreError::Size { what, expected, found });
            }
        }
        self.points.extend(other.points);
        Arc::make_mut(&mut self.data).extend_from_slice(&other.data);
        Ok(self)
    }

    /// Index of the stored point nearest to a place (m); `None` if there are no points.
    pub fn nearest(&self, place: Point) -> Option<usize> {
        (0..self.points.len())
            .min_by(|&a, &b| self.points[a].distance(place).total_cmp(&self.points[b].distance(place)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Outline, Shape};

    fn two_ports(points: &[f64]) -> SampledResponses {
        let port = |name: &str| Port { name: name.into(), at: Point::new(0.0, 0.0) };
        let conditions = Conditions {
            rate: 48e3,
            band: [0.0, 3e3],
            lambda_min: 0.0145,
            outline: Outline::new(Shape::Rectangle { width: 1.0, height: 1.0 }),
        };
        let data = points.iter().flat_map(|x| [*x as f32, 1.0, -*x as f32, 2.0]).collect();
        let points = points.iter().map(|x| Point::new(*x, 0.5)).collect();
        SampledResponses::new(vec![port("a1"), port("a2")], points, conditions, 2, data).unwrap()
    }

    #[test]
    fn what_is_parted_and_joined_is_the_same() {
        let whole = two_ports(&[0.1, 0.2, 0.3]);
        let parts = whole.select(&[0, 1]).unwrap().joined(whole.select(&[2]).unwrap()).unwrap();
        assert_eq!(parts, whole);
        let turned = whole.select(&[2, 0]).unwrap();
        assert_eq!(turned.points, [whole.points[2], whole.points[0]]);
        assert_eq!(turned.response(1, 0), whole.response(1, 2));
    }

    #[test]
    fn others_are_refused() {
        let whole = two_ports(&[0.1, 0.2]);
        assert!(whole.select(&[2]).is_err());
        let mut one = whole.clone();
        one.ports.pop();
        assert!(whole.joined(one).is_err());
    }
}
