//! Outlines of equal area, from the most to the least symmetric.

use std::f64::consts::PI;
use unripple_core::{Outline, Point, Shape};

/// Width over height of the rectangle: far enough from 1 that modes do not fall together as those of a square do.
const ASPECT: f64 = 1.5;

/// Vertices of the irregular polygon before it is scaled: no two sides parallel or equal, no symmetry.
const IRREGULAR: [(f64, f64); 6] =
    [(0.0, 0.31), (0.42, 0.0), (1.17, 0.09), (1.33, 0.74), (0.71, 1.12), (0.13, 0.93)];

/// Clamped outlines of equal area (m²), from the most to the least symmetric: square, rectangle, circle, stadium and an
/// irregular polygon. The first three are integrable cavities, whose rays keep to regular paths; in the stadium
/// (Bunimovich 1979) nearly every ray passes through every place in every direction, and the polygon has no symmetry.
///
/// ```
/// let outlines = unripple_paper::study::cavities(0.0225);
/// assert!(outlines.iter().all(|(_, outline)| (outline.area() / 0.0225 - 1.0).abs() < 1e-12));
/// ```
pub fn cavities(area: f64) -> Vec<(&'static str, Outline)> {
    let height = (area / ASPECT).sqrt();
    let radius = (area / (PI + 4.0)).sqrt();
    vec![
        ("square", Outline::new(Shape::Rectangle { width: area.sqrt(), height: area.sqrt() })),
        ("rectangle 3:2", Outline::new(Shape::Rectangle { width: ASPECT * height, height })),
        ("circle", Outline::new(Shape::Circle { radius: (area / PI).sqrt() })),
        ("stadium", Outline::new(Shape::Stadium { straight: 2.0 * radius, radius })),
        ("irregular polygon", irregular(area)),
    ]
}

fn irregular(area: f64) -> Outline {
    let vertices = |scale: f64| IRREGULAR.map(|(x, y)| Point::new(scale * x, scale * y)).to_vec();
    let unit = Outline::new(Shape::Polygon(vertices(1.0))).area();
    Outline::new(Shape::Polygon(vertices((area / unit).sqrt())))
}
