//! Tension tracked by a Kalman filter for its ratio and rate; each observation is fitted by Newton's method.

use super::run::{Course, Instants, Motion, Sheet};
use super::warp::warped;
use super::{Drift, Tracking};
use crate::CalibrateError;
use unripple_core::{ModalResponses, Surface, require};
use unripple_linalg::{Mat, Scale, squared_norm};
use unripple_physics::{sensed, sensors};

/// Step of the tension ratio for numerical derivatives. It changes the phases of the highest modes by far less than a radian, and the
/// responses by far more than rounding errors.
const SMALL: f64 = 1e-5;

/// Largest number of Newton steps of one estimate, and (`SETTLED`) the change of the tension ratio that ends them. The error falls
/// quadratically, so that more steps change nothing; an estimate that needs more has started too far away.
const STEPS: usize = 6;
const SETTLED: f64 = 1e-7;

/// Distance between the tension ratios that are tried when the tension is searched over its whole range. With twice the distance,
/// Newton's method may start beyond the nearest maximum; half the distance takes twice as long.
const GUESS: f64 = 1e-3;

/// Tracker of a sheet's tension, from the drive that is sent and the signals of the actuators used as sensors.
///
/// Any drive, whatever its purpose, makes the sheet vibrate, and the actuators sense the vibration. The model predicts their signals for
/// a tension; the difference between signals and prediction shows the error of that tension, since the frequency of every mode depends on
/// tension by its own share (the dispersion relation). A Kalman filter with the states ratio and rate predicts the tension between
/// observations.
///
/// ```
/// use unripple_linalg::Mat;
/// use std::sync::Arc;
/// use unripple_calibrate::{Drift, Tracker, Tracking};
/// use unripple_core::{Conditions, ModalResponses, Outline, Point, Pole, Port, Shape, Shapes};
///
/// #[derive(Debug)]
/// struct Piston;
/// impl Shapes for Piston {
///     fn modes(&self) -> usize {
///         1
///     }
///     fn at(&self, _: Point, row: &mut [f64]) {
///         row.fill(1.0);
///     }
/// }
///
/// let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
/// let drum = ModalResponses {
///     ports: vec![Port { name: "a1".into(), at: Point::new(0.1, 0.05) }],
///     poles: vec![Pole::new(1000.0, 10.0)],
///     input: Mat::full(1, 1, 1.0),
///     shapes: Arc::new(Piston),
///     conditions: Conditions { rate: 8000.0, band: [0.0, 300.0], lambda_min: 0.03, outline },
///     frequency_error: 0.0,
///     mode_errors: Vec::new(),
/// };
/// let mut tracker = Tracker::new(&drum, &[0.0], &Tracking { noise: 1e-6, ..Tracking::default() })?;
/// let stiffer = Pole::new(1000.0 * 1.002f64.sqrt(), 10.0);
/// let ping = vec![vec![1.0]];
/// let heard = vec![(0..1600).map(|i| stiffer.velocity(f64::from(i) / 8000.0) / 8000.0).collect()];
/// let Drift::Followed { tension, .. } = tracker.observe(&ping, &heard)? else { panic!("it is explained") };
/// assert!((tension - 1.002).abs() < 1e-5);
/// # Ok::<(), unripple_calibrate::CalibrateError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tracker {
    reference: ModalResponses,
    sheet: Sheet,
    options: Tracking,
    motion: Motion,
    /// Ratio of the tension to the model's nominal one at the end of the last observation, and its rate
    /// (1/s).
    state: [f64; 2],
    /// Model tension ratio of the calibrated surface, which is reported as 1.
    zero: f64,
    /// Covariance of ratio and rate.
    spread: [[f64; 2]; 2],
}

/// One observation: drive and sensor signals.
struct Heard<'a> {
    drive: &'a [Vec<f64>],
    samples: usize,
    instants: &'a Instants,
    /// Instants x channels.
    signals: &'a Mat<f64>,
}

/// An estimate from one observation.
struct Estimate {
    course: Course,
    spread: [[f64; 2]; 2],
    excess: f64,
    motion: Motion,
}

impl Tracker {
    /// A tracker for a surface with these modal responses, whose sensors measure velocity at the actuators. `bending_shares` holds the
    /// share of bending in the elastic energy of each mode (0 to 1), by [`Warp::bending_share`](crate::Warp::bending_share) where nothing
    /// better is known.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] for another number of shares than poles, [`CalibrateError::Range`] for options out of range.
    pub fn new(
        responses: &ModalResponses,
        bending_shares: &[f64],
        options: &Tracking,
    ) -> Result<Self, CalibrateError> {
        let places: Vec<_> = responses.ports.iter().map(|port| port.at).collect();
        let sense = responses.shapes.at_all(&places);
        Self::with_sensors(responses, bending_shares, &sense, options)
    }

    /// A tracker for other sensors than those of [`Tracker::new`]: `sensors` holds the weights of the modes'
    /// velocities in the sensors' signals, sensors x modes, one sensor per actuator.
    ///
    /// # Errors
    /// Those of [`Tracker::new`].
    pub fn with_sensors(
        responses: &ModalResponses,
        bending_shares: &[f64],
        sensors: &Mat<f64>,
        options: &Tracking,
    ) -> Result<Self, CalibrateError> {
        let modes = responses.poles.len();
        let counts = [("bending shares", bending_shares.len()), ("modes of the sensors", sensors.ncols())];
        for (what, found) in counts {
            if found != modes {
                return Err(CalibrateError::Count { what, expected: modes.to_string(), found });
            }
        }
        if sensors.nrows() != responses.ports.len() {
            let expected = responses.ports.len().to_string();
            return Err(CalibrateError::Count { what: "sensors", expected, found: sensors.nrows() });
        }
        options.check()?;
        let sheet = Sheet {
            poles: responses.poles.clone(),
            shares: bending_shares.to_vec(),
            input: responses.input.transpose().to_owned(),
            sense: sensors.transpose().to_owned(),
            rate: responses.conditions.rate,
            stride: ((responses.conditions.rate / (2.5 * responses.conditions.band[1])) as usize).max(1),
        };
        Ok(Self {
            reference: responses.clone(),
            motion: sheet.rest(),
            sheet,
            options: options.clone(),
            state: [1.0, 0.0],
            zero: 1.0,
            spread: [[options.range.powi(2), 0.0], [0.0, options.speed.powi(2)]],
        })
    }

    /// A tracker for a surface whose actuators are its sensors, each with the signal and the unit of its
    /// [`Sensor`](unripple_physics::Sensor).
    ///
    /// # Errors
    /// Those of [`Tracker::with_sensors`]; [`CalibrateError::Unsolvable`] for coils driven by a voltage that have an inductance, whose
    /// signals are filtered by their circuits, and for exciters, whose signals are filtered by their housings;
    /// [`CalibrateError::Physics`] for actuators that are not valid.
    pub fn of_surface(
        surface: &Surface,
        responses: &ModalResponses,
        bending_shares: &[f64],
        options: &Tracking,
    ) -> Result<Self, CalibrateError> {
        let all = sensors(surface)?;
        let refused = |found: &str| CalibrateError::Unsolvable {
            what: "tension",
            expected: "sensors that follow the sheet without delay: forces, patches, coils on a current",
            found: found.into(),
        };
        let gains = all.iter().map(|sensor| match (sensor.housing, sensor.circuit) {
            (Some(_), _) => Err(refused("exciters, whose housings move")),
            (None, None) => Ok(sensor.gain),
            (None, Some(circuit)) if circuit.inductance == 0.0 => Ok(sensor.gain / circuit.resistance),
            (None, Some(_)) => Err(refused("coils on a voltage with an inductance")),
        });
        let gains = gains.collect::<Result<Vec<f64>, _>>()?;
        let felt = sensed(&all, responses);
        let sense = Mat::from_fn(felt.nrows(), felt.ncols(), |sensor, m| gains[sensor] * felt[(sensor, m)]);
        Self::with_sensors(responses, bending_shares, &sense, options)
    }

    /// This tracker without the actuators of these indices, which then neither drive nor sense: for dead actuators.
    #[must_use]
    pub fn without(mut self, actuators: &[usize]) -> Self {
        let count = self.sheet.input.ncols();
        for actuator in actuators.iter().copied().filter(|actuator| *actuator < count) {
            self.sheet.input.col_mut(actuator).fill(0.0);
            self.sheet.sense.col_mut(actuator).fill(0.0);
        }
        self
    }

    /// This tracker with another reference: from now on tension is reported relative to `ratio` times the present reference tension.
    /// `ratio` is what [`Tracker::tension`] reports for a surface that has just been calibrated.
    ///
    /// A fitted model has small errors in the frequencies of the modes that a focus excites. They look like a change of tension of about
    /// 1e-4, which is the same under any tension. A few foci observed right after calibration show how large it is.
    ///
    /// # Errors
    /// [`CalibrateError::Range`] for a ratio that is not positive.
    pub fn with_zero(mut self, ratio: f64) -> Result<Self, CalibrateError> {
        require(
            "tension of the calibrated surface",
            ratio > 0.0 && ratio.is_finite(),
            "a positive number",
            ratio,
        )?;
        self.zero *= ratio;
        self.state[0] = self.zero;
        Ok(self)
    }

    /// Ratio of the tension to that at calibration, predicted `ahead` seconds after the end of the last
    /// observation.
    pub fn tension(&self, ahead: f64) -> f64 {
        self.ratio(ahead) / self.zero
    }

    /// Tension over the model's nominal tension, predicted `ahead` seconds after the end of the last observation.
    fn ratio(&self, ahead: f64) -> f64 {
        self.state[0] + self.state[1] * ahead
    }

    /// Modal responses under the tension predicted `ahead` seconds after the end of the last observation.
    pub fn responses(&self, ahead: f64) -> ModalResponses {
        warped(&self.reference, &self.sheet.shares, self.ratio(ahead))
    }

    /// Updates the tension from the drive sent since the last observation and the sensors' signals of the same time, both
    /// `[channel][sample]`. Drives that are shorter than the signals are continued with zeros.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] for another number of channels or no samples, [`CalibrateError::Range`] for samples that are not finite.
    pub fn observe(&mut self, drive: &[Vec<f64>], heard: &[Vec<f64>]) -> Result<Drift, CalibrateError> {
        let samples = self.check(drive, heard)?;
        let time = samples as f64 / self.sheet.rate;
        let instants = self.sheet.instants(drive, samples);
        let signals = instants.look(heard);
        self.pass(0.5 * time);
        let heard = Heard { drive, samples, instants: &instants, signals: &signals };
        let mut found = self.estimate(&heard, self.state[0]);
        if found.excess > self.options.limit {
            let other = self.estimate(&heard, self.search(&heard));
            found = if other.excess < found.excess { other } else { found };
        }
        let explained = found.excess <= self.options.limit;
        if explained {
            (self.state, self.spread) = ([found.course.middle, found.course.rate], found.spread);
            self.motion = found.motion;
        } else {
            // The motion of the sheet is unknown: the next observation starts from the motion that the drive alone would have made.
            let course = Course { middle: self.state[0], rate: self.state[1] };
            self.motion = self.sheet.run(&self.motion, drive, samples, &instants, course).1;
        }
        self.pass(0.5 * time);
        let tension = self.tension(0.0);
        let [error, rate_error] = [0, 1].map(|i| self.spread[i][i].sqrt() / self.zero);
        let (rate, excess) = (self.state[1] / self.zero, found.excess);
        Ok(match explained {
            true => Drift::Followed { tension, error, rate, rate_error, excess },
            false => Drift::Unexplained { tension, excess: found.excess, limit: self.options.limit },
        })
    }

    /// Advances the tracker by `samples` samples without an observation, as while a finger touches the sheet. `drive`,
    /// `[channel][sample]`, is what was sent in that time.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] for another number of channels.
    pub fn skip(&mut self, drive: &[Vec<f64>], samples: usize) -> Result<(), CalibrateError> {
        let channels = self.sheet.input.ncols();
        if drive.len() != channels {
            let (expected, found) = (channels.to_string(), drive.len());
            return Err(CalibrateError::Count { what: "channels of the drive", expected, found });
        }
        self.pass(samples as f64 / self.sheet.rate);
        let course = Course { middle: self.state[0], rate: self.state[1] };
        self.motion = self.sheet.run(&self.motion, drive, samples, &Instants::none(), course).1;
        Ok(())
    }

    fn check(&self, drive: &[Vec<f64>], heard: &[Vec<f64>]) -> Result<usize, CalibrateError> {
        let channels = self.sheet.input.ncols();
        for (what, found) in [("channels of the drive", drive.len()), ("recorded channels", heard.len())] {
            if found != channels {
                return Err(CalibrateError::Count { what, expected: channels.to_string(), found });
            }
        }
        let samples = heard.iter().map(Vec::len).min().unwrap_or(0);
        if samples == 0 {
            return Err(CalibrateError::Count {
                what: "recorded samples",
                expected: "at least 1".into(),
                found: 0,
            });
        }
        for value in drive.iter().chain(heard).flatten() {
            require("sample of an observation", value.is_finite(), "a finite number", *value)?;
        }
        Ok(samples)
    }

    /// The course of tension that agrees best with the signals and with the prediction, by Newton's method from a guess of the ratio in
    /// the middle of the observation.
    fn estimate(&self, heard: &Heard, guess: f64) -> Estimate {
        let mut course = Course { middle: guess, rate: self.state[1] };
        let (mut model, mut motion) = self.run(heard, course);
        let noise = self.noise(heard.signals);
        let count = (heard.signals.nrows() * heard.signals.ncols()) as f64;
        let prior = inverse(self.spread);
        let time = heard.samples as f64 / self.sheet.rate;
        let small = [SMALL, SMALL / time];
        let mut last = f64::INFINITY;
        let mut spread = self.spread;
        for _ in 0..STEPS {
            let residual = heard.signals - &model;
            let excess = (squared_norm(residual.as_ref()) / count).sqrt() / noise;
            let weight = 1.0 / (noise * excess.max(1.0)).powi(2);
            let moved = [(small[0], 0.0), (0.0, small[1])]
                .map(|(m, r)| Course { middle: course.middle + m, rate: course.rate + r });
            let slopes: [Mat<f64>; 2] =
                std::array::from_fn(|i| (self.run(heard, moved[i]).0 - &model) * Scale(1.0 / small[i]));
            let offset = [course.middle - self.state[0], course.rate - self.state[1]];
            let system = std::array::from_fn(|i| {
                std::array::from_fn(|j| weight * dot(&slopes[i], &slopes[j]) + prior[i][j])
            });
            let downhill: [f64; 2] = std::array::from_fn(|i| {
                weight * dot(&slopes[i], &residual) - prior[i][0] * offset[0] - prior[i][1] * offset[1]
            });
            spread = inverse(system);
            let step = spread.map(|row| row[0] * downhill[0] + row[1] * downhill[1]);
            // With a larger step the phases of the highest modes are no longer linear in the tension.
            let share = (GUESS / step[0].abs().max(step[1].abs() * time)).min(1.0);
            let next =
                Course { middle: course.middle + share * step[0], rate: course.rate + share * step[1] };
            let (after, moved) = self.run(heard, next);
            let size = squared_norm((heard.signals - &after).as_ref());
            if size >= last || !size.is_finite() {
                break;
            }
            (course, model, motion, last) = (next, after, moved, size);
            if step[0].abs() < SETTLED {
                break;
            }
        }
        let excess = (squared_norm((heard.signals - &model).as_ref()) / count).sqrt() / noise;
        Estimate { course, spread, excess, motion }
    }

    fn run(&self, heard: &Heard, course: Course) -> (Mat<f64>, Motion) {
        self.sheet.run(&self.motion, heard.drive, heard.samples, heard.instants, course)
    }

    /// Standard deviation of the expected residual: noise, and the error of the model as a share of the signals.
    fn noise(&self, signals: &Mat<f64>) -> f64 {
        let power = squared_norm(signals.as_ref()) / (signals.nrows() * signals.ncols()).max(1) as f64;
        (self.options.noise.powi(2) + self.options.model.powi(2) * power).sqrt()
    }

    /// The tension ratio with the smallest residual among many over the whole range.
    fn search(&self, heard: &Heard) -> f64 {
        use rayon::prelude::*;
        let count = (self.options.range / GUESS).ceil() as i32;
        let miss = |n: i32| {
            let course = Course { middle: 1.0 + f64::from(n) * GUESS, rate: self.state[1] };
            let miss = heard.signals - self.run(heard, course).0;
            (squared_norm(miss.as_ref()), course.middle)
        };
        let all: Vec<(f64, f64)> = (-count..=count).into_par_iter().map(miss).collect();
        all.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(self.state[0], |best| best.1)
    }

    /// Prediction step of the Kalman filter over `time` seconds: the ratio changes at its rate, and the rate makes a random walk.
    fn pass(&mut self, time: f64) {
        let wander = self.options.wander.powi(2) * time;
        self.state[0] += self.state[1] * time;
        let [[a, b], [_, d]] = self.spread;
        let (a, b) = (
            a + 2.0 * time * b + time * time * d + wander * time * time / 3.0,
            b + time * d + 0.5 * wander * time,
        );
        self.spread = [[a, b], [b, d + wander]];
    }
}

/// Inverse of a symmetric 2 x 2 matrix.
fn inverse([[a, b], [_, d]]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let determinant = a * d - b * b;
    [[d / determinant, -b / determinant], [-b / determinant, a / determinant]]
}

fn dot(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    a.col_iter().zip(b.col_iter()).map(|(a, b)| a.iter().zip(b.iter()).map(|(a, b)| a * b).sum::<f64>()).sum()
}
