//! The place of an actuator on the sheet, in words.

use unripple_core::{Actuator, Outline};

/// Where an actuator is, for messages.
pub(super) fn place(actuator: &Actuator, outline: &Outline) -> String {
    let (width, height) = outline.extent();
    format!("{} (actuator `{}`) on {:.1} x {:.1} mm", actuator.at, actuator.name, width * 1e3, height * 1e3)
}
