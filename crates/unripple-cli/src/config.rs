//! The configuration file: options that commands have where the command line gives none.

use crate::args::Arguments;
use crate::error::CliError;
use clap::error::{ContextKind, ErrorKind};
use clap::{Arg, ArgAction, Command, CommandFactory, Parser};
use std::ffi::OsString;
use std::path::PathBuf;
use toml::{Table, Value};

/// The variable that names another file than the usual one; empty for none.
const VARIABLE: &str = "UNRIPPLE_CONFIG";

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
    let Some(path) = place()? else {
        return Ok((alone?, None));
    };
    let shown = path.display().to_string();
    let refused = |what: String| CliError::Input(format!("{shown}: {what}"));
    let text = std::fs::read_to_string(&path).map_err(|error| refused(error.to_string()))?;
    let table: Table = text.parse().map_err(|error: toml::de::Error| refused(error.to_string()))?;
    let added = added(given, &table).map_err(refused)?;
    let told = |added: &Added| {
        Some(format!("{shown}: {}", added.options.join(" "))).filter(|_| !added.options.is_empty())
    };
    match Arguments::try_parse_from(added.beside(given)) {
        Ok(arguments) => Ok((arguments, told(&added))),
        Err(error) if added.is_at_fault(&error) => Err(refused(first_line(&error))),
        Err(error) => {
            let Ok(alone) = alone else { return Err(error.into()) };
            let usable = added.usable(given, alone).map_err(|error| refused(first_line(&error)))?;
            Ok((usable.0, told(&usable.1)))
        }
    }
}

fn first_line(error: &clap::Error) -> String {
    let text = error.to_string();
    text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
}

fn asks_for_help(error: &clap::Error) -> bool {
    let help = ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) || error.kind() == help
}

/// The file, if there is one: the one that the variable names, or the one in the user's folder of configurations.
fn place() -> Result<Option<PathBuf>, CliError> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    if let Some(named) = std::env::var_os(VARIABLE) {
        let path = PathBuf::from(named);
        return match path.as_os_str().is_empty() {
            true => Ok(None),
            // A pipe is as good as a file.
            false if path.exists() && !path.is_dir() => Ok(Some(path)),
            false => Err(CliError::Input(format!("{VARIABLE}: expected a file, found {}", path.display()))),
        };
    }
    let folder = match cfg!(windows) {
        true => set("APPDATA").map(PathBuf::from),
        false => set("XDG_CONFIG_HOME")
            .map(PathBuf::from)
            .or_else(|| set("HOME").map(|home| PathBuf::from(home).join(".config"))),
    };
    Ok(folder.map(|folder| folder.join("unripple").join("config.toml")).filter(|path| path.is_file()))
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
fn added(given: &[OsString], table: &Table) -> Result<Added, String> {
    let mut program = Arguments::command();
    program.build();
    let known = |name: &str| program.find_subcommand(name);
    for (key, value) in table {
        if value.is_table() && known(key).is_none() {
            return Err(format!("expected the name of a command in [{key}]; `unripple --help` lists them"));
        }
    }
    let words: Vec<&str> = given.iter().map(|word| word.to_str().unwrap_or_default()).collect();
    let mut commands = (1..words.len()).filter(|at| words[at - 1] != "--set");
    let Some((behind, command)) = commands.find_map(|at| Some((at, known(words[at])?))) else {
        return Ok(Added { options: Vec::new(), behind: 0 });
    };
    let own = table.get(command.get_name()).and_then(Value::as_table);
    let has_surface = command.get_positionals().any(|argument| argument.get_id() == "surface");
    // What a command's own table says goes before what is said for all; and surfaces are changed where there is one.
    let general = table.iter().filter(|(key, value)| {
        !value.is_table() && !own.is_some_and(|own| own.contains_key(*key)) && (has_surface || *key != "set")
    });
    let own: Vec<_> = own.into_iter().flatten().map(|(key, value)| (key, value, true)).collect();
    let find = |key: &str| {
        let option = command.get_arguments().find(|option| option.get_long() == Some(key));
        option.filter(|option| !["help", "version"].contains(&option.get_id().as_str())).ok_or_else(|| {
            let name = command.get_name();
            format!("`{name}` has no option --{key}; `unripple {name} --help` lists them")
        })
    };
    let excludes = |one: &Arg, other: &Arg| {
        command.get_arg_conflicts_with(one).contains(&other)
            || command.get_arg_conflicts_with(other).contains(&one)
    };
    let mut options = Vec::new();
    for (key, value, is_own) in general.map(|(key, value)| (key, value, false)).chain(own.iter().copied()) {
        let option = find(key)?;
        let given_otherwise = command
            .get_arguments()
            .any(|other| (other == option || excludes(option, other)) && is_given(other, command, given));
        let by_own =
            |(other, _, _): &(&String, &Value, bool)| find(other).is_ok_and(|other| excludes(option, other));
        if !given_otherwise && (is_own || !own.iter().any(by_own)) {
            options.extend(spelled(key, value, option)?);
        }
    }
    Ok(Added { options, behind })
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

/// An entry of the file as words of a command line.
fn spelled(key: &str, value: &Value, option: &Arg) -> Result<Vec<String>, String> {
    let is_flag = matches!(option.get_action(), ArgAction::SetTrue);
    let one = |value: &Value| match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        Value::Float(number) => Some(number.to_string()),
        _ => None,
    };
    match value {
        Value::Boolean(on) if is_flag => Ok(on.then(|| format!("--{key}")).into_iter().collect()),
        _ if is_flag => Err(format!("{key}: expected true or false, found {value}")),
        Value::Array(values) if matches!(option.get_action(), ArgAction::Append) => {
            let all: Option<Vec<_>> =
                values.iter().map(|value| Some(format!("--{key}={}", one(value)?))).collect();
            all.ok_or_else(|| format!("{key}: expected a list of texts or numbers, found {value}"))
        }
        _ => match one(value) {
            Some(text) => Ok(vec![format!("--{key}={text}")]),
            None => Err(format!("{key}: expected a text or a number, found {value}")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<OsString> {
        line.split_whitespace().map(OsString::from).collect()
    }

    /// The command line that a file makes of another.
    fn completed(line: &str, file: &str) -> Result<String, String> {
        let given = words(line);
        let all = added(&given, &file.parse().unwrap())?.beside(&given);
        assert!(Arguments::try_parse_from(&all).is_ok(), "{all:?}");
        Ok(all.join(std::ffi::OsStr::new(" ")).into_string().unwrap())
    }

    /// The options of a file that go with a command line which is good by itself.
    fn usable(line: &str, file: &Table) -> Result<Vec<String>, clap::Error> {
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
        let file = "[fit]\ngrid-mm = 5\n[play]\nsnr-db = 40\nunknowns = 1".parse().unwrap();
        for (line, wanted) in [
            ("unripple fit rig.zarr", vec![]),
            ("unripple fit rig.zarr -o fitted.zarr", vec!["--grid-mm=5"]),
            ("unripple play film.toml", vec!["--unknowns=1", "--snr-db=40"]),
        ] {
            let mut options = usable(line, &file).unwrap();
            options.sort_unstable_by(|a, b| b.cmp(a));
            assert_eq!(options, wanted, "{line}");
        }
        let wrong = "[fit]\nstrays = 'many'".parse().unwrap();
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
            let refused = added(&words(line), &file.parse().unwrap()).unwrap_err();
            assert!(refused.contains(wanted), "{refused}");
        }
    }
}
