//! A voice coil whose magnet rides on the sheet, driven by current or voltage.

use super::{Entry, Transducer};
use crate::{Circuit, Footprint, Load};
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Outline};

/// A magnet that rides on the sheet in a fixed coil: force bl·i, electromotive force bl·v, coil R + Ls
/// (Beranek, *Acoustics*, 1954, chapter 3, for a coil that moves in a fixed magnet's field, which is the same).
///
/// With a current source the coil's voltage is free: force bl per ampere, and the sheet carries the magnet's
/// mass alone. With a voltage source the sheet's motion drives a current, L di/dt + R i = V - bl·v: the coil is
/// part of the load, and damps the sheet by (bl)²/(R + Ls). What is sensed either way, [`Sensor`](super::Sensor)
/// says.
pub(super) fn transducer(actuator: &Actuator, outline: &Outline) -> Transducer {
    let ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by } =
        actuator.kind
    else {
        return super::force::transducer(actuator, outline);
    };
    let footprint = Footprint::disc(actuator.at, actuator.contact_radius, outline);
    let (entry, unit, circuit) = match driven_by {
        CoilDrive::Current => (Entry::Force, "A", None),
        CoilDrive::Voltage => (Entry::Voltage, "V", Some(Circuit { force_constant, resistance, inductance })),
    };
    let load =
        Load { footprint: footprint.clone(), mass: moving_mass, damping: 0.0, stiffness: 0.0, circuit };
    Transducer { footprint, gain: force_constant, entry, load: Some(load), unit }
}
