//! A field over the surface: picture, outline and markers, in a frame already placed.

use crate::canvas::{Anchor, Canvas, Rect, Rise, Stroke, Text, path};
use crate::colour::Rgb;
use crate::colours::Colours;
use crate::grid::{Grid, Ring};
use crate::placed::Placed;
use crate::raster::Raster;
use crate::style::Style;
use crate::{PlotError, encode, font};

/// The kind of a marker on a map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Symbol {
    /// An actuator: a dark square.
    #[default]
    Actuator,
    /// A target of focusing: a cross.
    Target,
    /// A circle of a radius in the grid's unit of length, such as the focal disc.
    Circle(f64),
}

/// A marker on a map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marker {
    /// Place of the marker, in the grid's unit of length.
    pub at: [f64; 2],
    /// The symbol that is drawn.
    pub symbol: Symbol,
    /// Name of the marker, written beside it; none if empty.
    pub name: String,
}

/// Pixels per point of an embedded picture: 200 per inch, interpolated further by the viewer.
pub(crate) const DENSITY: f64 = 200.0 / 72.0;
/// Largest number of pixels along a side of an embedded picture. It bounds the file's size: at 200 to an inch that is 8 inches.
pub(crate) const LONGEST: usize = 1600;

/// Draws a field clipped to the outline, or whole where there is none.
pub(crate) fn picture(
    canvas: &mut Canvas,
    placed: &Placed,
    grid: &Grid,
    outline: &[Ring],
    colours: &Colours,
) -> Result<(), PlotError> {
    let Some(rect) = cells_rect(placed, grid) else {
        return Ok(());
    };
    let pixels = |length: f64, cells: usize| {
        let factor = (length * DENSITY / cells.max(1) as f64).ceil().max(1.0) as usize;
        (factor * cells).min(LONGEST.max(cells))
    };
    let (width, height) = (pixels(rect.width, grid.columns), pixels(rect.height, grid.rows));
    let raster = Raster::new(grid, outline, width, height);
    let indices: Vec<u8> =
        raster.pixels(&grid.values).into_iter().map(|value| encode::index(colours.place(value))).collect();
    let png = encode::indexed(width, height, &indices, colours.map)?;
    let rim = rim(placed, outline);
    if rim.is_empty() {
        canvas.image(rect, &png);
    } else {
        canvas.clip(&rim);
        canvas.image(rect, &png);
        canvas.end();
    }
    Ok(())
}

/// The rectangle all cells of a grid cover.
pub(crate) fn cells_rect(placed: &Placed, grid: &Grid) -> Option<Rect> {
    let [low, high] = grid.corners();
    let ([x0, y0], [x1, y1]) = (placed.point(low[0], low[1])?, placed.point(high[0], high[1])?);
    Some(Rect { x: x0, y: y1, width: x1 - x0, height: y0 - y1 })
}

/// The path of the outline.
pub(crate) fn rim(placed: &Placed, outline: &[Ring]) -> String {
    let ring = |ring: &Ring| path(ring.iter().filter_map(|&[x, y]| placed.point(x, y)), true);
    outline.iter().map(ring).collect()
}

/// Draws the outline and the markers with their names.
pub(crate) fn overlay(
    canvas: &mut Canvas,
    placed: &Placed,
    outline: &[Ring],
    markers: &[Marker],
    style: &Style,
) {
    canvas.stroke(&rim(placed, outline), Stroke::solid(Rgb::BLACK, style.line_pt));
    let shown: Vec<(&Marker, [f64; 2])> = markers
        .iter()
        .filter_map(|marker| Some((marker, placed.point(marker.at[0], marker.at[1])?)))
        .filter(|(_, at)| placed.frame.contains(*at))
        .collect();
    for (marker, at) in &shown {
        symbol(canvas, placed, marker, *at);
    }
    let places: Vec<[f64; 2]> = shown.iter().map(|(_, at)| *at).collect();
    let mut taken: Vec<Rect> = Vec::new();
    for (marker, at) in shown.iter().filter(|(marker, _)| !marker.name.is_empty()) {
        let size = 0.88 * style.tick_pt;
        let (rect, anchor) = name_place(&marker.name, *at, size, placed.frame, &places, &taken);
        let x = match anchor {
            Anchor::Start => rect.x,
            Anchor::Middle => rect.x + rect.width / 2.0,
            Anchor::End => rect.right(),
        };
        let text = Text::new(&marker.name, [x, rect.y + rect.height / 2.0], size).anchor(anchor);
        canvas.text(text.rise(Rise::Middle).halo());
        taken.push(rect);
    }
}

/// Half the side of an actuator's square, in points. A square of 3 pt hides little of the field.
const HALF: f64 = 1.5;

fn symbol(canvas: &mut Canvas, placed: &Placed, marker: &Marker, [x, y]: [f64; 2]) {
    match marker.symbol {
        Symbol::Actuator => {
            let square =
                |h: f64| path([[x - h, y - h], [x + h, y - h], [x + h, y + h], [x - h, y + h]], true);
            canvas.fill(&square(HALF + 0.6), Rgb::WHITE, 1.0);
            canvas.fill(&square(HALF), Rgb::BLACK, 1.0);
        }
        Symbol::Target => {
            let r = 2.6;
            let bars = path([[x - r, y], [x + r, y]], false) + &path([[x, y - r], [x, y + r]], false);
            canvas.stroke(&bars, Stroke::solid(Rgb::WHITE, 1.9));
            canvas.stroke(&bars, Stroke::solid(Rgb::BLACK, 0.8));
        }
        Symbol::Circle(radius) => {
            if let Some([edge, _]) = placed.point(marker.at[0] + radius.abs(), marker.at[1]) {
                let dash = Stroke { ink: Rgb::BLACK, width: 0.7, dash: &[3.0, 2.0] };
                canvas.circle([x, y], edge - x, None, Stroke::solid(Rgb::WHITE, 1.4));
                canvas.circle([x, y], edge - x, None, dash);
            }
        }
    }
}

/// Place of a name that hides no marker and no other name, towards the middle of the map if possible.
fn name_place(
    name: &str,
    [x, y]: [f64; 2],
    size: f64,
    frame: Rect,
    places: &[[f64; 2]],
    taken: &[Rect],
) -> (Rect, Anchor) {
    let (width, height) = (font::width(name, size), size);
    let away = HALF + 2.0;
    let rightwards = (Rect { x: x + away, y: y - height / 2.0, width, height }, Anchor::Start);
    let leftwards = (Rect { x: x - away - width, y: y - height / 2.0, width, height }, Anchor::End);
    let above = (Rect { x: x - width / 2.0, y: y - away - height, width, height }, Anchor::Middle);
    let below = (Rect { x: x - width / 2.0, y: y + away, width, height }, Anchor::Middle);
    let order = if x < frame.x + frame.width / 2.0 {
        [rightwards, above, below, leftwards]
    } else {
        [leftwards, above, below, rightwards]
    };
    let free = |rect: &Rect| {
        let inside = frame.contains([rect.x, rect.y]) && frame.contains([rect.right(), rect.bottom()]);
        let room = Rect { x: rect.x - 2.0, y: rect.y - 2.0, width: width + 4.0, height: height + 4.0 };
        inside
            && !places.iter().any(|at| room.contains(*at))
            && !taken.iter().any(|other| {
                rect.x < other.right()
                    && other.x < rect.right()
                    && rect.y < other.bottom()
                    && other.y < rect.bottom()
            })
    };
    order.into_iter().find(|(rect, _)| free(rect)).unwrap_or(order[0])
}
