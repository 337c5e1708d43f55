//! One panel of a figure.

use crate::axis::Ruler;
use crate::canvas::{Canvas, Rect};
use crate::style::Style;
use crate::{Cells, Map, Plot, PlotError, Strip, Traces};

/// One cell of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum Panel {
    /// Curves and points on axes.
    Plot(Plot),
    /// Traces one above the other.
    Traces(Traces),
    /// A field over the surface.
    Map(Map),
    /// Several fields sharing one colour bar.
    Strip(Strip),
    /// A table in colour.
    Cells(Cells),
}

macro_rules! panels {
    ($($kind:ident),*) => {$(
        impl From<$kind> for Panel {
            fn from(panel: $kind) -> Self {
                Self::$kind(panel)
            }
        }
    )*};
}
panels!(Plot, Traces, Map, Strip, Cells);

impl Panel {
    /// Checks the data and fixes everything that determines the room needed, for a panel `width` points wide.
    pub(crate) fn prepare<'a>(
        &'a self,
        width: f64,
        style: &'a Style,
    ) -> Result<Box<dyn Prepared + 'a>, PlotError> {
        Ok(match self {
            Self::Plot(plot) => Box::new(crate::plot::PreparedPlot::new(plot, width, style)?),
            Self::Traces(traces) => Box::new(crate::traces::PreparedTraces::new(traces, width, style)?),
            Self::Map(map) => Box::new(crate::map::PreparedMap::new(map, width, style)?),
            Self::Cells(cells) => Box::new(crate::cells::PreparedCells::new(cells, width, style)?),
            Self::Strip(strip) => Box::new(crate::strip::PreparedStrip::new(strip, width, style)?),
        })
    }
}

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
