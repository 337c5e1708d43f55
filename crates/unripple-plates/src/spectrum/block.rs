//! A block of eigenpairs, and their residuals.

use super::panel::{LANES, Panel, Row};
use super::pencil::Pencil;
use super::rayleigh::quotients;
use rayon::prelude::*;
use std::ops::Range;
use unripple_linalg::{Mat, row_chunks};

/// Eigenpairs found at one shift, in ascending order.
#[derive(Debug, Default)]
pub(super) struct EigenBlock {
    /// Eigenvalues λ, ascending.
    pub(super) values: Vec<f64>,
    /// Residual of each eigenpair: norm in M of (K - σM)⁻¹Mx - x/(λ-σ), times abs(λ-σ).
    pub(super) residuals: Vec<f64>,
    /// Where each vector is stored: index of its panel, and its index in the panel.
    places: Vec<(usize, usize)>,
    /// Panels of the vectors, M-orthonormal, padded with zeros.
    pub(super) panels: Vec<Panel>,
    /// Number of eigenvalues below the shift.
    pub(super) left: usize,
}

impl EigenBlock {
    /// Eigenpairs in ascending order, with their vectors in that order in panels; `left` is the number of
    /// eigenvalues below the shift.
    pub(super) fn new(values: Vec<f64>, residuals: Vec<f64>, panels: Vec<Panel>, left: usize) -> Self {
        let places = (0..values.len()).map(|i| (i / LANES, i % LANES)).collect();
        Self { values, residuals, places, panels, left }
    }

    /// Eigenvalues λ above the shift, ascending.
    pub(super) fn right(&self) -> &[f64] {
        &self.values[self.left..]
    }

    /// Removes the eigenpairs outside a range of indices.
    pub(super) fn keep(&mut self, range: Range<usize>) {
        let mut used = vec![[0.0; LANES]; self.panels.len()];
        self.places[range.clone()].iter().for_each(|(panel, lane)| used[*panel][*lane] = 1.0);
        let mut number = 0;
        let mut numbers = Vec::new();
        for (panel, used) in self.panels.iter_mut().zip(&used) {
            numbers.push(number);
            number += usize::from(used.contains(&1.0));
            if used.contains(&0.0) {
                panel.iter_mut().for_each(|row| row.iter_mut().zip(used).for_each(|(x, u)| *x *= u));
            }
        }
        let mut used = used.iter();
        self.panels.retain(|_| used.next().is_some_and(|u| u.contains(&1.0)));
        self.places =
            self.places[range.clone()].iter().map(|(panel, lane)| (numbers[*panel], *lane)).collect();
        self.left = self.left.clamp(range.start, range.end) - range.start;
        self.values = self.values[range.clone()].to_vec();
        self.residuals = self.residuals[range].to_vec();
    }

    /// Replaces the eigenvalues by the Rayleigh quotients of their vectors.
    pub(super) fn refine(&mut self, pencil: &Pencil) {
        let quotients: Vec<Row> = self.panels.par_iter().map(|panel| quotients(pencil, panel)).collect();
        for (value, (panel, lane)) in self.values.iter_mut().zip(&self.places) {
            *value = quotients[*panel][*lane];
        }
    }

    /// Appends other eigenpairs, without regard to the order of eigenvalues.
    pub(super) fn append(&mut self, other: Self) {
        let count = self.panels.len();
        self.values.extend(other.values);
        self.residuals.extend(other.residuals);
        self.places.extend(other.places.iter().map(|(panel, lane)| (count + panel, *lane)));
        self.panels.extend(other.panels);
    }
}

/// All eigenvalues λ below `top`, ascending, and their vectors, unknowns x pairs, in the original order and
/// scale of the unknowns.
pub(super) fn gather(pencil: &Pencil, pieces: &[EigenBlock], top: f64) -> (Vec<f64>, Mat<f64>) {
    let mut pairs: Vec<(f64, usize, (usize, usize))> = Vec::new();
    for (p, piece) in pieces.iter().enumerate() {
        pairs.extend(piece.values.iter().zip(&piece.places).map(|(value, place)| (*value, p, *place)));
    }
    pairs.retain(|(value, ..)| *value < top);
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let n = pencil.len();
    let mut rows = vec![0; n];
    pencil.order.iter().enumerate().for_each(|(new, old)| rows[*old] = new);
    let mut vectors = Mat::zeros(n, pairs.len());
    // Rows per task: small enough to share among threads, large enough that a task is worth starting.
    const ROWS: usize = 128;
    row_chunks(vectors.as_mut(), ROWS).into_par_iter().zip(rows.par_chunks(ROWS)).for_each(
        |(mut vectors, rows)| {
            for (column, (_, piece, (panel, lane))) in vectors.as_mut().col_iter_mut().zip(&pairs) {
                let panel: &[Row] = &pieces[*piece].panels[*panel];
                column.iter_mut().zip(rows).for_each(|(x, row)| *x = panel[*row][*lane] * pencil.scale[*row]);
            }
        },
    );
    (pairs.iter().map(|(value, ..)| *value).collect(), vectors)
}
