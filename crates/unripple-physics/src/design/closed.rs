//! Closed forms for the contrast, spot and pulse of time-reversed focusing.
//!
//! Symbols: N actuators, bandwidth B, M modes in it, n̄ = M/B modes per hertz (the Heisenberg time), decay time τ of the
//! amplitude, window T. Contrast is the focal velocity over the rms velocity outside the focal disc at the focal instant.
//!
//! Derivation: mode m decays as g_m(t) ≈ e^{-t/τ} cos ω_m t, and its shape is φ_m. Time reversal of the
//! responses at A leaves at time T the amplitude Σ_n W_mn I_mn φ_n(A) of mode m, with W_mn = Σ_a φ_m(a) φ_n(a) and
//! I_mn = ∫_0^T g_m g_n dt. Its diagonal is the focus. Pairs of neighbouring modes that T does not resolve leak into
//! each other: by Parseval Σ_n I_mn² = (n̄/8) ∫_0^T e^{-4t/τ} dt, of random sign for each actuator, hence a variance
//! coth(T/τ)/2NBτ relative to the square of the peak. The gains W_mm vary by 2/N for Gaussian mode shapes, hence
//! 2/NM. The last part, e/M, comes from the side lobes of a perfect focus 2J_1(kr)/kr outside the disc.
//!
//! ```
//! use unripple_physics::design::closed;
//!
//! let (bandwidth, decay_time, modes) = (3000.0, 0.070, 306.0);
//! let contrast = closed::contrast(8.0, bandwidth, decay_time, 0.030, modes);
//! assert!((contrast - 23.6).abs() < 0.1);
//! ```

use std::f64::consts::{PI, TAU};
use unripple_core::FOCAL_RADIUS;
use unripple_dsp::bessel_j;

/// Effective window τ tanh(T/τ) of a window T and a decay time τ, all in s: about T if T ≪ τ, about τ if T ≫ τ.
pub fn effective_window(window: f64, decay_time: f64) -> f64 {
    if decay_time.is_finite() { decay_time * (window / decay_time).tanh() } else { window }
}

/// Contrast C_TR of time reversal, a ratio, without the side lobes of the focus: C_TR² = 2NBτ/(coth(T/τ) +
/// 4τ/n̄) for N `actuators`, `bandwidth` B in Hz, `decay_time` τ and `window` T in s, and n̄ = M/B with M
/// `modes`.
///
/// The limits of C_TR² are 2NBT for short windows (the √(NT) law of section 3.1 of the paper, with its constant), 2NBτ for long
/// windows and NM/2 for long decay.
pub fn contrast_tr(actuators: f64, bandwidth: f64, decay_time: f64, window: f64, modes: f64) -> f64 {
    let reach = effective_window(window, decay_time);
    let heisenberg = modes / bandwidth;
    (2.0 * actuators * bandwidth * reach / (1.0 + 4.0 * reach / heisenberg)).sqrt()
}

/// Contrast C of time reversal, a ratio, with the side lobes of the focus outside the focal disc: 1/C² =
/// 1/C_TR² + e/M, with C_TR of [`contrast_tr`] (B in Hz, τ and T in s), M `modes` and the share e of the
/// focus's energy outside the disc ([`exposure`]).
pub fn contrast(actuators: f64, bandwidth: f64, decay_time: f64, window: f64, modes: f64) -> f64 {
    let noise = contrast_tr(actuators, bandwidth, decay_time, window, modes).powi(-2);
    (noise + exposure(TAU * FOCAL_RADIUS) / modes).powf(-0.5)
}

/// Contrast, a ratio, of each of `foci` equal simultaneous foci, given the contrast of a single focus: the
/// backgrounds add in power, so that contrast falls as 1/√foci.
pub fn foci(contrast: f64, foci: f64) -> f64 {
    contrast / foci.sqrt()
}

/// Contrast of a focus repeated every `period` T_r (s), in the simplest form: 1/C² = q/C_TR² + e/M +
/// (q-1)/2M with q = coth(T_r/τ), C_TR of [`contrast_tr`] (B in Hz, τ and T in s), and e and M as in
/// [`contrast`].
///
/// This form counts all later pulses as complete, and adds the echoes of earlier and later pulses in power. [`super::Cavity::repeated`]
/// is more accurate.
pub fn repeated(
    actuators: f64,
    bandwidth: f64,
    decay_time: f64,
    window: f64,
    modes: f64,
    period: f64,
) -> f64 {
    let q = 1.0 / (period / decay_time).tanh();
    let noise = contrast_tr(actuators, bandwidth, decay_time, window, modes).powi(-2);
    (q * noise + exposure(TAU * FOCAL_RADIUS) / modes + (q - 1.0) / (2.0 * modes)).powf(-0.5)
}

/// The part of 1/C² that noise adds, dimensionless: r²/2NBT, with r the rms of the noise over that of a response, both in
/// the band (B in Hz) and over the window (T in s).
///
/// The drive is a matched filter: white noise of density r² h²_rms/2B on each of N responses of energy T h²_rms reaches
/// the surface through these responses with the variance N (r² h²_rms/2B) T h²_rms, while the peak is N T h²_rms. It is the same
/// for noise in the recording and in the emission.
pub fn noise_share(actuators: f64, bandwidth: f64, window: f64, ratio: f64) -> f64 {
    ratio * ratio / (2.0 * actuators * bandwidth * window)
}

/// Share e = J_0²(x) + J_1²(x) of the energy of a focus 2J_1(kr)/kr that lies beyond the radius r = x/k;
/// about 2/πx for large x.
pub fn exposure(x: f64) -> f64 {
    bessel_j(0, x).powi(2) + bessel_j(1, x).powi(2)
}

/// Full width at half maximum of a focus of a single frequency, J_0(kr): 0.484 times its wavelength, in metres.
pub fn spot_of_one_frequency(wavelength: f64) -> f64 {
    // J_0(x) is a half at x = 1.521.
    wavelength * 1.521_0 / PI
}

/// Full width at half maximum of a focus whose spectrum fills the wavenumber plane evenly up to 2π/λ_min, 2J_1(kr)/kr: 0.705 λ_min,
/// in metres.
pub fn spot_diameter(lambda_min: f64) -> f64 {
    // 2J_1(x)/x is a half at x = 2.2151.
    lambda_min * 2.215_1 / PI
}

/// Full width at half maximum in time of a focus with a band from 0 to B (Hz), for a mode density that grows as f^p
/// (`growth`), in seconds.
///
/// The velocity at the focus is ∫_0^1 s^p cos(ys) ds with y = 2πBt. It falls to half its peak at y = 1.5069 for p = 1
/// (membranes), a width of 0.480/B, and at y = 1.8955 for p = 0 (plates), a width of 0.603/B.
pub fn pulse_duration(bandwidth: f64, growth: f64) -> f64 {
    let (mut low, mut high) = (0.0, PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if pulse_at(middle, growth) > 0.5 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high / (PI * bandwidth)
}

/// (p+1) ∫_0^1 s^p cos(ys) ds by its power series Σ (-y²)^j (p+1) / (2j)! (p+1+2j), which converges fast up to y = π.
fn pulse_at(y: f64, growth: f64) -> f64 {
    let (mut sum, mut term) = (0.0, 1.0);
    for j in 0..30 {
        let order = 2.0 * f64::from(j);
        sum += term * (growth + 1.0) / (growth + 1.0 + order);
        term *= -y * y / ((order + 1.0) * (order + 2.0));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrast_has_its_three_limits() {
        let (n, b, m) = (4.0, 3000.0, 300.0);
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 2e-3, "{a} {b}");
        close(contrast_tr(n, b, 1.0, 1e-5, 1e9).powi(2), 2.0 * n * b * 1e-5);
        close(contrast_tr(n, b, 0.01, 10.0, 1e9).powi(2), 2.0 * n * b * 0.01);
        close(contrast_tr(n, b, 1e5, 1e5, m).powi(2), n * m / 2.0);
        assert_eq!(contrast_tr(n, b, f64::INFINITY, 1e5, m), contrast_tr(n, b, f64::INFINITY, 1e5, m));
    }

    #[test]
    fn spots_are_half_high_at_half_their_width() {
        let x = PI * spot_of_one_frequency(1.0);
        assert!((bessel_j(0, x) - 0.5).abs() < 1e-4);
        let x = PI * spot_diameter(1.0);
        assert!((2.0 * bessel_j(1, x) / x - 0.5).abs() < 1e-4);
    }

    #[test]
    fn pulses_are_half_high_at_half_their_width() {
        let y = PI * pulse_duration(1.0, 0.0);
        assert!((y.sin() / y - 0.5).abs() < 1e-9);
        let y = PI * pulse_duration(1.0, 1.0);
        assert!((2.0 * (y.sin() / y - (1.0 - y.cos()) / (y * y)) - 0.5).abs() < 1e-9);
    }

    #[test]
    fn exposure_is_the_energy_outside() {
        // ∫_x^∞ (2J_1(r)/r)² r dr against ∫_0^∞ = 2, by the midpoint rule.
        let (start, end, steps) = (TAU * FOCAL_RADIUS, 4000.0, 400_000);
        let width = (end - start) / f64::from(steps);
        let tail: f64 = (0..steps)
            .map(|i| start + (f64::from(i) + 0.5) * width)
            .map(|r| {
                let asymptotic =
                    (2.0 / (PI * r)).sqrt() * ((r - 0.75 * PI).cos() - 0.375 / r * (r - 0.75 * PI).sin());
                4.0 * asymptotic * asymptotic / r * width
            })
            .sum();
        let beyond = 4.0 / (PI * end);
        assert!((exposure(start) - (tail + beyond) / 2.0).abs() < 1e-4);
    }
}
