//! Hits in a recording: where the sound is not what came before predicts.
//!
//! A sum of ringing modes, of hum and of noise is predicted by a linear filter of its past, beats included; a hit is not. The filter is
//! that of an autoregressive process with the recording's autocorrelation (Levinson and Durbin).

/// Order of the filter: two for each of twenty tones.
const ORDER: usize = 40;

/// Length of the frames in which the unpredicted is summed, in s: about that of a contact of a knuckle.
const FRAME: f64 = 1e-3;

/// A hit is this many times as strong as what is usually not predicted, as a ratio of powers. Frames of noise alone seldom exceed twice the
/// median.
const ABOVE_USUAL: f64 = 6.0;

/// A hit has at least this share of the power of the strongest one.
const OF_STRONGEST: f64 = 0.1;

/// A hit is this many times as strong as what was not predicted just before, as a ratio of powers, and so many frames are just before:
/// after a hit, noise keeps ringing from being predicted well.
const RISE: f64 = 4.0;
const BEFORE: usize = 8;

/// Two hits are at least this far apart, in s; what is closer is one contact.
const APART: f64 = 6e-3;

/// A hit: the times at which it begins and ends, in samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Hit {
    /// Sample at which it begins.
    pub from: usize,
    /// Sample at which it ends.
    pub to: usize,
}

/// The hits in a recording at `rate` samples a second, in their order.
pub(super) fn hits(recording: &[f64], rate: f64) -> Vec<Hit> {
    let frame = ((FRAME * rate) as usize).max(1);
    let unpredicted = unpredicted(recording);
    let powers: Vec<f64> =
        unpredicted.chunks(frame).map(|all| all.iter().map(|x| x * x).sum::<f64>()).collect();
    let usual = unripple_dsp::median(powers.clone()).unwrap_or(0.0);
    let strongest = powers.iter().copied().fold(0.0, f64::max);
    let least = (ABOVE_USUAL * usual).max(OF_STRONGEST * strongest);
    let mut hits: Vec<Hit> = Vec::new();
    for (n, power) in powers.iter().enumerate().filter(|(_, power)| **power > least) {
        let (from, to) = (ORDER + n * frame, (ORDER + (n + 1) * frame).min(recording.len()));
        let before = &powers[n.saturating_sub(BEFORE)..n];
        let rises = *power * before.len() as f64 > RISE * before.iter().sum::<f64>();
        match hits.last_mut() {
            Some(last) if (from as f64) < last.to as f64 + APART * rate => last.to = to,
            _ if rises || n == 0 => hits.push(Hit { from, to }),
            _ => {}
        }
    }
    hits
}

/// What a linear filter of the past does not predict, sample by sample from the [`ORDER`]th on.
fn unpredicted(recording: &[f64]) -> Vec<f64> {
    let lag =
        |k: usize| recording.iter().zip(recording.get(k..).unwrap_or(&[])).map(|(a, b)| a * b).sum::<f64>();
    let mut correlation: Vec<f64> = (0..=ORDER).map(lag).collect();
    // A little white noise keeps the recursion stable where there is none.
    correlation[0] *= 1.0 + 1e-9;
    let mut filter = vec![1.0];
    let mut power = correlation[0];
    for order in 1..=ORDER {
        if power <= 0.0 {
            break;
        }
        let sum: f64 = filter.iter().zip(correlation[1..=order].iter().rev()).map(|(a, r)| a * r).sum();
        let reflected = -sum / power;
        filter.push(0.0);
        let before = filter.clone();
        filter.iter_mut().zip(before.iter().rev()).for_each(|(a, b)| *a += reflected * b);
        power *= 1.0 - reflected * reflected;
    }
    let length = filter.len();
    let one = |past: &[f64]| past.iter().rev().zip(&filter).map(|(x, a)| x * a).sum::<f64>();
    recording.windows(ORDER + 1).map(|past| one(&past[ORDER + 1 - length..])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use unripple_core::Random;

    #[test]
    fn beats_are_no_hits_and_hits_are() {
        let mut random = Random::seeded(3);
        let rate = 12e3;
        let knock = |t: f64| {
            let tone = |hz: f64| (TAU * hz * t).sin();
            if t < 0.0 { 0.0 } else { (-t / 0.1).exp() * (tone(300.0) + tone(340.0) + 0.5 * tone(900.0)) }
        };
        let sound = |n: i32| {
            let t = f64::from(n) / rate;
            knock(t - 0.2) + 0.8 * knock(t - 0.3) + 0.1 * (TAU * 50.0 * t).sin() + 2e-3 * random.normal()
        };
        let recording: Vec<f64> = (0..9600).map(sound).collect();
        let times: Vec<f64> = hits(&recording, rate).iter().map(|hit| hit.from as f64 / rate).collect();
        assert_eq!(times.len(), 2, "{times:?}");
        assert!((times[0] - 0.2).abs() < 2e-3 && (times[1] - 0.3).abs() < 2e-3, "{times:?}");
        assert!(hits(&[], rate).is_empty() && hits(&[0.0; 4000], rate).is_empty());
    }
}
