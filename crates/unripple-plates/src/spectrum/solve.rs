//! Triangular solves with the sparse factors, for a panel of right-hand sides.

use super::factor::{Factor, Node};
use super::panel::{NONE, Row, TILE, add};
use pulp::{Arch, NullaryFnOnce};

/// Solves (K - σM) X = B for a panel, in place; `rows` is scratch memory.
pub(super) fn solve(arch: Arch, factor: &Factor, x: &mut [Row], rows: &mut Vec<Row>) {
    arch.dispatch(Solve { factor, x, rows });
}

struct Solve<'a> {
    factor: &'a Factor<'a>,
    x: &'a mut [Row],
    rows: &'a mut Vec<Row>,
}

impl NullaryFnOnce for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let nodes = &self.factor.nodes;
        for s in 0..nodes.len() {
            forward(&nodes.at(s), self.x);
        }
        for s in (0..nodes.len()).rev() {
            backward(&nodes.at(s), self.x, self.rows);
        }
    }
}

/// The part of x ← L⁻¹x that one supernode contributes.
#[inline(always)]
fn forward(node: &Node, x: &mut [Row]) {
    let (top, below) = x[node.start..].split_at_mut(node.width);
    let mut tiles = node.top;
    for first in (0..node.width).step_by(TILE) {
        let (done, rest) = top.split_at_mut(first);
        let (left, later) = tiles.split_at(first);
        let (square, later) = later.split_at(TILE);
        tiles = later;
        let sums = tile_times(left, done);
        for (x, sum) in rest.iter_mut().zip(&sums) {
            add(x, -1.0, sum);
        }
        let high = TILE.min(rest.len());
        for j in 0..high {
            let now = rest[j];
            for (x, l) in rest[j + 1..high].iter_mut().zip(&square[j][j + 1..]) {
                add(x, -l, &now);
            }
        }
    }
    let offset = node.start + node.width;
    for (rows, tile) in node.pattern.chunks(TILE).zip(node.below.chunks_exact(node.width)) {
        let sums = tile_times(tile, top);
        for (row, sum) in rows.iter().zip(&sums) {
            add(&mut below[row - offset], -1.0, sum);
        }
    }
}

/// The sums Σ_j L[i, j] x[j] for the rows i of a tile.
#[inline(always)]
fn tile_times(tile: &[[f64; TILE]], x: &[Row]) -> [Row; TILE] {
    let mut sums = [NONE; TILE];
    for (l, x) in tile.iter().zip(x) {
        for (sum, l) in sums.iter_mut().zip(l) {
            add(sum, *l, x);
        }
    }
    sums
}

/// Subtracts the product with a transposed tile: x[j] ← x[j] - Σ_i L[i, j] rows[i].
#[inline(always)]
fn subtract_transposed(tile: &[[f64; TILE]], rows: &[Row; TILE], x: &mut [Row]) {
    for (l, x) in tile.iter().zip(x) {
        let mut sum = *x;
        for (row, l) in rows.iter().zip(l) {
            add(&mut sum, -l, row);
        }
        *x = sum;
    }
}

/// The part of x ← L⁻ᵀD⁻¹x that one supernode contributes.
#[inline(always)]
fn backward(node: &Node, x: &mut [Row], top: &mut Vec<Row>) {
    top.clear();
    for (x, inverse) in x[node.start..].iter().zip(node.inverse_pivots) {
        top.push(x.map(|v| v * inverse));
    }
    for (rows, tile) in node.pattern.chunks(TILE).zip(node.below.chunks_exact(node.width)).rev() {
        let mut gathered = [NONE; TILE];
        for (gathered, row) in gathered.iter_mut().zip(rows) {
            *gathered = x[*row];
        }
        subtract_transposed(tile, &gathered, top);
    }
    let mut end = node.top.len();
    for first in (0..node.width).step_by(TILE).rev() {
        let tile = &node.top[end - first - TILE..end];
        end -= first + TILE;
        let (early, rest) = top.split_at_mut(first);
        let high = TILE.min(rest.len());
        for j in (0..high).rev() {
            let mut now = rest[j];
            for (x, l) in rest[j + 1..high].iter().zip(&tile[first + j][j + 1..]) {
                add(&mut now, -l, x);
            }
            rest[j] = now;
        }
        let mut done = [NONE; TILE];
        done[..high].copy_from_slice(&rest[..high]);
        subtract_transposed(tile, &done, early);
    }
    x[node.start..][..node.width].copy_from_slice(top);
}
