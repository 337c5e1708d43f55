//! Loaded surfaces against an independent integration, and the rate at which steps within a sample approach it.

use crate::stepper_common;
use crate::truth;

use stepper_common::*;
use truth::{Hung, Truth};
use unripple_core::*;
use unripple_physics::stepper::*;
use unripple_physics::{Circuit, Housing};

const RATE: f64 = 48e3;
const MODES: usize = 25;

/// The paper's coil, with a force constant that a magnet of its size could have.
const COIL: Circuit = Circuit { force_constant: 1.5, resistance: 6.2, inductance: 1.9e-3 };

/// A housing of 5 g on a spring, 100 Hz, and its damper.
const HOUSING: Housing = Housing { mass: 5e-3, damping: 1.0, stiffness: 2e3 };

/// A surface, and the same as a system of equations: channels in order, then a finger.
struct Case {
    channels: Vec<Channel>,
    finger: Contact,
}

impl Case {
    /// Coils on a voltage: nothing strikes the sheet itself.
    fn voltage() -> Self {
        let channels = vec![coil(31.0, 12.0, 1e-4, COIL), coil(120.0, 84.0, 3e-4, COIL)];
        Self { channels, finger: finger(62.0, 90.0, [2e-4, 1.0, 1e3]) }
    }

    /// A bare force, a magnet on a current, and a coil without inductance on a voltage.
    fn mixed() -> Self {
        let mut heavy = force(70.0, 20.0);
        heavy.load = Some(load(70.0, 20.0, [3e-4, 0.1, 200.0], None));
        let plain = Circuit { inductance: 0.0, ..COIL };
        let channels = vec![force(31.0, 12.0), heavy, coil(120.0, 84.0, 1e-4, plain)];
        Self { channels, finger: finger(62.0, 90.0, [2e-4, 1.0, 1e3]) }
    }

    /// Exciters on a current, on a voltage, and on a voltage without inductance.
    fn exciters() -> Self {
        let plain = Circuit { inductance: 0.0, ..COIL };
        let channels = vec![
            exciter(31.0, 12.0, 3e-4, HOUSING, None),
            exciter(120.0, 84.0, 1e-4, HOUSING, Some(COIL)),
            exciter(70.0, 20.0, 2e-4, HOUSING, Some(plain)),
        ];
        Self { channels, finger: finger(62.0, 90.0, [2e-4, 1.0, 1e3]) }
    }

    fn surface(&self, substeps: usize) -> VirtualSurface {
        let options = StepperOptions { substeps, fade: 0.0, ..Default::default() };
        let mut surface =
            VirtualSurface::new(&membrane(MODES, 14.0), &self.channels, RATE, &options).unwrap();
        surface.set_probes(&[(mm(100.0, 40.0), Reading::Velocity)]).unwrap();
        surface.touch(1, &self.finger).unwrap();
        // Down before anything happens.
        rest(&mut surface, 2);
        surface
    }

    /// Sensors of all channels, then the probe.
    fn stepped(&self, drive: &[f64], substeps: usize) -> Vec<f64> {
        let (mut sensors, probes) = run(&mut self.surface(substeps), drive);
        sensors.extend(probes);
        sensors
    }

    fn exact(&self, drive: &[f64], steps: usize) -> Vec<f64> {
        let (frames, probe) = (drive.len() / self.channels.len(), weights(mm(100.0, 40.0)));
        let mut whole = Whole::new(self);
        let mut out = vec![0.0; (self.channels.len() + 1) * frames];
        for frame in 0..frames {
            if frame > 0 {
                whole.advance(1.0 / RATE, steps);
            }
            for (c, channel) in self.channels.iter().enumerate() {
                whole.drive(c, channel, drive[c * frames + frame] / RATE);
            }
            for (c, channel) in self.channels.iter().enumerate() {
                out[c * frames + frame] = whole.heard(c, channel);
            }
            out[self.channels.len() * frames + frame] = whole.truth.velocity(&probe);
        }
        out
    }
}

fn weights(at: Point) -> Vec<f64> {
    let mut row = vec![0.0; MODES];
    Sines(MODES).at(at, &mut row);
    row
}

/// The system of equations of a case.
struct Whole {
    truth: Truth,
    /// Number of each channel's load, if it has one.
    own: Vec<Option<usize>>,
    /// Each load on a sheet that is held still: sensors do not hear what drives cause there.
    held: Vec<Truth>,
}

impl Whole {
    fn new(case: &Case) -> Self {
        let (mut hung, mut own) = (Vec::new(), Vec::new());
        for channel in &case.channels {
            own.push(channel.load.as_ref().map(|load| {
                let values = [load.mass, load.damping, load.stiffness];
                let weights = weights(load.footprint.points[0].0);
                hung.push(Hung { weights, values, circuit: load.circuit, housing: load.housing });
                hung.len() - 1
            }));
        }
        let still = |hung: &Hung| Truth::new(&[], &[Hung { weights: Vec::new(), ..hung.clone() }]);
        let held = hung.iter().map(still).collect();
        let Finger { mass, damping, stiffness, .. } = case.finger.finger;
        let values = [mass, damping, stiffness];
        hung.push(Hung { weights: weights(case.finger.at), values, circuit: None, housing: None });
        let omega = |m: usize| {
            let (i, j) = ((m % 5 + 1) as f64, (m / 5 + 1) as f64);
            std::f64::consts::PI / SIDE * ((i * i + j * j) * 200.0 / 0.175).sqrt()
        };
        let poles: Vec<Pole> = (0..MODES).map(|m| Pole::new(omega(m), 14.0)).collect();
        Self { truth: Truth::new(&poles, &hung), own, held }
    }

    fn advance(&mut self, time: f64, steps: usize) {
        self.truth.advance(time, steps);
        self.held.iter_mut().for_each(|held| held.advance(time, steps));
    }

    /// An impulse of a channel's drive.
    fn drive(&mut self, c: usize, channel: &Channel, impulse: f64) {
        match self.own[c] {
            Some(load) if channel.voltage => {
                self.truth.shock(load, impulse);
                self.held[load].shock(0, impulse);
            }
            Some(load) => {
                self.truth.push(load, impulse);
                self.held[load].push(0, impulse);
            }
            None => self.truth.strike(&weights(channel.footprint.points[0].0), impulse),
        }
    }

    /// What a channel hears: the motion, or what it alone drives through a coil.
    fn heard(&self, c: usize, channel: &Channel) -> f64 {
        let Some(load) = self.own[c] else {
            return self.truth.velocity(&weights(channel.footprint.points[0].0));
        };
        let moved = self.truth.apart(load) - self.held[load].apart(0);
        match channel.load.as_ref().and_then(|load| load.circuit).filter(|_| channel.voltage) {
            Some(coil) if coil.inductance > 0.0 => self.held[load].current(0) - self.truth.current(load),
            Some(coil) => coil.force_constant / coil.resistance * moved,
            None => moved,
        }
    }
}

/// Errors of each output, of so many steps per sample.
fn errors(case: &Case, drive: &[f64], exact: &[f64], substeps: usize) -> Vec<f64> {
    let frames = drive.len() / case.channels.len();
    let found = case.stepped(drive, substeps);
    found.chunks(frames).zip(exact.chunks(frames)).map(|(found, exact)| apart(found, exact)).collect()
}

/// Errors fall as the square of the step, towards the independent integration.
fn falls_as_the_square(case: &Case, drive: &[f64], first: f64) {
    let exact = case.exact(drive, 40);
    assert!(apart(&case.exact(drive, 20), &exact) < 1e-5, "the integration itself");
    let rows: Vec<Vec<f64>> = [1, 2, 4, 8].map(|n| errors(case, drive, &exact, n)).to_vec();
    for output in 0..rows[0].len() {
        let column: Vec<f64> = rows.iter().map(|row| row[output]).collect();
        println!("output {output}: {column:?}");
        assert!(column[0] < first, "{output}: {column:?}");
        for pair in column.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((3.0..5.5).contains(&ratio), "{output}: {column:?}");
        }
    }
}

#[test]
fn coils_on_a_voltage_and_a_finger_converge() {
    let case = Case::voltage();
    falls_as_the_square(&case, &pulse(2, 240, 700.0, RATE), 0.05);
}

#[test]
fn struck_masses_and_a_finger_converge() {
    let case = Case::mixed();
    falls_as_the_square(&case, &pulse(3, 240, 700.0, RATE), 0.05);
}

#[test]
fn exciters_and_a_finger_converge() {
    let case = Case::exciters();
    falls_as_the_square(&case, &pulse(3, 240, 700.0, RATE), 0.05);
}

#[test]
fn a_single_impulse_converges_too() {
    let case = Case::mixed();
    let mut drive = vec![0.0; 3 * 200];
    drive[0] = 1.0;
    falls_as_the_square(&case, &drive, 0.2);
}

#[test]
fn the_least_step_is_exact_for_dampers() {
    // What neither stores nor waits: errors come from the held force alone, and still fall as the square.
    let mut channel = force(31.0, 12.0);
    channel.load = Some(load(31.0, 12.0, [0.0, 3.0, 0.0], None));
    let case = Case { channels: vec![channel], finger: finger(62.0, 90.0, [0.0, 2.0, 0.0]) };
    falls_as_the_square(&case, &pulse(1, 240, 700.0, RATE), 0.05);
}
