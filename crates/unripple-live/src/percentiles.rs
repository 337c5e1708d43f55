//! A histogram of times with bins of equal ratio: percentiles within 1 % in constant memory.

/// Shortest time that is resolved, in s, and how much longer each bin is than the last.
const SHORTEST: f64 = 1e-7;
const STEP: f64 = 1.01;

/// Bins up to 10 s: as many steps of 1 % as lie between 100 ns and that.
const BINS: usize = 1852;

/// Histogram of durations, for percentiles within 1 % of any number of times in constant memory. Times from 100 ns to
/// 10 s are resolved.
///
/// ```
/// let mut times = unripple_live::Percentiles::default();
/// (1..=1000).for_each(|i| times.add(f64::from(i) * 1e-6));
/// let middle = times.at(0.5).unwrap();
/// assert!((500e-6..506e-6).contains(&middle));
/// assert_eq!(times.worst(), Some(1000e-6));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Percentiles {
    bins: Vec<u64>,
    count: u64,
    worst: f64,
    unknown: u64,
}

impl Default for Percentiles {
    fn default() -> Self {
        Self { bins: vec![0; BINS], count: 0, worst: 0.0, unknown: 0 }
    }
}

impl Percentiles {
    /// Adds a time, in s. NaN is only counted as [`Percentiles::unknown`]. Never allocates.
    pub fn add(&mut self, seconds: f64) {
        if seconds.is_nan() {
            self.unknown += 1;
            return;
        }
        let bin = ((seconds / SHORTEST).max(1.0).ln() / STEP.ln()).ceil() as usize;
        self.bins[bin.min(BINS - 1)] += 1;
        self.count += 1;
        self.worst = self.worst.max(seconds);
    }

    /// Number of added times that were NaN, and so are not in the histogram.
    pub fn unknown(&self) -> u64 {
        self.unknown
    }

    /// Number of times that were added.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Percentile, in s: the time that a fraction `share`, 0 to 1, of all times does not exceed, at most 1 % too
    /// large; `None` without times.
    pub fn at(&self, share: f64) -> Option<f64> {
        let rank = (share.clamp(0.0, 1.0) * self.count as f64).ceil().max(1.0) as u64;
        let mut below = 0;
        let bin = self.bins.iter().position(|count| {
            below += count;
            below >= rank
        })?;
        Some((SHORTEST * STEP.powi(bin as i32)).min(self.worst))
    }

    /// The longest time, in s; `None` without times.
    pub fn worst(&self) -> Option<f64> {
        (self.count > 0).then_some(self.worst)
    }

    /// The 50th, 99th and 99.9th percentile, and the worst, in s.
    pub fn four(&self) -> Option<[f64; 4]> {
        Some([self.at(0.5)?, self.at(0.99)?, self.at(0.999)?, self.worst()?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Random;

    #[test]
    fn percentiles_are_those_of_the_sorted_times() {
        let mut random = Random::seeded(3);
        let mut all: Vec<f64> = (0..5000).map(|_| random.decades(2e-7, 2.0)).collect();
        let mut times = Percentiles::default();
        all.iter().for_each(|t| times.add(*t));
        all.sort_by(f64::total_cmp);
        for share in [0.001, 0.5, 0.9, 0.99, 0.999, 1.0] {
            let exact = all[((share * 5000.0) as usize).max(1) - 1];
            let found = times.at(share).unwrap();
            assert!(found >= exact * (1.0 - 1e-12) && found <= exact * 1.0101, "{share}: {found} {exact}");
        }
        assert_eq!(Percentiles::default().at(0.5), None);
    }

    #[test]
    fn odd_times_are_borne() {
        let mut times = Percentiles::default();
        [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9].into_iter().for_each(|t| times.add(t));
        assert_eq!((times.count(), times.unknown(), times.worst()), (4, 1, Some(f64::INFINITY)));
        assert!(times.at(0.25).unwrap() <= SHORTEST);
    }
}
