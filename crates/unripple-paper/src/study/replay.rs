//! Time reversal in modal coordinates: the matrix from recorded to focused amplitudes.

use unripple_core::{Pole, window_samples};
use unripple_linalg::{Accum, Mat, MatRef, Scale, all_threads, c64, multiply};

/// Velocity of every mode at the focal instant after a time-reversed response is played:
/// `I_mn = Σ_i heard_m[i] g_n[i] / rate`.
///
/// The response is a sum of g_n, the velocities of the modes after an impulse; `heard_m[i]` is the velocity of mode m
/// that is left at the focal instant by an impulse i samples earlier: g_m for one pulse, the sum over all earlier
/// pulses for a repeated one. The matrix is kept as a product of two factors where that is cheaper to apply.
#[derive(Clone, Debug)]
pub struct Replay(Form);

#[derive(Clone, Debug)]
enum Form {
    Whole(Mat<f64>),
    Factors { heard: Mat<f64>, rings: Mat<f64> },
}

impl Replay {
    /// Time reversal of a single pulse with a window (s), at `rate` samples per second.
    pub fn once(poles: &[Pole], rate: f64, window: f64) -> Self {
        let rings = rings(poles, rate, window_samples(window, rate));
        Self::of(rings.clone(), rings, rate)
    }

    /// Time reversal of a single pulse with a window (s). The computing time does not depend on the window,
    /// since the sums over samples are computed in closed form. For modes that oscillate (σ < ω) or have ω
    /// = 0.
    ///
    /// g_m = Re a_m z_m^i, so that I_mn = ½ Re Σ_i (a_m a_n (z_m z_n)^i + a_m a_n* (z_m z_n*)^i), two geometric series.
    pub fn of_any_length(poles: &[Pole], rate: f64, window: f64) -> Self {
        let terms = window_samples(window, rate) as f64 + 1.0;
        let swings: Vec<(c64, c64)> = poles.iter().map(|pole| phasor(*pole)).collect();
        let whole = Mat::from_fn(poles.len(), poles.len(), |m, n| {
            let ((a, s), (b, r)) = (swings[m], swings[n]);
            let sum = a * b * geometric((s + r) / rate, terms)
                + a * b.conj() * geometric((s + r.conj()) / rate, terms);
            sum.re / (2.0 * rate)
        });
        Self(Form::Whole(whole))
    }

    /// Time reversal of a pulse repeated every `period` seconds in the steady state, with a window (s), at
    /// `rate` samples per second.
    ///
    /// The earlier pulses have left the state Σ_k P^k = (1 - P)⁻¹ of an impulse, P the propagator over a period, and
    /// one more begins every period.
    pub fn repeated(poles: &[Pole], rate: f64, window: f64, period: f64) -> Self {
        let (last, step) = (window_samples(window, rate), window_samples(period, rate).max(1));
        let mut heard = Mat::zeros(last + 1, poles.len());
        for (m, pole) in poles.iter().enumerate() {
            let [[a, b], [c, d]] = pole.step(step as f64 / rate);
            let determinant = (1.0 - a) * (1.0 - d) - b * c;
            let (mut u, mut v) = (b / determinant, (1.0 - a) / determinant);
            let [[a, b], [c, d]] = pole.step(1.0 / rate);
            for i in 0..=last {
                if i > 0 {
                    (u, v) = (a * u + b * v, c * u + d * v);
                    v += f64::from(i % step == 0);
                }
                heard[(i, m)] = v;
            }
        }
        Self::of(heard, rings(poles, rate, last), rate)
    }

    /// Multiplies the matrix I (modes x modes) of time reversal by a matrix with one row per mode.
    pub fn apply(&self, columns: MatRef<'_, f64>) -> Mat<f64> {
        match &self.0 {
            Form::Whole(map) => product(map.as_ref(), columns),
            Form::Factors { heard, rings } => {
                product(heard.transpose(), product(rings.as_ref(), columns).as_ref())
            }
        }
    }

    fn of(mut heard: Mat<f64>, rings: Mat<f64>, rate: f64) -> Self {
        heard *= Scale(1.0 / rate);
        if 2 * rings.nrows() < rings.ncols() {
            Self(Form::Factors { heard, rings })
        } else {
            Self(Form::Whole(product(heard.transpose(), rings.as_ref())))
        }
    }
}

/// A mode's velocity as a_m and s_m of Re a_m e^{s_m t}.
fn phasor(pole: Pole) -> (c64, c64) {
    let swing = ((pole.omega - pole.sigma) * (pole.omega + pole.sigma)).max(0.0).sqrt();
    let lag = if swing > 0.0 { pole.sigma / swing } else { 0.0 };
    (c64::new(1.0, lag), c64::new(-pole.sigma, swing))
}

/// The geometric series Σ e^{xi} for i from 0, with `terms` terms.
fn geometric(x: c64, terms: f64) -> c64 {
    if (x * terms).norm() < 1e-9 {
        return c64::new(terms, 0.0);
    }
    let one = c64::new(1.0, 0.0);
    ((x * terms).exp() - one) / (x.exp() - one)
}

/// Modal velocities g_m at samples 0 to `last`, samples x modes.
pub(super) fn rings(poles: &[Pole], rate: f64, last: usize) -> Mat<f64> {
    Mat::from_fn(last + 1, poles.len(), |i, m| poles[m].velocity(i as f64 / rate))
}

/// The matrix product, on all cores.
pub(super) fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut sum = Mat::zeros(a.nrows(), b.ncols());
    multiply(sum.as_mut(), Accum::Replace, a, b, 1.0, all_threads());
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poles() -> Vec<Pole> {
        (1..5).map(|m| Pole::new(700.0 * f64::from(m), 30.0 * f64::from(m))).collect()
    }

    /// I by summing pulse after pulse, each delayed as it is.
    fn by_pulses(window: usize, step: usize, rate: f64) -> Mat<f64> {
        let poles = poles();
        Mat::from_fn(4, 4, |m, n| {
            let one = |delay: i64| -> f64 {
                (0..=window as i64)
                    .filter(|i| i + delay >= 0)
                    .map(|i| {
                        poles[m].velocity((i + delay) as f64 / rate) * poles[n].velocity(i as f64 / rate)
                    })
                    .sum()
            };
            (-100..1000).map(|k: i64| one(k * step as i64)).sum::<f64>() / rate
        })
    }

    #[test]
    fn a_comb_is_its_pulses() {
        let rate = 8e3;
        for (window, step) in [(80, 300), (80, 80), (200, 60)] {
            let replay = Replay::repeated(&poles(), rate, f64::from(window) / rate, f64::from(step) / rate);
            let found = replay.apply(Mat::<f64>::identity(4, 4).as_ref());
            let expected = by_pulses(window as usize, step as usize, rate);
            let error = (&found - &expected).norm_max() / expected.norm_max();
            assert!(error < 1e-9, "{window} {step}: {error}");
        }
    }

    #[test]
    fn series_are_their_sums() {
        let (rate, mut poles) = (8e3, poles());
        poles.push(Pole::new(0.0, 0.0));
        let identity = Mat::<f64>::identity(5, 5);
        for window in [0.0, 0.004, 0.2] {
            let apply = |replay: Replay| replay.apply(identity.as_ref());
            let expected = apply(Replay::once(&poles, rate, window));
            let found = apply(Replay::of_any_length(&poles, rate, window));
            let error = (&found - &expected).norm_max() / expected.norm_max();
            assert!(error < 1e-10, "{window}: {error}");
        }
    }

    #[test]
    fn factors_and_whole_agree() {
        let (rate, poles) = (8e3, [poles(), poles(), poles()].concat());
        let identity = Mat::<f64>::identity(12, 12);
        for (last, factored) in [(4, true), (5, false)] {
            let replay = Replay::once(&poles, rate, f64::from(last) / rate);
            assert_eq!(matches!(replay.0, Form::Factors { .. }), factored);
            let found = replay.apply(identity.as_ref())[(1, 2)];
            let at = |i: i32, m: usize| poles[m].velocity(f64::from(i) / rate);
            let expected = (0..=last).map(|i| at(i, 1) * at(i, 2)).sum::<f64>() / rate;
            assert!((found / expected - 1.0).abs() < 1e-12);
        }
    }
}
