//! Names of a plot's layers beside samples of them.

use crate::canvas::{Canvas, Rect, Rise, Stroke, Text, rectangle};
use crate::colour::Rgb;
use crate::font;
use crate::layer::{Along, Layer};
use crate::paint::{self, Look, PALE};
use crate::placed::Placed;
use crate::style::Style;

/// One line of a legend; layers of the same name share it.
#[derive(Clone, Debug)]
pub(crate) struct Entry<'a> {
    label: &'a str,
    samples: Vec<(Sample, Look)>,
}

#[derive(Clone, Copy, Debug)]
enum Sample {
    Line(f64),
    Mark,
    Patch,
}

/// Length of a line's sample, in points: long enough to show a pattern of dashes.
const SAMPLE: f64 = 19.0;
/// Space between sample and name, in points. About a letter's width.
const SPACE: f64 = 4.0;
/// Space kept clear round a legend, in points, so that it does not read as data.
const INSET: f64 = 4.0;

pub(crate) fn entries<'a>(layers: &'a [Layer], style: &Style) -> Vec<Entry<'a>> {
    let mut entries: Vec<Entry> = Vec::new();
    for (layer, look) in layers.iter().zip(paint::looks(layers)) {
        let (label, sample) = match layer {
            Layer::Line(line) => (&line.label, Sample::Line(line.width_pt.unwrap_or(style.line_pt))),
            Layer::Points(points) => (&points.label, Sample::Mark),
            Layer::Band(band) => (&band.label, Sample::Patch),
            Layer::Span(span) => (&span.label, Sample::Patch),
            Layer::Rule(_) | Layer::Note(_) => continue,
        };
        match entries.iter_mut().find(|entry| entry.label == label) {
            _ if label.is_empty() => {}
            Some(entry) => entry.samples.push((sample, look)),
            None => entries.push(Entry { label, samples: vec![(sample, look)] }),
        }
    }
    entries
}

fn entry_width(entry: &Entry, style: &Style) -> f64 {
    SAMPLE + SPACE + font::width(entry.label, style.tick_pt)
}

fn row_height(style: &Style) -> f64 {
    1.4 * style.tick_pt
}

/// Width and height of a legend in one column, its clear space included.
pub(crate) fn size(entries: &[Entry], style: &Style) -> [f64; 2] {
    let widest = entries.iter().map(|entry| entry_width(entry, style)).fold(0.0, f64::max);
    [widest + 2.0 * INSET, entries.len() as f64 * row_height(style) + INSET]
}

/// A place inside the frame that hides no data, as fractions of the room left across and down; absent if there is none.
pub(crate) fn free_place(
    entries: &[Entry],
    placed: &Placed,
    layers: &[Layer],
    style: &Style,
) -> Option<[f64; 2]> {
    let [width, height] = size(entries, style);
    let frame = placed.frame;
    if entries.is_empty() || width > 0.8 * frame.width || height > 0.8 * frame.height {
        return None;
    }
    let busy = occupied(placed, layers, style);
    const PLACES: [[f64; 2]; 13] = [
        [1.0, 0.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [1.0, 0.5],
        [0.0, 0.5],
        [0.5, 0.0],
        [0.5, 1.0],
        [0.75, 0.0],
        [0.25, 0.0],
        [1.0, 0.25],
        [1.0, 0.75],
        [0.75, 1.0],
    ];
    PLACES.into_iter().find(|[across, down]| {
        let place = Rect {
            x: frame.x + across * (frame.width - width),
            y: frame.y + down * (frame.height - height),
            width,
            height,
        };
        !busy.iter().any(|at| place.contains(*at))
    })
}

/// Places covered by data, close enough together that none slips through a legend.
fn occupied(placed: &Placed, layers: &[Layer], style: &Style) -> Vec<[f64; 2]> {
    let frame = placed.frame;
    let mut places = Vec::new();
    for layer in layers {
        match layer {
            Layer::Line(line) => along(&mut places, paint::runs(placed, &line.x, &line.y)),
            Layer::Points(points) => {
                for (i, (&x, &y)) in points.x.iter().zip(&points.y).enumerate() {
                    let [below, above] = points.error.get(i).copied().unwrap_or([0.0; 2]);
                    let ends: Vec<[f64; 2]> =
                        [y - below, y, y + above].iter().filter_map(|y| placed.point(x, *y)).collect();
                    along(&mut places, vec![ends]);
                }
            }
            Layer::Band(band) => {
                along(&mut places, paint::runs(placed, &band.x, &band.low));
                along(&mut places, paint::runs(placed, &band.x, &band.high));
            }
            Layer::Rule(rule) => {
                let ends = match rule.along {
                    Along::Y => [[placed.across(rule.at), frame.y], [placed.across(rule.at), frame.bottom()]],
                    Along::X => [[frame.x, placed.up(rule.at)], [frame.right(), placed.up(rule.at)]],
                };
                along(&mut places, vec![ends.to_vec()]);
                if rule.along == Along::X && !rule.label.is_empty() {
                    let wide = font::width(&rule.label, style.tick_pt);
                    let y = placed.up(rule.at) - style.tick_pt;
                    along(&mut places, vec![vec![[frame.right() - wide, y], [frame.right(), y]]]);
                }
            }
            Layer::Note(note) => {
                if let Some([x, y]) = placed.point(note.at[0], note.at[1]) {
                    let wide = font::width(&note.text, style.tick_pt);
                    along(&mut places, vec![vec![[x - wide, y], [x + wide, y]]]);
                }
            }
            Layer::Span(_) => {}
        }
    }
    places
}

/// Adds the corners of polylines and places every few points between them.
fn along(places: &mut Vec<[f64; 2]>, runs: Vec<Vec<[f64; 2]>>) {
    for run in runs {
        for pair in run.windows(2) {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            let steps = (((x1 - x0).hypot(y1 - y0) / 3.0).ceil()).clamp(1.0, 300.0) as usize;
            let step = |i: usize| i as f64 / steps as f64;
            places.extend((0..steps).map(|i| [x0 + step(i) * (x1 - x0), y0 + step(i) * (y1 - y0)]));
        }
        places.extend(run.last());
    }
}

/// A legend in one column with its upper-left corner there.
pub(crate) fn draw_column(canvas: &mut Canvas, entries: &[Entry], [x, y]: [f64; 2], style: &Style) {
    for (i, entry) in entries.iter().enumerate() {
        draw_entry(canvas, entry, [x + INSET, y + INSET / 2.0 + (i as f64 + 0.5) * row_height(style)], style);
    }
}

/// One entry, its middle line starting there.
fn draw_entry(canvas: &mut Canvas, entry: &Entry, [x, y]: [f64; 2], style: &Style) {
    for (sample, look) in &entry.samples {
        match sample {
            Sample::Line(width) => {
                canvas.line([x, y], [x + SAMPLE, y], Stroke { ink: look.ink, width: *width, dash: look.dash })
            }
            Sample::Mark => paint::mark(canvas, [x + SAMPLE / 2.0, y], look, style),
            Sample::Patch => {
                let patch = Rect { x, y: y - 2.5, width: SAMPLE, height: 5.0 };
                canvas.fill(&rectangle(patch), look.ink, PALE);
            }
        }
    }
    let text = Text::new(entry.label, [x + SAMPLE + SPACE, y], style.tick_pt).rise(Rise::Middle);
    canvas.text(text.ink(Rgb::BLACK));
}

/// A legend above a frame: entries in columns of equal width.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    columns: usize,
    rows: usize,
    pitch: f64,
}

impl Rows {
    /// Arranges entries in rows as wide as the frame.
    pub fn new(entries: &[Entry], width: f64, style: &Style) -> Self {
        if entries.is_empty() {
            return Self::default();
        }
        let pitch = size(entries, style)[0] + SPACE;
        let columns = ((width / pitch) as usize).clamp(1, entries.len());
        let rows = entries.len().div_ceil(columns);
        Self { columns: entries.len().div_ceil(rows), rows, pitch }
    }

    /// Height of all rows, in points.
    pub fn height(&self, style: &Style) -> f64 {
        self.rows as f64 * row_height(style)
    }

    /// Draws the rows with their upper-left corner at a place, in points.
    pub fn draw(&self, canvas: &mut Canvas, entries: &[Entry], [x, y]: [f64; 2], style: &Style) {
        for (i, entry) in entries.iter().enumerate().filter(|_| self.columns > 0) {
            let (row, column) = (i / self.columns, i % self.columns);
            let at = [x + column as f64 * self.pitch, y + (row as f64 + 0.5) * row_height(style)];
            draw_entry(canvas, entry, at, style);
        }
    }
}
