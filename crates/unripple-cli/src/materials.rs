//! `unripple materials`: the materials that surface files may name.

use crate::args::MaterialsOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::materials::{self, Ask};

/// Lists materials, with the sources of their values.
pub fn run(options: &MaterialsOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    output::perform(common.json, &Ask { name: options.name.clone() }, materials::run)
}
