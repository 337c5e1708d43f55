//! The recurrence of orthonormal Jacobi polynomials.

/// Writes the values of a first function times each polynomial at `x` into `values`, from the function's value there and the coefficients
/// of the recurrence.
pub(super) fn values(recurrence: &[(f64, f64)], x: f64, first: f64, values: &mut [f64]) {
    let (mut below, mut value) = (0.0, first);
    for (n, slot) in values.iter_mut().enumerate() {
        *slot = value;
        let ((a, b), (next, _)) = (recurrence[n], recurrence[n + 1]);
        (below, value) = (value, ((x - b) * value - a * below) / next);
    }
}

/// Value, first and second derivative of a first function times each polynomial but the last at `x`, by differentiating the recurrence.
/// `rate` is the derivative of `x` by the variable in question.
pub(super) fn jets(recurrence: &[(f64, f64)], x: f64, rate: f64, first: [f64; 3]) -> Vec<[f64; 3]> {
    let (mut below, mut jet) = ([0.0; 3], first);
    let mut all = Vec::with_capacity(recurrence.len());
    for pair in recurrence.windows(2) {
        all.push(jet);
        let [(a, b), (next, _)] = [pair[0], pair[1]];
        let above = [
            ((x - b) * jet[0] - a * below[0]) / next,
            ((x - b) * jet[1] + rate * jet[0] - a * below[1]) / next,
            ((x - b) * jet[2] + 2.0 * rate * jet[1] - a * below[2]) / next,
        ];
        (below, jet) = (jet, above);
    }
    all
}

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
