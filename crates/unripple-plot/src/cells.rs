//! A table in colour: named rows over columns along an axis, each cell of one colour.

use crate::axis::{Axis, Direction, Padding, Ruler};
use crate::canvas::{Canvas, Rect};
use crate::colours::{Bar, Colours};
use crate::error::{same_length, some_finite};
use crate::field::{DENSITY, LONGEST};
use crate::frame::{self, Title};
use crate::grid::Grid;
use crate::placed::Placed;
use crate::prepared::{Margins, Prepared};
use crate::style::{GAP, Style, points};
use crate::{PlotError, encode};
use std::cmp::Ordering;

/// Values in named rows, the first at the top, over columns along an axis. A cell is of one colour; one without a value is blank.
///
/// # Example
/// ```
/// use unripple_plot::{Axis, Cells, Colours, Figure};
/// let cells = Cells {
///     edges: vec![89.0, 112.0, 141.0],
///     rows: vec!["1".into(), "2".into()],
///     values: vec![31.0, 40.0, 12.0, f64::NAN],
///     x: Axis::log("Frequency (Hz)"),
///     label: "Point".into(),
///     colours: Colours { title: "Signal to noise (dB)".into(), ..Colours::default() },
///     ..Cells::default()
/// };
/// let drawing = Figure::of(cells).draw()?;
/// assert_eq!(drawing.tick_labels(0).unwrap()[1], ["1", "2"]);
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// Edges of the columns, ascending, in the unit of the abscissae: one more than columns.
    pub edges: Vec<f64>,
    /// Names of the rows, the first at the top. Where there is no room for all, every second, fifth, tenth and so on is written.
    pub rows: Vec<String>,
    /// `rows x columns` values, row by row.
    pub values: Vec<f64>,
    /// The axis of abscissae, along the columns.
    pub x: Axis,
    /// Label of the axis of rows, which says what the names of the rows stand for.
    pub label: String,
    /// How values become colours.
    pub colours: Colours,
    /// Text above the frame, in as many lines as it takes; none if empty.
    pub title: String,
    /// Height of the frame in millimetres; if absent, 4 mm per row, but at least 30 mm and at most 160 mm.
    pub height_mm: Option<f64>,
}

/// Height of a row in millimetres, if none is given: that of its name and some room. At half of it names of rows
/// would touch.
const ROW: f64 = 4.0;
/// Least and greatest height of all rows in millimetres, so that the bar has room and the figure fits a page.
const HEIGHT: [f64; 2] = [30.0, 160.0];

impl Cells {
    fn columns(&self) -> usize {
        self.edges.len().saturating_sub(1)
    }

    fn check(&self) -> Result<(), PlotError> {
        let what = format!("cells `{}`", self.title);
        same_length(&what, self.rows.len().saturating_mul(self.columns()), self.values.len())?;
        some_finite(&what, &self.values)?;
        match self.edges.windows(2).find(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less)) {
            Some(pair) => {
                Err(PlotError::Range { what, expected: "edges of columns in order", found: pair[1] })
            }
            None => Ok(()),
        }
    }

    /// Names of the rows that fit a height in points, each with its place in rows from the bottom.
    fn named(&self, height: f64, size: f64) -> Vec<(f64, String)> {
        let most = (height / (1.3 * size)).max(1.0);
        let steps = (0..12).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_usize.pow(power)));
        let step = steps.into_iter().find(|step| (self.rows.len() / step) as f64 <= most).unwrap_or(1);
        let place = |row: usize| (self.rows.len() - row) as f64 - 0.5;
        let shown = self.rows.iter().enumerate().filter(|(row, _)| (row + 1) % step == 0);
        shown.map(|(row, name)| (place(row), name.clone())).collect()
    }
}

pub(crate) struct PreparedCells<'a> {
    cells: &'a Cells,
    style: &'a Style,
    colours: Colours,
    bar: Bar,
    x: Ruler,
    y: Ruler,
    title: Title,
    height: f64,
}

impl<'a> PreparedCells<'a> {
    /// Fixes axis and colours for a panel `width` points wide.
    pub fn new(cells: &'a Cells, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        cells.check()?;
        let usual = (ROW * cells.rows.len() as f64).clamp(HEIGHT[0], HEIGHT[1]);
        let height = points(cells.height_mm.filter(|mm| mm.is_finite()).unwrap_or(usual)).clamp(10.0, 5000.0);
        let grid = Grid { values: cells.values.clone(), ..Grid::default() };
        let colours = cells.colours.settle(std::iter::once(&grid))?;
        let bar = Bar::new(&colours, height, style)?;
        let none = Padding { share: 0.0, zero: false };
        let across = (width - 11.0 * style.label_pt).max(20.0);
        let edges = cells.edges.iter().copied();
        let x = Ruler::new(&cells.x, edges, none, Direction::Across, across, style.tick_pt)?;
        let rows = Axis::new("").from(0.0).to(cells.rows.len() as f64);
        let mut y = Ruler::new(&rows, std::iter::empty(), none, Direction::Up, height, style.tick_pt)?;
        (y.major, y.minor, y.power) = (cells.named(height, style.tick_pt), Vec::new(), None);
        let title = Title::new(&cells.title, across, style);
        Ok(Self { cells, style, colours, bar, x, y, title, height })
    }

    /// The picture of all cells, over the frame.
    fn picture(&self, canvas: &mut Canvas, frame: Rect) -> Result<(), PlotError> {
        let (rows, columns) = (self.cells.rows.len(), self.cells.columns());
        let pixels = |length: f64| ((length * DENSITY).ceil().max(1.0) as usize).min(LONGEST);
        let (width, height) = (pixels(frame.width), pixels(frame.height).max(rows));
        let places: Vec<f64> = self.cells.edges.iter().map(|edge| self.x.place(*edge)).collect();
        let column = |pixel: usize| {
            let at = (pixel as f64 + 0.5) / width as f64;
            places.partition_point(|edge| *edge <= at).checked_sub(1).filter(|column| *column < columns)
        };
        let across: Vec<Option<usize>> = (0..width).map(column).collect();
        let mut indices = Vec::with_capacity(width * height);
        for pixel in 0..height {
            let row = (pixel * rows + rows / 2) / height;
            let values = &self.cells.values[row.min(rows - 1) * columns..][..columns];
            let colour = |column: &Option<usize>| {
                let value = column.map_or(f64::NAN, |column| values[column]);
                let place = if value.is_finite() { self.colours.place(value as f32) } else { f64::NAN };
                encode::index(place)
            };
            indices.extend(across.iter().map(colour));
        }
        canvas.image(frame, &encode::indexed(width, height, &indices, self.colours.map)?);
        Ok(())
    }
}

impl Prepared for PreparedCells<'_> {
    fn margins(&self) -> Margins {
        Margins {
            left: frame::room_left(&self.cells.label, &self.y, self.style),
            right: self.bar.room(self.style),
            top: self.title.room(self.style) + frame::room_above(&self.y, self.style),
            bottom: frame::room_below(&self.cells.x.label, self.style),
        }
    }

    fn height(&self, _width: f64) -> f64 {
        self.height
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let placed = Placed { frame, x: self.x.clone(), y: self.y.clone() };
        self.picture(canvas, frame)?;
        frame::draw_across(canvas, &placed, &self.cells.x.label, 0.0, self.style);
        frame::draw_up(canvas, &placed, &self.cells.label, 0.0, self.style);
        self.bar.draw(canvas, frame, self.style);
        let above = frame::room_above(&placed.y, self.style);
        let at = [frame.x + frame.width / 2.0, frame.y - above - GAP / 2.0];
        self.title.draw(canvas, at, self.style);
        Ok(placed)
    }
}
