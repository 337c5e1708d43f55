//! The unknowns of a vertex: its values and derivatives, reduced by the essential boundary conditions of the rim.
//!
//! At a vertex of a clamped or supported side, u and its first and second derivatives along the side are zero; on a clamped side
//! the normal slope and its derivative along the side are zero as well. With H the matrix of second derivatives, the second
//! derivative by arc length along a curve of tangent t and curvature κ is t·Ht + κ ∂u/∂n. The term with κ prevents a supported
//! curve from being as stiff as the polygons that approach it (Babuška and Pitkäranta, *SIAM J. Math. Anal.* 21, 551, 1990).
//!
//! Where two sides meet, H need not be continuous: u and ∇u are continuous across an edge from the vertex if H jumps there by
//! c n nᵀ, with n the edge's normal (Morgan and Scott, *Math. Comp.* 29, 736, 1975). One c for each inner edge allows each side its
//! own condition; without it, a jump of curvature would also fix the slope.

use super::topology::Topology;
use crate::mesh::Mesh;
use unripple_core::Edge;

/// A condition counts as linearly dependent on the others if the part of it that is independent is smaller
/// than this: between rounding errors and the angles at which sides meet. With twice this value, conditions
/// that differ by 2e-6 would count as one.
const RANK: f64 = 1e-6;

/// Sides that meet at an angle within this of a straight angle, in radians, count as one smooth curve.
/// Otherwise a kink due to rounded coordinates would fix the slope, with an error of (h/L)²; ignoring the
/// kink has an error of its angle times (h/L)².
const SMOOTH: f64 = 1e-3;

/// The unknowns of a vertex, and their relation to u, u_x, u_y, u_xx, u_xy, u_yy there, each scaled by a
/// power of `length`.
#[derive(Clone, Debug)]
pub(crate) struct Corner {
    /// Number of unknowns.
    pub(crate) count: usize,
    /// The length in metres by which derivatives are scaled.
    pub(crate) length: f64,
    /// Six rows of `count` coefficients: one set for all triangles (`None`), or one for each triangle
    /// around the vertex.
    values: Vec<(Option<usize>, Vec<f64>)>,
}

/// The end of a side at a vertex.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    tangent: [f64; 2],
    /// Curvature of the side times the length by which derivatives are scaled.
    curvature: f64,
    edge: Edge,
}

impl Corner {
    /// The unknowns of a vertex, given by its index in the mesh; `bending` if the sheet has bending stiffness.
    pub(crate) fn of(mesh: &Mesh, topology: &Topology, vertex: usize, bending: bool) -> Self {
        let length = topology.lengths[vertex];
        let Some([leaves, arrives]) = topology.rim(vertex) else {
            return Self::whole(length);
        };
        let first = Meeting::of(mesh, leaves, true, length);
        let last = Meeting::of(mesh, arrives, false, length);
        let (Some(mut first), Some(mut last)) = (first, last) else { return Self::whole(length) };
        first.smooth(&mut last);
        if first.is_like(&last) {
            let rows = first.conditions(bending, &[]);
            let held = !rows.is_empty();
            return if held { Self::held(length, rows, vec![(None, vec![])]) } else { Self::whole(length) };
        }
        let fan = topology.fan(mesh, vertex);
        let at = mesh.vertices[vertex].at;
        let crossed = &fan[..fan.len().saturating_sub(1)];
        let normals: Vec<[f64; 2]> = crossed
            .iter()
            .map(|step| {
                let to = mesh.vertices[step.towards].at;
                let size = to.distance(at);
                [-(to.y - at.y) / size, (to.x - at.x) / size]
            })
            .collect();
        let mut rows = first.conditions(bending, &[]);
        rows.iter_mut().for_each(|row| row.resize(6 + normals.len(), 0.0));
        rows.extend(last.conditions(bending, &normals));
        if rows.is_empty() {
            return Self::whole(length);
        }
        let jumps = fan.iter().enumerate().map(|(i, step)| (Some(step.triangle), normals[..i].to_vec()));
        Self::held(length, rows, jumps.collect())
    }

    /// A vertex inside the sheet: all six values are unknowns.
    fn whole(length: f64) -> Self {
        Self { count: 6, length, values: vec![(None, identity(6).concat())] }
    }

    /// The unknowns that satisfy the edge conditions (`rows`); `jumps` holds for each triangle the normals
    /// of the edges across which H jumps.
    fn held(length: f64, rows: Vec<Vec<f64>>, jumps: Vec<(Option<usize>, Vec<[f64; 2]>)>) -> Self {
        let size = rows.first().map_or(6, Vec::len);
        let free = null_space(rows, size);
        let value = |row: usize, normals: &[[f64; 2]], unknown: &[f64]| {
            let jump = |(i, [nx, ny]): (usize, &[f64; 2])| {
                unknown[6 + i] * [0.0, 0.0, 0.0, nx * nx, nx * ny, ny * ny][row]
            };
            unknown[row] + normals.iter().enumerate().map(jump).sum::<f64>()
        };
        let values = jumps
            .into_iter()
            .map(|(triangle, normals)| {
                let rows = (0..6).flat_map(|row| free.iter().map(move |u| (row, u)));
                (triangle, rows.map(|(row, u)| value(row, &normals, u)).collect())
            })
            .collect();
        Self { count: free.len(), length, values }
    }

    /// Whether the unknowns are all six values, free of any condition.
    pub(crate) fn is_whole(&self) -> bool {
        self.count == 6 && self.values.iter().all(|(triangle, _)| triangle.is_none())
    }

    /// Coefficients of the unknowns for u, u_x, u_y, u_xx, u_xy, u_yy in a triangle: six rows of
    /// [`Corner::count`].
    pub(crate) fn values(&self, triangle: usize) -> &[f64] {
        let found = self.values.iter().find(|(of, _)| of.is_none_or(|t| t == triangle));
        found.map_or(&[], |(_, values)| values)
    }
}

impl Meeting {
    /// The side that a rim edge belongs to, as it is at the edge's start or end; `None` for an edge inside.
    fn of(mesh: &Mesh, edge: usize, start: bool, length: f64) -> Option<Self> {
        let span = mesh.edges[edge].span?;
        let (side, edge) = *mesh.sides.get(span.side)?;
        let t = if start { span.from } else { span.to };
        let d = side.derivative(t);
        let size = d.x.hypot(d.y);
        Some(Self { tangent: [d.x / size, d.y / size], curvature: side.curvature(t) * length, edge })
    }

    /// Gives both sides their mean tangent if they meet at nearly a straight angle.
    fn smooth(&mut self, other: &mut Self) {
        let ([ax, ay], [bx, by]) = (self.tangent, other.tangent);
        let (across, along) = (ax * by - ay * bx, ax * bx + ay * by);
        if across.atan2(along).abs() < SMOOTH {
            let size = (ax + bx).hypot(ay + by);
            let mean = [(ax + bx) / size, (ay + by) / size];
            (self.tangent, other.tangent) = (mean, mean);
        }
    }

    /// Whether both sides have the same tangent, curvature and edge condition.
    fn is_like(&self, other: &Self) -> bool {
        // Equal except for rounding.
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        near(self.tangent[0], other.tangent[0])
            && near(self.tangent[1], other.tangent[1])
            && near(self.curvature, other.curvature)
            && self.edge == other.edge
    }

    /// The conditions of this side, as rows whose product with the six values and the jumps of H is zero;
    /// `jumps` are the normals of the edges across which H jumps.
    fn conditions(&self, bending: bool, jumps: &[[f64; 2]]) -> Vec<Vec<f64>> {
        let ([tx, ty], [nx, ny]) = (self.tangent, [-self.tangent[1], self.tangent[0]]);
        let row = |u: f64, g: [f64; 2], a: [f64; 2]| {
            // t·Ha in terms of u_xx, u_xy, u_yy.
            let h = [tx * a[0], tx * a[1] + ty * a[0], ty * a[1]];
            let jump = jumps.iter().map(|n| (tx * n[0] + ty * n[1]) * (a[0] * n[0] + a[1] * n[1]));
            [u, g[0], g[1], h[0], h[1], h[2]].into_iter().chain(jump).collect()
        };
        let (none, along, across) = ([0.0; 2], [tx, ty], [nx, ny]);
        let bow = [self.curvature * nx, self.curvature * ny];
        match self.edge {
            Edge::Free | Edge::Elastic { .. } => Vec::new(),
            Edge::Clamped if bending => vec![
                row(1.0, none, none),
                row(0.0, along, none),
                row(0.0, across, none),
                row(0.0, none, along),
                row(0.0, none, across),
            ],
            Edge::Clamped | Edge::Supported => {
                vec![row(1.0, none, none), row(0.0, along, none), row(0.0, bow, along)]
            }
        }
    }
}

/// The rows of an identity matrix, size x size.
fn identity(size: usize) -> Vec<Vec<f64>> {
    (0..size).map(|i| (0..size).map(|j| f64::from(u8::from(i == j))).collect()).collect()
}

/// An orthonormal basis of the vectors orthogonal to all rows, by Gram-Schmidt orthogonalisation with pivoting.
fn null_space(rows: Vec<Vec<f64>>, size: usize) -> Vec<Vec<f64>> {
    let unit = |mut row: Vec<f64>| {
        let norm = dot(&row, &row).sqrt();
        row.iter_mut().for_each(|v| *v /= norm);
        row
    };
    let mut basis = Vec::new();
    extend(&mut basis, rows.into_iter().map(unit).collect(), size);
    let rank = basis.len();
    extend(&mut basis, identity(size), size - rank);
    basis.split_off(rank)
}

/// Adds up to `most` directions from the candidates to an orthonormal basis, the most independent first.
fn extend(basis: &mut Vec<Vec<f64>>, mut candidates: Vec<Vec<f64>>, most: usize) {
    let clean = |v: &mut Vec<f64>, basis: &[Vec<f64>]| {
        for b in basis {
            let along = dot(v, b);
            v.iter_mut().zip(b).for_each(|(v, b)| *v -= along * b);
        }
    };
    candidates.iter_mut().for_each(|v| clean(v, basis));
    for _ in 0..most {
        let best = (0..candidates.len()).max_by(|a, b| {
            dot(&candidates[*a], &candidates[*a]).total_cmp(&dot(&candidates[*b], &candidates[*b]))
        });
        let Some(best) = best else { break };
        let mut v = candidates.swap_remove(best);
        clean(&mut v, basis);
        let norm = dot(&v, &v).sqrt();
        if norm <= RANK {
            break;
        }
        v.iter_mut().for_each(|x| *x /= norm);
        clean(&mut v, basis);
        candidates.iter_mut().for_each(|c| clean(c, std::slice::from_ref(&v)));
        basis.push(v);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
