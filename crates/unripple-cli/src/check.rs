//! `unripple check`: all faults of a surface file.

use crate::args::CheckOptions;
use crate::error::CliError;
use crate::output;
use serde_json::json;
use unripple_store::{StoreError, load_surface};

pub fn run(options: &CheckOptions, as_json: bool) -> Result<(), CliError> {
    match load_surface(&options.surface) {
        Ok(surface) => {
            let report = json!({ "surface": options.surface, "ok": true, "faults": [] });
            let (name, count) = (&surface.name, surface.actuators.len());
            output::answer(
                as_json,
                &report,
                &format!("{}: no faults (\"{name}\", {count} actuators)", options.surface),
            )
        }
        Err(StoreError::Surface(faults)) if as_json => {
            let report = json!({
                "surface": options.surface,
                "ok": false,
                "faults": faults.faults(),
                "omitted": faults.omitted(),
            });
            output::answer(true, &report, "")?;
            Err(CliError::Faults(Box::new(faults)))
        }
        Err(error) => Err(error.into()),
    }
}
