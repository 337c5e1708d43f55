//! An ideal force actuator: force in newtons in proportion to the drive.

use super::{Entry, Transducer};
use crate::Footprint;
use unripple_core::{Actuator, Outline};

/// An ideal force at a point, or evenly over a disc: 1 N per unit of drive, without a load on the sheet.
pub(super) fn transducer(actuator: &Actuator, outline: &Outline) -> Transducer {
    Transducer {
        footprint: Footprint::disc(actuator.at, actuator.contact_radius, outline),
        gain: 1.0,
        entry: Entry::Force,
        load: None,
        unit: "N",
    }
}
