//! Figures for publication, from data alone: one drawing gives SVG text, a PDF page and a PNG made of that same text, and tables of the data.
//!
//! A [`Figure`] is a grid of [`Panel`]s: [`Plot`] (curves, points, bands and annotations on axes), [`Traces`] (one above the other,
//! as on an oscilloscope), [`Map`] (a field over the surface), [`Strip`] (several fields, one colour bar) and [`Cells`] (a table in colour).
//! A [`Movie`] makes an animated PNG of a field. Data stay in their own (SI) units; axes and colour bars multiply
//! them for display. A value that is not finite is a gap, never an error, unless nothing else is left.
//!
//! The typeface is embedded; no system font is looked at, so the same data give the same bytes everywhere.

mod axis;
mod canvas;
mod cells;
mod colour;
mod colourmap;
mod colours;
mod drawing;
mod encode;
mod error;
mod field;
mod figure;
mod font;
mod frame;
mod grid;
mod inks;
mod layer;
mod legend;
mod map;
mod movie;
mod paint;
mod panel;
mod pdf;
mod plot;
mod raster;
mod strip;
mod style;
mod table;
mod thin;
mod ticks;
mod traces;
mod units;

pub use axis::{Axis, Scale};
pub use canvas::Anchor;
pub use cells::Cells;
pub use colour::Rgb;
pub use colourmap::ColourMap;
pub use colours::Colours;
pub use drawing::{Drawing, PRINT_DPI, pngs};
pub use error::PlotError;
pub use field::{Marker, Symbol};
pub use figure::Figure;
pub use grid::{Grid, Ring};
pub use layer::{Along, Band, Dash, Ink, Layer, Line, Mark, Note, Points, Rule, Span};
pub use map::Map;
pub use movie::Movie;
pub use panel::Panel;
pub use plot::{Legend, Plot};
pub use strip::{Shot, Strip};
pub use style::Style;
pub use ticks::nice_ticks;
pub use traces::{Trace, Traces};
pub use units::prefixed;
