//! Simulation in time of modal responses under a drifting tension.

use super::warp::tuned;
use unripple_core::Pole;
use unripple_linalg::Mat;

/// Duration, in s, over which the simulation takes the tension as constant: short against the time in which tension drifts.
const EVEN: f64 = 5e-3;

/// Modal model of a surface, for simulation under a changing tension.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// Decay rate and angular frequency of each mode at nominal tension.
    pub poles: Vec<Pole>,
    /// Share of bending in each mode's elastic energy, 0 to 1.
    pub shares: Vec<f64>,
    /// Input weights, modes x channels.
    pub input: Mat<f64>,
    /// Weights of the sensors, modes x channels.
    pub sense: Mat<f64>,
    /// Samples per second.
    pub rate: f64,
    /// Distance, in samples, between the instants at which signals are compared after the drive has ended.
    pub stride: usize,
}

/// Instants at which sensor signals are compared: every sample while a drive lasts; then one of every few samples, each a mean
/// over the samples around it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Instants {
    /// Indices of the samples at which sensor signals are compared, ascending.
    pub at: Vec<usize>,
    /// Number of instants at the start of `at` that are single samples, not means.
    pub single: usize,
    /// Number of samples before and after each later instant that its mean includes.
    pub reach: usize,
}

impl Instants {
    /// An empty list of instants, if no signals are compared.
    pub fn none() -> Self {
        Self { at: Vec::new(), single: 0, reach: 0 }
    }

    /// Number of samples in a mean.
    fn count(&self) -> f64 {
        (2 * self.reach + 1) as f64
    }

    /// Values of `signals`, `[channel][sample]`, at the instants, as instants x channels: at the first instants single
    /// samples, at later ones means over neighbouring samples. A mean is multiplied by the square root of its number of
    /// samples, so that white noise keeps its standard deviation.
    pub fn look(&self, signals: &[Vec<f64>]) -> Mat<f64> {
        Mat::from_fn(self.at.len(), signals.len(), |n, c| match n < self.single {
            true => signals[c][self.at[n]],
            false => {
                let around = &signals[c][self.at[n] - self.reach..=self.at[n] + self.reach];
                around.iter().sum::<f64>() / self.count().sqrt()
            }
        })
    }
}

/// Modal coordinates: displacement and velocity of every mode.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Motion {
    /// Displacement of each mode, in its modal unit.
    pub moved: Vec<f64>,
    /// Velocity of each mode, in its modal unit per second.
    pub velocity: Vec<f64>,
}

/// Tension during an observation: its ratio to nominal at the middle of that time, and the ratio's rate of
/// change (1/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    /// Ratio of the tension to nominal at the middle of the observation.
    pub middle: f64,
    /// Rate of change of the tension's ratio, in 1/s.
    pub rate: f64,
}

impl Sheet {
    /// The instants, among `samples` samples, at which signals are compared: every sample while `drive`,
    /// `[channel][sample]`, lasts, then one of every `stride`.
    pub fn instants(&self, drive: &[Vec<f64>], samples: usize) -> Instants {
        let driven =
            drive.iter().filter_map(|d| d.iter().rposition(|x| *x != 0.0)).max().map_or(0, |n| n + 1);
        let (single, reach) = (driven.min(samples), (self.stride - 1) / 2);
        let rest = (driven + reach..samples.saturating_sub(reach)).step_by(self.stride);
        Instants { at: (0..single).chain(rest).collect(), single, reach }
    }

    /// Weights of displacement and of velocity (each modes x channels) in the means of the sensors' signals at `instants`, for
    /// an undriven sheet whose tension is `ratio` times nominal. The mean over samples is that of the free, damped oscillation
    /// of each mode, computed from the instant at its middle.
    fn meant(&self, instants: &Instants, ratio: f64) -> [Mat<f64>; 2] {
        let reach = instants.reach as isize;
        let mean = |(pole, share): (&Pole, &f64)| {
            let pole = tuned(pole, *share, ratio);
            let steps = (-reach..=reach).map(|k| pole.step(k as f64 / self.rate)[1]);
            let sum = steps.fold([0.0; 2], |[u, v], [c, d]| [u + c, v + d]);
            sum.map(|x| x / instants.count().sqrt())
        };
        let means: Vec<[f64; 2]> = self.poles.iter().zip(&self.shares).map(mean).collect();
        [0, 1].map(|part| {
            Mat::from_fn(self.sense.nrows(), self.sense.ncols(), |m, c| means[m][part] * self.sense[(m, c)])
        })
    }

    /// Simulates `samples` samples from the motion `start`: returns the sensors' signals at `instants` as [`Instants::look`]
    /// forms them, instants x channels, in the sensors' unit, and the motion at the end. `drive` is `[channel][sample]`.
    pub fn run(
        &self,
        start: &Motion,
        drive: &[Vec<f64>],
        samples: usize,
        instants: &Instants,
        course: Course,
    ) -> (Mat<f64>, Motion) {
        let channels = self.input.ncols();
        let mut motion = start.clone();
        let mut heard = Mat::zeros(instants.at.len(), channels);
        let [moved, struck] = self.meant(instants, course.middle);
        let mut steps = (usize::MAX, usize::MAX, Vec::new());
        let even = ((EVEN * self.rate) as usize).max(1);
        let mut now = 0;
        for n in 0..=instants.at.len() {
            let next = instants.at.get(n).copied().unwrap_or(samples);
            if next > now {
                if (steps.0, steps.1) != (next - now, now / even) {
                    let time = ((now / even) as f64 + 0.5) * even as f64 - 0.5 * samples as f64;
                    let ratio = course.middle + course.rate * time / self.rate;
                    steps = (next - now, now / even, self.steps(ratio, next - now));
                }
                advance(&mut motion, &steps.2);
                now = next;
            }
            if n == instants.at.len() {
                break;
            }
            for (c, channel) in drive.iter().enumerate() {
                let kick = channel.get(now).copied().unwrap_or(0.0) / self.rate;
                if kick != 0.0 {
                    for (m, (weight, pole)) in self.input.col(c).iter().zip(&self.poles).enumerate() {
                        let [moved, struck] = pole.kick();
                        motion.moved[m] += kick * weight * moved;
                        motion.velocity[m] += kick * weight * struck;
                    }
                }
            }
            let read = |weights: &Mat<f64>, c: usize, state: &[f64]| -> f64 {
                weights.col(c).iter().zip(state).map(|(w, x)| w * x).sum()
            };
            for c in 0..channels {
                heard[(n, c)] = match n < instants.single {
                    true => read(&self.sense, c, &motion.velocity),
                    false => read(&moved, c, &motion.moved) + read(&struck, c, &motion.velocity),
                };
            }
        }
        (heard, motion)
    }

    fn steps(&self, ratio: f64, samples: usize) -> Vec<[[f64; 2]; 2]> {
        let time = samples as f64 / self.rate;
        self.poles
            .iter()
            .zip(&self.shares)
            .map(|(pole, share)| tuned(pole, *share, ratio).step(time))
            .collect()
    }

    /// The modal motion of a sheet at rest: zeros.
    pub fn rest(&self) -> Motion {
        Motion { moved: vec![0.0; self.poles.len()], velocity: vec![0.0; self.poles.len()] }
    }
}

fn advance(motion: &mut Motion, steps: &[[[f64; 2]; 2]]) {
    for ((u, v), [[a, b], [c, d]]) in motion.moved.iter_mut().zip(&mut motion.velocity).zip(steps) {
        (*u, *v) = (a * *u + b * *v, c * *u + d * *v);
    }
}
