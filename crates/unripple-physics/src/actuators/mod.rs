//! Actuators: the contact, force and load of each kind on the sheet.
//!
//! Each kind of actuator has a file that turns its data into a [`Transducer`]: its contact area, its force per drive, and its
//! load on the sheet. To add a kind, add its variant to
//! [`ActuatorKind`](unripple_core::ActuatorKind), a file here with a function `transducer` like those of the others, and an
//! arm in [`Transducer::of`]. No other code depends on the kinds.

mod derivative;
mod exciter;
mod force;
mod moving_magnet;
mod piezo;
mod place;
mod sensor;
mod suspension;
mod transducer;

pub use sensor::{Sensor, sensed, sensors};
pub use transducer::{Entry, Transducer};

use crate::{Load, PhysicsError};
use place::place;
use unripple_core::{Actuator, ActuatorKind, Outline, Surface, require};

impl Transducer {
    /// The transducer that models an actuator on a sheet with the given outline.
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
            ActuatorKind::Exciter { .. } => exciter::transducer(actuator, outline),
            ActuatorKind::Piezo { .. } => piezo::transducer(actuator, outline)?,
        };
        require("force of an actuator per unit of drive", true, "a finite number", transducer.gain)?;
        transducer.load.iter().try_for_each(Load::check)?;
        Ok(transducer)
    }
}

/// The transducers that model a surface's actuators, in channel order.
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
