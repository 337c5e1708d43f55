//! What modes in free vibration add to a signal, and the energy that they will add in all later time, in closed form.

use std::f64::consts::TAU;
use unripple_core::Pole;
use unripple_dsp::a_weighting;

/// A signal that is a weighted sum of displacements and velocities of modes in free vibration, and its rate of change.
#[derive(Debug)]
pub(crate) struct Ringing<'a> {
    poles: &'a [Pole],
    /// What displacement and velocity of each mode weigh in the signal.
    weights: &'a [Vec<f64>; 2],
    /// The A-weighting at the frequency of each mode.
    heard: Vec<f64>,
}

/// One mode's part in the signal.
#[derive(Clone, Copy, Debug)]
struct Part {
    pole: Pole,
    value: f64,
    change: f64,
    /// The A-weighting at its frequency.
    heard: f64,
}

impl<'a> Ringing<'a> {
    /// The signal with weights of displacement and of velocity, one of each for every pole.
    pub fn new(poles: &'a [Pole], weights: &'a [Vec<f64>; 2]) -> Self {
        Self { poles, weights, heard: poles.iter().map(|pole| a_weighting(pole.omega / TAU)).collect() }
    }

    /// The signal, in its own unit, from displacement (m·√kg) and velocity (√J) of every mode.
    pub fn value(&self, displacement: &[f64], velocity: &[f64]) -> f64 {
        let [displacements, velocities] = self.weights;
        let moved = displacement.iter().zip(displacements).map(|(u, weight)| u * weight).sum::<f64>();
        moved + velocity.iter().zip(velocities).map(|(v, weight)| v * weight).sum::<f64>()
    }

    /// The square of the signal's rate of change in the same state, as it is and A-weighted, in the signal's unit squared per s². The
    /// A-weighting is that of each mode's frequency, without the phase of a filter.
    pub fn squares(&self, displacement: &[f64], velocity: &[f64]) -> [f64; 2] {
        let parts = self.parts(displacement, velocity);
        let [plain, heard] = parts
            .fold([0.0; 2], |[plain, heard], part| [plain + part.change, heard + part.heard * part.change]);
        [plain * plain, heard * heard]
    }

    /// The integral of that square over all time after the state, in the signal's unit squared per second, as it is and A-weighted. Modes
    /// without damping, whose integral has no end, are left out.
    pub fn to_come(&self, displacement: &[f64], velocity: &[f64]) -> [f64; 2] {
        let lasting = |part: &Part| part.pole.sigma > 0.0 && (part.value != 0.0 || part.change != 0.0);
        let parts: Vec<Part> = self.parts(displacement, velocity).filter(lasting).collect();
        let mut sums = [0.0; 2];
        for (i, one) in parts.iter().enumerate() {
            for (j, other) in parts.iter().enumerate().take(i + 1) {
                let both = product(one, other) * if i == j { 1.0 } else { 2.0 };
                sums[0] += both;
                sums[1] += both * one.heard * other.heard;
            }
        }
        sums
    }

    /// The part of each mode in the signal in a state.
    fn parts(&self, displacement: &[f64], velocity: &[f64]) -> impl Iterator<Item = Part> {
        let [displacements, velocities] = self.weights;
        let modes = self.poles.iter().zip(&self.heard).zip(displacements.iter().zip(velocities));
        modes.zip(displacement.iter().zip(velocity)).map(|(((pole, heard), (a, b)), (u, v))| {
            let acceleration = -pole.omega * pole.omega * u - 2.0 * pole.sigma * v;
            Part { pole: *pole, value: a * u + b * v, change: a * v + b * acceleration, heard: *heard }
        })
    }
}

/// The integral over all later time of the product of the rates of change of two signals f and g that both decay as their poles do.
///
/// Integrals of the derivatives of f g, f' g, f g' and f' g' are known from the state, and the equations of both poles make them four
/// equations for the four products. It holds with any damping; of one signal with itself it is (f'² + ω² f²)/4σ.
fn product(one: &Part, other: &Part) -> f64 {
    let [first, second] = [one, other].map(|part| part.pole.omega * part.pole.omega);
    let sigma = one.pole.sigma + other.pole.sigma;
    let crossed = one.pole.sigma * second + other.pole.sigma * first;
    let apart = first - second;
    if crossed == 0.0 {
        // Both without stiffness: each moves as e^(-2σt).
        return one.change * other.change / (2.0 * sigma);
    }
    let alike =
        2.0 * crossed * one.change * other.change + 2.0 * sigma * first * second * one.value * other.value;
    let turned = apart * (second * one.change * other.value - first * one.value * other.change);
    (alike + turned) / (4.0 * crossed * sigma + apart * apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum over many decay times, of signals whose modes are close, far apart, strongly damped and without stiffness.
    #[test]
    fn what_is_to_come_is_a_sum_over_many_decay_times() {
        let sets = [
            vec![(900.0, 20.0)],
            vec![(900.0, 20.0), (900.0, 20.0)],
            vec![(900.0, 20.0), (915.0, 30.0), (2000.0, 25.0)],
            vec![(900.0, 20.0), (300.0, 300.0), (200.0, 450.0)],
            vec![(0.0, 40.0), (0.0, 25.0), (500.0, 30.0)],
        ];
        let dt = 2e-5;
        for set in sets {
            let poles: Vec<Pole> = set.iter().map(|(omega, sigma)| Pole::new(*omega, *sigma)).collect();
            let count = poles.len();
            let weights = [vec![3.0; count], (0..count).map(|m| 0.01 * (m as f64 - 0.5)).collect()];
            let ringing = Ringing::new(&poles, &weights);
            let mut u: Vec<f64> = (0..count).map(|m| 0.4 + 0.1 * m as f64).collect();
            let mut v: Vec<f64> = (0..count).map(|m| 200.0 - 90.0 * m as f64).collect();
            let found = ringing.to_come(&u, &v);
            let steps: Vec<_> = poles.iter().map(|pole| pole.step(dt)).collect();
            let mut sums = ringing.squares(&u, &v).map(|square| 0.5 * square * dt);
            for _ in 0..30_000 {
                for (m, [[a, b], [c, d]]) in steps.iter().enumerate() {
                    (u[m], v[m]) = (a * u[m] + b * v[m], c * u[m] + d * v[m]);
                }
                let squares = ringing.squares(&u, &v);
                sums.iter_mut().zip(squares).for_each(|(sum, square)| *sum += square * dt);
            }
            for (found, sum) in found.into_iter().zip(sums) {
                assert!((found - sum).abs() <= 1e-3 * sum, "{set:?}: {found} {sum}");
            }
        }
    }

    #[test]
    fn modes_without_damping_are_left_out() {
        let poles = [Pole::new(900.0, 0.0), Pole::new(700.0, 10.0)];
        let weights = [vec![1.0; 2], vec![0.0; 2]];
        let ringing = Ringing::new(&poles, &weights);
        let [both, _] = ringing.to_come(&[1.0, 1.0], &[0.0, 0.0]);
        assert!((both / (700.0 * 700.0 / 40.0) - 1.0).abs() < 1e-12, "{both}");
        assert_eq!(ringing.value(&[1.0, 2.0], &[5.0, 5.0]), 3.0);
    }
}
