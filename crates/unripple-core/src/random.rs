//! Repeatable random numbers (SplitMix64).

use std::f64::consts::TAU;

/// A pseudorandom number generator with repeatable sequences: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
///
/// ```
/// use unripple_core::Random;
///
/// let (mut a, mut b) = (Random::seeded(7), Random::seeded(7));
/// assert_eq!(a.between(2.0, 3.0), b.between(2.0, 3.0));
/// ```
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// A generator started from a seed, any integer. The same seed gives the same sequence on every machine.
    pub fn seeded(seed: u64) -> Self {
        Self { state: seed }
    }

    /// A uniformly distributed number from 0 (included) to 1 (excluded).
    pub fn uniform(&mut self) -> f64 {
        // The upper 53 bits fill a double's mantissa.
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A uniformly distributed number from `low` to `high`, in the unit of these bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// A number from `low` to `high`, both positive and in the same unit, whose logarithm is uniformly
    /// distributed.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// A normally distributed number of zero mean and unit variance, dimensionless, by the Box-Muller
    /// transform.
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_splitmix64() {
        // First outputs for seed 1234567, as listed with other implementations of the generator.
        let mut random = Random::seeded(1_234_567);
        assert_eq!(random.next(), 6_457_827_717_110_365_317);
        assert_eq!(random.next(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn has_the_moments_it_claims() {
        let mut random = Random::seeded(1);
        let draws: Vec<f64> = (0..100_000).map(|_| random.normal()).collect();
        let moment = |p: i32| draws.iter().map(|x| x.powi(p)).sum::<f64>() / draws.len() as f64;
        assert!(moment(1).abs() < 0.015 && (moment(2) - 1.0).abs() < 0.02 && (moment(4) - 3.0).abs() < 0.15);
    }
}
