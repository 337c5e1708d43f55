//! A focus repeated at 5 Hz on a virtual surface whose tension drifts.

#![allow(dead_code)]

use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_calibrate::{Drift, Tracker, Tracking};
use unripple_core::{ModalResponses, Point, Responses, Surface};
use unripple_focus::{Focuser, Method, Options, Target};
use unripple_physics::design::papers_surface;
use unripple_physics::stepper::{Misbehaving, Mishaps};
use unripple_physics::{Modes, ResponseOptions, StepperOptions, VirtualSurface, responses};

pub const WINDOW: f64 = 0.030;
pub const PERIOD: f64 = 0.2;
const BLOCK: usize = 240;

/// What is done about the drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Against {
    /// The tension is known without looking.
    Knowledge,
    Dispersion,
    Stretch,
    Nothing,
}

/// One focus.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub time: f64,
    /// Tension over nominal at the focal instant.
    pub tension: f64,
    /// As the tracker had it, before it heard of this focus.
    pub known: f64,
    pub error: f64,
    pub peak: f64,
    pub contrast: f64,
    pub explained: bool,
}

/// The paper's surface as it really is and as it is known.
pub struct Bench {
    pub surface: Surface,
    pub modes: Arc<Modes>,
    pub reference: ModalResponses,
    pub shares: Vec<f64>,
    at: Point,
    outside: Vec<Point>,
    pub noise: f64,
}

impl Bench {
    /// With so many dB of signal to noise within the band.
    pub fn new(snr: f64) -> Self {
        let surface = papers_surface();
        let modes = Arc::new(Modes::solve(&surface, surface.emission.band[1], 1e-6).unwrap());
        let Ok(Responses::Modal(reference)) = responses(&surface, &ResponseOptions::default()) else {
            unreachable!()
        };
        let shares = modes.bending_shares().to_vec();
        let at = Point::from_mm(62.0, 90.0);
        let radius = 4.0 / 3.0 * reference.conditions.lambda_min;
        let grid =
            (0..50 * 50).map(|n| Point::from_mm(3.0 * (n % 50) as f64 + 1.5, 3.0 * (n / 50) as f64 + 1.5));
        let outside = grid.filter(|p| p.distance(at) > radius).collect();
        let mut bench = Self { surface, modes, reference, shares, at, outside, noise: 0.0 };
        let heard = bench.silent_run(Method::TimeReversal).1;
        let rms = (heard.iter().map(|x| x * x).sum::<f64>() / heard.len() as f64).sqrt();
        bench.noise = rms * 10f64.powf(-snr / 20.0) * (0.5 * 48e3 / 3e3f64).sqrt();
        bench
    }

    /// The undrifted focus, the last of a few, and what the sensors hear over a period.
    pub fn silent_run(&self, method: Method) -> (Row, Vec<f64>) {
        let mut plant = self.plant(Vec::new(), 0.0);
        let drive = self.drive(&self.reference, method);
        let mut last = None;
        for _ in 0..4 {
            last = Some(self.period(&mut plant, &drive));
        }
        let ((peak, contrast), heard) = last.unwrap();
        let row = Row { time: 0.0, tension: 1.0, known: 1.0, error: 0.0, peak, contrast, explained: true };
        (row, heard.concat())
    }

    /// Foci for so many seconds from a start, under a tension ±5 % over a minute.
    pub fn run(&self, method: Method, against: Against, from: f64, seconds: f64) -> Vec<Row> {
        let tension = |t: f64| 1.0 + 0.05 * (TAU * t / 60.0).sin();
        let table =
            (0..=(seconds * 20.0) as usize + 2).map(|i| i as f64 / 20.0).map(|t| (t, tension(from + t)));
        let mut plant = self.plant(table.collect(), self.noise);
        let even = self.shares.iter().sum::<f64>() / self.shares.len() as f64;
        let shares = match against {
            Against::Stretch => vec![even; self.shares.len()],
            _ => self.shares.clone(),
        };
        let limit = if against == Against::Dispersion { 3.0 } else { 1e9 };
        let options = Tracking { noise: self.noise, limit, ..Tracking::default() };
        let mut tracker = Tracker::new(&self.reference, &shares, &options).unwrap();
        let mut rows = Vec::new();
        for n in 0..(seconds / PERIOD) as usize {
            let time = n as f64 * PERIOD;
            let known = match against {
                Against::Nothing => self.reference.clone(),
                Against::Knowledge => self.under(tension(from + time + 0.6 * WINDOW)),
                _ => tracker.responses(0.6 * WINDOW),
            };
            let expected = tracker.tension(WINDOW);
            let drive = self.drive(&known, method);
            let ((peak, contrast), heard) = self.period(&mut plant, &drive);
            let (explained, error) = match against {
                Against::Nothing | Against::Knowledge => (true, 0.0),
                _ => match tracker.observe(&drive, &heard).unwrap() {
                    Drift::Followed { error, .. } => (true, error),
                    Drift::Unexplained { .. } => (false, f64::NAN),
                },
            };
            let tension = tension(from + time + WINDOW);
            rows.push(Row { time, tension, known: expected, error, peak, contrast, explained });
        }
        rows
    }

    fn under(&self, ratio: f64) -> ModalResponses {
        let mut modal = self.reference.clone();
        for (pole, share) in modal.poles.iter_mut().zip(&self.shares) {
            pole.omega *= (1.0 + (ratio - 1.0) * (1.0 - share)).sqrt();
        }
        modal
    }

    fn plant(&self, tension: Vec<(f64, f64)>, noise: f64) -> Misbehaving {
        let surface =
            VirtualSurface::of(&self.surface, self.modes.clone(), &StepperOptions::default()).unwrap();
        Misbehaving::new(surface, Mishaps { tension, noise, ..Mishaps::default() }, BLOCK).unwrap()
    }

    fn drive(&self, known: &ModalResponses, method: Method) -> Vec<Vec<f64>> {
        let options = Options { method, window: WINDOW, ..Options::default() };
        let known = Responses::Modal(known.clone());
        let drive = Focuser::new(&known, &options).unwrap().focus(&[Target::at(self.at)]).unwrap().drive;
        drive.channels().to_vec()
    }

    /// Peak and contrast at the focal instant, and what the sensors heard over the period.
    fn period(&self, plant: &mut Misbehaving, drive: &[Vec<f64>]) -> ((f64, f64), Vec<Vec<f64>>) {
        let samples = (PERIOD * 48e3) as usize;
        let focal = (WINDOW * 48e3) as usize + 1;
        let mut heard = vec![Vec::new(); 8];
        let (mut now, mut focus) = (0, (0.0, 0.0));
        while now < samples {
            let end = if now < focal { focal } else { samples };
            let frames = BLOCK.min(end - now);
            let block: Vec<f64> = drive
                .iter()
                .flat_map(|d| (now..now + frames).map(|i| d.get(i).copied().unwrap_or(0.0)))
                .collect();
            let mut sensors = vec![0.0; 8 * frames];
            plant.process(frames, &block, &mut sensors, &mut []).unwrap();
            heard.iter_mut().zip(sensors.chunks(frames)).for_each(|(h, s)| h.extend_from_slice(s));
            now += frames;
            if now == focal {
                let peak = plant.surface().snapshot(&[self.at]).velocity[0];
                let outside = plant.surface().snapshot(&self.outside).velocity;
                let rms = (outside.iter().map(|v| v * v).sum::<f64>() / outside.len() as f64).sqrt();
                focus = (peak, peak.abs() / rms);
            }
        }
        (focus, heard)
    }
}
