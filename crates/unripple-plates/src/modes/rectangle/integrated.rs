//! Polynomials along one side that couple with few others: Legendre polynomials integrated twice.

use super::super::legendre::gauss;
use super::polynomials::{Polynomials, order};
use unripple_core::Edge;
use unripple_linalg::{Cholesky, Mat, product, solve_lower_alone};

/// Number of cubics: those that the ends leave free come before the integrated Legendre polynomials.
const CUBICS: usize = 4;

/// Polynomials on [-1, 1] that meet the essential conditions at both ends: some with a value or a slope at an end, and many, each with
/// the second derivative of one Legendre polynomial, that have neither.
///
/// The latter, of degree k+2 ≥ 4, are h = ∬√(k+½) L_k, with a double zero at both ends, so that ∫h_i'' h_j'' = δ_ij. The integrals of
/// products of h, h' and h'' vanish unless the degrees differ by at most 4, 2 and 0: energies are sparse matrices (Shen, *SIAM J. Sci.
/// Comput.* 15, 1489, 1994; Szabó and Babuška, *Finite Element Analysis*, 1991).
///
/// The others are the cubics that the ends allow, as they are, or made orthonormal to each other and orthogonal to the h in ∫f'' g'' + κ⁴ f g,
/// so that they fade within about 1/κ of the ends. Cubics themselves all but depend on the h in ∫f g, since these can make up anything on
/// the line but the ends; with functions that fade, smooth shapes are small differences between large parts.
#[derive(Clone, Debug)]
pub(crate) struct Integrated {
    /// The cubics.
    cubics: Polynomials,
    /// Each function with values at the ends as a sum of cubics, functions x cubics …
    of_cubics: Mat<f64>,
    /// … and of integrated Legendre polynomials, functions x the first of these.
    of_others: Mat<f64>,
    /// Order of the zeros at both ends together, the least degree of a function.
    zeros: usize,
    count: usize,
}

impl Integrated {
    /// The first `count` functions for a line with the edge conditions `low` at ξ = -1 and `high` at ξ = 1, among them the cubics themselves.
    pub(crate) fn with_cubics(low: Edge, high: Edge, count: usize) -> Self {
        let zeros = (order(low) + order(high)) as usize;
        let first = (CUBICS - zeros).min(count);
        let cubics = Polynomials::new(low, high, first);
        Self { cubics, of_cubics: Mat::identity(first, first), of_others: Mat::zeros(first, 0), zeros, count }
    }

    /// The same space, with functions that fade within about 1/κ of the ends in place of the cubics (κ without unit, on a line of length 2).
    /// These are made of the first `inner` functions, and replace the cubics in their space too. `None` if rounding
    /// errors make them dependent.
    pub(crate) fn fading(low: Edge, high: Edge, [inner, count]: [usize; 2], kappa: f64) -> Option<Self> {
        let mut whole = Self::with_cubics(low, high, count);
        let first = whole.at_ends();
        let mut products = Mat::zeros(inner, inner);
        for (xi, weight) in gauss(count + 5) {
            let jets = whole.derivatives_at(xi);
            for (j, g) in jets[..inner].iter().enumerate() {
                // Between equal ends even and odd functions stay apart.
                let step = 1 + usize::from(low == high);
                for (i, f) in
                    jets[..inner].iter().enumerate().skip(if step == 2 { j % 2 } else { 0 }).step_by(step)
                {
                    products[(i, j)] += weight * (f[2] * g[2] + kappa.powi(4) * f[0] * g[0]);
                }
            }
        }
        let others = products.as_ref().submatrix(first, first, inner - first, inner - first);
        let between = products.as_ref().submatrix(first, 0, inner - first, first);
        let mut along = between.to_owned();
        Cholesky::new(others)?.solve(along.as_mut());
        let left = Mat::from_fn(first, first, |i, j| {
            let removed: f64 = along.col(i).iter().zip(between.col(j).iter()).map(|(a, b)| a * b).sum();
            products[(i, j)] - removed
        });
        let factor = Cholesky::new(left.as_ref())?;
        let mut alone = Mat::identity(first, first);
        solve_lower_alone(factor.lower(), alone.as_mut());
        whole.of_others = product((-&alone).as_ref(), along.transpose());
        whole.of_cubics = alone;
        Some(whole)
    }

    /// Number of functions with a value or a slope at an end; they come first.
    pub(crate) fn at_ends(&self) -> usize {
        self.cubics.count()
    }

    /// Degree of the space of the first `n` + 1 functions, n an index.
    pub(crate) fn degree(&self, n: usize) -> usize {
        n + self.zeros
    }

    /// These functions in terms of those with cubics, functions x functions.
    pub(crate) fn in_cubics(&self) -> Mat<f64> {
        let first = self.at_ends();
        let mut turn = Mat::identity(self.count, self.count);
        for n in 0..first {
            (0..first).for_each(|i| turn[(i, n)] = self.of_cubics[(n, i)]);
            (0..self.of_others.ncols()).for_each(|i| turn[(first + i, n)] = self.of_others[(n, i)]);
        }
        turn
    }

    /// Value, first and second derivative of each function at ξ.
    pub(crate) fn derivatives_at(&self, xi: f64) -> Vec<[f64; 3]> {
        let legendre = legendre(xi, self.count + self.zeros + 1);
        let cubics = self.cubics.derivatives_at(xi);
        let mut all = vec![[0.0; 3]; cubics.len()];
        for n in all.len()..self.count {
            let k = self.degree(n) - 2;
            let (m, scale) = (2.0 * k as f64, (k as f64 + 0.5).sqrt());
            // (2k+1) L_k is the derivative of L_{k+1} - L_{k-1}.
            let slope = (legendre[k + 1] - legendre[k - 1]) / (m + 1.0);
            let above = (legendre[k + 2] - legendre[k]) / (m + 3.0);
            let below = (legendre[k] - legendre[k - 2]) / (m - 1.0);
            all.push([(above - below) / (m + 1.0), slope, legendre[k]].map(|value| scale * value));
        }
        let (at_ends, others) = all.split_at_mut(cubics.len());
        for (n, jet) in at_ends.iter_mut().enumerate() {
            let mut add = |share: f64, other: &[f64; 3]| {
                jet.iter_mut().zip(other).for_each(|(sum, value)| *sum += share * value);
            };
            self.of_cubics.row(n).iter().zip(&cubics).for_each(|(share, cubic)| add(*share, cubic));
            self.of_others.row(n).iter().zip(others.iter()).for_each(|(share, other)| add(*share, other));
        }
        all
    }
}

/// The Legendre polynomials of degree 0 to `most` at ξ.
fn legendre(xi: f64, most: usize) -> Vec<f64> {
    let mut values = vec![1.0, xi];
    for n in 1..most {
        let m = n as f64;
        values.push(((2.0 * m + 1.0) * xi * values[n] - m * values[n - 1]) / (m + 1.0));
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    const EDGES: [Edge; 3] = [Edge::Free, Edge::Supported, Edge::Clamped];
    const COUNT: usize = 40;

    /// The largest of all integrals of the products of derivatives `d` whose degrees differ by more than `reach`.
    fn beyond(family: &Integrated, d: [usize; 2], reach: usize) -> f64 {
        let mut sums = vec![0.0; COUNT * COUNT];
        for (x, w) in gauss(COUNT + 5) {
            let jets = family.derivatives_at(x);
            (0..COUNT * COUNT).for_each(|i| sums[i] += w * jets[i / COUNT][d[0]] * jets[i % COUNT][d[1]]);
        }
        let far = |i: &usize| (i / COUNT).abs_diff(i % COUNT) > reach;
        (0..COUNT * COUNT).filter(far).map(|i| sums[i].abs()).fold(0.0, f64::max)
    }

    #[test]
    fn only_neighbours_couple() {
        for (low, high) in EDGES.iter().flat_map(|l| EDGES.iter().map(move |h| (*l, *h))) {
            let family = Integrated::with_cubics(low, high, COUNT);
            assert!(beyond(&family, [0, 0], 4) < 1e-13 && beyond(&family, [1, 1], 2) < 1e-12);
            assert!(beyond(&family, [2, 0], 2) < 1e-12);
            // The two cubics with curvature alone may couple.
            assert!(beyond(&family, [2, 2], 1) < 1e-11, "{low:?} {high:?}");
        }
    }

    #[test]
    fn derivatives_match_differences_and_ends_are_held() {
        for (low, high) in EDGES.iter().flat_map(|l| EDGES.iter().map(move |h| (*l, *h))) {
            let family = Integrated::fading(low, high, [12; 2], 4.0).unwrap();
            let d = 1e-5;
            let [left, here, right] = [-d, 0.0, d].map(|off| family.derivatives_at(0.3 + off));
            for n in 0..12 {
                for k in 0..2 {
                    let difference = (right[n][k] - left[n][k]) / (2.0 * d);
                    assert!((difference - here[n][k + 1]).abs() < 1e-7 * (1.0 + here[n][k + 1].abs()));
                }
            }
            for (xi, edge) in [(-1.0, low), (1.0, high)] {
                let held = order(edge) as usize;
                let jets = family.derivatives_at(xi);
                assert!(jets.iter().all(|jet| jet[..held].iter().all(|v| v.abs() < 1e-15)));
            }
        }
    }
}
