//! Latency of a film whose tones are not the model's, above its band as well.

use std::f64::consts::{PI, TAU};
use unripple_calibrate::measure::{Hearing, latency};
use unripple_calibrate::signals::{Band, shift};
use unripple_core::{ActuatorKind, CoilDrive, Decay, Edge, Edges, Point, Responses, Surface};
use unripple_physics::design::papers_surface;
use unripple_physics::{ResponseOptions, responses};

const RATE: f64 = 48e3;
const LEAD: usize = 240;

/// The paper's film, supported, as the file says it is.
fn film(top: f64) -> Surface {
    let mut film = papers_surface();
    film.outline.edges = Edges::All(Edge::Supported);
    film.emission.band = [0.0, top];
    film.actuators.truncate(6);
    film
}

/// The measured film: its tension, how long it rings, how far its actuators are off, and its highest mode.
struct Truth {
    tension: f64,
    decay: f64,
    off: f64,
    top: f64,
}

impl Truth {
    /// Responses between the actuators by the closed form, limited to a band and delayed.
    fn heard(&self, film: &Surface, samples: usize, late: f64, band: Band) -> Vec<Vec<Vec<f64>>> {
        let (density, side) = (film.sheet.density * film.sheet.thickness, 0.15);
        let bending =
            film.sheet.young * film.sheet.thickness.powi(3) / 12.0 / (1.0 - film.sheet.poisson.powi(2));
        let places: Vec<Point> = film
            .actuators
            .iter()
            .enumerate()
            .map(|(i, a)| {
                let (sin, cos) = (2.4 * i as f64).sin_cos();
                Point::new(a.at.x + self.off * cos, a.at.y + self.off * sin)
            })
            .collect();
        let mut modes = Vec::new();
        for (i, j) in (1..99).flat_map(|i| (1..99).map(move |j| (f64::from(i), f64::from(j)))) {
            let square = (PI / side).powi(2) * (i * i + j * j);
            let omega = (square * (self.tension + bending * square) / density).sqrt();
            if omega < TAU * self.top {
                let shape = |p: &Point| (i * PI * p.x / side).sin() * (j * PI * p.y / side).sin();
                let weights: Vec<f64> =
                    places.iter().map(|p| 2.0 / (density * side * side).sqrt() * shape(p)).collect();
                modes.push((omega, weights));
            }
        }
        let sigma = 1.0 / self.decay;
        let one = |b: usize, a: usize| {
            let mut sum = vec![0.0; samples];
            for (omega, weights) in &modes {
                let ringing = (omega * omega - sigma * sigma).sqrt();
                let (sin, cos) = (ringing / RATE).sin_cos();
                let fade = (-sigma / RATE).exp();
                let [mut x, mut y] = [weights[b] * weights[a], 0.0];
                for sum in &mut sum {
                    *sum += x - sigma / ringing * y;
                    [x, y] = [fade * (x * cos - y * sin), fade * (x * sin + y * cos)];
                }
            }
            let mut all = vec![0.0; LEAD];
            all.extend(sum);
            band.limit(&mut all, RATE).unwrap();
            shift(&all, late)
        };
        let count = places.len();
        (0..count).map(|b| (0..count).map(|a| one(b.max(a), b.min(a))).collect()).collect()
    }
}

fn model(film: &Surface) -> Hearing {
    let Ok(Responses::Modal(model)) = responses(film, &ResponseOptions::default()) else { panic!() };
    Hearing::of(film, &model).unwrap()
}

#[test]
fn it_does_not_depend_on_what_rings_above_the_band() {
    let film = film(1500.0);
    let (model, band) = (model(&film), Band::within(60.0, 1800.0));
    let mut most = 0.0_f64;
    for (top, tension, off) in [
        (1500.0, 200.0, 0.0),
        (1800.0, 200.0, 0.0),
        (2200.0, 200.0, 0.0),
        (2200.0, 201.0, 1e-3),
        (4000.0, 199.0, 1e-3),
    ] {
        let truth = Truth { tension, decay: 0.07, off, top };
        let found = latency(&truth.heard(&film, 12_000, 37.37, band), &model, LEAD, RATE, band).unwrap();
        println!("ringing to {top} Hz, {tension} N/m, {off} m off: {found:.4?}");
        most = most.max((found[0] - 37.37).abs());
    }
    assert!(most < 0.05, "{most}");
}

#[test]
fn a_film_that_dies_away_sooner_or_later_is_as_late() {
    let film = film(1500.0);
    let (model, band) = (model(&film), Band::within(60.0, 1800.0));
    for decay in [0.012, 0.03, 0.3] {
        let truth = Truth { tension: 200.5, decay, off: 5e-4, top: 2200.0 };
        let found = latency(&truth.heard(&film, 16_000, -3.21, band), &model, LEAD, RATE, band).unwrap();
        println!("decay {decay} s: {found:.4?}");
        assert!((found[0] + 3.21).abs() < 0.05, "{decay}: {found:?}");
    }
}

/// After some tens of periods the tones of another film are out of step with those of the file.
#[test]
fn a_film_that_is_far_from_its_file_is_as_late() {
    let mut film = film(1500.0);
    film.sheet.decay = Decay::Time(0.3);
    let (model, band) = (model(&film), Band::within(60.0, 1800.0));
    for tension in [205.0, 210.0, 225.0, 250.0] {
        let truth = Truth { tension, decay: 0.3, off: 5e-4, top: 2200.0 };
        let found = latency(&truth.heard(&film, 16_000, 240.12, band), &model, LEAD, RATE, band).unwrap();
        println!("{tension} N/m: {found:.4?}");
        assert!((found[0] - 240.12).abs() < 0.05, "{tension}: {found:?}");
    }
}

#[test]
fn a_few_actuators_and_a_reversed_one_are_enough() {
    let mut film = film(1500.0);
    film.actuators.truncate(3);
    let (model, band) = (model(&film), Band::within(60.0, 1800.0));
    let truth = Truth { tension: 200.0, decay: 0.07, off: 1e-3, top: 2200.0 };
    let mut heard = truth.heard(&film, 16_000, 512.25, band);
    heard[1].iter_mut().flatten().for_each(|x| *x = -*x);
    let found = latency(&heard, &model, LEAD, RATE, band).unwrap();
    println!("{found:.4?}");
    assert!((found[0] - 512.25).abs() < 0.05, "{found:?}");
}

/// Coils on a voltage take the tones out of step; another film's do so in another way.
#[test]
fn coils_on_a_voltage_are_compared_with_a_model() {
    for (force_constant, inductance) in [(0.5, 0.0), (0.5, 1.9e-3), (2.0, 0.4e-3)] {
        let mut film = film(1000.0);
        let kind = ActuatorKind::MovingMagnet {
            force_constant,
            resistance: 6.2,
            inductance,
            moving_mass: 7e-6,
            driven_by: CoilDrive::Voltage,
        };
        film.actuators.iter_mut().for_each(|actuator| actuator.kind = kind);
        let known = model(&film);
        for (tension, most) in [(1.0, 0.05), (1.003, 0.2)] {
            let mut other = film.clone();
            other.sheet.tension *= tension;
            let band = Band::within(60.0, 1200.0);
            let there = model(&other);
            let one = |b: usize, a: usize| {
                let mut all = vec![0.0; LEAD];
                all.extend(there.response(b, a, 12_000));
                band.limit(&mut all, RATE).unwrap();
                shift(&all, 5.43)
            };
            let heard: Vec<Vec<Vec<f64>>> = (0..6).map(|b| (0..6).map(|a| one(b, a)).collect()).collect();
            let found = latency(&heard, &known, LEAD, RATE, band).unwrap();
            println!("{force_constant} N/A, {inductance} H, tension x {tension}: {found:.4?}");
            assert!((found[0] - 5.43).abs() < most, "{found:?}");
        }
    }
}
