//! Fractional delay of channels: a Kaiser-windowed sinc.

use unripple_dsp::{kaiser, sinc};

/// Half the length of the interpolator, in samples, which is also the smallest delay that is not a whole
/// number. With half of it the error below 0.4 of the sample rate would be above 1e-4; twice as much doubles
/// the least delay and the work.
pub(crate) const HALF: usize = 24;

/// A delay of several channels by a number of samples that may be fractional: a windowed sinc (Kaiser, β =
/// 10), whose error is below 1e-4 up to 0.4 of the sample rate.
#[derive(Clone, Debug)]
pub(crate) struct Delay {
    /// Weights of the samples from `first` back to the oldest; a single weight of 1 if the delay is a whole
    /// number.
    weights: Vec<f64>,
    first: usize,
    /// For each channel, its newest samples, the newest last.
    past: Vec<Vec<f64>>,
}

impl Delay {
    /// A delay of `channels` channels by `samples`: a whole number, or at least [`HALF`].
    pub(crate) fn new(channels: usize, samples: f64) -> Self {
        let whole = samples.floor();
        let (weights, first) = if whole == samples {
            (vec![1.0], whole as usize)
        } else {
            let first = whole as usize + 1 - HALF.min(whole as usize + 1);
            ((0..2 * HALF).map(|i| kernel((first + i) as f64 - samples)).collect(), first)
        };
        let past = vec![vec![0.0; first + weights.len() - 1]; channels];
        Self { weights, first, past }
    }

    /// Delays `planes`, `frames` samples of each channel, in place. Allocates nothing once the first block has passed.
    pub(crate) fn process(&mut self, planes: &mut [f64], frames: usize) {
        let reach = self.first + self.weights.len() - 1;
        if reach == 0 {
            return;
        }
        for (past, plane) in self.past.iter_mut().zip(planes.chunks_exact_mut(frames)) {
            past.extend_from_slice(plane);
            for (i, value) in plane.iter_mut().enumerate() {
                let newest = i + reach - self.first;
                *value = self.weights.iter().zip(past[..=newest].iter().rev()).map(|(w, x)| w * x).sum();
            }
            past.drain(..frames);
        }
    }
}

/// The interpolator, a sinc under a Kaiser window, at a distance in samples.
fn kernel(x: f64) -> f64 {
    sinc(x) * kaiser(x / HALF as f64, 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn tones_come_late_by_what_was_asked() {
        for samples in [0.0, 5.0, 64.0, 24.5, 33.37, 200.0625] {
            let mut delay = Delay::new(2, samples);
            for (frames, hz) in [(64, 0.02), (37, 0.21), (64, 0.39)] {
                let tone = |t: f64| (2.0 * PI * hz * t).sin();
                for block in 0..12 {
                    let start = (block * frames) as f64;
                    let line: Vec<f64> = (0..frames).map(|i| tone(start + i as f64)).collect();
                    let mut planes = [line.clone(), line].concat();
                    delay.process(&mut planes, frames);
                    if start > samples + 2.0 * HALF as f64 {
                        for (i, value) in planes.iter().enumerate() {
                            let exact = tone(start + (i % frames) as f64 - samples);
                            assert!((value - exact).abs() < 1e-4, "{samples} {hz}: {value} {exact}");
                        }
                    }
                }
            }
        }
    }
}
