//! Gauss-Legendre quadrature: nodes and weights by Newton's method.

use std::f64::consts::PI;

/// Nodes and weights of Gauss-Legendre quadrature on [-1, 1], `count` pairs (node, weight), exact for polynomials of degree
/// 2·`count` - 1.
///
/// Nodes are the zeros of the Legendre polynomial, by Newton's method from a cosine estimate (Davis and Rabinowitz, *Methods of
/// Numerical Integration*, 1984).
pub fn gauss(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let mut rule: Vec<(f64, f64)> = (0..count)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            for _ in 0..100 {
                let (p, slope) = legendre(count, x);
                let step = p / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            let (_, slope) = legendre(count, x);
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect();
    rule.reverse();
    rule
}

/// The Legendre polynomial P_n and its derivative at |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut below, mut p) = (0.0, 1.0);
    for k in 1..=n {
        let k = k as f64;
        (below, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * below) / k);
    }
    (p, n as f64 * (x * p - below) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::gauss;

    #[test]
    fn integrates_powers_exactly() {
        for count in [1, 2, 5, 40, 300] {
            let rule = gauss(count);
            for power in (0..2 * count as i32).step_by(1 + count / 4) {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(power)).sum();
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-13, "{count} {power}: {sum} {exact}");
            }
        }
    }
}
