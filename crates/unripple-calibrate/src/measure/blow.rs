//! Blows of a hammer with a force sensor: found in the recorded force, and checked.

use crate::CalibrateError;
use crate::signals::{clipped, line};
use unripple_dsp::median;

/// Least ratio of a blow's peak to the standard deviation of the force's noise: the largest of a million samples of Gaussian noise is at
/// 5.
const STANDS_OUT: f64 = 12.0;

/// Peak of another hit, relative to the blow's, from which on the blow counts as double: a hit of 5 % leaves ripples of 10 % in the force's
/// spectrum.
const SECOND: f64 = 0.05;

/// Depth to which the force has to fall between two hits, relative to the lower of them: a single push has no such dip.
const DIP: f64 = 0.5;

/// Force, relative to the blow's peak, below which a blow has not begun, or has ended: the rest is less than a hundredth of the impulse.
const EDGE: f64 = 0.005;

/// Longest time in s from the peak of a blow to its end, or from its beginning to the peak: the softest tips push for 10 ms.
const LONGEST: f64 = 10e-3;

/// Number of samples of a force in runs at its largest value from which on it counts as clipped: a push of 1 ms, recorded with 16 bits
/// at a tenth of full scale, has 4.
const FLAT_FORCE: usize = 7;

/// The same for the signal of a sensor, over its whole recording.
const FLAT: usize = 21;

/// Share of the power at low frequencies, 20 dB, down to which the force's spectrum is usable.
const USABLE: f64 = 0.01;

/// Number of steps of frequency in which the end of the usable band is searched.
const STEPS: usize = 400;

/// Why a blow is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BlowFault {
    /// The hammer hit twice.
    #[error("double hit: expected one push, found another of {:.0} % of its force {:.1} ms apart", 100.0 * share, 1e3 * after)]
    Double {
        /// Time from the first hit to the second, in s.
        after: f64,
        /// Peak force of the weaker hit, relative to the stronger.
        share: f64,
    },
    /// The force or a sensor's signal is clipped.
    #[error(
        "overload: expected a signal below full scale, found {samples} samples at the largest value of {channel}"
    )]
    Overload {
        /// What is clipped, in words.
        channel: String,
        /// Number of clipped samples.
        samples: usize,
    },
    /// The recording ends before the response does.
    #[error("cut off: expected {:.0} ms of recording after the blow, found {:.0} ms", 1e3 * expected, 1e3 * found)]
    CutOff {
        /// Time that is needed, in s.
        expected: f64,
        /// Time that was recorded, in s.
        found: f64,
    },
    /// The force pulls.
    #[error(
        "reversed: expected a force that pushes (above 0), found one of {peak:.3} N; a reversed input has a negative scale"
    )]
    Pulls {
        /// Peak force, in N.
        peak: f64,
    },
}

/// A blow, cut out of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Blow {
    /// Sample of the recording at which the force begins.
    pub begin: usize,
    /// Force in N from there to its end, without the sensor's offset.
    pub force: Vec<f64>,
}

impl Blow {
    /// Largest force, in N.
    pub fn peak(&self) -> f64 {
        self.force.iter().copied().fold(0.0, f64::max)
    }
}

/// Blows at a place, and what became of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlowAccount {
    /// Number of blows that the responses are computed from.
    pub used: usize,
    /// Largest force of each of them, in N.
    pub peaks_n: Vec<f64>,
    /// Frequency in Hz above which the force's spectrum is more than 20 dB below its level at low frequencies; `None` if that is above the
    /// band.
    pub usable_to_hz: Option<f64>,
    /// Blows that were refused, and why.
    pub refused: Vec<BlowFault>,
}

impl BlowAccount {
    /// What is remarkable about the blows, one sentence each.
    pub fn said(&self) -> Vec<String> {
        let mut said = Vec::new();
        if let Some(hz) = self.usable_to_hz {
            said.push(format!(
                "above {hz:.0} Hz the force is more than 20 dB below its level at low frequencies: responses are limited to what is below (a \
                 harder tip reaches further)"
            ));
        }
        let mut kinds: Vec<(String, usize)> = Vec::new();
        for fault in &self.refused {
            let text = fault.to_string();
            match kinds.iter_mut().find(|(known, _)| *known == text) {
                Some((_, count)) => *count += 1,
                None => kinds.push((text, 1)),
            }
        }
        said.extend(kinds.into_iter().map(|(text, count)| match count {
            1 => format!("a blow was refused: {text}"),
            count => format!("{count} blows were refused: {text}"),
        }));
        said
    }
}

/// A hit: its sample and its force.
type Hit = (usize, f64);

/// The blows in a recorded force (N, at `rate` samples per second), each with its faults of force; the sensor's offset is removed. Hits less
/// than `window` samples apart belong to one blow, and every blow must be followed by as many samples.
///
/// # Errors
/// [`CalibrateError::Recording`] if there is no blow.
pub fn blows(
    force: &[f64],
    rate: f64,
    window: usize,
) -> Result<Vec<Result<Blow, BlowFault>>, CalibrateError> {
    let nothing = |found: String| CalibrateError::Recording {
        what: "force".into(),
        expected: "a blow of the hammer".into(),
        found,
    };
    let offset = median(force.iter().copied()).ok_or_else(|| nothing("no samples".into()))?;
    let force: Vec<f64> = force.iter().map(|f| f - offset).collect();
    // Of Gaussian noise, half is within 0.6745 standard deviations.
    let noise = median(force.iter().map(|f| f.abs())).unwrap_or(0.0) / 0.6745;
    let most = force.iter().copied().fold(0.0, |most: f64, f| if f.abs() > most.abs() { f } else { most });
    if !most.is_finite() || most == 0.0 || most.abs() < STANDS_OUT * noise {
        return Err(nothing(format!("nothing above its noise of {noise:.2e} N")));
    }
    if most < 0.0 {
        return Ok(vec![Err(BlowFault::Pulls { peak: most })]);
    }
    let hits = hits(&force, noise, SECOND * most);
    let mut found = Vec::new();
    for blow in hits.chunk_by(|one, next| next.0 - one.0 < window) {
        found.push(one(&force, blow, (rate, window, noise)));
    }
    Ok(found)
}

/// Maxima of the force above `least` and above the noise, between which it falls to half of the lower.
fn hits(force: &[f64], noise: f64, least: f64) -> Vec<Hit> {
    let (least, mut hits) = (least.max(0.5 * STANDS_OUT * noise), Vec::<Hit>::new());
    // The largest force since the last dip, and the smallest since the last hit.
    let (mut top, mut bottom) = ((0, 0.0), 0.0);
    for (i, f) in force.iter().copied().enumerate() {
        if f > top.1 && f >= least && f > bottom + 0.5 * STANDS_OUT * noise && f * DIP >= bottom {
            top = (i, f);
        }
        if top.1 > 0.0 && f < DIP * top.1 {
            hits.push(top);
            (top, bottom) = ((i, 0.0), f.max(0.0));
        }
        bottom = bottom.min(f.max(0.0));
    }
    if top.1 > 0.0 {
        hits.push(top);
    }
    hits
}

/// A blow cut out of the force, from the hits that belong to it.
fn one(force: &[f64], hits: &[Hit], (rate, window, noise): (f64, usize, f64)) -> Result<Blow, BlowFault> {
    let main = hits.iter().copied().fold((0, 0.0), |most: Hit, hit| if hit.1 > most.1 { hit } else { most });
    let other = hits.iter().filter(|hit| hit.0 != main.0 && hit.1 >= SECOND * main.1);
    let other = other.copied().fold((0, 0.0), |most: Hit, hit| if hit.1 > most.1 { hit } else { most });
    if other.1 > 0.0 {
        let after = main.0.abs_diff(other.0) as f64 / rate;
        return Err(BlowFault::Double { after, share: other.1 / main.1 });
    }
    let edge = (EDGE * main.1).max(2.0 * noise);
    let longest = (LONGEST * rate) as usize;
    let before = &force[main.0.saturating_sub(longest)..main.0];
    let begin = main.0 - before.iter().rev().take_while(|f| **f > edge).count();
    let after = &force[main.0..(main.0 + longest).min(force.len())];
    let end = main.0 + after.iter().take_while(|f| **f > edge).count();
    let left = force.len() - begin;
    if left < window {
        return Err(BlowFault::CutOff { expected: window as f64 / rate, found: left as f64 / rate });
    }
    let samples = clipped(&force[begin..end], f64::INFINITY);
    if samples >= FLAT_FORCE {
        return Err(BlowFault::Overload { channel: "the force".into(), samples });
    }
    Ok(Blow { begin, force: force[begin..end].to_vec() })
}

/// The first sensor whose recording of a blow is clipped, as a fault; sensors are numbered from 1.
pub(super) fn overload(sensors: &[&[f64]]) -> Option<BlowFault> {
    sensors.iter().enumerate().find_map(|(sensor, signal)| {
        let samples = clipped(signal, f64::INFINITY);
        let channel = format!("sensor {}", sensor + 1);
        (samples >= FLAT).then_some(BlowFault::Overload { channel, samples })
    })
}

/// Frequency in Hz at which the spectrum of these blows together first falls 20 dB below its level at low frequencies, the square of their
/// impulses; `None` if it does not up to `top` Hz.
pub fn usable_to_hz<'a>(blows: impl Iterator<Item = &'a Blow> + Clone, rate: f64, top: f64) -> Option<f64> {
    let power = |hz: f64| -> f64 {
        let one = |blow: &Blow| {
            line(blow.force.iter().copied(), hz / rate).iter().map(|part| part * part).sum::<f64>()
        };
        blows.clone().map(one).sum()
    };
    let low = power(0.0);
    (1..=STEPS).map(|step| top * step as f64 / STEPS as f64).find(|hz| power(*hz) < USABLE * low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const RATE: f64 = 48e3;

    /// Half sines that begin at a time in s, of a peak in N and a duration in s.
    fn force(pushes: &[(f64, f64, f64)], seconds: f64) -> Vec<f64> {
        let at = |i: usize| {
            let t = i as f64 / RATE;
            let push = |(start, peak, length): &(f64, f64, f64)| {
                let x = (t - start) / length;
                if (0.0..1.0).contains(&x) { peak * (PI * x).sin() } else { 0.0 }
            };
            pushes.iter().map(push).sum::<f64>()
        };
        (0..(seconds * RATE) as usize).map(at).collect()
    }

    #[test]
    fn single_blows_are_told_from_double_ones() {
        let apart = |share: f64, later: f64| {
            let force = force(&[(0.05, 10.0, 1e-3), (0.05 + later, 10.0 * share, 1e-3)], 0.4);
            blows(&force, RATE, 9600).unwrap().remove(0)
        };
        assert!(apart(0.03, 5e-3).is_ok());
        for (share, later) in [(0.1, 5e-3), (0.8, 1.3e-3), (0.3, 0.1)] {
            match apart(share, later) {
                Err(BlowFault::Double { after, share: found }) => {
                    assert!((after - later).abs() < 5e-5 && (found - share).abs() < 0.01, "{after} {found}");
                }
                other => panic!("{share} {later}: {other:?}"),
            }
        }
        // Further apart than the window, they are two.
        let two = blows(&force(&[(0.05, 10.0, 1e-3), (0.3, 4.0, 1e-3)], 0.6), RATE, 9600).unwrap();
        assert!(two.len() == 2 && two.iter().all(Result::is_ok), "{two:?}");
    }

    #[test]
    fn what_is_cut_off_clipped_or_reversed_is_refused() {
        let push = force(&[(0.05, 10.0, 1e-3)], 0.4);
        let only = |force: &[f64]| blows(force, RATE, 9600).unwrap().remove(0);
        let blow = only(&push).unwrap();
        assert!((blow.begin as f64 - 2400.0).abs() <= 2.0 && (blow.peak() - 10.0).abs() < 0.02, "{blow:?}");
        let lifted: Vec<f64> = push.iter().map(|f| f + 3.0).collect();
        assert!((only(&lifted).unwrap().peak() - 10.0).abs() < 0.02);
        assert!(matches!(only(&push[..9600]), Err(BlowFault::CutOff { .. })));
        let flat: Vec<f64> = push.iter().map(|f| f.min(9.0)).collect();
        assert!(matches!(only(&flat), Err(BlowFault::Overload { .. })));
        let pulled: Vec<f64> = push.iter().map(|f| -f).collect();
        assert!(matches!(only(&pulled), Err(BlowFault::Pulls { .. })));
        assert!(blows(&[0.0; 960], RATE, 480).is_err() && blows(&[], RATE, 480).is_err());
    }

    /// A half sine of length T has the spectrum cos(π f T) / (1 − (2 f T)²): 20 dB down first at f T = 1.3033.
    #[test]
    fn the_usable_band_is_that_of_a_half_sine() {
        let blow = Blow { begin: 0, force: force(&[(0.0, 1.0, 1e-3)], 1.1e-3) };
        let found = usable_to_hz(std::iter::once(&blow), RATE, 4000.0).unwrap();
        assert!((found - USABLE_OF_HALF_SINE).abs() < 15.0, "{found}");
        assert_eq!(usable_to_hz(std::iter::once(&blow), RATE, 1000.0), None);
    }

    /// Where the spectrum of a half sine of 1 ms is 20 dB down, in Hz: the root of cos(π f T) / (1 − (2 f T)²) = 0.1.
    const USABLE_OF_HALF_SINE: f64 = 1303.3;
}
