//! Sheets and drives that tests of the stepper share.
#![allow(dead_code)]

use std::f64::consts::PI;
use std::sync::Arc;
use unripple_core::*;
use unripple_physics::stepper::*;
use unripple_physics::{Circuit, Footprint, Housing, Load};

/// Side of the square sheets, in m.
pub const SIDE: f64 = 0.15;

/// Mass of the sheets, in kg.
pub const MASS: f64 = 0.175 * SIDE * SIDE;

/// Shapes of a square sheet supported all round: products of sines.
#[derive(Debug)]
pub struct Sines(pub usize);

impl Sines {
    fn orders(&self) -> impl Iterator<Item = (f64, f64)> {
        let across = (self.0 as f64).sqrt().ceil() as usize;
        (0..self.0).map(move |m| ((m % across + 1) as f64, (m / across + 1) as f64))
    }
}

impl Shapes for Sines {
    fn modes(&self) -> usize {
        self.0
    }

    fn at(&self, p: Point, row: &mut [f64]) {
        for (row, (i, j)) in row.iter_mut().zip(self.orders()) {
            *row = 2.0 / MASS.sqrt() * (i * PI * p.x / SIDE).sin() * (j * PI * p.y / SIDE).sin();
        }
    }
}

/// A supported square membrane of so many modes, 200 N/m.
pub fn membrane(modes: usize, sigma: f64) -> Plant {
    let shapes = Sines(modes);
    let omega = |(i, j): (f64, f64)| PI / SIDE * ((i * i + j * j) * 200.0 / 0.175).sqrt();
    let poles: Vec<Pole> = shapes.orders().map(|order| Pole::new(omega(order), sigma)).collect();
    Plant::new(&poles, Arc::new(shapes), square()).unwrap()
}

/// The rim.
pub fn square() -> Outline {
    Outline::new(Shape::Rectangle { width: SIDE, height: SIDE })
}

/// A point by its millimetres.
pub fn mm(x: f64, y: f64) -> Point {
    Point::from_mm(x, y)
}

/// A force at a point.
pub fn force(x: f64, y: f64) -> Channel {
    Channel::force(Footprint::point(mm(x, y)))
}

/// A load on a point.
pub fn load(x: f64, y: f64, [mass, damping, stiffness]: [f64; 3], circuit: Option<Circuit>) -> Load {
    Load { footprint: Footprint::point(mm(x, y)), mass, damping, stiffness, circuit, housing: None }
}

/// A moving magnet driven by a voltage.
pub fn coil(x: f64, y: f64, mass: f64, circuit: Circuit) -> Channel {
    let load = load(x, y, [mass, 0.0, 0.0], Some(circuit));
    Channel { footprint: load.footprint.clone(), gain: 1.0, load: Some(load), voltage: true }
}

/// An exciter on a current, or on a voltage if it has a circuit: a housing that hangs on a coil of some mass.
pub fn exciter(x: f64, y: f64, mass: f64, housing: Housing, circuit: Option<Circuit>) -> Channel {
    let load = Load { housing: Some(housing), ..load(x, y, [mass, 0.0, 0.0], circuit) };
    Channel { footprint: load.footprint.clone(), gain: 1.0, load: Some(load), voltage: circuit.is_some() }
}

/// A fingertip touching at a point.
pub fn finger(x: f64, y: f64, [mass, damping, stiffness]: [f64; 3]) -> Contact {
    Contact { at: mm(x, y), finger: Finger { mass, damping, stiffness, contact_radius: 0.0 } }
}

/// Numbers between -1 and 1 that look random.
pub fn noise(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..20).for_each(|_| {
        next();
    });
    (0..count).map(|_| next()).collect()
}

/// A smooth pulse within the band: a windowed sine, channels one after the other.
pub fn pulse(channels: usize, frames: usize, hz: f64, rate: f64) -> Vec<f64> {
    let value = |channel: usize, i: usize| {
        let x = (i as f64 + 0.5) / frames as f64;
        (PI * x).sin().powi(4) * (2.0 * PI * hz * (1.0 + 0.1 * channel as f64) * i as f64 / rate).sin()
    };
    (0..channels).flat_map(|channel| (0..frames).map(move |i| value(channel, i))).collect()
}

/// Sensors and probes of a whole drive, taken in at once.
pub fn run(surface: &mut VirtualSurface, drive: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let frames = drive.len() / surface.channels();
    let mut sensors = vec![0.0; drive.len()];
    let mut probes = vec![0.0; frames * surface.probes()];
    surface.process(frames, drive, &mut sensors, &mut probes).unwrap();
    (sensors, probes)
}

/// Lets a surface go on without drive.
pub fn rest(surface: &mut VirtualSurface, frames: usize) {
    run(surface, &vec![0.0; frames * surface.channels()]);
}

/// Largest magnitude.
pub fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |peak, x| x.abs().max(peak))
}

/// Largest difference, relative to the largest magnitude of the second.
pub fn apart(found: &[f64], exact: &[f64]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let difference: Vec<f64> = found.iter().zip(exact).map(|(a, b)| a - b).collect();
    peak(&difference) / peak(exact)
}
