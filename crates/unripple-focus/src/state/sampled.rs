//! Velocities of stored points at the focal instant as a linear function of the drive.

use crate::FocusError;
use crate::recording::{SampledRecorder, locate};
use unripple_core::{Point, SampledResponses};
use unripple_linalg::{Mat, MatRef, product};

/// Largest number of values of responses that are held at once, a GiB of them. With twice this value, libraries of twice the size take
/// twice the memory.
const MOST_VALUES: usize = 1 << 27;

/// Linear model of the stored points of sampled responses under a drive: its state is made of their
/// velocities at the focal instant.
#[derive(Debug)]
pub(crate) struct SampledPlant<'r> {
    responses: &'r SampledResponses,
    /// Velocity of each point at the focal instant after an impulse at each sample, over the rate: samples of all channels x points.
    map: Mat<f64>,
}

impl<'r> SampledPlant<'r> {
    /// Stored points under drives that last one window of `length` samples, the last of which is the focal
    /// instant.
    ///
    /// # Errors
    /// [`FocusError::Count`] if the responses are shorter, or too many.
    pub fn single(responses: &'r SampledResponses, length: usize) -> Result<Self, FocusError> {
        SampledRecorder::new(responses, length)?;
        let (channels, points) = (responses.ports.len(), responses.points.len());
        let found = channels.saturating_mul(length).saturating_mul(points);
        if found > MOST_VALUES {
            let expected = format!("at most {MOST_VALUES} (thin the points to half the shortest wavelength)");
            return Err(FocusError::Count { what: "values of the responses", expected, found });
        }
        let rate = responses.conditions.rate;
        let map = Mat::from_fn(channels * length, points, |row, point| {
            let age = length - 1 - row % length;
            f64::from(responses.response(row / length, point)[age]) / rate
        });
        Ok(Self { responses, map })
    }

    /// Number of stored points.
    pub fn points(&self) -> usize {
        self.map.ncols()
    }

    /// The map from drives to the state, transposed: samples of all channels x points.
    pub fn map(&self) -> &Mat<f64> {
        &self.map
    }

    /// Adds the drive `Gᵀ z` to the channels, each a row of samples; G is the map from drives to the stored
    /// points' velocities.
    pub fn emit(&self, z: &[f64], channels: &mut [f64]) {
        let made = product(self.map.as_ref(), MatRef::from_column_major_slice(z, z.len(), 1));
        channels.iter_mut().zip(made.col_as_slice(0)).for_each(|(d, made)| *d += made);
    }

    /// Weights that give the velocity at points from the state, stored points x points, and the stored
    /// points used for them.
    pub fn readout(&self, target: usize, points: &[Point]) -> Result<(Mat<f64>, Vec<Point>), FocusError> {
        let stored =
            points.iter().map(|at| locate(self.responses, target, *at)).collect::<Result<Vec<_>, _>>()?;
        let weights = Mat::from_fn(self.points(), stored.len(), |p, k| f64::from(stored[k] == p));
        Ok((weights, stored.iter().map(|p| self.responses.points[*p]).collect()))
    }

    /// Weights that give the velocity at all stored points from the state, which are an identity matrix, and
    /// the stored points (m).
    pub fn cells(&self) -> (Mat<f64>, Vec<Point>) {
        let count = self.points();
        (Mat::identity(count, count), self.responses.points.clone())
    }
}
