//! From values to colours, with the colour bar's text.

use crate::axis::{Axis, Direction, Padding, Ruler, usable};
use crate::canvas::{Anchor, Canvas, Rect, Rise, Stroke, Text, path, rectangle};
use crate::colour::Rgb;
use crate::colourmap::ColourMap;
use crate::style::{GAP, Style, TICK};
use crate::ticks::power_of_ten;
use crate::{Grid, PlotError, font};

/// How values become colours, and what the colour bar says about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Colours {
    /// Title of the bar, with the unit shown, as in `Velocity (mm/s)`.
    pub title: String,
    /// The colour map. A diverging one is symmetric about zero unless both ends are given; a sequential one
    /// starts at zero unless its low end is given or values are negative.
    pub map: ColourMap,
    /// Factor from values to the numbers shown: 1e3 for m/s on a bar in mm/s.
    pub multiplier: f64,
    /// Value that the first colour stands for, in the data's unit; determined from the data if absent.
    pub low: Option<f64>,
    /// Value that the last colour stands for, in the data's unit; determined from the data if absent.
    pub high: Option<f64>,
}

impl Default for Colours {
    fn default() -> Self {
        Self { title: String::new(), map: ColourMap::Diverging, multiplier: 1.0, low: None, high: None }
    }
}

impl Colours {
    /// The colour scale with both ends fixed for the values of some grids.
    ///
    /// Errors when an end or the multiplier is not finite, or the ends are not in order.
    pub(crate) fn settle<'a>(&self, grids: impl Iterator<Item = &'a Grid>) -> Result<Self, PlotError> {
        let values = grids.flat_map(|grid| &grid.values).copied().filter(|value| usable(*value));
        let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), v| (l.min(v), m.max(v)));
        let (least, most) = if least <= most { (least, most) } else { (0.0, 0.0) };
        let (low, high) = match self.map {
            ColourMap::Diverging => {
                let largest = least.abs().max(most.abs());
                let end = self.high.or(self.low).map_or(largest, f64::abs);
                let end = if end > 1e-100 { end } else { 1.0 };
                (-end, end)
            }
            ColourMap::Sequential if most - least.min(0.0) > 1e-100 => (least.min(0.0), most),
            ColourMap::Sequential => (least, least + 1.0),
        };
        let (low, high) = (self.low.unwrap_or(low), self.high.unwrap_or(high));
        let name = || format!("colour bar `{}`", self.title);
        if !(usable(low) && usable(high) && high > low) {
            return Err(PlotError::Range { what: name(), expected: "finite ends in order", found: high });
        }
        if !(usable(self.multiplier) && self.multiplier > 0.0) {
            let expected = "a positive multiplier";
            return Err(PlotError::Range { what: name(), expected, found: self.multiplier });
        }
        Ok(Self { low: Some(low), high: Some(high), ..self.clone() })
    }

    /// Place of a value on a scale with fixed ends, 0 to 1 within it.
    pub(crate) fn place(&self, value: f32) -> f64 {
        let (low, high) = (self.low.unwrap_or(0.0), self.high.unwrap_or(1.0));
        (f64::from(value) - low) / (high - low)
    }
}

/// A colour bar beside a field, reading upwards.
#[derive(Clone, Debug)]
pub(crate) struct Bar {
    title: String,
    map: ColourMap,
    ruler: Ruler,
}

/// Width of the colour bar, in points: about the height of a letter, enough to tell colours.
const WIDTH: f64 = 7.0;
/// Space between the field and the bar, in points. As much as the bar is wide, so that it does not read as part of
/// the field.
const AWAY: f64 = 7.0;

impl Bar {
    /// A bar for a scale with fixed ends, `length` points long.
    pub fn new(colours: &Colours, length: f64, style: &Style) -> Result<Self, PlotError> {
        let axis = Axis {
            label: colours.title.clone(),
            multiplier: colours.multiplier,
            low: colours.low,
            high: colours.high,
            ..Axis::default()
        };
        let none = Padding { share: 0.0, zero: false };
        let ruler = Ruler::new(&axis, std::iter::empty(), none, Direction::Up, length, style.tick_pt)?;
        Ok(Self { title: colours.title.clone(), map: colours.map, ruler })
    }

    /// The title with the power of ten its ticks leave out.
    fn full_title(&self) -> String {
        match self.ruler.power {
            Some(power) => format!("{}   ×{}", self.title, power_of_ten(power)).trim_start().to_owned(),
            None => self.title.clone(),
        }
    }

    /// Room in points that the colour bar needs to the right of the map.
    pub fn room(&self, style: &Style) -> f64 {
        let title = if self.full_title().is_empty() { 0.0 } else { 1.5 * GAP + 1.2 * style.label_pt };
        AWAY + WIDTH + TICK + GAP + self.ruler.label_width(style.tick_pt) + title + 1.0
    }

    /// Draws the bar to the right of the field.
    pub fn draw(&self, canvas: &mut Canvas, field: Rect, style: &Style) {
        let bar = Rect { x: field.right() + AWAY, width: WIDTH, ..field };
        canvas.gradient(bar, &self.stops());
        let mut marks = rectangle(bar);
        for (value, label) in &self.ruler.major {
            let y = bar.bottom() - self.ruler.shown(*value) * bar.height;
            marks += &path([[bar.right(), y], [bar.right() + TICK, y]], false);
            let at = [bar.right() + TICK + GAP, y];
            // Signs and digits of one column line up on the right.
            let room = self.ruler.label_width(style.tick_pt);
            let text = Text::new(label, [at[0] + room, y], style.tick_pt);
            canvas.text(text.anchor(Anchor::End).rise(Rise::Middle));
        }
        canvas.stroke(&marks, Stroke::solid(Rgb::BLACK, style.axis_pt));
        let x = bar.right() + TICK + GAP + self.ruler.label_width(style.tick_pt) + 1.5 * GAP;
        let title = self.full_title();
        let wide = font::width(&title, style.label_pt);
        let middle = bar.y + bar.height / 2.0;
        // A title longer than the bar starts at its foot rather than leave the figure.
        let (y, anchor) =
            if wide > bar.height { (bar.bottom(), Anchor::Start) } else { (middle, Anchor::Middle) };
        let text = Text::new(&title, [x + 0.1 * style.label_pt, y], style.label_pt).anchor(anchor);
        canvas.text(text.rise(Rise::Top).upwards());
    }

    fn stops(&self) -> Vec<Rgb> {
        (0..=64).map(|i| self.map.colour(f64::from(i) / 64.0)).collect()
    }
}
