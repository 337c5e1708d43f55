//! The recurrence of orthonormal Jacobi polynomials.

/// a_n and b_n of the orthonormal Jacobi recurrence for the weight (1-ξ)^α (1+ξ)^β (Gautschi, *Orthogonal Polynomials*,
/// 2004, table 1.1).
pub(super) fn coefficients(alpha: f64, beta: f64, n: f64) -> (f64, f64) {
    let sum = alpha + beta;
    let twice = 2.0 * n + sum;
    let b = if alpha == beta {
        0.0
    } else if n == 0.0 {
        (beta - alpha) / (sum + 2.0)
    } else {
        (beta * beta - alpha * alpha) / (twice * (twice + 2.0))
    };
    let a = if n == 0.0 {
        0.0
    } else if n == 1.0 {
        (4.0 * (1.0 + alpha) * (1.0 + beta) / ((sum + 2.0).powi(2) * (sum + 3.0))).sqrt()
    } else {
        (4.0 * n * (n + alpha) * (n + beta) * (n + sum) / (twice * twice * (twice * twice - 1.0))).sqrt()
    };
    (a, b)
}
