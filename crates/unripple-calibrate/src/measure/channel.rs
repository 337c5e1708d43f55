//! Responses to every actuator, recorded at one input, and their quality.

use super::Account;
use super::telling::around;
use crate::signals::{Band, Quality, Sweep, band_powers};
use unripple_dsp::mean_square;

/// The responses to every actuator that one input of the device recorded, and their quality.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Channel {
    /// Responses, `[actuator][sample]` from time 0, in the input's unit per unit impulse of drive.
    pub responses: Vec<Vec<f64>>,
    /// Quality of each response.
    pub quality: Vec<Quality>,
    /// Quality of each response by thirds of an octave, `[actuator][band]`, bands ascending.
    pub bands: Vec<Vec<BandQuality>>,
    /// Other findings of the recording: clock error, gaps, drift of tension, knocks.
    pub account: Account,
}

impl Channel {
    /// A channel of stored responses `[actuator][sample]`, of unknown quality and without findings about the
    /// recording ([`Account`]).
    pub fn of_responses(responses: Vec<Vec<f64>>) -> Self {
        Self { responses, ..Self::default() }
    }
}

/// Quality of a response in a third of an octave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandQuality {
    /// Middle frequency of the band, in Hz.
    pub hz: f64,
    /// Signal-to-noise ratio, in dB; −∞ if there is no more than noise.
    pub snr_db: f64,
    /// Coherence: share of the power that repeats have in common; `None` without repeats.
    pub coherence: Option<f64>,
}

/// Smallest ratio of noise to signal in any recording, as powers: the rounding of float32.
const LEAST_NOISE: f64 = 1e-15;

/// Start and end of the interval before the linear response in which noise is measured, as shares of the time by which the
/// second harmonic precedes that response.
const QUIET: [f64; 2] = [0.9, 0.2];

/// Number of overlapping segments of the interval `QUIET`, each half as long, of which the quietest is used.
const STRETCHES: usize = 5;

/// Number of spectral lines of a segment that are left out at each edge of the band: the ringing of the
/// edges precedes time 0.
const EDGES: f64 = 3.0;

/// Noise of a deconvolved recording, measured before the first sweep's response begins, where the drive
/// causes nothing but decaying harmonics.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Noise {
    /// Samples of the whole interval in which noise is measured.
    pub whole: Vec<f64>,
    /// Samples of an earlier interval, between the responses of the fourth and third harmonics: the noise to
    /// which the second and third harmonics are compared.
    pub early: Vec<f64>,
    /// Mean square of the noise in the quietest segment, for the whole band.
    pub power: f64,
}

impl Noise {
    /// Measures the noise of a whole deconvolved recording that is limited to `band`; sample `lead` is time
    /// 0 of the first response.
    pub fn of(deconvolved: &[f64], sweep: &Sweep, lead: usize, band: Band) -> Self {
        let second = sweep.lead(2) * sweep.rate;
        let [from, to] = QUIET.map(|share| (share * second).round() as i64);
        let whole = around(deconvolved, lead as i64 - from, usize::try_from(from - to).unwrap_or(1).max(1));
        let half = (whole.len() / 2).max(1);
        let reach = EDGES * sweep.rate / half as f64;
        let clear = [band.low[1] + reach, band.high[0] - reach];
        // A band that is all edges is taken as it is.
        let clear = if clear[1] > 1.5 * clear[0] { clear } else { [band.low[0], band.high[1]] };
        let share = (clear[1] - clear[0]) / (band.high[1] - band.low[0]);
        let step = |i: usize| i * (whole.len() - half) / (STRETCHES - 1);
        let power = |i: usize| band_powers(&whole[step(i)..step(i) + half], sweep.rate, &[clear])[0] / share;
        let power = (0..STRETCHES).map(power).fold(f64::INFINITY, f64::min);
        let [third, fourth] = [3, 4].map(|order| sweep.lead(order) * sweep.rate);
        let length = (0.8 * (fourth - third)) as usize;
        let early =
            around(deconvolved, lead as i64 - (fourth - 0.1 * (fourth - third)) as i64, length.max(1));
        Self { early, whole, power }
    }

    /// Signal-to-noise ratio, in dB, of a response that contains this noise; at most that of the sample
    /// format.
    pub fn snr_db(&self, response: &[f64]) -> f64 {
        let all = mean_square(response);
        ratio_db(all - self.power, self.power.max(LEAST_NOISE * all))
    }
}

fn ratio_db(signal: f64, noise: f64) -> f64 {
    if signal > 0.0 && noise > 0.0 { 10.0 * (signal / noise).log10() } else { f64::NEG_INFINITY }
}

/// Thirds of an octave that lie entirely within a band: lower and upper edge of each, in Hz.
pub(super) fn thirds(band: Band) -> Vec<[f64; 2]> {
    let edge = 2f64.powf(1.0 / 6.0);
    let [low, high] = [band.low[1], band.high[0]];
    let third = |n: i32| [1.0 / edge, edge].map(|side| side * 1000.0 * 2f64.powf(f64::from(n) / 3.0));
    (-24..24).map(third).filter(|[from, to]| *from >= 0.999 * low && *to <= 1.001 * high).collect()
}

/// Quality by thirds of an octave: of repeats of one response, from their differences; of a single response,
/// from `noise`.
pub(super) fn by_bands(repeats: &[&[f64]], noise: &Noise, band: Band, rate: f64) -> Vec<BandQuality> {
    let thirds = thirds(band);
    let count = repeats.len() as f64;
    let samples = repeats.first().map_or(0, |repeat| repeat.len());
    let mean: Vec<f64> =
        (0..samples).map(|i| repeats.iter().map(|repeat| repeat[i]).sum::<f64>() / count).collect();
    let whole = band_powers(&mean, rate, &thirds);
    let apart = |repeat: &&[f64]| -> Vec<f64> {
        let left: Vec<f64> = repeat.iter().zip(&mean).map(|(x, mean)| x - mean).collect();
        band_powers(&left, rate, &thirds)
    };
    let scatter: Vec<Vec<f64>> = repeats.iter().map(apart).collect();
    let alone = band_powers(&noise.whole, rate, &thirds);
    let one = |(i, [from, to]): (usize, &[f64; 2])| {
        let several = repeats.len() > 1;
        // Noise power of one repeat.
        let noise =
            if several { scatter.iter().map(|left| left[i]).sum::<f64>() / (count - 1.0) } else { alone[i] };
        let noise = noise.max(LEAST_NOISE * whole[i]);
        let signal = (whole[i] - noise / count).max(0.0);
        let coherence = several.then(|| signal / (signal + noise).max(f64::MIN_POSITIVE));
        BandQuality { hz: (from * to).sqrt(), snr_db: ratio_db(signal, noise / count), coherence }
    };
    thirds.iter().enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirds_of_an_octave_are_told_by_noise_and_by_repeats() {
        let rate = 48e3;
        let band = Band::within(100.0, 4000.0);
        let random = |seed: u64| {
            move |i: u64| {
                let z = (i ^ seed << 40).wrapping_mul(0x9E37_79B9_7F4A_7C15);
                let z = (z ^ z >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9);
                ((z ^ z >> 32) as f64 / u64::MAX as f64 - 0.5) * 12f64.sqrt()
            }
        };
        let ring = |i: u64| (0.13 * i as f64).sin();
        let of = |seed: u64| -> Vec<f64> { (0..9600).map(|i| ring(i) + 0.1 * random(seed)(i)).collect() };
        let noise =
            Noise { whole: (0..4800).map(|i| 0.1 * random(9)(i)).collect(), power: 0.01, early: Vec::new() };
        let repeats: Vec<Vec<f64>> = (1..5).map(of).collect();
        let rows: Vec<&[f64]> = repeats.iter().map(Vec::as_slice).collect();
        let alone = by_bands(&rows[..1], &noise, band, rate);
        let together = by_bands(&rows, &noise, band, rate);
        // The tone of 993 Hz and mean square 1/2 against a third of an octave, 231 Hz, of noise of 0.01 in 24 kHz.
        let expected = 10.0 * (0.5_f64 / (0.01 * 231.0 / 24e3)).log10();
        let at = |found: &[BandQuality]| *found.iter().find(|b| (b.hz - 1000.0).abs() < 1.0).unwrap();
        assert!((at(&alone).snr_db - expected).abs() < 1.5, "{:?}", at(&alone));
        assert!((at(&together).snr_db - expected - 10.0 * 4f64.log10()).abs() < 1.5, "{:?}", at(&together));
        assert!(at(&together).coherence.unwrap() > 0.999);
        let silent = together.iter().find(|b| (b.hz - 2519.8).abs() < 1.0).unwrap();
        assert!(silent.snr_db < 3.0 && silent.coherence.unwrap() < 0.4, "{silent:?}");
        assert!(alone.iter().all(|b| b.coherence.is_none()));
    }
}
