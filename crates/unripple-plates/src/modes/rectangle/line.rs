//! One-dimensional basis functions on a side, and their energy integrals.

use super::super::legendre::gauss;
use super::integrated::Integrated;
use super::polynomials::Polynomials;
use std::f64::consts::FRAC_PI_2;
use unripple_core::Edge;
use unripple_linalg::Mat;

/// The basis along one direction of a rectangle, on ξ in [-1, 1]: functions and the integrals of their energies.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    functions: Functions,
    /// Mass integrals ∫f g, functions x functions: the identity where the functions are orthonormal.
    pub(crate) mass: Mat<f64>,
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
    /// Orthonormal polynomials that satisfy the essential boundary conditions.
    Polynomials(Polynomials),
    /// The same polynomials, combined so that each couples with few others.
    Integrated(Integrated),
}

/// Largest differences of index between functions without a value at an end that couple in mass, in slope, in curvature and in ∫f'' g; see
/// [`Integrated`].
const REACH: [usize; 4] = [4, 2, 0, 2];

impl Line {
    /// The first `count` functions for the edge conditions `low` at ξ = -1 and `high` at ξ = 1, for a sheet with bending stiffness: sines
    /// between two supported ends, elsewhere orthonormal polynomials.
    pub(crate) fn new(low: Edge, high: Edge, count: usize) -> Self {
        if (low, high) == (Edge::Supported, Edge::Supported) {
            return Self::sines(count);
        }
        let family = Polynomials::new(low, high, count);
        let mut line = Self::of(Functions::Polynomials(family), low == high, count);
        line.mass = Mat::identity(count, count);
        line
    }

    /// The same space in a basis in which most functions couple with few others: sines, or integrated Legendre polynomials with cubics.
    pub(crate) fn with_cubics(low: Edge, high: Edge, count: usize) -> Self {
        if (low, high) == (Edge::Supported, Edge::Supported) {
            return Self::sines(count);
        }
        Self::of(Functions::Integrated(Integrated::with_cubics(low, high, count)), low == high, count)
    }

    /// The same, with functions in place of the cubics that fade within about 1/κ of the ends (on a line of length 2). The first `counts[0]` of
    /// all `counts[1]` span the space of as many. `None` if rounding errors make them dependent.
    pub(crate) fn fading(low: Edge, high: Edge, counts: [usize; 2], kappa: f64) -> Option<Self> {
        if (low, high) == (Edge::Supported, Edge::Supported) {
            return Some(Self::sines(counts[1]));
        }
        let family = Integrated::fading(low, high, counts, kappa)?;
        Some(Self::of(Functions::Integrated(family), low == high, counts[1]))
    }

    /// These functions in terms of [`Line::with_cubics`], functions x functions.
    pub(crate) fn in_cubics(&self) -> Mat<f64> {
        match &self.functions {
            Functions::Integrated(family) => family.in_cubics(),
            _ => Mat::identity(self.count(), self.count()),
        }
    }

    /// The integrals of polynomials by Gauss's rule.
    fn of(functions: Functions, symmetric: bool, count: usize) -> Self {
        let zeros = || Mat::zeros(count, count);
        let (mass, slope, curvature, mixed) = (zeros(), zeros(), zeros(), zeros());
        let mut line = Self { functions, mass, slope, curvature, mixed, symmetric };
        for (xi, weight) in gauss(count + 5) {
            let jets = line.derivatives_at(xi);
            for (j, g) in jets.iter().enumerate() {
                // Opposite parities are left at an exact zero.
                let first = if symmetric { j % 2 } else { 0 };
                for i in (first..count).step_by(1 + usize::from(symmetric)) {
                    let (f, [mass, slope, curvature, mixed]) = (&jets[i], line.couple(i, j));
                    line.mass[(i, j)] += if mass { weight * f[0] * g[0] } else { 0.0 };
                    line.slope[(i, j)] += if slope { weight * f[1] * g[1] } else { 0.0 };
                    line.curvature[(i, j)] += if curvature { weight * f[2] * g[2] } else { 0.0 };
                    line.mixed[(i, j)] += if mixed { weight * f[2] * g[0] } else { 0.0 };
                }
            }
        }
        line
    }

    /// Whether functions `i` and `j` may couple in mass, in slope, in curvature and in ∫f'' g: elsewhere rounding would leave a little.
    fn couple(&self, i: usize, j: usize) -> [bool; 4] {
        let with_all = self.coupling_with_all();
        // Without a value at an end, functions are even and odd in turn, whatever the ends.
        let alike = i.abs_diff(j).is_multiple_of(2);
        REACH.map(|reach| i < with_all || j < with_all || alike && i.abs_diff(j) <= reach)
    }

    /// Number of functions, the first, that may couple with all others; the rest couples with every second index up to 4 away.
    pub(crate) fn coupling_with_all(&self) -> usize {
        match &self.functions {
            Functions::Sines => 0,
            Functions::Polynomials(_) => self.count(),
            Functions::Integrated(family) => family.at_ends(),
        }
    }

    /// The indices of the functions with which one may couple.
    pub(crate) fn near(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        let (with_all, count) = (self.coupling_with_all(), self.count());
        let first = if index < with_all { with_all } else { index.saturating_sub(REACH[0]).max(with_all) };
        let last = if index < with_all { count } else { (index + REACH[0] + 1).min(count) };
        let alike = move |other: &usize| index < with_all || other.abs_diff(index).is_multiple_of(2);
        (0..with_all).chain((first..last).filter(alike))
    }

    /// The first `count` sines, whose integrals are diagonal.
    fn sines(count: usize) -> Self {
        let diagonal = |f: &dyn Fn(f64) -> f64| {
            Mat::from_fn(count, count, |i, j| if i == j { f((i + 1) as f64 * FRAC_PI_2) } else { 0.0 })
        };
        Self {
            functions: Functions::Sines,
            mass: Mat::identity(count, count),
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
            Functions::Integrated(family) => family.derivatives_at(xi),
        }
    }

    /// The functions of another basis in terms of these, which are orthonormal and span the same space: functions x functions of `other`.
    pub(crate) fn coordinates(&self, other: &Self) -> Mat<f64> {
        let count = self.count();
        if self.exact() {
            return Mat::identity(count, count);
        }
        let mut coordinates = Mat::zeros(count, count);
        for (xi, weight) in gauss(count + 5) {
            let (own, others) = (self.derivatives_at(xi), other.derivatives_at(xi));
            for (j, g) in others.iter().enumerate() {
                for (i, f) in own.iter().enumerate() {
                    coordinates[(i, j)] += weight * f[0] * g[0];
                }
            }
        }
        coordinates
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
            Functions::Integrated(family) => {
                let jets = family.derivatives_at(xi);
                values.iter_mut().zip(jets).for_each(|(value, jet)| *value = jet[0]);
            }
        }
    }

    /// Degree of function `n` (an index) if it is a polynomial.
    pub(crate) fn degree(&self, n: usize) -> Option<usize> {
        match &self.functions {
            Functions::Sines => None,
            Functions::Polynomials(family) => Some(family.degree(n)),
            Functions::Integrated(family) => Some(family.degree(n)),
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
            _ if self.symmetric => (0..2).map(|n| Class { first: n, step: 2, end: count }).collect(),
            _ => vec![Class { first: 0, step: 1, end: count }],
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

    /// The position of an index that the class holds.
    pub(crate) fn place(self, index: usize) -> usize {
        (index - self.first) / self.step
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
