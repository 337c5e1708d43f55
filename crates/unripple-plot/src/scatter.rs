//! Values at points of a surface that are on no grid: a disc of its colour at each.

use crate::PlotError;
use crate::canvas::{Canvas, Rect, Stroke};
use crate::colour::Rgb;
use crate::colours::Colours;
use crate::error::{same_length, some_finite};
use crate::field::{self, Marker};
use crate::grid::{Grid, Ring};
use crate::placed::Placed;
use crate::plane::{self, Around, Plane};
use crate::prepared::{Margins, Prepared};
use crate::style::Style;

/// Values at scattered points of a surface, each drawn as a disc of its colour, with outline, markers, colour bar and axes as on a map.
///
/// # Example
/// ```
/// use unripple_plot::{Colours, Figure, Scatter};
/// let scatter = Scatter {
///     points: vec![[0.01, 0.02], [0.05, 0.03]],
///     values: vec![0.0, 2e-3],
///     colours: Colours { title: "Velocity (mm/s)".into(), multiplier: 1e3, ..Colours::default() },
///     ..Scatter::default()
/// };
/// let figure = Figure::of(scatter);
/// assert_eq!(figure.draw()?.svg().matches("<circle").count(), 2);
/// assert_eq!(figure.tables(), ["x (mm),y (mm),Velocity (mm/s)\r\n10,20,0\r\n50,30,2\r\n"]);
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Places of the points, `[x, y]`.
    pub points: Vec<[f64; 2]>,
    /// A value for each point; one that is not finite leaves its point out.
    pub values: Vec<f64>,
    /// Outline of the surface, as closed polygons, in the points' unit of length; if empty, the part of the plane around the points is
    /// shown.
    pub outline: Vec<Ring>,
    /// Actuators, targets and focal discs.
    pub markers: Vec<Marker>,
    /// How values become colours.
    pub colours: Colours,
    /// Unit of the axes.
    pub unit: String,
    /// Factor from the points' unit of length to the unit of the axes.
    pub multiplier: f64,
    /// Text above the points, in as many lines as it takes; none if empty.
    pub title: String,
    /// Greatest height of the frame in millimetres.
    pub height_mm: f64,
}

impl Default for Scatter {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            values: Vec::new(),
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

/// Room round the points where there is no outline, as a share of what they span: as much as a disc takes.
const ROOM: f64 = 0.05;

/// Radius of a disc over the mean distance of the points: discs on a regular grid do not touch.
const SHARE: f64 = 0.4;

/// Least and greatest radius of a disc, in points: a smaller one shows no colour, a larger one hides more of the surface than it says of it.
const RADII: [f64; 2] = [1.2, 4.0];

/// Width of the line round a disc, in points: as thin as prints, so that light colours have an edge and discs keep their colour.
const EDGE: f64 = 0.3;

/// How far rounding may place a point of the rim outside the frame, in points.
const SLACK: f64 = 0.01;

/// The part of the plane that is shown: the outline's bounding box, or that of the points with some room.
fn view(scatter: &Scatter) -> Result<[[f64; 2]; 2], PlotError> {
    if !scatter.outline.iter().all(Vec::is_empty) {
        return plane::view(&Grid::default(), &scatter.outline);
    }
    let [low, high] = plane::bounds(scatter.points.iter());
    let room = ROOM * (high[0] - low[0]).max(high[1] - low[1]);
    let corners = vec![low.map(|x| x - room), high.map(|x| x + room)];
    plane::view(&Grid::default(), &[corners])
}

/// Radius of the discs of so many points in a field, in points of the page.
fn radius(field: Rect, count: usize) -> f64 {
    let apart = (field.width * field.height / count.max(1) as f64).sqrt();
    (SHARE * apart).clamp(RADII[0], RADII[1])
}

pub(crate) struct PreparedScatter<'a> {
    scatter: &'a Scatter,
    plane: Plane<'a>,
}

impl<'a> PreparedScatter<'a> {
    /// Fixes axes and colours for a panel `width` points wide.
    pub fn new(scatter: &'a Scatter, width: f64, style: &'a Style) -> Result<Self, PlotError> {
        let what = format!("scatter `{}`", scatter.title);
        same_length(&what, scatter.points.len(), scatter.values.len())?;
        some_finite(&what, &scatter.values)?;
        let values = Grid { values: scatter.values.clone(), ..Grid::default() };
        let around = Around {
            colours: scatter.colours.settle(std::iter::once(&values))?,
            unit: &scatter.unit,
            multiplier: scatter.multiplier,
            title: &scatter.title,
            height_mm: scatter.height_mm,
        };
        Ok(Self { scatter, plane: Plane::new(view(scatter)?, around, width, style)? })
    }
}

impl Prepared for PreparedScatter<'_> {
    fn margins(&self) -> Margins {
        self.plane.margins()
    }

    fn height(&self, width: f64) -> f64 {
        self.plane.height(width)
    }

    fn draw(&self, canvas: &mut Canvas, frame: Rect) -> Result<Placed, PlotError> {
        let placed = self.plane.placed(frame);
        let Placed { frame: Rect { x, y, width, height }, .. } = placed;
        let seen =
            Rect { x: x - SLACK, y: y - SLACK, width: width + 2.0 * SLACK, height: height + 2.0 * SLACK };
        let (scatter, colours) = (self.scatter, &self.plane.colours);
        let radius = radius(placed.frame, scatter.points.len());
        for (point, value) in scatter.points.iter().zip(&scatter.values) {
            let at = placed.point(point[0], point[1]).filter(|at| seen.contains(*at) && value.is_finite());
            if let Some(at) = at {
                let colour = colours.map.colour(colours.place(*value as f32));
                canvas.circle(at, radius, Some(colour), Stroke::solid(Rgb::GREY, EDGE));
            }
        }
        field::overlay(canvas, &placed, &scatter.outline, &scatter.markers, self.plane.style);
        self.plane.draw(canvas, &placed);
        Ok(placed)
    }
}
