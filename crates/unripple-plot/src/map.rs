//! A field over the surface, in colour.

use crate::axis::{Axis, Direction, Padding, Ruler};
use crate::canvas::{Anchor, Canvas, Rect, Text};
use crate::colours::{Bar, Colours};
use crate::field::{self, Marker};
use crate::grid::{Grid, Ring};
use crate::placed::Placed;
use crate::prepared::{Margins, Prepared};
use crate::style::{GAP, Style, points};
use crate::{PlotError, frame};

/// A field over the surface, in colour, with its outline, markers and a colour bar. Lengths have the same scale in
/// both directions.
///
/// # Example
/// ```
/// use unripple_plot::{Colours, Figure, Grid, Map};
/// let grid = Grid { columns: 3, rows: 2, first: [0.5, 0.5], pitch: [1.0, 1.0], values: vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0] };
/// let map = Map { grid, colours: Colours { title: "Displacement (µm)".into(), ..Colours::default() }, ..Map::default() };
/// assert!(Figure::of(map).draw()?.svg().contains("<image"));
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The field's values, cell by cell.
    pub grid: Grid,
    /// Outline of the surface, as closed polygons to which the field is clipped, in the grid's unit of length; if
    /// empty, the whole grid is shown.
    pub outline: Vec<Ring>,
    /// Actuators, targets and focal discs.
    pub markers: Vec<Marker>,
    /// How values become colours.
    pub colours: Colours,
    /// Unit of the axes.
    pub unit: String,
    /// Factor from the grid's unit of length to the unit of the axes.
    pub multiplier: f64,
    /// Text above the map; none if empty.
    pub title: String,
    /// Greatest height of the frame in millimetres.
    pub height_mm: f64,
}

impl Default for Map {
    fn default() -> Self {
        Self {
            grid: Grid::default(),
            outline: Vec::new(),
            markers: Vec::new(),
            colours: Colours::default(),
            unit: "mm".to_owned(),
            multiplier: 1e3,
            title: String::new(),
            height_mm: 90.0,
        }
    }
}

/// The part of the plane that a map shows: the outline's bounding box, or the grid's where there is no outline.
pub(crate) fn view(grid: &Grid, outline: &[Ring]) -> Result<[[f64; 2]; 2], PlotError> {
    let corners = outline.iter().flatten();
    let bounds = corners.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], [x, y]| {
        [[low[0].min(*x), low[1].min(*y)], [high[0].max(*x), high[1].max(*y)]]
    });
    if outline.iter().all(Vec::is_empty) {
        return Ok(grid.corners());
    }
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
pub(crate) fn fitted(frame: Rect, aspect: f64) -> Rect {
    let width = frame.width.min(frame.height / aspect);
    Rect { x: frame.x + (frame.width - width) / 2.0, width, height: width * aspect, ..frame }
}

/// Distance between the field and its axes, in points. So that the outline does not touch the axes.
const DROP: f64 = 3.0;

pub(crate) struct PreparedMap<'a> {
    map: &'a Map,
    style: &'a Style,
    colours: Colours,
    bar: Bar,
    rulers: [Ruler; 2],
    aspect: f64,
    labels: [String; 2],
}

impl<'a> PreparedMap<'a> {
    /// Fixes axes and colours for a panel `width` points wide.
    pub fn new(map: &'a Map, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        map.grid.check("map")?;
        let view = view(&map.grid, &map.outline)?;
        let aspect = aspect(view);
        let across = (width - 11.0 * style.label_pt).max(20.0);
        let across = across.min(points(map.height_mm) / aspect).max(5.0);
        let colours = map.colours.settle(std::iter::once(&map.grid))?;
        let bar = Bar::new(&colours, across * aspect, style)?;
        let rulers = rulers(view, map.multiplier, [across, across * aspect], style)?;
        let labels = ["x", "y"].map(|name| format!("{name} ({})", map.unit));
        Ok(Self { map, style, colours, bar, rulers, aspect, labels })
    }
}

impl Prepared for PreparedMap<'_> {
    fn margins(&self) -> Margins {
        let title = if self.map.title.is_empty() { 0.0 } else { 1.6 * self.style.label_pt };
        Margins {
            left: DROP + frame::room_left(&self.labels[1], &self.rulers[1], self.style),
            right: self.bar.room(self.style),
            top: title + frame::room_above(&self.rulers[1], self.style),
            bottom: DROP + frame::room_below(&self.labels[0], self.style),
        }
    }

    fn height(&self, width: f64) -> f64 {
        (width * self.aspect).min(points(self.map.height_mm)).clamp(5.0, 5000.0)
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let field = fitted(frame, self.aspect);
        let [x, y] = self.rulers.clone();
        let placed = Placed { frame: field, x, y };
        field::picture(canvas, &placed, &self.map.grid, &self.map.outline, &self.colours)?;
        field::overlay(canvas, &placed, &self.map.outline, &self.map.markers, self.style);
        frame::draw_across(canvas, &placed, &self.labels[0], DROP, self.style);
        frame::draw_up(canvas, &placed, &self.labels[1], DROP, self.style);
        self.bar.draw(canvas, field, self.style);
        let above = frame::room_above(&placed.y, self.style);
        let at = [field.x + field.width / 2.0, field.y - above - GAP / 2.0];
        canvas.text(Text::new(&self.map.title, at, self.style.label_pt).anchor(Anchor::Middle));
        Ok(placed)
    }
}
