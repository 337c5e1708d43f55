//! Responses from taps of unknown force: estimate of the force, then deconvolution by it.

use super::force::{Force, TapOptions};
use crate::CalibrateError;
use crate::signals::{Band, CrossSpectra, Inversion};

/// Power, as a share of the largest, at which a tap counts as detected: its earlier part is weaker, and
/// shorter than a tap.
const HEARD: f64 = 0.01;

/// Power, as a multiple of that of noise, at which a tap counts as detected: averages over `AVERAGED` rarely
/// vary by more than a factor of three. If noise is so loud that this exceeds the share `LOUD` of the
/// largest power, the latter is used.
const ABOVE: f64 = 6.0;
const LOUD: f64 = 0.25;

/// Quantile of the power over the recording that is used as the power of noise: the silence before a tap and
/// after its ringing takes a larger share of the time.
const QUIET: f64 = 0.2;

/// Time in s over which power is averaged, a quarter of a tap's usual length: half of it would leave more of the noise's variation, twice
/// as much blur the beginning.
const AVERAGED: f64 = 0.625e-3;

/// Responses found from taps at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Tapped {
    /// Response of each actuator at the place, by reciprocity, in m/s per unit impulse, which is at time 0.
    pub responses: Vec<Vec<f64>>,
    /// Earliest sample of each recording at which its tap may begin.
    pub begins: Vec<usize>,
    /// Force of each tap, in N, from its sample in `begins` on, at the rate of the recording; empty for a
    /// tap so late that its response was not recorded to the end.
    pub forces: Vec<Vec<f64>>,
    /// Share of the power of the early signals that the estimated force and the model do not explain.
    pub unexplained: f64,
}

/// Responses of actuators at a place from taps there, of any shape and strength, recorded by the actuators as sensors.
///
/// The signal of sensor a is `s_a = h_a * f`, with the same force f for all. First f is estimated, as the
/// force, zero but for [`TapOptions::span`], that with the model's responses best explains the signals until
/// [`TapOptions::early`] later, in the least-squares sense; then each h_a is s_a deconvolved by f, all taps
/// together. The model thus determines only the strength and fine shape of a pulse of a few milliseconds and
/// of its bounces, and no other property of the responses. A tap so late that the recording ends before its
/// response does is left out, unless all are.
///
/// `heard` is `[tap][sensor][sample]`, latency removed; `model` is `[sensor][sample]` at the same place and
/// rate, and longer than these times by one period of the band's lowest frequency. Sensors in `deaf`
/// (indices) are not used for estimating the force.
///
/// # Errors
/// [`CalibrateError::Recording`] if no sensor has a signal; [`CalibrateError::Count`] if sensors and model disagree;
/// [`CalibrateError::Dsp`] from deconvolution.
pub fn tapped(
    heard: &[Vec<Vec<f64>>],
    (model, deaf): (&[Vec<f64>], &[usize]),
    samples: usize,
    (rate, band): (f64, Band),
    options: &TapOptions,
) -> Result<Tapped, CalibrateError> {
    if let Some(found) = heard.iter().map(Vec::len).find(|found| *found != model.len()) {
        let expected = format!("{}, one per actuator", model.len());
        return Err(CalibrateError::Count { what: "sensors that recorded a tap", expected, found });
    }
    let limited = |signals: &[Vec<f64>]| -> Result<Vec<Vec<f64>>, CalibrateError> {
        let mut signals = signals.to_vec();
        signals.iter_mut().try_for_each(|signal| band.limit(signal, rate))?;
        Ok(signals)
    };
    let hears = |signals: &[Vec<f64>]| -> Vec<Vec<f64>> {
        signals.iter().enumerate().filter(|(a, _)| !deaf.contains(a)).map(|(_, s)| s.clone()).collect()
    };
    // The band's filter responds before the impulse; earlier than a tap's length before it, this is little,
    // from the band's lower edge.
    let lead = (options.length * rate) as usize;
    let ahead = |response: &Vec<f64>| [vec![0.0; lead], response.clone()].concat();
    let model = hears(&limited(&model.iter().map(ahead).collect::<Vec<_>>())?);
    let back = arrival(&model, rate).max(lead) + averaged(rate);
    let (mut cuts, mut begins) = (Vec::new(), Vec::new());
    for (tap, sensors) in heard.iter().enumerate() {
        let mut cut = limited(sensors)?;
        let begin = heard_at(&hears(&cut), rate).ok_or_else(|| CalibrateError::Recording {
            what: format!("tap {}", tap + 1),
            expected: "a tap that the sensors record".into(),
            found: "nothing above the noise".into(),
        })?;
        let begin = begin.saturating_sub(back);
        cut.iter_mut().for_each(|signal| drop(signal.drain(..begin.min(signal.len()))));
        cuts.push(cut);
        begins.push(begin);
    }
    let whole = |cut: &Vec<Vec<f64>>| cut.iter().all(|signal| signal.len() >= samples);
    let some = cuts.iter().any(whole);
    let (mut forces, mut weight, mut unexplained) = (vec![Vec::new(); cuts.len()], 0.0, 0.0);
    for (cut, to) in cuts.iter().zip(&mut forces).filter(|(cut, _)| whole(cut) || !some) {
        let force = Force::find(&hears(cut), (&model, lead), (rate, band), options)?;
        let energy: f64 = force.samples.iter().map(|f| f * f).sum();
        (weight, unexplained) = (weight + energy, unexplained + energy * force.unexplained);
        *to = force.samples;
    }
    let used = cuts.into_iter().zip(&forces).filter(|(_, force)| !force.is_empty());
    let responses = together(&used.collect::<Vec<_>>(), samples, (rate, band), options.floor)?;
    let scale = if weight > 0.0 { 1.0 / weight } else { 0.0 };
    Ok(Tapped { responses, begins, forces, unexplained: unexplained * scale })
}

/// The first sample at which the power of all sensors is high enough for a tap; `None` for silence.
fn heard_at(sensors: &[Vec<f64>], rate: f64) -> Option<usize> {
    let powers = powers(sensors, rate);
    let most = powers.iter().copied().fold(0.0, f64::max);
    let mut sorted = powers.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let noise = *sorted.get((QUIET * sorted.len() as f64) as usize)?;
    let level = (HEARD * most).max((ABOVE * noise).min(LOUD * most));
    powers.iter().position(|power| *power >= level && most > 0.0)
}

/// The sample at which the first of the model's responses arrives.
fn arrival(model: &[Vec<f64>], rate: f64) -> usize {
    let powers = powers(model, rate);
    let most = powers.iter().copied().fold(0.0, f64::max);
    powers.iter().position(|power| *power >= HEARD * most).unwrap_or(0)
}

/// Power of all sensors, each relative to its peak, summed over the last [`AVERAGED`].
fn powers(sensors: &[Vec<f64>], rate: f64) -> Vec<f64> {
    let window = averaged(rate);
    let mut powers = vec![0.0; sensors.iter().map(Vec::len).min().unwrap_or(0)];
    for signal in sensors {
        let most = signal.iter().fold(0.0, |m: f64, x| m.max(x * x));
        if most > 0.0 {
            powers.iter_mut().zip(signal).for_each(|(power, x)| *power += x * x / most);
        }
    }
    let mut sum = 0.0;
    let moved = |i: usize| {
        sum += powers[i] - if i >= window { powers[i - window] } else { 0.0 };
        sum
    };
    (0..powers.len()).map(moved).collect()
}

/// Number of samples over which power is summed.
fn averaged(rate: f64) -> usize {
    ((AVERAGED * rate) as usize).max(1)
}

/// The response of each sensor that explains all taps best.
fn together(
    taps: &[(Vec<Vec<f64>>, &Vec<f64>)],
    samples: usize,
    (rate, band): (f64, Band),
    floor: f64,
) -> Result<Vec<Vec<f64>>, CalibrateError> {
    let lengths = taps.iter().flat_map(|(heard, force)| heard.iter().chain([*force]).map(Vec::len));
    let length = lengths.max().unwrap_or(0);
    let inversion = Inversion { band: Some(band), regularisation: floor, ..Inversion::default() };
    let sensors = taps.first().map_or(0, |(heard, _)| heard.len());
    let response = |sensor: usize| {
        let mut spectra = CrossSpectra::new(length, rate)?;
        taps.iter().try_for_each(|(heard, force)| spectra.add(force, &heard[sensor]))?;
        let mut response = vec![0.0; samples.min(length)];
        spectra.response(&inversion, &mut response)?;
        response.resize(samples, 0.0);
        Ok(response)
    };
    (0..sensors).map(response).collect()
}
