//! One input of a convolver, with the samples that have entered it.

use super::history::History;
use super::resample::Decimator;

/// The state of one input.
pub(super) struct Input {
    /// Brings samples to the lower rate.
    pub(super) decimator: Decimator,
    /// The last blocks, as spectra.
    pub(super) history: History,
}
