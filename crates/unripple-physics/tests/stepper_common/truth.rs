//! Modes and loads as one system of equations, integrated by tiny steps of Runge and Kutta's fourth order: nothing of the
//! stepper's scheme is in here.
#![allow(dead_code)]

use unripple_core::Pole;
use unripple_physics::{Circuit, Housing};

/// What hangs at a port: mass, damping, stiffness, coil and housing.
#[derive(Clone, Debug)]
pub struct Hung {
    pub weights: Vec<f64>,
    pub values: [f64; 3],
    pub circuit: Option<Circuit>,
    pub housing: Option<Housing>,
}

/// The coupled system: displacement and velocity of each mode, then of each load the extension of its spring to the ground, its
/// current, the extension of its housing's spring, and its housing's velocity.
pub struct Truth {
    poles: Vec<Pole>,
    hung: Vec<Hung>,
    /// Inverse of the mass matrix `1 + Σ μ w wᵀ`, row by row.
    lightness: Vec<Vec<f64>>,
    pub state: Vec<f64>,
}

impl Truth {
    pub fn new(poles: &[Pole], hung: &[Hung]) -> Self {
        let n = poles.len();
        let heft = |i: usize, j: usize| {
            let hung: f64 = hung.iter().map(|h| h.values[0] * h.weights[i] * h.weights[j]).sum();
            if i == j { 1.0 + hung } else { hung }
        };
        let lightness = inverse((0..n).map(|i| (0..n).map(|j| heft(i, j)).collect()).collect());
        let state = vec![0.0; 2 * n + 4 * hung.len()];
        Self { poles: poles.to_vec(), hung: hung.to_vec(), lightness, state }
    }

    /// An impulse on the modes.
    pub fn strike(&mut self, weights: &[f64], impulse: f64) {
        let n = self.poles.len();
        for i in 0..n {
            let gain: f64 = self.lightness[i].iter().zip(weights).map(|(l, w)| l * w).sum();
            self.state[n + i] += gain * impulse;
        }
    }

    /// An impulse on the modes where a load hangs, and back on its housing.
    pub fn push(&mut self, load: usize, impulse: f64) {
        let weights = self.hung[load].weights.clone();
        self.strike(&weights, impulse);
        if let Some(housing) = self.hung[load].housing {
            let place = 2 * self.poles.len() + 3 * self.hung.len() + load;
            self.state[place] -= impulse / housing.mass;
        }
    }

    /// A jump of the voltage's integral at a load's coil.
    pub fn shock(&mut self, load: usize, flux: f64) {
        let circuit = self.hung[load].circuit.unwrap();
        if circuit.inductance > 0.0 {
            let n = 2 * self.poles.len() + self.hung.len();
            self.state[n + load] += flux / circuit.inductance;
        } else {
            self.push(load, circuit.force_constant / circuit.resistance * flux);
        }
    }

    /// The velocity of a load's contact relative to its housing, or to the ground if it has none.
    pub fn apart(&self, load: usize) -> f64 {
        let housing = self.state[2 * self.poles.len() + 3 * self.hung.len() + load];
        self.velocity(&self.hung[load].weights) - housing
    }

    /// The velocity that weights see.
    pub fn velocity(&self, weights: &[f64]) -> f64 {
        let n = self.poles.len();
        weights.iter().zip(&self.state[n..2 * n]).map(|(w, v)| w * v).sum()
    }

    /// The current in a load's coil.
    pub fn current(&self, load: usize) -> f64 {
        self.state[2 * self.poles.len() + self.hung.len() + load]
    }

    fn slope(&self, x: &[f64]) -> Vec<f64> {
        let (n, loads) = (self.poles.len(), self.hung.len());
        let mut slope = vec![0.0; x.len()];
        let mut force: Vec<f64> = (self.poles.iter().enumerate())
            .map(|(m, pole)| -pole.omega * pole.omega * x[m] - 2.0 * pole.sigma * x[n + m])
            .collect();
        for (l, hung) in self.hung.iter().enumerate() {
            let v: f64 = hung.weights.iter().zip(&x[n..]).map(|(w, v)| w * v).sum();
            let [e, i, x, u] = [0, 1, 2, 3].map(|part| x[2 * n + part * loads + l]);
            slope[2 * n + l] = v;
            // Between contact and housing; without one, u stays 0.
            let apart = v - u;
            let Housing { mass, damping, stiffness } =
                hung.housing.unwrap_or(Housing { mass: f64::INFINITY, damping: 0.0, stiffness: 0.0 });
            let mut pull = -damping * apart - stiffness * x;
            if let Some(Circuit { force_constant: bl, resistance, inductance }) = hung.circuit {
                if inductance > 0.0 {
                    slope[2 * n + loads + l] = (-resistance * i - bl * apart) / inductance;
                    pull += bl * i;
                } else {
                    pull -= bl * bl / resistance * apart;
                }
            }
            slope[2 * n + 2 * loads + l] = apart;
            slope[2 * n + 3 * loads + l] = -pull / mass;
            pull -= hung.values[1] * v + hung.values[2] * e;
            force.iter_mut().zip(&hung.weights).for_each(|(f, w)| *f += w * pull);
        }
        for m in 0..n {
            slope[m] = x[n + m];
            slope[n + m] = self.lightness[m].iter().zip(&force).map(|(l, f)| l * f).sum();
        }
        slope
    }

    /// Goes on by a time, in so many steps.
    pub fn advance(&mut self, time: f64, steps: usize) {
        let h = time / steps as f64;
        let ahead =
            |x: &[f64], k: &[f64], h: f64| -> Vec<f64> { x.iter().zip(k).map(|(x, k)| x + h * k).collect() };
        for _ in 0..steps {
            let x = self.state.clone();
            let a = self.slope(&x);
            let b = self.slope(&ahead(&x, &a, h / 2.0));
            let c = self.slope(&ahead(&x, &b, h / 2.0));
            let d = self.slope(&ahead(&x, &c, h));
            for (i, x) in self.state.iter_mut().enumerate() {
                *x += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
        }
    }
}

/// By Gauss and Jordan; the matrix is positive definite.
fn inverse(mut matrix: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = matrix.len();
    for (i, row) in matrix.iter_mut().enumerate() {
        row.extend((0..n).map(|j| if i == j { 1.0 } else { 0.0 }));
    }
    for i in 0..n {
        let pivot = matrix[i][i];
        matrix[i].iter_mut().for_each(|x| *x /= pivot);
        let base = matrix[i].clone();
        for (j, row) in matrix.iter_mut().enumerate() {
            let factor = row[i];
            if j != i {
                row.iter_mut().zip(&base).for_each(|(x, b)| *x -= factor * b);
            }
        }
    }
    matrix.into_iter().map(|row| row[n..].to_vec()).collect()
}
