//! An actuator as a force on the sheet.

use crate::{Circuit, Footprint, Load};
use unripple_core::CoilDrive;

/// How the drive of an actuator acts: directly as a force, or as the voltage of a coil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// The force is proportional to the drive at each instant.
    Force,
    /// The drive is the voltage of the coil in the actuator's load; the force is proportional to its current.
    Voltage,
}

/// An actuator as a force on the sheet. By reciprocity, the same contact and gain also turn the sheet's motion into its sensor
/// signal ([`Sensor`](super::Sensor)).
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

impl Entry {
    /// How the drive of a coil acts, its unit, and the circuit that loads the sheet: with a current source the electromotive force
    /// drives no current, so that there is none.
    pub(super) fn of_coil(driven_by: CoilDrive, circuit: Circuit) -> (Self, &'static str, Option<Circuit>) {
        match driven_by {
            CoilDrive::Current => (Self::Force, "A", None),
            CoilDrive::Voltage => (Self::Voltage, "V", Some(circuit)),
        }
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
