//! Sound pressure as it is rated: A-weighting, and the energy of a signal's rate of change.

use crate::FourierPlanner;
use realfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Corner frequencies of the A-weighting, in Hz (IEC 61672-1:2013, annex E.4: f_1 to f_4).
const CORNERS: [f64; 4] = [20.60, 107.7, 737.9, 12_194.0];

/// Sound pressure to which levels are relative, in Pa (IEC 61672-1).
pub const REFERENCE_PRESSURE: f64 = 20e-6;

/// Gain of the A-weighting at a frequency (Hz), as a ratio of pressures: 1 at 1 kHz (IEC 61672-1:2013, annex E.4).
///
/// ```
/// let db = |hz: f64| 20.0 * unripple_dsp::a_weighting(hz).log10();
/// assert!(db(1000.0).abs() < 1e-12 && (db(100.0) + 19.1).abs() < 0.1);
/// ```
pub fn a_weighting(hz: f64) -> f64 {
    weight(hz) / weight(1000.0)
}

/// The A-weighting without its normalisation.
fn weight(hz: f64) -> f64 {
    let [a, b, c, d] = CORNERS.map(|corner| hz * hz + corner * corner);
    hz.powi(4) / (a * (b * c).sqrt() * d)
}

/// The rate of change of a periodic signal, and its energy as it is and A-weighted.
#[derive(Clone, Debug, PartialEq)]
pub struct RateOfChange {
    /// The rate of change at each sample, in the signal's unit per second.
    pub values: Vec<f64>,
    /// Sum of the squares of these values.
    pub squares: f64,
    /// Sum of their squares after A-weighting.
    pub a_weighted_squares: f64,
}

impl RateOfChange {
    /// The rate of change of a signal whose samples, at `rate` per second, are one period of it. A signal that begins and ends at rest,
    /// such as a pulse between zeros, is periodic too.
    ///
    /// The transform of the signal is multiplied by iω; the bin at half the rate, whose phase is not known, is left out.
    ///
    /// ```
    /// use std::f64::consts::TAU;
    ///
    /// let sine: Vec<f64> = (0..480).map(|i| (TAU * 100.0 * f64::from(i) / 48e3).sin()).collect();
    /// let found = unripple_dsp::RateOfChange::of(&sine, 48e3);
    /// assert!((found.values[0] - TAU * 100.0).abs() < 1e-6);
    /// assert!((10.0 * (found.a_weighted_squares / found.squares).log10() + 19.1).abs() < 0.1);
    /// ```
    pub fn of(signal: &[f64], rate: f64) -> Self {
        let size = signal.len();
        let nothing = Self { values: vec![0.0; size], squares: 0.0, a_weighted_squares: 0.0 };
        if size == 0 {
            return nothing;
        }
        let mut planner = FourierPlanner::new();
        let (forward, inverse) = (planner.forward(size), planner.inverse(size));
        let (mut values, mut spectrum) = (signal.to_vec(), forward.make_output_vec());
        if forward.process(&mut values, &mut spectrum).is_err() {
            return nothing; // Sizes come from the plan itself.
        }
        let (mut squares, mut a_weighted_squares) = (0.0, 0.0);
        for (line, value) in spectrum.iter_mut().enumerate() {
            let hz = line as f64 * rate / size as f64;
            let factor = if 2 * line == size { 0.0 } else { TAU * hz / size as f64 };
            *value *= Complex::new(0.0, factor);
            // Both signs of the frequency (Parseval).
            let energy = 2.0 * size as f64 * value.norm_sqr();
            squares += energy;
            a_weighted_squares += energy * a_weighting(hz).powi(2);
        }
        if inverse.process(&mut spectrum, &mut values).is_err() {
            return nothing; // Sizes come from the plan itself.
        }
        Self { values, squares, a_weighted_squares }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// IEC 61672-1:2013, table 3: nominal frequencies of third octaves, whose exact values are powers of 10^0.1.
    #[test]
    fn the_weighting_is_that_of_the_standards_table() {
        let table = [
            (10, -70.4),
            (13, -50.5),
            (16, -34.6),
            (17, -30.2),
            (20, -19.1),
            (24, -8.6),
            (27, -3.2),
            (30, 0.0),
            (33, 1.2),
            (36, 1.0),
            (39, -1.1),
            (40, -2.5),
            (43, -9.3),
        ];
        for (third, expected) in table {
            let hz = 10f64.powf(f64::from(third) / 10.0);
            let found = 20.0 * a_weighting(hz).log10();
            assert!((found - expected).abs() <= 0.051, "{hz} Hz: {found} dB, expected {expected} dB");
        }
        assert_eq!(a_weighting(0.0), 0.0);
    }

    #[test]
    fn a_sum_of_sines_has_the_rate_of_change_of_each() {
        for size in [480, 481] {
            let rate = 48e3;
            let tones =
                [(3.0, 1.0, 0.4), (20.0, 0.5, 1.1)].map(|(n, a, phase)| (TAU * n / size as f64, a, phase));
            let sum =
                |f: &dyn Fn(f64, f64, f64) -> f64| tones.iter().map(|(w, a, p)| f(*w, *a, *p)).sum::<f64>();
            let signal: Vec<f64> =
                (0..size).map(|i| 7.0 + sum(&|w, a, p| a * (w * i as f64 + p).sin())).collect();
            let found = RateOfChange::of(&signal, rate);
            for (i, value) in found.values.iter().enumerate() {
                let exact = sum(&|w, a, p| a * w * rate * (w * i as f64 + p).cos());
                assert!((value - exact).abs() < 1e-6, "{size}, {i}: {value} {exact}");
            }
            let squares = found.values.iter().map(|x| x * x).sum::<f64>();
            assert!((found.squares / squares - 1.0).abs() < 1e-9, "{} {squares}", found.squares);
            let weighted =
                sum(&|w, a, _| (a * w * rate * a_weighting(w * rate / TAU)).powi(2) * size as f64 / 2.0);
            assert!((found.a_weighted_squares / weighted - 1.0).abs() < 1e-9, "{weighted}");
        }
    }

    #[test]
    fn what_is_constant_or_empty_is_silent() {
        assert!(RateOfChange::of(&[], 48e3).values.is_empty());
        let found = RateOfChange::of(&[3.0; 8], 48e3);
        assert!(found.squares < 1e-12 && found.values.iter().all(|x| x.abs() < 1e-9), "{found:?}");
    }
}
