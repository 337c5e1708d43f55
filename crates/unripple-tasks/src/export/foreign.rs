//! Libraries in files of other programs: universal files and MATLAB files.

use crate::source::described;
use crate::{TaskError, judge};
use std::io;
use std::path::Path;
use unripple::core::{Onset, Point, Port, Responses, SampledResponses};
use unripple::dsp::FourierPlanner;
use unripple_exchange::{
    Array, Arrays, Axis, Dof, Function, Mode, Node, Uff, UffUnits, write_mat, write_uff,
};
use unripple_store::{Committed, Library, StoreError, write_durably};

/// Most letters of a name in a universal file.
const LETTERS: usize = 10;

/// Numbers of quantities and of kinds of functions in universal files.
const DISPLACEMENT: i64 = 8;
const VELOCITY: i64 = 11;
const FORCE: i64 = 13;
const FREQUENCY: i64 = 18;
const FREQUENCY_RESPONSE: i64 = 4;

/// The direction normal to the sheet, z.
const NORMAL: i64 = 3;

/// Writes all finished points as frequency responses (dataset 58), with nodes and SI units.
pub(super) fn uff(library: &Library, path: &Path) -> Result<Committed, TaskError> {
    let responses = library.responses()?;
    let actuators = named(library)?;
    vacant(path)?;
    let (points, units) = (responses.points.len(), &library.plan().drive_units);
    let nodes = nodes(&responses.points, &responses.ports);
    let mut spectrum = Spectrum::new(&responses);
    write_durably(path, |out| {
        let write =
            |out: &mut dyn io::Write, part: &Uff| out.write_all(&write_uff(part).map_err(io::Error::other)?);
        write(out, &Uff { units: Some(si()), nodes, ..Uff::default() })?;
        for point in 0..points {
            for (actuator, name) in actuators.iter().enumerate() {
                let reference = Dof { name: name.clone(), node: label(points + actuator), direction: NORMAL };
                let response = Dof { name: String::new(), node: label(point), direction: NORMAL };
                let values = spectrum.of(responses.response(actuator, point))?;
                let function = Function {
                    title: format!("point {} per {name}", point + 1),
                    kind: FREQUENCY_RESPONSE,
                    response,
                    reference,
                    step: spectrum.step,
                    abscissa: axis(FREQUENCY, "Frequency", "Hz"),
                    numerator: axis(VELOCITY, "Velocity", "m/s"),
                    denominator: reference_axis(&units[actuator]),
                    complex: true,
                    values,
                    ..Function::default()
                };
                write(out, &Uff { functions: vec![function], ..Uff::default() })?;
            }
        }
        Ok(())
    })?;
    Ok(Committed { path: path.into(), replaced: false })
}

/// Writes the modes of the surface that a library describes, at its points and actuators (dataset 55).
pub(super) fn modes(library: &Library, path: &Path) -> Result<Committed, TaskError> {
    let surface = described(library)?;
    let Responses::Modal(modal) = judge::model(&surface, None, &[])? else {
        return Err(TaskError::Work("expected a model with modes, found samples".into()));
    };
    if modal.poles.iter().any(|pole| pole.onset != Onset::Velocity || pole.sigma >= pole.omega) {
        let expected = "modes that oscillate and that damping does not couple, as dataset 55 has them";
        return Err(TaskError::Input(format!(
            "{}: expected {expected}, found others",
            library.path().display()
        )));
    }
    vacant(path)?;
    let points: Vec<Point> = library.done().into_iter().map(|point| library.points()[point]).collect();
    let places: Vec<Point> = points.iter().copied().chain(modal.ports.iter().map(|port| port.at)).collect();
    let shapes = modal.shapes.at_all(&places);
    let modes = modal.poles.iter().enumerate().map(|(m, pole)| {
        let damped = (pole.omega * pole.omega - pole.sigma * pole.sigma).sqrt();
        let at = |node: usize| (label(node), vec![[0.0; 2], [0.0; 2], [shapes[(node, m)], 0.0]]);
        Mode {
            number: label(m),
            quantity: DISPLACEMENT,
            eigenvalue: [-pole.sigma, damped],
            // Shapes are normalised by mass.
            scale: [1.0, 0.0],
            shape: (0..places.len()).map(at).collect(),
            ..Mode::default()
        }
    });
    let nodes = nodes(&points, &modal.ports);
    let uff = Uff { units: Some(si()), nodes, modes: modes.collect(), ..Uff::default() };
    written(path, &write_uff(&uff).map_err(TaskError::work)?)
}

/// Writes all finished points as arrays of a MATLAB file, as `import` reads them.
pub(super) fn mat(library: &Library, path: &Path) -> Result<Committed, TaskError> {
    let responses = library.responses()?;
    vacant(path)?;
    let (points, ports, samples) = (responses.points.len(), responses.ports.len(), responses.samples());
    let places = |places: &mut dyn Iterator<Item = Point>| -> Vec<f64> {
        places.flat_map(|at| [at.x, at.y]).collect()
    };
    let values = responses.data().iter().map(|value| f64::from(*value)).collect();
    let names = responses.ports.iter().map(|port| port.name.clone()).collect();
    let arrays = Arrays::from([
        ("responses".into(), Array::real(&[points, ports, samples], values)),
        ("points_m".into(), Array::real(&[points, 2], places(&mut responses.points.iter().copied()))),
        ("actuators".into(), Array::texts(names)),
        (
            "actuators_m".into(),
            Array::real(&[ports, 2], places(&mut responses.ports.iter().map(|port| port.at))),
        ),
        ("drive_units".into(), Array::texts(library.plan().drive_units.clone())),
        ("rate_hz".into(), Array::real(&[1], vec![responses.conditions.rate])),
        ("band_hz".into(), Array::real(&[1, 2], responses.conditions.band.to_vec())),
        ("kind".into(), Array::texts(vec!["impulse-responses".into()])),
        ("unit".into(), Array::texts(vec!["m/s".into()])),
    ]);
    written(path, &write_mat(&arrays).map_err(TaskError::work)?)
}

fn written(path: &Path, bytes: &[u8]) -> Result<Committed, TaskError> {
    write_durably(path, |out| out.write_all(bytes))?;
    Ok(Committed { path: path.into(), replaced: false })
}

/// Refuses a place that something is at: these files bear no sign by which an earlier export is known.
fn vacant(path: &Path) -> Result<(), TaskError> {
    match path.symlink_metadata() {
        Err(_) => Ok(()),
        Ok(_) => Err(StoreError::Occupied {
            path: path.into(),
            expected: "no such file yet",
            found: "a file or folder".into(),
        }
        .into()),
    }
}

/// Names of the actuators, which a universal file can hold.
fn named(library: &Library) -> Result<Vec<String>, TaskError> {
    let names: Vec<String> = library.plan().ports.iter().map(|port| port.name.clone()).collect();
    match names.iter().find(|name| name.len() > LETTERS || !name.is_ascii()) {
        None => Ok(names),
        Some(name) => Err(TaskError::Input(format!(
            "{}: expected names of actuators of at most {LETTERS} ASCII letters for a universal file, found `{name}`",
            library.path().display()
        ))),
    }
}

/// Number of a node or a mode by its index: they count from 1.
fn label(index: usize) -> i64 {
    index as i64 + 1
}

/// Nodes at the points, followed by those at the actuators.
fn nodes(points: &[Point], ports: &[Port]) -> Vec<Node> {
    let places = points.iter().copied().chain(ports.iter().map(|port| port.at));
    let node = |(index, at): (usize, Point)| Node {
        label: label(index),
        at: [at.x, at.y, 0.0],
        dataset: 0,
        line: 0,
    };
    places.enumerate().map(node).collect()
}

fn si() -> UffUnits {
    UffUnits { code: 1, name: "SI".into(), length: 1.0, force: 1.0 }
}

fn axis(quantity: i64, label: &str, unit: &str) -> Axis {
    Axis { quantity, label: label.into(), unit: unit.into() }
}

/// The reference of a drive in a unit.
fn reference_axis(unit: &str) -> Axis {
    match unit {
        "N" => axis(FORCE, "Force", unit),
        "V" => axis(0, "Voltage", unit),
        _ => axis(0, "Current", unit),
    }
}

/// Frequency responses of impulse responses.
struct Spectrum {
    planner: FourierPlanner,
    /// Seconds between samples, and their number: an even one, so that the last line is at half the rate.
    time: f64,
    samples: usize,
    /// Distance of lines, in Hz.
    step: f64,
}

impl Spectrum {
    fn new(responses: &SampledResponses) -> Self {
        let (rate, samples) = (responses.conditions.rate, responses.samples().next_multiple_of(2));
        Self { planner: FourierPlanner::new(), time: 1.0 / rate, samples, step: rate / samples as f64 }
    }

    /// Lines of a response, real and imaginary part after each other.
    fn of(&mut self, response: &[f32]) -> io::Result<Vec<f64>> {
        let mut values: Vec<f64> = response.iter().map(|value| self.time * f64::from(*value)).collect();
        values.resize(self.samples, 0.0);
        let transform = self.planner.forward(self.samples);
        let mut lines = transform.make_output_vec();
        transform.process(&mut values, &mut lines).map_err(io::Error::other)?;
        Ok(lines.into_iter().flat_map(|line| [line.re, line.im]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;
    use unripple::core::{Conditions, Outline, Shape};

    #[test]
    fn lines_are_those_of_the_integral() {
        let outline = Outline::new(Shape::Rectangle { width: 1.0, height: 1.0 });
        let conditions = Conditions { rate: 100.0, band: [0.0, 40.0], lambda_min: 0.1, outline };
        let port = Port { name: "a1".into(), at: Point::default() };
        let data: Vec<f32> = (0..199).map(|n| (-0.05 * n as f32).exp()).collect();
        let responses =
            SampledResponses::new(vec![port], vec![Point::default()], conditions, 199, data).unwrap();
        let mut spectrum = Spectrum::new(&responses);
        let lines = spectrum.of(responses.response(0, 0)).unwrap();
        assert_eq!((lines.len(), spectrum.step), (2 * 101, 0.5));
        // The geometric series of e^{-5 t} at 2.5 Hz.
        let angle = 2.0 * PI * 2.5 / 100.0;
        let (re, im) = (1.0 - (-0.05_f64).exp() * angle.cos(), (-0.05_f64).exp() * angle.sin());
        let size = re * re + im * im;
        assert!((lines[10] - 0.01 * re / size).abs() < 1e-5 && (lines[11] + 0.01 * im / size).abs() < 1e-5);
    }
}
