//! Outlines and holes written in their shortest exact form.

use super::super::edge::EDGES;
use super::super::range::of;
use crate::decimal::text;
use crate::lines::{Lines, list, named, point};
use unripple_core::{Edge, Edges, Hole, Outline, Point, Shape, Side};

pub(super) fn outline(outline: &Outline, out: &mut Lines) {
    out.table("[outline]");
    shape(&outline.shape, out);
    edges(&outline.edges, out);
}

/// A hole by the first of its forms that reads back exactly: a slit, a plain shape, its sides.
pub(super) fn hole(hole: &Hole, out: &mut Lines) {
    out.table("[[hole]]");
    let plain = plain(&hole.sides);
    if let Some((from, to, width)) = slit(hole) {
        out.line("slit_mm", &list([from, to].iter().map(point)));
        out.line("width_mm", &text(width, 3));
    } else if let (Some(Shape::Circle { radius }), Some(centre)) = (&plain, centre(hole, plain.as_ref())) {
        out.line("circle_mm", &text(*radius, 3));
        out.line("centre_mm", &point(&centre));
    } else {
        match plain {
            Some(plain) => shape(&plain, out),
            None => out.line("path_mm", &path(&hole.sides)),
        }
        out.line("at_mm", &point(&hole.at));
    }
    edges(&hole.edges, out);
}

fn shape(shape: &Shape, out: &mut Lines) {
    match shape {
        Shape::Rectangle { width, height } => {
            out.line("rectangle_mm", &point(&Point::new(*width, *height)));
        }
        Shape::Circle { radius } => out.line("circle_mm", &text(*radius, 3)),
        Shape::Stadium { straight, radius } => {
            out.line("stadium_mm", &point(&Point::new(*straight, *radius)));
        }
        Shape::Polygon(vertices) => out.line("polygon_mm", &list(vertices.iter().map(point))),
        Shape::Path(sides) => out.line("path_mm", &path(sides)),
    }
}

fn path(sides: &[Side]) -> String {
    list(sides.iter().map(|side| match side {
        Side::Line { from, to } => list([from, to].into_iter().map(point)),
        Side::Cubic(points) => list(points.iter().map(point)),
        Side::Arc { centre, radius, start, sweep } => format!(
            "{{ centre_mm = {}, radius_mm = {}, start_deg = {}, sweep_deg = {} }}",
            point(centre),
            text(*radius, 3),
            of::DIRECTION.text(*start),
            of::SWEEP.text(*sweep)
        ),
    }))
}

fn edges(edges: &Edges, out: &mut Lines) {
    match edges {
        Edges::All(edge) => out.line("edge", &one(edge)),
        Edges::PerSide(edges) => out.line("edge", &list(edges.iter().map(one))),
    }
}

fn one(edge: &Edge) -> String {
    match edge {
        Edge::Elastic { lift, tilt } => {
            format!("{{ lift_n_per_mm2 = {}, tilt_n = {} }}", text(*lift, -6), text(*tilt, 0))
        }
        named_edge => named(&EDGES, named_edge),
    }
}

/// The shape with exactly these sides, if a file has a shorter word for it than a path.
fn plain(sides: &[Side]) -> Option<Shape> {
    let candidates: Vec<Shape> = match sides {
        [Side::Arc { radius, .. }] => vec![Shape::Circle { radius: *radius }],
        [Side::Line { to: right, .. }, Side::Line { to: top, .. }, Side::Line { .. }, Side::Line { .. }] => {
            vec![Shape::Rectangle { width: right.x, height: top.y }]
        }
        [Side::Line { from, to }, Side::Arc { radius, .. }, ..] => {
            let straight = to.x - from.x;
            let stadium = |straight| Shape::Stadium { straight, radius: *radius };
            vec![stadium(short(straight)), stadium(straight)]
        }
        [Side::Arc { radius, .. }, Side::Arc { .. }] => {
            vec![Shape::Stadium { straight: 0.0, radius: *radius }]
        }
        _ => Vec::new(),
    };
    let polygon = || sides.iter().all(Side::is_straight).then(|| sides.iter().map(|s| s.at(0.0)).collect());
    let candidates = candidates.into_iter().chain(polygon().map(Shape::Polygon));
    candidates.into_iter().find(|shape| is_writable(shape) && shape.sides() == sides)
}

/// Whether the sizes of a hole are within the file's limits.
fn is_writable(shape: &Shape) -> bool {
    let fits = |length: &f64| of::HOLE_LENGTH.allow(length * 1e3);
    match shape {
        Shape::Rectangle { width, height } => fits(width) && fits(height),
        Shape::Circle { radius } | Shape::Stadium { radius, .. } => fits(radius),
        Shape::Polygon(_) | Shape::Path(_) => true,
    }
}

/// The centre that gives a circular hole back exactly, if there is one.
fn centre(hole: &Hole, shape: Option<&Shape>) -> Option<Point> {
    let Some(Shape::Circle { radius }) = shape else { return None };
    let middle = Point::new(hole.at.x + radius, hole.at.y + radius);
    let nearby = [middle, Point::new(short(middle.x), short(middle.y))];
    nearby.into_iter().rev().find(|c| Point::new(c.x - radius, c.y - radius) == hole.at)
}

/// The ends and the width that give a slit back exactly, if it is one.
fn slit(hole: &Hole) -> Option<(Point, Point, f64)> {
    let [
        Side::Line { .. },
        Side::Arc { centre: to, radius, .. },
        Side::Line { .. },
        Side::Arc { centre: from, .. },
    ] = hole.sides.as_slice()
    else {
        return None;
    };
    let back = |p: &Point| Point::new(p.x + hole.at.x, p.y + hole.at.y);
    let rounded = |p: &Point| Point::new(short(back(p).x), short(back(p).y));
    let width = 2.0 * radius;
    let same = |(from, to): &(Point, Point)| {
        let slit = Hole::slit(*from, *to, width);
        slit.sides == hole.sides && slit.at == hole.at
    };
    let ends = [(rounded(from), rounded(to)), (back(from), back(to))].into_iter().find(same)?;
    // The file's limits.
    of::SLIT_WIDTH.allow(width * 1e3).then_some((ends.0, ends.1, width))
}

/// A length rounded to a picometre, as people would have written it.
fn short(metres: f64) -> f64 {
    let rounded = format!("{:.9}", metres * 1e3);
    crate::decimal::scaled(&rounded, -3).unwrap_or(metres)
}
