//! The weak test signal, sent between effects, from which the tension is tracked.

use crate::CalibrateError;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use unripple_core::{ModalResponses, Outline, Point, require};
use unripple_dsp::{Threshold, Weighting};
use unripple_linalg::{Mat, product};

/// Points per shortest wavelength, along each axis, at which the level is computed: half a wave apart. Twice as many
/// take four times as long and find the loudest place a little better.
const DENSE: f64 = 2.0;

/// Number of samples per period of the highest frequency at which the level is computed. A peak between two
/// samples is missed by 13 % at most, about 1 dB; twice as many take twice as long.
const FINE: f64 = 6.0;

/// Duration of the fade-in and of the fade-out, in s. A shorter one spreads the signal over frequencies that are felt; a
/// longer one leaves less of the signal at full strength.
const RAMP: f64 = 10e-3;

/// Decay, in nepers, after which the response to a ping is no longer computed: 2 % of its amplitude is left.
const OVER: f64 = 4.0;

/// Options of a ping: band, length, level.
#[derive(Clone, Debug, PartialEq)]
pub struct PingOptions {
    /// Lowest and highest frequency of the ping, as shares of the top of the responses' band. High frequencies are felt
    /// least and show a change of tension most.
    pub band: [f64; 2],
    /// Length of the ping, in s.
    pub length: f64,
    /// Level at the place where the ping is felt most, in dB above the threshold of touch.
    pub felt_db: f64,
    /// Largest drive of an actuator, in the drive's unit.
    pub limit: f64,
    /// Vibrotactile threshold against frequency.
    pub threshold: Threshold,
}

impl Default for PingOptions {
    /// 100 ms near the top of the band, 3 dB below the threshold, with a drive of at most 1.
    fn default() -> Self {
        Self {
            band: [0.88, 0.97],
            length: 100e-3,
            felt_db: -3.0,
            limit: 1.0,
            threshold: Threshold::default(),
        }
    }
}

/// A short drive below the threshold of touch, for a [`Tracker`](crate::Tracker) when nothing else is driven.
///
/// Every actuator sweeps the band, fades in and out over 10 ms, and is louder at frequencies that are felt less. Phases
/// grow with the square of the actuator's number, so that the waves focus nowhere. The level is that of the displacement
/// of the sheet without a finger, weighted by the threshold, at points half a wavelength apart. The ping may still be
/// audible.
///
/// ```
/// use unripple_calibrate::{Ping, PingOptions};
/// use unripple_core::Responses;
/// use unripple_physics::{ResponseOptions, design::papers_surface, responses};
///
/// let mut surface = papers_surface();
/// surface.emission.band[1] = 800.0;
/// let Responses::Modal(film) = responses(&surface, &ResponseOptions::default())? else { unreachable!() };
/// let ping = Ping::design(&film, &PingOptions::default())?;
/// assert_eq!(ping.drive.len(), 8);
/// assert!(ping.felt_db < -2.99 && ping.peak <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ping {
    /// The drive, one signal per actuator, in the drive's unit.
    pub drive: Vec<Vec<f64>>,
    /// Largest value of the drive, in the drive's unit.
    pub peak: f64,
    /// Level at the place where the ping is felt most, in dB above the threshold of touch.
    pub felt_db: f64,
    /// Place where the ping is felt most, in m.
    pub felt_at: Point,
}

impl Ping {
    /// Designs a ping for a surface with these responses, as strong as `felt_db` and `limit` of the options allow.
    ///
    /// # Errors
    /// [`CalibrateError::Range`] for options out of range; [`CalibrateError::Unsolvable`] if the drive moves nothing.
    pub fn design(responses: &ModalResponses, options: &PingOptions) -> Result<Self, CalibrateError> {
        let [low, high] = options.band;
        require("bottom of a ping's band", low > 0.0 && low < high, "above 0, below its top", low)?;
        require("top of a ping's band", high <= 1.0, "at most 1", high)?;
        let (rate, top) = (responses.conditions.rate, responses.conditions.band[1]);
        require(
            "length of a ping in s",
            (1e-4..=1.0).contains(&options.length),
            "0.1 ms to 1 s",
            options.length,
        )?;
        require(
            "limit of the drive",
            options.limit > 0.0 && options.limit.is_finite(),
            "a positive number",
            options.limit,
        )?;
        require("level of a ping in dB", options.felt_db.is_finite(), "a finite number", options.felt_db)?;
        let samples = (options.length * rate).ceil() as usize;
        let count = responses.ports.len();
        let ramp = |i: f64| {
            let part = (i.min(samples as f64 - i) / rate / RAMP.min(0.5 * options.length)).min(1.0);
            (0.5 * PI * part).sin().powi(4)
        };
        let loudest = options.threshold.at(top * high).max(options.threshold.at(top * low));
        let channel = |a: usize| -> Vec<f64> {
            let start = PI * (a * a) as f64 / count as f64;
            let value = |i: usize| {
                let share = (i as f64 + 0.5) / samples as f64;
                let turned = TAU * top * options.length * (low * share + 0.5 * (high - low) * share * share);
                let loud = options.threshold.at(top * (low + (high - low) * share));
                ramp(i as f64 + 0.5) * (turned + start).cos() * loud / loudest
            };
            (0..samples).map(value).collect()
        };
        let drive: Vec<Vec<f64>> = (0..count).map(channel).collect();
        let (felt, felt_at) = felt_most(responses, &drive, &options.threshold);
        if felt <= 0.0 {
            return Err(CalibrateError::Unsolvable {
                what: "level of a ping",
                expected: "a drive that moves the surface",
                found: "one that does not".into(),
            });
        }
        let largest = drive.iter().flatten().fold(0.0, |most: f64, d| most.max(d.abs()));
        let gain = (10f64.powf(options.felt_db / 20.0) / felt).min(options.limit / largest);
        let drive = drive.into_iter().map(|d| d.into_iter().map(|x| gain * x).collect()).collect();
        Ok(Self { drive, peak: gain * largest, felt_db: 20.0 * (gain * felt).log10(), felt_at })
    }
}

/// The largest threshold-weighted displacement that a drive causes, in units of the threshold, and its
/// place.
fn felt_most(responses: &ModalResponses, drive: &[Vec<f64>], threshold: &Threshold) -> (f64, Point) {
    let conditions = &responses.conditions;
    let slowest = responses.poles.iter().map(|pole| pole.sigma).fold(f64::INFINITY, f64::min).max(1.0);
    let driven = drive.iter().map(Vec::len).max().unwrap_or(0);
    let samples = driven + (OVER / slowest * conditions.rate) as usize;
    let stride = ((conditions.rate / (FINE * conditions.band[1])) as usize).max(1);
    let weighting = Weighting::padded(threshold, conditions.rate, samples, samples);
    let rows: Vec<Vec<f64>> = (0..responses.poles.len())
        .into_par_iter()
        .map(|m| {
            let moved = displacement(responses, m, drive, samples);
            weighting.weigh(&moved).into_iter().step_by(stride).collect()
        })
        .collect();
    let points = places(&conditions.outline, conditions.lambda_min / DENSE);
    let shapes = responses.shapes.at_all(&points);
    let columns = rows.first().map_or(0, Vec::len);
    let motion = Mat::from_fn(rows.len(), columns, |m, i| rows[m][i]);
    let field = product(shapes.as_ref(), motion.as_ref());
    let most = |p: usize| field.row(p).iter().fold(0.0, |most: f64, u| most.max(u.abs()));
    let all = points.iter().enumerate().map(|(p, at)| (most(p), *at));
    all.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Point::new(0.0, 0.0)))
}

/// A mode's displacement under a drive.
fn displacement(responses: &ModalResponses, mode: usize, drive: &[Vec<f64>], samples: usize) -> Vec<f64> {
    let pole = responses.poles[mode];
    let [[a, b], [c, d]] = pole.step(1.0 / responses.conditions.rate);
    let [kick_moved, kick_struck] = pole.kick();
    let (mut u, mut v) = (0.0, 0.0);
    (0..samples)
        .map(|i| {
            (u, v) = (a * u + b * v, c * u + d * v);
            let force = |(n, channel): (usize, &Vec<f64>)| {
                responses.input[(n, mode)] * channel.get(i).copied().unwrap_or(0.0)
            };
            let kick = drive.iter().enumerate().map(force).sum::<f64>() / responses.conditions.rate;
            (u, v) = (u + kick * kick_moved, v + kick * kick_struck);
            u
        })
        .collect()
}

/// Centres of square cells inside an outline.
fn places(outline: &Outline, pitch: f64) -> Vec<Point> {
    let (width, height) = outline.extent();
    let count = |side: f64| ((side / pitch).ceil() as usize).clamp(4, 200);
    let (columns, rows) = (count(width), count(height));
    (0..columns * rows)
        .map(|n| ((n % columns) as f64 + 0.5, (n / columns) as f64 + 0.5))
        .map(|(x, y)| Point::new(x * width / columns as f64, y * height / rows as f64))
        .filter(|p| outline.contains(*p))
        .collect()
}
