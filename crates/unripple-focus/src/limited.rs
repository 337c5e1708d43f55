//! The strongest focus within peak and rms limits: Newton's method on the dual problem.

use crate::objective::{Levels, read};
use crate::state::State;
use crate::{FocusError, Shaping};
use unripple_linalg::{Lu, Mat, MatRef, Scale, product};

/// Largest number of steps of Newton's method. With twice this value, a problem that does not converge takes twice as long to fail.
const STEPS: usize = 80;

/// The duality gap at which Newton's method stops, as a share of the objective: a bound on how far the drive
/// is from the optimum. A smaller value costs a step or two more.
pub(crate) const GAP: f64 = 1e-6;

/// Largest number of attempts at a rise in level above that of the unlimited drive, where several targets cannot reach their levels
/// together: each is at half the rise of the one before. With twice this value, the last is at a 2048th of that rise instead of a 32nd.
const ATTEMPTS: usize = 6;

/// Largest number of halvings of a Newton step, down to a billionth of it. With twice this value, a search
/// that finds no improvement takes longer to fail.
const HALVINGS: usize = 30;

/// Bisections for the multiplier of an rms limit: to the last bits. More change nothing.
const BISECTIONS: usize = 60;

/// Limits of a drive's amplitude, and the level to be reached within these limits.
///
/// The drive that minimises `½ yᵀ(A - ε)y + ½ ε|d|²` under `|d| ≤ peak`, the rms of each channel under its limit, and levels
/// `Pᵀ y = p γ`, where `y = W d`. Its dual has one unknown per coordinate and level, its gradient is that of a sum of
/// clipped lines, and Newton's method solves it (semismooth: the clipped samples drop out of the slope).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Largest magnitude that a sample may have, in the drive's unit.
    pub peak: f64,
    /// Largest rms that a channel may have, in the drive's unit; `None` for no such limit.
    pub rms: Option<f64>,
    /// Largest rms that all channels may have together: √(Σ mean d²).
    pub total_rms: Option<f64>,
    /// The level requested, as a number from 0, the level of the unlimited drive scaled to the limits, to 1,
    /// that of the one-bit drive. If several targets cannot reach that level together, `push` is halved
    /// until they do.
    pub push: f64,
    /// Factor, dimensionless, on the level that `push` specifies.
    pub share: f64,
    /// Number of samples of each channel.
    pub samples: usize,
}

/// Unknowns of the dual problem at one iteration, and the drive that follows from them.
struct Trial {
    /// Multipliers: η of the state, ω = B η, then μ of the levels.
    dual: Vec<f64>,
    drive: Vec<f64>,
    /// Slope of each sample of the drive: 1/(ε + ν) where it is free, 0 where it is clipped.
    slopes: Vec<f64>,
    /// W d.
    state: Mat<f64>,
    /// The dual function.
    value: f64,
}

struct Program<'a> {
    map: Mat<f64>,
    /// B = A - ε.
    matrix: Mat<f64>,
    energy: f64,
    levels: &'a Levels,
    wanted: Vec<f64>,
    limits: Limits,
}

impl Limits {
    /// Computes the drive within the limits (the samples of one channel after those of another), and how the
    /// limits changed its waveforms. Up to the level that the unlimited drive reaches, it is the unlimited
    /// drive, scaled; likewise if several targets reach no higher level together. `matrix` is the lower
    /// triangle of the objective A, `energy` its term ε, `free` the optimal state without limits.
    ///
    /// # Errors
    /// [`FocusError::Gap`] if the duality gap does not close.
    pub fn drive(
        self,
        state: &State<'_>,
        matrix: Mat<f64>,
        energy: f64,
        levels: &Levels,
        free: &Mat<f64>,
    ) -> Result<(Vec<f64>, Shaping), FocusError> {
        let unlimited = state.emit(free.as_ref())?;
        let lowest = self.scale(&unlimited);
        let map = state.map()?;
        let highest = self.highest(&map, levels);
        let rank = state.rank();
        let whole = Mat::from_fn(rank, rank, |i, j| {
            let entry = if i >= j { matrix[(i, j)] } else { matrix[(j, i)] };
            entry - if i == j { energy } else { 0.0 }
        });
        let mut program = Program { map, matrix: whole, energy, levels, wanted: Vec::new(), limits: self };
        let asked = self.push * (highest - lowest);
        let (mut rise, mut attempts) = (asked, 0);
        while attempts < ATTEMPTS {
            let level = self.share * (lowest + rise);
            if rise.is_nan() || rise <= 0.0 || level <= lowest {
                break;
            }
            attempts += 1;
            program.wanted = levels.wanted.iter().map(|wanted| wanted * level).collect();
            match program.solve(free * Scale(level)) {
                Err(FocusError::Gap { .. }) if levels.wanted.len() > 1 => rise *= 0.5,
                found => return Ok((found?, Shaping::Shaped)),
            }
        }
        let level = (self.share * (lowest + asked.max(0.0))).min(lowest);
        let shaping = if attempts > 0 { Shaping::GaveUp { attempts } } else { Shaping::Unshaped };
        Ok((unlimited.iter().map(|d| d * level).collect(), shaping))
    }

    /// The largest factor by which a drive may be multiplied within the limits.
    fn scale(&self, drive: &[f64]) -> f64 {
        let mut most = drive.iter().fold(0.0_f64, |m, d| m.max(d.abs())) / self.peak;
        let rms = |c: &[f64]| (c.iter().map(|d| d * d).sum::<f64>() / self.samples as f64).sqrt();
        if let Some(limit) = self.rms {
            most = drive.chunks_exact(self.samples).fold(most, |m, c| m.max(rms(c) / limit));
        }
        if let Some(limit) = self.total_rms {
            most = most.max(rms(drive) / limit);
        }
        1.0 / most
    }

    /// The level that a one-bit drive reaches at all targets together: the smallest ratio of a level reached
    /// to the level wanted.
    fn highest(&self, map: &Mat<f64>, levels: &Levels) -> f64 {
        let wanted = Mat::from_fn(levels.wanted.len(), 1, |k, _| levels.wanted[k]);
        let together = product(map.transpose(), product(levels.readout.as_ref(), wanted.as_ref()).as_ref());
        let hard: Vec<f64> = together.col_as_slice(0).iter().map(|d| self.peak * d.signum()).collect();
        let fit = self.scale(&hard).min(1.0);
        let reached = read(
            levels.readout.as_ref(),
            product(map.as_ref(), MatRef::from_column_major_slice(&hard, hard.len(), 1)).as_ref(),
        );
        let ratios = reached.iter().zip(&levels.wanted).filter(|(_, wanted)| **wanted != 0.0);
        fit * ratios.map(|(reached, wanted)| reached / wanted).fold(f64::INFINITY, f64::min)
    }

    /// For each channel 1/(ε + ν), with ν the multipliers of its rms limit and of the total rms limit;
    /// `forced` is `Wᵀ(P μ - B η)`.
    fn slopes(&self, forced: &[f64], energy: f64) -> Vec<f64> {
        let each = |start: f64| -> Vec<f64> {
            let channels = forced.chunks_exact(self.samples);
            channels
                .map(|channel| self.within(start, self.rms, |slope| self.square(channel, slope)))
                .collect()
        };
        let all = |start: f64| -> f64 {
            let channels = forced.chunks_exact(self.samples);
            channels.zip(each(start)).map(|(channel, slope)| self.square(channel, slope)).sum()
        };
        each(self.within(1.0 / energy, self.total_rms, all))
    }

    /// The largest slope, up to `start`, at which the drive's sum of squares stays within an rms limit.
    fn within(&self, start: f64, limit: Option<f64>, square: impl Fn(f64) -> f64) -> f64 {
        let Some(most) = limit.map(|limit| limit * limit * self.samples as f64) else { return start };
        if square(start) <= most {
            return start;
        }
        let (mut low, mut high) = (0.0, start);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if square(middle) > most { high = middle } else { low = middle }
        }
        low
    }

    /// Σd² of a channel with samples clipped at the peak limit.
    fn square(&self, channel: &[f64], slope: f64) -> f64 {
        channel.iter().map(|q| (q * slope).clamp(-self.peak, self.peak).powi(2)).sum()
    }
}

impl Program<'_> {
    /// The optimal drive, by damped Newton steps that start from the optimal state without limits.
    fn solve(&self, free: Mat<f64>) -> Result<Vec<f64>, FocusError> {
        // Without limits `ε d = Wᵀ(P μ - B η)` at η = W d.
        let force = &free * Scale(self.energy) + product(self.matrix.as_ref(), free.as_ref());
        let gram = product(self.levels.readout.transpose(), self.levels.readout.as_ref());
        let mut mu = product(self.levels.readout.transpose(), force.as_ref());
        Lu::new(gram.as_ref()).solve(mu.as_mut());
        let mut dual = free.col_as_slice(0).to_vec();
        dual.extend_from_slice(mu.col_as_slice(0));
        let mut trial = self.at(dual);
        for _ in 0..STEPS {
            if self.gap(&trial) < GAP {
                return Ok(trial.drive);
            }
            let step = self.newton(&trial);
            let mut share = 1.0;
            let mut next = None;
            for _ in 0..HALVINGS {
                let moved = trial.dual.iter().zip(&step).map(|(x, s)| x + share * s).collect();
                let candidate = self.at(moved);
                // A value that is lower by rounding alone still counts as no worse.
                if candidate.value >= trial.value - 1e-13 * trial.value.abs() {
                    next = Some(candidate);
                    break;
                }
                share *= 0.5;
            }
            let Some(next) = next else { break };
            trial = next;
        }
        let found = self.gap(&trial);
        if found < GAP { Ok(trial.drive) } else { Err(FocusError::Gap { expected: GAP, found }) }
    }

    /// The optimal drive for given multipliers, and the value of the dual function.
    fn at(&self, dual: Vec<f64>) -> Trial {
        let rank = self.matrix.nrows();
        let (eta, mu) = dual.split_at(rank);
        let mu = MatRef::from_column_major_slice(mu, mu.len(), 1);
        let eta = MatRef::from_column_major_slice(eta, rank, 1);
        let omega = product(self.matrix.as_ref(), eta);
        let push = product(self.levels.readout.as_ref(), mu) - &omega;
        let forced = product(self.map.transpose(), push.as_ref());
        let mut drive = forced.col_as_slice(0).to_vec();
        let mut slopes = vec![0.0; drive.len()];
        let (samples, peak) = (self.limits.samples, self.limits.peak);
        let channels = drive.chunks_exact_mut(samples).zip(slopes.chunks_exact_mut(samples));
        for ((channel, to), slope) in channels.zip(self.limits.slopes(forced.col_as_slice(0), self.energy)) {
            for (d, to) in channel.iter_mut().zip(to) {
                *d = (*d * slope).clamp(-peak, peak);
                *to = if d.abs() < peak { slope } else { 0.0 };
            }
        }
        let state = product(self.map.as_ref(), MatRef::from_column_major_slice(&drive, drive.len(), 1));
        let cost = -0.5 * product(eta.transpose(), omega.as_ref())[(0, 0)];
        let energy: f64 = 0.5 * self.energy * drive.iter().map(|d| d * d).sum::<f64>();
        let work: f64 = product(push.transpose(), state.as_ref())[(0, 0)];
        let levels: f64 = mu.col(0).iter().zip(&self.wanted).map(|(mu, wanted)| mu * wanted).sum();
        let value = cost + energy - work + levels;
        Trial { dual, drive, slopes, state, value }
    }

    /// The duality gap: cost of the drive minus the dual's value, plus the multipliers times the levels
    /// missed, as a share of the cost.
    fn gap(&self, trial: &Trial) -> f64 {
        let mu = &trial.dual[self.matrix.nrows()..];
        let missed = read(self.levels.readout.as_ref(), trial.state.as_ref());
        let missed =
            missed.iter().zip(&self.wanted).zip(mu).map(|((got, wanted), mu)| (mu * (got - wanted)).abs());
        let forces = product(self.matrix.as_ref(), trial.state.as_ref());
        let cost = 0.5 * product(trial.state.transpose(), forces.as_ref())[(0, 0)]
            + 0.5 * self.energy * trial.drive.iter().map(|d| d * d).sum::<f64>();
        ((cost - trial.value).abs() + missed.sum::<f64>()) / cost
    }

    /// Newton's step for `y(d) = η` and `Pᵀ y(d) = p γ`, with `dy = W D Wᵀ (P dμ - B dη)`.
    fn newton(&self, trial: &Trial) -> Vec<f64> {
        let (rank, count) = (self.matrix.nrows(), self.wanted.len());
        let slope = self.slope(trial);
        let readout = &self.levels.readout;
        let costs = product(slope.as_ref(), self.matrix.as_ref());
        let levels = product(slope.as_ref(), readout.as_ref());
        let read_costs = product(readout.transpose(), costs.as_ref());
        let read_levels = product(readout.transpose(), levels.as_ref());
        let system = Mat::from_fn(rank + count, rank + count, |i, j| match (i < rank, j < rank) {
            (true, true) => f64::from(i == j) + costs[(i, j)],
            (true, false) => -levels[(i, j - rank)],
            (false, true) => -read_costs[(i - rank, j)],
            (false, false) => read_levels[(i - rank, j - rank)],
        });
        let got = read(readout.as_ref(), trial.state.as_ref());
        let mut step = Mat::from_fn(rank + count, 1, |i, _| match i < rank {
            true => trial.state[(i, 0)] - trial.dual[i],
            false => self.wanted[i - rank] - got[i - rank],
        });
        Lu::new(system.as_ref()).solve(step.as_mut());
        step.col_as_slice(0).to_vec()
    }

    /// `W D Wᵀ`, D the slopes of the samples.
    fn slope(&self, trial: &Trial) -> Mat<f64> {
        let kept: Vec<usize> = (0..trial.slopes.len()).filter(|i| trial.slopes[*i] > 0.0).collect();
        let mut weighed = Mat::<f64>::zeros(self.map.nrows(), kept.len());
        for (to, from) in kept.iter().enumerate() {
            let root = trial.slopes[*from].sqrt();
            let column = weighed.col_as_slice_mut(to);
            column.iter_mut().zip(self.map.col_as_slice(*from)).for_each(|(to, w)| *to = root * w);
        }
        product(weighed.as_ref(), weighed.transpose())
    }
}
