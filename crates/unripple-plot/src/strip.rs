//! Several fields side by side with one colour bar.

use crate::axis::Ruler;
use crate::canvas::{Anchor, Canvas, Rect, Rise, Stroke, Text};
use crate::colour::Rgb;
use crate::colours::{Bar, Colours};
use crate::field::{self, Marker};
use crate::grid::{Grid, Ring};
use crate::placed::Placed;
use crate::plane;
use crate::prepared::{Margins, Prepared};
use crate::style::{GAP, Style};
use crate::{PlotError, ticks};

/// One picture of a wave field, in a strip of pictures or in an animation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shot {
    /// The field's values, cell by cell.
    pub grid: Grid,
    /// Text above the field, such as the time.
    pub caption: String,
}

/// Several fields over one surface, side by side, sharing a colour bar, with a scale bar instead of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// The fields, left to right, then down.
    pub shots: Vec<Shot>,
    /// Number of fields side by side; 0 for all of them.
    pub columns: usize,
    /// Outline of the surface, as closed polygons to which the fields are clipped, in the grids' unit of length; if
    /// empty, the whole grids are shown.
    pub outline: Vec<Ring>,
    /// Actuators, targets and focal discs, the same on each field.
    pub markers: Vec<Marker>,
    /// How values become colours.
    pub colours: Colours,
    /// Unit of the scale bar.
    pub unit: String,
    /// Factor from the grids' unit of length to the unit of the scale bar.
    pub multiplier: f64,
}

impl Default for Strip {
    fn default() -> Self {
        Self {
            shots: Vec::new(),
            columns: 0,
            outline: Vec::new(),
            markers: Vec::new(),
            colours: Colours::default(),
            unit: "mm".to_owned(),
            multiplier: 1e3,
        }
    }
}

/// Space between fields, in points: enough to keep neighbours' outlines apart.
const BETWEEN: f64 = 5.0;

pub(crate) struct PreparedStrip<'a> {
    strip: &'a Strip,
    style: &'a Style,
    colours: Colours,
    bar: Bar,
    view: [[f64; 2]; 2],
    rulers: [Ruler; 2],
    columns: usize,
    rows: usize,
}

impl<'a> PreparedStrip<'a> {
    /// Fixes colours and rows for a panel `width` points wide.
    pub fn new(strip: &'a Strip, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        let Some(first) = strip.shots.first() else {
            return Err(PlotError::Empty { what: "strip".to_owned(), found: "no fields".to_owned() });
        };
        for shot in &strip.shots {
            shot.grid.check(&format!("field `{}`", shot.caption))?;
        }
        let count = strip.shots.len();
        let columns = if strip.columns == 0 { count } else { strip.columns.min(count) };
        let rows = count.div_ceil(columns);
        let view = plane::view(&first.grid, &strip.outline)?;
        let colours = strip.colours.settle(strip.shots.iter().map(|shot| &shot.grid))?;
        let across = ((width - 40.0) / columns as f64 - BETWEEN).max(10.0);
        let up = across * plane::aspect(view);
        let caption = Self::caption(strip, style);
        let bar = Bar::new(&colours, (up + caption) * rows as f64 - caption, style)?;
        let rulers = plane::rulers(view, strip.multiplier, [across, up], style)?;
        Ok(Self { strip, style, colours, bar, view, rulers, columns, rows })
    }

    /// Height of one line of captions.
    fn caption(strip: &Strip, style: &Style) -> f64 {
        let any = strip.shots.iter().any(|shot| !shot.caption.is_empty());
        if any { 1.5 * style.tick_pt } else { BETWEEN }
    }

    fn cell(&self, width: f64) -> [f64; 2] {
        let columns = self.columns as f64;
        let across = ((width - (columns - 1.0) * BETWEEN) / columns).max(2.0);
        [across, across * plane::aspect(self.view)]
    }
}

/// Draws a scale bar below a field, at most two fifths as long as the field is wide, and the length it stands for.
pub(crate) fn draw_scale(canvas: &mut Canvas, field: Rect, across: &Ruler, unit: &str, style: &Style) {
    let [low, high] = across.ends();
    let shown = (high - low).abs();
    let length = ticks::round_below(0.4 * shown);
    let drawn = length / shown * field.width;
    let y = field.bottom() + 2.0 * GAP;
    canvas.line([field.x, y], [field.x + drawn, y], Stroke::solid(Rgb::BLACK, 1.2));
    let label = format!("{} {unit}", ticks::short(length));
    let at = [field.x + drawn + 1.5 * GAP, y];
    canvas.text(Text::new(&label, at, style.tick_pt).rise(Rise::Middle));
}

impl Prepared for PreparedStrip<'_> {
    fn margins(&self) -> Margins {
        Margins {
            left: 1.0,
            right: self.bar.room(self.style),
            top: Self::caption(self.strip, self.style),
            bottom: 2.0 * GAP + 0.6 * self.style.tick_pt,
        }
    }

    fn aligned(&self) -> bool {
        false
    }

    fn height(&self, width: f64) -> f64 {
        let caption = Self::caption(self.strip, self.style);
        let rows = self.rows as f64;
        rows * self.cell(width)[1] + (rows - 1.0) * caption
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let [width, height] = self.cell(frame.width);
        let caption = Self::caption(self.strip, self.style);
        let place = |i: usize| Rect {
            x: frame.x + (i % self.columns) as f64 * (width + BETWEEN),
            y: frame.y + (i / self.columns) as f64 * (height + caption),
            width,
            height,
        };
        let [x, y] = self.rulers.clone();
        let placed = |i: usize| Placed { frame: place(i), x: x.clone(), y: y.clone() };
        for (i, shot) in self.strip.shots.iter().enumerate() {
            let placed = placed(i);
            field::picture(canvas, &placed, &shot.grid, &self.strip.outline, &self.colours)?;
            field::overlay(canvas, &placed, &self.strip.outline, &self.strip.markers, self.style);
            let at = [placed.frame.x + width / 2.0, placed.frame.y - GAP];
            canvas.text(Text::new(&shot.caption, at, self.style.tick_pt).anchor(Anchor::Middle));
        }
        self.bar.draw(canvas, Rect { height: self.height(frame.width), ..frame }, self.style);
        let last = place((self.rows - 1) * self.columns);
        draw_scale(canvas, last, &x, &self.strip.unit, self.style);
        Ok(placed(0))
    }
}
