//! A field over the surface, in colour.

use crate::PlotError;
use crate::canvas::{Canvas, Rect};
use crate::colours::Colours;
use crate::field::{self, Marker};
use crate::grid::{Grid, Ring};
use crate::placed::Placed;
use crate::plane::{self, Around, Plane};
use crate::prepared::{Margins, Prepared};
use crate::style::Style;

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
    /// Text above the map, in as many lines as it takes; none if empty.
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

pub(crate) struct PreparedMap<'a> {
    map: &'a Map,
    plane: Plane<'a>,
}

impl<'a> PreparedMap<'a> {
    /// Fixes axes and colours for a panel `width` points wide.
    pub fn new(map: &'a Map, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        map.grid.check("map")?;
        let view = plane::view(&map.grid, &map.outline)?;
        let around = Around {
            colours: map.colours.settle(std::iter::once(&map.grid))?,
            unit: &map.unit,
            multiplier: map.multiplier,
            title: &map.title,
            height_mm: map.height_mm,
        };
        Ok(Self { map, plane: Plane::new(view, around, width, style)? })
    }
}

impl Prepared for PreparedMap<'_> {
    fn margins(&self) -> Margins {
        self.plane.margins()
    }

    fn height(&self, width: f64) -> f64 {
        self.plane.height(width)
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let placed = self.plane.placed(frame);
        field::picture(canvas, &placed, &self.map.grid, &self.map.outline, &self.plane.colours)?;
        field::overlay(canvas, &placed, &self.map.outline, &self.map.markers, self.plane.style);
        self.plane.draw(canvas, &placed);
        Ok(placed)
    }
}
