//! `unripple completions` and `unripple man`: shell completions and manual pages, generated from the options.

use crate::args::{Arguments, CompletionsOptions, ManOptions};
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use clap::CommandFactory;
use clap_mangen::Man;
use unripple_store::OutputDir;
use unripple_tasks::folder;

/// The program's name, in completions and on its pages.
const NAME: &str = "unripple";

/// Prints the script with which a shell completes commands, options and their values.
pub fn completions(options: &CompletionsOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Arguments::command(), NAME, &mut script);
    output::print(&script)
}

/// Writes a manual page for the program and one for each command, section 1.
pub fn man(options: &ManOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let out = OutputDir::create(&options.output).map_err(CliError::work)?;
    let mut program = Arguments::command();
    program.build();
    let write = |command: clap::Command, name: String| {
        let mut page = Vec::new();
        Man::new(command).title(&name).render(&mut page).map_err(CliError::work)?;
        out.write(&format!("{name}.1"), &page).map_err(CliError::work)
    };
    write(program.clone(), NAME.to_owned())?;
    for command in program.get_subcommands().filter(|command| command.get_name() != "help") {
        write(command.clone(), format!("{NAME}-{}", command.get_name()))?;
    }
    Ok(folder::finish(out, &mut Terminal::default())?)
}
