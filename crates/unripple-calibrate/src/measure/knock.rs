//! Detection of knocks: short sounds in a recording that the drive does not explain, such as a door or a dropped tool.

use crate::signals::{Band, Sweep};
use std::f64::consts::TAU;
use unripple_dsp::{FourierPlanner, median};

/// Duration of a frame of the spectrogram, in s: spectral lines are 47 Hz apart.
const FRAME: f64 = 0.0213;

/// Level above that explained by sweeps and noise, in dB, that [`LOUD`] of all spectral lines of a frame
/// must exceed for the frame to contain a knock. For white noise this level scatters by 1.5 dB.
const STANDS_OUT: f64 = 8.0;

/// Share of the spectral lines that must be loud. A third: a soft knock has little in the upper lines, while of a sweep's harmonics few
/// are in the band at one time.
const LOUD: f64 = 1.0 / 3.0;

/// Largest share of all frames that knocks may take up. More is not short: noise, or a surface that rings longer than its file
/// says.
const MOST: f64 = 0.25;

/// Quantile of a line's power over time from which its noise is estimated, and the factor from this quantile
/// to the mean power of noise. 0.357 is -ln(1 - 0.3): the power of noise in a line is exponentially
/// distributed.
const QUIETEST: (f64, f64) = (0.3, 1.0 / 0.357);

/// Power below which spectral lines are ignored, relative to the largest power of any line in a sweep: a knock that matters is 20 dB
/// above it, and what a sweep leaks into lines that it has yet to pass, as where it begins, is below it. It is not relative to the
/// knock, whose low lines may be 50 dB above its middle ones.
const FLOOR: f64 = 1e-4;

/// Quiet frames that separate two knocks: 43 ms, since frames overlap by half. With fewer, a bounce would
/// count as another knock.
const APART: usize = 4;

/// Number of frames within which the level of a knock rises: the last has no sample in common with the frame
/// before the first.
const RISE: usize = 3;

/// A knock: a short sound in a recording that was not played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knock {
    /// Beginning of the knock, in samples.
    pub at: usize,
    /// Energy of the knock, relative to that of an average recorded sweep, both within the band.
    pub share: f64,
}

/// The times at which the sweeps pass each frequency.
pub(super) struct Sweeps<'a> {
    /// The sweep that every actuator plays.
    pub sweep: &'a Sweep,
    /// First sample of each actuator's sweep.
    pub starts: &'a [usize],
    /// Latency of the recording, in samples.
    pub latency: f64,
    /// Longest amplitude decay time of the surface, in s.
    pub decay: f64,
    /// The band in which responses are measured.
    pub band: Band,
}

impl Sweeps<'_> {
    /// Finds knocks in the recording of one input, `line`, in order of time: frames in which a third of all
    /// spectral lines are louder than noise and the ringing after the sweeps. Returns none if there are too
    /// many such frames.
    pub fn knocks(&self, line: &[f64]) -> Vec<Knock> {
        let rate = self.sweep.rate;
        let size = ((FRAME * rate) as usize).next_multiple_of(2).max(16);
        let powers = spectrogram(line, size);
        let width = rate / size as f64;
        let [first, end] = [self.band.low[1] / width, self.band.high[0] / width].map(|x| x.round() as usize);
        let end = end.min(size / 2);
        if powers.len() < 8 || end < first + 6 {
            return Vec::new();
        }
        let at = |line: usize| self.passes(width * line as f64, size, powers.len());
        let expected: Vec<Vec<f64>> =
            (first..end).map(|line| self.expected(&powers, line, &at(line), size)).collect();
        let most = (first..end).map(|line| usual_power(&powers, line, &at(line))).fold(0.0, f64::max);
        let above = |frame: usize, known: &dyn Fn(usize) -> f64| {
            let ratio = |line: usize| {
                10.0 * ((powers[frame][line] + FLOOR * most) / (known(line) + FLOOR * most)).log10()
            };
            let mut ratios: Vec<f64> = (first..end).map(ratio).collect();
            ratios.sort_unstable_by(|a, b| b.total_cmp(a));
            ratios[(LOUD * ratios.len() as f64) as usize]
        };
        let over = |frame: usize| above(frame, &|line| expected[line - first][frame]);
        let scores: Vec<f64> = (0..powers.len()).map(over).collect();
        let usual = median(scores.iter().copied()).unwrap_or(0.0).max(0.0);
        let loud: Vec<usize> = (0..scores.len()).filter(|i| scores[*i] > usual + STANDS_OUT).collect();
        if loud.len() as f64 > MOST * scores.len() as f64 {
            return Vec::new();
        }
        // Modes that beat grow slowly, and at different times.
        let sudden = |frames: &&[usize]| {
            let mut near = frames[0]..(frames[0] + RISE).min(powers.len());
            near.any(|frame| above(frame, &|line| powers[frame.saturating_sub(RISE)][line]) > STANDS_OUT)
        };
        let within = |frame: usize| powers[frame][first..end].iter().sum::<f64>();
        let all = (0..powers.len()).map(within).sum::<f64>() / self.starts.len().max(1) as f64;
        let excess = |frame: &usize| {
            let left = (first..end).map(|line| powers[*frame][line] - expected[line - first][*frame]);
            left.map(|x| x.max(0.0)).sum::<f64>()
        };
        let together = loud.chunk_by(|a, b| b - a <= APART);
        together
            .filter(sudden)
            .map(|frames| Knock {
                at: frames[0] * size / 2 + size / 4,
                share: frames.iter().map(excess).sum::<f64>() / all.max(f64::MIN_POSITIVE),
            })
            .collect()
    }

    /// First and last frame in which each sweep passes a frequency.
    fn passes(&self, hz: f64, size: usize, frames: usize) -> Vec<[usize; 2]> {
        let half = size as f64 / 2.0;
        let passed =
            self.sweep.growth() * self.sweep.rate * (hz / self.sweep.from).max(1.0).ln() + self.latency;
        let frame = |sample: f64| ((sample / half) as usize).min(frames - 1);
        let around = |start: &usize| {
            let at = *start as f64 + passed;
            [frame((at - 3.0 * half).max(0.0)), frame(at + 3.0 * half)]
        };
        self.starts.iter().map(around).collect()
    }

    /// Power of a spectral line that sweeps and noise explain, frame by frame.
    fn expected(&self, powers: &[Vec<f64>], line: usize, passes: &[[usize; 2]], size: usize) -> Vec<f64> {
        let half = size as f64 / 2.0;
        let fall = (-2.0 * half / self.sweep.rate / self.decay).exp();
        let mut sorted: Vec<f64> = powers.iter().map(|frame| frame[line]).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let noise = QUIETEST.1 * sorted[(QUIETEST.0 * sorted.len() as f64) as usize];
        let mut expected = vec![noise; powers.len()];
        for pass in passes {
            let mut left = loudest(powers, line, pass);
            for (i, expected) in expected.iter_mut().enumerate().skip(pass[0]) {
                *expected += left;
                left *= if i >= pass[1] { fall } else { 1.0 };
            }
        }
        expected
    }
}

/// Largest power of a spectral line while a sweep passes it.
fn loudest(powers: &[Vec<f64>], line: usize, [from, to]: &[usize; 2]) -> f64 {
    (*from..=*to).map(|i| powers[i][line]).fold(0.0, f64::max)
}

/// Median over the sweeps of the largest power of a spectral line while they pass it: a knock hits few of them.
fn usual_power(powers: &[Vec<f64>], line: usize, passes: &[[usize; 2]]) -> f64 {
    median(passes.iter().map(|pass| loudest(powers, line, pass))).unwrap_or(0.0)
}

/// Powers of Hann-windowed frames, half of a frame apart, `[frame][line]`.
fn spectrogram(signal: &[f64], size: usize) -> Vec<Vec<f64>> {
    let plan = FourierPlanner::new().forward(size);
    let (mut input, mut lines) = (plan.make_input_vec(), plan.make_output_vec());
    let window: Vec<f64> =
        (0..size).map(|i| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / size as f64).cos()).collect();
    let count = (2 * signal.len() / size).saturating_sub(1);
    (0..count)
        .map(|frame| {
            let from = &signal[frame * size / 2..][..size];
            input.iter_mut().zip(from).zip(&window).for_each(|((to, x), w)| *to = x * w);
            let done = plan.process(&mut input, &mut lines);
            debug_assert!(done.is_ok(), "sizes come from the plan itself");
            lines.iter().map(|x| x.norm_sqr()).collect()
        })
        .collect()
}
