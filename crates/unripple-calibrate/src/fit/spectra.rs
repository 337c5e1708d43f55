//! Laplace transforms of measured responses along a line to the right of their poles.

use super::limited::{DERIVATIVES, Limited};
use super::measured::Measured;
use std::f64::consts::{PI, TAU};
use unripple_core::Point;
use unripple_dsp::FourierPlanner;
use unripple_linalg::c64;

/// Least decay of the window by the end of the signals, in nepers. The window is then 0.25 % of its beginning; half as many would
/// leave 5 %.
const ENDED: f64 = 6.0;

/// Distance between frequencies, in full widths (at half power) of a spectral line under the window.
const SPACING: f64 = 1.0;

/// Measured signals as Laplace transforms along the line s = α + jω: spectra under a window e^{-αt}, which fades the signals out
/// without an edge and widens all spectral lines equally.
#[derive(Clone, Debug)]
pub(crate) struct Spectra {
    /// The complex frequencies, 1/s.
    pub frequencies: Vec<c64>,
    /// Spectra of the responses between actuators, in the order of [`Pairs`](super::Pairs); empty for pairs
    /// that were not measured.
    pub pairs: Vec<Vec<c64>>,
    /// Standard deviation of the noise in real and imaginary parts of `pairs`.
    pub pair_noise: f64,
    /// Spectra, `[term][frequency]`, whose combinations represent modes far above the band in `pairs`: an
    /// impulse and its odd derivatives; for responses limited to a band, also these after the limit.
    pub far: Vec<Vec<c64>>,
    /// Spectra of each tap at each actuator, `[tap][actuator][frequency]`.
    pub taps: Vec<Vec<Vec<c64>>>,
    /// Places of the taps.
    pub places: Vec<Point>,
    /// Standard deviation of the noise in real and imaginary parts of `taps`, for each tap.
    pub tap_noise: Vec<f64>,
    /// Number of frequencies, relative to the number of independent ones.
    pub overlap: f64,
}

/// The lines on which spectra are compared, and the window that signals are multiplied by.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    /// The complex frequencies, 1/s.
    pub frequencies: Vec<c64>,
    /// Standard deviation of the noise in real and imaginary parts of a line, per rms noise on each sample, in s.
    pub spread: f64,
    /// Number of frequencies, relative to the number of independent ones.
    pub overlap: f64,
    /// Numbers of the lines in a transform of `fold` samples.
    bins: Vec<usize>,
    fold: usize,
    /// The window times the duration of a sample, in s.
    weights: Vec<f64>,
}

impl Lines {
    /// The lines from `low` to `high` (Hz) of at most `window` seconds of signals of so many samples at a rate (Hz), which are multiplied
    /// by an exponential that decays at the rate `alpha` (1/s) or faster.
    pub fn new((rate, samples): (f64, usize), [low, high]: [f64; 2], (alpha, window): (f64, f64)) -> Self {
        let samples = samples.min((window * rate).ceil() as usize).max(2);
        let alpha = alpha.max(ENDED * rate / samples as f64);
        let fold = ((rate * PI / (SPACING * alpha)).round() as usize).clamp(2, 1 << 20);
        let spacing = rate / fold as f64;
        let bins: Vec<usize> =
            (1..fold / 2).filter(|k| (low..=high).contains(&(*k as f64 * spacing))).collect();
        let weights: Vec<f64> = (0..samples).map(|i| (-alpha * i as f64 / rate).exp() / rate).collect();
        let ratio = alpha / spacing;
        Self {
            frequencies: bins.iter().map(|k| c64::new(alpha, TAU * *k as f64 * spacing)).collect(),
            spread: (weights.iter().map(|w| w * w).sum::<f64>() / 2.0).sqrt(),
            overlap: (ratio / ratio.tanh()).max(1.0),
            bins,
            fold,
            weights,
        }
    }

    /// Spectra, `[term][frequency]`, whose combinations represent modes far above the band in responses that are not limited to one.
    pub fn far(&self) -> Vec<Vec<c64>> {
        let top = self.frequencies.last().map_or(1.0, |s| s.norm());
        let power = |order: &i32| self.frequencies.iter().map(|s| (s / top).powi(*order)).collect();
        DERIVATIVES.iter().map(power).collect()
    }

    /// How signals are transformed to the lines; an empty signal has none.
    fn transform(&self) -> impl Fn(&Vec<f64>) -> Vec<c64> + '_ {
        let plan = FourierPlanner::new().forward(self.fold);
        move |signal: &Vec<f64>| {
            let mut folded = plan.make_input_vec();
            let weighed = signal.iter().zip(&self.weights).enumerate();
            weighed.for_each(|(i, (x, w))| folded[i % self.fold] += x * w);
            let mut out = plan.make_output_vec();
            if signal.is_empty() || plan.process(&mut folded, &mut out).is_err() {
                return Vec::new();
            }
            self.bins.iter().map(|k| out[*k]).collect()
        }
    }
}

impl Spectra {
    /// Transforms from `low` to `high` (Hz) of at most `window` seconds of the signals, each multiplied by an
    /// exponential that decays at the rate `alpha` (1/s) or faster. If the measured responses between
    /// actuators were limited to a band, `limited` is the model's response outside that band, and is added.
    pub fn of(measured: &Measured, limited: Option<&Limited>, band: [f64; 2], window: (f64, f64)) -> Self {
        let lines = Lines::new((measured.rate, measured.samples()), band, window);
        let transform = lines.transform();
        let frequencies = &lines.frequencies;
        let pair = |(n, signal): (usize, &Vec<f64>)| {
            let mut spectrum = transform(signal);
            if let Some(Limited { whole, cut, late, .. }) = limited {
                let lines = transform(&whole[n]).into_iter().zip(transform(&cut[n])).zip(frequencies);
                let taken = lines.map(|((whole, cut), s)| whole * (-s * *late).exp() - cut);
                spectrum.iter_mut().zip(taken).for_each(|(y, taken)| *y += taken);
            }
            spectrum
        };
        let mut far = lines.far();
        far.extend(limited.iter().flat_map(|limited| &limited.far).map(&transform));
        Self {
            far,
            pairs: measured.pairs.iter().flat_map(|p| &p.responses).enumerate().map(pair).collect(),
            pair_noise: measured.pairs.as_ref().map_or(1.0, |p| p.noise) * lines.spread,
            taps: measured.taps.iter().map(|tap| tap.heard.iter().map(&transform).collect()).collect(),
            places: measured.taps.iter().map(|tap| tap.at).collect(),
            tap_noise: measured.taps.iter().map(|tap| tap.noise * lines.spread).collect(),
            frequencies: lines.frequencies.clone(),
            overlap: lines.overlap,
        }
    }
}
