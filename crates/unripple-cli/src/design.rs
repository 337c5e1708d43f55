//! `unripple design`: every tradeoff of a surface before anything is built.

use crate::args::DesignOptions;
use crate::error::CliError;
use crate::{input, output};
use unripple::physics::design;

pub fn run(options: &DesignOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let design = design(&surface).map_err(CliError::input)?;
    output::answer(as_json, &design, &design.to_string())
}
