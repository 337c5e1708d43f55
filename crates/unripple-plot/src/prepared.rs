//! A panel whose data are checked, ready to be placed.

use crate::PlotError;
use crate::canvas::{Canvas, Rect};
use crate::placed::Placed;

/// A panel ready to be placed.
pub(crate) trait Prepared {
    /// Room needed round the frame, in points.
    fn margins(&self) -> Margins;
    /// Whether its frame lines up with those above and below it.
    fn aligned(&self) -> bool {
        true
    }
    /// Height of the frame for a width of the frame, both in points.
    fn height(&self, width: f64) -> f64;
    /// Draws the panel with its frame at a place.
    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError>;
}

/// Room round a frame, in points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Margins {
    /// Room on the left, for tick labels.
    pub left: f64,
    /// Room on the right, for a colour bar.
    pub right: f64,
    /// Room above, for a title.
    pub top: f64,
    /// Room below, for the axis.
    pub bottom: f64,
}
