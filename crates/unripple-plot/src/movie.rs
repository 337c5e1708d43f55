//! Animated PNG of a field.

use crate::canvas::{Anchor, Canvas, Rect, Rise, Text};
use crate::colour::Rgb;
use crate::colours::{Bar, Colours};
use crate::encode::{self, image_error};
use crate::field::{self, Marker};
use crate::grid::Ring;
use crate::inks::Inks;
use crate::placed::Placed;
use crate::plane;
use crate::raster::Raster;
use crate::strip::{Shot, draw_scale};
use crate::style::{GAP, Style};
use crate::{PlotError, error};
use rayon::prelude::*;
use resvg::tiny_skia::Pixmap;

/// An animated PNG of a field in motion. It repeats for ever, and has few colours so that it stays small.
///
/// # Example
/// ```
/// use unripple_plot::{Grid, Movie, Shot};
/// let shot = |phase: f64| Shot {
///     grid: Grid { columns: 2, rows: 2, first: [0.0; 2], pitch: [1.0; 2], values: vec![phase, -phase, 0.0, 1.0] },
///     caption: format!("{phase} ms"),
/// };
/// let movie = Movie { shots: vec![shot(0.0), shot(1.0)], ..Movie::default() };
/// assert_eq!(&movie.apng()?[1..4], b"PNG");
/// # Ok::<(), unripple_plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Movie {
    /// The frames, all on grids of the same shape; their captions give the time.
    pub shots: Vec<Shot>,
    /// Outline of the surface, as closed polygons to which the field is clipped, in the grids' unit of length; if
    /// empty, the whole grid is shown.
    pub outline: Vec<Ring>,
    /// Actuators, targets and focal discs.
    pub markers: Vec<Marker>,
    /// How values become colours, the same in every frame.
    pub colours: Colours,
    /// Unit of the scale bar.
    pub unit: String,
    /// Factor from the grids' unit of length to the unit of the scale bar.
    pub multiplier: f64,
    /// Width of the whole picture, 120 to 4000 pixels.
    pub width_px: u32,
    /// Frames a second, above 0 and at most 100.
    pub rate: f64,
}

impl Default for Movie {
    fn default() -> Self {
        Self {
            shots: Vec::new(),
            outline: Vec::new(),
            markers: Vec::new(),
            colours: Colours::default(),
            unit: "mm".to_owned(),
            multiplier: 1e3,
            width_px: 360,
            rate: 15.0,
        }
    }
}

/// Pixels to a point, so that text is legible on a screen.
const DENSITY: f64 = 1.5;
/// Frames held in memory at once: they are encoded in parallel, and twice as many take twice the memory.
const BATCH: usize = 64;

/// What is common to all frames of a movie.
struct Stage<'a> {
    movie: &'a Movie,
    style: Style,
    colours: Colours,
    bar: Bar,
    placed: Placed,
    /// Width and height of the picture, in points.
    size: [f64; 2],
    /// The part of the picture that moves, in pixels: left, top, width, height.
    moving: [usize; 4],
}

impl Movie {
    /// Draws and encodes all frames.
    ///
    /// Errors when there is no frame, when frames differ in shape or hold nothing finite, and when an option is outside its range.
    pub fn apng(&self) -> Result<Vec<u8>, PlotError> {
        let stage = Stage::new(self)?;
        let inks = Inks::new(self.colours.map);
        let still = stage.still(&inks)?;
        let failed = image_error("writing the animation");
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, still.width as u32, still.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(inks.palette());
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Paeth);
        encoder.set_animated(self.shots.len() as u32, 0).map_err(|e| failed(&e))?;
        let delay = (1000.0 / self.rate).round().clamp(1.0, 65_535.0) as u16;
        encoder.set_frame_delay(delay, 1000).map_err(|e| failed(&e))?;
        let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
        let painter = Painter::new(&stage, &inks)?;
        for (batch, shots) in self.shots.chunks(BATCH).enumerate() {
            let frames = shots.par_iter().map(|shot| painter.frame(shot)).collect::<Result<Vec<_>, _>>()?;
            for (i, frame) in frames.into_iter().enumerate() {
                let [x, y, width, height] = stage.moving;
                if batch == 0 && i == 0 {
                    writer.write_image_data(&still.with(&frame, stage.moving)).map_err(|e| failed(&e))?;
                    continue;
                }
                writer.set_frame_dimension(width as u32, height as u32).map_err(|e| failed(&e))?;
                writer.set_frame_position(x as u32, y as u32).map_err(|e| failed(&e))?;
                writer.write_image_data(&frame).map_err(|e| failed(&e))?;
            }
        }
        writer.finish().map_err(|e| failed(&e))?;
        Ok(file)
    }

    fn check(&self) -> Result<&Shot, PlotError> {
        let Some(first) = self.shots.first() else {
            return Err(PlotError::Empty { what: "movie".to_owned(), found: "no frames".to_owned() });
        };
        first.grid.check(&format!("frame `{}`", first.caption))?;
        for shot in &self.shots {
            let what = format!("frame `{}`", shot.caption);
            error::same_length(&what, first.grid.columns, shot.grid.columns)?;
            error::same_length(&what, first.grid.rows, shot.grid.rows)?;
            error::same_length(&what, first.grid.values.len(), shot.grid.values.len())?;
        }
        let range = |what: &str, expected, found: f64, legal: bool| {
            if legal { Ok(()) } else { Err(PlotError::Range { what: what.to_owned(), expected, found }) }
        };
        let width = f64::from(self.width_px);
        range("width of the movie", "120 to 4000 pixels", width, (120.0..=4000.0).contains(&width))?;
        let legal = self.rate > 0.0 && self.rate <= 100.0;
        range("rate of the movie", "above 0 and at most 100 frames a second", self.rate, legal)?;
        Ok(first)
    }
}

impl<'a> Stage<'a> {
    fn new(movie: &'a Movie) -> Result<Self, PlotError> {
        let first = movie.check()?;
        let style = Style::default();
        let view = plane::view(&first.grid, &movie.outline)?;
        let aspect = plane::aspect(view);
        let colours = movie.colours.settle(movie.shots.iter().map(|shot| &shot.grid))?;
        let width = f64::from(movie.width_px) / DENSITY;
        let edge = 4.0;
        // The bar's room hardly depends on its length, the field's width on the bar's room.
        let room = Bar::new(&colours, 0.7 * width * aspect, &style)?.room(&style);
        let across = (width - 2.0 * edge - room).max(10.0);
        let bar = Bar::new(&colours, across * aspect, &style)?;
        let top = edge + 1.4 * style.label_pt;
        let frame = Rect { x: edge, y: top, width: across, height: across * aspect };
        let [x, y] = plane::rulers(view, movie.multiplier, [frame.width, frame.height], &style)?;
        let height = frame.bottom() + 2.0 * GAP + 0.6 * style.tick_pt + edge;
        let pixels = |points: f64| (points * DENSITY).round().max(0.0) as usize;
        // Half a line's width beyond the field, so that the whole outline is repainted.
        let (left, right) = (pixels(frame.x - 1.0), pixels(frame.right() + 1.0));
        let (upper, lower) = (pixels(edge), pixels(frame.bottom() + 1.0));
        let moving = [left, upper, right - left, lower - upper];
        let placed = Placed { frame, x, y };
        Ok(Self { movie, style, colours, bar, placed, size: [width, height], moving })
    }

    fn render(&self, canvas: &Canvas, background: Option<Rgb>) -> Result<Pixmap, PlotError> {
        let svg = canvas.finish(self.size[0], self.size[1], "");
        encode::render(&svg, (DENSITY * 72.0 / 96.0) as f32, background)
    }

    /// The still background, on white.
    fn still(&self, inks: &Inks) -> Result<Still, PlotError> {
        let mut canvas = Canvas::default();
        self.bar.draw(&mut canvas, self.placed.frame, &self.style);
        draw_scale(&mut canvas, self.placed.frame, &self.placed.x, &self.movie.unit, &self.style);
        let pixmap = self.render(&canvas, Some(Rgb::WHITE))?;
        let indices = pixmap.data().chunks_exact(4).map(|p| inks.nearest(Rgb(p[0], p[1], p[2]))).collect();
        Ok(Still { width: pixmap.width() as usize, height: pixmap.height() as usize, indices })
    }
}

/// The surroundings of a movie's field.
struct Still {
    width: usize,
    height: usize,
    indices: Vec<u8>,
}

impl Still {
    /// The whole picture with one frame in it.
    fn with(&self, frame: &[u8], [x, y, width, _]: [usize; 4]) -> Vec<u8> {
        let mut picture = self.indices.clone();
        for (row, pixels) in frame.chunks_exact(width).enumerate() {
            let start = (y + row) * self.width + x;
            if let Some(place) = picture.get_mut(start..start + width) {
                place.copy_from_slice(pixels);
            }
        }
        picture
    }
}

/// Makes frames: the field, under an outline and markers drawn once.
struct Painter<'a> {
    stage: &'a Stage<'a>,
    inks: &'a Inks,
    raster: Raster,
    /// Left, top, width and height of the field within what moves, in pixels.
    field: [usize; 4],
    /// Whether each pixel of what moves is within the outline.
    within: Vec<bool>,
    /// Red, green, blue and opacity of what lies over the field, colours already weighted by opacity.
    over: Vec<[u8; 4]>,
}

impl<'a> Painter<'a> {
    fn new(stage: &'a Stage, inks: &'a Inks) -> Result<Self, PlotError> {
        let movie = stage.movie;
        let grid = &movie.shots[0].grid;
        let cells = field::cells_rect(&stage.placed, grid).unwrap_or(stage.placed.frame);
        let pixels = |points: f64| (points * DENSITY).round();
        let (left, top) = (pixels(cells.x), pixels(cells.y));
        let width = (pixels(cells.right()) - left).clamp(1.0, 8000.0) as usize;
        let height = (pixels(cells.bottom()) - top).clamp(1.0, 8000.0) as usize;
        let offset = |place: f64, moving: usize| (place - moving as f64).max(0.0) as usize;
        let place = [offset(left, stage.moving[0]), offset(top, stage.moving[1]), width, height];
        let raster = Raster::new(grid, &movie.outline, width, height);
        let mut overlay = Canvas::default();
        field::overlay(&mut overlay, &stage.placed, &movie.outline, &movie.markers, &stage.style);
        let over = moving(&stage.render(&overlay, None)?, stage.moving);
        let within = if movie.outline.is_empty() {
            vec![true; over.len()]
        } else {
            let mut filled = Canvas::default();
            filled.fill(&field::rim(&stage.placed, &movie.outline), Rgb::BLACK, 1.0);
            let filled = stage.render(&filled, None)?;
            moving(&filled, stage.moving).iter().map(|pixel| pixel[3] >= 128).collect()
        };
        Ok(Self { stage, inks, raster, field: place, within, over })
    }

    /// Indices of the pixels of what moves, for one frame.
    fn frame(&self, shot: &Shot) -> Result<Vec<u8>, PlotError> {
        let [_, _, width, height] = self.stage.moving;
        let mut indices = vec![self.inks.nearest(Rgb::WHITE); width * height];
        let [x, y, across, _] = self.field;
        for (row, values) in self.raster.pixels(&shot.grid.values).chunks_exact(across).enumerate() {
            let start = (y + row) * width + x;
            let room = across.min(width.saturating_sub(x));
            for (i, value) in values.iter().take(room).enumerate() {
                if self.within.get(start + i).is_some_and(|within| *within) && !value.is_nan() {
                    indices[start + i] = self.inks.of(self.stage.colours.place(*value));
                }
            }
        }
        self.lay_over(&mut indices, &self.over);
        self.lay_over(&mut indices, &self.caption(&shot.caption)?);
        Ok(indices)
    }

    fn lay_over(&self, indices: &mut [u8], over: &[[u8; 4]]) {
        for (index, [r, g, b, opacity]) in indices.iter_mut().zip(over).filter(|(_, over)| over[3] > 0) {
            let Rgb(r0, g0, b0) = self.inks.colour(*index);
            let through = |under: u8| (u16::from(under) * u16::from(255 - opacity) / 255) as u8;
            let mixed = |over: u8, under: u8| over.saturating_add(through(under));
            *index = self.inks.nearest(Rgb(mixed(*r, r0), mixed(*g, g0), mixed(*b, b0)));
        }
    }

    /// The caption alone: the rows of what moves down to its foot.
    fn caption(&self, caption: &str) -> Result<Vec<[u8; 4]>, PlotError> {
        let (frame, style) = (self.stage.placed.frame, &self.stage.style);
        let mut canvas = Canvas::default();
        let at = [frame.x + frame.width / 2.0, frame.y - 1.3 * GAP];
        canvas.text(Text::new(caption, at, style.label_pt).anchor(Anchor::Middle).rise(Rise::Baseline));
        let svg = canvas.finish(self.stage.size[0], frame.y, "");
        let pixmap = encode::render(&svg, (DENSITY * 72.0 / 96.0) as f32, None)?;
        Ok(moving(&pixmap, self.stage.moving))
    }
}

/// The part of a picture that moves, as far down as the picture goes.
fn moving(pixmap: &Pixmap, [x, y, width, height]: [usize; 4]) -> Vec<[u8; 4]> {
    let line = 4 * pixmap.width() as usize;
    let rows = pixmap.data().chunks_exact(line).skip(y).take(height);
    let part = rows.flat_map(|row| row.chunks_exact(4).skip(x).take(width));
    part.map(|pixel| [pixel[0], pixel[1], pixel[2], pixel[3]]).collect()
}
