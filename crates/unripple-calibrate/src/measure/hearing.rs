//! Modelled responses of actuators at each other's sensors and at their own.

use crate::CalibrateError;
use unripple_core::{ModalResponses, Onset, Surface};
use unripple_linalg::Mat;
use unripple_physics::{Sensor, sensed, sensors};

/// A model of the responses of all sensors of a surface's actuators to all its actuators, each in the unit
/// of its [`Sensor`].
#[derive(Clone, Debug)]
pub struct Hearing {
    sensors: Vec<Sensor>,
    /// Weight of each oscillation (pole of the model) at each sensor, sensors x oscillations.
    felt: Mat<f64>,
    model: ModalResponses,
}

impl Hearing {
    /// The model of the responses between a surface's actuators, from the surface's modal responses.
    ///
    /// # Errors
    /// [`CalibrateError::Physics`] for actuators that are not valid, [`CalibrateError::Count`] if the responses have another number of
    /// them.
    pub fn of(surface: &Surface, model: &ModalResponses) -> Result<Self, CalibrateError> {
        let sensors = sensors(surface)?;
        if sensors.len() != model.ports.len() {
            let (what, expected) = ("actuators of the model", sensors.len().to_string());
            return Err(CalibrateError::Count { what, expected, found: model.ports.len() });
        }
        Ok(Self { felt: sensed(&sensors, model), sensors, model: model.clone() })
    }

    /// Number of actuators.
    pub fn actuators(&self) -> usize {
        self.sensors.len()
    }

    /// The actuators as sensors, in channel order.
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }

    /// Frequency (Hz) and decay rate (1/s) of each oscillation (pole) of the model, frequencies ascending;
    /// several oscillations may have the same frequency.
    pub fn tones(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.model.poles.iter().map(|pole| [pole.omega / std::f64::consts::TAU, pole.sigma])
    }

    /// Whether every oscillation that an actuator senses is in phase with the drive of that actuator: there
    /// are no circuits, no housings, and no damping that couples modes ([`Onset::Velocity`] throughout).
    /// Coils driven by a voltage couple modes strongly; masses that do not dissipate, on a sheet that does,
    /// couple them a little.
    pub fn in_step(&self) -> bool {
        let housed = self.sensors.iter().any(|sensor| sensor.housing.is_some());
        !self.has_voltage_driven_coils()
            && !housed
            && self.model.poles.iter().all(|pole| pole.onset == Onset::Velocity)
    }

    /// Whether any actuator is a coil driven by a voltage.
    pub fn has_voltage_driven_coils(&self) -> bool {
        self.sensors.iter().any(|sensor| sensor.circuit.is_some())
    }

    /// Response at a sensor to a unit impulse of an actuator's drive, `samples` samples from time 0 on, in
    /// the sensor's unit.
    pub fn response(&self, sensor: usize, drive: usize, samples: usize) -> Vec<f64> {
        let rate = self.model.conditions.rate;
        let mut moved = vec![0.0; samples];
        for (m, pole) in self.model.poles.iter().enumerate() {
            let weight = self.model.input[(drive, m)] * self.felt[(sensor, m)];
            let step = pole.step(1.0 / rate);
            let [mut u, mut v] = pole.kick();
            for sum in &mut moved {
                *sum += weight * v;
                [u, v] = [step[0][0] * u + step[0][1] * v, step[1][0] * u + step[1][1] * v];
            }
        }
        self.sensors.get(sensor).map_or(Vec::new(), |sensor| sensor.signal(&moved, rate))
    }
}
