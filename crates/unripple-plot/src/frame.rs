//! What surrounds the frame of a panel: spines, ticks and their labels, labels of axes, the title.

use crate::axis::Ruler;
use crate::canvas::{Anchor, Canvas, Rise, Stroke, Text, path};
use crate::colour::Rgb;
use crate::font;
use crate::placed::Placed;
use crate::style::{GAP, MINOR_TICK, Style, TICK};
use crate::ticks::power_of_ten;

/// Room an axis of abscissae needs below the frame.
pub(crate) fn room_below(label: &str, style: &Style) -> f64 {
    let label = if label.is_empty() { 0.0 } else { 1.4 * GAP + 1.15 * style.label_pt };
    TICK + GAP + 0.85 * style.tick_pt + label
}

/// Room an axis of ordinates needs to the left of the frame.
pub(crate) fn room_left(label: &str, ruler: &Ruler, style: &Style) -> f64 {
    let label = if label.is_empty() { 0.0 } else { 1.5 * GAP + style.label_pt };
    TICK + GAP + ruler.label_width(style.tick_pt) + label
}

/// Room above the frame for the power of ten taken out of the ordinates, and for half a tick label.
pub(crate) fn room_above(ruler: &Ruler, style: &Style) -> f64 {
    if ruler.power.is_some() { 1.5 * style.tick_pt } else { 0.5 * style.tick_pt }
}

/// Room to the right of the frame for the last tick label's half.
pub(crate) fn room_right(ruler: &Ruler, style: &Style) -> f64 {
    let last = ruler.major.last().map_or(0.0, |(_, label)| font::width(label, style.tick_pt));
    (last / 2.0).max(style.axis_pt) + 1.0
}

/// A label with the power of ten its ticks leave out.
fn with_power(label: &str, ruler: &Ruler) -> String {
    match ruler.power {
        Some(power) if label.is_empty() => format!("×{}", power_of_ten(power)),
        Some(power) => format!("{label}   ×{}", power_of_ten(power)),
        None => label.to_owned(),
    }
}

/// The axis of abscissae, `drop` points below the frame.
pub(crate) fn draw_across(canvas: &mut Canvas, placed: &Placed, label: &str, drop: f64, style: &Style) {
    let (frame, y) = (placed.frame, placed.frame.bottom() + drop);
    let place = |value: f64| frame.x + placed.x.shown(value) * frame.width;
    let mut marks = path([[frame.x, y], [frame.right(), y]], false);
    for (value, text) in &placed.x.major {
        let x = place(*value);
        marks += &path([[x, y], [x, y + TICK]], false);
        canvas
            .text(Text::new(text, [x, y + TICK + GAP], style.tick_pt).anchor(Anchor::Middle).rise(Rise::Top));
    }
    for &value in &placed.x.minor {
        marks += &path([[place(value), y], [place(value), y + MINOR_TICK]], false);
    }
    canvas.stroke(&marks, Stroke::solid(Rgb::BLACK, style.axis_pt));
    let at = [frame.x + frame.width / 2.0, y + TICK + 2.4 * GAP + 0.85 * style.tick_pt];
    let label = with_power(label, &placed.x);
    canvas.text(Text::new(&label, at, style.label_pt).anchor(Anchor::Middle).rise(Rise::Top));
}

/// The axis of ordinates, `drop` points to the left of the frame.
pub(crate) fn draw_up(canvas: &mut Canvas, placed: &Placed, label: &str, drop: f64, style: &Style) {
    let (frame, x) = (placed.frame, placed.frame.x - drop);
    let place = |value: f64| frame.bottom() - placed.y.shown(value) * frame.height;
    let mut marks = path([[x, frame.y], [x, frame.bottom()]], false);
    for (value, text) in &placed.y.major {
        let y = place(*value);
        marks += &path([[x, y], [x - TICK, y]], false);
        let at = [x - TICK - GAP, y];
        canvas.text(Text::new(text, at, style.tick_pt).anchor(Anchor::End).rise(Rise::Middle));
    }
    for &value in &placed.y.minor {
        marks += &path([[x, place(value)], [x - MINOR_TICK, place(value)]], false);
    }
    canvas.stroke(&marks, Stroke::solid(Rgb::BLACK, style.axis_pt));
    if let Some(power) = placed.y.power {
        let text = format!("×{}", power_of_ten(power));
        canvas.text(Text::new(&text, [x, frame.y - 1.2 * GAP], style.tick_pt));
    }
    let right = x - TICK - GAP - placed.y.label_width(style.tick_pt) - 1.5 * GAP;
    let at = [right - 0.15 * style.label_pt, frame.y + frame.height / 2.0];
    canvas.text(Text::new(label, at, style.label_pt).anchor(Anchor::Middle).upwards());
}

/// Height of a line of a title over its size of type: descenders of one line stay clear of the next.
const LINE: f64 = 1.2;

/// Room for the last line of a title over its size of type, the space below it included. Less, and it touches the ticks' labels.
const LAST_LINE: f64 = 1.6;

/// The title of a panel, above its frame, in as many lines as it takes.
#[derive(Clone, Debug)]
pub(crate) struct Title(Vec<String>);

impl Title {
    /// A title in lines at most `width` points wide; a wider word has a line of its own.
    pub fn new(text: &str, width: f64, style: &Style) -> Self {
        Self(font::broken(text, width, style.label_pt))
    }

    /// Vertical space that the title needs, in points; 0 if it is empty.
    pub fn room(&self, style: &Style) -> f64 {
        match self.0.len() {
            0 => 0.0,
            lines => (LAST_LINE + LINE * (lines - 1) as f64) * style.label_pt,
        }
    }

    /// Draws the title with the middle of its last line at a place, in points.
    pub fn draw(&self, canvas: &mut Canvas, [x, y]: [f64; 2], style: &Style) {
        for (above, line) in self.0.iter().rev().enumerate() {
            let at = [x, y - LINE * above as f64 * style.label_pt];
            canvas.text(Text::new(line, at, style.label_pt).anchor(Anchor::Middle));
        }
    }
}
