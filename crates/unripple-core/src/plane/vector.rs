//! Vectors in the plane and their products, distances of segments, triangles. Lengths in metres.

use crate::Point;

/// The difference a - b, in metres.
pub fn minus(a: Point, b: Point) -> Point {
    Point::new(a.x - b.x, a.y - b.y)
}

/// The sum a + s·b, in metres: the point `a` moved by `s` times the vector `b`.
pub fn along(a: Point, b: Point, s: f64) -> Point {
    Point::new(a.x + s * b.x, a.y + s * b.y)
}

/// The midpoint of two points, in metres.
pub fn middle(a: Point, b: Point) -> Point {
    Point::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y))
}

/// The scalar product a·b, in m².
pub fn dot(a: Point, b: Point) -> f64 {
    a.x * b.x + a.y * b.y
}

/// The cross product a × b, in m²: positive if `b` points to the left of `a`.
pub fn cross(a: Point, b: Point) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Length of a vector, in metres.
pub fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// A vector rotated anticlockwise by `angle`, in radians.
pub fn turned(a: Point, angle: f64) -> Point {
    let (s, c) = angle.sin_cos();
    Point::new(a.x * c - a.y * s, a.x * s + a.y * c)
}

/// The angle from `a` to `b`, in radians, anticlockwise, -π to π.
pub fn angle(a: Point, b: Point) -> f64 {
    cross(a, b).atan2(dot(a, b))
}

/// Twice the signed area of a triangle, in m², positive anticlockwise.
pub fn doubled(a: Point, b: Point, c: Point) -> f64 {
    cross(minus(b, a), minus(c, a))
}

/// Distance from `p` to the segment from `a` to `b`, in metres.
pub fn from_segment(p: Point, a: Point, b: Point) -> f64 {
    let (ab, ap) = (minus(b, a), minus(p, a));
    let t = (dot(ap, ab) / dot(ab, ab).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    norm(along(ap, ab, -t))
}

/// Distance between two segments, in metres; 0 where they cross.
pub fn between_segments([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    let cross = !apart(doubled(a, b, c), doubled(a, b, d)) && !apart(doubled(c, d, a), doubled(c, d, b));
    let nearest = from_segment(a, c, d)
        .min(from_segment(b, c, d))
        .min(from_segment(c, a, b))
        .min(from_segment(d, a, b));
    // Segments on one line pass the test of sides without meeting.
    let level = doubled(a, b, c) == 0.0 && doubled(a, b, d) == 0.0;
    if cross && !level { 0.0 } else { nearest }
}

/// The circle through three points: its centre and radius, in metres. Not finite if the points lie on a line.
pub fn circumcircle(a: Point, b: Point, c: Point) -> (Point, f64) {
    let (u, v) = (minus(b, a), minus(c, a));
    let (uu, vv, d) = (dot(u, u), dot(v, v), 2.0 * cross(u, v));
    let offset = Point::new((v.y * uu - u.y * vv) / d, (u.x * vv - v.x * uu) / d);
    (along(a, offset, 1.0), norm(offset))
}

/// Cotangent of the smallest angle of a triangle, dimensionless; infinite if its corners run clockwise or it has no area.
pub fn sharpness([a, b, c]: [Point; 3]) -> f64 {
    let (ab, bc, ca) = (minus(b, a), minus(c, b), minus(a, c));
    let area = cross(ab, bc);
    let least = dot(ab, ca).min(dot(bc, ab)).min(dot(ca, bc));
    if area > 0.0 { -least / area } else { f64::INFINITY }
}
