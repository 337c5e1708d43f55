//! One-dimensional basis functions on a side, and their energy integrals.

use super::super::legendre::gauss;
use super::polynomials::Polynomials;
use std::f64::consts::FRAC_PI_2;
use unripple_core::Edge;
use unripple_linalg::Mat;

/// The basis along one direction of a rectangle, on ξ in [-1, 1]: orthonormal functions and the integrals of their energies.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    functions: Functions,
    /// Slope integrals ∫f' g', functions x functions.
    pub(crate) slope: Mat<f64>,
    /// Curvature integrals ∫f'' g'', functions x functions.
    pub(crate) curvature: Mat<f64>,
    /// Integrals ∫f'' g, functions x functions; the function of the first index is differentiated.
    pub(crate) mixed: Mat<f64>,
    /// Whether both ends have the same edge condition, so that even and odd functions do not couple.
    symmetric: bool,
}

/// The basis functions along one direction.
#[derive(Clone, Debug)]
enum Functions {
    /// sin(nπ(1+ξ)/2), n = 1, 2, …: the exact shapes between two supported ends.
    Sines,
    /// Polynomials that satisfy the essential boundary conditions.
    Polynomials(Polynomials),
}

impl Line {
    /// The first `count` functions for the edge conditions `low` at ξ = -1 and `high` at ξ = 1, for a sheet with bending stiffness.
    pub(crate) fn new(low: Edge, high: Edge, count: usize) -> Self {
        if (low, high) == (Edge::Supported, Edge::Supported) {
            return Self::sines(count);
        }
        let family = Polynomials::new(low, high, count);
        let mut line = Self {
            slope: Mat::zeros(count, count),
            curvature: Mat::zeros(count, count),
            mixed: Mat::zeros(count, count),
            functions: Functions::Polynomials(family.clone()),
            symmetric: low == high,
        };
        let symmetric = family.symmetric();
        for (xi, weight) in gauss(count + 5) {
            let jets = family.derivatives_at(xi);
            for (j, g) in jets.iter().enumerate() {
                // Opposite parities are left at an exact zero.
                let first = if symmetric { j % 2 } else { 0 };
                for (i, f) in jets.iter().enumerate().skip(first).step_by(1 + usize::from(symmetric)) {
                    line.slope[(i, j)] += weight * f[1] * g[1];
                    line.curvature[(i, j)] += weight * f[2] * g[2];
                    line.mixed[(i, j)] += weight * f[2] * g[0];
                }
            }
        }
        line
    }

    /// The first `count` sines, whose integrals are diagonal.
    fn sines(count: usize) -> Self {
        let diagonal = |f: &dyn Fn(f64) -> f64| {
            Mat::from_fn(count, count, |i, j| if i == j { f((i + 1) as f64 * FRAC_PI_2) } else { 0.0 })
        };
        Self {
            functions: Functions::Sines,
            slope: diagonal(&|k| k * k),
            curvature: diagonal(&|k| k.powi(4)),
            mixed: diagonal(&|k| -k * k),
            symmetric: true,
        }
    }

    /// Value, first and second derivative of each polynomial at ξ; empty where the functions are sines.
    pub(crate) fn derivatives_at(&self, xi: f64) -> Vec<[f64; 3]> {
        match &self.functions {
            Functions::Sines => Vec::new(),
            Functions::Polynomials(family) => family.derivatives_at(xi),
        }
    }

    /// Number of functions n: the size of all integrals.
    pub(crate) fn count(&self) -> usize {
        self.slope.nrows()
    }

    /// Writes the values of all functions at ξ into `values`, of length [`Line::count`].
    pub(crate) fn at(&self, xi: f64, values: &mut [f64]) {
        match &self.functions {
            Functions::Sines => sines(FRAC_PI_2 * (1.0 + xi), values),
            Functions::Polynomials(family) => family.at(xi, values),
        }
    }

    /// Degree of function `n` (an index) if it is a polynomial.
    pub(crate) fn degree(&self, n: usize) -> Option<usize> {
        match &self.functions {
            Functions::Sines => None,
            Functions::Polynomials(family) => Some(family.degree(n)),
        }
    }

    /// Whether the functions are the exact mode shapes, so that more of them add nothing.
    pub(crate) fn exact(&self) -> bool {
        matches!(self.functions, Functions::Sines)
    }

    /// Classes of functions, among the first `count`, such that functions of different classes do not
    /// couple: single sines, even and odd polynomials, or all polynomials.
    pub(crate) fn classes(&self, count: usize) -> Vec<Class> {
        match &self.functions {
            Functions::Sines => (0..count).map(|n| Class { first: n, step: 1, end: n + 1 }).collect(),
            Functions::Polynomials(_) if self.symmetric => {
                (0..2).map(|n| Class { first: n, step: 2, end: count }).collect()
            }
            Functions::Polynomials(_) => vec![Class { first: 0, step: 1, end: count }],
        }
    }
}

/// A class of functions: those with the indices `first`, `first + step`, … below `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Class {
    /// The first index.
    pub(crate) first: usize,
    /// Difference from one index to the next.
    pub(crate) step: usize,
    /// Upper bound of the indices, exclusive.
    pub(crate) end: usize,
}

impl Class {
    /// Number of indices.
    pub(crate) fn len(self) -> usize {
        self.end.saturating_sub(self.first).div_ceil(self.step)
    }

    /// The index of the function in position `i` of the class.
    pub(crate) fn index(self, i: usize) -> usize {
        self.first + i * self.step
    }

    /// The same class continued up to the index `end`.
    pub(crate) fn until(self, end: usize) -> Self {
        Self { end, ..self }
    }
}

/// Writes sin(nθ), n = 1, 2, …, into `values`, by complex rotation that is restarted often enough to stay
/// at machine precision; θ in radians.
pub(crate) fn sines(theta: f64, values: &mut [f64]) {
    let (s, c) = theta.sin_cos();
    for (chunk, slots) in values.chunks_mut(16).enumerate() {
        let (mut y, mut x) = ((16 * chunk + 1) as f64 * theta).sin_cos();
        for slot in slots {
            *slot = y;
            (x, y) = (x * c - y * s, y * c + x * s);
        }
    }
}
