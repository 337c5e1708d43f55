//! A sub-band of a recording: shifted to 0 Hz, filtered, and sampled more slowly.

use std::f64::consts::TAU;
use unripple_dsp::{kaiser, sinc};
use unripple_linalg::c64;

/// Shape of the Kaiser window over the filter, and its length in widths of the transition: 80 dB.
const BETA: f64 = 7.86;
const TRANSITIONS: f64 = 5.02;

/// Most samples of a sub-band: enough for any resolution, and small matrices.
const MOST: usize = 320;

/// Fewest samples that are of use.
const LEAST: usize = 24;

/// Fewest samples that are kept of a band, if there are as many: a tone as steady as the noise is to be known as one.
const KEPT: usize = 80;

/// Number of pieces in which the decay of a band is followed down to its floor.
const PIECES: usize = 40;

/// Samples of a sub-band: those for which the filter lies wholly in the recording, so that a decaying exponential stays one.
#[derive(Clone, Debug)]
pub(super) struct SubBand {
    /// The samples, complex, about the centre.
    pub samples: Vec<c64>,
    /// Samples per second.
    pub rate: f64,
    /// Frequency in Hz that became 0.
    pub centre: f64,
}

/// The sub-band of a recording at `rate` samples a second, `width` Hz wide about `centre` Hz; `None` if the recording is too short for its
/// filter.
pub(super) fn sub_band(recording: &[f64], rate: f64, centre: f64, width: f64) -> Option<SubBand> {
    let step = ((rate / (2.0 * width)) as usize).max(1);
    let length = (TRANSITIONS * rate / width).ceil() as usize | 1;
    let count = ((recording.len() + 1).saturating_sub(length)).div_ceil(step);
    if count < LEAST {
        return None;
    }
    let half = (length / 2) as f64;
    let tap = |n: usize| {
        let (away, turns) = (n as f64 - half, TAU * centre / rate);
        let weight = 2.0 * width / rate * sinc(2.0 * width / rate * away) * kaiser(away / (half + 1.0), BETA);
        c64::cis(-turns * n as f64) * weight
    };
    let taps: Vec<c64> = (0..length).map(tap).collect();
    let one = |n: usize| {
        let from = n * step;
        let sum: c64 = taps.iter().zip(&recording[from..from + length]).map(|(tap, x)| *tap * *x).sum();
        // The phase of the shift at the beginning of this stretch; that within it is in the taps.
        sum * c64::cis(-TAU * centre / rate * from as f64)
    };
    let samples: Vec<c64> = (0..count.min(MOST)).map(one).collect();
    Some(SubBand { samples: above_floor(samples), rate: rate / step as f64, centre })
}

/// The samples until their power has come down to twice that of their end, and a third more: beyond is noise.
fn above_floor(mut samples: Vec<c64>) -> Vec<c64> {
    let power = |of: &[c64]| of.iter().map(|x| x.norm_sqr()).sum::<f64>() / of.len().max(1) as f64;
    let floor = power(&samples[samples.len() - samples.len().div_ceil(5)..]);
    let piece = (samples.len() / PIECES).max(3);
    let last = samples.chunks(piece).rposition(|of| power(of) > 2.0 * floor);
    let end = last.map_or(samples.len(), |last| (last + 1) * piece * 4 / 3);
    samples.truncate(end.max(KEPT));
    samples
}
