//! Shared by the tests of measuring: noise with a seed, and a plant whose response is a sum of decaying oscillations.

#![allow(dead_code)]

use std::f64::consts::TAU;

/// Samples per second.
pub const RATE: f64 = 48e3;

/// Gaussian noise (splitmix64, Box and Muller).
pub struct Noise(pub u64);

impl Noise {
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn gauss(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }

    pub fn of(&mut self, samples: usize, rms: f64) -> Vec<f64> {
        (0..samples).map(|_| rms * self.gauss()).collect()
    }

    /// Adds white noise `db` below the signal's own rms.
    pub fn spoil(&mut self, signal: &mut [f64], db: f64) {
        let level = rms(signal) * 10f64.powf(-db / 20.0);
        signal.iter_mut().for_each(|x| *x += level * self.gauss());
    }
}

/// Oscillations between 160 Hz and 3 kHz, as dense as a film's, with random weights.
pub struct Plant {
    /// Angular frequency per sample and weight.
    pub modes: Vec<[f64; 2]>,
    /// Decay rate, per sample.
    pub sigma: f64,
}

impl Plant {
    pub fn new(seed: u64, modes: usize, decay: f64) -> Self {
        let mut noise = Noise(seed);
        let hz = |m: usize| 160.0 + 2840.0 * m as f64 / modes as f64;
        let modes = (0..modes).map(|m| [TAU * (hz(m) + noise.uniform()) / RATE, noise.gauss()]).collect();
        Self { modes, sigma: 1.0 / (decay * RATE) }
    }

    pub fn response(&self, samples: usize) -> Vec<f64> {
        let mut response = vec![0.0; samples];
        for [omega, weight] in &self.modes {
            let (step, fall) = (omega.sin_cos(), (-self.sigma).exp());
            let (mut re, mut im) = (*weight, 0.0);
            for x in &mut response {
                *x += re;
                (re, im) = (fall * (re * step.1 - im * step.0), fall * (re * step.0 + im * step.1));
            }
        }
        response
    }

    /// The sum over all samples of h[i] e^{-jωi}, in closed form: real and imaginary part.
    pub fn spectrum(&self, omega: f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for [at, weight] in &self.modes {
            for side in [-1.0, 1.0] {
                // Half of a geometric series of ratio r e^{jφ}.
                let (r, phi) = ((-self.sigma).exp(), side * at - omega);
                let (re, im) = (1.0 - r * phi.cos(), r * phi.sin());
                let power = re * re + im * im;
                sum[0] += weight / 2.0 * re / power;
                sum[1] += weight / 2.0 * im / power;
            }
        }
        sum
    }
}

/// The sum of x[i] e^{-jω(i - start)}.
pub fn fourier(signal: &[f64], omega: f64, start: f64) -> [f64; 2] {
    signal.iter().enumerate().fold([0.0; 2], |[re, im], (i, x)| {
        let (sin, cos) = (omega * (i as f64 - start)).sin_cos();
        [re + x * cos, im - x * sin]
    })
}

/// Recording of a drive: h convolved with d, over the rate, for so many samples.
pub fn hear(response: &[f64], drive: &[f64], samples: usize) -> Vec<f64> {
    let mut heard = unripple_dsp::convolve(drive, response);
    heard.resize(samples, 0.0);
    heard.iter_mut().for_each(|x| *x /= RATE);
    heard
}

pub fn rms(signal: &[f64]) -> f64 {
    (signal.iter().map(|x| x * x).sum::<f64>() / signal.len().max(1) as f64).sqrt()
}

/// Rms of the difference, relative to the rms of the second signal.
pub fn error(found: &[f64], truth: &[f64]) -> f64 {
    assert_eq!(found.len(), truth.len());
    let difference: Vec<f64> = found.iter().zip(truth).map(|(a, b)| a - b).collect();
    rms(&difference) / rms(truth)
}

/// The response in a band, with a lead.
pub fn limited(response: &[f64], band: unripple_calibrate::signals::Band, lead: usize) -> Vec<f64> {
    let mut padded = vec![0.0; lead];
    padded.extend(response);
    band.limit(&mut padded, RATE).unwrap();
    padded
}
