//! The paper's surface measured at points, with errors that the software does not know.

#![allow(dead_code)]

use std::sync::LazyLock;
use unripple_calibrate::{Between, BetweenOptions, Interpolation};
use unripple_core::{Drive, ModalResponses, Outline, Point, Random, Responses, SampledResponses, Surface};
use unripple_devices::Perturbation;
use unripple_field::Field;
use unripple_focus::{Focuser, Method, Options, Target};
use unripple_physics::design::papers_surface;
use unripple_physics::{Medium, ResponseOptions, responses, sample};

pub const WINDOW: f64 = 0.030;
pub const RATE: f64 = 48e3;

/// Errors of a measurement: relative rms of noise and gains, rms distance (m) of points from their stated places.
#[derive(Clone, Copy)]
pub struct Errors {
    pub noise: f64,
    pub gain: f64,
    pub position: f64,
}

pub const USUAL: Errors = Errors { noise: 3.16e-3, gain: 5e-3, position: 0.0 };

#[derive(Clone)]
pub struct Truth {
    pub modal: ModalResponses,
    pub whole: Responses,
}

impl Truth {
    pub fn of(surface: &Surface) -> Self {
        let whole = responses(surface, &ResponseOptions::default()).unwrap();
        let Responses::Modal(modal) = whole.clone() else { unreachable!() };
        Self { modal, whole }
    }

    pub fn papers() -> Self {
        Self::of(&papers_surface())
    }

    /// A true surface that differs from the paper's: actuators off by 1 mm, drives by 0.5 %, tension varying by 1 %, another
    /// law of damping, two stray masses of 20 mg.
    pub fn unknown() -> Self {
        static TRUTH: LazyLock<Truth> = LazyLock::new(|| {
            let truth = Perturbation::default().truth(&papers_surface()).unwrap();
            let options = ResponseOptions { accuracy: 1e-4.into(), ..ResponseOptions::default() };
            let Ok(Responses::Modal(mut modal)) = responses(&truth.surface, &options) else { unreachable!() };
            for (a, gain) in truth.drive_gains.iter().enumerate() {
                modal.input.row_mut(a).iter_mut().for_each(|w| *w *= gain);
            }
            // Responses are said to be those of the actuators as told.
            for (port, actuator) in modal.ports.iter_mut().zip(&papers_surface().actuators) {
                port.at = actuator.at;
            }
            Truth { whole: Responses::Modal(modal.clone()), modal }
        });
        TRUTH.clone()
    }

    pub fn lambda(&self) -> f64 {
        self.modal.conditions.lambda_min
    }

    pub fn outline(&self) -> &Outline {
        &self.modal.conditions.outline
    }

    /// Responses at points as a measurement finds them.
    pub fn measured(&self, points: &[Point], samples: usize, errors: Errors, seed: u64) -> SampledResponses {
        let mut random = Random::seeded(seed);
        let aside = errors.position / 2f64.sqrt();
        let (low, high) = (0.2e-3, 149.8e-3);
        let displaced: Vec<Point> = points
            .iter()
            .map(|p| {
                let [x, y] = [p.x, p.y].map(|x| (x + aside * random.normal()).clamp(low, high));
                Point::new(x, y)
            })
            .collect();
        let clean = sample(&self.modal, &displaced, samples);
        let mut data = Vec::with_capacity(points.len() * clean.ports.len() * samples);
        let rows = (0..points.len()).flat_map(|p| (0..clean.ports.len()).map(move |a| (a, p)));
        let mut squares = 0.0;
        for (a, p) in rows {
            let gain = 1.0 + errors.gain * random.normal();
            squares += clean.response(a, p).iter().map(|h| f64::from(*h).powi(2)).sum::<f64>();
            data.extend(clean.response(a, p).iter().map(|h| (gain * f64::from(*h)) as f32));
        }
        let level = errors.noise * (squares / data.len() as f64).sqrt();
        data.iter_mut().for_each(|h| *h += (level * random.normal()) as f32);
        let conditions = clean.conditions.clone();
        SampledResponses::new(clean.ports.clone(), points.to_vec(), conditions, samples, data).unwrap()
    }

    /// Contrast of a drive that focuses at a place at the end of the window.
    pub fn contrast(&self, drive: &Drive, at: Point) -> f64 {
        let drive = drive.clone().as_emitted();
        let field = Field::new(&self.whole, &drive, 8.0).unwrap();
        let shot = &field.snapshots(&[WINDOW]).unwrap()[0];
        let peak = field.traces(&[at], WINDOW).unwrap()[0].velocity.last().copied().unwrap();
        let radius = 4.0 / 3.0 * self.lambda();
        let outside = field.points().iter().zip(&shot.velocity).filter(|(p, _)| p.distance(at) > radius);
        let squares: Vec<f64> = outside.map(|(_, v)| f64::from(*v).powi(2)).collect();
        peak.abs() / (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// Contrasts at places, of drives that are made from responses.
    pub fn contrasts(&self, known: &Responses, method: Method, places: &[Point]) -> Vec<f64> {
        let options = Options { method, window: WINDOW, ..Options::default() };
        let focuser = Focuser::new(known, &options).unwrap();
        let judge = |at: &Point| {
            let focused = focuser.focus(&[Target::at(*at)]).unwrap();
            assert_eq!(focused.points[0][0], *at);
            self.contrast(&focused.drive, *at)
        };
        places.iter().map(judge).collect()
    }
}

/// Wavenumber (rad/m) of the paper's film by the surface file, at an angular frequency (rad/s).
pub fn told() -> impl Fn(f64) -> f64 {
    let medium = Medium::of(&papers_surface().sheet);
    move |omega| medium.wavenumber(omega)
}

/// Centres of the cells of a square grid over the paper's surface, the pitch no more than asked for.
pub fn grid(pitch: f64) -> Vec<Point> {
    let count = (0.15 / pitch).ceil() as usize;
    let at = |i: usize| (i as f64 + 0.5) * 0.15 / count as f64;
    (0..count * count).map(|i| Point::new(at(i % count), at(i / count))).collect()
}

/// Places 20 mm or more from every edge.
pub fn targets(count: usize, seed: u64) -> Vec<Point> {
    let mut random = Random::seeded(seed);
    (0..count).map(|_| Point::new(0.02 + 0.11 * random.uniform(), 0.02 + 0.11 * random.uniform())).collect()
}

pub fn options(interpolation: Interpolation, errors: Errors) -> BetweenOptions {
    BetweenOptions {
        interpolation,
        noise: errors.noise,
        gain_error: errors.gain,
        position_error: errors.position,
        ..BetweenOptions::default()
    }
}

/// Interpolated responses at places and on a control grid of a pitch.
pub fn onto(between: &Between, places: &[Point], pitch: f64) -> Responses {
    let all: Vec<Point> = places.iter().copied().chain(grid(pitch)).collect();
    Responses::Sampled(between.onto(&all).unwrap())
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Relative rms error of responses against true ones.
pub fn off(found: &SampledResponses, truth: &SampledResponses) -> f64 {
    let (mut wrong, mut right) = (0.0, 0.0);
    for (p, a) in (0..truth.points.len()).flat_map(|p| (0..truth.ports.len()).map(move |a| (p, a))) {
        for (f, t) in found.response(a, p).iter().zip(truth.response(a, p)) {
            wrong += f64::from(f - t).powi(2);
            right += f64::from(*t).powi(2);
        }
    }
    (wrong / right).sqrt()
}
