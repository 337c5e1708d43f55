//! A reduced model of a surface: low modes individually, high modes as static flexibility.

use super::lines::Lines;
use unripple_core::{ModalResponses, Onset, Point, Pole, Port};
use unripple_dsp::Complex;
use unripple_linalg::{Accum, Mat, Par, multiply};

/// Reduced model of a surface: the first modes individually, and all others as springs, that is, as static
/// flexibility.
///
/// Far below their natural frequencies the other modes follow the drive without delay: u = Σ_a spring_a(x) ·
/// d_a with spring_a(x) = Σ_m input[a, m] shape_m(x) / ω_m² (residual flexibility). This is little, except
/// close to an actuator. There is one spring per actuator; springs come after the modes, as additional
/// columns.
#[derive(Clone, Debug)]
pub(crate) struct Reduced<'r> {
    responses: &'r ModalResponses,
    /// Number of modes that are represented individually.
    pub kept: usize,
    /// Static displacement per drive of each mode that is not represented individually, modes x actuators.
    yields: Mat<f64>,
}

impl<'r> Reduced<'r> {
    /// Keeps the first `kept` modes (a number) individually, and replaces the others by their static
    /// (residual) flexibility.
    pub fn new(responses: &'r ModalResponses, kept: usize) -> Self {
        let others = &responses.poles[kept..];
        let yields = Mat::from_fn(others.len(), responses.ports.len(), |m, a| {
            responses.input[(a, kept + m)] * compliance(others[m])
        });
        Self { responses, kept, yields }
    }

    /// The actuators, in channel order.
    pub fn ports(&self) -> &[Port] {
        &self.responses.ports
    }

    /// Number of individual modes plus number of springs (one per actuator).
    pub fn count(&self) -> usize {
        self.kept + self.yields.ncols()
    }

    /// Mode shapes, then static deflections of the springs, at points: points x (modes and springs).
    pub fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let all = self.responses.shapes.at_all(points);
        let mut shapes = Mat::zeros(points.len(), self.count());
        shapes.as_mut().subcols_mut(0, self.kept).copy_from(all.subcols(0, self.kept));
        let springs = shapes.as_mut().subcols_mut(self.kept, self.yields.ncols());
        let others = all.subcols(self.kept, self.yields.nrows());
        multiply(springs, Accum::Replace, others, self.yields.as_ref(), 1.0, Par::Seq);
        shapes
    }

    /// Input weights of the actuators, actuators x (modes and springs).
    pub fn input(&self) -> Mat<f64> {
        Mat::from_fn(self.yields.ncols(), self.count(), |a, m| match m {
            m if m < self.kept => self.responses.input[(a, m)],
            m if m - self.kept == a => 1.0,
            _ => 0.0,
        })
    }

    /// Displacement per drive of each mode and spring at the frequency lines: (modes and springs) x lines.
    pub fn lines(&self, lines: &Lines) -> Vec<Vec<Complex<f64>>> {
        let modes = self.responses.poles[..self.kept].iter().map(|pole| lines.of_pole(*pole));
        let springs = (0..self.yields.ncols()).map(|_| vec![Complex::new(1.0, 0.0); lines.count()]);
        modes.chain(springs).collect()
    }
}

/// Displacement of a mode under a constant unit drive: the integral of its impulse response.
fn compliance(pole: Pole) -> f64 {
    let yields = match pole.onset {
        Onset::Velocity => pole.omega.powi(-2),
        Onset::Displacement => 2.0 * pole.sigma * pole.omega.powi(-3),
    };
    if yields.is_finite() { yields } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compliance_is_the_integral_of_the_response() {
        for pole in [Pole::new(900.0, 60.0), Pole::moved(900.0, 60.0), Pole::new(300.0, 500.0)] {
            let step = 1e-6;
            let sum: f64 = (0..400_000).map(|i| pole.displacement((f64::from(i) + 0.5) * step) * step).sum();
            assert!((sum / compliance(pole) - 1.0).abs() < 1e-6, "{pole:?}: {sum}");
        }
    }
}
