//! Unknowns around a free corner, relative to the corner's motion as a rigid body.
//!
//! Edges at a re-entrant free corner may be a millionth of the sheet's width w. Triangles of size h that move as a rigid body store no
//! energy, but between nodal values that is a sum of terms D u²/h² that cancel up to rounding errors ε, which are ε (w/h)² of the energy
//! of the lowest modes: 1e-4. So around corners where the sheet can move and edges are short, the unknowns are what nodal values have
//! beyond the linear function with the displacement and slope of the corner. The entries of rigid motion are set to zero, which they are
//! but for rounding.

use super::corner::Corner;
use super::element::{Element, Middle, Shares};
use super::topology::Topology;
use crate::mesh::Mesh;
use unripple_core::Point;
use unripple_core::plane::Bounds;
use unripple_linalg::Mat;

/// Vertices whose edges are on average shorter than this share of the sheet's width are relative to a corner: longer edges leave rounding
/// errors of 1e-10. With twice this value, more unknowns depend on each corner.
const SHORT: f64 = 1e-3;

/// Distance from a corner up to which unknowns are relative to it, in multiples of [`SHORT`]: edges grow by a tenth of the distance or more,
/// so that they are short up to ten. Farther away short edges have another reason, such as boundary layers, which may be as long as the
/// rim.
const REACH: f64 = 20.0;

/// Distance of corners from each other, as a share of the sheet's width, below which they have one rigid motion: farther apart, triangles
/// between them that are relative to two corners are long enough. With a tenth of this value, those leave rounding errors of 1e-7; with
/// ten times, those at the corner that bends away from the other do.
const CLOSE: f64 = 1e-3;

/// An unknown relative to a corner.
#[derive(Clone, Copy, Debug)]
struct Tied {
    /// Indices of the corner's unknowns of u, u_x and u_y.
    corner: [usize; 3],
    /// The value that the nodal value has if one of the corner's unknowns is 1, and the sheet moves as a rigid body.
    factors: [f64; 3],
}

/// The unknowns that are relative to a corner.
#[derive(Clone, Debug, Default)]
pub(super) struct Relative {
    /// For each nodal value; empty if none is relative.
    tied: Vec<Option<Tied>>,
}

impl Relative {
    /// The unknowns around all free corners of a mesh where edges are short. `firsts` are the indices of the first unknowns of the
    /// vertices, `middles` those of the edges, of `unknowns` in all.
    pub(super) fn new(
        (mesh, topology): (&Mesh, &Topology),
        corners: &[Corner],
        firsts: &[usize],
        middles: &[Middle],
        unknowns: usize,
    ) -> Self {
        let owners = owners(mesh, topology, corners);
        if owners.iter().all(Option::is_none) {
            return Self::default();
        }
        let mut tied = vec![None; unknowns];
        let scaled = |owner: usize, [u, x, y]: [f64; 3]| {
            let (first, length) = (firsts[owner], corners[owner].length);
            Some(Tied { corner: [first, first + 1, first + 2], factors: [u, x / length, y / length] })
        };
        for (v, owner) in owners.iter().enumerate() {
            let Some(owner) = *owner else { continue };
            let (at, from, length) = (mesh.vertices[v].at, mesh.vertices[owner].at, corners[v].length);
            let value = scaled(owner, [1.0, at.x - from.x, at.y - from.y]);
            let slopes = [scaled(owner, [0.0, length, 0.0]), scaled(owner, [0.0, 0.0, length])];
            let none = scaled(owner, [0.0; 3]);
            tied[firsts[v]..][..6].copy_from_slice(&[value, slopes[0], slopes[1], none, none, none]);
        }
        for (edge, middle) in mesh.edges.iter().zip(middles) {
            let [a, b] = edge.ends.map(|v| owners[v]);
            if let (Some(owner), Some(unknown)) = (a.filter(|_| a == b), middle.unknown) {
                let [nx, ny] = middle.normal.map(|n| n * middle.length);
                tied[unknown] = scaled(owner, [0.0, nx, ny]);
            }
        }
        Self { tied }
    }

    fn of(&self, unknown: usize) -> Option<&Tied> {
        self.tied.get(unknown)?.as_ref()
    }

    /// The unknowns on which an element's functions depend: its own, then those of corners that these are relative to.
    pub(super) fn among(&self, element: &Element) -> Vec<usize> {
        let mut all = element.unknowns.clone();
        for tied in element.unknowns.iter().filter_map(|unknown| self.of(*unknown)) {
            for corner in tied.corner {
                if !all.contains(&corner) {
                    all.push(corner);
                }
            }
        }
        all
    }

    /// The matrices of an element between nodal values as matrices between unknowns, and these unknowns as by [`Relative::among`].
    pub(super) fn between(&self, element: &Element, matrices: Shares) -> (Vec<usize>, Shares) {
        let unknowns = self.among(element);
        let own = &element.unknowns;
        if own.iter().all(|unknown| self.of(*unknown).is_none()) {
            return (unknowns, matrices);
        }
        let place = |unknown: usize| unknowns.iter().position(|other| *other == unknown).unwrap_or_default();
        let row = |(i, unknown): (usize, &usize)| {
            let mut row = vec![(i, 1.0)];
            if let Some(tied) = self.of(*unknown).filter(|tied| !tied.corner.contains(unknown)) {
                let factors = tied.corner.into_iter().zip(tied.factors).filter(|(_, factor)| *factor != 0.0);
                row.extend(factors.map(|(corner, factor)| (place(corner), factor)));
            }
            row
        };
        let rows: Vec<Vec<(usize, f64)>> = own.iter().enumerate().map(row).collect();
        let [rest, mut bending, mass] = matrices.map(|matrix| congruent(&matrix, &rows, unknowns.len()));
        if let Some(corner) = self.rigid(element) {
            let count = unknowns.len();
            for still in corner.map(place) {
                (0..count)
                    .for_each(|i| (bending[i * count + still], bending[still * count + i]) = (0.0, 0.0));
            }
        }
        (unknowns, [rest, bending, mass])
    }

    /// The corner to which all of an element is relative: then the element follows it as a rigid body.
    fn rigid(&self, element: &Element) -> Option<[usize; 3]> {
        let mut nodal = element.unknowns[..element.polynomials()].iter().map(|unknown| self.of(*unknown));
        let corner = nodal.next()??.corner;
        nodal.all(|tied| tied.is_some_and(|tied| tied.corner == corner)).then_some(corner)
    }

    /// Turns vectors of unknowns, unknowns x vectors, into nodal values.
    pub(super) fn nodal(&self, vectors: &mut Mat<f64>) {
        for (unknown, tied) in self.tied.iter().enumerate() {
            let Some(tied) = tied.filter(|tied| !tied.corner.contains(&unknown)) else { continue };
            for column in 0..vectors.ncols() {
                let moved =
                    tied.corner.iter().zip(tied.factors).map(|(corner, f)| f * vectors[(*corner, column)]);
                vectors[(unknown, column)] += moved.sum::<f64>();
            }
        }
    }
}

/// For each vertex the free corner that it is relative to: the nearest, or of corners close together the first.
fn owners(mesh: &Mesh, topology: &Topology, corners: &[Corner]) -> Vec<Option<usize>> {
    let count = mesh.vertices.len();
    let places: Vec<Point> = mesh.vertices.iter().map(|vertex| vertex.at).collect();
    let Bounds { low, high } = Bounds::around(&places, 0.0);
    let width = (high.x - low.x).max(high.y - low.y);
    let short = |v: usize| topology.lengths[v] < SHORT * width && corners[v].is_whole();
    let starts = |v: usize| {
        let leaves = topology.rim(v).and_then(|[leaves, _]| mesh.edges[leaves].span);
        leaves.is_some_and(|span| span.from == 0.0)
    };
    let sources: Vec<usize> = (0..count).filter(|v| short(*v) && starts(*v)).collect();
    if sources.is_empty() {
        return vec![None; count];
    }
    let between = |a: usize, b: usize| places[a].distance(places[b]);
    let mut firsts = sources.clone();
    for i in 1..sources.len() {
        for j in 0..i {
            if between(sources[i], sources[j]) < CLOSE * width {
                let (old, new) = (firsts[i].max(firsts[j]), firsts[i].min(firsts[j]));
                firsts.iter_mut().filter(|first| **first == old).for_each(|first| *first = new);
            }
        }
    }
    let owner = |v: usize| {
        if !short(v) {
            return None;
        }
        let near = sources.iter().zip(&firsts).map(|(source, first)| (between(v, *source), *first));
        let (distance, first) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance < REACH * SHORT * width).then_some(first)
    };
    (0..count).map(owner).collect()
}

/// The matrix Tᵀ A T between `count` unknowns, given the rows of T as places and values.
fn congruent(matrix: &[f64], rows: &[Vec<(usize, f64)>], count: usize) -> Vec<f64> {
    let mut out = vec![0.0; count * count];
    for (a, values) in rows.iter().zip(matrix.chunks_exact(rows.len().max(1))) {
        for (b, value) in rows.iter().zip(values) {
            for (i, f) in a {
                for (j, g) in b {
                    out[i * count + j] += f * g * value;
                }
            }
        }
    }
    out
}
