//! Reduced coordinates (component-mode synthesis): low modes are kept, high ones condensed to the combinations that the loads
//! excite.

use super::basis::Shape;
use super::span::Span;
use unripple_linalg::{Mat, MatRef, product};

/// Number of times that the loads' combinations of high modes are divided by their squared frequencies: each adds a
/// fourth power of (ω/ω_m) to the order. With twice this value, twice as many coordinates are kept.
const DEPTH: usize = 4;

/// A combination is left out if less than this share of it is linearly independent of the others: the rest would be
/// rounding. Larger, combinations that matter would be lost.
const OLD: f64 = 1e-9;

/// The coordinates that couple to the loads: single modes up to some frequency, combinations of modes above.
#[derive(Debug)]
pub(super) struct Active {
    /// Modes x coordinates, the columns orthonormal.
    pub map: Mat<f64>,
    /// Stiffness over mass, coordinates x coordinates, in 1/s².
    pub stiffness: Mat<f64>,
    /// Damping 2Σ, coordinates x coordinates, in 1/s.
    pub damping: Mat<f64>,
    /// Weights of the loads' footprints, loads x coordinates.
    pub felt: Mat<f64>,
}

impl Active {
    /// The coordinates for shapes; those above the angular frequency `dynamic` (rad/s) only in the combinations that the loads
    /// excite. `felt` holds the weights of the loads' footprints, loads x modes.
    pub fn of(shapes: &[Shape], felt: MatRef<'_, f64>, dynamic: f64) -> Self {
        let (low, high): (Vec<&Shape>, Vec<&Shape>) = shapes.iter().partition(|s| s.pole.omega <= dynamic);
        let vectors = moved(&high, felt);
        let count = low.len() + vectors.len();
        let mut map = Mat::zeros(felt.ncols(), count);
        let (mut stiffness, mut damping) = (Mat::zeros(count, count), Mat::zeros(count, count));
        for (i, shape) in low.iter().enumerate() {
            shape.parts.iter().for_each(|(mode, part)| map[(*mode, i)] = *part);
            stiffness[(i, i)] = shape.pole.omega * shape.pole.omega;
            damping[(i, i)] = 2.0 * shape.pole.sigma;
        }
        for (i, a) in vectors.iter().enumerate() {
            for (shape, part) in high.iter().zip(a) {
                shape.parts.iter().for_each(|(mode, p)| map[(*mode, low.len() + i)] += p * part);
            }
            for (j, b) in vectors.iter().enumerate() {
                let sum = |f: fn(&Shape) -> f64| -> f64 {
                    high.iter().zip(a.iter().zip(b)).map(|(shape, (x, y))| f(shape) * x * y).sum()
                };
                stiffness[(low.len() + i, low.len() + j)] = sum(|s| s.pole.omega * s.pole.omega);
                damping[(low.len() + i, low.len() + j)] = sum(|s| 2.0 * s.pole.sigma);
            }
        }
        let felt = product(felt, map.as_ref());
        Self { map, stiffness, damping, felt }
    }
}

/// Orthonormal combinations of high shapes that span Ω^{-2k} Wᵀ for k = 1 … DEPTH; all shapes if there are no more of them.
fn moved(high: &[&Shape], felt: MatRef<'_, f64>) -> Vec<Vec<f64>> {
    if high.len() <= DEPTH * felt.nrows() {
        let unit = |i: usize| (0..high.len()).map(|j| f64::from(u8::from(i == j))).collect();
        return (0..high.len()).map(unit).collect();
    }
    let lowest = high.iter().map(|s| s.pole.omega).fold(f64::INFINITY, f64::min);
    let softened = |vector: &[f64]| -> Vec<f64> {
        vector.iter().zip(high).map(|(v, shape)| v * (lowest / shape.pole.omega).powi(2)).collect()
    };
    let mut span = Span::default();
    let mut block: Vec<Vec<f64>> = (0..felt.nrows())
        .map(|load| high.iter().map(|shape| shape.weight(felt.row(load))).collect())
        .collect();
    for _ in 0..DEPTH {
        let before = span.vectors.len();
        block.iter().for_each(|vector| {
            span.add(softened(vector), OLD);
        });
        block = span.vectors[before..].to_vec();
    }
    span.vectors
}
