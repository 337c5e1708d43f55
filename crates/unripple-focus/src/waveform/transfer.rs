//! Transfer functions from all actuators to all points, over the lines of the band.

use super::Quantity;
use super::plan::Plan;
use crate::FocusError;
use crate::modal::{REST, largest, usual};
use crate::recording::locate;
use std::f64::consts::TAU;
use unripple_core::{ModalResponses, Point, Pole, Responses, SampledResponses};
use unripple_dsp::{Complex, integral};
use unripple_linalg::{Mat, product};

/// Number of modes times number of frequency lines in a block that is summed at once, 16 MiB. With twice
/// this value, twice the memory; sums differ by rounding.
const AT_ONCE: usize = 1 << 20;

/// Width of the band over that of the moving average which gives the mean response g(f). With twice this value, the error's weight
/// follows single resonances more closely.
const SMOOTH: usize = 30;

/// Transfer functions from all actuators to all points over the lines of the band, divided by √g, with g(f)
/// the mean squared response.
#[derive(Debug)]
pub(crate) struct Transfer {
    /// Number of points.
    pub rows: usize,
    /// Number of actuators.
    pub ports: usize,
    /// The transfer functions times `weights`, `[line][point][actuator]`.
    pub values: Vec<Complex<f64>>,
    /// Weight 1/√g of each frequency line, with g the smoothed mean squared response.
    pub weights: Vec<f64>,
    /// The points of each set: those requested or, with sampled responses, the nearest stored ones.
    pub places: Vec<Vec<Point>>,
}

impl Transfer {
    /// Computes the transfer functions to sets of points: the first `moving` (a count) sets are targets, all
    /// others points that are kept still.
    pub fn new(
        responses: &Responses,
        sets: &[&[Point]],
        moving: usize,
        quantity: Quantity,
        plan: &Plan,
    ) -> Result<Self, FocusError> {
        let rows = sets.iter().map(|set| set.len()).sum();
        let ports = responses.ports().len();
        let mut values = vec![Complex::default(); plan.lines.len() * rows * ports];
        let places = match responses {
            Responses::Modal(modal) => {
                fill_modal(modal, sets, moving, quantity, plan, &mut values)?;
                sets.iter().map(|set| set.to_vec()).collect()
            }
            Responses::Sampled(sampled) => fill_sampled(sampled, sets, moving, quantity, plan, &mut values)?,
        };
        let weights = weights(&values, rows * ports, rows);
        for (line, weight) in values.chunks_exact_mut((rows * ports).max(1)).zip(&weights) {
            line.iter_mut().for_each(|h| *h *= *weight);
        }
        Ok(Self { rows, ports, values, weights, places })
    }
}

/// 1/√g: the power of the responses of a point to all actuators, averaged over points and neighbouring lines.
fn weights(values: &[Complex<f64>], per_line: usize, rows: usize) -> Vec<f64> {
    let power = |line: &[Complex<f64>]| line.iter().map(|h| h.norm_sqr()).sum::<f64>() / rows as f64;
    let mut sums = vec![0.0];
    for line in values.chunks_exact(per_line.max(1)) {
        sums.push(sums[sums.len() - 1] + power(line));
    }
    let lines = sums.len() - 1;
    let half = (lines / SMOOTH / 2).max(1);
    let mean = |line: usize| {
        let (first, end) = (line.saturating_sub(half), (line + half + 1).min(lines));
        (sums[end] - sums[first]) / (end - first) as f64
    };
    let weight = |g: f64| if g > 0.0 { 1.0 / g.sqrt() } else { 0.0 };
    (0..lines).map(|line| weight(mean(line))).collect()
}

/// Exact transform of the modal response that the field and the time-domain simulation use: an impulse for
/// each sample of the drive, then free decay.
fn fill_modal(
    modal: &ModalResponses,
    sets: &[&[Point]],
    moving: usize,
    quantity: Quantity,
    plan: &Plan,
    values: &mut [Complex<f64>],
) -> Result<(), FocusError> {
    let usual = usual(modal);
    for (target, set) in sets[..moving].iter().enumerate() {
        if largest(modal.shapes.at_all(set).as_ref()) <= REST * usual {
            return Err(FocusError::Still { target, at: set[0] });
        }
    }
    let points: Vec<Point> = sets.iter().flat_map(|set| set.iter().copied()).collect();
    let readout = modal.shapes.at_all(&points);
    let ports = modal.ports.len();
    let per_line = points.len() * ports;
    let weights = Mat::from_fn(per_line, modal.poles.len(), |i, m| {
        readout[(i / ports, m)] * modal.input[(i % ports, m)] / plan.rate
    });
    let step = TAU / plan.convolver.size() as f64;
    let rings: Vec<Ring> = modal.poles.iter().map(|pole| Ring::of(*pole, plan.rate, quantity)).collect();
    let count = (AT_ONCE / rings.len().max(1)).max(1);
    for (block, values) in values.chunks_mut(count * per_line.max(1)).enumerate() {
        let first = plan.lines.start + block * count;
        let lines = values.len() / per_line.max(1);
        let mut ringing = [Mat::zeros(rings.len(), lines), Mat::zeros(rings.len(), lines)];
        for line in 0..lines {
            let z = Complex::from_polar(1.0, -step * (first + line) as f64);
            for (m, ring) in rings.iter().enumerate() {
                let value = ring.at(z);
                ringing[0][(m, line)] = value.re;
                ringing[1][(m, line)] = value.im;
            }
        }
        let [re, im] = ringing.map(|part| product(weights.as_ref(), part.as_ref()));
        for (i, value) in values.iter_mut().enumerate() {
            let (line, row) = (i / per_line, i % per_line);
            *value = Complex::new(re[(row, line)], im[(row, line)]);
        }
    }
    Ok(())
}

/// `Σ_n x[n] zⁿ` of a pole's displacement or velocity x after a unit impulse, z = e^{-jθ}: the state after it is Aⁿ kick, with A
/// its propagator over one sample, so that the sum is `(1 − zA)⁻¹ kick`, a quotient of polynomials.
struct Ring {
    above: [f64; 2],
    below: [f64; 2],
}

impl Ring {
    /// The quotient for a pole at `rate` samples per second.
    fn of(pole: Pole, rate: f64, quantity: Quantity) -> Self {
        let [[a, b], [c, d]] = pole.step(1.0 / rate);
        let [u, v] = pole.kick();
        let above = match quantity {
            Quantity::Displacement => [u, b * v - d * u],
            Quantity::Velocity => [v, c * u - a * v],
        };
        // The determinant of A is e^{-2σ/rate}.
        Self { above, below: [-(a + d), (-2.0 * pole.sigma / rate).exp()] }
    }

    fn at(&self, z: Complex<f64>) -> Complex<f64> {
        let below = (z * self.below[1] + self.below[0]) * z + 1.0;
        (z * self.above[1] + self.above[0]) * below.conj() / below.norm_sqr()
    }
}

/// The transforms of stored responses, and the stored points used for those requested.
fn fill_sampled(
    sampled: &SampledResponses,
    sets: &[&[Point]],
    moving: usize,
    quantity: Quantity,
    plan: &Plan,
    values: &mut [Complex<f64>],
) -> Result<Vec<Vec<Point>>, FocusError> {
    let ports = sampled.ports.len();
    let rows: usize = sets.iter().map(|set| set.len()).sum();
    let mut places = Vec::with_capacity(sets.len());
    let mut row = 0;
    for (target, set) in sets.iter().enumerate() {
        let mut found = Vec::with_capacity(set.len());
        for at in *set {
            let stored = locate(sampled, target, *at)?;
            found.push(sampled.points[stored]);
            for port in 0..ports {
                let response = sampled.response(port, stored);
                let spectrum = match quantity {
                    Quantity::Displacement => plan.convolver.spectrum(integral(response, plan.rate)),
                    Quantity::Velocity => plan.convolver.spectrum(response.iter().map(|h| f64::from(*h))),
                };
                for (line, value) in spectrum[plan.lines.clone()].iter().enumerate() {
                    values[(line * rows + row) * ports + port] = value / plan.rate;
                }
            }
            row += 1;
        }
        let still = |at: &Point| {
            sampled
                .nearest(*at)
                .is_none_or(|i| (0..ports).all(|p| sampled.response(p, i).iter().all(|h| *h == 0.0)))
        };
        if target < moving && found.iter().all(still) {
            return Err(FocusError::Still { target, at: set[0] });
        }
        places.push(found);
    }
    Ok(places)
}
