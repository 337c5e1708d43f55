//! Correction of a recording to the clock and the time axis of the played signal.

use crate::signals::shift;
use unripple_dsp::resample;

/// The corrections to a recording: clock error, delay, lost samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Mend {
    /// Relative error of the recording's clock, positive if it is fast.
    pub quick: f64,
    /// Delay of the recording, in samples.
    pub late: f64,
    /// Number of samples lost (negative: recorded twice), and the sample at which they were lost, counted
    /// after the correction of the clock.
    pub lost: Option<(i64, usize)>,
}

/// Smallest delay that is corrected, in samples; also the smallest deviation of the clock over the whole recording.
const LEAST: f64 = 0.02;

impl Mend {
    /// Whether a recording of `samples` samples needs a correction.
    pub fn is_needed(&self, samples: usize) -> bool {
        self.lost.is_some() || self.late.abs() >= LEAST || self.resampled(samples)
    }

    fn resampled(&self, samples: usize) -> bool {
        self.quick.abs() * samples as f64 >= LEAST
    }

    /// The corrected recording, of the same length; samples about which the recording has no information are
    /// zero.
    pub fn of(&self, line: &[f64]) -> Vec<f64> {
        let samples = line.len();
        let mut mended = line.to_vec();
        if self.resampled(samples) {
            mended = resample(&mended, 1.0 + self.quick);
            mended.resize(samples, 0.0);
        }
        if self.late.abs() >= LEAST {
            mended = shift(&mended, -self.late);
        }
        if let Some((lost, at)) = self.lost {
            put_back(&mut mended, lost, at.min(samples));
        }
        mended.resize(samples, 0.0);
        mended
    }
}

/// Inserts a straight line in place of samples that were lost, or removes those that were recorded twice.
fn put_back(line: &mut Vec<f64>, lost: i64, at: usize) {
    if lost < 0 {
        let end = (at + lost.unsigned_abs() as usize).min(line.len());
        line.drain(at..end);
        return;
    }
    let count = lost.unsigned_abs() as usize;
    let (left, right) = (at.checked_sub(1).and_then(|i| line.get(i)), line.get(at));
    let [left, right] = [left, right].map(|x| x.copied().unwrap_or(0.0));
    let between = |i: usize| left + (right - left) * (i + 1) as f64 / (count + 1) as f64;
    line.splice(at..at, (0..count).map(between));
}

/// The sample, within `between`, at which `lost` samples are missing in some recordings: that which leaves the smallest residual
/// to the `expected` recordings, which have no gap.
pub(super) fn place(heard: &[&[f64]], expected: &[Vec<f64>], lost: i64, between: [usize; 2]) -> usize {
    let [from, to] = between;
    let length = heard.first().map_or(0, |line| line.len());
    let to = to.min(length);
    // Squared residual at a sample if none of the lost samples precedes it, minus that if all of them do.
    let more = |i: usize| -> f64 {
        let one = |(heard, expected): (&&[f64], &Vec<f64>)| {
            let x = heard.get(i).copied().unwrap_or(0.0);
            let [before, after] = [i as i64, i as i64 + lost]
                .map(|i| usize::try_from(i).ok().and_then(|i| expected.get(i)).copied().unwrap_or(0.0));
            (x - before).powi(2) - (x - after).powi(2)
        };
        heard.iter().zip(expected).map(one).sum()
    };
    let (mut sum, mut best, mut least) = (0.0, from, 0.0);
    for i in from..to {
        sum += more(i);
        if sum < least {
            (best, least) = (i + 1, sum);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(at: f64) -> f64 {
        (0.05 * at).sin() + 0.3 * (0.171 * at).sin()
    }

    #[test]
    fn what_was_lost_is_found_and_put_back() {
        let truth: Vec<f64> = (0..4000).map(|i| tone(f64::from(i))).collect();
        for lost in [64_i64, -40] {
            let mut line = truth.clone();
            match usize::try_from(lost) {
                Ok(count) => drop(line.drain(1700..1700 + count)),
                Err(_) => {
                    let twice = line[1660..1700].to_vec();
                    line.splice(1700..1700, twice);
                }
            }
            let at = place(&[&line], std::slice::from_ref(&truth), lost, [1000, 2500]);
            assert!(at.abs_diff(1700) < 60, "{at}");
            let mend = Mend { lost: Some((lost, at)), ..Mend::default() };
            let mended = mend.of(&line);
            let off = (0..3800).filter(|i| (mended[*i] - truth[*i]).abs() > 1e-9).count();
            assert!(off < 130, "{lost}: {off}");
        }
    }
}
