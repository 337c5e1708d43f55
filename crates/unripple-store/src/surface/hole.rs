//! Holes in a surface file.

use super::edge::{self, SidesListed};
use super::outline::{Fetch, MOST_HOLES, count_expected, drawn_ring, only_shape, stadium};
use super::range::of;
use super::reader::{Entry, Faults, Section};
use super::ring::{Ring, off_corner};
use super::{path, polygon};
use std::ops::Range;
use unripple_core::{Edge, Edges, Hole, Point, Shape};

/// Keys of the table `[[hole]]` that give a shape; exactly one of them is there.
const SHAPES: [&str; 7] =
    ["circle_mm", "rectangle_mm", "stadium_mm", "polygon_mm", "path_mm", "slit_mm", "svg"];
/// What `at_mm` of a hole is expected to be, for messages.
const CORNER: &str = "[x, y] in mm, of the lower-left corner of its bounding box";
/// Width of a slit where a file does not say, in metres. 0.2 mm is narrow beside any wavelength of use.
const SLIT_WIDTH: f64 = 0.2e-3;

/// A hole of the file without faults of its own, and where the file gives it.
pub(super) struct Cut {
    /// The hole itself, in metres on the sheet.
    pub hole: Hole,
    /// Path of the key that gives it, as `hole[3]`.
    pub key: String,
    /// The bytes of the file that give its shape.
    pub span: Range<usize>,
}

/// All tables `[[hole]]`, in the file's order: those without fault, and whether these are all.
pub(super) fn read(root: &Section, fetch: &Fetch, faults: &mut Faults) -> (Vec<Cut>, bool) {
    let Some(entry) = root.get("hole") else { return (Vec::new(), true) };
    let Some(items) = entry.items() else {
        entry.refuse("a list of tables, each headed [[hole]]", None, faults);
        return (Vec::new(), false);
    };
    if items.len() > MOST_HOLES {
        let found = format!("{} holes", items.len());
        faults.add("hole", entry.span, found, count_expected(), Some(MOST_HOLES.to_string()));
        return (Vec::new(), false);
    }
    let read: Vec<Option<Cut>> =
        items.iter().map(|item| one(&item.section(faults)?, fetch, faults)).collect();
    let whole = read.iter().all(Option::is_some);
    (read.into_iter().flatten().collect(), whole)
}

fn one(section: &Section, fetch: &Fetch, faults: &mut Faults) -> Option<Cut> {
    let entry = only_shape(section, &SHAPES, faults);
    let name = entry.as_ref().and_then(|e| e.key.rsplit('.').next()).unwrap_or_default();
    let known: Vec<&str> = match name {
        "" => SHAPES.into_iter().chain(["centre_mm", "at_mm", "width_mm", "edge"]).collect(),
        "circle_mm" => vec![name, "centre_mm", "at_mm", "edge"],
        "slit_mm" => vec![name, "width_mm", "edge"],
        _ => vec![name, "at_mm", "edge"],
    };
    let elsewhere = |key: &str| match key {
        "centre_mm" => Some("this key only beside circle_mm".into()),
        "width_mm" => Some("this key only beside slit_mm".into()),
        "at_mm" => Some("this key not beside slit_mm".into()),
        _ => None,
    };
    section.check_keys(&known, elsewhere, faults);
    let cut = entry.as_ref().and_then(|entry| cut(section, entry, name, fetch, faults));
    let (hole, ring) = cut.map_or((None, None), |(hole, ring)| (Some(hole), ring));
    let listed = hole.as_ref().map(|hole| match &ring {
        Some(ring) => SidesListed { count: ring.sides_of_file(), order: "in its own order" },
        None => SidesListed { count: hole.sides.len(), order: "from the bottom, anticlockwise" },
    });
    let expand = |list: Vec<Edge>| match &ring {
        Some(ring) => ring.edges(&list),
        None => Edges::PerSide(list),
    };
    let edges = edge::read(section, Edge::Free, listed.as_ref(), expand, faults);
    let hole = Hole { edges: edges?, ..hole? };
    let entry = entry?;
    Some(Cut { hole, key: entry.key, span: entry.span })
}

/// A hole with a free rim; its ring if the file lists its sides.
fn cut(
    section: &Section,
    entry: &Entry,
    name: &str,
    fetch: &Fetch,
    faults: &mut Faults,
) -> Option<(Hole, Option<Ring>)> {
    let simple = |shape: Option<Shape>, at: Option<Point>| Some((Hole::new(&shape?, at?), None));
    match name {
        "circle_mm" => circle(section, entry, faults).map(|hole| (hole, None)),
        "rectangle_mm" => {
            let sizes = entry.numbers(&of::HOLE_LENGTH, "[width, height] in mm", faults);
            let shape = sizes.map(|[width, height]| Shape::Rectangle { width, height });
            simple(shape, place(section, "at_mm", CORNER, faults))
        }
        "stadium_mm" => {
            let shape = stadium(entry, &of::HOLE_LENGTH, faults);
            simple(shape, place(section, "at_mm", CORNER, faults))
        }
        "slit_mm" => slit(section, entry, faults).map(|hole| (hole, None)),
        "polygon_mm" => {
            let ring = polygon::ring(entry, faults);
            listed(section, entry, ring, ("a polygon", "vertex"), faults)
        }
        "path_mm" => {
            let ring = path::sides(entry, faults).map(Ring::plain);
            listed(section, entry, ring, ("a path", "point"), faults)
        }
        _ => {
            let ring = drawn_ring(entry, fetch, faults);
            let at = place(section, "at_mm", CORNER, faults);
            let (ring, _) = ring?.cornered();
            Some((Hole { sides: ring.sides.clone(), at: at?, edges: Edges::All(Edge::Free) }, Some(ring)))
        }
    }
}

fn place(section: &Section, key: &str, shape: &str, faults: &mut Faults) -> Option<Point> {
    let entry = section.require(key, shape, faults)?;
    entry.numbers(&of::COORDINATE, shape, faults).map(|[x, y]| Point::new(x, y))
}

fn circle(section: &Section, entry: &Entry, faults: &mut Faults) -> Option<Hole> {
    let radius = entry.number(&of::HOLE_LENGTH, faults);
    let corner = match (section.get("centre_mm"), section.get("at_mm")) {
        (None, Some(_)) => place(section, "at_mm", CORNER, faults),
        (Some(_), Some(second)) => {
            let found = "centre_mm and at_mm";
            faults.add(&second.key, second.span, found, "exactly one of them", None);
            None
        }
        _ => place(section, "centre_mm", "[x, y] in mm", faults)
            .zip(radius)
            .map(|(centre, radius)| Point::new(centre.x - radius, centre.y - radius)),
    };
    Some(Hole::new(&Shape::Circle { radius: radius? }, corner?))
}

fn slit(section: &Section, entry: &Entry, faults: &mut Faults) -> Option<Hole> {
    let width = section.number_or("width_mm", SLIT_WIDTH, &of::SLIT_WIDTH, faults);
    let shape = "[[x, y], [x, y]] in mm, the two ends";
    let Some([from, to]) = entry.items().and_then(|items| <[Entry; 2]>::try_from(items).ok()) else {
        entry.refuse(shape, None, faults);
        return None;
    };
    let [from, to] = [from, to].map(|end| end.numbers(&of::COORDINATE, "[x, y] in mm", faults));
    let [from, to] = [from?, to?].map(|[x, y]| Point::new(x, y));
    if from == to {
        entry.refuse("two different ends", None, faults);
        return None;
    }
    Some(Hole::slit(from, to, width?))
}

/// A hole of sides that the file lists: on the sheet, or from `at_mm` on if that is given.
fn listed(
    section: &Section,
    entry: &Entry,
    ring: Option<Ring>,
    (what, each): (&str, &str),
    faults: &mut Faults,
) -> Option<(Hole, Option<Ring>)> {
    let at = match section.get("at_mm") {
        Some(_) => Some(place(section, "at_mm", CORNER, faults)?),
        None => None,
    };
    let ring = ring?;
    let displaced = at.and_then(|_| off_corner(&ring.bounds(), what, each));
    if let Some((found, expected)) = displaced.or_else(|| ring.complaint(what, path::LEAST_AREA)) {
        faults.add(&entry.key, entry.span.clone(), found, expected, None);
        return None;
    }
    let (ring, at) = match at {
        Some(at) => (ring, at),
        None => ring.cornered(),
    };
    Some((Hole { sides: ring.sides.clone(), at, edges: Edges::All(Edge::Free) }, Some(ring)))
}
