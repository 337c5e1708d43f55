//! A virtual calibration of any surface, from its wires to the contrast of a focus on the true surface.

#![allow(dead_code)]

#[path = "../contrast/mod.rs"]
mod contrast;

use contrast::contrast;
use std::sync::Arc;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Listen, MeasureOptions, Rig, Session, Wires};
use unripple_calibrate::signals::Reciprocity;
use unripple_core::{
    Actuator, ActuatorKind, CoilDrive, Decay, Device, Edge, Edges, Emission, ModalResponses, Outline, Patch,
    Point, Responses, SampledResponses, Shape, Surface,
};
use unripple_devices::{
    Expected, Handle, Perturbation, Truth, Virtual, VirtualOptions, WiringOptions, check_wiring,
};
use unripple_focus::Method;
use unripple_physics::design::papers_surface;
use unripple_physics::{ResponseOptions, responses, sensors};

/// The result of a calibration.
#[derive(Clone, Debug)]
pub struct Found {
    /// Faults that the wiring test found.
    pub faults: Vec<String>,
    /// Latency and its uncertainty, in samples.
    pub latency: [f64; 2],
    /// Difference of the responses between a and b in both directions, as a share.
    pub reciprocity: f64,
    /// Contrast on the true surface of time reversal by the measured responses, relative to that by the true responses.
    pub share: f64,
    /// Contrast of the true responses.
    pub contrast: f64,
}

/// The paper's film up to a frequency (Hz), with actuators of some kind.
pub fn film(top: f64, kind: impl Fn(usize) -> ActuatorKind) -> Surface {
    let mut film = papers_surface();
    film.sheet.strength = None;
    film.emission = Emission { band: [0.0, top], ..film.emission };
    film.actuators.iter_mut().enumerate().for_each(|(i, actuator)| actuator.kind = kind(i));
    film
}

/// A coil of 6.2 Ω.
pub fn coil(force_constant: f64, inductance: f64, moving_mass: f64, driven_by: CoilDrive) -> ActuatorKind {
    ActuatorKind::MovingMagnet { force_constant, resistance: 6.2, inductance, moving_mass, driven_by }
}

/// An exciter for a film: a housing of 2 g that resonates at 40 Hz, below the film's modes, on a coil of 7 mg.
pub fn exciter(driven_by: CoilDrive, quality_factor: f64) -> ActuatorKind {
    ActuatorKind::Exciter {
        force_constant: 0.5,
        resistance: 6.2,
        inductance: 0.13e-3,
        moving_mass: 7e-6,
        housing_mass: 2e-3,
        resonance: 40.0,
        quality_factor,
        driven_by,
    }
}

/// A supported pane of glass, with round patches.
pub fn glass(top: f64, mass: f64) -> Surface {
    let mut glass = papers_surface();
    let sheet = &mut glass.sheet;
    (sheet.young, sheet.density, sheet.poisson) = (69e9, 2500.0, 0.22);
    (sheet.thickness, sheet.tension, sheet.decay) = (0.7e-3, 0.0, Decay::Time(0.03));
    sheet.strength = None;
    glass.outline =
        Outline::new(Shape::Rectangle { width: 0.16, height: 0.1 }).with_edges(Edges::All(Edge::Supported));
    glass.emission = Emission { band: [0.0, top], ..glass.emission };
    let places = [(22.0, 18.0), (71.0, 14.0), (131.0, 25.0), (143.0, 66.0), (104.0, 84.0), (35.0, 79.0)];
    let patch = ActuatorKind::Piezo { patch: Patch::Round { radius: 6e-3 }, moment: 0.02, mass };
    let actuator = |(i, (x, y)): (usize, &(f64, f64))| Actuator {
        name: format!("p{}", i + 1),
        at: Point::from_mm(*x, *y),
        kind: patch,
        contact_radius: 0.0,
    };
    glass.actuators = places.iter().enumerate().map(actuator).collect();
    glass
}

/// A table of 1.2 x 0.8 m of fibreboard, held at its rim, with exciters driven by a current.
pub fn table(exciters: usize) -> Surface {
    let mut table = papers_surface();
    let sheet = &mut table.sheet;
    (sheet.young, sheet.density, sheet.poisson) = (4e9, 750.0, 0.3);
    (sheet.thickness, sheet.tension, sheet.decay) = (10e-3, 0.0, Decay::LossFactor(0.02));
    sheet.strength = None;
    table.outline =
        Outline::new(Shape::Rectangle { width: 1.2, height: 0.8 }).with_edges(Edges::All(Edge::Supported));
    table.emission = Emission { band: [0.0, 2000.0], ..table.emission };
    let around = |i: usize| {
        let angle = std::f64::consts::TAU * (i as f64 + 0.3 * (2.4 * i as f64).sin()) / exciters as f64;
        Point::new(0.6 + 0.45 * angle.cos(), 0.4 + 0.28 * angle.sin())
    };
    let actuator = |i: usize| Actuator {
        name: format!("e{}", i + 1),
        at: around(i),
        kind: coil(4.0, 0.3e-3, 2e-3, CoilDrive::Current),
        contact_radius: 0.0125,
    };
    table.actuators = (0..exciters).map(actuator).collect();
    table
}

/// Moves the probe; the surface begins anew before each recording.
struct Hands {
    device: Virtual,
    handle: Handle,
}

impl Rig for Hands {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.device
    }

    fn ready(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError> {
        self.handle.rest(number as u64 * 100 + attempt);
        self.handle.move_probe(at).map_err(|error| CalibrateError::Rig { number, why: error.to_string() })
    }

    fn tap(&mut self, number: usize, _: Point, _: u64) -> Result<(), CalibrateError> {
        Err(CalibrateError::Rig { number, why: "nobody taps".into() })
    }
}

pub fn modal(surface: &Surface, max_hz: Option<f64>, accuracy: f64) -> ModalResponses {
    match responses(surface, &ResponseOptions { max_hz, accuracy: accuracy.into(), ..Default::default() }) {
        Ok(Responses::Modal(modal)) => modal,
        other => panic!("{other:?}"),
    }
}

/// Measures the responses at a target of a surface as `calibrate` does, and focuses there with them.
pub fn calibrate(
    surface: &Surface,
    unknowns: Option<&Perturbation>,
    settings: &MeasureOptions,
    target: Point,
    window: f64,
) -> Found {
    let accuracy = if unknowns.is_some() { Truth::ACCURACY } else { 1e-6 };
    let model = modal(surface, None, accuracy);
    let options =
        VirtualOptions { accuracy: accuracy.into(), ..VirtualOptions::to_be_measured(surface).unwrap() };
    let truth = unknowns.map(|unknowns| unknowns.truth(surface).unwrap());
    let device = match &truth {
        Some(truth) => Virtual::of_truth(truth, &options).unwrap(),
        None => Virtual::new(surface, &options).unwrap(),
    };
    let handle = device.handle();
    let mut rig = Hands { device, handle };

    let (width, height) = surface.outline.extent();
    let middle = Point::new(width / 2.0, height / 2.0);
    rig.ready(1, middle, 0).unwrap();
    let trial = WiringOptions::for_surface(surface);
    let expected = Expected::of(surface, &model, Some(middle), trial.listen).unwrap();
    let faults = check_wiring(&mut rig.device, &expected, &trial).unwrap().faults();

    let (latency, session) = in_time(&mut rig, surface, settings, &model, middle);
    let sensors = session.measure(&mut rig, 1, middle, 2, Listen::Sensors).unwrap();
    let count = sensors.len();
    let flat: Vec<f64> = (0..count)
        .flat_map(|drive| sensors.iter().flat_map(move |heard| heard.responses[drive].iter().copied()))
        .collect();
    let reciprocity = Reciprocity::of(&flat, count).unwrap().error;

    let channel = session.measure(&mut rig, 0, target, 0, Listen::Probe).unwrap().remove(0);
    let data = channel.responses.iter().flatten().map(|h| *h as f32).collect();
    let samples = channel.responses[0].len();
    let measured =
        SampledResponses::new(model.ports.clone(), vec![target], model.conditions.clone(), samples, data);
    let twice = (2.0 * surface.emission.band[1]).min(0.45 * surface.emission.rate);
    let there = truth.as_ref().map_or(surface, |truth| &truth.surface);
    let mut plant = modal(there, Some(twice), accuracy);
    for (a, gain) in truth.iter().flat_map(|truth| truth.drive_gains.iter().enumerate()) {
        (0..plant.poles.len()).for_each(|m| plant.input[(a, m)] *= gain);
    }
    let plant = Responses::Modal(plant);
    let of = |known: Responses| contrast(&known, &plant, Method::TimeReversal, target, window);
    let contrast = of(Responses::Modal(modal_of(&plant, surface)));
    let share = of(Responses::Sampled(measured.unwrap())) / contrast;
    Found { faults, latency, reciprocity, share, contrast }
}

/// A session that knows the latency, and the latency.
fn in_time(
    rig: &mut Hands,
    surface: &Surface,
    settings: &MeasureOptions,
    model: &ModalResponses,
    at: Point,
) -> ([f64; 2], Session) {
    let layout = rig.device.layout().clone();
    let wires = Wires::by_name(&model.ports, &layout, &[]).unwrap();
    let first = Session::new(surface, &layout, wires.clone(), settings).unwrap();
    let latency = first.find_latency(rig, 1, at, model).unwrap().unwrap();
    let settings = MeasureOptions { latency: latency[0], ..settings.clone() };
    (latency, Session::new(surface, &layout, wires, &settings).unwrap())
}

/// Difference between the velocity under an actuator's contact by its own sensor and by a probe at the same place, as a share: for the
/// response to the actuator's own drive, and the largest for those to the others'.
pub fn at_an_actuator(surface: &Surface, actuator: usize) -> [f64; 2] {
    let (settings, model) = (MeasureOptions::default(), modal(surface, None, 1e-6));
    let device = Virtual::new(surface, &VirtualOptions::to_be_measured(surface).unwrap()).unwrap();
    let handle = device.handle();
    let mut rig = Hands { device, handle };
    let at = surface.actuators[actuator].at;
    let (_, session) = in_time(&mut rig, surface, &settings, &model, at);
    let heard = session.measure(&mut rig, 1, at, 2, Listen::Sensors).unwrap().swap_remove(actuator);
    let probed = session.measure(&mut rig, 0, at, 0, Listen::Probe).unwrap().remove(0);
    let [_, top] = settings.swept(surface);
    let sensor = &sensors(surface).unwrap()[actuator];
    let told = sensor.velocities(&heard.responses, surface.emission.rate, top).unwrap();
    let apart = |drive: usize| {
        let power =
            |one: &[f64], other: &[f64]| -> f64 { one.iter().zip(other).map(|(x, y)| (x - y).powi(2)).sum() };
        let (told, probed) = (&told[drive], &probed.responses[drive]);
        (power(told, probed) / power(probed, &vec![0.0; probed.len()])).sqrt()
    };
    let others = (0..told.len()).filter(|drive| *drive != actuator);
    [apart(actuator), others.map(apart).fold(0.0, f64::max)]
}

/// The part of true responses that lies in the band.
fn modal_of(plant: &Responses, surface: &Surface) -> ModalResponses {
    let Responses::Modal(plant) = plant else { panic!() };
    let top = std::f64::consts::TAU * surface.emission.band[1];
    let kept: Vec<usize> = (0..plant.poles.len()).filter(|m| plant.poles[*m].omega <= top).collect();
    let input =
        unripple_linalg::Mat::from_fn(plant.ports.len(), kept.len(), |a, m| plant.input[(a, kept[m])]);
    ModalResponses {
        ports: plant.ports.clone(),
        poles: kept.iter().map(|m| plant.poles[*m]).collect(),
        input,
        shapes: Arc::new(Kept { shapes: plant.shapes.clone(), kept }),
        conditions: plant.conditions.clone(),
        frequency_error: plant.frequency_error,
        mode_errors: Vec::new(),
    }
}

#[derive(Debug)]
struct Kept {
    shapes: Arc<dyn unripple_core::Shapes>,
    kept: Vec<usize>,
}

impl unripple_core::Shapes for Kept {
    fn modes(&self) -> usize {
        self.kept.len()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let mut all = vec![0.0; self.shapes.modes()];
        self.shapes.at(point, &mut all);
        row.iter_mut().zip(&self.kept).for_each(|(to, m)| *to = all[*m]);
    }
}
