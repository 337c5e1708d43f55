//! Focal pulses at places and instants, with levels.

use crate::gains::gains;
use crate::recording::{Recorder, Recording};
use crate::settle::settle;
use crate::{FocusError, Options, Target, level, target};
use unripple_core::{Drive, Point, Responses, require, window_samples};

/// Decay, in nepers, after which the past no longer matters to a level: to 1/10 000. Doubled, recordings are
/// twice as long for levels that are right to 1e-8.
const FORGOTTEN: f64 = 9.2;

/// Most samples of all recordings together, half a GiB of them. Doubled, a GiB.
const MOST_VALUES: usize = 1 << 26;

/// A focus at an instant, with the level it is to have.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Where, in metres: a point, or a set of points that are all to have this level.
    pub points: Vec<Point>,
    /// Seconds after the first focus can be, which is one window after the drive begins; rounded to a sample.
    pub instant: f64,
    /// Velocity at each of the points at that instant, in m/s.
    pub level: f64,
}

impl Pulse {
    /// One point (m) at a level (m/s), as early as can be.
    pub fn at(point: Point, level: f64) -> Self {
        Self { points: vec![point], instant: 0.0, level }
    }
}

/// How pulses are struck: window, regularisation and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct PulseOptions {
    /// Seconds that the drive begins before the earliest focus can be.
    pub window: f64,
    /// Tikhonov regularisation: what keeps foci finite that lie too close to differ, as a share of the mean
    /// energy of a response.
    pub ridge: f64,
    /// Largest drive per actuator, in the drive's unit. A drive above it is scaled down as a whole.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// Accuracy of modal responses, as in [`Options`].
    pub accuracy: f64,
}

impl Default for PulseOptions {
    /// 30 ms at a limit of 1.
    fn default() -> Self {
        Self { window: 30e-3, ridge: 1e-6, limit: 1.0, rms_limit: None, accuracy: 1e-8 }
    }
}

/// A drive that strikes pulses.
#[derive(Clone, Debug, PartialEq)]
pub struct Struck {
    /// The drive that is to be sent. It ends with the last focus.
    pub drive: Drive,
    /// Sample of the drive at which each pulse is in focus.
    pub instants: Vec<usize>,
    /// What the limits left of the levels asked for; 1 where they were not reached.
    pub scale: f64,
    /// The points of each pulse: those asked for, or the nearest ones whose responses are stored.
    pub points: Vec<Vec<Point>>,
}

/// The drive of least energy that gives every point of every pulse its level, exactly, at its instant.
///
/// It is a sum of reversed responses, `d_a[j] = Σ_k c_k h_ak[f_k − j]`, one k for each point of each pulse and each as long as
/// the drive so far: all that pulses do to each other is in the levels (Gram system, K x K).
///
/// # Errors
/// [`FocusError::Outside`], [`FocusError::Unknown`] and [`FocusError::Still`] for points that cannot be reached,
/// [`FocusError::Range`] and [`FocusError::Count`] for numbers without meaning or of absurd size, and for modes that never
/// die out.
pub fn strike(responses: &Responses, pulses: &[Pulse], options: &PulseOptions) -> Result<Struck, FocusError> {
    check(responses, pulses, options)?;
    let rate = responses.conditions().rate;
    let window = window_samples(options.window, rate);
    let instants: Vec<usize> =
        pulses.iter().map(|p| window.saturating_add(window_samples(p.instant, rate))).collect();
    let last = instants.iter().copied().max().unwrap_or(0);
    let length =
        settle(responses, FORGOTTEN).map_or(last.saturating_add(1), |most| most.min(last.saturating_add(1)));
    let count: usize = pulses.iter().map(|p| p.points.len()).sum();
    let ports = responses.ports().len();
    let values = length.saturating_mul(count).saturating_mul(ports);
    if values > MOST_VALUES || last.saturating_mul(ports) > MOST_VALUES {
        let expected =
            format!("at most {MOST_VALUES} over all points and actuators: fewer pulses or a shorter time");
        return Err(FocusError::Count {
            what: "samples of the responses of pulses",
            expected,
            found: values,
        });
    }
    let recording = Options { window: options.window, accuracy: options.accuracy, ..Options::default() };
    let recorder = Recorder::plan(responses, length, &recording)?;
    let mut all: Vec<Recording> = Vec::with_capacity(count);
    let (mut at, mut levels) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for (index, (pulse, instant)) in pulses.iter().zip(&instants).enumerate() {
        for point in &pulse.points {
            all.push(recorder.record(index, std::slice::from_ref(point))?);
            at.push(*instant);
            levels.push(pulse.level);
        }
    }
    let gains = gains(&all, &at, &levels, (ports, rate), options.ridge)?;
    let mut channels = vec![vec![0.0; last + 1]; ports];
    for ((recording, instant), gain) in all.iter().zip(&at).zip(gains) {
        for (channel, response) in channels.iter_mut().zip(recording.samples.chunks_exact(length)) {
            let sent = channel[..=*instant].iter_mut().rev();
            sent.zip(response).for_each(|(d, h)| *d += gain * h);
        }
    }
    let scale = level::hold(&mut channels, options.limit, options.rms_limit);
    let names = responses.ports().iter().map(|port| port.name.clone()).collect();
    let mut places = all.into_iter().flat_map(|recording| recording.points);
    let points = pulses.iter().map(|p| places.by_ref().take(p.points.len()).collect()).collect();
    Ok(Struck { drive: Drive::new(rate, names, channels)?, instants, scale, points })
}

fn check(responses: &Responses, pulses: &[Pulse], options: &PulseOptions) -> Result<(), FocusError> {
    let positive = |x: f64| x.is_finite() && x > 0.0;
    for (what, x) in [
        ("window (s)", options.window),
        ("limit", options.limit),
        ("rms limit", options.rms_limit.unwrap_or(1.0)),
        ("accuracy", options.accuracy),
    ] {
        require(what, positive(x), "a positive number", x)?;
    }
    require("ridge", (0.0..=1.0).contains(&options.ridge), "0 to 1", options.ridge)?;
    let of = |p: &Pulse| Target { points: p.points.clone(), gain: p.level, rate_hz: None };
    target::check(&pulses.iter().map(of).collect::<Vec<_>>(), &responses.conditions().outline)?;
    if responses.ports().is_empty() {
        return Err(FocusError::Count { what: "actuators", expected: "at least 1".to_owned(), found: 0 });
    }
    for (index, pulse) in pulses.iter().enumerate() {
        let legal = pulse.instant.is_finite() && pulse.instant >= 0.0;
        require(format!("instant of pulse {} (s)", index + 1), legal, "0 or more", pulse.instant)?;
    }
    Ok(())
}
