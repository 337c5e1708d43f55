//! Quadrature over an outline, for the integrals of energies.

use unripple_core::{Outline, Point, Shape};
use unripple_physics::Footprint;

/// Quadrature points along a side: `DENSE` for each radian of phase over half the side, and `MORE`, so that the error is near rounding.
const DENSE: f64 = 0.6;
const MORE: f64 = 12.0;

/// Number of parts into which a cell is divided along each side, to count the share of it inside the
/// outline.
const PARTS: usize = 4;

/// Points and weights (m²) of an integral over an outline of functions with wavenumbers up to `k` (rad/m).
///
/// Gauss-Legendre quadrature on whole rectangles, to about rounding; elsewhere cells of a tenth of a wavelength, weighted by the share of
/// each that lies inside.
pub(super) fn over(outline: &Outline, k: f64) -> Vec<(Point, f64)> {
    match outline.shape {
        Shape::Rectangle { width, height } if outline.holes.is_empty() => {
            let nodes = |side: f64| (DENSE * k * side / 2.0 + MORE) as usize;
            let origin = Point::new(0.0, 0.0);
            let along = Footprint::line(origin, Point::new(width, 0.0), nodes(width)).points;
            let up = Footprint::line(origin, Point::new(0.0, height), nodes(height)).points;
            let row = |(y, wy): &(Point, f64)| {
                let (y, wy) = (y.y, wy * width * height);
                along.iter().map(move |(x, wx)| (Point::new(x.x, y), wx * wy)).collect::<Vec<_>>()
            };
            up.iter().flat_map(row).collect()
        }
        _ => cells(outline, k),
    }
}

fn cells(outline: &Outline, k: f64) -> Vec<(Point, f64)> {
    let (width, height) = outline.extent();
    let count = |side: f64| (10.0 * side * k / std::f64::consts::TAU).ceil().max(8.0);
    let (columns, rows) = (count(width), count(height));
    let (dx, dy) = (width / columns, height / rows);
    let mut points = Vec::new();
    for cell in 0..(columns * rows) as usize {
        let (i, j) = ((cell % columns as usize) as f64, (cell / columns as usize) as f64);
        let part = |n: usize| (n as f64 + 0.5) / PARTS as f64;
        let inside: Vec<Point> = (0..PARTS * PARTS)
            .map(|n| Point::new((i + part(n % PARTS)) * dx, (j + part(n / PARTS)) * dy))
            .filter(|p| outline.contains(*p))
            .collect();
        if !inside.is_empty() {
            let share = inside.len() as f64;
            let mean = |f: fn(&Point) -> f64| inside.iter().map(f).sum::<f64>() / share;
            points.push((Point::new(mean(|p| p.x), mean(|p| p.y)), share / (PARTS * PARTS) as f64 * dx * dy));
        }
    }
    points
}
