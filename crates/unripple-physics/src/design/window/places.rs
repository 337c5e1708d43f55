//! Targets spread over a surface, and the grid of points on which the field around them is evaluated.

use std::f64::consts::TAU;
use unripple_core::{Outline, Point};

/// Number of targets over which contrast is averaged. With twice this value, the mean varies by √2 less
/// between similar surfaces, and takes longer.
const TARGETS: usize = 96;

/// Number of candidate places tried as targets; a surface with little room away from the rim gets fewer
/// targets. With twice this value, such a surface has up to twice as many.
const TRIES: u32 = 4000;

/// Number of directions in which a target is tested for its distance from the rim: every 22.5°. With twice this value, every 11°, for
/// twice the tests.
const DIRECTIONS: u32 = 16;

/// Number of cells of the grid along a shortest wavelength. The square of a field has half the field's
/// wavelength, so that two would suffice. With twice this value, there are four times the points, and the
/// mean stays the same.
const CELLS: f64 = 3.0;

/// Steps, in x and y, of a sequence of points that fills the plane evenly, without the symmetries of a
/// grid: powers of 1/ρ with ρ³ = ρ + 1 (Roberts 2018).
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Targets on a surface, in metres: at least a shortest wavelength (`wavelength`, m) from the rim, or a
/// quarter of the mean chord on a small surface, and half a wavelength from the `actuators`, near which the
/// field is always strong.
pub fn targets(outline: &Outline, actuators: &[Point], wavelength: f64) -> Vec<Point> {
    let (width, height) = outline.extent();
    // A quarter of the mean chord πS/P is about 0.8 S/P.
    let margin = wavelength.min(0.8 * outline.area() / outline.perimeter());
    let around = |p: Point, i: u32| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(DIRECTIONS)).sin_cos();
        Point::new(p.x + margin * cos, p.y + margin * sin)
    };
    let clear = |p: &Point| {
        outline.contains(*p)
            && (0..DIRECTIONS).all(|i| outline.contains(around(*p, i)))
            && actuators.iter().all(|a| a.distance(*p) >= 0.5 * wavelength)
    };
    let [along, up] = STEPS.map(|step| move |i: u32| (0.5 + f64::from(i) * step).fract());
    (1..=TRIES).map(|i| Point::new(width * along(i), height * up(i))).filter(clear).take(TARGETS).collect()
}

/// Centres, in metres, of the grid cells that lie inside the outline; `wavelength` is the shortest
/// wavelength, in m.
pub fn grid(outline: &Outline, wavelength: f64) -> Vec<Point> {
    let (width, height) = outline.extent();
    let cells = |length: f64| (CELLS * length / wavelength).ceil().max(1.0) as usize;
    let (columns, rows) = (cells(width), cells(height));
    let centre = |i: usize, of: usize| (i as f64 + 0.5) / of as f64;
    (0..rows)
        .flat_map(|j| (0..columns).map(move |i| (i, j)))
        .map(|(i, j)| Point::new(width * centre(i, columns), height * centre(j, rows)))
        .filter(|p| outline.contains(*p))
        .collect()
}
