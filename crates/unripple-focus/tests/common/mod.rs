//! A simply supported film under tension, from its closed form, and the sums that define responses and fields.

#![allow(dead_code)]

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

/// A rectangular membrane: ω = k √(R/ρ_s), one decay time, every mode up to `top_hz`.
#[derive(Clone, Debug)]
pub struct Membrane {
    pub width: f64,
    pub height: f64,
    pub areal_density: f64,
    pub tension: f64,
    pub decay_time: f64,
    pub top_hz: f64,
    pub rate: f64,
    pub ports: Vec<Point>,
}

impl Membrane {
    /// A small membrane of few modes, quick to compute.
    pub fn small() -> Self {
        Self {
            width: 0.10,
            height: 0.08,
            areal_density: 0.175,
            tension: 200.0,
            decay_time: 20e-3,
            top_hz: 1500.0,
            rate: 12e3,
            ports: vec![Point::new(0.013, 0.021), Point::new(0.081, 0.034), Point::new(0.046, 0.071)],
        }
    }

    pub fn modal(&self) -> ModalResponses {
        let celerity = (self.tension / self.areal_density).sqrt();
        let k_top = 2.0 * PI * self.top_hz / celerity;
        let mut modes = Vec::new();
        for m in 1..=(k_top * self.width / PI) as u32 {
            for n in 1..=(k_top * self.height / PI) as u32 {
                let k = (f64::from(m) * PI / self.width).hypot(f64::from(n) * PI / self.height);
                if k <= k_top {
                    modes.push((k * celerity, (f64::from(m), f64::from(n))));
                }
            }
        }
        modes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let numbers = modes.iter().map(|mode| mode.1).collect();
        let (width, height) = (self.width, self.height);
        let shapes = Sines { width, height, areal_density: self.areal_density, numbers };
        let outline = Outline::new(Shape::Rectangle { width, height });
        let port = |(i, at): (usize, &Point)| Port { name: format!("a{}", i + 1), at: *at };
        ModalResponses {
            ports: self.ports.iter().enumerate().map(port).collect(),
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

    pub fn responses(&self) -> Responses {
        Responses::Modal(self.modal())
    }
}

/// Velocity responses at a point, `[actuator][sample]`, from the definition.
pub fn responses_at(modal: &ModalResponses, at: Point, samples: usize) -> Vec<Vec<f64>> {
    let mut row = vec![0.0; modal.shapes.modes()];
    modal.shapes.at(at, &mut row);
    let weights = Mat::from_fn(modal.ports.len(), row.len(), |a, m| modal.input[(a, m)] * row[m]);
    let ringing =
        Mat::from_fn(row.len(), samples, |m, i| modal.poles[m].velocity(i as f64 / modal.conditions.rate));
    let all = product(weights.as_ref(), ringing.as_ref());
    (0..modal.ports.len()).map(|a| (0..samples).map(|i| all[(a, i)]).collect()).collect()
}

/// Velocity that a drive makes at a point at one sample: Σ_a Σ_j h_a[i−j] d_a[j] / rate.
pub fn velocity(modal: &ModalResponses, drive: &Drive, at: Point, i: usize) -> f64 {
    let h = responses_at(modal, at, i + 1);
    let sum = |(h, d): (&Vec<f64>, &Vec<f64>)| (0..=i.min(d.len() - 1)).map(|j| h[i - j] * d[j]).sum::<f64>();
    h.iter().zip(drive.channels()).map(sum).sum::<f64>() / modal.conditions.rate
}
