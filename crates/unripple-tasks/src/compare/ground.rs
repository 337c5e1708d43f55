//! What the drives of all methods of a comparison have in common.

use unripple::act::{Level, Readouts};
use unripple::core::{Responses, Surface};
use unripple::focus::{Options, Target};

/// What the drives of all methods have in common.
pub(super) struct Ground<'a> {
    /// The surface in common.
    pub surface: &'a Surface,
    /// Responses that drives are made from.
    pub known: &'a Responses,
    /// Responses that drives are evaluated on.
    pub plant: &'a Responses,
    /// Readouts of `plant`, computed once for all methods.
    pub on: &'a Readouts<'a>,
    /// The targets in common.
    pub targets: &'a [Target],
    /// The options in common: window, level.
    pub options: &'a Options,
    /// How strongly each method drives.
    pub level: Level,
}
