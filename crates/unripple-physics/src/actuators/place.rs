//! The place of an actuator on the sheet, in words.

use unripple_core::{Actuator, Outline};

/// Text for messages: the position of an actuator, its name and the size of the sheet.
pub(super) fn place(actuator: &Actuator, outline: &Outline) -> String {
    let (width, height) = outline.extent();
    format!("{} (actuator `{}`) on {:.1} x {:.1} mm", actuator.at, actuator.name, width * 1e3, height * 1e3)
}
