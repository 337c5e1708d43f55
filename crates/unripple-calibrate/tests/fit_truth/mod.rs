//! A true surface that differs from its model, measurements on it, and the contrast that fitted responses reach.

#![allow(dead_code)]

use std::sync::Arc;
use unripple_calibrate::signals::Band;
use unripple_calibrate::{Measured, Tap};
use unripple_core::{
    Conditions, Decay, Drive, ModalResponses, Point, Port, Profile, Random, Responses, Scatterer,
    ScattererKind, Shapes, Surface,
};
use unripple_field::Field;
use unripple_focus::{Focuser, Method, Options, Target};
use unripple_linalg::Mat;
use unripple_physics::design::papers_surface;
use unripple_physics::{Medium, Modes, sample};

pub const WINDOW: f64 = 0.030;

/// Differences of the true surface from its model.
#[derive(Clone, Debug)]
pub struct Faults {
    /// Signal-to-noise ratio within the band, in dB.
    pub snr: f64,
    /// Standard deviation of the relative error of gains.
    pub gain: f64,
    /// Distance of each actuator from its stated place, in metres.
    pub place: f64,
    /// Largest variation of tension over the sheet, as a share.
    pub uneven: f64,
    /// Tension relative to nominal, a ratio.
    pub tension: f64,
    pub another_decay: bool,
    /// Stray masses, in kg.
    pub masses: Vec<(Point, f64)>,
}

impl Default for Faults {
    fn default() -> Self {
        Self {
            snr: 50.0,
            gain: 5e-3,
            place: 1e-3,
            uneven: 0.01,
            tension: 1.02,
            another_decay: true,
            masses: vec![(Point::from_mm(52.0, 97.0), 12e-6), (Point::from_mm(108.0, 61.0), 8e-6)],
        }
    }
}

#[derive(Debug)]
struct First {
    base: Arc<dyn Shapes>,
    count: usize,
}

impl Shapes for First {
    fn modes(&self) -> usize {
        self.count
    }
    fn at(&self, point: Point, row: &mut [f64]) {
        let mut all = vec![0.0; self.base.modes()];
        self.base.at(point, &mut all);
        row.copy_from_slice(&all[..self.count]);
    }
    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        self.base.at_all(points).subcols(0, self.count).to_owned()
    }
}

/// A true surface, its true responses and the errors of its channels.
pub struct Truth {
    pub nominal: Surface,
    pub surface: Surface,
    /// Modes of the true surface up to 1.4 times the band's top.
    pub modes: Arc<Modes>,
    /// Responses with the modes of the band.
    pub plant: Responses,
    /// Responses with the modes above the band too.
    pub whole: ModalResponses,
    pub drive: Vec<f64>,
    pub sense: Vec<f64>,
    snr: f64,
    random: Random,
}

impl Truth {
    pub fn new(faults: &Faults, top: f64) -> Self {
        let mut nominal = papers_surface();
        nominal.emission.band[1] = top;
        let mut random = Random::seeded(5);
        let mut surface = nominal.clone();
        surface.sheet.tension *= faults.tension;
        if faults.uneven > 0.0 {
            let rows: Vec<Vec<f64>> = (0..4)
                .map(|_| (0..4).map(|_| 1.0 + faults.uneven * random.between(-1.0, 1.0)).collect())
                .collect();
            surface.sheet.uneven.tension = Profile::new(&rows);
        }
        if faults.another_decay {
            surface.sheet.decay =
                Decay::Table(vec![(150.0, 0.09), (600.0, 0.078), (1500.0, 0.06), (3000.0, 0.045)]);
        }
        for (at, mass) in &faults.masses {
            surface.sheet.uneven.scatterers.push(Scatterer { at: *at, kind: ScattererKind::Mass(*mass) });
        }
        for actuator in &mut surface.actuators {
            let angle = random.between(0.0, std::f64::consts::TAU);
            actuator.at.x += faults.place * angle.cos();
            actuator.at.y += faults.place * angle.sin();
        }
        Self::of(nominal, surface, faults, random)
    }

    /// A true surface whose file is `nominal`; gains and noise are drawn.
    pub fn of(nominal: Surface, surface: Surface, faults: &Faults, mut random: Random) -> Self {
        let top = nominal.emission.band[1];
        let modes = Arc::new(Modes::solve(&surface, 1.4 * top, 1e-5).unwrap());
        let mut gains = || (0..8).map(|_| 1.0 + faults.gain * random.normal()).collect::<Vec<f64>>();
        let (drive, sense) = (gains(), gains());
        // The drive's gains are the plant's own.
        let mut modal = modal(&surface, &modes);
        for (a, gain) in drive.iter().enumerate() {
            modal.input.row_mut(a).iter_mut().for_each(|w| *w *= gain);
        }
        let whole = modal.clone();
        let count = modal.poles.partition_point(|pole| pole.omega <= std::f64::consts::TAU * top);
        modal.poles.truncate(count);
        modal.input = modal.input.subcols(0, count).to_owned();
        modal.shapes = Arc::new(First { base: modal.shapes, count });
        Self {
            nominal,
            surface,
            modes,
            plant: Responses::Modal(modal),
            whole,
            drive,
            sense,
            snr: faults.snr,
            random,
        }
    }

    fn noisy(&mut self, signals: &mut [Vec<f64>]) -> f64 {
        let count: usize = signals.iter().map(Vec::len).sum();
        let power = signals.iter().flatten().map(|x| x * x).sum::<f64>() / count as f64;
        let emission = &self.nominal.emission;
        let whole = (0.5 * emission.rate / emission.band[1]).sqrt();
        let noise = power.sqrt() * 10f64.powf(-self.snr / 20.0) * whole;
        signals.iter_mut().flatten().for_each(|x| *x += noise * self.random.normal());
        noise
    }

    /// Responses between all actuators, of so many seconds.
    pub fn pairs(&mut self, seconds: f64) -> Measured {
        let places: Vec<Point> = self.surface.actuators.iter().map(|a| a.at).collect();
        let rate = self.nominal.emission.rate;
        let sampled = sample(&self.whole, &places, (seconds * rate) as usize);
        let signal = |driven: usize, heard: usize| {
            sampled.response(driven, heard).iter().map(|v| f64::from(*v) * self.sense[heard]).collect()
        };
        let mut signals: Vec<Vec<f64>> = (0..64).map(|n| signal(n / 8, n % 8)).collect();
        let noise = self.noisy(&mut signals);
        Measured::pairs(rate, signals, noise)
    }

    /// These responses as a calibration measures them: limited to a band and cut off before time 0, of so many
    /// seconds.
    pub fn swept(&mut self, seconds: f64) -> Measured {
        let rate = self.nominal.emission.rate;
        let [from, to] = [60.0, 1.2 * self.nominal.emission.band[1]];
        let band = Band::within(from, to);
        let mut measured = self.pairs(seconds);
        let Some(pairs) = &mut measured.pairs else { panic!("they are there") };
        for response in &mut pairs.responses {
            let mut signal = vec![0.0; 64];
            signal.append(response);
            band.limit(&mut signal, rate).unwrap();
            *response = signal.split_off(64);
        }
        measured.limited_to(band)
    }

    /// Taps of unknown shape and strength, recorded by all actuators.
    pub fn taps(&mut self, places: &[Point], seconds: f64) -> Measured {
        let rate = self.nominal.emission.rate;
        let sampled = sample(&self.whole, places, (seconds * rate) as usize);
        let mut taps = Vec::new();
        for (p, at) in places.iter().enumerate() {
            let (width, strength) = (self.random.between(4e-5, 9e-5), self.random.between(0.2, 2.0));
            let length = (4.0 * width * rate).ceil() as usize + 3;
            let pulse: Vec<f64> = (0..length)
                .map(|i| {
                    let x = (i as f64 / rate - 2.0 * width) / width;
                    strength * (-x * x).exp() * (1.0 + 0.3 * x)
                })
                .collect();
            let mut heard: Vec<Vec<f64>> = (0..8)
                .map(|a| {
                    // By reciprocity; the actuator's own drive gain taken out again.
                    let h: Vec<f64> = sampled.response(a, p).iter().map(|v| f64::from(*v)).collect();
                    let gain = self.sense[a] / self.drive[a];
                    (0..h.len())
                        .map(|i| (0..=i.min(length - 1)).map(|j| gain * h[i - j] * pulse[j]).sum())
                        .collect()
                })
                .collect();
            let noise = self.noisy(&mut heard);
            taps.push(Tap { at: *at, heard, noise });
        }
        Measured::taps(rate, taps)
    }

    /// Mean contrast that drives made from some responses have on the true plant.
    pub fn contrast(&self, known: &Responses, method: Method, targets: &[Point]) -> f64 {
        let options = Options { method, window: WINDOW, ..Options::default() };
        let plan = Focuser::new(known, &options).unwrap();
        let each = targets.iter().map(|at| {
            let drive = plan.focus(&[Target::at(*at)]).unwrap().drive.as_emitted();
            contrast(&self.plant, &drive, *at)
        });
        each.sum::<f64>() / targets.len() as f64
    }

    /// Contrast of time reversal and of the inverse by fitted responses, as shares of those by the true ones.
    pub fn shares(&self, fitted: &Responses, targets: &[Point]) -> [f64; 2] {
        [Method::TimeReversal, Method::Inverse].map(|method| {
            self.contrast(fitted, method, targets) / self.contrast(&self.plant, method, targets)
        })
    }
}

/// Responses by all of some modes.
fn modal(surface: &Surface, modes: &Arc<Modes>) -> ModalResponses {
    let places: Vec<Point> = surface.actuators.iter().map(|a| a.at).collect();
    ModalResponses {
        ports: (surface.actuators.iter()).map(|a| Port { name: a.name.clone(), at: a.at }).collect(),
        poles: modes.poles().to_vec(),
        input: modes.at_all(&places),
        shapes: modes.clone(),
        conditions: Conditions {
            rate: surface.emission.rate,
            band: surface.emission.band,
            lambda_min: Medium::of(&surface.sheet).lambda_min(surface.emission.band[1]),
            outline: surface.outline.clone(),
        },
        frequency_error: 0.0,
        mode_errors: Vec::new(),
    }
}

/// Contrast: peak relative to the rms outside the focal disc, at the end of the window.
pub fn contrast(plant: &Responses, drive: &Drive, at: Point) -> f64 {
    let field = Field::new(plant, drive, 8.0).unwrap();
    let shot = &field.snapshots(&[WINDOW]).unwrap()[0];
    let peak = field.traces(&[at], WINDOW).unwrap()[0].velocity.last().copied().unwrap();
    let radius = 4.0 / 3.0 * plant.conditions().lambda_min;
    let outside = field.points().iter().zip(&shot.velocity).filter(|(p, _)| p.distance(at) > radius);
    let squares: Vec<f64> = outside.map(|(_, v)| f64::from(*v).powi(2)).collect();
    peak.abs() / (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Targets 20 mm or more from every edge.
pub fn targets(count: usize) -> Vec<Point> {
    let mut random = Random::seeded(2012);
    (0..count).map(|_| Point::new(random.between(0.02, 0.13), random.between(0.02, 0.13))).collect()
}
