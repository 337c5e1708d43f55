//! `unripple export`: a library in formats that others read.

use crate::args::ExportOptions;
use crate::error::CliError;
use crate::output;
use unripple_tasks::export::{self, Ask};

pub fn run(options: &ExportOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask {
        library: options.library.clone().into(),
        output: options.output.clone(),
        format: options.format.map(|format| format.format()),
        author: options.author.clone(),
        organization: options.organization.clone(),
        license: options.license.clone(),
    };
    output::perform(as_json, &ask, export::run)
}
