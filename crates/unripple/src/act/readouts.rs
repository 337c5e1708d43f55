//! What it takes to read a surface where levels and figures are taken, made once for all drives.

use super::{ActError, CELLS};
use crate::core::Responses;
use crate::field::Readout;
use std::sync::OnceLock;

/// Cells of the coarse grid per shortest wavelength: enough for displacements and for curves of contrast, while slopes take as many as
/// figures.
const COARSE: f64 = 4.0;

/// Cells where only what is felt at a target is asked, which no grid changes.
const FEWEST: f64 = 1.0;

/// The grids that drives are brought to their level and judged on, each made when it is first asked for and kept for all drives: an act
/// takes two of them at most.
#[derive(Debug)]
pub struct Readouts<'a> {
    responses: &'a Responses,
    fewest: OnceLock<Readout<'a>>,
    coarse: OnceLock<Readout<'a>>,
    fine: OnceLock<Readout<'a>>,
}

impl<'a> Readouts<'a> {
    /// Of the responses that drives are judged on.
    pub fn of(responses: &'a Responses) -> Self {
        Self { responses, fewest: OnceLock::new(), coarse: OnceLock::new(), fine: OnceLock::new() }
    }

    /// On the grid of figures, [`CELLS`].
    ///
    /// # Errors
    /// Those of [`Readout::new`].
    pub fn fine(&self) -> Result<&Readout<'a>, ActError> {
        self.made(&self.fine, CELLS)
    }

    /// On half as many cells each way.
    ///
    /// # Errors
    /// Those of [`Readout::new`].
    pub fn coarse(&self) -> Result<&Readout<'a>, ActError> {
        self.made(&self.coarse, COARSE)
    }

    /// On a cell a wavelength.
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
