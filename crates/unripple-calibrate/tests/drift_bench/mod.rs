//! A focus repeated at 5 Hz on a virtual surface whose tension drifts: the model itself, or a true surface known by a fit alone.

#![allow(dead_code)]

#[path = "../fit_truth/mod.rs"]
pub mod fit_truth;

use fit_truth::{Faults, Truth};
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_calibrate::{Drift, FitOptions, Fitted, Hold, Ping, PingOptions, Tracker, Tracking, fit};
use unripple_core::{ModalResponses, Point, Responses, Shapes, Surface};
use unripple_focus::{Focuser, Method, Options, Target};
use unripple_linalg::Mat;
use unripple_physics::design::papers_surface;
use unripple_physics::stepper::{FaultySurface, InjectedFaults};
use unripple_physics::{Modes, ResponseOptions, StepperOptions, VirtualSurface, responses};

pub const WINDOW: f64 = 0.030;
pub const PERIOD: f64 = 0.2;
const BLOCK: usize = 240;
const RATE: f64 = 48e3;

/// Share of the drive's limit that the first drive, before any drift, leaves free.
pub const HEADROOM: f64 = 0.05;

/// What is done against the drift of tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Against {
    /// The true tension is known, without tracking.
    Knowledge,
    Dispersion,
    Stretch,
    Nothing,
}

/// The drive that is sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sent {
    Focus(Method),
    Ping,
}

/// The result of one focus.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub time: f64,
    /// Tension over that at calibration, at the focal instant.
    pub tension: f64,
    /// Tension by the tracker, before it observed this focus.
    pub known: f64,
    pub error: f64,
    pub peak: f64,
    pub contrast: f64,
    pub explained: bool,
    pub excess: f64,
}

/// A true surface, and its model.
pub struct Bench {
    pub surface: Surface,
    pub modes: Arc<Modes>,
    pub reference: ModalResponses,
    pub shares: Vec<f64>,
    sensors: Mat<f64>,
    /// Error of the model by the fit, as a share.
    pub model: f64,
    drive_gains: Vec<f64>,
    sense_gains: Vec<f64>,
    at: Point,
    /// True shapes at the target and outside its disc, points x modes.
    shapes: [Mat<f64>; 2],
    pub noise: f64,
    /// Largest change of tension either way, as a share, and number of cycles per minute.
    pub swing: [f64; 2],
}

impl Bench {
    /// The paper's surface, with itself as the model, and a signal-to-noise ratio of so many dB within the band.
    pub fn new(snr: f64) -> Self {
        let surface = papers_surface();
        let modes = Arc::new(Modes::solve(&surface, surface.emission.band[1], 1e-6).unwrap());
        let Ok(Responses::Modal(reference)) = responses(&surface, &ResponseOptions::default()) else {
            unreachable!()
        };
        let places: Vec<Point> = reference.ports.iter().map(|port| port.at).collect();
        let known = Known {
            sensors: reference.shapes.at_all(&places),
            shares: modes.bending_shares().to_vec(),
            model: 0.0,
            reference,
        };
        Self::of(surface, modes, [vec![1.0; 8], vec![1.0; 8]], known, snr)
    }

    /// A true surface whose model is a fit to the responses between its actuators alone.
    pub fn truth(top: f64, snr: f64) -> (Self, Fitted) {
        let mut truth = Truth::new(&Faults::default(), top);
        let measured = truth.pairs(0.25);
        let fitted = fit(&truth.nominal, &measured, &FitOptions::default()).unwrap();
        let known = Known {
            reference: fitted.modal().clone(),
            shares: fitted.bending_shares().to_vec(),
            sensors: fitted.sensors().clone(),
            model: fitted.unexplained(),
        };
        let gains = [truth.drive.clone(), truth.sense.clone()];
        (Self::of(truth.surface, truth.modes, gains, known, snr), fitted)
    }

    fn of(surface: Surface, modes: Arc<Modes>, gains: [Vec<f64>; 2], known: Known, snr: f64) -> Self {
        let at = Point::from_mm(62.0, 90.0);
        let Known { reference, shares, sensors, model } = known;
        let radius = 4.0 / 3.0 * reference.conditions.lambda_min;
        let grid =
            (0..30 * 30).map(|n| Point::from_mm(5.0 * (n % 30) as f64 + 2.5, 5.0 * (n / 30) as f64 + 2.5));
        let outside: Vec<Point> = grid.filter(|p| p.distance(at) > radius).collect();
        let shapes = [modes.at_all(&[at]), modes.at_all(&outside)];
        let [drive_gains, sense_gains] = gains;
        let mut bench = Self {
            surface,
            modes,
            reference,
            shares,
            sensors,
            model,
            drive_gains,
            sense_gains,
            at,
            shapes,
            noise: 0.0,
            swing: [0.05, 1.0],
        };
        let heard = bench.silent_run(Method::TimeReversal).1;
        let rms = (heard.iter().map(|x| x * x).sum::<f64>() / heard.len() as f64).sqrt();
        let top = bench.reference.conditions.band[1];
        bench.noise = rms * 10f64.powf(-snr / 20.0) * (0.5 * RATE / top).sqrt();
        bench
    }

    /// The last of a few foci without drift, and the sensors' signals over a period.
    pub fn silent_run(&self, method: Method) -> (Row, Vec<f64>) {
        let mut plant = self.plant(Vec::new(), 0.0);
        let drive = self.drive(&self.reference, method, &mut Hold::new(1.0, HEADROOM).unwrap());
        let mut last = None;
        for _ in 0..4 {
            last = Some(self.period(&mut plant, &drive));
        }
        let ((peak, contrast), heard) = last.unwrap();
        let (known, tension) = (1.0, 1.0);
        let row = Row { time: 0.0, tension, known, error: 0.0, peak, contrast, explained: true, excess: 0.0 };
        (row, heard.concat())
    }

    pub fn ping(&self) -> Ping {
        Ping::design(&self.reference, &PingOptions::default()).unwrap()
    }

    /// Periods for so many seconds from a start, under a tension ±5 % over a minute.
    pub fn run(&self, sent: Sent, against: Against, from: f64, seconds: f64) -> Vec<Row> {
        let [swing, pace] = self.swing;
        let tension = |t: f64| 1.0 + swing * (pace * TAU * t / 60.0).sin();
        let table =
            (0..=(seconds * 20.0) as usize + 2).map(|i| i as f64 / 20.0).map(|t| (t, tension(from + t)));
        let mut plant = self.plant(table.collect(), self.noise);
        let mut tracker = match (against, sent) {
            (Against::Dispersion | Against::Stretch, Sent::Focus(method)) => self.zeroed(against, method),
            _ => self.tracker(against),
        };
        let mut hold = Hold::new(1.0, HEADROOM).unwrap();
        // The level is that of the calibrated surface.
        if let Sent::Focus(method) = sent {
            self.drive(&self.reference, method, &mut hold);
        }
        let ping = self.ping();
        let mut rows = Vec::new();
        for n in 0..(seconds / PERIOD).round() as usize {
            let time = n as f64 * PERIOD;
            let expected = tracker.tension(WINDOW);
            let drive = match sent {
                Sent::Ping => ping.drive.clone(),
                Sent::Focus(method) => {
                    let known = match against {
                        Against::Nothing => self.reference.clone(),
                        Against::Knowledge => self.under(tension(from + time + 0.6 * WINDOW)),
                        _ => tracker.responses(0.6 * WINDOW),
                    };
                    self.drive(&known, method, &mut hold)
                }
            };
            let ((peak, contrast), heard) = self.period(&mut plant, &drive);
            let (explained, error, excess) = match against {
                Against::Nothing | Against::Knowledge => (true, 0.0, 0.0),
                _ => match tracker.observe(&drive, &heard).unwrap() {
                    Drift::Followed { error, excess, .. } => (true, error, excess),
                    Drift::Unexplained { excess, .. } => (false, f64::NAN, excess),
                },
            };
            let tension = tension(from + time + WINDOW);
            rows.push(Row { time, tension, known: expected, error, peak, contrast, explained, excess });
        }
        rows
    }

    fn tracker(&self, against: Against) -> Tracker {
        let even = self.shares.iter().sum::<f64>() / self.shares.len() as f64;
        let shares = match against {
            Against::Stretch => vec![even; self.shares.len()],
            _ => self.shares.clone(),
        };
        let limit = if against == Against::Dispersion { 3.0 } else { 1e9 };
        let options = Tracking { noise: self.noise, model: self.model, limit, ..Tracking::default() };
        Tracker::with_sensors(&self.reference, &shares, &self.sensors, &options).unwrap()
    }

    /// A tracker that has heard three foci on the surface as it was calibrated.
    fn zeroed(&self, against: Against, method: Method) -> Tracker {
        let fresh = self.tracker(against);
        let mut tracker = fresh.clone();
        let mut plant = self.plant(Vec::new(), self.noise);
        let drive = self.drive(&self.reference, method, &mut Hold::new(1.0, HEADROOM).unwrap());
        for _ in 0..3 {
            let heard = self.period(&mut plant, &drive).1;
            tracker.observe(&drive, &heard).unwrap();
        }
        fresh.with_zero(tracker.tension(0.0)).unwrap()
    }

    fn under(&self, ratio: f64) -> ModalResponses {
        let mut modal = self.reference.clone();
        for (pole, share) in modal.poles.iter_mut().zip(&self.shares) {
            pole.omega *= (1.0 + (ratio - 1.0) * (1.0 - share)).sqrt();
        }
        modal
    }

    fn plant(&self, tension: Vec<(f64, f64)>, noise: f64) -> FaultySurface {
        let surface =
            VirtualSurface::of(&self.surface, self.modes.clone(), &StepperOptions::default()).unwrap();
        FaultySurface::new(surface, InjectedFaults { tension, noise, ..InjectedFaults::default() }, BLOCK)
            .unwrap()
    }

    fn drive(&self, known: &ModalResponses, method: Method, hold: &mut Hold) -> Vec<Vec<f64>> {
        let options = Options { method, window: WINDOW, ..Options::default() };
        let responses = Responses::Modal(known.clone());
        let drive = Focuser::new(&responses, &options).unwrap().focus(&[Target::at(self.at)]).unwrap().drive;
        let mut channels = drive.channels().to_vec();
        hold.scale(known, self.at, (WINDOW * RATE) as usize, &mut channels).unwrap();
        channels
    }

    /// Peak and contrast at the focal instant, and what the sensors heard over the period.
    fn period(&self, plant: &mut FaultySurface, drive: &[Vec<f64>]) -> ((f64, f64), Vec<Vec<f64>>) {
        let samples = (PERIOD * RATE) as usize;
        let focal = (WINDOW * RATE) as usize + 1;
        let mut heard = vec![Vec::new(); 8];
        let (mut now, mut focus) = (0, (0.0, 0.0));
        while now < samples {
            let end = if now < focal { focal } else { samples };
            let frames = BLOCK.min(end - now);
            let sent = |(d, gain): (&Vec<f64>, &f64)| {
                (now..now + frames).map(|i| gain * d.get(i).copied().unwrap_or(0.0)).collect::<Vec<_>>()
            };
            let block: Vec<f64> = drive.iter().zip(&self.drive_gains).flat_map(sent).collect();
            let mut sensors = vec![0.0; 8 * frames];
            plant.process(frames, &block, &mut sensors, &mut []).unwrap();
            for ((heard, gain), sensor) in heard.iter_mut().zip(&self.sense_gains).zip(sensors.chunks(frames))
            {
                heard.extend(sensor.iter().map(|v| gain * v));
            }
            now += frames;
            if now == focal {
                let velocity = plant.surface().state().1;
                let read = |shapes: &Mat<f64>| -> Vec<f64> {
                    (0..shapes.nrows())
                        .map(|p| velocity.iter().enumerate().map(|(m, v)| shapes[(p, m)] * v).sum())
                        .collect()
                };
                let [peak, outside] = [&self.shapes[0], &self.shapes[1]].map(read);
                let rms = (outside.iter().map(|v| v * v).sum::<f64>() / outside.len() as f64).sqrt();
                focus = (peak[0], peak[0].abs() / rms);
            }
        }
        (focus, heard)
    }
}

/// What is known of a surface.
struct Known {
    reference: ModalResponses,
    shares: Vec<f64>,
    sensors: Mat<f64>,
    model: f64,
}
