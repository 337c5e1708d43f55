use unripple_core::{Outline, Point, Shape};

/// Step of the coordinates suggested to people, in metres.
const STEP: f64 = 1e-6;

/// The point of the rim nearest to a point outside it, in metres.
pub(super) fn nearest_on_rim(outline: &Outline, p: Point) -> Point {
    match &outline.shape {
        Shape::Rectangle { width, height } => Point::new(p.x.clamp(0.0, *width), p.y.clamp(0.0, *height)),
        Shape::Circle { radius } => towards(Point::new(*radius, *radius), p, *radius),
        Shape::Stadium { straight, radius } => {
            towards(Point::new(p.x.clamp(*radius, radius + straight), *radius), p, *radius)
        }
        Shape::Polygon(vertices) => vertices
            .iter()
            .zip(vertices.iter().cycle().skip(1))
            .map(|(a, b)| nearest_on_side(*a, *b, p))
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            .unwrap_or(p),
    }
}

/// The point `reach` from `from` on the way to `to`.
fn towards(from: Point, to: Point, reach: f64) -> Point {
    let scale = reach / from.distance(to).max(f64::MIN_POSITIVE);
    Point::new(from.x + scale * (to.x - from.x), from.y + scale * (to.y - from.y))
}

fn nearest_on_side(a: Point, b: Point, p: Point) -> Point {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let length = (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
    let share = (((p.x - a.x) * dx + (p.y - a.y) * dy) / length).clamp(0.0, 1.0);
    Point::new(a.x + share * dx, a.y + share * dy)
}

/// A point inside the outline with short coordinates, near a point of its rim, as a file writes it in mm.
pub(super) fn nearest_legal(outline: &Outline, rim: Point) -> Option<String> {
    let around = |v: f64| {
        let base = (v / STEP).floor();
        (-1..=2).map(move |i| base + f64::from(i))
    };
    around(rim.x)
        .flat_map(|x| around(rim.y).map(move |y| (x, y)))
        .map(|(x, y)| (x / 1e3, y / 1e3))
        .map(|(x, y)| (Point::from_mm(x, y), format!("[{}, {}]", x + 0.0, y + 0.0)))
        .filter(|(point, _)| outline.contains(*point))
        .min_by(|(a, _), (b, _)| a.distance(rim).total_cmp(&b.distance(rim)))
        .map(|(_, text)| text)
}
