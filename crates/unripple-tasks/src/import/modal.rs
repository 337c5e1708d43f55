//! Impulse responses of modes that were identified elsewhere: sums of decaying oscillations between nodes.

use super::measured::Complex;
use unripple::core::Point;

/// Modes at nodes.
pub(super) struct Modes {
    /// The file, for messages.
    pub from: String,
    /// Names of the nodes.
    pub names: Vec<String>,
    /// Places of the nodes, in m.
    pub places: Vec<Point>,
    /// The modes, with a value for each node.
    pub modes: Vec<Mode>,
}

/// A mode at nodes.
#[derive(Clone, Debug)]
pub(super) struct Mode {
    /// Eigenvalue in 1/s, its imaginary part above 0.
    pub eigenvalue: Complex,
    /// The mode's deflection at each node.
    pub shape: Vec<Complex>,
    /// What the product of two deflections is divided by, in kg/s: modal A.
    pub scale: Complex,
}

impl Mode {
    /// A mode with real deflections, from its eigenvalue (1/s) and its modal mass (kg).
    pub fn real(eigenvalue: Complex, mass: f64, shape: &[f64]) -> Self {
        let shape = shape.iter().map(|value| Complex::new(*value, 0.0)).collect();
        // The residue of 1/(m (s² + 2σs + ω²)) at the eigenvalue is 1/(2i m ω_d).
        Self { eigenvalue, shape, scale: Complex::new(0.0, 2.0 * mass * eigenvalue.im) }
    }

    /// Frequency of the decaying oscillation, in Hz.
    pub fn hz(&self) -> f64 {
        self.eigenvalue.im / (2.0 * std::f64::consts::PI)
    }
}

/// The responses of points to actuators at nodes.
pub(super) struct Synthesis {
    modes: Vec<Mode>,
    /// The node of each actuator, and the factor of its responses; `None` if it was left out.
    drives: Vec<Option<(usize, f64)>>,
    /// The node of each point.
    points: Vec<usize>,
    /// Seconds between samples, and their number.
    step: f64,
    samples: usize,
}

impl Synthesis {
    /// Responses at nodes, `samples` of them at distances of `step` seconds.
    pub fn new(
        modes: Vec<Mode>,
        drives: Vec<Option<(usize, f64)>>,
        points: Vec<usize>,
        step: f64,
        samples: usize,
    ) -> Self {
        Self { modes, drives, points, step, samples }
    }

    /// The first node at which responses could be beyond single precision, and what they could reach there, in m/s per unit of drive and
    /// second.
    pub fn beyond_single(&self) -> Option<(usize, f64)> {
        for node in &self.points {
            for (driven, factor) in self.drives.iter().flatten() {
                let reached = self.modes.iter().map(|mode| {
                    // Growing modes are largest at the end.
                    let growth = (mode.eigenvalue.re * self.step * self.samples as f64).exp().max(1.0);
                    growth * Self::start(mode, *node, *driven, *factor).norm()
                });
                let most: f64 = reached.sum();
                if !(most as f32).is_finite() {
                    return Some((*node, most));
                }
            }
        }
        None
    }

    /// Velocity of a mode at time 0, with its conjugate's: its real part is the response.
    fn start(mode: &Mode, node: usize, driven: usize, factor: f64) -> Complex {
        let residue = mode.shape[node] * mode.shape[driven] / mode.scale;
        // Each mode and its conjugate, which make twice the real part.
        residue * mode.eigenvalue * (2.0 * factor)
    }

    /// Responses of a point, actuators x samples, in m/s per unit of drive and second.
    pub fn row(&self, point: usize) -> Vec<f32> {
        let node = self.points[point];
        let mut row = Vec::with_capacity(self.drives.len() * self.samples);
        for drive in &self.drives {
            match drive {
                Some((driven, factor)) => {
                    row.extend(self.response(node, *driven, *factor).into_iter().map(|v| v as f32));
                }
                None => row.resize(row.len() + self.samples, 0.0),
            }
        }
        row
    }

    fn response(&self, node: usize, driven: usize, factor: f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.samples];
        for mode in &self.modes {
            let turn = (mode.eigenvalue * self.step).exp();
            let mut velocity = Self::start(mode, node, driven, factor);
            for sample in &mut sum {
                *sample += velocity.re;
                velocity *= turn;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::core::Pole;

    #[test]
    fn a_real_mode_is_a_pole() {
        let pole = Pole::new(700.0, 20.0);
        let damped = (700.0_f64 * 700.0 - 400.0).sqrt();
        let mode = Mode::real(Complex::new(-20.0, damped), 0.5, &[0.3, -2.0]);
        let synthesis = Synthesis::new(vec![mode], vec![None, Some((0, 3.0))], vec![1], 1e-4, 500);
        let row = synthesis.row(0);
        assert!(row[..500].iter().all(|v| *v == 0.0));
        for (n, value) in (0..500).zip(&row[500..]) {
            let wanted = 3.0 * 0.3 * -2.0 / 0.5 * pole.velocity(f64::from(n) * 1e-4);
            assert!((f64::from(*value) - wanted).abs() < 1e-5, "{n}: {value} {wanted}");
        }
    }
}
