//! The configuration file: options that commands have where the command line gives none.

use crate::args::Arguments;
use crate::error::CliError;
use clap::error::{ContextKind, ErrorKind};
use clap::{Arg, ArgAction, Command, CommandFactory, Parser};
use std::ffi::OsString;
use unripple_store::{ConfigFile, Setting, StoreError, Takes};

/// The arguments `given` on the command line, completed by the configuration file; with what was added, in words.
///
/// # Errors
/// [`CliError::Usage`] of a request for help, and of usage that is wrong by itself; [`CliError::Input`] of a file that cannot be read, or of
/// what it says.
pub fn arguments(given: &[OsString]) -> Result<(Arguments, Option<String>), CliError> {
    let alone = match Arguments::try_parse_from(given) {
        // Help is to be had whatever the file says.
        Err(error) if asks_for_help(&error) => return Err(error.into()),
        alone => alone,
    };
    let Some(file) = ConfigFile::of_user().map_err(unusable)? else {
        return Ok((alone?, None));
    };
    let shown = file.name();
    let refused = |error: &clap::Error| CliError::Input(format!("{shown}: {}", first_line(error)));
    let added = added(given, &file)?;
    let told = |added: &Added| {
        Some(format!("{shown}: {}", added.options.join(" "))).filter(|_| !added.options.is_empty())
    };
    match Arguments::try_parse_from(added.beside(given)) {
        Ok(arguments) => Ok((arguments, told(&added))),
        Err(error) if added.is_at_fault(&error) => Err(refused(&error)),
        Err(error) => {
            let Ok(alone) = alone else { return Err(error.into()) };
            let usable = added.usable(given, alone).map_err(|error| refused(&error))?;
            Ok((usable.0, told(&usable.1)))
        }
    }
}

fn unusable(error: StoreError) -> CliError {
    CliError::Input(error.to_string())
}

fn first_line(error: &clap::Error) -> String {
    let text = error.to_string();
    text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
}

fn asks_for_help(error: &clap::Error) -> bool {
    let help = ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) || error.kind() == help
}

/// Options that the file adds to a command line, and behind which argument they come.
#[derive(Debug, PartialEq)]
struct Added {
    options: Vec<String>,
    behind: usize,
}

impl Added {
    /// Whether an error is about one of these options.
    fn is_at_fault(&self, error: &clap::Error) -> bool {
        let about = error.get(ContextKind::InvalidArg).map(ToString::to_string).unwrap_or_default();
        let name = |text: &str| text.split(['=', ' ']).next().map(str::to_owned);
        self.options.iter().any(|option| name(option) == name(&about))
    }

    /// A command line that is good by itself, and was read as `alone`, with as many of these options as go with it: without those that need
    /// others which nobody gives.
    ///
    /// # Errors
    /// That of an option which is wrong itself.
    fn usable(&self, given: &[OsString], alone: Arguments) -> Result<(Arguments, Self), clap::Error> {
        let mut arguments = alone;
        let (mut taken, mut left) = (Self { options: Vec::new(), behind: self.behind }, self.options.clone());
        // What one needs may come later.
        loop {
            let before = left.len();
            let mut others = Vec::new();
            for option in left {
                taken.options.push(option);
                match Arguments::try_parse_from(taken.beside(given)) {
                    Ok(found) => arguments = found,
                    Err(error) => {
                        others.extend(taken.options.pop());
                        let needs = [ErrorKind::MissingRequiredArgument, ErrorKind::ArgumentConflict];
                        if !needs.contains(&error.kind()) {
                            return Err(error);
                        }
                    }
                }
            }
            if others.is_empty() || others.len() == before {
                return Ok((arguments, taken));
            }
            left = others;
        }
    }

    fn beside(&self, given: &[OsString]) -> Vec<OsString> {
        let (before, after) = given.split_at(self.behind + 1);
        let options = self.options.iter().map(OsString::from);
        before.iter().cloned().chain(options).chain(after.iter().cloned()).collect()
    }
}

/// The options in the file that a command line does not give, nor excludes.
fn added(given: &[OsString], file: &ConfigFile) -> Result<Added, CliError> {
    let refused = |what: String| CliError::Input(format!("{}: {what}", file.name()));
    let mut program = Arguments::command();
    program.build();
    let known = |name: &str| program.find_subcommand(name);
    if let Some(name) = file.commands().find(|name| known(name).is_none()) {
        let what = format!("expected the name of a command in [{name}]; `unripple --help` lists them");
        return Err(refused(what));
    }
    let words: Vec<&str> = given.iter().map(|word| word.to_str().unwrap_or_default()).collect();
    let mut commands = (1..words.len()).filter(|at| words[at - 1] != "--set");
    let Some((behind, command)) = commands.find_map(|at| Some((at, known(words[at])?))) else {
        return Ok(Added { options: Vec::new(), behind: 0 });
    };
    let find = |name: &str| {
        let option = command.get_arguments().find(|option| option.get_long() == Some(name));
        option.filter(|option| !["help", "version"].contains(&option.get_id().as_str())).ok_or_else(|| {
            let own = command.get_name();
            refused(format!("`{own}` has no option --{name}; `unripple {own} --help` lists them"))
        })
    };
    let excludes = |one: &Arg, other: &Arg| {
        command.get_arg_conflicts_with(one).contains(&other)
            || command.get_arg_conflicts_with(other).contains(&one)
    };
    // Keys of surfaces are set where there is a surface.
    let has_surface = command.get_positionals().any(|argument| argument.get_id() == "surface");
    let settings = file.settings(command.get_name());
    let mut options = Vec::new();
    for setting in settings.iter().filter(|setting| setting.own || has_surface || setting.option != "set") {
        let option = find(setting.option)?;
        let given_otherwise = command
            .get_arguments()
            .any(|other| (other == option || excludes(option, other)) && is_given(other, command, given));
        let by_own =
            |other: &Setting<'_>| other.own && find(other.option).is_ok_and(|other| excludes(option, other));
        if !given_otherwise && (setting.own || !settings.iter().any(by_own)) {
            options.extend(setting.words(takes(option)).map_err(unusable)?);
        }
    }
    Ok(Added { options, behind })
}

fn takes(option: &Arg) -> Takes {
    match option.get_action() {
        ArgAction::SetTrue => Takes::Nothing,
        ArgAction::Append => Takes::Many,
        _ => Takes::One,
    }
}

/// Whether a command line gives an option, by its long or its short name.
fn is_given(option: &Arg, command: &Command, given: &[OsString]) -> bool {
    given.iter().map(|word| word.to_string_lossy()).take_while(|word| word != "--").any(|word| {
        if let Some(long) = word.strip_prefix("--") {
            return option.get_long() == long.split('=').next();
        }
        // Short names may stand together, as in -qo; the rest of a word is the value of the first that takes one.
        let named = |letter| command.get_arguments().find(|other| other.get_short() == Some(letter));
        let letters = word.strip_prefix('-').unwrap_or_default().chars();
        for other in letters.map_while(named) {
            if other == option {
                return true;
            }
            if other.get_action().takes_values() {
                break;
            }
        }
        false
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<OsString> {
        line.split_whitespace().map(OsString::from).collect()
    }

    fn parsed(text: &str) -> ConfigFile {
        ConfigFile::parse(text, "config.toml").unwrap()
    }

    /// The command line that a file makes of another.
    fn completed(line: &str, file: &str) -> Result<String, CliError> {
        let given = words(line);
        let all = added(&given, &parsed(file))?.beside(&given);
        assert!(Arguments::try_parse_from(&all).is_ok(), "{all:?}");
        Ok(all.join(std::ffi::OsStr::new(" ")).into_string().unwrap())
    }

    /// The options of a file that go with a command line which is good by itself.
    fn usable(line: &str, file: &ConfigFile) -> Result<Vec<String>, clap::Error> {
        let given = words(line);
        let alone = Arguments::try_parse_from(&given).unwrap();
        Ok(added(&given, file).unwrap().usable(&given, alone)?.1.options)
    }

    #[test]
    fn options_of_the_file_stand_where_none_are_given() {
        let file = "quiet = true\n[play]\ndevice = 'jack'\nblock = 128\n[focus]\nat = ['62,90', '40,60']\nwindow-ms = 22.5";
        let cases = [
            ("unripple play film.toml", "unripple play --quiet --block=128 --device=jack film.toml"),
            (
                "unripple play film.toml --device virtual -v",
                "unripple play --block=128 film.toml --device virtual -v",
            ),
            ("unripple -q play film.toml --block=64", "unripple -q play --device=jack film.toml --block=64"),
            ("unripple design film.toml", "unripple design --quiet film.toml"),
            (
                "unripple focus film.toml -o out",
                "unripple focus --quiet --at=62,90 --at=40,60 --window-ms=22.5 film.toml -o out",
            ),
        ];
        for (line, wanted) in cases {
            assert_eq!(completed(line, file).unwrap(), wanted);
        }
    }

    #[test]
    fn what_the_command_line_excludes_is_left_out() {
        let file = "[focus]\npeak-um = 4\noutput = 'out'\nno-figures = false";
        let wanted = "unripple focus --output=out film.toml --at 62,90 --felt-db 20";
        assert_eq!(completed("unripple focus film.toml --at 62,90 --felt-db 20", file).unwrap(), wanted);
    }

    #[test]
    fn what_a_command_says_goes_before_what_is_said_for_all() {
        let file = "quiet = true\nset = ['sheet.tension_n_per_m=220']\n[play]\nquiet = false\n[focus]\nverbose = true\n[modes]\nquiet = true";
        let cases = [
            ("unripple play film.toml", "unripple play --set=sheet.tension_n_per_m=220 film.toml"),
            (
                "unripple focus film.toml -oquick",
                "unripple focus --set=sheet.tension_n_per_m=220 --verbose film.toml -oquick",
            ),
            ("unripple modes film.toml", "unripple modes --set=sheet.tension_n_per_m=220 --quiet film.toml"),
            ("unripple materials", "unripple materials --quiet"),
        ];
        for (line, wanted) in cases {
            assert_eq!(completed(line, file).unwrap(), wanted);
        }
    }

    #[test]
    fn options_that_need_others_come_with_them_alone() {
        let file = parsed("[fit]\ngrid-mm = 5\n[play]\nsnr-db = 40\nunknowns = 1");
        for (line, wanted) in [
            ("unripple fit rig.zarr", vec![]),
            ("unripple fit rig.zarr -o fitted.zarr", vec!["--grid-mm=5"]),
            ("unripple play film.toml", vec!["--unknowns=1", "--snr-db=40"]),
        ] {
            let mut options = usable(line, &file).unwrap();
            options.sort_unstable_by(|a, b| b.cmp(a));
            assert_eq!(options, wanted, "{line}");
        }
        let wrong = parsed("[fit]\nstrays = 'many'");
        assert!(usable("unripple fit rig.zarr", &wrong).is_err());
    }

    #[test]
    fn what_no_command_knows_is_refused() {
        let cases = [
            ("[plai]\nblock = 1", "[plai]"),
            ("[play]\nblok = 1", "no option --blok"),
            ("block = 64", "`focus` has no option --block"),
            ("quiet = 1", "quiet: expected true or false, found 1"),
            ("[focus]\nat = [[62, 90]]", "at: expected a list of texts or numbers"),
            ("[focus]\nmethod = ['felt']", "method: expected a text or a number"),
        ];
        for (file, wanted) in cases {
            let line = if file.contains("play") {
                "unripple play film.toml"
            } else {
                "unripple focus film.toml -o out"
            };
            let refused = added(&words(line), &parsed(file)).unwrap_err().to_string();
            assert!(refused.contains(wanted), "{refused}");
        }
    }
}
