//! Diameter of the focal spot: full width at half maximum.

use std::f64::consts::PI;
use unripple_core::{Outline, Point};

/// Directions in which a spot is measured: opposite pairs make the diameters that are averaged. Doubled,
/// twice the readouts for a mean that hardly changes.
const DIRECTIONS: usize = 16;

/// Steps of the regula falsi that bring a crossing to well under a thousandth of the wavelength. Doubled,
/// digits that no figure shows.
const REFINEMENTS: usize = 3;

/// Where a spot is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around<'a> {
    /// Its middle, in metres.
    pub at: Point,
    /// The region that holds the field.
    pub outline: &'a Outline,
    /// Shortest wavelength of the field, in metres.
    pub wavelength: f64,
}

impl Around<'_> {
    fn place(&self, direction: usize, radius: f64) -> Point {
        let (sin, cos) = (2.0 * PI * direction as f64 / DIRECTIONS as f64).sin_cos();
        Point::new(self.at.x + radius * cos, self.at.y + radius * sin)
    }

    /// The largest radius up to `outer` that is inside, if `inner` is.
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
    /// Whether the rim was reached above half.
    lost: bool,
}

/// Full width at half maximum of a field around a point, in metres: the mean over eight diameters.
///
/// In sixteen directions, from the point outwards, the first crossing of half the value at the point is bracketed in steps
/// of λ_min/12 (or a tenth of the radius, if that is more) and then refined on the field itself. Diameters with an end that
/// never falls to half are left out; `None` if there is none left.
pub(crate) fn diameter(around: &Around<'_>, field: impl Fn(&[Point]) -> Vec<f64>) -> Option<f64> {
    let top = field(&[around.at]).first().copied().filter(|top| *top != 0.0)?;
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
    let (near, far) = rays.split_at(DIRECTIONS / 2);
    let widths: Vec<f64> =
        near.iter().zip(far).filter_map(|(a, b)| Some(crossing(a)? + crossing(b)?)).collect();
    (!widths.is_empty()).then(|| widths.iter().sum::<f64>() / widths.len() as f64)
}

/// Where the straight line between the ends of a bracket crosses half.
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
            let found = diameter(&around, field).unwrap();
            assert!((found / exact - 1.0).abs() < 1e-3, "{a} {b}: {found} {exact}");
        }
    }

    #[test]
    fn a_held_rim_ends_the_spot_and_a_free_one_may_not() {
        let outline = sheet();
        let around = Around { at: Point::new(0.01, 0.075), outline: &outline, wavelength: 14.55e-3 };
        let tent = |points: &[Point]| points.iter().map(|p| p.x.min(0.02 - p.x)).collect::<Vec<f64>>();
        assert!(diameter(&around, tent).unwrap() > 0.01);
        assert_eq!(diameter(&around, |points| vec![1.0; points.len()]), None);
        assert_eq!(diameter(&around, |points| vec![0.0; points.len()]), None);
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
