//! Computes drives that focus on targets, by any [`Method`].

use crate::magnitude::{energy, peak};
use crate::planned::Planned;
use crate::recording::{Recorder, Recording};
use crate::schedule::{self, MOST_SAMPLES, Schedule};
use crate::settle::settle;
use crate::{FeltPlan, FocusError, Focused, LossCorrection, Method, Options, Shaping, Target, Timing};
use unripple_core::{Drive, Point, Responses, require, window_samples};

/// Decay, in nepers, after which earlier periods no longer matter to a repeated drive: to 1/1000. With twice this value, repeated
/// drives last longer by as much, and are periodic to 1e-6.
const SETTLED: f64 = 6.9;

/// Computes drives for many targets on one surface: what does not depend on the targets is computed once.
#[derive(Debug)]
pub struct Focuser<'r> {
    responses: &'r Responses,
    others: &'r [Responses],
    maker: Maker<'r>,
    options: Options,
    window: usize,
}

/// The computation of drives, by kind of method.
#[derive(Debug)]
enum Maker<'r> {
    /// Reverses responses in time: time reversal and one-bit.
    Reversal(Recorder<'r>),
    /// Optimises the state at the focal instant: inverse, concentrate, limited and robust.
    Planned(Box<Planned<'r>>),
    /// Minimises what a fingertip would feel outside the targets.
    Felt(Box<FeltPlan<'r>>),
}

impl<'r> Focuser<'r> {
    /// Prepares the computation of drives for a surface with these responses, by the method and for the
    /// window of `options`.
    ///
    /// # Errors
    /// [`FocusError::Range`] for options out of range, [`FocusError::Count`] for a window of no sample, of too many, or
    /// longer than the responses, [`FocusError::NeedsModes`] where the method needs modal responses and these are
    /// sampled, [`FocusError::Decomposition`] where a matrix of the responses is not positive definite.
    pub fn new(responses: &'r Responses, options: &Options) -> Result<Self, FocusError> {
        Self::beside(responses, &[], options)
    }

    /// Prepares the computation of drives for a surface and variants of it, such as with another tension or
    /// under a finger. [`Method::Robust`] minimises the velocity outside the targets on the variants as
    /// well; other methods ignore them.
    ///
    /// # Errors
    /// As [`Focuser::new`], and if a variant has another number of actuators or another sample rate.
    pub fn beside(
        responses: &'r Responses,
        others: &'r [Responses],
        options: &Options,
    ) -> Result<Self, FocusError> {
        options.check()?;
        let window = window_samples(options.window, responses.conditions().rate);
        let channels = responses.ports().len();
        let count = |what, expected, found| Err(FocusError::Count { what, expected, found });
        if channels == 0 {
            return count("actuators", "at least 1".to_owned(), 0);
        }
        if window == 0 {
            let sample = 1e3 / responses.conditions().rate;
            return count("samples of the window after the first", format!("at least 1 ({sample:.4} ms)"), 0);
        }
        if window >= MOST_SAMPLES / channels {
            let most = MOST_SAMPLES / channels - 1;
            return count("samples of the window after the first", format!("at most {most}"), window);
        }
        let maker = match options.method.reverses() {
            true => Maker::Reversal(Recorder::plan(responses, window + 1, options)?),
            false if options.method == Method::Felt => {
                Maker::Felt(Box::new(FeltPlan::new(responses, &options.felt())?))
            }
            false => Maker::Planned(Box::new(Planned::new(responses, others, options, window + 1, false)?)),
        };
        Ok(Self { responses, others, maker, options: options.clone(), window })
    }

    /// The responses from which drives are computed.
    pub fn responses(&self) -> &'r Responses {
        self.responses
    }

    /// The drive that focuses on these targets.
    ///
    /// Time reversal works as follows; [`Method`] describes the others. With h_ak the velocity response of target k to
    /// actuator a, the reversed responses are superposed, `d_a[j] = Σ_k gain_k Σ_f h_ak[f − j]`, with f the instants at
    /// which target k is to be in focus (n, or n and every period after it), and then scaled to the limits (Hudin et
    /// al. 2012, eq. 1). The sum over a target's points is normalised as [`Target::gain`] says.
    ///
    /// # Errors
    /// As [`focus`].
    pub fn focus(&self, targets: &[Target]) -> Result<Focused, FocusError> {
        self.focus_at(targets, 1.0)
    }

    /// The drive that focuses on these targets at `share` (a dimensionless factor) of the level that
    /// [`Focuser::focus`] reaches. [`Method::Limited`] solves for that level, and the waveforms change;
    /// drives of other methods are scaled.
    ///
    /// # Errors
    /// As [`focus`]; [`FocusError::Range`] for a share that is no positive number.
    pub fn focus_at(&self, targets: &[Target], share: f64) -> Result<Focused, FocusError> {
        let positive = share.is_finite() && share > 0.0;
        require("share of the level at the limit", positive, "a positive number", share)?;
        Target::check(targets, &self.responses.conditions().outline)?;
        let schedule = self.schedule(targets)?;
        let mut channels = vec![vec![0.0; schedule.length]; self.responses.ports().len()];
        let mut shaping = match self.options.method {
            Method::OneBit => Shaping::Shaped,
            _ => Shaping::Unshaped,
        };
        let points = match &self.maker {
            Maker::Reversal(recorder) => self.reverse(recorder, targets, &schedule, &mut channels)?,
            Maker::Planned(planned) => {
                let sought = self.seek(planned, targets, &schedule, share, &mut channels)?;
                shaping = sought.1;
                sought.0
            }
            Maker::Felt(plan) => {
                let focused = plan.focus(targets)?;
                return Ok(Focused { drive: focused.drive.scaled(share), ..focused });
            }
        };
        // A drive solved for a level below that of the limits keeps them already, and is not scaled up.
        let solved = self.options.method == Method::Limited && share != 1.0;
        self.limit(&mut channels, solved)?;
        let names = self.responses.ports().iter().map(|port| port.name.clone()).collect();
        let drive = Drive::new(self.responses.conditions().rate, names, channels)?;
        let drive = if solved || share == 1.0 { drive } else { drive.scaled(share) };
        Ok(Focused {
            drive,
            timing: schedule.timing,
            period: schedule.period,
            points,
            method: self.options.method,
            shaping,
        })
    }

    /// Superposes reversed responses.
    fn reverse(
        &self,
        recorder: &Recorder<'_>,
        targets: &[Target],
        schedule: &Schedule,
        channels: &mut [Vec<f64>],
    ) -> Result<Vec<Vec<Point>>, FocusError> {
        let mut points = Vec::with_capacity(targets.len());
        for (index, target) in targets.iter().enumerate() {
            let mut recording = recorder.record(index, &target.points)?;
            self.correct(&mut recording);
            for instant in schedule.instants(schedule.timing[index]) {
                self.add_reversed(&recording, target.gain, instant, channels);
            }
            points.push(recording.points);
        }
        Ok(points)
    }

    /// Superposes optimised drives: one for all targets that are not repeated, and one for the targets of
    /// each repetition period. Returns the points of each target, and the strongest change that the limits
    /// made to any of the drives.
    fn seek(
        &self,
        once: &Planned<'_>,
        targets: &[Target],
        schedule: &Schedule,
        share: f64,
        channels: &mut [Vec<f64>],
    ) -> Result<(Vec<Vec<Point>>, Shaping), FocusError> {
        let mut points = vec![Vec::new(); targets.len()];
        let mut shaping = Shaping::Unshaped;
        let mut timings: Vec<Timing> = Vec::new();
        for timing in &schedule.timing {
            if !timings.contains(timing) {
                timings.push(*timing);
            }
        }
        for timing in timings {
            let group: Vec<(usize, &Target)> =
                targets.iter().enumerate().filter(|(i, _)| schedule.timing[*i] == timing).collect();
            let sought = match timing.period {
                None => once.drive(&group, share)?,
                Some(period) => {
                    let steady = Planned::new(self.responses, self.others, &self.options, period, true)?;
                    steady.drive(&group, share)?
                }
            };
            add(&sought.drive, timing, self.window, channels);
            group.iter().zip(sought.points).for_each(|((index, _), used)| points[*index] = used);
            shaping = shaping.max(sought.shaping);
        }
        Ok((points, shaping))
    }

    /// When each target is in focus.
    fn schedule(&self, targets: &[Target]) -> Result<Schedule, FocusError> {
        let rate = self.responses.conditions().rate;
        let rates: Vec<_> = targets.iter().map(|target| target.rate_hz).collect();
        let conditions = schedule::Conditions {
            rate,
            window: self.window,
            channels: self.responses.ports().len(),
            duration: self.options.duration.map(|seconds| window_samples(seconds, rate)),
            settle: settle(self.responses, SETTLED),
        };
        Schedule::plan(&rates, conditions)
    }

    /// Multiplies responses by e^{+t/τ}, if the options request it.
    fn correct(&self, recording: &mut Recording) {
        if let LossCorrection::Uniform(tau) = self.options.loss {
            let step = 1.0 / (tau * self.responses.conditions().rate);
            for row in recording.samples.chunks_exact_mut(self.window + 1) {
                row.iter_mut().enumerate().for_each(|(i, h)| *h *= (i as f64 * step).exp());
            }
        }
    }

    /// Adds responses played backwards, so that their first sample falls on `instant`.
    fn add_reversed(&self, recording: &Recording, gain: f64, instant: usize, channels: &mut [Vec<f64>]) {
        for (channel, row) in channels.iter_mut().zip(recording.samples.chunks_exact(self.window + 1)) {
            let first = instant - self.window;
            let end = channel.len().min(instant + 1);
            let reversed = row.iter().rev();
            channel[first..end].iter_mut().zip(reversed).for_each(|(d, h)| *d += gain * h);
        }
    }

    /// Scales the drive so that its peak equals `limit`, then down if an rms limit requires it. A drive that
    /// was `solved` for its level is only scaled down.
    fn limit(&self, channels: &mut [Vec<f64>], solved: bool) -> Result<(), FocusError> {
        let limit = self.options.limit;
        let peak = channels.iter().map(|channel| peak(channel)).fold(0.0, f64::max);
        let usable = peak.is_finite() && peak > 0.0;
        require("peak of the unscaled drive", usable, "a positive finite number", peak)?;
        let power = self.options.rms_limit.is_some() || self.options.total_rms.is_some();
        let shape = |d: f64| match self.options.method {
            Method::OneBit if d == 0.0 => 0.0,
            Method::OneBit => limit.copysign(d),
            // It keeps all limits already, and may stay below the peak for the sake of the rms.
            Method::Limited if (power || solved) && peak <= limit * (1.0 + 1e-9) => d.clamp(-limit, limit),
            _ => d / peak * limit,
        };
        for channel in channels.iter_mut() {
            channel.iter_mut().for_each(|d| *d = shape(*d));
        }
        let squares: Vec<f64> = channels.iter().map(|c| energy(c) / c.len() as f64).collect();
        let largest = squares.iter().copied().fold(0.0, f64::max).sqrt();
        let together = squares.iter().sum::<f64>().sqrt();
        let share = |limit: Option<f64>, found: f64| limit.map_or(1.0, |limit| limit / found);
        let scale = share(self.options.rms_limit, largest).min(share(self.options.total_rms, together));
        if scale < 1.0 {
            channels.iter_mut().flatten().for_each(|d| *d *= scale);
        }
        Ok(())
    }
}

/// Adds a drive whose last sample is the focal instant: once, or repeated with its period over the whole length.
fn add(drive: &[f64], timing: Timing, window: usize, channels: &mut [Vec<f64>]) {
    let length = drive.len() / channels.len().max(1);
    for (channel, part) in channels.iter_mut().zip(drive.chunks_exact(length)) {
        match timing.period {
            None => {
                let first = timing.instant - window;
                channel[first..].iter_mut().zip(part).for_each(|(d, part)| *d += part);
            }
            Some(period) => {
                let shift = period - 1 - timing.instant % period;
                let wave = part.iter().cycle().skip(shift);
                channel.iter_mut().zip(wave).for_each(|(d, part)| *d += part);
            }
        }
    }
}

/// Computes the drive that focuses on `targets` on a surface with these responses: one channel per actuator,
/// at the sample rate of the responses.
///
/// # Errors
/// [`FocusError::Outside`], [`FocusError::Unknown`] and [`FocusError::Still`] for targets that cannot be
/// reached, [`FocusError::Range`] and [`FocusError::Count`] for numbers and counts out of range,
/// [`FocusError::NeedsModes`] where sampled responses are not enough, [`FocusError::Inseparable`] for
/// targets of [`Method::Felt`] too close to each other for different levels, [`FocusError::Decomposition`]
/// and [`FocusError::Gap`] where an optimum is not found.
pub fn focus(responses: &Responses, targets: &[Target], options: &Options) -> Result<Focused, FocusError> {
    Focuser::new(responses, options)?.focus(targets)
}
