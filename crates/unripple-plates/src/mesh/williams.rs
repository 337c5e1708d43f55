//! Exponents of the singularity of a bent plate at a corner (Williams, *J. Appl. Mech.* 19, 526, 1952).

use std::f64::consts::PI;
use unripple_core::Edge;
use unripple_linalg::c64;

/// Poisson's ratio assumed at free edges, a common value: the exponents depend little on it.
const POISSON: f64 = 0.3;
/// Exponents within this of a whole number count as whole: the solution is then a polynomial, which
/// elements represent exactly. Above the error of Newton's method, 1e-9.
const WHOLE: f64 = 1e-5;
/// Spacing of the starting points of Newton's method, along the real and the imaginary axis. With twice
/// this value, two neighbours may converge to the same root and miss one between them.
const STEP: [f64; 2] = [0.1, 0.4];
/// Number of starting points along the imaginary axis, up to 1.2. More find roots that oscillate faster.
const ROWS: u32 = 4;

/// The least positive real part, below `most`, of z (not a whole number) for which a deflection r^(z + 1) satisfies the
/// biharmonic equation in a wedge of some angle (rad) and the conditions at both its edges. Infinite if there is none.
/// Springs at an edge change only smoother parts of the solution.
pub(super) fn exponent(angle: f64, edges: [Edge; 2], most: f64) -> f64 {
    if edges == [Edge::Supported; 2] {
        return supported(angle, most);
    }
    let (mut best, mut from) = (f64::INFINITY, 0.5 * STEP[0]);
    while from < most && from < best + 2.0 * STEP[0] {
        for i in 0..ROWS {
            if let Some(z) = root(angle, edges, c64::new(from, f64::from(i) * STEP[1])) {
                let whole = z.im.abs() < WHOLE && (z.re - z.re.round()).abs() < WHOLE;
                // At z = 0 the deflection is a rigid rotation.
                if z.re > 0.01 && z.re < best && !whole {
                    best = z.re;
                }
            }
        }
        from += STEP[0];
    }
    if best < most { best } else { f64::INFINITY }
}

/// The least exponent between supported edges, from the solutions r^(kπ/α) sin(kπθ/α) and r² times that.
fn supported(angle: f64, most: f64) -> f64 {
    let powers = (-32..=32).flat_map(|k| [f64::from(k) * PI / angle - 1.0, f64::from(k) * PI / angle + 1.0]);
    let singular = powers.filter(|z| *z > WHOLE && *z < most && (z - z.round()).abs() > WHOLE);
    singular.fold(f64::INFINITY, f64::min)
}

/// The root to which Newton's method converges from a starting point.
fn root(angle: f64, edges: [Edge; 2], from: c64) -> Option<c64> {
    // Half the step of a central difference: its error is 1e-10, that of rounding 1e-11.
    const D: f64 = 1e-5;
    let f = |z: c64| determinant(angle, edges, z);
    let mut z = from;
    for _ in 0..40 {
        let slope = (f(z + D) - f(z - D)) / (2.0 * D);
        let step = f(z) / slope;
        if !step.norm().is_finite() {
            return None;
        }
        // Short steps keep Newton's method near the place it started from.
        z -= step * (0.3 / step.norm()).min(1.0);
        if (z - from).norm() > 1.0 {
            return None;
        }
        if step.norm() < 1e-9 {
            return Some(z);
        }
    }
    None
}

/// The determinant that vanishes if the conditions at both edges can be satisfied.
fn determinant(angle: f64, edges: [Edge; 2], z: c64) -> c64 {
    let [a, b] = conditions(edges[0], z, 0.0);
    let [c, d] = conditions(edges[1], z, angle);
    let minor = |u: &[c64; 4], v: &[c64; 4], i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
    // Laplace's expansion by pairs of rows.
    const PAIRS: [([usize; 4], f64); 6] = [
        ([0, 1, 2, 3], 1.0),
        ([0, 2, 1, 3], -1.0),
        ([0, 3, 1, 2], 1.0),
        ([1, 2, 0, 3], 1.0),
        ([1, 3, 0, 2], -1.0),
        ([2, 3, 0, 1], 1.0),
    ];
    PAIRS
        .iter()
        .map(|([i, j, k, l], sign)| minor(&a, &b, *i, *j) * minor(&c, &d, *k, *l) * *sign)
        .fold(c64::new(0.0, 0.0), |sum, term| sum + term)
}

/// Two linear conditions on the coefficients of cos mθ, (sin mθ)/m, cos kθ and (sin kθ)/k, m = z + 1 and k = z - 1, at an
/// edge in the direction θ.
fn conditions(edge: Edge, z: c64, theta: f64) -> [[c64; 4]; 2] {
    let (m, one) = (z + 1.0, c64::new(1.0, 0.0));
    // Value and three derivatives by θ.
    let pair = |n: c64| {
        let (s, c) = ((n * theta).sin(), (n * theta).cos());
        let sinc = if n.norm() < 1e-7 { one * theta } else { s / n };
        [[c, -n * s, -n * n * c, n * n * n * s], [sinc, c, -n * s, -n * n * c]]
    };
    let ([a, b], [c, d]) = (pair(m), pair(z - 1.0));
    let row = |weights: [c64; 4]| {
        [a, b, c, d].map(|f| f[0] * weights[0] + f[1] * weights[1] + f[2] * weights[2] + f[3] * weights[3])
    };
    let zero = c64::new(0.0, 0.0);
    match edge {
        Edge::Clamped => [row([one, zero, zero, zero]), row([zero, one, zero, zero])],
        Edge::Supported => [row([one, zero, zero, zero]), row([zero, zero, one, zero])],
        Edge::Free | Edge::Elastic { .. } => {
            let moment = m + m * (m - 1.0) * POISSON;
            let force = m * m + (m - 1.0) * (m - 2.0) * (1.0 - POISSON);
            [row([moment, zero, one, zero]), row([zero, force, zero, one])]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Edge::{Clamped, Free, Supported};

    /// Williams's equations, zero at the powers z; multiplied out.
    fn residual(angle: f64, z: c64, edges: [Edge; 2]) -> c64 {
        let (nu, a) = (POISSON, angle.sin());
        let (s, double, za) = ((z * angle).sin(), (z * (2.0 * angle)).sin(), z * a);
        match edges {
            [Clamped, Clamped] => s * s - za * za,
            [Free, Free] => s * s * (3.0 + nu).powi(2) - za * za * (1.0 - nu).powi(2),
            [Clamped, Supported] => double - z * (2.0 * angle).sin(),
            [Clamped, Free] => s * s * ((3.0 + nu) * (1.0 - nu)) + za * za * (1.0 - nu).powi(2) - 4.0,
            _ => double * (3.0 + nu) + z * ((1.0 - nu) * (2.0 * angle).sin()),
        }
    }

    /// The least real part below `most` of a root of Williams's equations, by Newton's method from a fine lattice of starts.
    fn closed(angle: f64, edges: [Edge; 2], most: f64) -> f64 {
        let f = |z: c64| residual(angle, z, edges);
        let mut best = f64::INFINITY;
        for i in 0..(most / 0.02) as u32 {
            for j in 0..60 {
                let mut z = c64::new(0.02 * f64::from(i), 0.03 * f64::from(j));
                for _ in 0..60 {
                    z -= f(z) * 2e-6 / (f(z + 1e-6) - f(z - 1e-6));
                }
                let whole = z.im.abs() < 1e-4 && (z.re - z.re.round()).abs() < 1e-4;
                if f(z).norm() < 1e-9 && z.re > 0.01 && z.re < best && !whole {
                    best = z.re;
                }
            }
        }
        if best < most { best } else { f64::INFINITY }
    }

    #[test]
    fn powers_are_those_of_williams_equations() {
        for edges in [[Clamped; 2], [Free; 2], [Clamped, Supported], [Clamped, Free], [Supported, Free]] {
            for degrees in [60.0_f64, 90.0, 135.0, 180.0, 215.0, 270.0, 330.0, 358.0] {
                let (angle, most) = (degrees.to_radians(), 2.0);
                let (found, expected) = (exponent(angle, edges, most), closed(angle, edges, most));
                let same = found == expected || (found - expected).abs() < 1e-6;
                assert!(same, "{edges:?} {degrees}: {found} {expected}");
                let turned = exponent(angle, [edges[1], edges[0]], most);
                assert!(
                    turned == found || (turned - found).abs() < 1e-6,
                    "{edges:?} {degrees}: {turned} {found}"
                );
            }
        }
    }

    #[test]
    fn published_powers() {
        let at = |degrees: f64, edges| exponent(degrees.to_radians(), edges, 3.0);
        assert!((at(270.0, [Clamped; 2]) - 0.544_483_736_782_464).abs() < 1e-9);
        assert!((at(359.999, [Clamped; 2]) - 0.5).abs() < 1e-4);
        assert!((at(180.0, [Clamped, Free]) - 0.5).abs() < 1e-9);
        assert!((at(180.0, [Clamped, Supported]) - 0.5).abs() < 1e-9);
        assert!((at(270.0, [Supported; 2]) - 1.0 / 3.0).abs() < 1e-12);
        assert!((at(120.0, [Supported; 2]) - 0.5).abs() < 1e-12);
        assert_eq!(at(90.0, [Supported; 2]), f64::INFINITY);
    }
}
