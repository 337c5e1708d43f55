//! Figures for publication, from data alone: one drawing gives SVG text, a PDF page and a PNG made of that same text, and tables of the data.
//!
//! Only numbers, labels and outlines are known here, neither surfaces nor drives. No file is written: the caller gets text or bytes.
//!
//! # In reading order
//!
//! A [`Figure`] is a grid of [`Panel`]s: [`Plot`] (curves, points, bands and annotations on axes), [`Traces`] (one above the other,
//! as on an oscilloscope), [`Map`] (a field over the surface), [`Scatter`] (values at points of it), [`Strip`] (several fields, one colour
//! bar) and [`Cells`] (a table in colour).
//! A [`Movie`] makes an animated PNG of a field. Data stay in their own (SI) units; axes and colour bars multiply
//! them for display. A value that is not finite is a gap, never an error, unless nothing else is left.
//!
//! The typeface is embedded; no system font is looked at, so the same data give the same bytes everywhere.
//!
//! ```
//! use unripple_plot::{Axis, Figure, Line, Plot};
//!
//! let x: Vec<f64> = (0..200).map(|i| f64::from(i) * 0.1e-3).collect(); // Time, in s.
//! let y: Vec<f64> = x.iter().map(|t| 0.2 * (-t / 7e-3).exp() * (t * 2000.0).cos()).collect(); // Velocity, in m/s.
//! let figure = Figure::of(Plot {
//!     x: Axis::new("Time (ms)").times(1e3),
//!     y: Axis::new("Velocity (mm/s)").times(1e3),
//!     layers: vec![Line { x, y, label: "focus".into(), ..Line::default() }.into()],
//!     ..Plot::default()
//! });
//! let drawing = figure.draw()?;
//! assert!(drawing.svg().contains("Velocity (mm/s)"));
//! assert!(figure.tables()[0].starts_with("series,Time (ms),Velocity (mm/s)\r\nfocus,0,200\r\n"));
//! # Ok::<(), unripple_plot::PlotError>(())
//! ```

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
mod label;
mod layer;
mod legend;
mod map;
mod movie;
mod paint;
mod panel;
mod pdf;
mod placed;
mod plane;
mod plot;
mod prepared;
mod raster;
mod scatter;
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
pub use drawing::{Drawing, PRINT_DPI, png, pngs};
pub use error::PlotError;
pub use field::{Marker, Symbol};
pub use figure::Figure;
pub use grid::{Grid, Ring};
pub use label::Label;
pub use layer::{Along, Band, Dash, Ink, Layer, Line, Mark, Note, Points, Rule, Span};
pub use map::Map;
pub use movie::Movie;
pub use panel::Panel;
pub use plot::{Legend, Plot};
pub use scatter::Scatter;
pub use strip::{Shot, Strip};
pub use style::Style;
pub use ticks::nice_ticks;
pub use traces::{Trace, Traces};
pub use units::prefixed;
