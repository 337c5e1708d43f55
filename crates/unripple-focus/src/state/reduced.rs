//! States of modes with linearly dependent shapes: one coordinate per independent shape.

use super::modal::{lattice, ringing, steady};
use super::room::fits;
use crate::FocusError;
use unripple_core::{ModalResponses, Point};
use unripple_linalg::{Accum, Mat, MatRef, all_threads, multiply, product, symmetric};

/// Combinations of shapes with less than this share of the energy of the strongest, over the surface, count
/// as zero. Larger, independent shapes would be lost; smaller, rounding would count as a shape.
const ALIKE: f64 = 1e-12;

/// Linear model of oscillations with linearly dependent shapes, under a drive of one window or period: its
/// state is made of the velocities of independent shapes.
///
/// Under loads, responses are sums of oscillations whose large parts cancel. With Φ their shapes over the surface and
/// `ΦᵀΦ = R Σ² Rᵀ`, every readout lies in the span of R, and `Rᵀ c` is small where c is not.
#[derive(Debug)]
pub(crate) struct ReducedPlant<'r> {
    responses: &'r ModalResponses,
    /// R, oscillations x independent shapes.
    basis: Mat<f64>,
    /// `Rᵀ G` transposed: samples of all channels x independent shapes.
    map: Mat<f64>,
}

impl<'r> ReducedPlant<'r> {
    /// A model for drives of one window of `length` samples, whose last sample is the focal instant, or with
    /// `periodic` for periodic drives with a period of `length` samples.
    ///
    /// # Errors
    /// [`FocusError::Decomposition`]; [`FocusError::Count`] if an oscillation never becomes steady, and for too many samples or
    /// too large a surface for the number of oscillations.
    pub fn new(
        responses: &'r ModalResponses,
        length: usize,
        stretch: f64,
        periodic: bool,
    ) -> Result<Self, FocusError> {
        let (cells, modes) = (lattice(responses), responses.poles.len());
        fits("samples of the window or period times modes", length, modes)?;
        fits("cells of the surface times modes", cells.len(), modes)?;
        let shapes = responses.shapes.at_all(&cells);
        let gram = product(shapes.transpose(), shapes.as_ref());
        let (values, vectors) = symmetric(gram.as_ref()).ok_or(FocusError::Decomposition)?;
        let count = values.len();
        let most = values[count - 1];
        let first = (0..count).position(|i| values[i] > ALIKE * most).ok_or(FocusError::Decomposition)?;
        let basis = vectors.subcols(first, count - first).to_owned();
        let channels = responses.ports.len();
        fits("samples of all channels times modes", channels * length, basis.ncols())?;
        let ringing = match periodic {
            true => steady(responses, length, stretch)?,
            false => ringing(responses, length, stretch),
        };
        let mut map = Mat::zeros(channels * length, basis.ncols());
        for a in 0..channels {
            let weighed =
                Mat::from_fn(basis.nrows(), basis.ncols(), |m, i| responses.input[(a, m)] * basis[(m, i)]);
            let part = map.as_mut().subrows_mut(a * length, length);
            multiply(part, Accum::Replace, ringing.as_ref(), weighed.as_ref(), 1.0, all_threads());
        }
        Ok(Self { responses, basis, map })
    }

    /// Number of linearly independent mode shapes, which is the number of the state's coordinates.
    pub fn shapes(&self) -> usize {
        self.basis.ncols()
    }

    /// The map from drives to the state, transposed: samples of all channels x coordinates.
    pub fn map(&self) -> &Mat<f64> {
        &self.map
    }

    /// Adds the drive `Gᵀ z` to the channels, each a row of samples; G is the map from drives to the state.
    pub fn emit(&self, z: &[f64], channels: &mut [f64]) {
        let made = product(self.map.as_ref(), MatRef::from_column_major_slice(z, z.len(), 1));
        channels.iter_mut().zip(made.col_as_slice(0)).for_each(|(d, made)| *d += made);
    }

    /// Weights that give the velocity at points from the state, shapes x points.
    pub fn readout(&self, points: &[Point]) -> Mat<f64> {
        product(self.basis.transpose(), self.responses.shapes.at_all(points).transpose())
    }

    /// Weights that give the velocity at cells all over the surface from the state, shapes x cells, and the
    /// cells' centres (m).
    pub fn cells(&self) -> (Mat<f64>, Vec<Point>) {
        let points = lattice(self.responses);
        (self.readout(&points), points)
    }
}
