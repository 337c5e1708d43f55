//! Contrast of time reversal (velocity at the focus over the rms elsewhere) against its window in closed
//! form, from modal responses.

use super::places::{grid, targets};
use unripple_core::{ModalResponses, Onset, Point, Pole};
use unripple_linalg::{Accum, Mat, MatRef, Par, c64, multiply};

/// The terms of a surface's modal responses, arranged to compute the contrast of time reversal for many windows.
///
/// Responses h_a(x) = Σ_m b_am φ_m(x) g_m(t), recorded at A for T and played backwards, give at the focal instant the velocity
/// Σ_m φ_m(x) Σ_n (Σ_a b_am b_an) I_mn φ_n(A), with I_mn = ∫_0^T g_m g_n dt a sum of exponentials of T.
pub struct Modal {
    terms: Vec<Term>,
    /// Products of the input weights b, summed over actuators: Σ_a b_am b_an, modes x modes.
    gains: Mat<f64>,
    /// Mode shapes at the targets, modes x targets.
    targets: Mat<f64>,
    /// Mode shapes at the grid's points, points x modes.
    points: Mat<f64>,
    /// Indices of the grid points inside the focal disc of each target.
    within: Vec<Vec<usize>>,
}

/// Share of the targets whose contrast lies below the interval of contrasts that is reported, and share
/// above it. With twice this value, one target in five lies outside the interval.
const TAIL: f64 = 0.05;

/// An exponential Re a e^{st}, a part of the velocity of a mode after an impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Index of the mode.
    pub mode: usize,
    /// Complex amplitude a.
    pub amplitude: c64,
    /// Complex frequency s, in 1/s.
    pub rate: c64,
}

impl Modal {
    /// Prepares the exponentials, gains, targets and points of modal responses.
    ///
    /// # Errors
    /// In words, why no contrast can be computed from these responses.
    pub fn of(responses: &ModalResponses) -> Result<Self, &'static str> {
        let ModalResponses { ports, poles, input, shapes, conditions, .. } = responses;
        let actuators: Vec<Point> = ports.iter().map(|port| port.at).collect();
        let points = grid(&conditions.outline, conditions.lambda_min);
        let mut targets = targets(&conditions.outline, &actuators, conditions.lambda_min);
        let reach = conditions.focal_radius();
        let inside = |target: &Point| -> Vec<usize> {
            (0..points.len()).filter(|i| points[*i].distance(*target) <= reach).collect()
        };
        if ports.is_empty() || poles.is_empty() {
            return Err("there is nothing that drives it, or no mode in the band");
        }
        if targets.is_empty() {
            return Err("no place is half a wavelength away from all actuators and the rim");
        }
        targets.retain(|target| inside(target).len() < points.len());
        if targets.is_empty() {
            return Err("focal discs leave nothing of the surface outside them");
        }
        Ok(Self {
            terms: poles.iter().enumerate().flat_map(|(mode, pole)| exponentials(mode, *pole)).collect(),
            gains: product(input.transpose(), input.as_ref()),
            targets: shapes.at_all(&targets).transpose().to_owned(),
            within: targets.iter().map(inside).collect(),
            points: shapes.at_all(&points),
        })
    }

    /// The velocities of all modes as exponentials, in order of the modes.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Mean square of each mode shape, in 1/kg: first over the targets, then over the grid.
    pub fn mean_squares(&self) -> [Vec<f64>; 2] {
        let modes = 0..self.gains.nrows();
        let targets =
            modes.clone().map(|m| squares(self.targets.row(m).iter()) / self.targets.ncols() as f64);
        let points = modes.map(|m| squares(self.points.col(m).iter()) / self.points.nrows() as f64);
        [targets.collect(), points.collect()]
    }

    /// Contrast at the focal instant for a window in seconds: its mean, from the mean of 1/C² over the
    /// targets, and its 5 % and 95 % quantiles over the targets.
    pub fn contrast(&self, window: f64) -> (f64, [f64; 2]) {
        let states = product(self.left(window).as_ref(), self.targets.as_ref());
        let field = product(self.points.as_ref(), states.as_ref());
        let square = |target: usize| {
            let column = field.col(target);
            let all: f64 = column.iter().map(|v| v * v).sum();
            let disc: f64 = self.within[target].iter().map(|i| column[*i] * column[*i]).sum();
            let outside = (field.nrows() - self.within[target].len()) as f64;
            let peak: f64 =
                self.targets.col(target).iter().zip(states.col(target).iter()).map(|(a, b)| a * b).sum();
            (all - disc) / outside / (peak * peak)
        };
        let mut squares: Vec<f64> = (0..self.targets.ncols()).map(square).collect();
        let mean = (squares.iter().sum::<f64>() / squares.len() as f64).powf(-0.5);
        squares.sort_by(f64::total_cmp);
        let share = |of: f64| squares[(of * (squares.len() - 1) as f64).round() as usize].powf(-0.5);
        (mean, [share(1.0 - TAIL), share(TAIL)])
    }

    /// Amplitude of mode m at the focal instant per unit of the shape of mode n at the target, modes x
    /// modes.
    fn left(&self, window: f64) -> Mat<f64> {
        let modes = self.gains.nrows();
        let mut left = Mat::zeros(modes, modes);
        // One exponential for each term: those of pairs are products of them.
        let ends: Vec<c64> = self.terms.iter().map(|term| (term.rate * window).exp()).collect();
        for (i, a) in self.terms.iter().enumerate() {
            for (j, b) in self.terms[..=i].iter().enumerate() {
                let gathered = integral([a, b], [ends[i], ends[j]], window);
                left[(a.mode, b.mode)] += gathered;
                if a.mode == b.mode && i != j {
                    left[(a.mode, b.mode)] += gathered;
                }
            }
        }
        for m in 0..modes {
            for n in 0..=m {
                let value = left[(m, n)] * self.gains[(m, n)];
                left[(m, n)] = value;
                left[(n, m)] = value;
            }
        }
        left
    }
}

/// Sum of squares.
fn squares<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.map(|v| v * v).sum()
}

/// The integral ∫_0^T Re a e^{st} Re b e^{rt} dt of two terms, in s, for a window T in s; the caller passes
/// e^{sT} and e^{rT}.
pub fn integral([a, b]: [&Term; 2], [end, other]: [c64; 2], window: f64) -> f64 {
    let sum = a.amplitude * b.amplitude * gathered(a.rate + b.rate, end * other, window)
        + a.amplitude * b.amplitude.conj() * gathered(a.rate + b.rate.conj(), end * other.conj(), window);
    0.5 * sum.re
}

/// The integral ∫_0^T e^{st} dt; the caller passes e^{sT}.
fn gathered(rate: c64, end: c64, window: f64) -> c64 {
    let x = rate * window;
    if x.norm() < 1e-5 {
        return (x * 0.5 + 1.0) * window;
    }
    (end - 1.0) / rate
}

/// The velocity of a mode, [`Pole::velocity`], as a sum of exponentials.
fn exponentials(mode: usize, pole: Pole) -> Vec<Term> {
    let Pole { omega, sigma, onset } = pole;
    let term = |amplitude: c64, rate: c64| Term { mode, amplitude, rate };
    let square = (omega - sigma) * (omega + sigma);
    if square > 0.0 {
        let swing = square.sqrt();
        let amplitude = match onset {
            Onset::Velocity => c64::new(1.0, sigma / swing),
            Onset::Displacement => c64::new(0.0, omega / swing),
        };
        return vec![term(amplitude, c64::new(-sigma, swing))];
    }
    // Overdamped: two real exponentials. At critical damping they coincide; slightly beside it, the sum is the same to five digits.
    let split = (-square).sqrt().max(1e-5 * sigma);
    if split == 0.0 {
        return vec![term(c64::new(f64::from(u8::from(onset == Onset::Velocity)), 0.0), c64::new(0.0, 0.0))];
    }
    let [slow, fast] = match onset {
        Onset::Velocity => [0.5 - 0.5 * sigma / split, 0.5 + 0.5 * sigma / split],
        Onset::Displacement => [-0.5 * omega / split, 0.5 * omega / split],
    };
    vec![
        term(c64::new(slow, 0.0), c64::new(split - sigma, 0.0)),
        term(c64::new(fast, 0.0), c64::new(-split - sigma, 0.0)),
    ]
}

/// The matrix product on one thread, with sums in a fixed order, so that a surface always gets exactly the
/// same window.
fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut sum = Mat::zeros(a.nrows(), b.ncols());
    multiply(sum.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_add_up_to_the_velocity() {
        for (omega, sigma) in [(900.0, 30.0), (300.0, 400.0), (50.0, 50.0), (0.0, 0.0), (0.0, 20.0)] {
            for pole in [Pole::new(omega, sigma), Pole::moved(omega, sigma)] {
                for t in [0.0, 1e-3, 7e-3, 0.05] {
                    let sum: f64 =
                        exponentials(0, pole).iter().map(|x| (x.amplitude * (x.rate * t).exp()).re).sum();
                    assert!(
                        (sum - pole.velocity(t)).abs() < 1e-4,
                        "{pole:?} {t}: {sum} {}",
                        pole.velocity(t)
                    );
                }
            }
        }
    }

    #[test]
    fn integrals_are_those_of_fine_sums() {
        let (a, b) = (exponentials(0, Pole::new(900.0, 30.0)), exponentials(1, Pole::new(300.0, 400.0)));
        let (window, steps) = (0.02, 20_000);
        for (one, other) in [(&a, &a), (&a, &b), (&b, &b)] {
            let found: f64 = one
                .iter()
                .flat_map(|x| {
                    other.iter().map(move |y| {
                        let ends = [x, y].map(|term| (term.rate * window).exp());
                        integral([x, y], ends, window)
                    })
                })
                .sum();
            let value = |terms: &[Term], t: f64| {
                terms.iter().map(|x| (x.amplitude * (x.rate * t).exp()).re).sum::<f64>()
            };
            let dt = window / f64::from(steps);
            let at = |i: i32| (f64::from(i) + 0.5) * dt;
            let sum: f64 = (0..steps).map(|i| value(one, at(i)) * value(other, at(i)) * dt).sum();
            assert!((found / sum - 1.0).abs() < 1e-5, "{found} {sum}");
        }
    }
}
