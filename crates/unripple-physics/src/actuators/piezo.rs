//! A round piezoelectric patch: a bending moment along its rim.

use super::{Entry, Transducer, place};
use crate::{Footprint, Load, PhysicsError};
use unripple_core::{Actuator, ActuatorKind, Outline, require};

/// A round piezo patch, thin compared with the sheet: a bending moment along its rim, in N per volt, which does the work
/// moment·∮ ∂u/∂n ds = moment·∫ ∇²u dA (Dimitriadis, Fuller and Rogers, *J. Vib. Acoust.* 113, 100, 1991). Its mass is spread
/// evenly over the disc; its stiffness is neglected.
///
/// As a sensor, a patch turns the same integral of the sheet's displacement into charge, and that of its velocity into the
/// current of its signal ([`Sensor`](super::Sensor)).
pub(super) fn transducer(actuator: &Actuator, outline: &Outline) -> Result<Transducer, PhysicsError> {
    let ActuatorKind::Piezo { radius, moment, mass } = actuator.kind else {
        return Ok(super::force::transducer(actuator, outline));
    };
    require("radius of a piezo patch in m", radius > 0.0, "a positive finite number", radius)?;
    if !outline.holds_disc(actuator.at, radius) {
        let to_rim = outline.to_rim(actuator.at);
        return Err(PhysicsError::Unsupported {
            what: "place of a piezo patch",
            expected: "a disc inside the outline",
            found: format!(
                "a radius of {:.2} mm, {:.2} mm from the rim, at {}",
                radius * 1e3,
                to_rim * 1e3,
                place(actuator, outline)
            ),
        });
    }
    let load = (mass != 0.0).then(|| Load {
        footprint: Footprint::disc(actuator.at, radius, outline),
        mass,
        damping: 0.0,
        stiffness: 0.0,
        circuit: None,
    });
    let footprint = Footprint::rim_slope(actuator.at, radius);
    Ok(Transducer { footprint, gain: moment, entry: Entry::Force, load, unit: "V" })
}
