//! Functions of the radius for one angular order.

use super::super::jacobi::{self, coefficients};

/// Functions f of ξ = r/a on [0, 1] for deflections f(ξ) cos nθ: f_j = ξ^n (1-ξ²)^p J_j(2ξ²-1), with J_j the Jacobi polynomials for which
/// ∫f_i f_j ξ dξ = δ_ij (for p = 0 the radial parts of Zernike's polynomials; Zernike, *Physica* 1, 689, 1934).
///
/// p is the order of the zero at the rim: 0, 1 or 2. They span every polynomial in x and y of this angular order that may be a deflection.
#[derive(Clone, Debug)]
pub(super) struct Radial {
    /// Angular order n.
    pub(super) order: usize,
    zeros: i32,
    first: f64,
    recurrence: Vec<(f64, f64)>,
}

/// A function at one radius, and what its energy is made of.
pub(super) struct Jet {
    /// f.
    pub(super) value: f64,
    /// f'.
    pub(super) slope: f64,
    /// n f/ξ.
    pub(super) around: f64,
    /// f''.
    pub(super) curvature: f64,
    /// f'/ξ - n² f/ξ², the curvature along the circle.
    pub(super) across: f64,
    /// n (f'/ξ - f/ξ²).
    pub(super) twist: f64,
}

impl Radial {
    /// The first `count` functions of angular order `order`, with a zero of order `zeros` at the rim.
    pub(super) fn new(order: usize, zeros: i32, count: usize) -> Self {
        let (n, twice) = (order as f64, 2 * zeros);
        // √(2 (n+2p+1)! / (n! (2p)!)).
        let ratio: f64 = (1..=twice + 1).map(|i| n + f64::from(i)).product();
        let factorial: f64 = (1..=twice).map(f64::from).product();
        let recurrence = (0..=count).map(|j| coefficients(f64::from(twice), n, j as f64)).collect();
        Self { order, zeros, first: (2.0 * ratio / factorial).sqrt(), recurrence }
    }

    /// Number of functions.
    pub(super) fn count(&self) -> usize {
        self.recurrence.len() - 1
    }

    /// Writes the values of all functions at ξ into `values`, of length [`Radial::count`].
    pub(super) fn at(&self, xi: f64, values: &mut [f64]) {
        let (s, n) = (xi * xi, self.order as i32);
        let first = self.first * xi.powi(n) * (1.0 - s).powi(self.zeros);
        jacobi::values(&self.recurrence, 2.0 * s - 1.0, first, values);
    }

    /// h, h_s and h_ss of each function f = ξ^n h(ξ²).
    fn polynomials(&self, s: f64) -> Vec<[f64; 3]> {
        let (p, rest) = (self.zeros, 1.0 - s);
        let weight = [
            rest.powi(p),
            if p >= 1 { -f64::from(p) * rest.powi(p - 1) } else { 0.0 },
            if p >= 2 { f64::from(p * (p - 1)) * rest.powi(p - 2) } else { 0.0 },
        ];
        jacobi::jets(&self.recurrence, 2.0 * s - 1.0, 2.0, weight.map(|w| w * self.first))
    }

    /// Each function at ξ, with no division by small radii.
    pub(super) fn jets(&self, xi: f64) -> Vec<Jet> {
        let (n, s) = (self.order as f64, xi * xi);
        let power = |k: i32| xi.powi(self.order as i32 + k);
        let lower = if self.order > 0 { n * power(-1) } else { 0.0 };
        let lowest = if self.order > 1 { n * (n - 1.0) * power(-2) } else { 0.0 };
        let jet = |[h, first, second]: [f64; 3]| Jet {
            value: power(0) * h,
            slope: lower * h + 2.0 * power(1) * first,
            around: lower * h,
            curvature: lowest * h + (4.0 * n + 2.0) * power(0) * first + 4.0 * power(2) * second,
            across: -lowest * h + 2.0 * power(0) * first,
            twist: lowest * h + 2.0 * n * power(0) * first,
        };
        self.polynomials(s).into_iter().map(jet).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::legendre::gauss;

    #[test]
    fn functions_are_orthonormal_and_held() {
        for (order, zeros) in [(0, 0), (1, 0), (2, 1), (7, 2), (40, 2), (300, 0)] {
            let radial = Radial::new(order, zeros, 40);
            let mut gram = vec![0.0; 1600];
            for (t, weight) in gauss(50 + order / 2) {
                let mut f = vec![0.0; 40];
                radial.at((0.5 * (1.0 + t)).sqrt(), &mut f);
                (0..1600).for_each(|i| gram[i] += 0.25 * weight * f[i / 40] * f[i % 40]);
            }
            for (i, found) in gram.iter().enumerate() {
                let exact = f64::from(u8::from(i / 40 == i % 40));
                assert!((found - exact).abs() < 1e-11, "order {order}, {zeros} zeros, {i}: {found}");
            }
            let rim = radial.jets(1.0);
            assert!(rim.iter().all(|jet| (zeros < 1 || jet.value == 0.0) && (zeros < 2 || jet.slope == 0.0)));
        }
    }

    #[test]
    fn jets_are_the_differences_of_values() {
        for (order, zeros) in [(0, 2), (1, 1), (2, 0), (9, 2)] {
            let radial = Radial::new(order, zeros, 9);
            let (n, xi, d) = (order as f64, 0.6, 1e-4);
            let value = |xi: f64| {
                let mut values = vec![0.0; 9];
                radial.at(xi, &mut values);
                values
            };
            let [left, here, right] = [value(xi - d), value(xi), value(xi + d)];
            for (j, jet) in radial.jets(xi).iter().enumerate() {
                let f = here[j];
                let slope = (right[j] - left[j]) / (2.0 * d);
                let curvature = (right[j] - 2.0 * f + left[j]) / (d * d);
                let along = [f, slope, n * f / xi, curvature];
                let across = [slope / xi - n * n * f / (xi * xi), n * (slope / xi - f / (xi * xi))];
                let found = [jet.value, jet.slope, jet.around, jet.curvature, jet.across, jet.twist];
                for (exact, found) in along.into_iter().chain(across).zip(found) {
                    assert!(
                        (exact - found).abs() < 1e-4 * (1.0 + found.abs()),
                        "{order} {j}: {exact} {found}"
                    );
                }
            }
        }
    }
}
