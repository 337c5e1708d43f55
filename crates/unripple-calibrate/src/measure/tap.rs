//! Responses from taps of unknown force: estimate of the force, then deconvolution by it.

use super::force::Force;
use crate::CalibrateError;
use crate::signals::{Band, Together};

/// Assumptions about taps before they are recorded: length, and how far the model is trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapOptions {
    /// Longest time that a tap takes, in s, without bounces.
    pub length: f64,
    /// Longest time from a tap to its last bounce, in s.
    pub bounces: f64,
    /// Time after a force, in s, in which the model is trusted.
    pub early: f64,
    /// Whether a tap is known to push and never to pull, so that its force has one sign.
    pub pushes: bool,
    /// Regularisation of the deconvolution: power added to that of the taps' spectra, relative to their strongest line in the band.
    pub floor: f64,
}

impl Default for TapOptions {
    /// For a model that was fitted to the surface: bounces within 13 ms, by 6 ms of responses.
    fn default() -> Self {
        Self { length: 2.5e-3, bounces: 13e-3, early: 6e-3, pushes: true, floor: 1e-3 }
    }
}

impl TapOptions {
    /// For a model of which little is known to be right. Without bounces it is trusted only in the time of the first reflections, which a
    /// small error of tension hardly moves; a force that may pull makes up for part of its errors.
    pub fn for_unfitted() -> Self {
        Self { bounces: 0.0, pushes: false, ..Self::default() }
    }

    /// Duration of the signals' part in which there may be a force, in s: it may begin a tap's length before it is heard, and as long
    /// after.
    pub fn span(&self) -> f64 {
        2.0 * self.length + self.bounces
    }
}

/// Share of the largest power at which a tap counts as heard, and (`ABOVE`) factor above the power of the noise. Weaker signals from afar
/// would come earlier by less than a tap's length.
const HEARD: f64 = 0.01;
const ABOVE: f64 = 6.0;

/// Share of the recording that is quieter than what counts as noise: silence before a tap, and what follows its ringing.
const QUIET: f64 = 0.2;

/// Share of a tap's length over which power is averaged.
const AVERAGED: f64 = 0.25;

/// Responses found from taps at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Tapped {
    /// Response of each actuator at the place, by reciprocity, in m/s per unit impulse; time 0 is the start of the tap.
    pub responses: Vec<Vec<f64>>,
    /// Force of each tap in N, at the rate of the recording.
    pub forces: Vec<Vec<f64>>,
    /// Share of the power of the early signals that force and model do not explain.
    pub unexplained: f64,
}

/// Responses of actuators at a place from taps there, of any shape and strength, recorded by the actuators as sensors.
///
/// The signal of sensor a is `s_a = h_a * f`, with the same force f for all. First f is estimated, as the force, zero but for
/// [`TapOptions::span`], that with the model's responses best explains the signals until [`TapOptions::early`] later, in the least-squares
/// sense; then each h_a is s_a deconvolved by f, all taps together. The model thus determines the strength and fine shape of a pulse of a
/// few milliseconds and of its bounces, and nothing of the responses themselves.
///
/// `heard` is `[tap][sensor][sample]`, latency removed; `model` is `[sensor][sample]` at the same place and rate.
///
/// # Errors
/// [`CalibrateError::Recording`] if no sensor has a signal; [`CalibrateError::Count`] if sensors and model disagree;
/// [`CalibrateError::Dsp`] from deconvolution.
pub fn tapped(
    heard: &[Vec<Vec<f64>>],
    model: &[Vec<f64>],
    samples: usize,
    rate: f64,
    band: Band,
    options: &TapOptions,
) -> Result<Tapped, CalibrateError> {
    let limited = |signals: &[Vec<f64>]| -> Result<Vec<Vec<f64>>, CalibrateError> {
        let mut signals = signals.to_vec();
        signals.iter_mut().try_for_each(|signal| band.limit(signal, rate))?;
        Ok(signals)
    };
    // The band's filter begins before the impulse; what of that is further ahead than a tap's length is of its lower edge, and little.
    let lead = (options.length * rate) as usize;
    let ahead = |response: &Vec<f64>| [vec![0.0; lead], response.clone()].concat();
    let model = limited(&model.iter().map(ahead).collect::<Vec<_>>())?;
    let (mut cuts, mut forces) = (Vec::new(), Vec::new());
    let (mut weight, mut unexplained) = (0.0, 0.0);
    for (tap, sensors) in heard.iter().enumerate() {
        if sensors.len() != model.len() {
            let expected = format!("{}, one per actuator", model.len());
            let what = "sensors that recorded a tap";
            return Err(CalibrateError::Count { what, expected, found: sensors.len() });
        }
        let mut cut = limited(sensors)?;
        let Some(begin) = begin(&cut, rate, options) else {
            return Err(CalibrateError::Recording {
                what: format!("tap {}", tap + 1),
                expected: "a tap that the sensors record".into(),
                found: "nothing above the noise".into(),
            });
        };
        cut.iter_mut().for_each(|signal| drop(signal.drain(..begin.min(signal.len()))));
        let force = Force::find(&cut, (&model, lead), (rate, band), options)?;
        let energy: f64 = force.samples.iter().map(|f| f * f).sum();
        weight += energy;
        unexplained += energy * force.unexplained;
        forces.push(force.samples);
        cuts.push(cut);
    }
    let responses = together(&mut cuts, &forces, samples, rate, band, options.floor)?;
    let scale = if weight > 0.0 { 1.0 / weight } else { 0.0 };
    Ok(Tapped { responses, forces, unexplained: unexplained * scale })
}

/// The sample a tap's length before that at which the power of all sensors, each relative to its peak, first is that of a tap; `None` for
/// silence.
fn begin(sensors: &[Vec<f64>], rate: f64, options: &TapOptions) -> Option<usize> {
    let window = ((AVERAGED * options.length * rate) as usize).max(1);
    let mut powers = vec![0.0; sensors.iter().map(Vec::len).min()?];
    for signal in sensors {
        let most = signal.iter().fold(0.0, |m: f64, x| m.max(x * x));
        if most > 0.0 {
            powers.iter_mut().zip(signal).for_each(|(power, x)| *power += x * x / most);
        }
    }
    let mut sum = 0.0;
    let moving: Vec<f64> = (0..powers.len())
        .map(|i| {
            sum += powers[i] - if i >= window { powers[i - window] } else { 0.0 };
            sum
        })
        .collect();
    let most = moving.iter().copied().fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let mut sorted = moving.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let noise = sorted[(QUIET * sorted.len() as f64) as usize];
    // However loud the noise, the loudest part is the tap.
    let level = (HEARD * most).max((ABOVE * noise).min(0.25 * most));
    let first = moving.iter().position(|power| *power >= level)?;
    Some(first.saturating_sub(window + (options.length * rate) as usize))
}

/// The response of each sensor to all taps.
fn together(
    taps: &mut [Vec<Vec<f64>>],
    forces: &[Vec<f64>],
    samples: usize,
    rate: f64,
    band: Band,
    floor: f64,
) -> Result<Vec<Vec<f64>>, CalibrateError> {
    let longest = |rows: &mut dyn Iterator<Item = usize>| rows.max().unwrap_or(0);
    let length =
        longest(&mut taps.iter().flatten().map(Vec::len)).max(longest(&mut forces.iter().map(Vec::len)));
    taps.iter_mut().flatten().for_each(|signal| signal.resize(length, 0.0));
    let plan = Together::new(forces, length, rate, band, floor)?;
    let sensors = taps.first().map_or(0, Vec::len);
    let response = |sensor: usize| {
        let heard: Vec<&[f64]> = taps.iter().map(|tap| &tap[sensor][..]).collect();
        let mut response = plan.deconvolve(&heard)?;
        response.resize(samples, 0.0);
        Ok(response)
    };
    (0..sensors).map(response).collect()
}
