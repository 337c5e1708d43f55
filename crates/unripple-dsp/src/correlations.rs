//! Sums over samples of the products of two modes' impulse responses.

use unripple_core::Pole;

/// A two by two matrix, by rows.
type Square = [[f64; 2]; 2];

/// Sums over samples of the products of any two modes' impulse responses, Σ v_i(n) v_j(n), from which time reversal over these samples is
/// computed.
///
/// With A and B the free motion of two modes over a sample and S(n) = Σ_{i<n} (A^i k)(B^i l)ᵀ after kicks k and l,
/// S(2n) = S(n) + A^n S(n) B^nᵀ and S(n+1) = k lᵀ + A S(n) Bᵀ: exact by repeated doubling for every kind of pole, in
/// as many steps as the count has binary digits.
///
/// ```
/// use unripple_core::Pole;
/// use unripple_dsp::Correlations;
///
/// let poles = [Pole::new(1000.0, 14.0), Pole::new(2300.0, 14.0)];
/// let sums = Correlations::new(&poles, 8000.0, 240);
/// let plain: f64 = (0..240).map(|n| n as f64 / 8000.0).map(|t| poles[0].velocity(t) * poles[1].velocity(t)).sum();
/// assert!((sums.of(0, 1) - plain).abs() < 1e-12 * sums.of(0, 0));
/// ```
#[derive(Clone, Debug)]
pub struct Correlations {
    /// States of all modes after a unit impulse.
    kicks: Vec<[f64; 2]>,
    /// State-transition matrices of all modes over one sample.
    once: Vec<Square>,
    /// For each binary digit of the number of samples after the first: the state-transition matrices over
    /// the samples summed so far, and whether one more sample is added after doubling.
    digits: Vec<(Vec<Square>, bool)>,
}

impl Correlations {
    /// Prepares the sums over the first `samples` samples after the impulse, at `rate` samples per second.
    pub fn new(poles: &[Pole], rate: f64, samples: usize) -> Self {
        let over = |n: usize| poles.iter().map(|pole| pole.step(n as f64 / rate)).collect::<Vec<_>>();
        let length = usize::BITS - samples.leading_zeros();
        let digits = (0..length.saturating_sub(1)).rev().map(|digit| {
            let so_far = samples >> (digit + 1);
            (over(so_far), samples >> digit & 1 == 1)
        });
        Self {
            kicks: poles.iter().map(|pole| pole.kick()).collect(),
            once: over(1),
            digits: digits.collect(),
        }
    }

    /// The sum Σ v_i(n) v_j(n) of two modes, given by the indices of their poles.
    pub fn of(&self, i: usize, j: usize) -> f64 {
        let ([a, b], [c, d]) = (self.kicks[i], self.kicks[j]);
        let first = [[a * c, a * d], [b * c, b * d]];
        let sum = self.digits.iter().fold(first, |sum, (motion, more)| {
            let doubled = add(sum, turned(motion[i], sum, motion[j]));
            if *more { add(first, turned(self.once[i], doubled, self.once[j])) } else { doubled }
        });
        sum[1][1]
    }
}

/// `A S Bᵀ`.
fn turned([[a, b], [c, d]]: Square, s: Square, [[e, f], [g, h]]: Square) -> Square {
    let [[p, q], [r, t]] = [
        [a * s[0][0] + b * s[1][0], a * s[0][1] + b * s[1][1]],
        [c * s[0][0] + d * s[1][0], c * s[0][1] + d * s[1][1]],
    ];
    [[p * e + q * f, p * g + q * h], [r * e + t * f, r * g + t * h]]
}

fn add(one: Square, other: Square) -> Square {
    let [[a, b], [c, d]] = one;
    let [[e, f], [g, h]] = other;
    [[a + e, b + f], [c + g, d + h]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_the_samples() {
        let rate = 48e3;
        let poles = [
            Pole::new(1000.0, 14.0),
            Pole::new(18_000.0, 30.0),
            Pole::moved(18_000.0, 30.0),
            Pole::new(1000.0, 1000.0),
            Pole::new(1000.0, 4000.0),
            Pole::new(0.0, 0.0),
        ];
        for samples in [1, 2, 3, 64, 1441, 2025] {
            let sums = Correlations::new(&poles, rate, samples);
            for (i, one) in poles.iter().enumerate() {
                for (j, other) in poles.iter().enumerate() {
                    let product = |n: usize| one.velocity(n as f64 / rate) * other.velocity(n as f64 / rate);
                    let plain: f64 = (0..samples).map(product).sum();
                    let size: f64 = (0..samples).map(|n| product(n).abs()).sum();
                    assert!((sums.of(i, j) - plain).abs() <= 1e-10 * size, "{samples} {i} {j}");
                }
            }
        }
    }
}
