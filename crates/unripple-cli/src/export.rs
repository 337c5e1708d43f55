//! `unripple export`: writes a library in formats that other programs read.

use crate::args::ExportOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::export::{self, Ask};

/// Writes a library as WAV files or as SOFA.
pub fn run(options: &ExportOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let ask = Ask {
        library: options.library.clone().into(),
        output: options.output.clone(),
        format: options.format.map(|format| format.format()),
        author: options.author.clone(),
        organization: options.organization.clone(),
        license: options.license.clone(),
    };
    output::perform(common.json, &ask, export::run)
}
