use super::polygon;
use super::range::of;
use super::reader::{Entry, Faults, Section};
use crate::{Drawing, StoreError};
use unripple_core::{Edge, Edges, Point, Shape};

/// The keys that give a shape.
const SHAPES: [&str; 5] = ["rectangle_mm", "circle_mm", "stadium_mm", "polygon_mm", "svg"];

/// The edge conditions and their names.
pub(super) const EDGES: [(&str, Edge); 3] =
    [("clamped", Edge::Clamped), ("supported", Edge::Supported), ("free", Edge::Free)];

/// How finely the curves of an SVG outline are followed, in metres.
const SVG_TOLERANCE: f64 = 1e-5;

/// Hands over the text of the SVG file that an outline names.
pub(super) type Fetch<'f> = dyn Fn(&str) -> Result<String, StoreError> + 'f;

/// What of the table `[outline]` is without fault: actuators are judged by the shape even if the edges are not.
#[derive(Default)]
pub(super) struct Rim {
    pub shape: Option<Shape>,
    pub edges: Option<Edges>,
}

pub(super) fn read(section: &Section, fetch: &Fetch, faults: &mut Faults) -> Rim {
    let known: Vec<&str> = SHAPES.into_iter().chain(["edge"]).collect();
    section.check_keys(&known, |_| None, faults);
    let shape = shape(section, fetch, faults);
    let edges = edges(section, shape.as_ref(), faults);
    Rim { shape, edges }
}

fn shape(section: &Section, fetch: &Fetch, faults: &mut Faults) -> Option<Shape> {
    let given: Vec<Entry> = SHAPES.iter().filter_map(|key| section.get(key)).collect();
    let one = format!("exactly one of {}", SHAPES.join(", "));
    let [entry] = given.as_slice() else {
        let keys: Vec<&str> = given.iter().map(|e| e.key.as_str()).collect();
        let found = if keys.is_empty() { "none".into() } else { keys.join(" and ") };
        let span = given.get(1).map_or(section.span.clone(), |second| second.span.clone());
        faults.add(&section.key, span, found, one, None);
        return None;
    };
    match entry.key.rsplit('.').next()? {
        "rectangle_mm" => {
            let [width, height] = entry.numbers(&of::LENGTH, "[width, height] in mm", faults)?;
            Some(Shape::Rectangle { width, height })
        }
        "circle_mm" => Some(Shape::Circle { radius: entry.number(&of::LENGTH, faults)? }),
        "stadium_mm" => stadium(entry, faults),
        "polygon_mm" => polygon::read(entry, faults).map(Shape::Polygon),
        _ => drawing(entry, fetch, faults).map(Shape::Polygon),
    }
}

fn stadium(entry: &Entry, faults: &mut Faults) -> Option<Shape> {
    let Some([straight, radius]) = entry.items().and_then(|items| <[Entry; 2]>::try_from(items).ok()) else {
        entry.refuse("[straight length, radius] in mm", None, faults);
        return None;
    };
    let straight = straight.number(&of::STRAIGHT, faults);
    let radius = radius.number(&of::LENGTH, faults);
    Some(Shape::Stadium { straight: straight?, radius: radius? })
}

/// One closed path of an SVG file, moved so that its bounding box starts at the origin.
fn drawing(entry: &Entry, fetch: &Fetch, faults: &mut Faults) -> Option<Vec<Point>> {
    let name = entry.line("the name of an SVG file", faults)?;
    let outline = fetch(&name)
        .and_then(|text| Drawing::parse(&text, &name, SVG_TOLERANCE))
        .and_then(|drawing| drawing.outline(&name));
    match outline {
        Ok(vertices) => polygon::check(entry, vertices, faults),
        Err(StoreError::Content { file, expected, found }) => {
            let found = if file == name { found } else { format!("{found} in {file}") };
            faults.add(&entry.key, entry.span.clone(), found, expected, None);
            None
        }
        Err(other) => {
            faults.add(&entry.key, entry.span.clone(), other.to_string(), "an SVG file", None);
            None
        }
    }
}

fn edges(section: &Section, shape: Option<&Shape>, faults: &mut Faults) -> Option<Edges> {
    let Some(entry) = section.get("edge") else { return Some(Edges::All(Edge::Clamped)) };
    let Some(items) = entry.items() else {
        return entry.choice(&EDGES, faults).map(Edges::All);
    };
    let list: Vec<Option<Edge>> = items.iter().map(|item| item.choice(&EDGES, faults)).collect();
    let sides = match shape {
        Some(Shape::Rectangle { .. }) => 4,
        Some(Shape::Polygon(vertices)) if section.get("svg").is_none() => vertices.len(),
        Some(_) => {
            let expected =
                "one word for the whole rim: a list is for the sides of rectangle_mm or polygon_mm";
            entry.refuse(expected, None, faults);
            return None;
        }
        None => return None,
    };
    if list.len() != sides {
        let found = format!("a list of {}", list.len());
        let expected = format!("one word, or a list of {sides}, one per side from the bottom, anticlockwise");
        faults.add(&entry.key, entry.span.clone(), found, expected, None);
        return None;
    }
    list.into_iter().collect::<Option<Vec<Edge>>>().map(Edges::PerSide)
}
