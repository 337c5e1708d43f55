//! A fixed voice coil whose magnet is attached to the sheet, driven by current or voltage.

use super::{Entry, Transducer};
use crate::{Circuit, Footprint, Load};
use unripple_core::{Actuator, ActuatorKind, Outline};

/// A magnet that is attached to the sheet and moves in a fixed coil: force bl·i, electromotive force bl·v, coil impedance R + Ls
/// (Beranek, *Acoustics*, 1954, chapter 3, for a coil that moves in a fixed magnet's field, which has the same equations).
///
/// With a current source the force is bl per ampere, and the only load on the sheet is the magnet's mass. With a voltage source
/// the sheet's motion drives a current, L di/dt + R i = V - bl·v: the coil is part of the load, and damps the sheet by
/// (bl)²/(R + Ls). For the signals sensed in both cases see [`Sensor`](super::Sensor).
pub(super) fn transducer(actuator: &Actuator, outline: &Outline) -> Transducer {
    let ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by } =
        actuator.kind
    else {
        return super::force::transducer(actuator, outline);
    };
    let footprint = Footprint::disc(actuator.at, actuator.contact_radius, outline);
    let (entry, unit, circuit) =
        Entry::of_coil(driven_by, Circuit { force_constant, resistance, inductance });
    let load = Load {
        footprint: footprint.clone(),
        mass: moving_mass,
        damping: 0.0,
        stiffness: 0.0,
        circuit,
        housing: None,
    };
    Transducer { footprint, gain: force_constant, entry, load: Some(load), unit }
}
