//! An actuator as a force on the sheet.

use crate::{Circuit, Footprint, Load};
use unripple_core::CoilDrive;

/// How the drive of an actuator acts: directly as a force, or as the voltage of a coil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// The force is proportional to the drive at each instant.
    Force,
    /// The drive is the voltage of the coil in the actuator's load; the force is proportional to the coil's
    /// current.
    Voltage,
}

/// An actuator as a source of force on the sheet. By reciprocity, the same contact and gain also turn the
/// sheet's motion into its sensor signal ([`Sensor`](super::Sensor)).
#[derive(Clone, Debug, PartialEq)]
pub struct Transducer {
    /// The contact over which the actuator acts on the sheet, as quadrature points and weights.
    pub footprint: Footprint,
    /// Force over the footprint per unit of drive (N per unit), or for a patch the moment per length of its
    /// rim (N per V); for [`Entry::Voltage`], the force per coil current (N/A).
    pub gain: f64,
    /// How the drive acts: as a force or as a coil's voltage.
    pub entry: Entry,
    /// The load of the actuator on the sheet (mass, coil, housing); `None` if it does not load the sheet.
    pub load: Option<Load>,
    /// Unit of the drive: N, A or V.
    pub unit: &'static str,
}

impl Entry {
    /// How the drive of a coil acts, the unit of the drive, and the circuit that loads the sheet; `None`
    /// for a current source, with which the electromotive force drives no current.
    pub(super) fn of_coil(driven_by: CoilDrive, circuit: Circuit) -> (Self, &'static str, Option<Circuit>) {
        match driven_by {
            CoilDrive::Current => (Self::Force, "A", None),
            CoilDrive::Voltage => (Self::Voltage, "V", Some(circuit)),
        }
    }
}

impl Transducer {
    /// Force per unit of drive on a sheet without any load: 0 for a coil driven by a voltage, which would be a
    /// load unless its force constant is 0.
    pub(crate) fn unloaded_gain(&self) -> f64 {
        match self.entry {
            Entry::Force => self.gain,
            Entry::Voltage => 0.0,
        }
    }
}
