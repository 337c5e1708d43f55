//! Reduced coordinates (component-mode synthesis): low modes are kept, high modes are condensed to the
//! combinations that the loads excite.

use super::basis::Shape;
use super::span::Span;
use unripple_linalg::{Mat, MatRef, product};

/// Number of times that the combinations of high modes excited by the loads are divided by the modes'
/// squared frequencies: each time adds a fourth power of (ω/ω_m) to the order of accuracy. With twice this
/// value, twice as many coordinates are kept.
const DEPTH: usize = 4;

/// Number of combinations of high modes that so many loads excite, at most.
pub(crate) fn coordinates_of_loads(loads: usize) -> usize {
    DEPTH * loads
}

/// Least share of a combination that must be linearly independent of the others for it to be kept: with
/// less, what is independent is only rounding error. Larger, combinations that matter would be lost.
const OLD: f64 = 1e-9;

/// The coordinates of the sheet that couple to the loads: single modes up to a limiting frequency,
/// combinations of modes above it.
#[derive(Debug)]
pub(super) struct Active {
    /// Number of single modes, which are the first coordinates; the others are combinations.
    pub single: usize,
    /// Coefficients of the modes in each coordinate, modes x coordinates, with orthonormal columns.
    pub map: Mat<f64>,
    /// Stiffness over mass, coordinates x coordinates, in 1/s².
    pub stiffness: Mat<f64>,
    /// Damping 2Σ, coordinates x coordinates, in 1/s.
    pub damping: Mat<f64>,
    /// Mode shapes averaged over the loads' footprints, loads x coordinates.
    pub at_loads: Mat<f64>,
}

impl Active {
    /// The coordinates of the sheet that couple to the loads, from combinations of its modes (`shapes`).
    /// Above the angular frequency `dynamic` (rad/s), only the combinations that the loads excite are kept, unless these are not fewer.
    /// `at_loads` holds the mode shapes averaged over the loads' footprints, loads x modes.
    pub fn of(shapes: &[Shape], at_loads: MatRef<'_, f64>, dynamic: f64) -> Self {
        let most = DEPTH * at_loads.nrows();
        let above = shapes.iter().filter(|s| s.pole.omega > dynamic).count();
        let kept = |shape: &&Shape| shape.pole.omega <= dynamic || above <= most;
        let (low, high): (Vec<&Shape>, Vec<&Shape>) = shapes.iter().partition(kept);
        let vectors = moved(&high, at_loads);
        let count = low.len() + vectors.len();
        let mut map = Mat::zeros(at_loads.ncols(), count);
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
        let at_loads = product(at_loads, map.as_ref());
        Self { single: low.len(), map, stiffness, damping, at_loads }
    }
}

/// Orthonormal combinations of high shapes that span Ω^{-2k} Wᵀ for k = 1 … DEPTH.
fn moved(high: &[&Shape], at_loads: MatRef<'_, f64>) -> Vec<Vec<f64>> {
    let lowest = high.iter().map(|s| s.pole.omega).fold(f64::INFINITY, f64::min);
    let softened = |vector: &[f64]| -> Vec<f64> {
        vector.iter().zip(high).map(|(v, shape)| v * (lowest / shape.pole.omega).powi(2)).collect()
    };
    let mut span = Span::default();
    let mut block: Vec<Vec<f64>> = (0..at_loads.nrows())
        .map(|load| high.iter().map(|shape| shape.weight(at_loads.row(load))).collect())
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
