//! Layers of a plot: lines, points, bands.

use crate::canvas::Anchor;
use crate::colour::Rgb;
use crate::colourmap::ColourMap;

/// The colour of a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Ink {
    /// The palette's next colour, counted over the layers of the plot.
    #[default]
    Auto,
    /// The colour of [`Rgb::palette`] with this index.
    Palette(usize),
    /// A place from 0 (dark) to 1 (light) on the sequential colour map, for a family of curves in order.
    Graded(f64),
    /// A colour chosen by the caller.
    Rgb(Rgb),
}

impl Ink {
    pub(crate) fn colour(self, index: usize) -> Rgb {
        match self {
            Self::Auto => Rgb::palette(index),
            Self::Palette(index) => Rgb::palette(index),
            Self::Graded(place) => ColourMap::Sequential.colour(0.05 + 0.75 * place.clamp(0.0, 1.0)),
            Self::Rgb(colour) => colour,
        }
    }
}

/// The pattern of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dash {
    /// A different pattern for each line whose ink is [`Ink::Auto`], solid for the first; solid for lines
    /// with any other ink.
    #[default]
    Auto,
    /// An unbroken line.
    Solid,
    /// Dashes of even length.
    Dashed,
    /// Dots in a row.
    Dotted,
    /// Dashes and dots by turns.
    DashDot,
    /// Long dashes alone.
    Long,
    /// Long dashes, each followed by two dots.
    DashDotDot,
}

impl Dash {
    /// Lengths of marks and spaces by turns, in line widths.
    pub(crate) fn pattern(self, index: usize) -> &'static [f64] {
        const CYCLE: [Dash; 6] =
            [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted, Dash::Long, Dash::DashDotDot];
        match self {
            Self::Auto => CYCLE[index % CYCLE.len()].pattern(0),
            Self::Solid => &[],
            Self::Dashed => &[4.5, 2.2],
            Self::Dotted => &[1.2, 1.8],
            Self::DashDot => &[6.0, 2.0, 1.2, 2.0],
            Self::Long => &[9.0, 2.5],
            Self::DashDotDot => &[8.0, 2.0, 1.2, 1.6, 1.2, 2.0],
        }
    }
}

/// The shape of a point's mark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    /// A different shape for each layer of points, a disc for the first.
    #[default]
    Auto,
    /// A filled circle.
    Disc,
    /// A filled square.
    Square,
    /// A filled triangle.
    Triangle,
    /// A filled diamond.
    Diamond,
    /// An empty circle.
    Ring,
    /// An upright cross.
    Plus,
    /// A slanting cross.
    Cross,
}

impl Mark {
    pub(crate) fn of(self, index: usize) -> Self {
        const CYCLE: [Mark; 7] =
            [Mark::Disc, Mark::Square, Mark::Triangle, Mark::Diamond, Mark::Ring, Mark::Cross, Mark::Plus];
        if self == Self::Auto { CYCLE[index % CYCLE.len()] } else { self }
    }
}

/// A curve through points in order. A value that is not finite leaves a gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Abscissae, in the axis's data unit.
    pub x: Vec<f64>,
    /// Ordinates, one for each abscissa.
    pub y: Vec<f64>,
    /// Name of the line in the legend; none if empty.
    pub label: String,
    /// Colour of the line.
    pub ink: Ink,
    /// Pattern of the line.
    pub dash: Dash,
    /// Width of the line in points; the figure's width of data lines if absent.
    pub width_pt: Option<f64>,
}

/// Marks at points, with error bars if wanted. A value that is not finite leaves its mark out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Abscissae, in the axis's data unit.
    pub x: Vec<f64>,
    /// Ordinates, one for each abscissa.
    pub y: Vec<f64>,
    /// Lengths of each error bar below and above its point, in the data unit of the ordinates; one pair for
    /// each point, or empty for no error bars.
    pub error: Vec<[f64; 2]>,
    /// Name of the points in the legend; none if empty.
    pub label: String,
    /// Colour of marks and bars.
    pub ink: Ink,
    /// Shape of the marks.
    pub mark: Mark,
}

/// A shaded band between two curves, as for a confidence interval.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// Abscissae, in the axis's data unit.
    pub x: Vec<f64>,
    /// Lower ordinates, one for each abscissa.
    pub low: Vec<f64>,
    /// Upper ordinates, one for each abscissa.
    pub high: Vec<f64>,
    /// Name of the band in the legend; none if empty.
    pub label: String,
    /// Colour of the band, drawn pale.
    pub ink: Ink,
}

/// Direction of a rule or a span.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Along {
    /// Parallel to the axis y: at one abscissa, from bottom to top.
    #[default]
    Y,
    /// Parallel to the axis x: at one ordinate, from left to right.
    X,
}

/// A straight line across the whole plot at one value.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Value at which the rule is drawn, in the axis's data unit.
    pub at: f64,
    /// Direction in which the rule runs.
    pub along: Along,
    /// Text beside the rule: above the frame for a rule along y, on the line for one along x; none if empty.
    pub label: String,
    /// Colour of the rule.
    pub ink: Ink,
    /// Pattern of the rule.
    pub dash: Dash,
}

impl Default for Rule {
    fn default() -> Self {
        Self { at: 0.0, along: Along::Y, label: String::new(), ink: Ink::Rgb(Rgb::GREY), dash: Dash::Dashed }
    }
}

/// A pale stripe across the whole plot between two values.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Value at which the stripe begins, in the axis's data unit.
    pub from: f64,
    /// Value at which the stripe ends, in the axis's data unit.
    pub to: f64,
    /// Direction in which the stripe runs.
    pub along: Along,
    /// Name of the stripe in the legend; none if empty.
    pub label: String,
    /// Colour of the stripe, drawn pale.
    pub ink: Ink,
}

impl Default for Span {
    fn default() -> Self {
        Self { from: 0.0, to: 0.0, along: Along::Y, label: String::new(), ink: Ink::Rgb(Rgb::GREY) }
    }
}

/// Text at a point of the plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Place of the text, in the data's units.
    pub at: [f64; 2],
    /// The text of the note.
    pub text: String,
    /// Which end of the text is at the place.
    pub anchor: Anchor,
    /// Colour of the text.
    pub ink: Ink,
}

impl Default for Note {
    fn default() -> Self {
        Self { at: [0.0; 2], text: String::new(), anchor: Anchor::Start, ink: Ink::Rgb(Rgb::BLACK) }
    }
}

/// One thing drawn in a plot.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer {
    /// A curve through points.
    Line(Line),
    /// Marks with error bars.
    Points(Points),
    /// A band between two curves.
    Band(Band),
    /// A line at one value.
    Rule(Rule),
    /// A stripe between two values.
    Span(Span),
    /// Text at a place.
    Note(Note),
}

macro_rules! layers {
    ($($kind:ident),*) => {$(
        impl From<$kind> for Layer {
            fn from(layer: $kind) -> Self {
                Self::$kind(layer)
            }
        }
    )*};
}
layers!(Line, Points, Band, Rule, Span, Note);
