//! Time-stepping of an exciter's housing, as the motion of the sheet drives the housing and its coil.

use crate::{Circuit, Housing};

/// Number of terms in the series of a matrix exponential whose argument has a norm of at most 1/2: the next
/// term is below 1e-18. With twice this value, sums stay the same.
const TERMS: u32 = 16;

/// Largest number of times that the argument of the exponential is halved: 2^64 times 1/2 is beyond all
/// rates that a surface file can describe.
const HALVINGS: f64 = 64.0;

/// Number of coordinates: one each for the spring, the housing and the current, then the velocity of the
/// sheet and its change over a sample.
const SIZE: usize = 5;

/// A square matrix, coordinates x coordinates.
type Square = [[f64; SIZE]; SIZE];

/// A housing on its spring, advanced sample by sample; exact if the velocity of the sheet is linear between
/// samples.
pub(super) struct Suspension {
    /// State-transition matrix from the coordinates at a sample to those at the next. The first three are
    /// √(k/M) times the extension of the spring, the velocity of the housing, and √(L/M) times the current,
    /// all in m/s, so that half of M times the sum of their squares is the energy.
    step: Square,
    /// Signal per velocity of the coil relative to the housing, and per coordinate of the current.
    gains: [f64; 2],
}

impl Suspension {
    /// A housing whose coil has the electromotive force `gain` (V·s/m) and is open, or closed by a circuit,
    /// at `rate` samples per second.
    pub(super) fn new(housing: &Housing, circuit: Option<Circuit>, gain: f64, rate: f64) -> Self {
        let Housing { mass, damping, stiffness } = *housing;
        let spring = (stiffness / mass).sqrt();
        let (mut damper, mut coil, mut loss) = (damping / mass, 0.0, 0.0);
        let mut gains = [gain, 0.0];
        if let Some(circuit) = circuit {
            let Circuit { force_constant, resistance, inductance } = circuit;
            if circuit.is_inductive() {
                (coil, loss) = (force_constant / (inductance * mass).sqrt(), resistance / inductance);
                gains = [0.0, (mass / inductance).sqrt()];
            } else {
                damper += force_constant * force_constant / (resistance * mass);
                gains = [gain / resistance, 0.0];
            }
        }
        // Rates of change, in 1/s; the velocity of the sheet changes by its change over one sample.
        let rates = [
            [0.0, -spring, 0.0, spring, 0.0],
            [spring, -damper, coil, damper, 0.0],
            [0.0, -coil, -loss, coil, 0.0],
            [0.0, 0.0, 0.0, 0.0, rate],
            [0.0; SIZE],
        ];
        Self { step: exponential(&rates.map(|row| row.map(|x| x / rate))), gains }
    }

    /// The signal that a velocity (m/s) of the sheet causes, sample by sample, starting from rest: the
    /// voltage (V) of an open coil, or the current (A) of a closed one.
    pub(super) fn signal(&self, velocity: &[f64]) -> Vec<f64> {
        let (mut state, mut last) = ([0.0_f64; 3], 0.0_f64);
        let one = |now: &f64| {
            let before = [state[0], state[1], state[2], last, now - last];
            for (to, row) in state.iter_mut().zip(&self.step) {
                *to = row.iter().zip(before).map(|(factor, x)| factor * x).sum();
            }
            last = *now;
            self.gains[0] * (now - state[1]) + self.gains[1] * state[2]
        };
        velocity.iter().map(one).collect()
    }
}

/// The exponential of a matrix by scaling and squaring: the power series for the matrix divided by 2^n,
/// squared n times.
fn exponential(matrix: &Square) -> Square {
    let size = |row: &[f64; SIZE]| row.iter().map(|x| x.abs()).sum::<f64>();
    let norm = matrix.iter().map(size).fold(0.0, f64::max);
    let halvings = (2.0 * norm).log2().ceil().clamp(0.0, HALVINGS) as i32;
    let part = matrix.map(|row| row.map(|x| x * 0.5_f64.powi(halvings)));
    let mut sum: Square = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    for n in (1..=TERMS).rev() {
        sum = times(&part, &sum).map(|row| row.map(|x| x / f64::from(n)));
        sum.iter_mut().enumerate().for_each(|(i, row)| row[i] += 1.0);
    }
    (0..halvings).fold(sum, |sum, _| times(&sum, &sum))
}

fn times(a: &Square, b: &Square) -> Square {
    let entry = |i: usize, j: usize| (0..SIZE).map(|k| a[i][k] * b[k][j]).sum::<f64>();
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use unripple_core::Pole;

    #[test]
    fn a_housing_on_a_sheet_that_sets_off_rings_as_its_pole() {
        let rate = 48e3;
        for (hz, quality) in [(150.0, 3.0), (150.0, 0.5), (20.0, 0.2), (9e3, 30.0), (1e5, 1.0)] {
            let (mass, omega) = (0.04, TAU * hz);
            let housing = Housing { mass, damping: mass * omega / quality, stiffness: mass * omega * omega };
            let heard = Suspension::new(&housing, None, 2.5, rate).signal(&[1.0; 400]);
            // The relative velocity obeys r'' + (ω/Q) r' + ω² r = v''. The velocity v rises to 1 over the first sample, so that v'' is an
            // impulse at its beginning and the opposite one at its end.
            let pole = Pole::new(omega, 0.5 * omega / quality);
            let risen = |t: f64| rate * pole.displacement(t);
            for (i, heard) in heard.iter().enumerate() {
                let t = (i + 1) as f64 / rate;
                let exact = 2.5 * (risen(t) - if i > 0 { risen(t - 1.0 / rate) } else { 0.0 });
                assert!((heard - exact).abs() < 1e-9, "{hz} Hz, {quality}, {i}: {heard} {exact}");
            }
        }
    }

    #[test]
    fn exponentials_add_up() {
        let of = |share: f64| -> Square {
            let entry = |i: usize, j: usize| share * (((3 * i + 7 * j) % 5) as f64 - 2.0);
            exponential(&std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
        };
        for share in [0.01, 0.1, 0.5] {
            let (product, sum) = (times(&of(share), &of(2.0 * share)), of(3.0 * share));
            let size = sum.as_flattened().iter().fold(0.0_f64, |most, x| x.abs().max(most));
            for (a, b) in product.as_flattened().iter().zip(sum.as_flattened()) {
                assert!((a - b).abs() < 1e-13 * size, "{share}: {a} {b}");
            }
        }
    }
}
