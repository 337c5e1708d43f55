//! Signal processing for measuring responses: stimuli, deconvolution, and quality of the responses.

mod average;
mod band;
mod comb;
mod cross;
mod cut;
mod decay;
mod deconvolver;
mod delay;
mod gate;
mod harmonics;
mod line;
mod powers;
mod quality;
mod reciprocity;
mod remap;
mod schedule;
mod stimulus;
mod sweep;
mod transform;

pub use average::{Average, Outliers};
pub use band::Band;
pub use cross::CrossSpectra;
pub use decay::Decay;
pub use deconvolver::{Deconvolver, Inversion, Workspace};
pub use delay::{Delay, shift};
pub use gate::{Gate, onset};
pub use harmonics::{Harmonic, Harmonics, Split};
pub(crate) use line::line;
pub use powers::band_powers;
pub use quality::{Quality, clipped, snr_db};
pub use reciprocity::{Pair, Reciprocity};
pub use remap::{Moves, Remap};
pub use schedule::Schedule;
pub use stimulus::Stimulus;
pub use sweep::Sweep;

use unripple_core::OutOfRange;
use unripple_dsp::DspError;

/// Checks that a number is positive and finite.
///
/// # Errors
/// [`DspError::Range`] if a number is not positive and finite.
fn positive(what: &'static str, found: f64) -> Result<(), DspError> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(DspError::Range(OutOfRange::new(what, "positive and finite", found)))
}

/// Checks that two counts are equal.
///
/// # Errors
/// [`DspError::Size`] if two counts differ.
fn same(what: &'static str, expected: usize, found: usize) -> Result<(), DspError> {
    if expected == found { Ok(()) } else { Err(DspError::Size { what, expected, found }) }
}
