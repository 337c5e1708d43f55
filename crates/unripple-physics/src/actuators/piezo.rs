//! A piezoelectric patch: a bending moment along its rim.

use super::place::place;
use super::{Entry, Transducer};
use crate::{Footprint, Load, PhysicsError};
use unripple_core::{Actuator, ActuatorKind, Outline, Patch, require};

/// A piezo patch, thin compared with the sheet: a bending moment along its rim, in N per volt, which does the work
/// moment·∮ ∂u/∂n ds = moment·∫ ∇²u dA (Dimitriadis, Fuller and Rogers, *J. Vib. Acoust.* 113, 100, 1991). Its mass is spread
/// evenly over it; its stiffness is neglected.
///
/// As a sensor, a patch turns the same integral of the sheet's displacement into charge, and that of its velocity into the
/// current of its signal ([`Sensor`](super::Sensor)).
pub(super) fn transducer(actuator: &Actuator, outline: &Outline) -> Result<Transducer, PhysicsError> {
    let ActuatorKind::Piezo { patch, moment, mass } = actuator.kind else {
        return Ok(super::force::transducer(actuator, outline));
    };
    let sizes = match patch {
        Patch::Round { radius } => [radius; 2],
        Patch::Rectangular { sides, .. } => sides,
    };
    for size in sizes {
        require("size of a piezo patch in m", size > 0.0, "a positive finite number", size)?;
    }
    if !patch.lies_on(outline, actuator.at) {
        return Err(PhysicsError::Unsupported {
            what: "place of a piezo patch",
            expected: "a patch inside the outline",
            found: format!("{}, at {}", told(patch, outline.to_rim(actuator.at)), place(actuator, outline)),
        });
    }
    let (area, footprint) = match patch {
        Patch::Round { radius } => {
            (Footprint::disc(actuator.at, radius, outline), Footprint::rim_slope(actuator.at, radius))
        }
        Patch::Rectangular { sides, angle } => (
            Footprint::rectangle(actuator.at, sides, angle),
            Footprint::rectangle_slope(actuator.at, sides, angle),
        ),
    };
    let load = (mass != 0.0).then_some(Load {
        footprint: area,
        mass,
        damping: 0.0,
        stiffness: 0.0,
        circuit: None,
        housing: None,
    });
    Ok(Transducer { footprint, gain: moment, entry: Entry::Force, load, unit: "V" })
}

/// Text for messages: the size of a patch and the distance (m) of its centre from the rim.
fn told(patch: Patch, to_rim: f64) -> String {
    let to_rim = to_rim * 1e3;
    match patch {
        Patch::Round { radius } => format!("a radius of {:.2} mm, {to_rim:.2} mm from the rim", radius * 1e3),
        Patch::Rectangular { sides: [width, height], .. } => {
            format!("{:.2} x {:.2} mm, its centre {to_rim:.2} mm from the rim", width * 1e3, height * 1e3)
        }
    }
}
