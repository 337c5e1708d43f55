//! Actuators: the contact, force and load that each kind is to the sheet.
//!
//! Every kind of actuator is one file that turns its data into a [`Transducer`]: where it touches, what force it makes of its
//! drive, and what it hangs on the sheet. To add a kind, add its variant to
//! [`ActuatorKind`](unripple_core::ActuatorKind), a file here with a function `transducer` like those of the others, and an
//! arm in [`Transducer::of`]. Nothing else needs to know.

mod derivative;
mod force;
mod moving_magnet;
mod piezo;
mod sensor;

pub use sensor::{Sensor, sensed, sensors};

use crate::{Footprint, Load, PhysicsError};
use unripple_core::{Actuator, ActuatorKind, Outline, Surface, require};

/// How a drive enters the sheet: as a force, or through a coil's voltage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// As a force in step with the drive.
    Force,
    /// As the voltage on the coil of the actuator's own load, whose current is the force.
    Voltage,
}

/// An actuator as the sheet knows it. What drives also senses: by reciprocity the same footprint and gain turn the sheet's
/// motion into a signal, that of its [`Sensor`].
#[derive(Clone, Debug, PartialEq)]
pub struct Transducer {
    /// Contact through which it acts, as points and weights.
    pub footprint: Footprint,
    /// Force (N) or moment functional (N·m) per unit of drive, through the footprint; for [`Entry::Voltage`], force per
    /// ampere in the coil.
    pub gain: f64,
    /// How the drive enters: as a force or as a coil's voltage.
    pub entry: Entry,
    /// What hangs on the sheet because of it.
    pub load: Option<Load>,
    /// Unit of the drive: N, A or V.
    pub unit: &'static str,
}

impl Transducer {
    /// The transducer that an actuator is.
    ///
    /// # Errors
    /// [`PhysicsError::Unsupported`] for a place outside the outline or a patch partly beyond the rim,
    /// [`PhysicsError::Range`] for values that cannot be.
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
    /// Force per unit of drive where nothing hangs on the sheet: a coil of no force constant has none.
    pub(crate) fn unloaded_gain(&self) -> f64 {
        match self.entry {
            Entry::Force => self.gain,
            Entry::Voltage => 0.0,
        }
    }
}

/// The transducers that a surface's actuators are, in channel order.
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
