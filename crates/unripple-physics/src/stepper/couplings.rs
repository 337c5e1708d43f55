//! Mutual influence of loads within one time step, and its inverse.

use super::bank::Bank;
use super::lanes::{Rows, grams};
use super::small::{Inverse, Small};
use pulp::Simd;

/// The composition of a port from two rows of weights: the rows, the columns of the tiles that hold copies
/// of them, and the share of each.
///
/// A port that does not move has a single row and column, which are given twice, with shares 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// Indices of the two rows of weights.
    pub(super) rows: [usize; 2],
    /// Indices of the columns that hold these rows in the tiles.
    pub(super) columns: [usize; 2],
    /// Share of each row in the port's weights, from 0 to 1.
    pub(super) shares: [f64; 2],
}

/// The effect of ports on each other over a step, and the inverses that the loads need.
#[derive(Clone, Debug)]
pub(super) struct Couplings {
    /// For each pair of rows of weights, as a matrix row by row: velocity after a unit impulse,
    /// displacement after a unit impulse, displacement after a constant unit force.
    grams: [Vec<f64>; 3],
    rows: usize,
    /// The couplings of `grams` between ports instead of rows.
    between: [Small; 3],
    /// The composition of each port.
    pub(super) parts: Vec<Part>,
    /// Number of ports that never change, which come first.
    fixed: usize,
    /// Inverse matrices for the loads' forces, and for impulses shared with masses.
    forces: Inverse,
    impulses: Inverse,
}

impl Couplings {
    /// Couplings of zero between `rows` rows, for up to `ports` ports; the first ports are `fixed` and
    /// never change.
    pub(super) fn new(rows: usize, ports: usize, fixed: &[Part]) -> Self {
        let mut parts = Vec::with_capacity(ports);
        parts.extend_from_slice(fixed);
        Self {
            grams: [0, 1, 2].map(|_| vec![0.0; rows * rows]),
            rows,
            between: [0, 1, 2].map(|_| Small::zeros(ports)),
            parts,
            fixed: fixed.len(),
            forces: Inverse::new(ports),
            impulses: Inverse::new(ports),
        }
    }

    /// Number of ports in use.
    #[inline(always)]
    pub(super) fn ports(&self) -> usize {
        self.parts.len()
    }

    /// Couplings between ports, ports x ports: velocity after a unit impulse, displacement after a unit
    /// impulse, displacement after a constant unit force.
    #[inline(always)]
    pub(super) fn between(&self) -> &[Small; 3] {
        &self.between
    }

    /// The inverse matrix that gives the loads' forces.
    #[inline(always)]
    pub(super) fn forces(&self) -> &Inverse {
        &self.forces
    }

    /// The inverse matrix that gives the impulses shared with masses.
    #[inline(always)]
    pub(super) fn impulses(&self) -> &Inverse {
        &self.impulses
    }

    /// Computes the couplings of one row of weights with the first `others` rows.
    #[inline(always)]
    pub(super) fn measure<S: Simd>(
        &mut self,
        simd: S,
        row: usize,
        others: usize,
        weights: &Rows,
        factors: &Rows,
    ) {
        let factors = [factors.row(0), factors.row(1)];
        for other in 0..others {
            let values = grams(simd, weights.row(row), weights.row(other), factors);
            for (gram, value) in self.grams.iter_mut().zip(values) {
                gram[row * self.rows + other] = value;
                gram[other * self.rows + row] = value;
            }
        }
    }

    /// Computes the couplings of all ports and both inverses from the couplings of rows.
    pub(super) fn renew<S: Simd>(&mut self, simd: S, bank: &Bank) {
        self.between.iter_mut().for_each(|matrix| matrix.clear());
        for port in 0..self.ports() {
            self.couple(port);
        }
        self.forces.fix(simd, self.fixed, &self.between[2], bank.depth());
        self.impulses.fix(simd, self.fixed, &self.between[0], bank.heft());
        self.follow(simd, bank);
    }

    /// Computes the couplings of the port with this index with all ports.
    #[inline(always)]
    pub(super) fn couple(&mut self, port: usize) {
        let part = self.parts[port];
        for (other, second) in self.parts.iter().enumerate() {
            for (matrix, gram) in self.between.iter_mut().zip(&self.grams) {
                let mut sum = 0.0;
                for (row, share) in part.rows.iter().zip(part.shares) {
                    for (column, other) in second.rows.iter().zip(second.shares) {
                        sum += share * other * gram[row * self.rows + column];
                    }
                }
                matrix.set(port, other, sum);
                matrix.set(other, port, sum);
            }
        }
    }

    /// Updates the inverses after a change of the couplings of ports that are not fixed.
    #[inline(always)]
    pub(super) fn follow<S: Simd>(&mut self, simd: S, bank: &Bank) {
        let ports = self.fixed..self.ports();
        self.forces.extend(simd, ports.clone(), &self.between[2], bank.depth());
        if bank.shares() {
            self.impulses.extend(simd, ports, &self.between[0], bank.heft());
        }
    }
}
