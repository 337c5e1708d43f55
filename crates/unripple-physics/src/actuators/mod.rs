//! Actuators: the contact, force and load of each kind on the sheet.
//!
//! Each kind of actuator has a file that turns its data into a [`Transducer`]: its contact area, its force per drive, and its
//! load on the sheet. To add a kind, add its variant to
//! [`ActuatorKind`](unripple_core::ActuatorKind), a file here with a function `transducer` like those of the others, and an
//! arm in [`Transducer::of`]. No other code depends on the kinds.

mod derivative;
mod force;
mod moving_magnet;
mod piezo;
mod sensor;

pub use sensor::{Sensor, sensed, sensors};

use crate::{Footprint, Load, PhysicsError};
use unripple_core::{Actuator, ActuatorKind, Outline, Surface, require};

/// How the drive of an actuator acts: directly as a force, or as the voltage of a coil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// The force is proportional to the drive at each instant.
    Force,
    /// The drive is the voltage of the coil in the actuator's load; the force is proportional to its current.
    Voltage,
}

/// An actuator as a force on the sheet. By reciprocity, the same contact and gain also turn the sheet's motion into its sensor
/// signal ([`Sensor`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Transducer {
    /// Contact through which it acts, as points and weights.
    pub footprint: Footprint,
    /// Force through the footprint per unit of drive (N per unit), or for a patch the moment per length of its rim (N per V); for
    /// [`Entry::Voltage`], the force per coil current (N/A).
    pub gain: f64,
    /// How the drive acts: as a force or as a coil's voltage.
    pub entry: Entry,
    /// The load of the actuator on the sheet (mass, coil); `None` for none.
    pub load: Option<Load>,
    /// Unit of the drive: N, A or V.
    pub unit: &'static str,
}

impl Transducer {
    /// The transducer of an actuator on a sheet of some outline.
    ///
    /// # Errors
    /// [`PhysicsError::Unsupported`] for a place outside the outline or a patch partly beyond the rim,
    /// [`PhysicsError::Range`] for a value out of its range.
    pub fn of(actuator: &Actuator, outline: &Outline) -> Result<Self, PhysicsError> {
        if !outline.contains(actuator.at) {
            return Err(PhysicsError::Unsupported {
                what: "place of an actuator",
                expected: "a point inside the outline",
                found: place(actuator, outline),
            });
        }
        let radius = actuator.contact_radius;
        require("contact radius of an actuator in m", radius >= 0.0, "0 or more", radius)?;
        let transducer = match actuator.kind {
            ActuatorKind::Force => force::transducer(actuator, outline),
            ActuatorKind::MovingMagnet { .. } => moving_magnet::transducer(actuator, outline),
            ActuatorKind::Piezo { .. } => piezo::transducer(actuator, outline)?,
        };
        require("force of an actuator per unit of drive", true, "a finite number", transducer.gain)?;
        transducer.load.iter().try_for_each(Load::check)?;
        Ok(transducer)
    }
}

impl Transducer {
    /// Force per unit of drive if no load acts on the sheet: 0 for a coil driven by a voltage, which then has no force constant.
    pub(crate) fn unloaded_gain(&self) -> f64 {
        match self.entry {
            Entry::Force => self.gain,
            Entry::Voltage => 0.0,
        }
    }
}

/// The transducers of a surface's actuators, in channel order.
///
/// # Errors
/// Those of [`Transducer::of`], with the actuator's index.
pub fn transducers(surface: &Surface) -> Result<Vec<Transducer>, PhysicsError> {
    let of = |(index, actuator): (usize, &Actuator)| {
        Transducer::of(actuator, &surface.outline).map_err(|error| match error {
            PhysicsError::Unsupported { what, expected, found } => PhysicsError::Unsupported {
                what,
                expected,
                found: found.replacen("(actuator", &format!("(actuator {index},"), 1),
            },
            other => other,
        })
    };
    surface.actuators.iter().enumerate().map(of).collect()
}

/// Where an actuator is, for messages.
fn place(actuator: &Actuator, outline: &Outline) -> String {
    let (width, height) = outline.extent();
    format!("{} (actuator `{}`) on {:.1} x {:.1} mm", actuator.at, actuator.name, width * 1e3, height * 1e3)
}
