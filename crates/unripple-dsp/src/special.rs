//! Special functions and the Kaiser window.

use std::f64::consts::PI;

/// The normalised sinc function sin(πt)/(πt) of a dimensionless t, 1 at 0: the ideal interpolation kernel for samples at
/// unit distance (Shannon, *Communication in the presence of noise*, 1949, theorem 1).
pub fn sinc(t: f64) -> f64 {
    // For smaller arguments it is 1 to the last digit.
    if t.abs() < 1e-9 { 1.0 } else { (PI * t).sin() / (PI * t) }
}

/// The Kaiser window of shape parameter `beta`, where `u` is the distance from its middle over its half-width, both
/// dimensionless: 1 at the middle, 0 for |u| > 1 (Kaiser and Schafer, *On the use of the I0-sinh window for spectrum
/// analysis*, 1980).
pub fn kaiser(u: f64, beta: f64) -> f64 {
    if u.abs() > 1.0 { 0.0 } else { bessel_i0(beta * (1.0 - u * u).sqrt()) / bessel_i0(beta) }
}

/// The modified Bessel function I_0 of a dimensionless `x`, used in the Kaiser window, by its power series (Abramowitz and
/// Stegun, *Handbook of Mathematical Functions*, 9.6.12).
pub fn bessel_i0(x: f64) -> f64 {
    let quarter = x * x / 4.0;
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    // Terms below the rounding of the sum change nothing.
    while term > sum * 1e-17 {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

/// The Bessel function of the first kind J_n of order n = `order` and a dimensionless `x`, to nearly full double precision (from
/// the `libm` crate).
///
/// ```
/// // Abramowitz and Stegun, table 9.1.
/// assert!((unripple_dsp::bessel_j(1, 10.0) - 0.043_472_746_168_861_4).abs() < 1e-15);
/// ```
pub fn bessel_j(order: u32, x: f64) -> f64 {
    match order {
        0 => libm::j0(x),
        1 => libm::j1(x),
        _ => libm::jn(order.min(i32::MAX as u32) as i32, x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// J_n(x) = 1/π ∫ cos(nθ - x sin θ) dθ over 0 … π (Abramowitz and Stegun, 9.1.21), by the trapezoidal rule, which converges faster than
    /// any power once there are more steps than x.
    fn integral(order: u32, x: f64) -> f64 {
        let steps = 64 + 2 * x.abs() as usize;
        let value = |i: usize| {
            let angle = PI * i as f64 / steps as f64;
            (f64::from(order) * angle - x * angle.sin()).cos()
        };
        let inner: f64 = (1..steps).map(value).sum();
        (inner + 0.5 * (value(0) + value(steps))) / steps as f64
    }

    #[test]
    fn bessel_functions_are_their_integrals() {
        for order in 0..4 {
            for i in -50..500 {
                let x = 0.37 * f64::from(i);
                let (found, exact) = (bessel_j(order, x), integral(order, x));
                assert!((found - exact).abs() < 1e-13, "J{order}({x}): {found} {exact}");
            }
        }
    }

    #[test]
    fn i0_agrees_with_tables() {
        // Abramowitz and Stegun, table 9.8.
        assert!((bessel_i0(1.0) - 1.266_065_877_752_008_4).abs() < 1e-15);
        assert!((bessel_i0(5.0) / 27.239_871_823_604_44 - 1.0).abs() < 1e-14);
    }
}
