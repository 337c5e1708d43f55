//! Shapes of SVG files, flattened.

mod arcs;
mod curves;
mod ellipse;
mod guard;

pub use curves::{Curve, read_curves};

use crate::StoreError;
use crate::file::{LARGEST_TEXT, read_text, too_large};
use kurbo::{BezPath, PathEl};
use std::path::Path as FilePath;
use unripple_core::Point;
use usvg::roxmltree::Document;
use usvg::tiny_skia_path::{PathSegment, Transform};
use usvg::{Group, ImageHrefResolver, Node, Options, Tree};

/// Metres in one user unit of a document without physical size: a CSS pixel, 1/96 inch.
const PIXEL: f64 = 0.0254 / 96.0;
/// Largest coordinate of a drawing, in metres: single precision, which the reader keeps, resolves 8 µm there.
const LARGEST: f64 = 100.0;
/// Finest tolerance, in metres: the number of points grows with the inverse root of it, by 1.4 for half.
const FINEST: f64 = 1e-7;
/// Largest number of points of a drawing: 16 MB. Past it reading ends with an error, whatever the tolerance.
const MOST_POINTS: usize = 1_000_000;

/// The shapes of an SVG document, flattened: metres, y up, the document's lower-left corner at the origin.
///
/// Paths, rectangles, circles, ellipses, lines, polylines and polygons are read, with groups, transforms, `use` and
/// styles. The physical size is that of `width`, `height` and `viewBox`; a bare number is a CSS pixel, 1/96 inch. What is
/// neither filled nor stroked does not show and is left out, as are text and images.
///
/// ```
/// use unripple_store::Drawing;
/// let text = r#"<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="20mm" viewBox="0 0 30 20">
///     <rect x="10" y="5" width="4" height="3"/>
/// </svg>"#;
/// let drawing = Drawing::parse(text, "box.svg", 1e-5)?;
/// assert!((drawing.width - 0.030).abs() < 1e-8);
/// let rectangle = &drawing.shapes[0];
/// assert!(rectangle.fill.is_some() && rectangle.stroke_width.is_none());
/// let top = rectangle.polylines[0].points.iter().map(|p| p.y).fold(0.0, f64::max);
/// assert!((top - 0.015).abs() < 1e-8);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Width of the document, in metres.
    pub width: f64,
    /// Height of the document, in metres.
    pub height: f64,
    /// The shapes, in drawing order.
    pub shapes: Vec<SvgShape>,
}

/// One shape of a drawing: its curves and how they are painted.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgShape {
    /// The element's id; may be empty.
    pub id: String,
    /// Connected pieces of the shape, in the order drawn.
    pub polylines: Vec<Polyline>,
    /// Rule by which points count as inside the shape, if it is filled.
    pub fill: Option<FillRule>,
    /// Width of its stroke in metres, if it is stroked; a dashed stroke counts as unbroken.
    pub stroke_width: Option<f64>,
}

/// A connected piece of a shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// Corners of the polyline, in metres; where closed, the first is not repeated.
    pub points: Vec<Point>,
    /// Whether the polyline returns to its start.
    pub closed: bool,
}

/// Rule for the inside of a shape whose curves cross or nest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FillRule {
    /// Points around which the curves wind a number of times other than zero, turns in opposite directions
    /// cancelling.
    NonZero,
    /// Points around which the curves wind an odd number of times.
    EvenOdd,
}

impl Drawing {
    /// Reads an SVG file, and approximates its curves by polylines to within `tolerance` metres.
    ///
    /// # Errors
    /// [`StoreError::Read`] if it cannot be read, otherwise as [`Drawing::parse`].
    pub fn read(path: impl AsRef<FilePath>, tolerance: f64) -> Result<Self, StoreError> {
        let path = path.as_ref();
        Self::parse(&read_text(path)?, &path.display().to_string(), tolerance)
    }

    /// Reads the text of an SVG document, and approximates its curves by polylines to within `tolerance`
    /// metres. `name` is the document's name in messages.
    ///
    /// # Errors
    /// [`StoreError::Content`] if it is not SVG, shows nothing, asks for what is not supported (clipping, masks, patterns,
    /// markers, filters, nested `use`, entities), or is past a limit of size, depth or detail.
    pub fn parse(text: &str, name: &str, tolerance: f64) -> Result<Self, StoreError> {
        if text.len() > LARGEST_TEXT {
            return Err(too_large(name, text.len() as u64));
        }
        let document = guard::document(text, name)?;
        let page = Page::of(&document, name)?;
        let (width, height) = (page.width, page.height);
        let tolerance = if tolerance >= FINEST { tolerance } else { FINEST };
        let mut pen = Pen { page: &page, tolerance, points: 0, shapes: Vec::new() };
        page.paths(&mut |path| pen.path(path))?;
        if pen.shapes.is_empty() {
            return Err(nothing(name));
        }
        Ok(Self { width, height, shapes: pen.shapes })
    }
}

fn nothing(name: &str) -> StoreError {
    StoreError::content(name, "a filled or stroked shape (turn text into paths first)", "no visible shape")
}

/// How the reader behaves: nothing outside the text is looked at.
fn options() -> Options<'static> {
    Options {
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    }
}

/// A document as the SVG library reads it, with its physical size in metres.
struct Page<'n> {
    name: &'n str,
    tree: Tree,
    width: f64,
    height: f64,
}

impl<'n> Page<'n> {
    fn of(document: &Document, name: &'n str) -> Result<Self, StoreError> {
        let tree = Tree::from_xmltree(document, &options())
            .map_err(|error| StoreError::content(name, "an SVG document", error.to_string()))?;
        let size = tree.size();
        let (width, height) = (f64::from(size.width()) * PIXEL, f64::from(size.height()) * PIXEL);
        if width.max(height) > LARGEST {
            return Err(StoreError::content(name, format!("a drawing of at most {LARGEST} m"), "more"));
        }
        Ok(Self { name, tree, width, height })
    }

    /// Hands over every path that shows, in drawing order.
    fn paths(&self, take: &mut Take) -> Result<(), StoreError> {
        fn within(group: &Group, take: &mut Take) -> Result<(), StoreError> {
            for node in group.children() {
                match node {
                    Node::Group(inner) => within(inner, take)?,
                    Node::Path(path) if path.is_visible() => take(path)?,
                    _ => {}
                }
            }
            Ok(())
        }
        within(self.tree.root(), take)
    }

    /// A point of a path in metres, y up.
    fn place(&self, p: usvg::tiny_skia_path::Point, ts: Transform) -> Result<kurbo::Point, StoreError> {
        let (x, y) = (f64::from(p.x), f64::from(p.y));
        let x_px = f64::from(ts.sx) * x + f64::from(ts.kx) * y + f64::from(ts.tx);
        let y_px = f64::from(ts.ky) * x + f64::from(ts.sy) * y + f64::from(ts.ty);
        let point = kurbo::Point::new(x_px * PIXEL, self.height - y_px * PIXEL);
        // Not-a-number fails this comparison too.
        if point.x.abs() <= LARGEST && point.y.abs() <= LARGEST {
            return Ok(point);
        }
        let expected = format!("coordinates of at most {LARGEST} m");
        Err(StoreError::content(self.name, expected, format!("({}, {}) m", point.x, point.y)))
    }
}

/// The action on each path of a document.
type Take<'t> = dyn FnMut(&usvg::Path) -> Result<(), StoreError> + 't;

/// Collects shapes, in metres with y up.
struct Pen<'p> {
    page: &'p Page<'p>,
    tolerance: f64,
    points: usize,
    shapes: Vec<SvgShape>,
}

impl Pen<'_> {
    fn path(&mut self, path: &usvg::Path) -> Result<(), StoreError> {
        let to_metres = path.abs_transform();
        let mut curve = BezPath::new();
        for segment in path.data().segments() {
            curve.push(self.element(segment, to_metres)?);
        }
        let polylines = self.flatten(&curve)?;
        if polylines.is_empty() {
            return Ok(());
        }
        let fill = path.fill().map(|fill| match fill.rule() {
            usvg::FillRule::NonZero => FillRule::NonZero,
            usvg::FillRule::EvenOdd => FillRule::EvenOdd,
        });
        let scale = f64::from(to_metres.sx) * f64::from(to_metres.sy)
            - f64::from(to_metres.kx) * f64::from(to_metres.ky);
        let stroke_width =
            path.stroke().map(|stroke| f64::from(stroke.width().get()) * scale.abs().sqrt() * PIXEL);
        self.shapes.push(SvgShape { id: path.id().into(), polylines, fill, stroke_width });
        Ok(())
    }

    /// One segment in metres.
    fn element(&self, segment: PathSegment, ts: Transform) -> Result<PathEl, StoreError> {
        let place = |p| self.page.place(p, ts);
        Ok(match segment {
            PathSegment::MoveTo(p) => PathEl::MoveTo(place(p)?),
            PathSegment::LineTo(p) => PathEl::LineTo(place(p)?),
            PathSegment::QuadTo(a, p) => PathEl::QuadTo(place(a)?, place(p)?),
            PathSegment::CubicTo(a, b, p) => PathEl::CurveTo(place(a)?, place(b)?, place(p)?),
            PathSegment::Close => PathEl::ClosePath,
        })
    }

    /// A curve as polylines within the tolerance.
    fn flatten(&mut self, curve: &BezPath) -> Result<Vec<Polyline>, StoreError> {
        let mut pieces: Vec<Polyline> = Vec::new();
        let mut last = kurbo::Point::ZERO;
        for element in curve.elements() {
            // One at a time, so that the limit is noticed between two curves.
            let start = [PathEl::MoveTo(last), *element];
            let single = matches!(element, PathEl::MoveTo(_) | PathEl::ClosePath);
            kurbo::flatten(start.into_iter().skip(usize::from(single)), self.tolerance, |flat| match flat {
                PathEl::LineTo(p) => add(&mut pieces, p, &mut self.points),
                PathEl::MoveTo(p) if single => {
                    pieces.push(Polyline { points: vec![Point::new(p.x, p.y)], closed: false });
                }
                PathEl::ClosePath => {
                    if let Some(piece) = pieces.last_mut() {
                        piece.closed = true;
                    }
                }
                _ => {}
            });
            last = element.end_point().unwrap_or(last);
            if self.points > MOST_POINTS {
                let expected = format!("at most {MOST_POINTS} points");
                return Err(StoreError::content(self.page.name, expected, "more"));
            }
        }
        Ok(pieces.into_iter().filter_map(tidy).collect())
    }
}

/// Adds a point to the last piece, unless it is there already.
fn add(pieces: &mut [Polyline], p: kurbo::Point, count: &mut usize) {
    let Some(piece) = pieces.last_mut() else { return };
    let point = Point::new(p.x, p.y);
    if piece.points.last() != Some(&point) {
        piece.points.push(point);
        *count += 1;
    }
}

/// A piece whose return to its start is said by `closed` alone; `None` if it is a mere point.
fn tidy(mut piece: Polyline) -> Option<Polyline> {
    if let ([first, .., last], true) = (piece.points.as_slice(), piece.points.len() > 2)
        && first.distance(*last) < FINEST
    {
        piece.points.pop();
        piece.closed = true;
    }
    (piece.points.len() > 1).then_some(piece)
}
