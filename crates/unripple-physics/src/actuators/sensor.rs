//! Actuators as sensors: the signals that the sheet's motion generates at their terminals.

use super::derivative::Derivative;
use super::suspension::Suspension;
use super::{Entry, Transducer};
use crate::{Circuit, Footprint, Housing};
use unripple_core::{ActuatorKind, ModalResponses, Surface};
use unripple_linalg::{Mat, c64};

/// An actuator as a sensor: its signal is the part of the quantity at its terminals that the sheet's motion causes.
///
/// The signal is the quantity whose product with the drive is a power. With v the velocity under the contact:
///
/// | driven by | sensor signal | for a velocity v | unit |
/// |---|---|---|---|
/// | a force (N) | the velocity | v | m/s |
/// | a coil's current (A) | the voltage of its open terminals | bl·v | V |
/// | a coil's voltage (V) | the current j in its closed circuit, L dj/dt + R j = bl·v | bl·v/(R + Ls) | A |
/// | an exciter's current (A) | the voltage of its open terminals, u the velocity of its housing | bl·(v - u) | V |
/// | an exciter's voltage (V) | the current j in its closed circuit, L dj/dt + R j = bl·(v - u) | bl·(v - u)/(R + Ls) | A |
/// | a patch's voltage (V) | the current of its short circuit | moment·∮ ∂v/∂n ds | A |
///
/// What the drive itself causes at the terminals of a coil or patch that does not move, R i + L di/dt or V/(R + Ls) or C dV/dt, is
/// not part of the signal; in a measurement, a bridge or a dummy load removes it. Nor is what the drive of an exciter causes by moving
/// its housing on a sheet that is held still: u is the part of the housing's velocity that the sheet's motion causes,
/// v - u = v·Ms/(Ms + T) with T as in [`Load::reaction`](crate::Load::reaction); a dummy load is another exciter on a heavy block. With
/// this definition all pairs of actuators are reciprocal, whatever their kinds: the signal of b for a drive at a is that of a for the
/// same drive at b, and an actuator senses its own drive with a positive sign (L. L. Foldy and H. Primakoff, *J. Acoust. Soc. Am.*
/// 17, 109, 1945).
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// The contact over which the actuator senses the sheet's motion, as quadrature points and weights.
    pub footprint: Footprint,
    /// Signal per velocity (m/s) over the footprint; for a coil in a closed circuit, the electromotive
    /// force per velocity, in V·s/m.
    pub gain: f64,
    /// For a coil driven by a voltage, the closed circuit in which the sheet's motion drives a current;
    /// `None` for other actuators.
    pub circuit: Option<Circuit>,
    /// The housing of an exciter, relative to which the exciter senses the sheet's motion; `None` for other
    /// actuators.
    pub housing: Option<Housing>,
    /// Unit of the signal: m/s, V or A.
    pub unit: &'static str,
    /// Whether the signal follows the sheet's velocity under the contact: false for a piezo patch, which senses bending.
    placed: bool,
}

impl Sensor {
    /// The sensor that corresponds to the transducer of an actuator of the given kind.
    pub(super) fn of(transducer: &Transducer, kind: &ActuatorKind) -> Self {
        let circuit = match transducer.entry {
            Entry::Voltage => transducer.load.as_ref().and_then(|load| load.circuit),
            Entry::Force => None,
        };
        let unit = match (kind, circuit) {
            (ActuatorKind::Force, _) => "m/s",
            (ActuatorKind::MovingMagnet { .. } | ActuatorKind::Exciter { .. }, None) => "V",
            (ActuatorKind::MovingMagnet { .. } | ActuatorKind::Exciter { .. }, Some(_))
            | (ActuatorKind::Piezo { .. }, _) => "A",
        };
        let housing = transducer.load.as_ref().and_then(|load| load.housing);
        let placed = !matches!(kind, ActuatorKind::Piezo { .. });
        Self {
            footprint: transducer.footprint.clone(),
            gain: transducer.gain,
            circuit,
            housing,
            unit,
            placed,
        }
    }

    /// Whether the velocity under the contact can be computed from the sensor signal. It cannot for a
    /// patch, which senses the sheet's bending, nor for an exciter: far below its resonance, the housing
    /// follows the sheet and the signal vanishes, so that the computed velocity would grow without bounds
    /// with any offset or cut-off of the signal.
    pub fn gives_velocity(&self) -> bool {
        self.placed && self.gain != 0.0 && self.housing.is_none()
    }

    /// Sensitivity: sensor signal, in the sensor's unit, per velocity (m/s) under the contact, at the
    /// complex frequency `s` (1/s).
    pub fn per_velocity(&self, s: c64) -> c64 {
        let closed = self.circuit.map_or(c64::new(1.0, 0.0), |circuit| circuit.admittance(s)) * self.gain;
        let coil = Circuit::reaction(self.circuit.as_ref(), s);
        self.housing.map_or(closed, |housing| closed * housing.transmission(coil, s))
    }

    /// The sensor signal, in the sensor's unit, for a velocity (m/s) under the sensor's contact, both at
    /// `rate` samples per second. The velocity is taken as linear between samples.
    pub fn signal(&self, velocity: &[f64], rate: f64) -> Vec<f64> {
        if let Some(housing) = &self.housing {
            return Suspension::new(housing, self.circuit, self.gain, rate).signal(velocity);
        }
        let Some(Circuit { resistance, inductance, .. }) = self.circuit else {
            return velocity.iter().map(|v| self.gain * v).collect();
        };
        let at_once = self.gain / resistance;
        if inductance == 0.0 {
            return velocity.iter().map(|v| at_once * v).collect();
        }
        let [left, before, now] = held(resistance / (inductance * rate));
        let (mut current, mut last) = (0.0, 0.0);
        let step = |v: &f64| {
            current = left * current + at_once * (before * last + now * v);
            last = *v;
            current
        };
        velocity.iter().map(step).collect()
    }

    /// The velocities (m/s) under the contact, recovered from sensor signals at `rate` samples per second
    /// with frequencies up to `top` (Hz), at most 0.42 of the rate. Signals may be cut off at their ends;
    /// they are not taken as zero beyond. `None` for a patch or an exciter ([`Sensor::gives_velocity`]).
    pub fn velocities(&self, heard: &[Vec<f64>], rate: f64, top: f64) -> Option<Vec<Vec<f64>>> {
        if !self.gives_velocity() {
            return None;
        }
        let Some(Circuit { resistance, inductance, .. }) = self.circuit else {
            return Some(heard.iter().map(|row| row.iter().map(|x| x / self.gain).collect()).collect());
        };
        let derivative = (inductance > 0.0).then(|| Derivative::new(rate, top));
        let one = |row: &Vec<f64>| {
            let slopes = derivative.as_ref().map(|derivative| derivative.of(row));
            let slope = |i: usize| slopes.as_ref().map_or(0.0, |slopes| inductance * slopes[i]);
            row.iter().enumerate().map(|(i, j)| (resistance * j + slope(i)) / self.gain).collect()
        };
        Some(heard.iter().map(one).collect())
    }
}

/// Weights for one time step of the current in an R-L circuit, for θ = R dt/L: of the current before the
/// step, and of voltage over resistance before and after it. Exact for a voltage that is linear between
/// samples.
fn held(theta: f64) -> [f64; 3] {
    let left = (-theta).exp();
    let mean = -(-theta).exp_m1() / theta;
    // Their differences cancel where the current is slow.
    let series = theta < 1e-3;
    let now = if series { theta / 2.0 - theta * theta / 6.0 } else { 1.0 - mean };
    let before = if series { theta / 2.0 - theta * theta / 3.0 } else { mean - left };
    [left, before, now]
}

/// The actuators of a surface as sensors, in channel order.
///
/// # Errors
/// Those of [`transducers`](super::transducers).
pub fn sensors(surface: &Surface) -> Result<Vec<Sensor>, crate::PhysicsError> {
    let all = super::transducers(surface)?;
    Ok(all.iter().zip(&surface.actuators).map(|(t, actuator)| Sensor::of(t, &actuator.kind)).collect())
}

/// Readout weights of sensors for the modes of modal responses, in 1/√kg, sensors x modes: the mode shapes
/// averaged over each sensor's footprint. With these weights the responses give the velocity under the
/// sensor, and [`Sensor::signal`] turns that velocity into the sensor's signal.
pub fn sensed(sensors: &[Sensor], responses: &ModalResponses) -> Mat<f64> {
    let footprints: Vec<Footprint> = sensors.iter().map(|sensor| sensor.footprint.clone()).collect();
    Footprint::all_weights(&footprints, responses.shapes.as_ref())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use unripple_core::{Actuator, CoilDrive, Outline, Patch, Point, Shape};

    fn sensor(kind: ActuatorKind) -> Sensor {
        let outline = Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 });
        let at = Point::new(0.04, 0.05);
        let actuator = Actuator { name: "a".into(), at, kind, contact_radius: 0.0 };
        Sensor::of(&Transducer::of(&actuator, &outline).unwrap(), &kind)
    }

    fn coil(inductance: f64, driven_by: CoilDrive) -> Sensor {
        sensor(ActuatorKind::MovingMagnet {
            force_constant: 2.0,
            resistance: 6.0,
            inductance,
            moving_mass: 1e-5,
            driven_by,
        })
    }

    /// A housing of 20 g that resonates at 200 Hz.
    fn exciter(inductance: f64, driven_by: CoilDrive) -> Sensor {
        sensor(ActuatorKind::Exciter {
            force_constant: 2.0,
            resistance: 6.0,
            inductance,
            moving_mass: 1e-3,
            housing_mass: 0.02,
            resonance: 200.0,
            quality_factor: 4.0,
            driven_by,
        })
    }

    #[test]
    fn each_kind_hears_in_the_unit_that_its_drive_makes_power_with() {
        let patch =
            sensor(ActuatorKind::Piezo { patch: Patch::Round { radius: 0.01 }, moment: 0.02, mass: 0.0 });
        let found = [
            sensor(ActuatorKind::Force),
            coil(2e-3, CoilDrive::Current),
            coil(2e-3, CoilDrive::Voltage),
            patch.clone(),
        ];
        assert_eq!(found.map(|sensor| sensor.unit), ["m/s", "V", "A", "A"]);
        assert!(patch.velocities(&[vec![1.0]], 48e3, 3e3).is_none());
        let found = [exciter(2e-3, CoilDrive::Current), exciter(2e-3, CoilDrive::Voltage)];
        assert!(found.iter().all(|sensor| sensor.velocities(&[vec![1.0]], 48e3, 3e3).is_none()));
        assert_eq!(found.map(|sensor| sensor.unit), ["V", "A"]);
    }

    /// Against the equations of coil and housing solved by hand at one frequency.
    #[test]
    fn an_exciter_hears_what_moves_against_its_housing() {
        let (bl, resistance, mass, rate) = (2.0, 6.0, 0.02, 48e3);
        let (omega, quality) = (TAU * 200.0, 4.0);
        for (inductance, driven_by) in [
            (1e-4, CoilDrive::Current),
            (0.0, CoilDrive::Voltage),
            (2e-5, CoilDrive::Voltage),
            (2e-3, CoilDrive::Voltage),
        ] {
            let sensor = exciter(inductance, driven_by);
            for hz in [50.0, 200.0, 1000.0] {
                let tone = |i: usize| TAU * hz * i as f64 / rate;
                let velocity: Vec<f64> = (0..12_000).map(|i| tone(i).cos()).collect();
                let heard = sensor.signal(&velocity, rate);
                let s = c64::new(0.0, TAU * hz);
                let closed = s * inductance + resistance;
                // M s u = (c + k/s)(v - u) + bl j, with the current j = bl (v - u)/(R + Ls) if the coil is closed.
                let coil = match driven_by {
                    CoilDrive::Current => c64::new(0.0, 0.0),
                    CoilDrive::Voltage => c64::new(bl * bl, 0.0) / closed,
                };
                let held = s.inv() * (mass * omega * omega) + mass * omega / quality + coil;
                let apart = (held / (s * mass) + 1.0).inv();
                let factor = match driven_by {
                    CoilDrive::Current => apart * bl,
                    CoilDrive::Voltage => apart * bl / closed,
                };
                assert!(
                    (sensor.per_velocity(s) - factor).norm() < 1e-12 * factor.norm(),
                    "{inductance} {hz}"
                );
                // A line between samples is off by (ω dt)²/12 at most, in v and in u alike.
                let size = (factor / apart).norm() * (apart.norm() + (apart - 1.0).norm());
                let most = (TAU * hz / rate).powi(2) / 10.0 * size;
                for (i, found) in heard.iter().enumerate().take(12_000).skip(8000) {
                    let exact = (factor * c64::new(0.0, tone(i)).exp()).re;
                    assert!((found - exact).abs() < most, "{inductance} {hz}: {i}");
                }
            }
        }
    }

    #[test]
    fn a_closed_coil_hears_as_its_circuit_says_and_tells_the_motion() {
        let rate = 48e3;
        for inductance in [0.0, 1e-9, 1e-5, 1.3e-4, 1.9e-3] {
            let sensor = coil(inductance, CoilDrive::Voltage);
            for hz in [400.0, 3000.0] {
                let tone = |i: usize| TAU * hz * i as f64 / rate;
                let velocity: Vec<f64> = (0..4000).map(|i| tone(i).cos()).collect();
                let heard = sensor.signal(&velocity, rate);
                let factor = sensor.per_velocity(c64::new(0.0, TAU * hz));
                // As it is, and cut in the middle of a tone.
                let back = sensor.velocities(&[heard.clone(), heard[2000..].to_vec()], rate, 3600.0).unwrap();
                for i in 2000..4000 {
                    let exact = (factor * c64::new(0.0, tone(i)).exp()).re;
                    // A line between samples is off by (ω dt)²/12 at most.
                    let most = (TAU * hz / rate).powi(2) / 10.0;
                    assert!((heard[i] - exact).abs() < most * factor.norm(), "{inductance} {hz}");
                    assert!((back[0][i] - velocity[i]).abs() < 1.2 * most, "{inductance} {hz}: {i}");
                    assert!(
                        (back[1][i - 2000] - velocity[i]).abs() < 1.2 * most,
                        "{inductance} {hz}, cut: {i}"
                    );
                }
            }
        }
    }
}
