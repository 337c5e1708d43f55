//! Sizes of text and lines.

/// Sizes shared by everything in a figure, in points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Size of axis labels, titles and panel letters.
    pub label_pt: f64,
    /// Size of tick labels, legends and annotations.
    pub tick_pt: f64,
    /// Width of data lines.
    pub line_pt: f64,
    /// Width of axes and ticks.
    pub axis_pt: f64,
}

impl Default for Style {
    fn default() -> Self {
        Self { label_pt: 8.0, tick_pt: 7.0, line_pt: 0.8, axis_pt: 0.6 }
    }
}

/// Millimetres in a point, 1/72 of an inch of 25.4 mm.
pub(crate) const MM_PER_POINT: f64 = 25.4 / 72.0;
/// Length of a major tick, in points; minor ones are three fifths as long, so that the eye tells them apart.
pub(crate) const TICK: f64 = 3.0;
/// Length of a minor tick, in points: three fifths of a major one.
pub(crate) const MINOR_TICK: f64 = 1.8;
/// Space between a mark and its text, in points. Less, and digits touch the axis.
pub(crate) const GAP: f64 = 2.5;

/// The points (1/72 inch) in `mm` millimetres.
pub(crate) fn points(mm: f64) -> f64 {
    mm / MM_PER_POINT
}
