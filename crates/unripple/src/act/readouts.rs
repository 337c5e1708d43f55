//! Grids on which levels and metrics of drives are evaluated, computed once for all drives.

use super::ActError;
use crate::core::Responses;
use crate::field::Readout;
use std::sync::OnceLock;

/// Cells per shortest wavelength of the grid on which metrics are computed. On 4, contrasts differ by 2 % rms; 16 take
/// four times as long.
pub const CELLS: f64 = 8.0;

/// Cells of the coarse grid per shortest wavelength: enough for displacements and for curves of contrast, while slopes
/// need as many as metrics.
const COARSE: f64 = 4.0;

/// Cells per shortest wavelength where only the motion at targets matters, which does not depend on the
/// grid.
const FEWEST: f64 = 1.0;

/// The grids on which drives are brought to their level and evaluated. Each is computed when it is first needed and
/// kept for all drives; an act uses two of them at most.
#[derive(Debug)]
pub struct Readouts<'a> {
    responses: &'a Responses,
    /// Cells per shortest wavelength of the grid for metrics.
    cells: f64,
    fewest: OnceLock<Readout<'a>>,
    coarse: OnceLock<Readout<'a>>,
    fine: OnceLock<Readout<'a>>,
}

impl<'a> Readouts<'a> {
    /// Readouts of `responses`, on which drives are evaluated; each grid is computed when it is first
    /// needed.
    pub fn of(responses: &'a Responses) -> Self {
        Self::with_cells(responses, CELLS)
    }

    /// Readouts whose grid for metrics has half as many cells along each side: for searches that compare many drives, in a fourth of the
    /// time.
    pub fn thinned(responses: &'a Responses) -> Self {
        Self::with_cells(responses, COARSE)
    }

    fn with_cells(responses: &'a Responses, cells: f64) -> Self {
        Self { responses, cells, fewest: OnceLock::new(), coarse: OnceLock::new(), fine: OnceLock::new() }
    }

    /// Readout on the grid for metrics, [`CELLS`] cells per shortest wavelength, or half as many if these are [`Readouts::thinned`].
    ///
    /// # Errors
    /// Those of [`Readout::new`].
    pub fn fine(&self) -> Result<&Readout<'a>, ActError> {
        self.made(&self.fine, self.cells)
    }

    /// Readout on a coarser grid, with half as many cells along each side as metrics have by default.
    ///
    /// # Errors
    /// Those of [`Readout::new`].
    pub fn coarse(&self) -> Result<&Readout<'a>, ActError> {
        self.made(&self.coarse, COARSE)
    }

    /// Readout on a grid of one cell per shortest wavelength.
    pub(super) fn fewest(&self) -> Result<&Readout<'a>, ActError> {
        self.made(&self.fewest, FEWEST)
    }

    fn made<'b>(&self, one: &'b OnceLock<Readout<'a>>, cells: f64) -> Result<&'b Readout<'a>, ActError> {
        match one.get() {
            Some(readout) => Ok(readout),
            None => {
                let readout = Readout::new(self.responses, cells)?;
                Ok(one.get_or_init(|| readout))
            }
        }
    }
}
