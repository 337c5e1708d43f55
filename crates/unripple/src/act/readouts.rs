//! Grids on which levels and metrics of drives are evaluated, and a listener above them, computed once for all drives.

use super::{ActError, Hearing, LISTEN_M};
use crate::core::{Responses, Surface};
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
    /// Height of the listener, in metres.
    height: f64,
    hearing: OnceLock<Hearing<'a>>,
}

impl<'a> Readouts<'a> {
    /// Readouts of `responses`, on which drives are evaluated; each grid is computed when it is first
    /// needed.
    pub fn of(responses: &'a Responses) -> Self {
        Self::with_cells(responses, CELLS)
    }

    /// The same with the listener `height` metres above the middle of the surface, in place of [`LISTEN_M`].
    #[must_use]
    pub fn heard_at(self, height: f64) -> Self {
        Self { height, hearing: OnceLock::new(), ..self }
    }

    /// What a listener above the middle of `surface` hears, which moves as these responses say; prepared when it is first needed.
    ///
    /// # Errors
    /// Those of [`Hearing::new`].
    pub fn hearing(&self, surface: &Surface) -> Result<&Hearing<'a>, ActError> {
        match self.hearing.get() {
            Some(hearing) => Ok(hearing),
            None => {
                let hearing = Hearing::new(surface, self.responses, self.height)?;
                Ok(self.hearing.get_or_init(|| hearing))
            }
        }
    }

    /// Readouts whose grid for metrics has half as many cells along each side: for searches that compare many drives, in a fourth of the
    /// time.
    pub fn thinned(responses: &'a Responses) -> Self {
        Self::with_cells(responses, COARSE)
    }

    fn with_cells(responses: &'a Responses, cells: f64) -> Self {
        Self {
            responses,
            cells,
            fewest: OnceLock::new(),
            coarse: OnceLock::new(),
            fine: OnceLock::new(),
            height: LISTEN_M,
            hearing: OnceLock::new(),
        }
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
