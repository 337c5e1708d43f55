//! One touch event: which finger came, moved or left, where and when.

use crate::Point;

/// What one finger just did, wherever that was learnt: a screen, a network, a recording.
///
/// ```
/// use unripple_core::{Phase, Point, Touch};
///
/// let touch = Touch { finger: 3, phase: Phase::Down, at: Point::from_mm(62.0, 90.0), time: 0.0, force: None };
/// assert_eq!(touch.phase, Phase::Down);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Which finger: the same from its `Down` to its `Up`, and nobody else's before or after.
    pub finger: u64,
    /// What it did: came, moved or left.
    pub phase: Phase,
    /// Where it is, in m on the surface, its origin at the lower-left corner. With `Up`, where it was last.
    pub at: Point,
    /// When, in s of the clock of whoever tells; never runs back.
    pub time: f64,
    /// How hard it presses, in N, where that is known.
    pub force: Option<f64>,
}

/// The phase of a touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The finger came onto the surface.
    Down,
    /// The finger moved, or pressed otherwise.
    Move,
    /// The finger left the surface.
    Up,
}
