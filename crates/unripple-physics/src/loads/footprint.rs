//! Contact shapes as quadrature points and weights: point, disc, rectangle, rims.

use std::f64::consts::{PI, TAU};
use unripple_core::{Outline, Point, Shapes};

/// Number of radii in the quadrature over a disc: Gauss points in r². With twice this value, it would be exact to degree 19, for
/// twice the points.
const RADII: usize = 5;
/// Number of points on each radius, staggered from one radius to the next. With twice this value, there are twice the points, exact for
/// shorter waves.
const DIRECTIONS: usize = 16;

/// Number of rings, up to the rim of a disc, from which the slope at the rim is computed. More rings are
/// exact for shorter waves, with points in proportion.
const RINGS: usize = 9;
/// Number of points on each ring: enough for an exact mean around the ring for waves up to about k·radius
/// = 8.
const RAYS: usize = 24;

/// Number of Gauss points along a side of a rectangle. With twice this value, waves half as long are integrated as exactly.
const ACROSS: usize = 10;

/// Largest number of values of mode shapes that are read at once: a GiB of them. With twice this value,
/// twice the memory, and fewer evaluations for thousands of footprints; results stay the same but for
/// rounding.
const AT_ONCE: usize = 1 << 27;

/// A contact area on the sheet as quadrature points with weights. A force F over it excites mode m with the modal force
/// `F Σ_i weight_i φ_m(x_i)`; the motion sensed there is the same weighted sum of the sheet's motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    /// Points on the sheet (m) and their weights; the weights of a contact of uniform pressure sum to 1.
    pub points: Vec<(Point, f64)>,
}

impl Footprint {
    /// A contact at a single point (m), with weight 1.
    pub fn point(at: Point) -> Self {
        Self { points: vec![(at, 1.0)] }
    }

    /// A contact of uniform pressure over a disc of some radius (m). A part of the disc beyond the rim of
    /// the sheet carries no pressure.
    ///
    /// Exact for mode shapes that are polynomials of degree 9 in x and y; for waves with k·radius up to 5 the error is below 1e-6.
    pub fn disc(at: Point, radius: f64, outline: &Outline) -> Self {
        if radius <= 0.0 {
            return Self::point(at);
        }
        let around = |(share, weight): (f64, f64)| {
            (0..DIRECTIONS).map(move |i| {
                let (angle, r) = (TAU * (i as f64 + 0.5 * share) / DIRECTIONS as f64, radius * share.sqrt());
                (Point::new(at.x + r * angle.cos(), at.y + r * angle.sin()), weight / DIRECTIONS as f64)
            })
        };
        let mut points: Vec<(Point, f64)> = unripple_plates::gauss(RADII)
            .into_iter()
            .map(|(x, w)| (0.5 * (1.0 + x), 0.5 * w))
            .flat_map(around)
            .filter(|(p, _)| outline.contains(*p))
            .collect();
        let whole: f64 = points.iter().map(|(_, w)| w).sum();
        if whole <= 0.0 {
            return Self::point(at);
        }
        points.iter_mut().for_each(|(_, w)| *w /= whole);
        Self { points }
    }

    /// A contact of uniform pressure along a straight line between two points (m), of no width.
    ///
    /// By Gauss-Legendre quadrature with `count` points: exact for polynomials of degree 2·`count` - 1 along the line.
    pub fn line(from: Point, to: Point, count: usize) -> Self {
        let along = |(x, w): (f64, f64)| {
            let t = 0.5 * (1.0 + x);
            (Point::new(from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)), 0.5 * w)
        };
        Self { points: unripple_plates::gauss(count.max(1)).into_iter().map(along).collect() }
    }

    /// A footprint that reads the outward slope integrated along the rim of a disc of some radius (m), ∮
    /// ∂u/∂n ds = ∫ ∇²u dA: the motion that a round piezo patch drives and senses. The weights are
    /// dimensionless and sum to 0.
    ///
    /// The mean of u around a circle of radius r is an even function of r. It is taken on rings inside the disc, so that no points
    /// beyond the rim are needed; the slope at the rim is that of the polynomial in r² through these means. For plane waves of
    /// wavenumber k, for which the integral is -2πk·radius J_1(k·radius), the error is below 1e-9 of 2πk·radius up to
    /// k·radius = 3, and below 1e-5 up to 8.
    pub fn rim_slope(at: Point, radius: f64) -> Self {
        let squares = lobatto_squares();
        let slopes = slopes_at_end(&squares);
        let ring = |(square, slope): (&f64, f64)| {
            // ∮ ∂u/∂n ds = 2π·radius · dū/dr, and dū/dr = 2/radius · dū/d(r²/radius²) there.
            let (r, weight) = (radius * square.sqrt(), 4.0 * PI * slope);
            let rays = if r > 0.0 { RAYS } else { 1 };
            (0..rays).map(move |i| {
                let angle = TAU * i as f64 / rays as f64;
                (Point::new(at.x + r * angle.cos(), at.y + r * angle.sin()), weight / rays as f64)
            })
        };
        Self { points: squares.iter().zip(slopes).flat_map(ring).collect() }
    }

    /// A contact of uniform pressure over a rectangle of some width and height (m), turned by an angle
    /// (radians, anticlockwise) about its centre. The whole rectangle must lie on the sheet.
    ///
    /// By Gauss quadrature, exact for polynomials of degree 19 along each side; for waves with k·side up to 16 the error is below 1e-5.
    pub fn rectangle(at: Point, [width, height]: [f64; 2], angle: f64) -> Self {
        let nodes = unripple_plates::gauss(ACROSS);
        let row = |(y, v): &(f64, f64)| {
            let (y, v) = (*y, *v);
            nodes
                .iter()
                .map(move |(x, w)| (turned(at, [0.5 * width * x, 0.5 * height * y], angle), 0.25 * v * w))
        };
        Self { points: nodes.iter().flat_map(row).collect() }
    }

    /// A footprint that reads the outward slope integrated along the rim of a rectangle, ∮ ∂u/∂n ds = ∫ ∇²u
    /// dA: the motion that a rectangular piezo patch drives and senses. Width, height and angle as for
    /// [`rectangle`](Self::rectangle). The weights are dimensionless and sum to 0.
    ///
    /// Across each pair of opposite sides, the sum of both outward slopes is that of the even part of u, taken from a polynomial in
    /// the squared distance from the middle as in [`rim_slope`](Self::rim_slope); along them by Gauss quadrature. For plane waves of
    /// wavenumber k, whose ∇²u is -k² u, the error is below 1e-5 of k²·area up to k·side = 16.
    pub fn rectangle_slope(at: Point, sides: [f64; 2], angle: f64) -> Self {
        let squares = lobatto_squares();
        let slopes = slopes_at_end(&squares);
        let along = unripple_plates::gauss(ACROSS);
        let mut points = Vec::new();
        for axis in [0, 1] {
            let (half, length) = (0.5 * sides[axis], sides[1 - axis]);
            for (square, slope) in squares.iter().zip(&slopes) {
                // Both slopes together are 2 dū/dx at the end, and dū/dx = 2/half · dū/d(x²/half²) there.
                let (x, weight) = (half * square.sqrt(), 4.0 / half * slope);
                let ends: &[f64] = if x > 0.0 { &[-1.0, 1.0] } else { &[0.0] };
                for (y, w) in &along {
                    let weight = 0.5 * length * w * weight / ends.len() as f64;
                    for end in ends {
                        let mut place = [0.0; 2];
                        (place[axis], place[1 - axis]) = (end * x, 0.5 * length * y);
                        points.push((turned(at, place, angle), weight));
                    }
                }
            }
        }
        Self { points }
    }

    /// Mode shapes averaged over the contact: `Σ_i weight_i φ_m(x_i)`, one weight per mode, in 1/√kg.
    pub fn weights(&self, shapes: &dyn Shapes) -> Vec<f64> {
        Self::all_weights(std::slice::from_ref(self), shapes).row(0).iter().copied().collect()
    }

    /// The weights of several footprints as in [`Footprint::weights`], footprints x modes, with as few evaluations of the shapes as
    /// memory allows: mostly one.
    pub fn all_weights(footprints: &[Self], shapes: &dyn Shapes) -> unripple_linalg::Mat<f64> {
        let mut weights = unripple_linalg::Mat::zeros(footprints.len(), shapes.modes());
        let mut row = 0;
        while row < footprints.len() {
            let group = together(&footprints[row..], AT_ONCE / shapes.modes().max(1));
            let places: Vec<Point> = group.iter().flat_map(|f| f.points.iter().map(|(p, _)| *p)).collect();
            let values = shapes.at_all(&places);
            let mut first = 0;
            for footprint in group {
                for m in 0..shapes.modes() {
                    weights[(row, m)] = match footprint.points[..] {
                        [(_, 1.0)] => values[(first, m)],
                        _ => footprint
                            .points
                            .iter()
                            .enumerate()
                            .map(|(i, (_, w))| w * values[(first + i, m)])
                            .sum(),
                    };
                }
                first += footprint.points.len();
                row += 1;
            }
        }
        weights
    }
}

/// The longest list of footprints from the start of `footprints` that have at most `most` points together,
/// but at least one footprint.
fn together(footprints: &[Footprint], most: usize) -> &[Footprint] {
    let mut points = 0;
    let fit = footprints.iter().take_while(|footprint| {
        points += footprint.points.len();
        points <= most
    });
    &footprints[..fit.count().max(1)]
}

/// Chebyshev nodes of (r/radius)² from 0 to 1, including both ends.
fn lobatto_squares() -> Vec<f64> {
    (0..=RINGS).map(|i| 0.5 * (1.0 - (PI * i as f64 / RINGS as f64).cos())).collect()
}

/// The point with coordinates (m) relative to a centre in axes turned by an angle (radians, anticlockwise).
fn turned(centre: Point, [x, y]: [f64; 2], angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    Point::new(centre.x + x * cos - y * sin, centre.y + x * sin + y * cos)
}

/// Weights of the values at `nodes` from 0 to 1 that give the slope, at the last node 1, of the polynomial
/// through these values.
fn slopes_at_end(nodes: &[f64]) -> Vec<f64> {
    let last = nodes.len() - 1;
    let others = |i: usize| (0..nodes.len()).filter(move |j| *j != i);
    let slope = |i: usize| -> f64 {
        if i == last {
            return others(last).map(|j| 1.0 / (nodes[last] - nodes[j])).sum();
        }
        let product: f64 = others(i)
            .filter(|j| *j != last)
            .map(|j| (nodes[last] - nodes[j]) / (nodes[i] - nodes[j]))
            .product();
        product / (nodes[i] - nodes[last])
    };
    (0..nodes.len()).map(slope).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Shape;

    /// Bessel's J_0 and J_1, by their power series.
    fn bessel(x: f64) -> (f64, f64) {
        let quarter = -x * x / 4.0;
        let (mut zero, mut one, mut term) = (0.0, 0.0, 1.0);
        for n in 0..60 {
            let n = f64::from(n);
            zero += term;
            one += term * x / 2.0 / (n + 1.0);
            term *= quarter / ((n + 1.0) * (n + 1.0));
        }
        (zero, one)
    }

    fn felt(footprint: &Footprint, k: f64, direction: f64) -> f64 {
        let wave = |p: &Point| (k * (p.x * direction.cos() + p.y * direction.sin())).cos();
        footprint.points.iter().map(|(p, w)| w * wave(p)).sum()
    }

    #[test]
    fn a_rim_feels_the_slope_of_waves() {
        for (x, tolerance) in [(0.1, 1e-9), (1.0, 1e-9), (3.0, 1e-9), (8.0, 1e-5)] {
            for direction in [0.0f64, 0.3, 1.1] {
                let footprint = Footprint::rim_slope(Point::new(0.0, 0.0), 0.01);
                let exact = -TAU * x * bessel(x).1;
                let error = (felt(&footprint, x / 0.01, direction) - exact).abs();
                assert!(error < tolerance * TAU * x, "{x} {direction}: {error:e}");
            }
        }
    }

    #[test]
    fn a_rectangle_feels_the_mean_and_the_curvature_of_waves() {
        let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
        let (sides, area) = ([0.02, 0.012], 0.02 * 0.012);
        for (x, tolerance) in [(0.1, 1e-9), (3.0, 1e-9), (8.0, 1e-8), (16.0, 1e-5)] {
            let k = x / 0.02;
            for (direction, angle) in [(0.0f64, 0.0), (0.3, 0.0), (1.1, 0.7), (1.1, -2.0), (1.6, 0.0)] {
                let at = Point::new(0.0, 0.0);
                let (along, across) = ((direction - angle).cos(), (direction - angle).sin());
                let mean = sinc(0.5 * k * along * sides[0]) * sinc(0.5 * k * across * sides[1]);
                let error = (felt(&Footprint::rectangle(at, sides, angle), k, direction) - mean).abs();
                assert!(error < tolerance, "mean: {x} {direction} {angle}: {error:e}");
                let exact = -k * k * area * mean;
                let error = (felt(&Footprint::rectangle_slope(at, sides, angle), k, direction) - exact).abs();
                assert!(error < tolerance * k * k * area, "slope: {x} {direction} {angle}: {error:e}");
            }
        }
    }

    #[test]
    fn a_disc_feels_the_mean_of_waves() {
        let outline = Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 });
        let footprint = Footprint::disc(Point::new(0.05, 0.05), 0.01, &outline);
        for x in [0.1, 1.0, 3.0, 5.0] {
            for direction in [0.0f64, 0.3, 1.1] {
                let middle = 0.05 * (direction.cos() + direction.sin()) * x / 0.01;
                let exact = 2.0 * bessel(x).1 / x * middle.cos();
                assert!((felt(&footprint, x / 0.01, direction) - exact).abs() < 1e-6, "{x} {direction}");
            }
        }
    }

    #[test]
    fn contacts_sum_to_one_and_slopes_to_none() {
        let outline = Outline::new(Shape::Circle { radius: 0.05 });
        let sum = |f: &Footprint| f.points.iter().map(|(_, w)| w).sum::<f64>();
        let at = Point::new(0.03, 0.05);
        for contact in [
            Footprint::point(at),
            Footprint::disc(at, 0.01, &outline),
            Footprint::disc(Point::new(0.002, 0.05), 0.01, &outline),
            Footprint::line(at, Point::new(0.06, 0.07), 5),
            Footprint::rectangle(at, [0.01, 0.02], 0.4),
        ] {
            assert!((sum(&contact) - 1.0).abs() < 1e-12);
            assert!(contact.points.iter().all(|(p, _)| outline.contains(*p)));
        }
        assert!(sum(&Footprint::rim_slope(at, 0.01)).abs() < 1e-10);
        assert!(sum(&Footprint::rectangle_slope(at, [0.01, 0.02], 0.4)).abs() < 1e-10);
    }
}
