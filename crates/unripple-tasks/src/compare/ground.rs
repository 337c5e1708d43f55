//! Data that the drives of all methods of a comparison share.

use unripple::act::{Level, Readouts};
use unripple::core::{Responses, Surface};
use unripple::focus::{Options, Target};

/// Data that the drives of all methods share: surface, responses, targets, options and level.
pub(super) struct Ground<'a> {
    /// The surface that drives are computed for and evaluated on.
    pub surface: &'a Surface,
    /// Responses that drives are computed from.
    pub known: &'a Responses,
    /// Responses that drives are evaluated on.
    pub plant: &'a Responses,
    /// Readouts of `plant`, computed once for all methods.
    pub on: &'a Readouts<'a>,
    /// The targets of all methods.
    pub targets: &'a [Target],
    /// Options of all methods: window and drive limits.
    pub options: &'a Options,
    /// Level to which each drive is scaled.
    pub level: Level,
}
