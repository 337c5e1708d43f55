//! Where recordings and prediction part: in time and in frequency.

use super::setting::Setting;
use serde::Serialize;
use std::ops::Range;
use unripple::dsp::Convolver;

/// Number of equal parts of the time up to twice the focal instant; what follows is one more.
const PARTS: usize = 8;

/// Number of octaves below the highest frequency that are told apart; what lies below them is one more band.
const OCTAVES: i32 = 6;

/// Difference between recordings and prediction in a part of the time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct InTime {
    /// Beginning and end of the part, in s from the drive's first sample.
    pub span_s: [f64; 2],
    /// Rms difference over the rms predicted velocity in this part; `None` where nothing is predicted.
    pub difference: Option<f64>,
    /// Share of the energy of the whole difference.
    pub share: f64,
}

/// Difference between recordings and prediction in a band of frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct InBand {
    /// Lower and upper end of the band, in Hz.
    pub band_hz: [f64; 2],
    /// Rms difference over the rms predicted velocity in this band; `None` where nothing is predicted.
    pub difference: Option<f64>,
    /// Share of the energy of the whole difference.
    pub share: f64,
}

/// Energies of difference and prediction.
type Energies = [f64; 2];

fn ratio([off, known]: Energies) -> Option<f64> {
    (known > 0.0).then(|| (off / known).sqrt())
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// The differences in parts of the time.
pub(super) fn in_time(setting: &Setting, measured: &[Vec<f64>]) -> Vec<InTime> {
    let (samples, rate) = (setting.samples, setting.drive.rate());
    let near = (2 * setting.focal_sample()).clamp(PARTS.min(samples), samples);
    let mut ends: Vec<usize> = (0..=PARTS).map(|n| n * near / PARTS).collect();
    if near < samples {
        ends.push(samples);
    }
    let energies = |span: Range<usize>| {
        let mut sum: Energies = [0.0; 2];
        for (found, known) in measured.iter().zip(&setting.predicted) {
            for (found, known) in found[span.clone()].iter().zip(&known[span.clone()]) {
                sum[0] += (found - known).powi(2);
                sum[1] += known * known;
            }
        }
        sum
    };
    let whole = energies(0..samples)[0];
    let part = |ends: &[usize]| {
        let found = energies(ends[0]..ends[1]);
        let span_s = [ends[0] as f64 / rate, ends[1] as f64 / rate];
        InTime { span_s, difference: ratio(found), share: share(found[0], whole) }
    };
    ends.windows(2).map(part).collect()
}

/// The differences in octaves.
pub(super) fn in_bands(setting: &Setting, measured: &[Vec<f64>]) -> Vec<InBand> {
    let plan = Convolver::new(setting.samples);
    let width = setting.drive.rate() / plan.size() as f64;
    let mut ends = vec![0.0];
    ends.extend((0..=OCTAVES).rev().map(|n| setting.hz / 2f64.powi(n)));
    let mut sums: Vec<Energies> = vec![[0.0; 2]; ends.len() - 1];
    for (found, known) in measured.iter().zip(&setting.predicted) {
        let off = plan.spectrum(found.iter().zip(known).map(|(found, known)| found - known));
        let known = plan.spectrum(known.iter().copied());
        for (line, (off, known)) in off.iter().zip(&known).enumerate() {
            let band = ends[1..].partition_point(|end| *end <= line as f64 * width);
            if let Some(sum) = sums.get_mut(band) {
                sum[0] += off.norm_sqr();
                sum[1] += known.norm_sqr();
            }
        }
    }
    let whole = sums.iter().map(|sum| sum[0]).sum();
    let band = |(ends, sum): (&[f64], &Energies)| InBand {
        band_hz: [ends[0], ends[1]],
        difference: ratio(*sum),
        share: share(sum[0], whole),
    };
    ends.windows(2).zip(&sums).map(band).collect()
}
