//! A simply supported film under tension, from its closed form, and drives made by hand.

use std::f64::consts::PI;
use std::sync::Arc;
use unripple_core::{
    Conditions, Drive, ModalResponses, Outline, Point, Pole, Port, Responses, Shape, Shapes,
};
use unripple_linalg::{Mat, product};

/// Sine products on a rectangle, mass-normalised.
#[derive(Clone, Debug)]
pub struct Sines {
    pub width: f64,
    pub height: f64,
    pub areal_density: f64,
    pub numbers: Vec<(f64, f64)>,
}

impl Shapes for Sines {
    fn modes(&self) -> usize {
        self.numbers.len()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let scale = 2.0 / (self.areal_density * self.width * self.height).sqrt();
        for (w, (m, n)) in row.iter_mut().zip(&self.numbers) {
            *w = scale * (m * PI * point.x / self.width).sin() * (n * PI * point.y / self.height).sin();
        }
    }
}

/// A rectangular film: ω² = k²(R + D k²)/ρ_s, one decay time.
#[derive(Clone, Debug)]
pub struct Film {
    pub width: f64,
    pub height: f64,
    pub areal_density: f64,
    pub tension: f64,
    pub stiffness: f64,
    pub decay_time: f64,
    pub top_hz: f64,
    pub rate: f64,
    pub ports: Vec<Point>,
}

impl Film {
    /// The film of Hudin et al. 2012, simply supported, with eight actuators placed without symmetry.
    pub fn paper() -> Self {
        let ports = [(12, 31), (9, 84), (40, 140), (95, 137), (141, 106), (138, 44), (103, 11), (50, 9)];
        Self {
            width: 0.15,
            height: 0.15,
            areal_density: 1400.0 * 0.125e-3,
            tension: 200.0,
            stiffness: 4e9 * 0.125e-3_f64.powi(3) / 12.0 / (1.0 - 0.09),
            decay_time: 70e-3,
            top_hz: 3000.0,
            rate: 48e3,
            ports: ports.map(|(x, y)| Point::from_mm(f64::from(x), f64::from(y))).to_vec(),
        }
    }

    fn omega(&self, k: f64) -> f64 {
        (k * k * (self.tension + self.stiffness * k * k) / self.areal_density).sqrt()
    }

    /// Every mode up to the top of the band.
    pub fn modal(&self) -> ModalResponses {
        let top = 2.0 * PI * self.top_hz;
        let square = (-self.tension
            + (self.tension.powi(2) + 4.0 * self.stiffness * self.areal_density * top * top).sqrt())
            / (2.0 * self.stiffness);
        let k_top = if self.stiffness > 0.0 {
            square.sqrt()
        } else {
            top * (self.areal_density / self.tension).sqrt()
        };
        let mut modes = Vec::new();
        for m in 1..=(k_top * self.width / PI) as u32 {
            for n in 1..=(k_top * self.height / PI) as u32 {
                let k = (f64::from(m) * PI / self.width).hypot(f64::from(n) * PI / self.height);
                if k <= k_top {
                    modes.push((self.omega(k), (f64::from(m), f64::from(n))));
                }
            }
        }
        modes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let numbers = modes.iter().map(|mode| mode.1).collect();
        let shapes =
            Sines { width: self.width, height: self.height, areal_density: self.areal_density, numbers };
        let outline = Outline::new(Shape::Rectangle { width: self.width, height: self.height });
        ModalResponses {
            ports: self
                .ports
                .iter()
                .enumerate()
                .map(|(i, at)| Port { name: format!("a{}", i + 1), at: *at })
                .collect(),
            poles: modes.iter().map(|mode| Pole::new(mode.0, 1.0 / self.decay_time)).collect(),
            input: shapes.at_all(&self.ports),
            shapes: Arc::new(shapes),
            conditions: Conditions {
                rate: self.rate,
                band: [0.0, self.top_hz],
                lambda_min: 2.0 * PI / k_top,
                outline,
            },
            frequency_error: 0.0,
            mode_errors: Vec::new(),
        }
    }

    #[allow(dead_code)]
    pub fn responses(&self) -> Responses {
        Responses::Modal(self.modal())
    }
}

#[allow(dead_code)]
/// Velocity response at sample `i`, from the definition.
pub fn velocity(modal: &ModalResponses, actuator: usize, at: Point, i: usize) -> f64 {
    sum(modal, actuator, at, |pole| pole.velocity(i as f64 / modal.conditions.rate))
}

/// Displacement response at sample `i`, from the definition.
#[allow(dead_code)]
pub fn displacement(modal: &ModalResponses, actuator: usize, at: Point, i: usize) -> f64 {
    sum(modal, actuator, at, |pole| pole.displacement(i as f64 / modal.conditions.rate))
}

fn sum(modal: &ModalResponses, actuator: usize, at: Point, of: impl Fn(&Pole) -> f64) -> f64 {
    let mut row = vec![0.0; modal.shapes.modes()];
    modal.shapes.at(at, &mut row);
    modal
        .poles
        .iter()
        .zip(&row)
        .enumerate()
        .map(|(m, (pole, w))| modal.input[(actuator, m)] * w * of(pole))
        .sum()
}

/// Responses to every actuator at a point, samples 0 … n, reversed and unscaled.
pub fn reversed(modal: &ModalResponses, at: Point, n: usize) -> Drive {
    let mut row = vec![0.0; modal.shapes.modes()];
    modal.shapes.at(at, &mut row);
    let weights = Mat::from_fn(modal.ports.len(), row.len(), |a, m| modal.input[(a, m)] * row[m]);
    let ringing = Mat::from_fn(row.len(), n + 1, |m, i| {
        modal.poles[m].velocity((n - i) as f64 / modal.conditions.rate)
    });
    let all = product(weights.as_ref(), ringing.as_ref());
    drive(modal, (0..modal.ports.len()).map(|a| (0..=n).map(|i| all[(a, i)]).collect()).collect())
}

/// A drive with the responses' rate and names.
pub fn drive(modal: &ModalResponses, channels: Vec<Vec<f64>>) -> Drive {
    let names = modal.ports.iter().map(|port| port.name.clone()).collect();
    Drive::new(modal.conditions.rate, names, channels).unwrap()
}
