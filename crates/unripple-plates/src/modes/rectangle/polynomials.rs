//! Orthonormal Jacobi polynomials that satisfy the essential boundary conditions.

use crate::modes::jacobi::{self, coefficients};
use unripple_core::Edge;

/// Orthonormal polynomials on [-1, 1] that meet the essential conditions at both ends:
/// f_n(ξ) = (1+ξ)^p (1-ξ)^q J_n(ξ), with J_n the Jacobi polynomials orthonormal under (1+ξ)^2p (1-ξ)^2q.
///
/// p, q = 0 for a free end, 1 for a supported one, 2 for a clamped one. They span every polynomial that may be a
/// deflection, and their mass matrix is the identity.
#[derive(Clone, Debug)]
pub(crate) struct Polynomials {
    low: i32,
    high: i32,
    /// Value of J_0, then for each n the coefficients a, b of the recurrence ξ J_n = a_{n+1} J_{n+1} + b_n
    /// J_n + a_n J_{n-1}.
    first: f64,
    recurrence: Vec<(f64, f64)>,
}

/// Order of the zero that an end imposes on the deflection: 0, 1 or 2, a number without unit.
pub(crate) fn order(edge: Edge) -> i32 {
    match edge {
        Edge::Free | Edge::Elastic { .. } => 0,
        Edge::Supported => 1,
        Edge::Clamped => 2,
    }
}

impl Polynomials {
    /// The first `count` polynomials, for a line with the edge conditions `low` at ξ = -1 and `high` at ξ = 1.
    pub(crate) fn new(low: Edge, high: Edge, count: usize) -> Self {
        let (low, high) = (order(low), order(high));
        let (alpha, beta) = (f64::from(2 * high), f64::from(2 * low));
        let recurrence = (0..=count).map(|n| coefficients(alpha, beta, n as f64)).collect();
        Self { low, high, first: 1.0 / weight_mass(2 * low, 2 * high).sqrt(), recurrence }
    }

    /// Number of polynomials.
    pub(crate) fn count(&self) -> usize {
        self.recurrence.len() - 1
    }

    /// Degree of polynomial `n`, an index.
    pub(crate) fn degree(&self, n: usize) -> usize {
        n + (self.low + self.high) as usize
    }

    /// Writes the values of all polynomials at ξ into `values`, of length [`Polynomials::count`].
    pub(crate) fn at(&self, xi: f64, values: &mut [f64]) {
        let first = self.first * (1.0 + xi).powi(self.low) * (1.0 - xi).powi(self.high);
        jacobi::values(&self.recurrence, xi, first, values);
    }

    /// Value, first and second derivative of each polynomial at ξ, by differentiating the recurrence.
    pub(crate) fn derivatives_at(&self, xi: f64) -> Vec<[f64; 3]> {
        let first = weight_jet(self.low, self.high, xi).map(|w| w * self.first);
        jacobi::jets(&self.recurrence, xi, 1.0, first)
    }
}

/// ∫(1+ξ)^p (1-ξ)^q dξ over [-1, 1] = 2^(p+q+1) p! q! / (p+q+1)!.
fn weight_mass(p: i32, q: i32) -> f64 {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    2f64.powi(p + q + 1) * factorial(p) * factorial(q) / factorial(p + q + 1)
}

/// (1+ξ)^p (1-ξ)^q and its first two derivatives.
fn weight_jet(p: i32, q: i32, xi: f64) -> [f64; 3] {
    let power = |base: f64, n: i32, sign: f64| {
        let falling = |k: i32| (0..k).map(|i| f64::from(n - i)).product::<f64>() * sign.powi(k);
        [0, 1, 2].map(|k| if n >= k { falling(k) * base.powi(n - k) } else { 0.0 })
    };
    let (f, g) = (power(1.0 + xi, p, 1.0), power(1.0 - xi, q, -1.0));
    [f[0] * g[0], f[1] * g[0] + f[0] * g[1], f[2] * g[0] + 2.0 * f[1] * g[1] + f[0] * g[2]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::legendre::gauss;

    const EDGES: [Edge; 3] = [Edge::Free, Edge::Supported, Edge::Clamped];

    #[test]
    fn orthonormal_and_held() {
        for (low, high) in EDGES.iter().flat_map(|l| EDGES.iter().map(move |h| (*l, *h))) {
            let family = Polynomials::new(low, high, 60);
            let mut gram = vec![0.0; 60 * 60];
            for (x, w) in gauss(70) {
                let mut f = vec![0.0; 60];
                family.at(x, &mut f);
                (0..3600).for_each(|i| gram[i] += w * f[i / 60] * f[i % 60]);
            }
            for (i, found) in gram.iter().enumerate() {
                let exact = f64::from(u8::from(i / 60 == i % 60));
                assert!((found - exact).abs() < 1e-12, "{low:?} {high:?} {i}: {found}");
            }
            for (xi, edge) in [(-1.0, low), (1.0, high)] {
                let jets = family.derivatives_at(xi);
                let held = order(edge) as usize;
                assert!(jets.iter().all(|jet| jet[..held].iter().all(|v| *v == 0.0)));
            }
        }
    }

    #[test]
    fn derivatives_match_differences() {
        let family = Polynomials::new(Edge::Clamped, Edge::Supported, 12);
        let (xi, d) = (0.3, 1e-5);
        let (left, here, right) =
            (family.derivatives_at(xi - d), family.derivatives_at(xi), family.derivatives_at(xi + d));
        for n in 0..12 {
            for k in 0..2 {
                let difference = (right[n][k] - left[n][k]) / (2.0 * d);
                assert!((difference - here[n][k + 1]).abs() < 1e-4 * (1.0 + here[n][k + 1].abs()));
            }
        }
    }
}
