//! A true surface that differs from the paper's, as a virtual device, with its model.

#![allow(dead_code)]

#[path = "../contrast/mod.rs"]
mod contrast;

use std::sync::{Arc, LazyLock};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Listen, MeasureOptions, Rig, SILENCE, Session, Wires};
use unripple_core::{Device, ModalResponses, Point, Port, Responses, SampledResponses, Surface};
use unripple_devices::{Handle, Perturbation, Tap, Truth, Virtual, VirtualOptions};
use unripple_focus::Method;
use unripple_physics::design::papers_surface;
use unripple_physics::{Modes, ResponseOptions, responses};

pub const WINDOW: f64 = 0.030;

/// The surface file with its model, and the true surface with its modes.
pub struct World {
    pub surface: Surface,
    pub model: ModalResponses,
    pub truth: Truth,
    pub modes: Arc<Modes>,
    /// The true responses, the drive's gains included.
    pub plant: Responses,
}

pub static WORLD: LazyLock<World> = LazyLock::new(|| World::new(&Perturbation::default()));

impl World {
    /// The paper's film with unknowns.
    pub fn new(unknowns: &Perturbation) -> Self {
        let surface = papers_surface();
        let truth = unknowns.truth(&surface).unwrap();
        let modal = |surface: &Surface| match responses(
            surface,
            &ResponseOptions { accuracy: 1e-4.into(), ..Default::default() },
        ) {
            Ok(Responses::Modal(modal)) => modal,
            other => panic!("{other:?}"),
        };
        let modes = truth.modes(None).unwrap();
        let mut plant = modal(&truth.surface);
        for (a, gain) in truth.drive_gains.iter().enumerate() {
            (0..plant.poles.len()).for_each(|m| plant.input[(a, m)] *= gain);
        }
        Self { model: modal(&surface), surface, truth, modes, plant: Responses::Modal(plant) }
    }

    pub fn ports(&self) -> Vec<Port> {
        self.model.ports.clone()
    }

    pub fn device(&self) -> Virtual {
        self.device_with(&VirtualOptions::default())
    }

    pub fn device_with(&self, options: &VirtualOptions) -> Virtual {
        Virtual::of_truth_with_modes(&self.truth, self.modes.clone(), options).unwrap()
    }

    pub fn session(&self, device: &dyn Device, options: &MeasureOptions) -> Session {
        let wires = Wires::by_name(&self.ports(), device.layout(), &[]).unwrap();
        Session::new(&self.surface, device.layout(), wires, options).unwrap()
    }

    /// Responses that a probe measures at some points.
    pub fn probed(&self, rig: &mut dyn Rig, session: &Session, points: &[Point]) -> SampledResponses {
        let channels = points
            .iter()
            .enumerate()
            .map(|(i, at)| session.measure(rig, i, *at, 0, Listen::Probe).unwrap().remove(0));
        self.sampled(points, &channels.collect::<Vec<_>>())
    }

    pub fn sampled(&self, points: &[Point], channels: &[Channel]) -> SampledResponses {
        let data = channels.iter().flat_map(|c| c.responses.iter().flatten().map(|h| *h as f32));
        let samples = channels[0].responses[0].len();
        let conditions = self.model.conditions.clone();
        SampledResponses::new(self.ports(), points.to_vec(), conditions, samples, data.collect()).unwrap()
    }

    /// Contrast on the true surface of a focus made from some responses.
    pub fn contrast(&self, known: &Responses, method: Method, at: Point) -> f64 {
        contrast::contrast(known, &self.plant, method, at, WINDOW)
    }

    /// Contrast of a focus made from known responses, relative to that from the true responses, both by time
    /// reversal.
    pub fn share(&self, known: &SampledResponses, at: Point) -> f64 {
        let known = Responses::Sampled(known.clone());
        self.contrast(&known, Method::TimeReversal, at) / self.contrast(&self.plant, Method::TimeReversal, at)
    }
}

/// A rig that moves the probe of a virtual surface and taps it, for any device that leads to it.
pub struct Hands<D> {
    pub device: D,
    pub handle: Handle,
    pub rate: f64,
    /// Whether the surface is reset before each recording.
    pub rest: bool,
}

impl<D: Device> Hands<D> {
    pub fn new(device: D, handle: Handle) -> Self {
        let rate = device.layout().rate;
        Self { device, handle, rate, rest: true }
    }
}

impl<D: Device> Rig for Hands<D> {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.device
    }

    fn ready(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError> {
        if self.rest {
            self.handle.rest(number as u64 * 100 + attempt);
        }
        self.handle.move_probe(at).map_err(|error| CalibrateError::Rig { number, why: error.to_string() })
    }

    fn tap(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError> {
        let tap = Tap::random(number as u64 * 10 + attempt, self.rate);
        self.handle
            .tap(&tap, at, (SILENCE * 128) as f64 / self.rate + 0.02)
            .map_err(|error| CalibrateError::Rig { number, why: error.to_string() })
    }
}
