//! The common result of all methods that compute modes.

use unripple_core::{Encoded, Shapes};

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
    /// What is known of the errors of each mode.
    pub(super) errors: Vec<Errors>,
}

/// Bounds of the relative errors of one mode; 0 where there are rounding errors alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Errors {
    /// That of the frequency.
    pub(super) frequency: f64,
    /// That of the share of bending.
    pub(super) share: f64,
    /// That of the shape, root mean square over the sheet.
    pub(super) shape: f64,
    /// That of a decay rate by a loss factor for want of second order, divided by the square of the loss factor; infinite if unknown.
    pub(super) second: f64,
}

impl Errors {
    /// The errors of a mode by a Ritz method whose frequencies have an error of at most `error`, with the share of bending `share`.
    ///
    /// The energy of the error of a shape is twice the relative error of its frequency, and its mean square less, since it consists of
    /// shorter waves. The share s is the logarithmic derivative of ω² by the bending stiffness, so that its error is that of twice the
    /// error of the frequency: for errors that fall exponentially with the number of functions, with an exponent that varies as the root
    /// of the stiffness at most, these errors times the exponent.
    pub(super) fn of_ritz(error: f64, share: f64, second: f64) -> Self {
        let pure = share <= 0.0 || 1.0 - share < PURE;
        let of_share = if pure || error <= 0.0 { 0.0 } else { -error * error.ln() / share };
        Self { frequency: error, share: of_share, shape: (2.0 * error).sqrt(), second }
    }
}

impl Encoded for Errors {
    fn encode(&self, to: &mut Vec<u8>) {
        [self.frequency, self.share, self.shape, self.second].encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let [frequency, share, shape, second] = <[f64; 4]>::decode(from)?;
        Some(Self { frequency, share, shape, second })
    }
}

/// Shares of bending nearer to 1 are 1 but for rounding. Ten times more would hide errors of the finest meshes.
pub(super) const PURE: f64 = 1e-7;
