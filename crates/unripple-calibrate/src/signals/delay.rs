//! Delay between two signals to a fraction of a sample: cross-correlation in a band.

use super::transform::{Transform, Work, turns};
use super::{Band, positive};
use std::f64::consts::TAU;
use unripple_dsp::{Complex, DspError};

/// Delay of one signal relative to another, to a fraction of a sample.
///
/// ```
/// use unripple_calibrate::signals::{Band, Delay, shift};
///
/// let model: Vec<f64> = (0..200).map(|i| (-0.5 * ((f64::from(i) - 40.0) / 6.0).powi(2)).exp()).collect();
/// let found: Vec<f64> = shift(&model, 3.37).iter().map(|x| -0.2 * x).collect();
/// let delay = Delay::between(&found, &model, 48e3, Band::ALL)?;
/// assert!((delay.samples - 3.37).abs() < 1e-6 && delay.inverted);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// Delay of the found signal relative to the model, in samples.
    pub samples: f64,
    /// Correlation of the two signals in the band at the delay `samples`, from 0 to 1: 1 if they differ by a
    /// delay and a factor only.
    pub correlation: f64,
    /// Whether the two signals have opposite signs.
    pub inverted: bool,
}

impl Delay {
    /// Delay of `found` relative to `model`, the signal as it would be without latency; both are zero beyond their ends.
    ///
    /// Generalised cross-correlation: the delay, to a fraction of a sample, at which the correlation in the band is
    /// largest in magnitude. It is the maximum-likelihood estimate in white noise, and that whose linear phase is nearest
    /// to the phase of the cross-spectrum, weighted by its magnitude.
    ///
    /// Source: C. H. Knapp, G. C. Carter, IEEE Trans. ASSP 24 (1976), eq. 1 and table I.
    ///
    /// # Errors
    /// [`DspError::Range`] for a rate or a band out of range, or if either signal is silent in the band.
    pub fn between(found: &[f64], model: &[f64], rate: f64, band: Band) -> Result<Self, DspError> {
        positive("samples per second", rate)?;
        band.check()?;
        let plan = Transform::smooth(found.len() + model.len());
        let mut works = [plan.work(), plan.work()];
        let mut powers = [0.0; 2];
        for ((signal, work), total) in [found, model].into_iter().zip(&mut works).zip(&mut powers) {
            plan.forward(signal, work);
            for (line, value) in work.lines.iter_mut().enumerate() {
                *value *= band.weight(plan.hz(line, rate)) * plan.copies(line).sqrt();
                *total += value.norm_sqr();
            }
        }
        positive("power of what was found, in the band", powers[0])?;
        positive("power of the model, in the band", powers[1])?;
        let [mut cross, other] = works;
        cross.lines.iter_mut().zip(&other.lines).for_each(|(f, m)| *f *= m.conj());
        Ok(Self::largest(&plan, cross, found.len(), (powers[0] * powers[1]).sqrt()))
    }

    /// Delay of a loopback's response relative to an impulse at sample 0.
    ///
    /// # Errors
    /// As [`Delay::between`].
    pub fn of_impulse(found: &[f64], rate: f64, band: Band) -> Result<Self, DspError> {
        Self::between(found, &[1.0], rate, band)
    }

    /// Delay of the largest correlation. The first `latest` delays count from 0; the others are negative, at the end of
    /// the periodic correlation.
    fn largest(plan: &Transform, mut cross: Work, latest: usize, norm: f64) -> Self {
        let lines = Lines::of(&cross.lines, plan.size());
        // Lines hold the power of their mirror images too, which the inverse transform adds by itself.
        cross.lines.iter_mut().enumerate().for_each(|(line, x)| *x /= plan.copies(line));
        plan.inverse(&mut cross);
        let peak =
            cross.signal.iter().enumerate().fold((0, 0.0), |best: (usize, f64), (i, x)| {
                if x.abs() > best.1.abs() { (i, *x) } else { best }
            });
        let sign = peak.1.signum();
        let size = plan.size();
        let whole = if peak.0 >= latest { peak.0 as f64 - size as f64 } else { peak.0 as f64 };
        let samples = refined(&lines, whole, sign);
        let correlation = (sign * lines.slopes(samples)[0] / norm).clamp(0.0, 1.0);
        Self { samples, correlation, inverted: sign < 0.0 }
    }
}

/// Maximum of `sign` times the correlation within a sample of `whole`: Newton's steps, or halving where they leave the
/// bracket.
fn refined(lines: &Lines, whole: f64, sign: f64) -> f64 {
    let (mut low, mut high, mut at) = (whole - 1.0, whole + 1.0, whole);
    for _ in 0..STEPS {
        let [_, first, second] = lines.slopes(at).map(|x| sign * x);
        if first > 0.0 {
            low = at;
        } else {
            high = at;
        }
        let newton = at - first / second;
        let next = if second < 0.0 && newton > low && newton < high { newton } else { (low + high) / 2.0 };
        let step = (next - at).abs();
        at = next;
        if step < 1e-10 {
            break;
        }
    }
    at
}

/// Largest number of steps to the maximum: halving alone reaches 1e-12 of a sample in as many.
const STEPS: usize = 40;

/// The lines of a cross-spectrum from the first to the last that is not zero.
struct Lines {
    first: usize,
    values: Vec<Complex<f64>>,
    /// Phase per line and sample of delay, in radians.
    step: f64,
}

impl Lines {
    fn of(lines: &[Complex<f64>], size: usize) -> Self {
        let counts = |x: &Complex<f64>| x.norm_sqr() > 0.0;
        let first = lines.iter().position(counts).unwrap_or(0);
        let end = lines.iter().rposition(counts).map_or(first, |last| last + 1);
        Self { first, values: lines[first..end].to_vec(), step: TAU / size as f64 }
    }

    /// The correlation at a delay, and its first and second derivative.
    fn slopes(&self, delay: f64) -> [f64; 3] {
        let turned = self.values.iter().zip(turns(self.step * delay, self.first)).enumerate();
        turned.fold([0.0; 3], |[value, first, second], (line, (x, turn))| {
            let omega = self.step * (self.first + line) as f64;
            let turned = x * turn;
            [value + turned.re, first - omega * turned.im, second - omega * omega * turned.re]
        })
    }
}

/// Delays a signal by any number of samples, fractional or negative too, by a phase ramp in its spectrum:
/// exact for a signal that is band limited and zero near its ends. Samples that are moved beyond an end are
/// lost.
///
/// ```
/// let moved = unripple_calibrate::signals::shift(&[0.0, 1.0, 2.0, 0.0], 1.0);
/// assert!(moved.iter().zip([0.0, 0.0, 1.0, 2.0]).all(|(a, b)| (a - b).abs() < 1e-12));
/// ```
pub fn shift(signal: &[f64], samples: f64) -> Vec<f64> {
    let length = signal.len();
    if !samples.is_finite() || samples.abs() >= length as f64 {
        return vec![0.0; length];
    }
    let plan = Transform::smooth(2 * length);
    let mut work = plan.work();
    plan.forward(signal, &mut work);
    let (turn, scale) = (-TAU * samples / plan.size() as f64, 1.0 / plan.size() as f64);
    for (value, turn) in work.lines.iter_mut().zip(turns(turn, 0)) {
        *value *= turn * scale;
    }
    plan.inverse(&mut work);
    work.signal[..length].to_vec()
}
