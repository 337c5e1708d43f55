//! Traces one above the other, as on an oscilloscope.

use crate::axis::{Axis, Direction, LARGEST, Padding, Ruler, usable};
use crate::canvas::{Anchor, Canvas, Rect, Rise, Stroke, Text, rectangle};
use crate::colour::Rgb;
use crate::error::some_finite;
use crate::frame::{self, Title};
use crate::layer::{Ink, Layer, Rule};
use crate::placed::Placed;
use crate::prepared::{Margins, Prepared};
use crate::style::{GAP, Style, points};
use crate::{PlotError, font, paint, ticks};

/// Traces one above the other over one time axis, each with its name at the left, as on an oscilloscope.
/// A bar at the right gives the scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Traces {
    /// The axis of abscissae, shared by all traces.
    pub x: Axis,
    /// Abscissa of the first sample, in the data's unit.
    pub start: f64,
    /// Step from one sample to the next, in the data's unit.
    pub step: f64,
    /// The traces, the first at the top.
    pub traces: Vec<Trace>,
    /// Unit of the scale bar, as in `mm/s`.
    pub unit: String,
    /// Factor from the data's unit to that of the scale bar.
    pub multiplier: f64,
    /// Whether each trace fills its lane at a scale of its own, with its own scale bar.
    pub own_scales: bool,
    /// Lines at single abscissae across all traces.
    pub rules: Vec<Rule>,
    /// Height of the lane of one trace in millimetres; chosen by the number of traces if absent.
    pub lane_mm: Option<f64>,
    /// Text above the traces, in as many lines as it takes; none if empty.
    pub title: String,
}

/// One trace, such as the velocity at a point against time.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Name of the trace, written at the left.
    pub label: String,
    /// Samples of the trace; one that is not finite leaves a gap.
    pub values: Vec<f64>,
    /// Colour of its line.
    pub ink: Ink,
}

impl Trace {
    /// A trace of values, in the figure's data unit, in the palette's first colour.
    pub fn new(label: impl Into<String>, values: Vec<f64>) -> Self {
        Self { label: label.into(), values, ink: Ink::Palette(0) }
    }
}

impl Default for Traces {
    fn default() -> Self {
        Self {
            x: Axis::default(),
            start: 0.0,
            step: 1.0,
            traces: Vec::new(),
            unit: String::new(),
            multiplier: 1.0,
            own_scales: false,
            rules: Vec::new(),
            lane_mm: None,
            title: String::new(),
        }
    }
}

/// Space between a scale bar and what is beside it, in points. So that bar, label and trace stay apart.
const BAR_GAP: f64 = 4.0;

pub(crate) struct PreparedTraces<'a> {
    traces: &'a Traces,
    style: &'a Style,
    x: Ruler,
    /// Lowest and highest value of each lane, in the data's unit.
    ranges: Vec<[f64; 2]>,
    /// Length of each lane's scale bar in the unit shown; none for lanes that share another's.
    bars: Vec<Option<f64>>,
    /// Room for the names on the left and for the scale bars on the right, in points.
    beside: [f64; 2],
    title: Title,
    lane: f64,
}

impl<'a> PreparedTraces<'a> {
    /// Fixes the time axis and the lanes for a panel `width` points wide.
    pub fn new(traces: &'a Traces, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        traces.check()?;
        let longest = traces.traces.iter().map(|trace| trace.values.len()).max().unwrap_or(0);
        let ends = [traces.start, traces.start + traces.step * longest.saturating_sub(1) as f64];
        let mut ranges: Vec<[f64; 2]> = traces.traces.iter().map(|trace| range(&trace.values)).collect();
        if !traces.own_scales {
            let shared = ranges.iter().fold([0.0f64, 0.0f64], |[l, h], r| [l.min(r[0]), h.max(r[1])]);
            ranges.fill(shared);
        }
        ranges.iter_mut().filter(|[low, high]| high - low <= 0.0).for_each(|range| *range = [-1.0, 1.0]);
        let last = ranges.len() - 1;
        let bars: Vec<Option<f64>> = ranges
            .iter()
            .enumerate()
            .map(|(i, [low, high])| {
                let span = (high - low) * traces.multiplier.abs();
                (traces.own_scales || i == last).then(|| ticks::round_below(0.75 * span))
            })
            .collect();
        let beside = beside(traces, &bars, style);
        let across = (width - beside[0] - beside[1]).max(20.0);
        let padding = Padding { share: 0.0, zero: false };
        let x = Ruler::new(&traces.x, ends.into_iter(), padding, Direction::Across, across, style.tick_pt)?;
        let title = Title::new(&traces.title, across, style);
        let lane =
            traces.lane_mm.map_or((130.0 / ranges.len() as f64).clamp(17.0, 34.0), points).clamp(2.0, 1000.0);
        Ok(Self { traces, style, x, ranges, bars, beside, title, lane })
    }

    /// Room in points above the frame for the labels of rules.
    fn above(&self) -> f64 {
        let labelled = self.traces.rules.iter().any(|rule| !rule.label.is_empty());
        if labelled { 1.4 * self.style.tick_pt } else { 1.0 }
    }

    fn lane(&self, frame: Rect, i: usize) -> Rect {
        let gap = 0.06 * self.lane;
        Rect { y: frame.y + i as f64 * self.lane + gap, height: self.lane - 2.0 * gap, ..frame }
    }

    fn draw_lane(&self, canvas: &mut Canvas, placed: &Placed, i: usize) {
        let (trace, [low, high], lane) = (&self.traces.traces[i], self.ranges[i], self.lane(placed.frame, i));
        let up = |value: f64| lane.bottom() - (value - low) / (high - low) * lane.height;
        let zero = Stroke::solid(Rgb(205, 205, 205), 0.5);
        canvas.line([lane.x, up(0.0)], [lane.right(), up(0.0)], zero);
        let at = |(i, &value): (usize, &f64)| {
            let x = placed.across(self.traces.start + i as f64 * self.traces.step);
            (usable(value) && x.is_finite()).then(|| [x, up(value)])
        };
        let places: Vec<Option<[f64; 2]>> = trace.values.iter().enumerate().map(at).collect();
        let runs: Vec<Vec<[f64; 2]>> = places
            .split(Option::is_none)
            .filter(|run| !run.is_empty())
            .map(|run| run.iter().flatten().copied().collect())
            .collect();
        let path = paint::curve_path(&runs);
        canvas.stroke(&path, Stroke::solid(trace.ink.colour(i), 0.8 * self.style.line_pt));
    }

    fn draw_beside(&self, canvas: &mut Canvas, frame: Rect, i: usize) {
        let ([low, high], lane, size) = (self.ranges[i], self.lane(frame, i), self.style.tick_pt);
        let zero = lane.bottom() - (0.0 - low) / (high - low) * lane.height;
        let label = Text::new(&self.traces.traces[i].label, [frame.x - BAR_GAP, zero], size);
        canvas.text(label.anchor(Anchor::End).rise(Rise::Middle));
        let Some(bar) = self.bars[i] else {
            return;
        };
        let length = bar / self.traces.multiplier.abs() / (high - low) * lane.height;
        let (x, middle) = (frame.right() + BAR_GAP, lane.y + lane.height / 2.0);
        let stroke = Stroke::solid(Rgb::BLACK, 1.2);
        canvas.line([x, middle - length / 2.0], [x, middle + length / 2.0], stroke);
        let label = bar_label(self.traces, bar);
        canvas.text(Text::new(&label, [x + GAP, middle], size).rise(Rise::Middle));
    }
}

impl Prepared for PreparedTraces<'_> {
    fn margins(&self) -> Margins {
        let [left, bars] = self.beside;
        Margins {
            left,
            right: bars.max(frame::room_right(&self.x, self.style)),
            top: self.above() + self.title.room(self.style),
            bottom: 2.0 + frame::room_below(&self.traces.x.label, self.style),
        }
    }

    fn height(&self, _width: f64) -> f64 {
        self.lane * self.ranges.len() as f64
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let lanes = Axis::new("").from(0.0).to(self.ranges.len() as f64);
        let none = Padding { share: 0.0, zero: false };
        let y =
            Ruler::new(&lanes, std::iter::empty(), none, Direction::Up, frame.height, self.style.tick_pt)?;
        let placed = Placed { frame, x: self.x.clone(), y };
        canvas.clip(&rectangle(frame));
        (0..self.ranges.len()).for_each(|i| self.draw_lane(canvas, &placed, i));
        canvas.end();
        let rules: Vec<Layer> = self.traces.rules.iter().cloned().map(Layer::Rule).collect();
        paint::layers(canvas, &placed, &rules, self.style);
        (0..self.ranges.len()).for_each(|i| self.draw_beside(canvas, frame, i));
        frame::draw_across(canvas, &placed, &self.traces.x.label, 2.0, self.style);
        let at = [frame.x + frame.width / 2.0, frame.y - self.above() - GAP];
        self.title.draw(canvas, at, self.style);
        Ok(placed)
    }
}

/// What a scale bar stands for, with its unit.
fn bar_label(traces: &Traces, bar: f64) -> String {
    format!("{} {}", ticks::short(bar), traces.unit).trim_end().to_owned()
}

/// Room in points for the names on the left, and for the scale bars with their labels on the right.
fn beside(traces: &Traces, bars: &[Option<f64>], style: &Style) -> [f64; 2] {
    let size = style.tick_pt;
    let names = traces.traces.iter().map(|trace| font::width(&trace.label, size)).fold(0.0, f64::max);
    let labels = bars.iter().flatten().map(|bar| font::width(&bar_label(traces, *bar), size));
    [names + BAR_GAP + 1.0, labels.fold(0.0, f64::max) + BAR_GAP + GAP + 1.0]
}

/// Lowest and highest value, zero included.
fn range(values: &[f64]) -> [f64; 2] {
    values.iter().filter(|v| usable(**v)).fold([0.0, 0.0], |[low, high], v| [low.min(*v), high.max(*v)])
}

impl Traces {
    fn check(&self) -> Result<(), PlotError> {
        if self.traces.is_empty() {
            return Err(PlotError::Empty { what: "traces".to_owned(), found: "none".to_owned() });
        }
        for trace in &self.traces {
            some_finite(&format!("trace `{}`", trace.label), &trace.values)?;
        }
        some_finite("start of the traces", &[self.start])?;
        for (what, found) in
            [("step of the traces", self.step), ("multiplier of the traces", self.multiplier)]
        {
            if !(usable(found) && found.abs() > 1.0 / LARGEST) {
                let expected = "a finite, non-zero number";
                return Err(PlotError::Range { what: what.to_owned(), expected, found });
            }
        }
        self.rules.iter().try_for_each(|rule| some_finite(&format!("rule `{}`", rule.label), &[rule.at]))
    }
}
