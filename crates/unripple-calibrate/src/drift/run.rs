use super::warp::tuned;
use faer::Mat;
use unripple_core::Pole;

/// Seconds over which the tension counts as even while a stretch of time is run.
const EVEN: f64 = 5e-3;

/// The modes of a surface running under a tension that changes.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub poles: Vec<Pole>,
    pub shares: Vec<f64>,
    /// Input weights, modes x channels.
    pub input: Mat<f64>,
    /// Weights of the sensors, modes x channels.
    pub sense: Mat<f64>,
    pub rate: f64,
    /// Samples between two that are looked at, while nothing drives.
    pub stride: usize,
}

/// Displacement and velocity of every mode.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Motion {
    pub moved: Vec<f64>,
    pub velocity: Vec<f64>,
}

/// Tension over a stretch of time: the ratio at its middle and its rate of change (1/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    pub middle: f64,
    pub rate: f64,
}

impl Sheet {
    /// The samples that are looked at: all while something drives, then every `stride`-th.
    pub fn instants(&self, drive: &[Vec<f64>], samples: usize) -> Vec<usize> {
        let driven =
            drive.iter().filter_map(|d| d.iter().rposition(|x| *x != 0.0)).max().map_or(0, |n| n + 1);
        (0..samples).filter(|n| *n < driven || (n - driven) % self.stride == 0).collect()
    }

    /// What the sensors hear at those instants, instants x channels, and the motion at the end.
    pub fn run(
        &self,
        start: &Motion,
        drive: &[Vec<f64>],
        samples: usize,
        instants: &[usize],
        course: Course,
    ) -> (Mat<f64>, Motion) {
        let channels = self.input.ncols();
        let mut motion = start.clone();
        let mut heard = Mat::zeros(instants.len(), channels);
        let mut steps = (usize::MAX, usize::MAX, Vec::new());
        let even = ((EVEN * self.rate) as usize).max(1);
        let mut now = 0;
        for n in 0..=instants.len() {
            let next = instants.get(n).copied().unwrap_or(samples);
            if next > now {
                if (steps.0, steps.1) != (next - now, now / even) {
                    let time = ((now / even) as f64 + 0.5) * even as f64 - 0.5 * samples as f64;
                    let ratio = course.middle + course.rate * time / self.rate;
                    steps = (next - now, now / even, self.steps(ratio, next - now));
                }
                advance(&mut motion, &steps.2);
                now = next;
            }
            if n == instants.len() {
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
            for c in 0..channels {
                heard[(n, c)] = self.sense.col(c).iter().zip(&motion.velocity).map(|(w, v)| w * v).sum();
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

    /// The motion of a sheet at rest.
    pub fn rest(&self) -> Motion {
        Motion { moved: vec![0.0; self.poles.len()], velocity: vec![0.0; self.poles.len()] }
    }
}

fn advance(motion: &mut Motion, steps: &[[[f64; 2]; 2]]) {
    for ((u, v), [[a, b], [c, d]]) in motion.moved.iter_mut().zip(&mut motion.velocity).zip(steps) {
        (*u, *v) = (a * *u + b * *v, c * *u + d * *v);
    }
}
