//! Shapes of SVG files with their curves kept.

use super::{FINEST, Page, arcs, ellipse, guard, nothing};
use crate::StoreError;
use crate::file::{LARGEST_TEXT, too_large};
use unripple_core::{Point, Side};
use usvg::tiny_skia_path::{self, PathSegment, Transform};

/// A connected curve of a drawing, not flattened, in metres: y up, the document's lower-left corner at the origin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Lines and cubic Bézier curves that meet end to end, in metres. An elliptic arc is approximated by several,
    /// within 1e-7 m.
    pub sides: Vec<Side>,
    /// Number of sides that each segment of the drawing became, in order.
    pub counts: Vec<usize>,
    /// Whether the curve returns to its start.
    pub closed: bool,
}

/// Largest number of sides of all curves of a drawing. Past it reading ends with an error, which bounds memory.
const MOST_SIDES: usize = 1 << 16;
/// How near a curve's handles must be to its chord for it to be a line, in metres: the accuracy of single precision.
const STRAIGHT: f64 = 1e-8;

/// Reads the curves of the text of an SVG document without flattening them; `name` is the document's name in
/// messages.
///
/// Quadratic curves are raised to cubic ones. An elliptic arc of a path counts as one segment; a circle or an ellipse
/// as four, a quarter each. A cubic curve by which drawing programs approximate a quarter of an ellipse is taken as
/// that quarter, if it agrees to within single precision.
///
/// ```
/// let text = r#"<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm" viewBox="0 0 90 90">
///     <circle cx="40" cy="40" r="30"/></svg>"#;
/// let curves = unripple_store::read_curves(text, "disc.svg")?;
/// assert_eq!((curves.len(), curves[0].counts.len(), curves[0].closed), (1, 4, true));
/// let around: f64 = curves[0].sides.iter().map(|side| side.length()).sum();
/// assert!((around - std::f64::consts::TAU * 0.03).abs() < 1e-7);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
///
/// # Errors
/// As [`crate::Drawing::parse`].
pub fn read_curves(text: &str, name: &str) -> Result<Vec<Curve>, StoreError> {
    if text.len() > LARGEST_TEXT {
        return Err(too_large(name, text.len() as u64));
    }
    let document = guard::document(text, name)?;
    let spelled = arcs::spelled_out(&document);
    let page = match &spelled {
        Some(text) => Page::of(&guard::document(text, name)?, name)?,
        None => Page::of(&document, name)?,
    };
    let mut tracer = Tracer { page: &page, curves: Vec::new(), count: 0 };
    page.paths(&mut |path| tracer.path(path))?;
    if tracer.curves.is_empty() {
        return Err(nothing(name));
    }
    Ok(tracer.curves)
}

/// Collects the curves of a document in drawing order, in metres.
struct Tracer<'p> {
    page: &'p Page<'p>,
    curves: Vec<Curve>,
    count: usize,
}

/// A curve in the making.
#[derive(Default)]
struct Trace {
    curve: Curve,
    start: Point,
    /// The end so far, in metres and in the file's coordinates.
    at: Point,
    raw: Point,
    /// Within an arc that was spelled out: whether a side was begun for it.
    arc: Option<bool>,
}

impl Tracer<'_> {
    fn path(&mut self, path: &usvg::Path) -> Result<(), StoreError> {
        let ts = path.abs_transform();
        let mut trace = Trace::default();
        for segment in path.data().segments() {
            let [handles @ .., end] = self.points(segment, ts)?;
            match segment {
                PathSegment::MoveTo(_) => {
                    self.keep(std::mem::take(&mut trace))?;
                    (trace.start, trace.at, trace.raw) = (end.1, end.1, end.0);
                }
                PathSegment::LineTo(_) => trace.line(end.1),
                PathSegment::QuadTo(..) if handles[0].0 == end.0 && trace.raw == end.0 => {
                    trace.arc = if trace.arc.is_some() { None } else { Some(false) };
                }
                PathSegment::QuadTo(..) => {
                    let third = |from: Point, to: Point| {
                        Point::new(from.x + (to.x - from.x) / 1.5, from.y + (to.y - from.y) / 1.5)
                    };
                    let (at, handle) = (trace.at, handles[0].1);
                    trace.cubic([at, third(at, handle), third(end.1, handle), end.1], false);
                }
                PathSegment::CubicTo(..) => {
                    let raw = [trace.raw, handles[0].0, handles[1].0, end.0];
                    let arc = trace.arc.is_some() || ellipse::is_quarter(&raw);
                    trace.cubic([trace.at, handles[0].1, handles[1].1, end.1], arc);
                }
                PathSegment::Close => {
                    trace.close();
                    let next = Trace { start: trace.start, at: trace.start, raw: end.0, ..Trace::default() };
                    self.keep(std::mem::replace(&mut trace, next))?;
                    continue;
                }
            }
            trace.raw = end.0;
        }
        self.keep(trace)
    }

    /// Two handles and the end of a segment, each as the file says and in metres; missing ones repeat the end.
    fn points(&self, segment: PathSegment, ts: Transform) -> Result<[(Point, Point); 3], StoreError> {
        let place = |p: tiny_skia_path::Point| {
            let metres = self.page.place(p, ts)?;
            let raw = Point::new(f64::from(p.x), f64::from(p.y));
            Ok::<_, StoreError>((raw, Point::new(metres.x, metres.y)))
        };
        let [a, b, end] = match segment {
            PathSegment::MoveTo(p) | PathSegment::LineTo(p) => [p; 3],
            PathSegment::QuadTo(a, p) => [a, p, p],
            PathSegment::CubicTo(a, b, p) => [a, b, p],
            PathSegment::Close => return Ok(Default::default()),
        };
        Ok([place(a)?, place(b)?, place(end)?])
    }

    /// Takes a finished curve, unless it is a mere point.
    fn keep(&mut self, mut trace: Trace) -> Result<(), StoreError> {
        if trace.curve.sides.len() > 1 && trace.at.distance(trace.start) < FINEST {
            trace.close();
        }
        self.count += trace.curve.sides.len();
        if self.count > MOST_SIDES {
            return Err(StoreError::content(self.page.name, format!("at most {MOST_SIDES} sides"), "more"));
        }
        if !trace.curve.sides.is_empty() {
            self.curves.push(trace.curve);
        }
        Ok(())
    }
}

impl Trace {
    /// Adds what one side as drawn became; sides of the same arc count as one.
    fn add(&mut self, sides: impl ExactSizeIterator<Item = Side>) {
        match (self.arc, self.curve.counts.last_mut()) {
            (Some(true), Some(last)) => *last += sides.len(),
            _ => self.curve.counts.push(sides.len()),
        }
        self.arc = self.arc.map(|_| true);
        self.curve.sides.extend(sides);
    }

    fn line(&mut self, to: Point) {
        // What is shorter than the accuracy of the file only moves the next side's start.
        if self.at.distance(to) >= FINEST {
            self.add([Side::Line { from: self.at, to }].into_iter());
            self.at = to;
        }
    }

    fn cubic(&mut self, curve: [Point; 4], arc: bool) {
        let to = curve[3];
        if curve.iter().all(|p| p.distance(self.at) < FINEST) {
            return;
        }
        if is_line(&curve) {
            return self.line(to);
        }
        if arc {
            self.add(ellipse::finer(&curve, FINEST).into_iter().map(Side::Cubic));
        } else {
            self.add([Side::Cubic(curve)].into_iter());
        }
        self.at = to;
    }

    /// Returns to the start, by a line if that is not where it is.
    fn close(&mut self) {
        if self.curve.sides.is_empty() {
            return;
        }
        self.arc = None;
        self.line(self.start);
        match self.curve.sides.last_mut() {
            Some(Side::Line { to, .. }) => *to = self.start,
            Some(Side::Cubic(p)) => p[3] = self.start,
            _ => {}
        }
        self.at = self.start;
        self.curve.closed = true;
    }
}

/// Whether a curve runs straight from its start to its end.
fn is_line(curve: &[Point; 4]) -> bool {
    let [from, a, b, to] = *curve;
    let length = from.distance(to);
    if length < FINEST {
        return false;
    }
    let along = |p: Point| ((p.x - from.x) * (to.x - from.x) + (p.y - from.y) * (to.y - from.y)) / length;
    let off = |p: Point| ((to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x)).abs() / length;
    let between = |p: Point| (-STRAIGHT..=length + STRAIGHT).contains(&along(p));
    [a, b].into_iter().all(|p| off(p) <= STRAIGHT && between(p))
}
