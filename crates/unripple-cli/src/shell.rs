//! `unripple completions` and `unripple man`: shell completions and manual pages, generated from the options.

use crate::args::{Arguments, CompletionsOptions, ManOptions};
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;
use unripple_store::OutputDir;
use unripple_tasks::folder;

/// The program's name, in completions and on its pages.
const NAME: &str = "unripple";

/// Prints the script with which a shell completes commands, options and their values.
pub fn completions(options: &CompletionsOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    output::print(&script(options.shell))
}

fn script(shell: Shell) -> Vec<u8> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), NAME, &mut script);
    script
}

/// Writes a manual page for the program and one for each command, section 1.
pub fn man(options: &ManOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let out = OutputDir::create(&options.output).map_err(CliError::work)?;
    for (name, command) in pages() {
        let page = page(command, &name)?;
        out.write(&format!("{name}.1"), &page).map_err(CliError::work)?;
    }
    Ok(folder::finish(out, &mut Terminal::default())?)
}

/// Names of the manual pages, each with the program or command that it describes.
fn pages() -> Vec<(String, clap::Command)> {
    let mut program = Arguments::command();
    program.build();
    let commands = program.get_subcommands().filter(|command| command.get_name() != "help");
    let of_commands = commands.map(|command| (format!("{NAME}-{}", command.get_name()), command.clone()));
    std::iter::once((NAME.to_owned(), program.clone())).chain(of_commands).collect()
}

fn page(command: clap::Command, name: &str) -> Result<Vec<u8>, CliError> {
    let mut page = Vec::new();
    Man::new(command).title(name).render(&mut page).map_err(CliError::work)?;
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Long names of the options that a command shows.
    fn shown(command: &clap::Command) -> Vec<String> {
        let options = command.get_arguments().filter(|option| !option.is_hide_set());
        options.filter_map(|option| option.get_long()).map(str::to_owned).collect()
    }

    #[test]
    fn scripts_complete_every_command_and_option() {
        let text = |shell| String::from_utf8(script(shell)).unwrap();
        let fish = text(Shell::Fish);
        let others = [Shell::Bash, Shell::Zsh].map(|shell| -> BTreeSet<String> {
            let apart = |c: char| !(c.is_ascii_alphanumeric() || c == '-');
            text(shell).split(apart).map(str::to_owned).collect()
        });
        let all = pages();
        assert!(all.len() > 15, "{}", all.len());
        for (_, command) in &all[1..] {
            let name = command.get_name();
            assert!(fish.contains(&format!(" -a \"{name}\"")), "{name}");
            assert!(others.iter().all(|words| words.contains(name)), "{name}");
            let own = format!("using_subcommand {name}\"");
            for option in shown(command) {
                let (short, long) = (format!(" -l {option} "), format!("--{option}"));
                let mut lines = fish.lines().filter(|line| line.contains(&own));
                assert!(lines.any(|line| line.contains(&short)), "{name} {long}");
                assert!(others.iter().all(|words| words.contains(&long)), "{name} {long}");
            }
        }
    }

    #[test]
    fn pages_describe_every_command_and_option() {
        let roff = |text: &str| text.replace('-', "\\-");
        let all = pages();
        let program = String::from_utf8(page(all[0].1.clone(), NAME).unwrap()).unwrap();
        for (name, command) in all {
            let options = shown(&command);
            assert!(name == NAME || program.contains(&roff(&format!("{name}(1)"))), "{name}");
            let page = String::from_utf8(page(command, &name).unwrap()).unwrap();
            assert!(!page.contains(&roff(env!("CARGO_PKG_NAME"))), "{name}");
            for option in options {
                let bold = format!("\\fB{}\\fR", roff(&format!("--{option}")));
                assert!(page.contains(&bold), "{name} --{option}");
            }
        }
    }
}
