//! The points at which fields are evaluated, with the weights of the modes there.

use crate::{FieldError, Grid};
use std::sync::{Arc, OnceLock};
use unripple_core::{Point, Responses};
use unripple_linalg::Mat;

/// The points at which fields of some responses are evaluated: those of a [`Grid`], or the stored ones of
/// sampled responses. The weights of every mode at every point are computed once, for the fields of any
/// number of drives.
///
/// ```
/// use unripple_core::{Conditions, Drive, Outline, Point, Port, Responses, SampledResponses, Shape};
/// use unripple_field::{Field, Readout};
///
/// let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
/// let conditions = Conditions { rate: 1000.0, band: [0.0, 100.0], lambda_min: 0.03, outline };
/// let (ports, at) = (vec![Port { name: "a1".into(), at: Point::new(0.1, 0.05) }], Point::new(0.05, 0.05));
/// let library = Responses::Sampled(SampledResponses::new(ports, vec![at], conditions, 2, vec![1.0, 0.5])?);
/// let [once, twice] = [1.0, 2.0].map(|push| Drive::new(1000.0, vec!["a1".into()], vec![vec![push]]));
/// let (once, twice) = (once?, twice?);
/// let readout = Readout::new(&library, 8.0)?;
/// for drive in [&once, &twice] {
///     let (shared, own) = (readout.field(drive)?, Field::new(&library, drive, 8.0)?);
///     assert_eq!(shared.snapshots(&[0.001])?, own.snapshots(&[0.001])?);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Readout<'a> {
    pub(crate) responses: &'a Responses,
    pub(crate) grid: Option<Grid>,
    pub(crate) kept: Arc<Kept>,
}

/// Cached data of a grid: its points inside the outline, and the weights of every mode at them.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    /// The points of the grid inside the outline, in metres.
    pub points: Vec<Point>,
    /// Weights of every mode at these points (points x modes), in chunks of points; computed when first needed.
    pub weights: OnceLock<Vec<Mat<f32>>>,
}

impl<'a> Readout<'a> {
    /// Points for evaluating fields: a grid of `cells` cells per shortest wavelength (metrics use 8), or the
    /// stored points of sampled responses.
    ///
    /// # Errors
    /// [`FieldError::Range`] if the grid would have no or too many cells.
    pub fn new(responses: &'a Responses, cells: f64) -> Result<Self, FieldError> {
        let grid = match responses {
            Responses::Modal(_) => Some(Grid::new(responses.conditions(), cells)?),
            Responses::Sampled(_) => None,
        };
        let points = grid.as_ref().map(Grid::points).unwrap_or_default();
        Ok(Self { responses, grid, kept: Arc::new(Kept { points, weights: OnceLock::new() }) })
    }
}
