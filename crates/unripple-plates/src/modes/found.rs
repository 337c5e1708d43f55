//! The common result of all methods that compute modes.

use unripple_core::Shapes;

/// Computed modes of a sheet in order of ascending frequency, in a form common to all methods of solution.
pub(super) struct Found {
    /// Natural frequencies ω, in rad/s.
    pub(super) omegas: Vec<f64>,
    /// Share of bending in each mode's elastic energy, 0 to 1.
    pub(super) bending_shares: Vec<f64>,
    /// The mass-normalised shapes.
    pub(super) shapes: Box<dyn Shapes>,
    /// A bound of the relative error of any frequency.
    pub(super) error: f64,
}
