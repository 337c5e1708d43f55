//! The frame and axes of a panel that has been drawn.

use crate::axis::Ruler;
use crate::canvas::Rect;

/// The frame and axes of a panel that has been drawn, which place its data.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    /// The frame, in points.
    pub frame: Rect,
    /// The axis of abscissae, with its range and ticks fixed.
    pub x: Ruler,
    /// The axis of ordinates, with its range and ticks fixed.
    pub y: Ruler,
}

impl Placed {
    /// A datum's place in points; absent where it cannot be shown.
    pub fn point(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let (across, up) = (self.x.place(x), self.y.place(y));
        (across.is_finite() && up.is_finite())
            .then(|| [self.frame.x + across * self.frame.width, self.frame.bottom() - up * self.frame.height])
    }

    /// The abscissa's place in points.
    pub fn across(&self, x: f64) -> f64 {
        self.frame.x + self.x.place(x) * self.frame.width
    }

    /// The ordinate's place in points.
    pub fn up(&self, y: f64) -> f64 {
        self.frame.bottom() - self.y.place(y) * self.frame.height
    }
}
