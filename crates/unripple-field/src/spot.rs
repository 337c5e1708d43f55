//! The focal spot: its size at half the value at the target, and the distance of its maximum from the
//! target.

use std::f64::consts::PI;
use unripple_core::{Outline, Point};

/// Directions in which a spot is measured: opposite pairs make the diameters that are averaged. With twice this value,
/// twice the readouts for a mean that hardly changes.
const DIRECTIONS: usize = 16;

/// Number of steps of the regula falsi (false position), which locate a crossing to well under a thousandth
/// of the wavelength. With twice this value, digits would be computed that no figure shows.
const REFINEMENTS: usize = 3;

/// Where a spot is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around<'a> {
    /// Centre of the spot, in metres.
    pub at: Point,
    /// Outline of the surface, outside which there is no field.
    pub outline: &'a Outline,
    /// Shortest wavelength of the field, in metres.
    pub wavelength: f64,
}

impl Around<'_> {
    fn place(&self, direction: usize, radius: f64) -> Point {
        let (sin, cos) = (2.0 * PI * direction as f64 / DIRECTIONS as f64).sin_cos();
        Point::new(self.at.x + radius * cos, self.at.y + radius * sin)
    }

    /// The largest radius up to `outer` that lies inside the outline, if `inner` does.
    fn within(&self, direction: usize, inner: f64, outer: f64) -> f64 {
        if self.outline.contains(self.place(direction, outer)) {
            return outer;
        }
        let (mut inner, mut outer) = (inner, outer);
        for _ in 0..50 {
            let middle = (inner + outer) / 2.0;
            if self.outline.contains(self.place(direction, middle)) { inner = middle } else { outer = middle }
        }
        inner
    }
}

/// A search for half the level in one direction.
#[derive(Clone, Copy, Debug)]
struct Ray {
    direction: usize,
    /// Radius still above half, and its excess over half.
    inner: (f64, f64),
    /// Radius at or below half, and its (negative) excess, once found.
    outer: Option<(f64, f64)>,
    /// Whether the rim of the surface was reached while the field was still above half.
    lost: bool,
}

/// Size of a focal spot, and its distance from the target. Each is `None` where it is not defined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Spot {
    /// Full width at half maximum, in metres: the mean over diameters.
    pub diameter: Option<f64>,
    /// Area within which the field is above half the value at the target, in square metres.
    pub area: Option<f64>,
    /// Distance from the target to the nearest maximum of the field's magnitude, in metres.
    pub offset: Option<f64>,
}

/// Step sizes of the search for the maximum, relative to the wavelength: the first is smaller than a spot,
/// and the last well below what a figure shows.
const STEPS: [f64; 8] = [0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005];

/// Largest number of moves at each step size of the search for the maximum: enough to cross a spot.
const MOVES: usize = 8;

/// The focal spot of a field around a point: the mean over eight diameters, and the area within sixteen radii.
///
/// In sixteen directions, from the point outwards, the first crossing of half the value at the point is bracketed in steps
/// of λ_min/12 (or a tenth of the radius, if that is more) and then refined on the field itself. Diameters with an end that
/// never falls to half are left out, and so is the area if there is such an end.
pub(crate) fn spot(around: &Around<'_>, field: impl Fn(&[Point]) -> Vec<f64>) -> Spot {
    let Some(top) = field(&[around.at]).first().copied().filter(|top| *top != 0.0) else {
        return Spot::default();
    };
    let radii = radii(around, top, &field);
    let (near, far) = radii.split_at(DIRECTIONS / 2);
    let widths: Vec<f64> = near.iter().zip(far).filter_map(|(a, b)| Some((*a)? + (*b)?)).collect();
    let squares: Option<Vec<f64>> = radii.iter().map(|radius| radius.map(|r| r * r)).collect();
    Spot {
        diameter: (!widths.is_empty()).then(|| widths.iter().sum::<f64>() / widths.len() as f64),
        // ½ ∫ r² dφ by the trapezoidal rule, which converges fast for a smooth closed curve.
        area: squares.map(|squares| PI * squares.iter().sum::<f64>() / DIRECTIONS as f64),
        offset: Some(summit(around, top, &field).distance(around.at)),
    }
}

/// The maximum of the field's magnitude that is reached uphill from the point, by a compass search.
fn summit(around: &Around<'_>, top: f64, field: impl Fn(&[Point]) -> Vec<f64>) -> Point {
    let (mut at, mut height) = (around.at, top.abs());
    for step in STEPS.map(|step| step * around.wavelength) {
        for _ in 0..MOVES {
            let from = Around { at, ..*around };
            let directions = (0..DIRECTIONS).step_by(2);
            let places = directions.map(|direction| from.place(direction, step));
            let places: Vec<Point> = places.filter(|place| around.outline.contains(*place)).collect();
            let heights = field(&places).into_iter().map(f64::abs);
            let best = places.iter().zip(heights).max_by(|a, b| a.1.total_cmp(&b.1));
            match best {
                Some((place, found)) if found > height => (at, height) = (*place, found),
                _ => break,
            }
        }
    }
    at
}

/// Distance in each direction at which the field falls to half its value `top` at the point; nothing where it does not.
fn radii(around: &Around<'_>, top: f64, field: impl Fn(&[Point]) -> Vec<f64>) -> Vec<Option<f64>> {
    let excess = |value: f64| value / top - 0.5;
    let start = |direction| Ray { direction, inner: (0.0, 0.5), outer: None, lost: false };
    let mut rays: Vec<Ray> = (0..DIRECTIONS).map(start).collect();
    let mut radius = 0.0;
    while rays.iter().any(|ray| ray.outer.is_none() && !ray.lost) {
        radius += f64::max(around.wavelength / 12.0, radius / 10.0);
        let mut open: Vec<&mut Ray> =
            rays.iter_mut().filter(|ray| ray.outer.is_none() && !ray.lost).collect();
        let reach: Vec<f64> =
            open.iter().map(|ray| around.within(ray.direction, ray.inner.0, radius)).collect();
        let places: Vec<Point> =
            open.iter().zip(&reach).map(|(ray, r)| around.place(ray.direction, *r)).collect();
        for ((ray, reached), value) in open.iter_mut().zip(reach).zip(field(&places)) {
            let end = (reached, excess(value));
            match end.1 > 0.0 {
                true => (ray.inner, ray.lost) = (end, reached < radius),
                false => ray.outer = Some(end),
            }
        }
    }
    for _ in 0..REFINEMENTS {
        let mut found: Vec<&mut Ray> = rays.iter_mut().filter(|ray| ray.outer.is_some()).collect();
        let radii: Vec<f64> = found.iter().filter_map(|ray| crossing(ray)).collect();
        let places: Vec<Point> =
            found.iter().zip(&radii).map(|(ray, r)| around.place(ray.direction, *r)).collect();
        for ((ray, r), value) in found.iter_mut().zip(radii).zip(field(&places)) {
            let end = (r, excess(value));
            if end.1 > 0.0 { ray.inner = end } else { ray.outer = Some(end) }
        }
    }
    rays.iter().map(crossing).collect()
}

/// Radius at which the straight line between the ends of a bracket crosses half the value.
fn crossing(ray: &Ray) -> Option<f64> {
    let outer = ray.outer?;
    Some(ray.inner.0 + (outer.0 - ray.inner.0) * ray.inner.1 / (ray.inner.1 - outer.1))
}

/// Full width at half maximum around a point from values at scattered points, in metres.
///
/// `values` are (distance, value over the value at the point), distances ascending. The round profile
/// 1 − a r² + b r⁴ is fitted by least squares within ever larger radii until half its height is crossed within nine
/// tenths of one that holds at least six points; `None` if that never happens.
pub(crate) fn fitted_diameter(values: &[(f64, f64)], wavelength: f64) -> Option<f64> {
    [0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0].iter().find_map(|waves| {
        let radius = waves * wavelength;
        let near = &values[..values.partition_point(|(r, _)| *r <= radius)];
        if near.len() < 6 {
            return None;
        }
        // In units of the radius the two powers are of like size.
        let sum =
            |term: fn(f64, f64) -> f64| near.iter().map(|(r, y)| term((r / radius).powi(2), *y)).sum::<f64>();
        let (aa, ab, bb) = (sum(|s, _| s * s), sum(|s, _| s * s * s), sum(|s, _| s.powi(4)));
        let (ay, by) = (sum(|s, y| s * (1.0 - y)), sum(|s, y| s * s * (1.0 - y)));
        let determinant = aa * bb - ab * ab;
        // Distances too much alike do not tell r² from r⁴.
        if determinant <= 1e-12 * aa * bb {
            return None;
        }
        let (a, b) = ((ay * bb - by * ab) / determinant, (ay * ab - by * aa) / determinant);
        let root = (a * a - 2.0 * b).max(0.0).sqrt();
        let square = 1.0 / (a + root);
        // The crossing lies within nine tenths of the radius: 0.9² = 0.81.
        let crosses = a > 0.0 && a * a >= 2.0 * b && square > 0.0 && square <= 0.81;
        crosses.then(|| 2.0 * square.sqrt() * radius)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Shape;

    fn sheet() -> Outline {
        Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 })
    }

    #[test]
    fn ellipses_give_the_mean_of_their_diameters() {
        let outline = sheet();
        let at = Point::new(0.06, 0.09);
        for (a, b) in [(5e-3, 5e-3), (4e-3, 7e-3), (30e-3, 30e-3)] {
            let around = Around { at, outline: &outline, wavelength: 14.55e-3 };
            let field = |points: &[Point]| {
                let value =
                    |p: &Point| -3.0 * (-((p.x - at.x) / a).powi(2) - ((p.y - at.y) / b).powi(2)).exp();
                points.iter().map(value).collect()
            };
            let exact = (0..8).map(|i| {
                let (sin, cos) = (PI * f64::from(i) / 8.0).sin_cos();
                2.0 * 2f64.ln().sqrt() / ((cos / a).powi(2) + (sin / b).powi(2)).sqrt()
            });
            let exact = exact.sum::<f64>() / 8.0;
            let found = spot(&around, field);
            let diameter = found.diameter.unwrap();
            assert!((diameter / exact - 1.0).abs() < 1e-3, "{a} {b}: {diameter} {exact}");
            // The ellipse at half height has the area π a b ln 2.
            let area = PI * a * b * 2f64.ln();
            assert!((found.area.unwrap() / area - 1.0).abs() < 0.01, "{a} {b}: {found:?} {area}");
            assert!(found.offset.unwrap() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn the_summit_is_found_where_it_is() {
        let outline = sheet();
        let (at, top) = (Point::new(0.06, 0.09), Point::new(0.0613, 0.0892));
        let around = Around { at, outline: &outline, wavelength: 14.55e-3 };
        let field =
            |points: &[Point]| points.iter().map(|p| (-(p.distance(top) / 5e-3).powi(2)).exp()).collect();
        let found = spot(&around, field).offset.unwrap();
        assert!((found - at.distance(top)).abs() < 2e-5, "{found}");
    }

    #[test]
    fn a_held_rim_ends_the_spot_and_a_free_one_may_not() {
        let outline = sheet();
        let around = Around { at: Point::new(0.01, 0.075), outline: &outline, wavelength: 14.55e-3 };
        let tent = |points: &[Point]| points.iter().map(|p| p.x.min(0.02 - p.x)).collect::<Vec<f64>>();
        assert!(spot(&around, tent).diameter.unwrap() > 0.01);
        let flat = spot(&around, |points| vec![1.0; points.len()]);
        assert_eq!((flat.diameter, flat.area), (None, None));
        assert_eq!(spot(&around, |points| vec![0.0; points.len()]), Spot::default());
    }

    #[test]
    fn scattered_points_give_the_width_of_a_bell() {
        let bell = |r: f64| (-(r / 7e-3).powi(2)).exp();
        let mut values: Vec<(f64, f64)> = (0..400)
            .map(|i| (f64::from(i % 20 - 10) * 3.6e-3 + 1e-3).hypot(f64::from(i / 20 - 10) * 3.6e-3))
            .map(|r| (r, bell(r)))
            .collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let exact = 2.0 * 7e-3 * 2f64.ln().sqrt();
        let found = fitted_diameter(&values, 14.55e-3).unwrap();
        assert!((found / exact - 1.0).abs() < 0.05, "{found} {exact}");
        assert_eq!(fitted_diameter(&[], 14.55e-3), None);
        let flat: Vec<_> = values.iter().map(|(r, _)| (*r, 1.0)).collect();
        assert_eq!(fitted_diameter(&flat, 14.55e-3), None);
    }
}
