//! Bessel functions of any order by their power series, up to a factor that does not depend on the argument.

/// A function's value and its first and second derivative.
pub type Jet = [f64; 3];

/// Γ(ν+1) 2^ν k^-ν J_ν(kr), or I_ν in place of J_ν, as a function of r: r^ν Σ (∓k²r²/4)^m / (m! (ν+1)…(ν+m)), with its derivatives by r.
/// `sign` is -1 for J and 1 for I; the order is not a negative whole number.
pub fn series(order: f64, k: f64, r: f64, sign: f64) -> Jet {
    let x = sign * 0.25 * (k * r).powi(2);
    let (mut term, mut sums) = (r.powf(order), [0.0; 3]);
    for m in 0..400 {
        let power = order + 2.0 * f64::from(m);
        sums[0] += term;
        sums[1] += term * power / r;
        sums[2] += term * power * (power - 1.0) / (r * r);
        let next = f64::from(m + 1);
        term *= x / (next * (order + next));
        if term.abs() * power * power < 1e-17 * sums[0].abs() && f64::from(m) > x.abs().sqrt() {
            break;
        }
    }
    sums
}
