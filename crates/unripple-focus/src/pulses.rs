//! Focal pulses with prescribed points, instants and velocities.

use crate::gains::gains;
use crate::recording::{Recorder, Recording};
use crate::settle::settle;
use crate::{FocusError, Options, Target, level};
use unripple_core::{Drive, Point, Responses, require, window_samples};

/// Decay, in nepers, after which responses are cut off: to 1/10 000. With twice this value, responses are
/// twice as long, for levels accurate to 1e-8.
const FORGOTTEN: f64 = 9.2;

/// Largest number of samples of all recordings together, half a GiB of them. Twice as many take a GiB.
const MOST_VALUES: usize = 1 << 26;

/// Largest number of points of all pulses together, whose responses make a square matrix of half a GiB. Twice as many make one four times
/// as large.
const MOST_POINTS: usize = 1 << 13;

/// A focal pulse: where, when, and with which velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Place of the pulse, in metres: a point, or a set of points that are all to have the velocity `level`.
    pub points: Vec<Point>,
    /// Focal instant, in seconds after the earliest possible one, which is one window after the drive's first sample;
    /// rounded to a sample.
    pub instant: f64,
    /// Velocity at each of the points at the focal instant, in m/s.
    pub level: f64,
}

impl Pulse {
    /// A pulse at one point (m) with a velocity of `level` (m/s), at the earliest possible instant.
    pub fn at(point: Point, level: f64) -> Self {
        Self { points: vec![point], instant: 0.0, level }
    }
}

/// Options of [`strike`]: window, regularisation and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct PulseOptions {
    /// Time from the drive's first sample to the earliest possible focal instant, in seconds.
    pub window: f64,
    /// Tikhonov regularisation of the equations for the gains, 0 to 1, as a share of the mean energy of a response. It
    /// bounds the drive where pulses lie too close in place and time for different levels.
    pub ridge: f64,
    /// Largest drive per actuator, in the drive's unit. A drive above it is scaled down as a whole.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// Truncation error allowed in modal responses, as a share of the sum of the magnitudes of their modes;
    /// see [`Options::accuracy`].
    pub accuracy: f64,
}

impl Default for PulseOptions {
    /// A window of 30 ms, a regularisation of 1e-6 and a limit of 1.
    fn default() -> Self {
        Self { window: 30e-3, ridge: 1e-6, limit: 1.0, rms_limit: None, accuracy: 1e-8 }
    }
}

/// A drive that makes prescribed focal pulses, as computed by [`strike`].
#[derive(Clone, Debug, PartialEq)]
pub struct Struck {
    /// The drive to be sent to the actuators. It ends with the last focal instant.
    pub drive: Drive,
    /// Sample of the drive at which each pulse is in focus.
    pub instants: Vec<usize>,
    /// Factor by which the limits reduced all levels; 1 where no limit was reached.
    pub scale: f64,
    /// The points of each pulse: those requested or, with sampled responses, the nearest stored ones.
    pub points: Vec<Vec<Point>>,
}

/// Computes the drive of least energy for which every point of every pulse has its prescribed velocity at
/// its prescribed instant; only the regularisation and the limits cause deviations.
///
/// The drive is a sum of reversed responses, `d_a[j] = Σ_k c_k h_ak[f_k − j]`, one k for each point of each pulse. The gains
/// c_k solve the K x K Gram system of these responses, so that the motion which a pulse causes at the instants of
/// others is accounted for. Responses reach back to the drive's first sample, or until they have decayed to 1/10 000.
///
/// # Errors
/// [`FocusError::Outside`], [`FocusError::Unknown`] and [`FocusError::Still`] for points that cannot be
/// reached, [`FocusError::Range`] for numbers out of range and for pulses too close to each other for
/// different levels, [`FocusError::Count`] for too many points or samples in all.
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
    let points: usize = pulses.iter().map(|p| p.points.len()).sum();
    if points > MOST_POINTS {
        let expected = format!("at most {MOST_POINTS}: fewer pulses or a shorter time");
        return Err(FocusError::Count { what: "points over all pulses", expected, found: points });
    }
    let of = |p: &Pulse| Target { points: p.points.clone(), gain: p.level, rate_hz: None };
    Target::check(&pulses.iter().map(of).collect::<Vec<_>>(), &responses.conditions().outline)?;
    if responses.ports().is_empty() {
        return Err(FocusError::Count { what: "actuators", expected: "at least 1".to_owned(), found: 0 });
    }
    for (index, pulse) in pulses.iter().enumerate() {
        let legal = pulse.instant.is_finite() && pulse.instant >= 0.0;
        require(format!("instant of pulse {} (s)", index + 1), legal, "0 or more", pulse.instant)?;
    }
    Ok(())
}
