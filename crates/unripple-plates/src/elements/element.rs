//! One triangular element: its unknowns and its polynomial basis.

use super::border::Border;
use super::corner::Corner;
use super::kink::{Factors, Kink, product};
use super::monomials::{COUNT, Frame, Jet, QUINTIC};
use super::trim::trim;
use unripple_core::Point;

/// A triangular element with its quintic basis polynomials.
///
/// A quintic is determined by 21 values (Argyris, Fried and Scharpf, *Aeronaut. J.* 72, 701, 1968): u, ∇u and the second derivatives
/// at each vertex, and ∂u/∂n at the middle of each edge. Along an edge inside, u and ∂u/∂n are polynomials of degrees 5 and 4 that
/// are determined by the values on the edge, so that u and ∇u are continuous. Along clamped or supported curves, polynomials of higher
/// degree are added whose coefficients depend on the 21 values.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    /// Centre and scale of the element's monomials.
    pub(crate) frame: Frame,
    /// Edges of the triangle, anticlockwise.
    pub(crate) borders: [Border; 3],
    /// Indices of the unknowns on which the element's functions depend: those of its polynomials, then
    /// those of its functions with jumps.
    pub(crate) unknowns: Vec<usize>,
    /// Coefficients of the basis polynomials, monomials x polynomials, row by row.
    pub(crate) basis: Vec<f64>,
    /// The functions with jumps of curvature at the rims of discs; the last unknowns belong to them.
    jumping: Vec<Jumping>,
}

/// Matrices of one triangle between its nodal values, row by row: stiffness other than bending (tension and springs), bending, mass.
pub(super) type Shares = [Vec<f64>; 3];

/// A function N (ψq - I(ψq)) with a jump of curvature at the rim of a disc, see [`Kink`], on one triangle.
#[derive(Clone, Debug)]
pub(crate) struct Jumping {
    /// The function ψ of the disc.
    pub(crate) kink: Kink,
    /// The vertex where the polynomial N is 1, in metres.
    pub(crate) vertex: Point,
    /// The polynomial q, as factors of monomials.
    pub(crate) factors: Factors,
    /// Column of N among the basis polynomials.
    pub(crate) column: usize,
    /// Coefficients of the quintic I(ψq), monomial by monomial.
    pub(crate) interpolated: Vec<f64>,
}

impl Jumping {
    /// The function ψq - I(ψq) at a point: as many of its value and derivatives as `monomials` has rows;
    /// `covered` if the disc is over the point.
    fn left(&self, p: Point, covered: bool, monomials: &[[f64; COUNT]]) -> Jet {
        let mut left = if covered { [0.0; 6] } else { self.kink.outside(self.vertex, &self.factors, p) };
        for (value, row) in left.iter_mut().zip(monomials) {
            *value -= self.interpolated.iter().zip(row).map(|(c, m)| c * m).sum::<f64>();
        }
        left
    }
}

/// The middle of an edge, where the normal derivative is an unknown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Middle {
    /// Place of the edge's middle, in metres.
    pub(crate) at: Point,
    /// The unit normal, the same for the triangles on both sides.
    pub(crate) normal: [f64; 2],
    /// The edge's length in metres, by which the normal derivative is scaled.
    pub(crate) length: f64,
    /// Index of the unknown; `None` where the derivative is zero.
    pub(crate) unknown: Option<usize>,
}

/// A vertex of a triangle, with the unknowns there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen<'a> {
    /// Place of the vertex, in metres.
    pub(crate) at: Point,
    /// Index of the vertex's first unknown.
    pub(crate) first: usize,
    /// The relation of the vertex's unknowns to the values and derivatives there.
    pub(crate) corner: &'a Corner,
}

impl Element {
    /// The element of the triangle `index`, from its vertices, edges and edges' middles.
    pub(crate) fn new(index: usize, vertices: [Seen; 3], borders: [Border; 3], middles: [Middle; 3]) -> Self {
        let frame = Frame::of(vertices.map(|v| v.at));
        let inverse = inverse(functionals(&frame, &vertices, &middles));
        let at_vertices = vertices.iter().flat_map(|v| v.first..v.first + v.corner.count);
        let unknowns: Vec<usize> = at_vertices.chain(middles.iter().filter_map(|m| m.unknown)).collect();
        let mut basis = Vec::with_capacity(QUINTIC * unknowns.len());
        for row in &inverse {
            for (v, vertex) in vertices.iter().enumerate() {
                let values = vertex.corner.values(index);
                let count = vertex.corner.count;
                let column = |c: usize| (0..6).map(|i| row[6 * v + i] * values[i * count + c]).sum::<f64>();
                basis.extend((0..count).map(column));
            }
            let free = (0..3).filter(|m| middles[*m].unknown.is_some());
            basis.extend(free.map(|m| row[18 + m]));
        }
        let points = vertices.map(|v| v.at);
        let slopes = [0, 1, 2].map(|m| middles[m].unknown.is_none());
        trim(&frame, points, &borders, slopes, unknowns.len(), &mut basis);
        Self { frame, borders, unknowns, basis, jumping: Vec::new() }
    }

    /// Adds a function with a jump of curvature; `unknown` is the index of its unknown.
    pub(crate) fn add(&mut self, jumping: Jumping, unknown: usize) {
        self.jumping.push(jumping);
        self.unknowns.push(unknown);
    }

    /// Number of the element's basis polynomials.
    pub(crate) fn polynomials(&self) -> usize {
        self.unknowns.len() - self.jumping.len()
    }

    /// Coefficients of the monomials of the polynomial that has the given values of the unknowns.
    pub(crate) fn polynomial(&self, values: &[f64]) -> Vec<f64> {
        let rows = self.basis.chunks_exact(self.polynomials());
        rows.map(|row| row.iter().zip(values).map(|(b, v)| b * v).sum()).collect()
    }

    /// The functions ψ of the discs whose rims cross this element, each once.
    pub(crate) fn kinks(&self) -> impl Iterator<Item = &Kink> {
        let first = |i: usize| self.jumping[..i].iter().all(|j| j.kink.disc != self.jumping[i].kink.disc);
        (0..self.jumping.len()).filter(move |i| first(*i)).map(|i| &self.jumping[i].kink)
    }

    /// Index of the disc that covers a point (m), among the discs with functions in this element.
    pub(crate) fn covering(&self, p: Point) -> Option<usize> {
        self.kinks().find(|kink| kink.covers(p)).map(|kink| kink.disc)
    }

    /// Values at a point (m) of six functions with jumps around one vertex, which need not be part of the
    /// element; `covered` if the disc is over the point.
    pub(crate) fn jumps(&self, p: Point, covered: bool, functions: &[Jumping; 6]) -> [f64; 6] {
        let monomials = self.frame.values(p);
        let of_vertex = self.combine(&monomials)[functions[0].column];
        std::array::from_fn(|i| of_vertex * functions[i].left(p, covered, &[monomials])[0])
    }

    /// Weights of the element's unknowns, one each, whose sum gives u at a point (m).
    pub(crate) fn values(&self, p: Point) -> Vec<f64> {
        if self.jumping.is_empty() {
            return self.combine(&self.frame.values(p));
        }
        let [values, ..] = self.jets(p, self.covering(p));
        values
    }

    /// Weights of the element's unknowns that give u, u_x, u_y (1/m), u_xx, u_xy and u_yy (1/m²) at a point
    /// (m): six rows. `under` is the index of the disc over the point, among the discs with functions in
    /// this element.
    pub(crate) fn jets(&self, p: Point, under: Option<usize>) -> [Vec<f64>; 6] {
        let monomials = self.frame.jets(p);
        let mut rows = monomials.map(|jet| self.combine(&jet));
        for jumping in &self.jumping {
            let of_vertex: Jet = std::array::from_fn(|i| rows[i][jumping.column]);
            let covered = Some(jumping.kink.disc) == under;
            let jet = product(&of_vertex, &jumping.left(p, covered, &monomials));
            rows.iter_mut().zip(jet).for_each(|(row, value)| row.push(value));
        }
        rows
    }

    /// Number of monomials of the element's polynomials: 21 for quintics, more at a clamped or supported
    /// curve.
    pub(crate) fn monomials(&self) -> usize {
        if self.unknowns.is_empty() { QUINTIC } else { self.basis.len() / self.polynomials() }
    }

    /// Values or derivatives of the element's polynomials at a point, from those of the monomials.
    pub(crate) fn combine(&self, monomials: &[f64; COUNT]) -> Vec<f64> {
        let mut sums = vec![0.0; self.polynomials()];
        if sums.is_empty() {
            return sums;
        }
        for (m, row) in monomials.iter().zip(self.basis.chunks_exact(self.polynomials())) {
            sums.iter_mut().zip(row).for_each(|(s, b)| *s += m * b);
        }
        sums
    }

    /// Distance of a point inside the triangle from the nearest edge, in units of the triangle's size;
    /// negative for a point outside.
    pub(crate) fn depth(&self, p: Point) -> f64 {
        self.borders.iter().map(|b| b.left_of(p)).fold(f64::INFINITY, f64::min) / self.frame.scale
    }
}

/// The 21 nodal values (u and its derivatives at vertices and edge middles) of each monomial: a row for
/// each value.
fn functionals(frame: &Frame, vertices: &[Seen; 3], middles: &[Middle; 3]) -> [[f64; QUINTIC]; QUINTIC] {
    let mut rows = [[0.0; QUINTIC]; QUINTIC];
    for (v, vertex) in vertices.iter().enumerate() {
        let length = vertex.corner.length;
        let units = [1.0, length, length, length * length, length * length, length * length];
        for (i, (jet, unit)) in frame.jets(vertex.at).iter().zip(units).enumerate() {
            rows[6 * v + i].iter_mut().zip(jet).for_each(|(row, value)| *row = value * unit);
        }
    }
    for (m, middle) in middles.iter().enumerate() {
        let jets = frame.jets(middle.at);
        let [nx, ny] = middle.normal.map(|n| n * middle.length);
        for (value, (x, y)) in rows[18 + m].iter_mut().zip(jets[1].iter().zip(&jets[2])) {
            *value = nx * x + ny * y;
        }
    }
    rows
}

/// The inverse of a matrix by Gauss-Jordan elimination with partial pivoting.
fn inverse(mut a: [[f64; QUINTIC]; QUINTIC]) -> [[f64; QUINTIC]; QUINTIC] {
    let mut order = [0; QUINTIC];
    for k in 0..QUINTIC {
        let pivot = (k..QUINTIC).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap_or(k);
        a.swap(k, pivot);
        order[k] = pivot;
        let scale = 1.0 / a[k][k];
        a[k][k] = 1.0;
        a[k].iter_mut().for_each(|v| *v *= scale);
        let row = a[k];
        for (i, other) in a.iter_mut().enumerate() {
            if i != k && other[k] != 0.0 {
                let factor = other[k];
                other[k] = 0.0;
                other.iter_mut().zip(row).for_each(|(v, r)| *v -= factor * r);
            }
        }
    }
    // Rows that were exchanged correspond to columns of the inverse, which are exchanged back, the last first.
    for k in (0..QUINTIC).rev() {
        if order[k] != k {
            a.iter_mut().for_each(|row| row.swap(k, order[k]));
        }
    }
    a
}
