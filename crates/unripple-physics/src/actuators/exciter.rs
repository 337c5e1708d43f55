//! An inertial exciter: a voice coil fixed to the sheet, its magnet in a housing on a spring, driven by current or voltage.

use super::{Entry, Transducer};
use crate::{Circuit, Footprint, Housing, Load};
use std::f64::consts::TAU;
use unripple_core::{Actuator, ActuatorKind, Outline};

/// A voice coil of mass μ that is fixed to the sheet and moves in the field of a magnet, whose housing of mass M hangs on the coil by a
/// spring k and a damper c. With v the velocity of the sheet, u that of the housing and F = bl·i the force between them,
/// M du/dt = -F + c(v - u) + k∫(v - u) dt, and the sheet is driven by F - c(v - u) - k∫(v - u) dt - μ dv/dt.
///
/// With a current source the force on a sheet held still is bl·Ms²/(Ms² + cs + k) per ampere: nothing far below the resonance
/// √(k/M) of the housing, all of bl well above it. With a voltage source L di/dt + R i = V - bl(v - u), so that the coil acts as a
/// further damper (bl)²/(R + Ls) between housing and sheet. The load on the sheet is μs + 1/(1/Ms + 1/(c + k/s + (bl)²/(R + Ls))):
/// the masses together far below the resonance, that of the coil and what holds the housing above it (Beranek, *Acoustics*, 1954,
/// chapter 3, for the elements). For the signals sensed see [`Sensor`](super::Sensor).
pub(super) fn transducer(actuator: &Actuator, outline: &Outline) -> Transducer {
    let ActuatorKind::Exciter {
        force_constant,
        resistance,
        inductance,
        moving_mass,
        housing_mass,
        resonance,
        quality_factor,
        driven_by,
    } = actuator.kind
    else {
        return super::force::transducer(actuator, outline);
    };
    let footprint = Footprint::disc(actuator.at, actuator.contact_radius, outline);
    let (entry, unit, circuit) =
        Entry::of_coil(driven_by, Circuit { force_constant, resistance, inductance });
    let omega = TAU * resonance;
    let housing = Housing {
        mass: housing_mass,
        damping: housing_mass * omega / quality_factor,
        stiffness: housing_mass * omega * omega,
    };
    let load = Load {
        footprint: footprint.clone(),
        mass: moving_mass,
        damping: 0.0,
        stiffness: 0.0,
        circuit,
        housing: Some(housing),
    };
    Transducer { footprint, gain: force_constant, entry, load: Some(load), unit }
}
