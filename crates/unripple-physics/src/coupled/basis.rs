//! Combines modes of equal frequency into those that couple to loads and those that do not.

use super::span::Span;
use unripple_core::Pole;
use unripple_linalg::MatRef;

/// Modes whose frequencies and decay rates differ by less than this relative amount count as degenerate: it
/// is some hundred rounding errors. Larger, modes of slightly different frequencies would count as
/// degenerate.
const SAME: f64 = 1e-13;

/// A mode whose weight at the loads is less than this share of the largest weight does not couple to the
/// loads: such a weight is rounding error of the mode shape. Larger, modes that have a node near the load
/// would lose the damping by the load.
const UNFELT: f64 = 1e-12;

/// A normalised combination of modes of one frequency.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// Pole of the combination on the sheet without loads.
    pub pole: Pole,
    /// Indices of modes and their coefficients, whose squares sum to 1.
    pub parts: Vec<(usize, f64)>,
}

impl Shape {
    /// This combination of mode shapes averaged over a footprint, from the averages of the single mode shapes
    /// over it (`row`).
    pub fn weight(&self, row: unripple_linalg::RowRef<'_, f64>) -> f64 {
        self.parts.iter().map(|(mode, part)| part * row[*mode]).sum()
    }
}

/// Splits modes into those that couple to the loads, and those that do not and therefore keep their poles.
///
/// Of several modes of one frequency (a square has many), at most as many couple to the loads as there are loads: the others are
/// combinations that vanish at the loads' footprints. `at_loads` holds the weights of the loads' footprints, loads x modes.
pub(super) fn split(poles: &[Pole], at_loads: MatRef<'_, f64>) -> (Vec<Shape>, Vec<Shape>) {
    let most = (0..poles.len()).map(|m| largest(at_loads, m)).fold(0.0, f64::max);
    let (mut active, mut passive) = (Vec::new(), Vec::new());
    let mut first = 0;
    while first < poles.len() {
        let end = (first + 1..poles.len()).find(|m| !same(poles[first], poles[*m])).unwrap_or(poles.len());
        let shape = |vector: &Vec<f64>| Shape {
            pole: poles[first],
            parts: vector.iter().enumerate().map(|(i, part)| (first + i, *part)).collect(),
        };
        let mut span = Span::default();
        for load in 0..at_loads.nrows() {
            let row: Vec<f64> = (first..end).map(|m| at_loads[(load, m)]).collect();
            if row.iter().any(|w| w.abs() > UNFELT * most) {
                span.add(row, UNFELT);
            }
        }
        let feeling = span.vectors.len();
        for i in 0..end - first {
            if span.vectors.len() < end - first {
                span.add((0..end - first).map(|j| f64::from(u8::from(i == j))).collect(), 1e-6);
            }
        }
        active.extend(span.vectors[..feeling].iter().map(shape));
        passive.extend(span.vectors[feeling..].iter().map(shape));
        first = end;
    }
    (active, passive)
}

fn largest(at_loads: MatRef<'_, f64>, mode: usize) -> f64 {
    at_loads.col(mode).iter().fold(0.0, |most, w| w.abs().max(most))
}

fn same(a: Pole, b: Pole) -> bool {
    let close = |x: f64, y: f64| (x - y).abs() <= SAME * x.abs().max(y.abs());
    close(a.omega, b.omega) && close(a.sigma, b.sigma)
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_linalg::mat;

    #[test]
    fn one_load_is_felt_by_one_of_each_frequency() {
        let poles = [10.0, 20.0, 20.0, 20.0, 30.0].map(|omega| Pole::new(omega, 1.0));
        let at_loads = mat![[1.0, 0.5, -0.3, 0.1, 0.0]];
        let (active, passive) = split(&poles, at_loads.as_ref());
        assert_eq!(active.iter().map(|s| s.pole.omega).collect::<Vec<_>>(), [10.0, 20.0]);
        assert_eq!(passive.iter().map(|s| s.pole.omega).collect::<Vec<_>>(), [20.0, 20.0, 30.0]);
        assert!(passive.iter().all(|s| s.weight(at_loads.row(0)).abs() < 1e-15));
        assert!((active[1].weight(at_loads.row(0)) - 0.35f64.sqrt()).abs() < 1e-15);
    }
}
