//! The plane of a surface in a panel: the part of it that is shown, its axes, the colour bar and the title.

use crate::PlotError;
use crate::axis::{Axis, Direction, Padding, Ruler};
use crate::canvas::{Canvas, Rect};
use crate::colours::{Bar, Colours};
use crate::frame::{self, Title};
use crate::grid::{Grid, Ring};
use crate::placed::Placed;
use crate::prepared::Margins;
use crate::style::{GAP, Style, points};

/// Lower left and upper right corners of the box round some places; what is not a number does not count.
pub(crate) fn bounds<'a>(places: impl Iterator<Item = &'a [f64; 2]>) -> [[f64; 2]; 2] {
    places.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], [x, y]| {
        [[low[0].min(*x), low[1].min(*y)], [high[0].max(*x), high[1].max(*y)]]
    })
}

/// The part of the plane that a map shows: the outline's bounding box, or the grid's where there is no outline.
pub(crate) fn view(grid: &Grid, outline: &[Ring]) -> Result<[[f64; 2]; 2], PlotError> {
    if outline.iter().all(Vec::is_empty) {
        return Ok(grid.corners());
    }
    let bounds = bounds(outline.iter().flatten());
    for (low, high) in bounds[0].iter().zip(bounds[1]) {
        let found = high - low;
        if !(found > 0.0 && found < 1e12) {
            let expected = "a finite, non-zero width and height";
            return Err(PlotError::Range { what: "outline".to_owned(), expected, found });
        }
    }
    Ok(bounds)
}

/// Rulers for both directions of a view, over lengths in points.
pub(crate) fn rulers(
    view: [[f64; 2]; 2],
    multiplier: f64,
    length: [f64; 2],
    style: &Style,
) -> Result<[Ruler; 2], PlotError> {
    let none = Padding { share: 0.0, zero: false };
    let ruler = |i: usize, direction| {
        let axis = Axis::new("").times(multiplier).from(view[0][i]).to(view[1][i]);
        Ruler::new(&axis, std::iter::empty(), none, direction, length[i], style.tick_pt)
    };
    Ok([ruler(0, Direction::Across)?, ruler(1, Direction::Up)?])
}

/// Height over width of a view.
pub(crate) fn aspect([[x0, y0], [x1, y1]]: [[f64; 2]; 2]) -> f64 {
    ((y1 - y0) / (x1 - x0)).clamp(0.01, 100.0)
}

/// The largest rectangle of an aspect in a frame, at its top and in its middle.
fn fitted(frame: Rect, aspect: f64) -> Rect {
    let width = frame.width.min(frame.height / aspect);
    Rect { x: frame.x + (frame.width - width) / 2.0, width, height: width * aspect, ..frame }
}

/// Distance between the field and its axes, in points. So that the outline does not touch the axes.
const DROP: f64 = 3.0;

/// What surrounds a field.
pub(crate) struct Around<'a> {
    /// How values become colours, with both ends fixed.
    pub colours: Colours,
    /// Unit of the axes.
    pub unit: &'a str,
    /// Factor from the unit of the view to that of the axes.
    pub multiplier: f64,
    /// Text above the field; none if empty.
    pub title: &'a str,
    /// Greatest height of the field in millimetres.
    pub height_mm: f64,
}

/// A view of the plane with everything round the field, ready to be placed.
pub(crate) struct Plane<'a> {
    /// Sizes of text and lines.
    pub style: &'a Style,
    /// How values become colours, with both ends fixed.
    pub colours: Colours,
    bar: Bar,
    rulers: [Ruler; 2],
    aspect: f64,
    labels: [String; 2],
    title: Title,
    height_mm: f64,
}

impl<'a> Plane<'a> {
    /// Fixes axes, colour bar and title for a panel `width` points wide.
    pub fn new(
        view: [[f64; 2]; 2],
        around: Around<'_>,
        width: f64,
        style: &'a Style,
    ) -> Result<Self, PlotError> {
        let Around { colours, unit, multiplier, title, height_mm } = around;
        let aspect = aspect(view);
        let room = (width - 11.0 * style.label_pt).max(20.0);
        let across = room.min(points(height_mm) / aspect).max(5.0);
        let bar = Bar::new(&colours, across * aspect, style)?;
        let rulers = rulers(view, multiplier, [across, across * aspect], style)?;
        let labels = ["x", "y"].map(|name| format!("{name} ({unit})"));
        // A letter's width beyond the field on either side, where neither the panel's letter nor its neighbour is.
        let title = Title::new(title, room + 2.0 * style.label_pt, style);
        Ok(Self { style, colours, bar, rulers, aspect, labels, title, height_mm })
    }

    /// Room needed round the field.
    pub fn margins(&self) -> Margins {
        Margins {
            left: DROP + frame::room_left(&self.labels[1], &self.rulers[1], self.style),
            right: self.bar.room(self.style),
            top: self.title.room(self.style) + frame::room_above(&self.rulers[1], self.style),
            bottom: DROP + frame::room_below(&self.labels[0], self.style),
        }
    }

    /// Height of the frame for a width of it, both in points.
    pub fn height(&self, width: f64) -> f64 {
        (width * self.aspect).min(points(self.height_mm)).clamp(5.0, 5000.0)
    }

    /// The field's place in a frame, with its axes.
    pub fn placed(&self, frame: Rect) -> Placed {
        let [x, y] = self.rulers.clone();
        Placed { frame: fitted(frame, self.aspect), x, y }
    }

    /// Draws axes, colour bar and title round a field in its place.
    pub fn draw(&self, canvas: &mut Canvas, placed: &Placed) {
        let field = placed.frame;
        frame::draw_across(canvas, placed, &self.labels[0], DROP, self.style);
        frame::draw_up(canvas, placed, &self.labels[1], DROP, self.style);
        self.bar.draw(canvas, field, self.style);
        let above = frame::room_above(&placed.y, self.style);
        let at = [field.x + field.width / 2.0, field.y - above - GAP / 2.0];
        self.title.draw(canvas, at, self.style);
    }
}
