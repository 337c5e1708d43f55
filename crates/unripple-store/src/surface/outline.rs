//! The table `[outline]`.

use super::edge::{self, SidesListed};
use super::path;
use super::polygon;
use super::range::{Limits, of};
use super::reader::{Entry, Faults, Section};
use super::ring::Ring;
use crate::{Curve, StoreError, read_curves};
use std::ops::Range;
use unripple_core::{Edge, Edges, Hole, Outline, Point, Shape};

/// Largest number of holes of a surface: a bound on the pairs of rims that are compared.
pub(super) const MOST_HOLES: usize = 256;

/// Keys of the table `[outline]` that give a shape; exactly one of them is there.
const SHAPES: [&str; 6] = ["rectangle_mm", "circle_mm", "stadium_mm", "polygon_mm", "path_mm", "svg"];

/// Hands over the text of the SVG file that an outline or a hole names.
pub(super) type Fetch<'f> = dyn Fn(&str) -> Result<String, StoreError> + 'f;

/// The parts of the table `[outline]` that are without fault: actuators are checked even if the edges are at fault.
#[derive(Default)]
pub(super) struct Rim {
    /// Shape of the outer rim.
    pub shape: Option<Shape>,
    /// How the sides of the outline are held.
    pub edges: Option<Edges>,
    /// Holes drawn in the same SVG file as the rim.
    pub holes: Vec<Hole>,
    /// The bytes of the file that give the shape.
    pub shape_span: Range<usize>,
    /// The bytes of the file that say how the edges are held.
    pub edge_span: Range<usize>,
}

impl Rim {
    /// The outline with these holes; edges whose condition is invalid count as clamped.
    pub fn outline(&self, holes: &[Hole]) -> Option<Outline> {
        let edges = self.edges.clone().unwrap_or(Edges::All(Edge::Clamped));
        Some(Outline { shape: self.shape.clone()?, edges, holes: holes.to_vec() })
    }
}

pub(super) fn read(section: &Section, fetch: &Fetch, faults: &mut Faults) -> Rim {
    let known: Vec<&str> = SHAPES.into_iter().chain(["edge"]).collect();
    section.check_keys(&known, |_| None, faults);
    let entry = only_shape(section, &SHAPES, faults);
    let drawn = entry.as_ref().filter(|e| e.key.ends_with(".svg"));
    let (shape, ring, holes) = match (drawn, &entry) {
        (Some(entry), _) => drawing(entry, fetch, faults)
            .map_or((None, None, Vec::new()), |(ring, holes)| (Some(ring.shape()), Some(ring), holes)),
        (None, Some(entry)) => (shape(entry, faults), None, Vec::new()),
        (None, None) => (None, None, Vec::new()),
    };
    let listed = shape.as_ref().map(|shape| sides_listed(shape, ring.as_ref()));
    let expand = |list: Vec<Edge>| match &ring {
        Some(ring) => ring.edges(&list),
        None => Edges::PerSide(list),
    };
    let edges = edge::read(section, Edge::Clamped, listed.as_ref(), expand, faults);
    let span_of = |key: &str| section.get(key).map_or(section.span.clone(), |e| e.span);
    let shape_span = entry.map_or(section.span.clone(), |e| e.span);
    Rim { shape, edges, holes, shape_span, edge_span: span_of("edge") }
}

fn sides_listed(shape: &Shape, ring: Option<&Ring>) -> SidesListed {
    let order = match shape {
        Shape::Rectangle { .. } | Shape::Circle { .. } | Shape::Stadium { .. } => {
            "from the bottom, anticlockwise"
        }
        Shape::Polygon(_) | Shape::Path(_) => "in its own order",
    };
    SidesListed { count: ring.map_or_else(|| shape.sides().len(), Ring::sides_of_file), order }
}

/// The one key of a table that gives a shape.
pub(super) fn only_shape<'a>(
    section: &Section<'a>,
    shapes: &[&str],
    faults: &mut Faults,
) -> Option<Entry<'a>> {
    let mut given: Vec<Entry> = shapes.iter().filter_map(|key| section.get(key)).collect();
    if given.len() == 1 {
        return given.pop();
    }
    let one = format!("exactly one of {}", shapes.join(", "));
    let keys: Vec<&str> = given.iter().map(|e| e.key.as_str()).collect();
    let found = if keys.is_empty() { "none".into() } else { keys.join(" and ") };
    let span = given.get(1).map_or(section.span.clone(), |second| second.span.clone());
    faults.add(&section.key, span, found, one, None);
    None
}

fn shape(entry: &Entry, faults: &mut Faults) -> Option<Shape> {
    match entry.key.rsplit('.').next()? {
        "rectangle_mm" => {
            let [width, height] = entry.numbers(&of::LENGTH, "[width, height] in mm", faults)?;
            Some(Shape::Rectangle { width, height })
        }
        "circle_mm" => Some(Shape::Circle { radius: entry.number(&of::LENGTH, faults)? }),
        "stadium_mm" => stadium(entry, &of::LENGTH, faults),
        "polygon_mm" => polygon::read(entry, faults).map(Shape::Polygon),
        _ => path::read(entry, faults),
    }
}

pub(super) fn stadium(entry: &Entry, length: &Limits, faults: &mut Faults) -> Option<Shape> {
    let Some([straight, radius]) = entry.items().and_then(|items| <[Entry; 2]>::try_from(items).ok()) else {
        entry.refuse("[straight length, radius] in mm", None, faults);
        return None;
    };
    let straight = straight.number(&of::STRAIGHT, faults);
    let radius = radius.number(length, faults);
    Some(Shape::Stadium { straight: straight?, radius: radius? })
}

/// The closed curves of an SVG file: the largest, moved so that its bounding box starts at the origin, and the others as
/// holes with free rims.
fn drawing(entry: &Entry, fetch: &Fetch, faults: &mut Faults) -> Option<(Ring, Vec<Hole>)> {
    let mut rings = rings(entry, fetch, "closed paths, one around all others", faults)?;
    let extent = |ring: &Ring| {
        let bounds = ring.bounds();
        (bounds.greatest.x - bounds.least.x) * (bounds.greatest.y - bounds.least.y)
    };
    let largest = (0..rings.len()).max_by(|a, b| extent(&rings[*a]).total_cmp(&extent(&rings[*b])))?;
    let (rim, origin) = rings.swap_remove(largest).cornered();
    let holes = rings.into_iter().map(|ring| {
        let (ring, at) = ring.cornered();
        let at = Point::new(at.x - origin.x, at.y - origin.y);
        Hole { sides: ring.sides, at, edges: Edges::All(Edge::Free) }
    });
    Some((rim, holes.collect()))
}

/// The one closed curve of the SVG file that a hole names.
pub(super) fn drawn_ring(entry: &Entry, fetch: &Fetch, faults: &mut Faults) -> Option<Ring> {
    let expected = "exactly one closed path";
    let mut rings = rings(entry, fetch, expected, faults)?;
    if rings.len() != 1 {
        faults.add(&entry.key, entry.span.clone(), format!("{} of them", rings.len()), expected, None);
        return None;
    }
    rings.pop()
}

/// How many holes there may be, for messages.
pub(super) fn count_expected() -> String {
    format!("at most {MOST_HOLES} holes")
}

/// The curves of an SVG file, all of them closed and sound.
fn rings(entry: &Entry, fetch: &Fetch, expected: &str, faults: &mut Faults) -> Option<Vec<Ring>> {
    let name = entry.line("the name of an SVG file", faults)?;
    let mut refuse = |found: String, expected: &str| {
        faults.add(&entry.key, entry.span.clone(), found, expected, None);
        None
    };
    let curves = match fetch(&name).and_then(|text| read_curves(&text, &name)) {
        Ok(curves) => curves,
        Err(StoreError::Content { file, expected, found }) => {
            let found = if file == name { found } else { format!("{found} in {file}") };
            return refuse(found, &expected);
        }
        Err(other) => return refuse(other.to_string(), "an SVG file"),
    };
    if curves.iter().any(|curve| !curve.closed) {
        return refuse("an open one".into(), expected);
    }
    if curves.len() > MOST_HOLES + 1 {
        return refuse(format!("{} paths", curves.len()), &count_expected());
    }
    let rings: Vec<Ring> =
        curves.into_iter().map(|Curve { sides, counts, .. }| Ring::new(sides, counts)).collect();
    match rings.iter().find_map(|ring| ring.complaint("a path", path::LEAST_AREA)) {
        Some((found, expected)) => refuse(found, &expected),
        None => Some(rings),
    }
}
