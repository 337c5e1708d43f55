//! One touch event: which finger was put down, moved or lifted, where and when.

use crate::Point;

/// One touch event of one finger, from any source: a touch screen, a network or a recording.
///
/// ```
/// use unripple_core::{Phase, Point, Touch};
///
/// let touch = Touch { finger: 3, phase: Phase::Down, at: Point::from_mm(62.0, 90.0), time: 0.0, force: None };
/// assert_eq!(touch.phase, Phase::Down);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Number that identifies the contact from `Down` to `Up`; it is never used again for another contact.
    pub finger: u64,
    /// Whether the finger was put down, moved or was lifted.
    pub phase: Phase,
    /// Position of the finger on the surface, in metres; for `Up`, its last position.
    pub at: Point,
    /// Time of the event, in seconds of the clock of the source of touches; it never decreases from one
    /// event to the next.
    pub time: f64,
    /// Pressing force, in N; `None` where it is not known.
    pub force: Option<f64>,
}

/// The phase of a touch: what the finger did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The finger was put down on the surface.
    Down,
    /// The finger moved, or its force changed.
    Move,
    /// The finger was lifted from the surface.
    Up,
}
