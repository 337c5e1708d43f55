//! Curves on a pair of axes.

use crate::axis::{Axis, Direction, Padding, Ruler, Scale, shortened};
use crate::canvas::{Canvas, Rect};
use crate::error::{same_length, some_finite};
use crate::frame::{self, Title};
use crate::layer::{Along, Layer, Note, Rule};
use crate::placed::Placed;
use crate::prepared::{Margins, Prepared};
use crate::style::{GAP, Style, points};
use crate::{PlotError, font, legend, paint};

/// Curves, points, bands and annotations on a pair of axes.
///
/// # Example
/// ```
/// use unripple_plot::{Axis, Figure, Line, Plot};
/// let plot = Plot {
///     x: Axis::new("Time (ms)").times(1e3),
///     y: Axis::new("Velocity (mm/s)").times(1e3),
///     layers: vec![Line { x: vec![0.0, 1e-3], y: vec![0.0, 2e-3], label: "focus".into(), ..Line::default() }.into()],
///     ..Plot::default()
/// };
/// let drawing = Figure::of(plot).draw()?;
/// assert!(drawing.svg().contains("Velocity (mm/s)"));
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// The axis of abscissae, across.
    pub x: Axis,
    /// The axis of ordinates, upwards.
    pub y: Axis,
    /// The layers, the first at the bottom.
    pub layers: Vec<Layer>,
    /// Where the names of the layers are listed.
    pub legend: Legend,
    /// Text above the frame, in as many lines as it takes; none if empty.
    pub title: String,
    /// Height of the frame in millimetres; 0.68 of its width if absent.
    pub height_mm: Option<f64>,
}

/// Where a legend goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Legend {
    /// At a place inside the frame where it hides no data; above the frame if there is none.
    #[default]
    Auto,
    /// Above the frame, in as many rows as it takes.
    Above,
    /// No legend at all.
    None,
}

pub(crate) struct PreparedPlot<'a> {
    plot: &'a Plot,
    style: &'a Style,
    entries: Vec<legend::Entry<'a>>,
    x: Ruler,
    y: Ruler,
    inside: Option<[f64; 2]>,
    above: legend::Rows,
    title: Title,
    height: f64,
}

impl<'a> PreparedPlot<'a> {
    /// Fixes axes and legend for a panel `width` points wide.
    pub fn new(plot: &'a Plot, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        plot.check()?;
        let names = plot.y.names.iter().map(|name| font::width(&shortened(name), style.tick_pt));
        let names = names.fold(0.0, f64::max);
        let across = (width - 6.0 * style.label_pt - names).max(20.0);
        let height = plot.height_mm.map_or(0.68 * across, points).clamp(10.0, 5000.0);
        let marks = plot.layers.iter().any(|layer| matches!(layer, Layer::Points(_)));
        let share = if marks { 0.04 } else { 0.0 };
        let padding = Padding { share, zero: false };
        let x = Ruler::new(&plot.x, plot.abscissae(), padding, Direction::Across, across, style.tick_pt)?;
        let padding = Padding { share: 0.06, zero: plot.y.scale == Scale::Linear };
        let y = Ruler::new(&plot.y, plot.ordinates(&x), padding, Direction::Up, height, style.tick_pt)?;
        let entries = legend::entries(&plot.layers, style);
        let trial =
            Placed { frame: Rect { x: 0.0, y: 0.0, width: across, height }, x: x.clone(), y: y.clone() };
        let inside = match plot.legend {
            Legend::Auto => legend::free_place(&entries, &trial, &plot.layers, style),
            _ => None,
        };
        let above = match (plot.legend, inside) {
            (Legend::None, _) | (_, Some(_)) => legend::Rows::default(),
            _ => legend::Rows::new(&entries, across, style),
        };
        let title = Title::new(&plot.title, across, style);
        Ok(Self { plot, style, entries, x, y, inside, above, title, height })
    }

    /// Heights of what is stacked on the frame: names of rules and the power of ten, legend, title.
    fn top(&self) -> [f64; 3] {
        let near = frame::room_above(&self.y, self.style);
        let rules = self.plot.layers.iter().any(is_labelled_rule);
        let near = if rules { near.max(1.4 * self.style.tick_pt) } else { near };
        let rows = self.above.height(self.style);
        [near, rows, self.title.room(self.style)]
    }
}

fn is_labelled_rule(layer: &Layer) -> bool {
    matches!(layer, Layer::Rule(Rule { along: Along::Y, label, .. }) if !label.is_empty())
}

impl Prepared for PreparedPlot<'_> {
    fn margins(&self) -> Margins {
        Margins {
            left: frame::room_left(&self.plot.y.label, &self.y, self.style),
            right: frame::room_right(&self.x, self.style),
            top: self.top().iter().sum(),
            bottom: frame::room_below(&self.plot.x.label, self.style),
        }
    }

    fn height(&self, _width: f64) -> f64 {
        self.height
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let placed = Placed { frame, x: self.x.clone(), y: self.y.clone() };
        paint::layers(canvas, &placed, &self.plot.layers, self.style);
        frame::draw_across(canvas, &placed, &self.plot.x.label, 0.0, self.style);
        frame::draw_up(canvas, &placed, &self.plot.y.label, 0.0, self.style);
        let [near, rows, _] = self.top();
        if let Some(planned) = self.inside {
            // The frame is not quite the one planned for, so a better place may have opened.
            let place = legend::free_place(&self.entries, &placed, &self.plot.layers, self.style);
            let [across, down] = place.unwrap_or(planned);
            let size = legend::size(&self.entries, self.style);
            let at = [frame.x + across * (frame.width - size[0]), frame.y + down * (frame.height - size[1])];
            legend::draw_column(canvas, &self.entries, at, self.style);
        } else {
            self.above.draw(canvas, &self.entries, [frame.x, frame.y - near - rows], self.style);
        }
        let at = [frame.x + frame.width / 2.0, frame.y - near - rows - GAP];
        self.title.draw(canvas, at, self.style);
        Ok(placed)
    }
}

impl Plot {
    fn check(&self) -> Result<(), PlotError> {
        if self.layers.is_empty() {
            return Err(PlotError::Empty { what: "plot".to_owned(), found: "no layers".to_owned() });
        }
        self.layers.iter().try_for_each(check_layer)
    }

    fn abscissae(&self) -> impl Iterator<Item = f64> + '_ {
        self.layers.iter().flat_map(|layer| -> Box<dyn Iterator<Item = f64>> {
            match layer {
                Layer::Line(line) => Box::new(line.x.iter().copied()),
                Layer::Points(points) => Box::new(points.x.iter().copied()),
                Layer::Band(band) => Box::new(band.x.iter().copied()),
                Layer::Rule(rule) if rule.along == Along::Y => Box::new([rule.at].into_iter()),
                Layer::Span(span) if span.along == Along::Y => Box::new([span.from, span.to].into_iter()),
                Layer::Note(Note { at, .. }) => Box::new([at[0]].into_iter()),
                Layer::Rule(_) | Layer::Span(_) => Box::new(std::iter::empty()),
            }
        })
    }

    /// Ordinates of everything whose abscissa is within the range shown.
    fn ordinates<'a>(&'a self, x: &'a Ruler) -> impl Iterator<Item = f64> + 'a {
        let shown = |(x_value, _): &(f64, f64)| (-1e-9..=1.0 + 1e-9).contains(&x.place(*x_value));
        self.layers
            .iter()
            .flat_map(|layer| -> Box<dyn Iterator<Item = (f64, f64)>> {
                match layer {
                    Layer::Line(line) => Box::new(pairs(&line.x, &line.y)),
                    Layer::Points(points) => Box::new(pairs(&points.x, &points.y).chain(
                        pairs(&points.x, &points.y).zip(&points.error).flat_map(
                            |((x, y), [below, above])| {
                                let low = y - below;
                                let low = if low > 0.0 || self.y.scale == Scale::Linear { low } else { y };
                                [(x, low), (x, y + above)]
                            },
                        ),
                    )),
                    Layer::Band(band) => {
                        Box::new(pairs(&band.x, &band.low).chain(pairs(&band.x, &band.high)))
                    }
                    Layer::Rule(rule) if rule.along == Along::X => {
                        Box::new([(x.middle(), rule.at)].into_iter())
                    }
                    Layer::Span(span) if span.along == Along::X => {
                        Box::new([(x.middle(), span.from), (x.middle(), span.to)].into_iter())
                    }
                    Layer::Note(Note { at, .. }) => Box::new([(at[0], at[1])].into_iter()),
                    Layer::Rule(_) | Layer::Span(_) => Box::new(std::iter::empty()),
                }
            })
            .filter(move |pair| shown(pair))
            .map(|(_, y)| y)
    }
}

fn pairs<'a>(x: &'a [f64], y: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    x.iter().copied().zip(y.iter().copied())
}

fn check_layer(layer: &Layer) -> Result<(), PlotError> {
    match layer {
        Layer::Line(line) => {
            let what = format!("line `{}`", line.label);
            same_length(&what, line.x.len(), line.y.len())?;
            some_finite(&what, &line.x)?;
            some_finite(&what, &line.y)
        }
        Layer::Points(points) => {
            let what = format!("points `{}`", points.label);
            same_length(&what, points.x.len(), points.y.len())?;
            if !points.error.is_empty() {
                same_length(&format!("error bars of {what}"), points.x.len(), points.error.len())?;
            }
            some_finite(&what, &points.x)?;
            some_finite(&what, &points.y)
        }
        Layer::Band(band) => {
            let what = format!("band `{}`", band.label);
            same_length(&what, band.x.len(), band.low.len())?;
            same_length(&what, band.x.len(), band.high.len())?;
            some_finite(&what, &band.x)?;
            some_finite(&what, &band.low)?;
            some_finite(&what, &band.high)
        }
        Layer::Rule(rule) => some_finite(&format!("rule `{}`", rule.label), &[rule.at]),
        Layer::Span(span) => {
            let what = format!("span `{}`", span.label);
            some_finite(&what, &[span.from])?;
            some_finite(&what, &[span.to])
        }
        Layer::Note(note) => {
            let what = format!("note `{}`", note.text);
            note.at.iter().try_for_each(|value| some_finite(&what, &[*value]))
        }
    }
}
