//! An outline in a library's metadata.

use serde::{Deserialize, Serialize};
use unripple_core::{Edge, Edges, Hole, Outline, Point, Shape, Side};

/// An outline as JSON, in SI.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutlineText {
    shape: ShapeText,
    edges: EdgesText,
    holes: Vec<HoleText>,
}

type Place = [f64; 2];

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum ShapeText {
    RectangleM([f64; 2]),
    CircleM(f64),
    StadiumM([f64; 2]),
    PolygonM(Vec<Place>),
    Path(Vec<SideText>),
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum SideText {
    LineM([Place; 2]),
    Arc { centre_m: Place, radius_m: f64, start_rad: f64, sweep_rad: f64 },
    CubicM([Place; 4]),
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum EdgeText {
    Clamped,
    Supported,
    Free,
    Elastic { lift_n_per_m2: f64, tilt_n_per_rad: f64 },
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum EdgesText {
    All(EdgeText),
    PerSide(Vec<EdgeText>),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct HoleText {
    at_m: Place,
    sides: Vec<SideText>,
    edges: EdgesText,
}

pub(crate) fn place(p: Point) -> Place {
    [p.x, p.y]
}

pub(crate) fn point([x, y]: Place) -> Point {
    Point::new(x, y)
}

impl From<&Outline> for OutlineText {
    fn from(outline: &Outline) -> Self {
        let hole = |hole: &Hole| HoleText {
            at_m: place(hole.at),
            sides: hole.sides.iter().map(SideText::from).collect(),
            edges: (&hole.edges).into(),
        };
        let shape = match &outline.shape {
            Shape::Rectangle { width, height } => ShapeText::RectangleM([*width, *height]),
            Shape::Circle { radius } => ShapeText::CircleM(*radius),
            Shape::Stadium { straight, radius } => ShapeText::StadiumM([*straight, *radius]),
            Shape::Polygon(vertices) => ShapeText::PolygonM(vertices.iter().map(|p| place(*p)).collect()),
            Shape::Path(sides) => ShapeText::Path(sides.iter().map(SideText::from).collect()),
        };
        Self { shape, edges: (&outline.edges).into(), holes: outline.holes.iter().map(hole).collect() }
    }
}

impl From<OutlineText> for Outline {
    fn from(text: OutlineText) -> Self {
        let sides = |sides: Vec<SideText>| sides.into_iter().map(Side::from).collect::<Vec<_>>();
        let shape = match text.shape {
            ShapeText::RectangleM([width, height]) => Shape::Rectangle { width, height },
            ShapeText::CircleM(radius) => Shape::Circle { radius },
            ShapeText::StadiumM([straight, radius]) => Shape::Stadium { straight, radius },
            ShapeText::PolygonM(vertices) => Shape::Polygon(vertices.into_iter().map(point).collect()),
            ShapeText::Path(path) => Shape::Path(sides(path)),
        };
        let hole = |hole: HoleText| Hole {
            sides: sides(hole.sides),
            at: point(hole.at_m),
            edges: hole.edges.into(),
        };
        Self { shape, edges: text.edges.into(), holes: text.holes.into_iter().map(hole).collect() }
    }
}

impl From<&Side> for SideText {
    fn from(side: &Side) -> Self {
        match *side {
            Side::Line { from, to } => Self::LineM([place(from), place(to)]),
            Side::Arc { centre, radius, start, sweep } => {
                Self::Arc { centre_m: place(centre), radius_m: radius, start_rad: start, sweep_rad: sweep }
            }
            Side::Cubic(points) => Self::CubicM(points.map(place)),
        }
    }
}

impl From<SideText> for Side {
    fn from(text: SideText) -> Self {
        match text {
            SideText::LineM([from, to]) => Self::Line { from: point(from), to: point(to) },
            SideText::Arc { centre_m, radius_m, start_rad, sweep_rad } => {
                Self::Arc { centre: point(centre_m), radius: radius_m, start: start_rad, sweep: sweep_rad }
            }
            SideText::CubicM(points) => Self::Cubic(points.map(point)),
        }
    }
}

impl From<&Edges> for EdgesText {
    fn from(edges: &Edges) -> Self {
        let edge = |edge: &Edge| match *edge {
            Edge::Clamped => EdgeText::Clamped,
            Edge::Supported => EdgeText::Supported,
            Edge::Free => EdgeText::Free,
            Edge::Elastic { lift, tilt } => EdgeText::Elastic { lift_n_per_m2: lift, tilt_n_per_rad: tilt },
        };
        match edges {
            Edges::All(one) => Self::All(edge(one)),
            Edges::PerSide(list) => Self::PerSide(list.iter().map(edge).collect()),
        }
    }
}

impl From<EdgesText> for Edges {
    fn from(text: EdgesText) -> Self {
        let edge = |text: EdgeText| match text {
            EdgeText::Clamped => Edge::Clamped,
            EdgeText::Supported => Edge::Supported,
            EdgeText::Free => Edge::Free,
            EdgeText::Elastic { lift_n_per_m2: lift, tilt_n_per_rad: tilt } => Edge::Elastic { lift, tilt },
        };
        match text {
            EdgesText::All(one) => Self::All(edge(one)),
            EdgesText::PerSide(list) => Self::PerSide(list.into_iter().map(edge).collect()),
        }
    }
}
