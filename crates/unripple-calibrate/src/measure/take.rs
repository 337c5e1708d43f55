//! One recording (take), corrected to the clock, time and tension of the first.

use super::account::{Account, Lost};
use super::apart::Apart;
use super::law::Law;
use super::mend::{Mend, place};
use super::telling::Telling;
use super::timing::{Sweep, Timing};
use crate::CalibrateError;
use crate::signals::Band;
use unripple_dsp::convolve;

/// Largest error of the clock that is corrected, in parts per million: 200, and a little more for the error of measuring it.
const MOST_PPM: f64 = 203.0;

/// Largest number of rounds of estimating and correcting: each leaves a hundredth of the error.
const ROUNDS: usize = 5;

/// Number of standard errors above which a difference counts as real.
const SURE: f64 = 5.0;

/// Error of the clock, in parts per million, below which clocks count as equal, however small the standard error.
const LEAST_PPM: f64 = 0.2;

/// Relative change of tension below which the change counts as zero, however small the standard error.
const LEAST_CHANGE: f64 = 2e-5;

/// Fewest sweeps from which an error of the clock is found, unless there are only two, which correlate well.
const FEWEST: usize = 3;

/// Smallest correlation of two sweeps from which an error of the clock is found when there are no others. By
/// chance two sweeps hardly ever correlate that well, as their responses differ.
const ALIKE: f64 = 0.95;

/// Largest unexplained rms deviation of the sweeps' times that is accepted, as a share of the shortest period swept: it costs a focus 2 %
/// of its height.
const HARMLESS: f64 = 1.0 / 32.0;

/// Function that deconvolves the recording of one input by the sweep; the result is periodic.
type Deconvolve<'a> = dyn Fn(&[f64]) -> Result<Vec<f64>, CalibrateError> + 'a;

/// Everything with which a take is compared: the first take, the schedule, the band.
pub(super) struct Judge<'a> {
    /// Indices of the actuators whose sensors are used; empty if a reference channel, which records the sent signal, is used instead.
    pub sensors: &'a [usize],
    /// Responses at the sensors of `sensors` in the first take, `[sensor][actuator][sample]` from time 0;
    /// `None` in the first take itself.
    pub known: Option<&'a [Vec<Vec<f64>>]>,
    /// First sample of each actuator's sweep.
    pub starts: &'a [usize],
    /// Length of a sweep without the silence after it, in samples.
    pub sounding: usize,
    /// The signals that are played, `[output][sample]`.
    pub drive: &'a [Vec<f64>],
    /// Number of samples before time 0 with which a response begins.
    pub lead: usize,
    /// Number of samples of a response that are compared, lead included: few enough to exclude the
    /// neighbouring sweeps.
    pub length: usize,
    /// Latency of the device, in samples.
    pub latency: f64,
    /// Samples per second.
    pub rate: f64,
    /// The band in which responses are measured.
    pub band: Band,
    /// Shift of natural frequencies with tension or stiffness.
    pub law: &'a Law,
    /// Deconvolves a recording by the sweep.
    pub deconvolve: &'a Deconvolve<'a>,
    /// Whether a deconvolved recording is well above the noise.
    pub clear: &'a dyn Fn(&[f64]) -> bool,
}

/// The findings on a take, and the corrections that follow from them.
#[derive(Clone, Debug, Default)]
pub(super) struct Verdict {
    /// Account of the recording, for the user.
    pub account: Account,
    /// Corrections of clock, delay and gaps.
    pub mend: Mend,
    /// Relative change of tension at the start of each sweep, and its rate per second; `None` if tension has
    /// not changed.
    pub changes: Option<Vec<[f64; 2]>>,
    /// Indices of sweeps whose sensor signals differ from those of the first take for other reasons than
    /// noise.
    pub unlike: Vec<usize>,
}

impl Judge<'_> {
    /// Finds clock error, delay, gaps and change of tension of a take from the recordings of its sensors, one each.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] for clocks too far apart, samples lost at a place that cannot be found, and sweeps at times that
    /// neither explains.
    pub fn judge(&self, heard: &[&[f64]]) -> Result<Verdict, CalibrateError> {
        let mut verdict = Verdict::default();
        if heard.is_empty() || self.starts.len() < 2 {
            return Ok(verdict);
        }
        let samples = heard.iter().map(|line| line.len()).max().unwrap_or(0);
        let mut found = Vec::new();
        for _ in 0..ROUNDS {
            let lines: Vec<Vec<f64>> = heard.iter().map(|line| verdict.mend.of(line)).collect();
            found = self.sweeps(&lines)?;
            let Some(timing) = self.timing(&mut verdict, &found)? else { break };
            if !self.learn(&mut verdict, &timing, &lines)? {
                break;
            }
            if !verdict.mend.is_needed(samples) {
                break;
            }
        }
        if !self.sensors.is_empty() {
            self.tell(&mut verdict, &found);
        }
        verdict.unlike = self.unlike(&verdict, &found, heard)?;
        Ok(verdict)
    }

    /// Sweeps that are in the first take and that are not recognised in this one, although the recording is
    /// well above the noise.
    fn unlike(
        &self,
        verdict: &Verdict,
        found: &[Option<Apart>],
        heard: &[&[f64]],
    ) -> Result<Vec<usize>, CalibrateError> {
        let known = self.known.filter(|_| !self.sensors.is_empty()).unwrap_or_default();
        let sounded = |sweep: &usize| {
            known.iter().filter_map(|rows| rows.get(*sweep)).flatten().any(|sample| *sample != 0.0)
        };
        let unlike: Vec<usize> = (0..found.len()).filter(|n| found[*n].is_none()).filter(sounded).collect();
        if unlike.is_empty() {
            return Ok(unlike);
        }
        let mut clear = 0;
        for line in heard {
            clear += usize::from((self.clear)(&(self.deconvolve)(&verdict.mend.of(line))?));
        }
        Ok(if 2 * clear > heard.len() { unlike } else { Vec::new() })
    }

    fn sweeps(&self, lines: &[Vec<f64>]) -> Result<Vec<Option<Apart>>, CalibrateError> {
        let wholes = lines.iter().map(|line| (self.deconvolve)(line)).collect::<Result<Vec<_>, _>>()?;
        let telling = Telling {
            sensors: self.sensors,
            wholes: &wholes,
            starts: self.starts,
            lead: self.lead,
            rate: self.rate,
            band: self.band,
            law: self.law,
        };
        Ok(match self.known {
            _ if self.sensors.is_empty() => telling.beside_the_loudest(self.length),
            Some(known) => telling.beside(known),
            None => telling.beside_each_other(self.length),
        })
    }

    /// Clock error and lost samples from the sweeps' delays; `None` for too few sweeps.
    fn timing(
        &self,
        verdict: &mut Verdict,
        found: &[Option<Apart>],
    ) -> Result<Option<Timing>, CalibrateError> {
        let known = found.iter().zip(self.starts).enumerate();
        let sweeps: Vec<Sweep> = known
            .filter_map(|(number, (apart, start))| {
                let apart = apart.as_ref()?;
                Some(Sweep { number, start: *start as f64, late: apart.late, error: apart.errors[0] })
            })
            .collect();
        let alike = found.iter().flatten().all(|apart| apart.likeness >= ALIKE);
        if sweeps.len() < FEWEST && !(alike && sweeps.len() == 2) {
            return Ok(None);
        }
        let explained = Timing::of(&sweeps);
        verdict.account.scatter = None;
        if explained.is_some() {
            return Ok(explained);
        }
        let near = Timing::nearest(&sweeps);
        let scatter = near.map_or(0.0, |near| near.rest);
        if scatter > HARMLESS * self.rate / self.band.high[0] {
            let lates = || sweeps.iter().map(|sweep| sweep.late);
            let [from, to] =
                [lates().fold(f64::INFINITY, f64::min), lates().fold(f64::NEG_INFINITY, f64::max)];
            return Err(CalibrateError::Recording {
                what: "arrival times of the sweeps".into(),
                expected: "those of one clock, with samples lost at one place at most".into(),
                found: format!(
                    "sweeps between {from:+.1} and {to:+.1} samples late (samples lost at several places, a clock that is not steady, or a \
                     latency that jitters)"
                ),
            });
        }
        verdict.account.scatter = Some(scatter);
        Ok(near)
    }

    /// Adds the corrections that follow from the delays; returns whether there are any new ones.
    fn learn(
        &self,
        verdict: &mut Verdict,
        timing: &Timing,
        lines: &[Vec<f64>],
    ) -> Result<bool, CalibrateError> {
        let mut new = false;
        if timing.clock {
            verdict.account.clock_error_ppm = 1e6 * timing.slope_error;
        }
        if timing.slope.abs() > (SURE * timing.slope_error).max(1e-6 * LEAST_PPM) {
            verdict.mend.quick += timing.slope;
            new = true;
        }
        let ppm = 1e6 * verdict.mend.quick;
        if ppm.abs() > MOST_PPM {
            return Err(CalibrateError::Recording {
                what: "clocks of playing and recording".into(),
                expected: "at most 200 millionths apart (one card for both, or two that are synchronised)"
                    .into(),
                found: format!("{ppm:+.1} millionths"),
            });
        }
        if timing.clock {
            verdict.account.clock_ppm = Some(ppm);
        }
        // Comparing sweeps with each other does not show a delay common to all.
        if self.known.is_some() {
            new |= timing.late.abs() >= LEAST_LATE;
            verdict.mend.late += timing.late;
            verdict.account.late = Some(verdict.mend.late);
        }
        // The place is searched after everything else is corrected.
        if let Some((lost, numbers)) = timing.lost.filter(|_| !new) {
            self.lose(verdict, lost, numbers, lines)?;
            new = true;
        }
        Ok(new)
    }

    /// Finds where samples were lost, between two sweeps.
    fn lose(
        &self,
        verdict: &mut Verdict,
        lost: i64,
        [before, after]: [usize; 2],
        lines: &[Vec<f64>],
    ) -> Result<(), CalibrateError> {
        let late = self.latency.max(0.0) as usize;
        let between = [self.starts[before], self.starts[after] + self.sounding].map(|i| i + late);
        let said = |between: [usize; 2]| Lost {
            samples: lost,
            between_s: between.map(|i| i as f64 / self.rate),
            sweeps: [before + 1, after + 1],
        };
        let Some(known) = self.known.filter(|_| verdict.mend.lost.is_none()) else {
            return Err(CalibrateError::Recording {
                what: "recording".into(),
                expected: "all samples that were played".into(),
                found: said(between).said(),
            });
        };
        let lines: Vec<&[f64]> = lines.iter().map(Vec::as_slice).collect();
        let expected: Vec<Vec<f64>> =
            known.iter().map(|known| self.expected(known, lines[0].len())).collect();
        let at = place(&lines, &expected, lost, between);
        verdict.mend.lost = Some((lost, at));
        verdict.account.lost.push(said([at, at + lost.unsigned_abs() as usize]));
        Ok(())
    }

    /// The signal that a sensor should record, from its responses to each actuator in the first take.
    fn expected(&self, known: &[Vec<f64>], samples: usize) -> Vec<f64> {
        let mut sum = vec![0.0; samples];
        for (response, drive) in known.iter().zip(self.drive) {
            let heard = convolve(drive, response);
            sum.iter_mut().zip(heard).for_each(|(sum, x)| *sum += x / self.rate);
        }
        if self.latency == 0.0 { sum } else { crate::signals::shift(&sum, self.latency) }
    }

    /// Stores the course of tension in the account, and in `changes` if it is to be corrected.
    fn tell(&self, verdict: &mut Verdict, found: &[Option<Apart>]) {
        verdict.account.of_stiffness = !self.law.tension;
        let known: Vec<(f64, Apart)> = found
            .iter()
            .zip(self.starts)
            .filter_map(|(apart, start)| Some((*start as f64 / self.rate, (*apart)?)))
            .collect();
        if known.len() < FEWEST {
            return;
        }
        let sure = |apart: &Apart| apart.change.abs() > (SURE * apart.errors[1]).max(LEAST_CHANGE);
        let course = Course::of(&known);
        let first_last = [0, self.starts.len() - 1].map(|i| course.at(self.starts[i] as f64 / self.rate)[0]);
        verdict.account.drift = Some(first_last);
        // A single change may be significant by chance: tension counts as drifting if the changes of half of
        // the sweeps are.
        if 2 * known.iter().filter(|(_, apart)| sure(apart)).count() >= known.len() {
            let at = |start: &usize| course.at(*start as f64 / self.rate);
            verdict.changes = Some(self.starts.iter().map(at).collect());
        } else {
            verdict.account.drift = Some([0.0; 2]);
        }
    }
}

/// Smallest delay, in samples, that is followed by another round of correction.
const LEAST_LATE: f64 = 0.02;

/// Change of tension over the time of a take: a straight line, or straight lines from sweep to sweep if one
/// does not fit.
struct Course {
    line: Option<[f64; 2]>,
    known: Vec<[f64; 2]>,
}

impl Course {
    fn of(known: &[(f64, Apart)]) -> Self {
        let count = known.len() as f64;
        let mean = |value: &dyn Fn(&(f64, Apart)) -> f64| known.iter().map(value).sum::<f64>() / count;
        let [t, x] = [mean(&|(t, _)| *t), mean(&|(_, apart)| apart.change)];
        let square = mean(&|(at, _)| (at - t).powi(2));
        let slope =
            if square > 0.0 { mean(&|(at, apart)| (at - t) * (apart.change - x)) / square } else { 0.0 };
        let rest = mean(&|(at, apart)| (apart.change - x - slope * (at - t)).powi(2)).sqrt();
        let error = mean(&|(_, apart)| apart.errors[1].powi(2)).sqrt();
        let line = (rest <= 2.0 * error + LEAST_CHANGE).then_some([x - slope * t, slope]);
        Self { line, known: known.iter().map(|(t, apart)| [*t, apart.change]).collect() }
    }

    /// Change at a time (s), and its rate per second.
    fn at(&self, time: f64) -> [f64; 2] {
        if let Some([at_0, slope]) = self.line {
            return [at_0 + slope * time, slope];
        }
        let last = self.known.len() - 1;
        let right = self.known.iter().position(|[t, _]| *t >= time).unwrap_or(last).clamp(1, last);
        let ([a, x], [b, y]) = (self.known[right - 1], self.known[right]);
        let slope = (y - x) / (b - a);
        [x + slope * (time.clamp(a, b) - a), slope]
    }
}
