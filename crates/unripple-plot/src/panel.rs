//! One panel of a figure.

use crate::prepared::Prepared;
use crate::style::Style;
use crate::{Cells, Map, Plot, PlotError, Scatter, Strip, Traces};

/// One cell of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum Panel {
    /// Curves and points on axes.
    Plot(Plot),
    /// Traces one above the other.
    Traces(Traces),
    /// A field over the surface.
    Map(Map),
    /// Values at points of the surface.
    Scatter(Scatter),
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
panels!(Plot, Traces, Map, Scatter, Strip, Cells);

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
            Self::Scatter(scatter) => Box::new(crate::scatter::PreparedScatter::new(scatter, width, style)?),
            Self::Cells(cells) => Box::new(crate::cells::PreparedCells::new(cells, width, style)?),
            Self::Strip(strip) => Box::new(crate::strip::PreparedStrip::new(strip, width, style)?),
        })
    }
}
