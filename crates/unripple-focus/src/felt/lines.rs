//! Lines (frequency bins) of a Fourier transform, up to the highest frequency that is felt.

use std::sync::Arc;
use unripple_core::Pole;
use unripple_dsp::{Complex, FourierPlanner, RealToComplex, Threshold};

/// Frequencies whose threshold is more than this factor (40 dB) above the lowest threshold do not count as
/// felt. Doubled (46 dB), lines reach to higher frequencies, and plans take longer.
const UNFELT: f64 = 100.0;

/// Number of frequencies at which the threshold is evaluated to find the highest one felt, evenly in the
/// logarithm over four decades: 0.5 % apart. With twice this value, it is found twice as closely.
const LOOKED_AT: i32 = 2000;

/// Decay, in nepers, of oscillations by the end of the transform, where it wraps around: to 1/55. With twice
/// this value, to 1/3000, for a transform up to twice as long.
const DIED_OUT: f64 = 4.0;

/// Largest number of samples of the transform beyond what the drive itself needs: modes that ring longer are made to decay
/// faster. With twice this value, transforms may be twice as long.
const MOST_DECAY: usize = 1 << 16;

/// The highest frequency, in Hz, whose threshold is less than 40 dB above the lowest one; at most `limit`.
pub(crate) fn felt_top(threshold: &Threshold, limit: f64) -> f64 {
    let hz = |i: i32| limit * 1e-4_f64.powf(1.0 - f64::from(i) / f64::from(LOOKED_AT));
    let all = || (0..=LOOKED_AT).map(hz);
    let least = all().map(|f| threshold.at(f)).fold(f64::INFINITY, f64::min);
    all().filter(|f| threshold.at(*f) <= UNFELT * least).fold(0.0, f64::max)
}

/// The lines (frequency bins) of a Fourier transform, up to the highest frequency that is felt.
#[derive(Clone)]
pub(crate) struct Lines {
    /// Samples per second.
    pub rate: f64,
    /// Length of the transform, in samples.
    pub size: usize,
    /// Inverse of the detection threshold at each line, in 1/m.
    pub gains: Vec<f64>,
    /// Number of samples over which responses are exact; afterwards those that hardly decay are made to
    /// decay faster.
    exact: usize,
    transform: Arc<dyn RealToComplex<f64>>,
}

impl std::fmt::Debug for Lines {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Lines").field("size", &self.size).field("lines", &self.gains.len()).finish()
    }
}

impl Lines {
    /// Lines up to `top` (Hz), fine enough for a drive of `window` samples and the decay of these poles.
    pub fn new(threshold: &Threshold, rate: f64, window: usize, poles: &[Pole], top: f64) -> Self {
        let [size, count] = Self::sizes(rate, window, poles, top);
        let gains = (0..count).map(|k| 1.0 / threshold.at(k as f64 * rate / size as f64)).collect();
        let transform = FourierPlanner::new().forward(size);
        Self { rate, size, gains, exact: 2 * window, transform }
    }

    /// Length of the transform in samples, and number of its lines from 0 Hz to `top`, that [`Lines::new`]
    /// uses for these arguments.
    pub fn sizes(rate: f64, window: usize, poles: &[Pole], top: f64) -> [usize; 2] {
        let slowest = poles.iter().map(slowest_decay).fold(f64::INFINITY, f64::min);
        let decay = (DIED_OUT * rate / slowest.max(f64::MIN_POSITIVE)).min(MOST_DECAY as f64) as usize;
        let size = (4 * window + decay).next_power_of_two();
        [size, ((top * size as f64 / rate) as usize + 1).min(size / 2)]
    }

    /// Number of lines, from 0 Hz to the highest frequency felt.
    pub fn count(&self) -> usize {
        self.gains.len()
    }

    /// The factor on a line X in the inverse transform: x[i] = Σ share · Re(X e^{jωi}).
    pub fn share(&self, line: usize) -> f64 {
        if line == 0 { 1.0 / self.size as f64 } else { 2.0 / self.size as f64 }
    }

    /// Phase of a line's oscillation at a sample, in radians.
    pub fn phase(&self, line: usize, sample: i64) -> f64 {
        let turns = (line as i64 * sample).rem_euclid(self.size as i64);
        std::f64::consts::TAU * turns as f64 / self.size as f64
    }

    /// Fourier transform, at the lines, of a signal that starts at sample 0.
    pub fn of(&self, signal: &[f64]) -> Vec<Complex<f64>> {
        let mut padded = self.transform.make_input_vec();
        let length = signal.len().min(self.size);
        padded[..length].copy_from_slice(&signal[..length]);
        let mut lines = self.transform.make_output_vec();
        let done = self.transform.process(&mut padded, &mut lines);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
        lines.truncate(self.count());
        lines
    }

    /// Transfer function, at the lines, from drive to displacement of one oscillation: the transform of its
    /// impulse response, times the sample interval.
    pub fn of_pole(&self, pole: Pole) -> Vec<Complex<f64>> {
        let wanted = DIED_OUT * self.rate / (self.size - self.exact) as f64;
        let more = (wanted - slowest_decay(&pole)).max(0.0) / self.rate;
        let sample = |i: usize| {
            let late = i.saturating_sub(self.exact) as f64;
            pole.displacement(i as f64 / self.rate) * (-more * late).exp() / self.rate
        };
        self.of(&(0..self.size).map(sample).collect::<Vec<_>>())
    }
}

/// Decay rate of the slower of a mode's two exponentials, in 1/s.
fn slowest_decay(pole: &Pole) -> f64 {
    let square = (pole.sigma - pole.omega) * (pole.sigma + pole.omega);
    pole.sigma - square.max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingers_feel_up_to_about_fourteen_hundred_hertz() {
        // 10 µm on 20 dB per octave from 3 µm at 1 kHz.
        let top = felt_top(&Threshold::default(), 3000.0);
        assert!((top - 1434.0).abs() < 10.0, "{top}");
        assert_eq!(felt_top(&Threshold::default(), 600.0), 600.0);
    }

    #[test]
    fn lines_of_a_struck_oscillation_are_its_transfer_function() {
        let pole = Pole::new(1000.0, 30.0);
        let lines = Lines::new(&Threshold::default(), 48e3, 480, &[pole], 1000.0);
        for (k, found) in lines.of_pole(pole).iter().enumerate().skip(1) {
            let w = std::f64::consts::TAU * k as f64 * 48e3 / lines.size as f64;
            let exact = Complex::new(1e6 - w * w, 60.0 * w).inv();
            assert!((found - exact).norm() < 0.03 * exact.norm() + 1e-9, "{k}: {found} {exact}");
        }
    }
}
