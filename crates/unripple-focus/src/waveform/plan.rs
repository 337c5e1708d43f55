//! Sizes and frequency lines of the waveform problem.

use super::{PlayOptions, Waveform};
use crate::FocusError;
use crate::settle::settle;
use std::f64::consts::PI;
use std::ops::Range;
use unripple_core::{Responses, require, window_samples};
use unripple_dsp::Convolver;

/// Decay, in nepers, after which vibration that wraps round the transform no longer matters: to 1/10 000.
/// With twice this value, transforms are longer by the same decay time.
const FORGOTTEN: f64 = 9.2;

/// Largest number of values of a transfer function, 2 GiB of them: lines x points x actuators. With twice this value, problems of twice
/// the size.
const MOST_VALUES: usize = 1 << 27;

/// Largest number of samples of the transform, or of a stroke: 349 s at 48 kHz. With twice this value, drives may be twice as long.
pub(crate) const MOST_SAMPLES: usize = 1 << 24;

/// Periods of the highest frequency over which a drive rises at its start and falls at its end. With twice this value,
/// edges make less that lies outside the band, and drives follow later.
const EDGE: f64 = 8.0;

/// Share of the band, at its top, over which the prescribed motion fades out. With twice this value, less of
/// the band is followed, and waveforms ring less at its edge.
const FADE: f64 = 0.1;

/// Samples and frequency lines over which a drive is solved for.
#[derive(Debug)]
pub(crate) struct Plan {
    /// Samples per second.
    pub rate: f64,
    /// Sample of the drive at which each waveform starts.
    pub starts: Vec<usize>,
    /// Taper p of the drive, 0 to 1, at each of its samples: 1 except near both ends.
    pub taper: Vec<f64>,
    /// Indices of the transform's frequency lines that lie within the band.
    pub lines: Range<usize>,
    /// Factor on the prescribed motion at each of `lines`: 1, falling to 0 at the top of the band.
    pub fade: Vec<f64>,
    /// Fourier transform over the drive and the time afterwards in which the surface's vibration decays.
    pub convolver: Convolver,
}

impl Plan {
    /// Determines frequency lines, start samples and taper for these waveforms and `silent` (a number)
    /// points that are kept still.
    pub fn new(
        responses: &Responses,
        waveforms: &[Waveform],
        silent: usize,
        options: &PlayOptions,
    ) -> Result<Self, FocusError> {
        let rate = responses.conditions().rate;
        let [low, high] = band(responses, options)?;
        let at = |seconds: f64| window_samples(seconds, rate);
        let starts: Vec<usize> =
            waveforms.iter().map(|w| at(options.lead[0]).saturating_add(at(w.delay))).collect();
        let ends = starts.iter().zip(waveforms).map(|(start, w)| start.saturating_add(w.samples.len()));
        let support = ends.max().unwrap_or(0).saturating_add(at(options.lead[1]));
        let tail = settle(responses, FORGOTTEN).ok_or_else(|| FocusError::Count {
            what: "samples until all modes have died out",
            expected: "a finite number, but a mode without losses never dies out".into(),
            found: usize::MAX,
        })?;
        let samples = support.saturating_add(tail);
        if samples > MOST_SAMPLES {
            let expected =
                format!("at most {MOST_SAMPLES}: responses that die out sooner, or a shorter waveform");
            return Err(FocusError::Count {
                what: "samples of a waveform and its decay",
                expected,
                found: samples,
            });
        }
        let convolver = Convolver::new(samples);
        let width = rate / convolver.size() as f64;
        let lines = (low / width).ceil() as usize..(high / width).floor() as usize + 1;
        let rows = waveforms.iter().map(|w| w.points.len()).sum::<usize>() + silent;
        let values = lines.len().saturating_mul(rows).saturating_mul(responses.ports().len());
        if values > MOST_VALUES {
            let expected = format!("at most {MOST_VALUES} over all points and actuators");
            return Err(FocusError::Count { what: "lines of the spectra", expected, found: values });
        }
        let fade = lines.clone().map(|line| fade(line as f64 * width, high)).collect();
        let taper = taper(support, (EDGE * rate / high).round() as usize);
        Ok(Self { rate, starts, taper, lines, fade, convolver })
    }

    /// The factor by which a line counts in sums over all frequencies, negative ones included: 1 or 2.
    pub fn multiplicity(&self, line: usize) -> f64 {
        if self.lines.start + line == 0 { 1.0 } else { 2.0 }
    }
}

/// The band that is played, in Hz, within that of the responses.
fn band(responses: &Responses, options: &PlayOptions) -> Result<[f64; 2], FocusError> {
    let own = responses.conditions().band;
    let [low, high] = options.band.unwrap_or(own);
    let nyquist = responses.conditions().rate / 2.0;
    let top = own[1].min(nyquist);
    require(
        "top of the band played (Hz)",
        high > 0.0 && high <= top,
        format!("above 0, at most {top}"),
        high,
    )?;
    require("bottom of the band played (Hz)", low >= 0.0 && low < high, format!("0 to {high}"), low)?;
    Ok([low, high.min(0.99 * nyquist)])
}

/// Factor on the prescribed motion at a frequency: 1 in most of the band, falling to 0 at its top.
fn fade(hz: f64, high: f64) -> f64 {
    let into = ((hz / high - (1.0 - FADE)) / FADE).clamp(0.0, 1.0);
    (PI / 2.0 * into).cos().powi(2)
}

/// Taper of `length` samples: 1 in the middle, with raised-cosine edges of `edge` samples.
fn taper(length: usize, edge: usize) -> Vec<f64> {
    let edge = edge.clamp(1, length.div_ceil(2).max(1));
    let share = |i: usize| {
        let into = ((i.min(length - 1 - i) as f64 + 0.5) / edge as f64).min(1.0);
        (PI / 2.0 * into).sin().powi(2)
    };
    (0..length).map(share).collect()
}
