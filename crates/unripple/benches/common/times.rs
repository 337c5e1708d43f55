//! Wall-clock times of repeated work.

use std::time::Instant;

/// Times in seconds, ascending.
pub struct Times(Vec<f64>);

impl Times {
    /// Runs `work` once without timing and `repeats` times timed; `work` is given the index of the run.
    pub fn of(repeats: usize, mut work: impl FnMut(usize)) -> Self {
        work(repeats);
        let time = |run| {
            let start = Instant::now();
            work(run);
            start.elapsed().as_secs_f64()
        };
        Self::from((0..repeats).map(time).collect::<Vec<f64>>())
    }

    /// Number of runs that were timed.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The shortest time, in seconds.
    pub fn best(&self) -> f64 {
        self.quantile(0.0)
    }

    /// The median time, in seconds.
    pub fn median(&self) -> f64 {
        let [low, high] = [self.0.len().saturating_sub(1) / 2, self.0.len() / 2];
        let at = |i: usize| self.0.get(i).copied().unwrap_or(f64::NAN);
        (at(low) + at(high)) / 2.0
    }

    /// The longest time, in seconds.
    pub fn worst(&self) -> f64 {
        self.quantile(1.0)
    }

    /// The quantile of a share (0 to 1) of the times, in seconds; NaN without times.
    pub fn quantile(&self, share: f64) -> f64 {
        let index = (share * self.0.len().saturating_sub(1) as f64).round() as usize;
        self.0.get(index).copied().unwrap_or(f64::NAN)
    }
}

impl From<Vec<f64>> for Times {
    fn from(mut seconds: Vec<f64>) -> Self {
        seconds.sort_by(f64::total_cmp);
        Self(seconds)
    }
}
