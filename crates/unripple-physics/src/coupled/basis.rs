//! Modes of equal frequency combined into those that couple to loads and those that do not.

use super::span::Span;
use unripple_core::Pole;
use unripple_linalg::MatRef;

/// Modes whose frequencies and decay rates differ by less than this share count as degenerate: some hundred rounding
/// errors. Larger, modes of slightly different frequencies would count as degenerate.
const SAME: f64 = 1e-13;

/// A mode whose weight at the loads is less than this share of the largest does not couple to them: it is rounding of its
/// shape. Larger, modes that have a node near the load would lose their damping by it.
const UNFELT: f64 = 1e-12;

/// A normalised combination of modes of one frequency.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// Pole of the combination without the loads.
    pub pole: Pole,
    /// Indices of modes and their coefficients, whose squares sum to 1.
    pub parts: Vec<(usize, f64)>,
}

impl Shape {
    /// Weight of the combination at a footprint, computed from the modes' weights there.
    pub fn weight(&self, row: unripple_linalg::RowRef<'_, f64>) -> f64 {
        self.parts.iter().map(|(mode, part)| part * row[*mode]).sum()
    }
}

/// Splits modes into those that couple to the loads, and those that do not and keep their poles.
///
/// Of several modes of one frequency (a square has many), at most as many couple to the loads as there are loads: the others are
/// combinations that vanish at the loads' footprints. `felt` holds the weights of the loads' footprints, loads x modes.
pub(super) fn split(poles: &[Pole], felt: MatRef<'_, f64>) -> (Vec<Shape>, Vec<Shape>) {
    let most = (0..poles.len()).map(|m| largest(felt, m)).fold(0.0, f64::max);
    let (mut active, mut passive) = (Vec::new(), Vec::new());
    let mut first = 0;
    while first < poles.len() {
        let end = (first + 1..poles.len()).find(|m| !same(poles[first], poles[*m])).unwrap_or(poles.len());
        let shape = |vector: &Vec<f64>| Shape {
            pole: poles[first],
            parts: vector.iter().enumerate().map(|(i, part)| (first + i, *part)).collect(),
        };
        let mut span = Span::default();
        for load in 0..felt.nrows() {
            let row: Vec<f64> = (first..end).map(|m| felt[(load, m)]).collect();
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

fn largest(felt: MatRef<'_, f64>, mode: usize) -> f64 {
    felt.col(mode).iter().fold(0.0, |most, w| w.abs().max(most))
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
        let felt = mat![[1.0, 0.5, -0.3, 0.1, 0.0]];
        let (active, passive) = split(&poles, felt.as_ref());
        assert_eq!(active.iter().map(|s| s.pole.omega).collect::<Vec<_>>(), [10.0, 20.0]);
        assert_eq!(passive.iter().map(|s| s.pole.omega).collect::<Vec<_>>(), [20.0, 20.0, 30.0]);
        assert!(passive.iter().all(|s| s.weight(felt.row(0)).abs() < 1e-15));
        assert!((active[1].weight(felt.row(0)) - 0.35f64.sqrt()).abs() < 1e-15);
    }
}
