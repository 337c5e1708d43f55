//! Separation of a residual into noise and a share of the measured signal.

/// Number of steps of the iteration, which converges in a few.
const STEPS: usize = 30;

/// Factor by which noise or share is reduced in a step whose least-squares estimate of it is negative.
const LESS: f64 = 0.1;

/// The two parts of a residual: noise, and a share of the measured signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Following {
    /// Mean square of the noise on a spectral line.
    pub noise: f64,
    /// Share of the measured signal that is in the residual, as amplitude.
    pub share: f64,
}

impl Following {
    /// Estimates both parts from the squared magnitudes |r|² of the residual and |y|² of the measurement at each spectral line,
    /// `[line][2]`.
    ///
    /// Noise does not depend on the signal, whereas the error of a model grows with it. So |r|² = n² + c² |y|² is fitted by least
    /// squares, each line weighted by the inverse of its expected variance.
    pub fn of(lines: &[[f64; 2]]) -> Self {
        let count = lines.len() as f64;
        let mean = |k: usize| lines.iter().map(|l| l[k]).sum::<f64>() / count.max(1.0);
        let (left, power) = (mean(0), mean(1));
        if !(left > 0.0 && power > 0.0) {
            return Self { noise: left.max(0.0), share: 0.0 };
        }
        let (mut noise, mut share) = (0.5 * left, 0.5 * left / power);
        for _ in 0..STEPS {
            let mut sums = [0.0; 5];
            for [r, y] in lines {
                let weight = (noise + share * y).max(1e-12 * left).powi(-2);
                let terms = [1.0, *y, y * y, *r, r * y];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += weight * term);
            }
            let [one, y, yy, r, ry] = sums;
            let det = one * yy - y * y;
            let (a, b) = ((r * yy - ry * y) / det, (one * ry - y * r) / det);
            (noise, share) = match (a > 0.0, b > 0.0) {
                _ if det.is_nan() || det <= 0.0 => (0.0, left / power),
                (true, true) => (a, b),
                // Not set to 0 at once: without one of the two parts, single strong lines get so much weight that it never recovers.
                (false, _) => (LESS * noise, ry / yy),
                (_, false) => (r / one, LESS * share),
            };
        }
        Self { noise, share: share.max(0.0).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Random;

    #[test]
    fn noise_and_what_a_model_gets_wrong_are_told_apart() {
        let mut random = Random::seeded(3);
        for (noise, share) in [(0.1_f64, 0.2_f64), (0.5, 0.0), (0.0, 0.3), (0.02, 0.02)] {
            let mut line = || {
                // A signal whose lines differ widely, as between resonances and on them.
                let y = [random.normal(), random.normal()].map(|x| x * (1.5 * random.normal()).exp());
                let r: f64 = y
                    .iter()
                    .map(|y| noise * random.normal() + share * y.abs() * random.normal())
                    .map(|x| x * x)
                    .sum();
                [r, y[0] * y[0] + y[1] * y[1]]
            };
            let lines: Vec<[f64; 2]> = (0..6000).map(|_| line()).collect();
            let found = Following::of(&lines);
            println!("{noise} {share}: {found:?}");
            assert!((found.noise.sqrt() - noise * 2f64.sqrt()).abs() < 0.1 * noise + 0.01);
            assert!((found.share - share).abs() < 0.1 * share + 0.02);
        }
    }
}
