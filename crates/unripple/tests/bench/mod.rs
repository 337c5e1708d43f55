//! The paper's surface, twenty seeded targets, and evaluation on modes to twice the band.

#![allow(dead_code)]

use unripple::core::{Drive, Point, Responses, Surface};
use unripple::field::{Aim, Field, Measured};
use unripple::focus::{Focuser, Method, Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};
use unripple_paper::study::Random;

pub const WINDOW: f64 = 0.030;

/// Responses from which drives are computed (`known`), and those on which they are evaluated (`plant`).
pub struct Bench {
    pub known: Responses,
    pub plant: Responses,
}

/// Velocity and contrast of a focus at one target, and energy of its drive.
#[derive(Clone, Copy, Debug)]
pub struct Focus {
    /// Velocity at the target at the focal instant, in m/s.
    pub peak: f64,
    pub contrast: f64,
    /// Energy of the drive, Σ∫d²dt.
    pub energy: f64,
}

impl Focus {
    /// Energy of this drive over that of another, both scaled to the same peak.
    pub fn cost(&self, other: &Self) -> f64 {
        self.energy / self.peak.powi(2) / (other.energy / other.peak.powi(2))
    }
}

pub fn modes_to(surface: &Surface, hz: f64) -> Responses {
    responses(surface, &ResponseOptions { max_hz: Some(hz), ..Default::default() }).unwrap()
}

impl Bench {
    pub fn of(surface: &Surface) -> Self {
        Self {
            known: responses(surface, &ResponseOptions::default()).unwrap(),
            plant: modes_to(surface, 6000.0),
        }
    }

    pub fn new() -> Self {
        Self::of(&papers_surface())
    }

    pub fn plan(&self, method: Method, options: Options) -> Focuser<'_> {
        Focuser::new(&self.known, &Options { method, window: WINDOW, ..options }).unwrap()
    }

    /// The focus of a drive at a target at the end of the window.
    pub fn focus(&self, drive: &Drive, at: Point) -> Focus {
        let drive = drive.clone().as_emitted();
        on(&self.plant, &drive, at, WINDOW)
    }

    /// The focus of the drive that a focuser computes for a target (m).
    pub fn judge(&self, plan: &Focuser, at: Point) -> Focus {
        self.focus(&plan.focus(&[Target::at(at)]).unwrap().drive, at)
    }

    pub fn figures(&self, plan: &Focuser, at: Point) -> Measured {
        let drive = plan.focus(&[Target::at(at)]).unwrap().drive.as_emitted();
        Field::new(&self.plant, &drive, 8.0).unwrap().measure(&[Aim::at(at, WINDOW)], None).unwrap()
    }
}

/// The focus at a target and an instant, from a snapshot of the field.
pub fn on(plant: &Responses, drive: &Drive, at: Point, instant: f64) -> Focus {
    let field = Field::new(plant, drive, 8.0).unwrap();
    let shot = &field.snapshots(&[instant]).unwrap()[0];
    let peak = field.traces(&[at], instant).unwrap()[0].velocity.last().copied().unwrap();
    let radius = 4.0 / 3.0 * plant.conditions().lambda_min;
    let outside = field.points().iter().zip(&shot.velocity).filter(|(p, _)| p.distance(at) > radius);
    let squares: Vec<f64> = outside.map(|(_, v)| f64::from(*v).powi(2)).collect();
    let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    Focus { peak, contrast: peak.abs() / rms, energy: drive.energy() }
}

/// The first `count` of a seeded sequence of targets, 20 mm or more from every edge.
pub fn targets(count: usize) -> Vec<Point> {
    let mut random = Random::seeded(2012);
    (0..count).map(|_| Point::new(random.between(0.02, 0.13), random.between(0.02, 0.13))).collect()
}

/// The first `count` targets, or twenty where `UNRIPPLE_ALL_TARGETS` is set: for tests that take long.
pub fn few(count: usize) -> Vec<Point> {
    targets(if std::env::var_os("UNRIPPLE_ALL_TARGETS").is_some() { 20 } else { count })
}

/// Mean, least and greatest of some values.
pub fn spread(values: &[f64]) -> [f64; 3] {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [mean, least, most]
}
