//! The configuration file of a user: options that commands have where they are given none.

use crate::StoreError;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// The variable that names another file than the usual one; empty for none.
const VARIABLE: &str = "UNRIPPLE_CONFIG";

/// A configuration file: options for all commands at its top, and a table of options for each command that has its own.
///
/// ```
/// use unripple_store::{ConfigFile, Takes};
///
/// let file = ConfigFile::parse("quiet = true\n[play]\nblock = 128", "config.toml")?;
/// let settings = file.settings("play");
/// assert_eq!(settings[0].words(Takes::Nothing)?, ["--quiet"]);
/// assert_eq!(settings[1].words(Takes::One)?, ["--block=128"]);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ConfigFile {
    name: String,
    table: Table,
}

/// An option that a configuration file sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting<'f> {
    /// Long name of the option, without the hyphens before it.
    pub option: &'f str,
    /// Whether it stands in the table of the command rather than at the top of the file.
    pub own: bool,
    file: &'f str,
    value: &'f Value,
}

/// How many values an option has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// None: the file says `true` or `false`.
    Nothing,
    /// One, a text or a number.
    One,
    /// Any number, each by the option once more: one value or a list.
    Many,
}

impl ConfigFile {
    /// Reads the file that the variable `UNRIPPLE_CONFIG` names, or else `unripple/config.toml` in the user's folder of configurations; `None` if
    /// there is no such file, or if the variable is empty.
    ///
    /// # Errors
    /// [`StoreError::Content`] if the variable names no file; those of [`ConfigFile::read`].
    pub fn of_user() -> Result<Option<Self>, StoreError> {
        place()?.map(|path| Self::read(&path)).transpose()
    }

    /// Reads a file, or what comes through a pipe.
    ///
    /// # Errors
    /// [`StoreError::Read`] if it cannot be read; those of [`ConfigFile::parse`].
    pub fn read(path: &Path) -> Result<Self, StoreError> {
        let text = std::fs::read_to_string(path).map_err(StoreError::read(path))?;
        Self::parse(&text, &path.display().to_string())
    }

    /// Parses the text of a file; `name` is that of the file in errors.
    ///
    /// # Errors
    /// [`StoreError::Toml`] with line and column, if it is not TOML.
    pub fn parse(text: &str, name: &str) -> Result<Self, StoreError> {
        let table = text.parse::<Table>();
        let refused =
            |error: toml::de::Error| StoreError::Toml { file: name.into(), fault: error.to_string() };
        Ok(Self { name: name.into(), table: table.map_err(refused)? })
    }

    /// Name of the file in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Names of the commands that have options of their own.
    pub fn commands(&self) -> impl Iterator<Item = &str> {
        self.table.iter().filter(|(_, value)| value.is_table()).map(|(name, _)| name.as_str())
    }

    /// The options of a command: those at the top of the file that its own table leaves, then its own.
    pub fn settings(&self, command: &str) -> Vec<Setting<'_>> {
        let own = self.table.get(command).and_then(Value::as_table);
        let left = |option: &String, value: &Value| {
            !value.is_table() && !own.is_some_and(|own| own.contains_key(option))
        };
        let top = self.table.iter().filter(|(option, value)| left(option, value));
        let all = top.map(|entry| (entry, false)).chain(own.into_iter().flatten().map(|entry| (entry, true)));
        all.map(|((option, value), own)| Setting { option, own, file: &self.name, value }).collect()
    }
}

impl Setting<'_> {
    /// The option as it is typed: `--OPTION`, which is left out where the file says `false`, or `--OPTION=VALUE` for each value.
    ///
    /// # Errors
    /// [`StoreError::Content`] of a value that no option of this kind has.
    pub fn words(&self, takes: Takes) -> Result<Vec<String>, StoreError> {
        let refused = |expected: &str| {
            StoreError::content(&format!("{}: {}", self.file, self.option), expected, self.value.to_string())
        };
        let word = |value: &Value| shown(value).map(|text| format!("--{}={text}", self.option));
        match (takes, self.value) {
            (Takes::Nothing, Value::Boolean(on)) => {
                Ok(on.then(|| format!("--{}", self.option)).into_iter().collect())
            }
            (Takes::Nothing, _) => Err(refused("true or false")),
            (Takes::Many, Value::Array(values)) => {
                let words: Option<Vec<_>> = values.iter().map(word).collect();
                words.ok_or_else(|| refused("a list of texts or numbers"))
            }
            (_, value) => Ok(vec![word(value).ok_or_else(|| refused("a text or a number"))?]),
        }
    }
}

/// A text or a number as it is typed; `None` of anything else.
fn shown(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        Value::Float(number) => Some(number.to_string()),
        _ => None,
    }
}

/// The file, if there is one: the one that the variable names, or the one in the user's folder of configurations.
fn place() -> Result<Option<PathBuf>, StoreError> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    if let Some(named) = std::env::var_os(VARIABLE) {
        let path = PathBuf::from(named);
        return match path.as_os_str().is_empty() {
            true => Ok(None),
            // A pipe is as good as a file.
            false if path.exists() && !path.is_dir() => Ok(Some(path)),
            false => Err(StoreError::content(VARIABLE, "a file", path.display().to_string())),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_command_says_goes_before_what_is_said_for_all() {
        let text = "quiet = true\nset = ['a=1']\n[play]\nquiet = false\nblock = 64\n[focus]\nat = '62,90'";
        let file = ConfigFile::parse(text, "config.toml").unwrap();
        let options = |command: &str| -> Vec<String> {
            let all = file.settings(command).into_iter();
            all.map(|setting| format!("{}{}", setting.option, if setting.own { " of its own" } else { "" }))
                .collect()
        };
        assert_eq!(options("play"), ["set", "block of its own", "quiet of its own"]);
        assert_eq!(options("modes"), ["quiet", "set"]);
        assert_eq!(file.commands().collect::<Vec<_>>(), ["focus", "play"]);
    }

    #[test]
    fn values_are_written_as_they_are_typed() {
        let words = |text: &str, takes| {
            let file = ConfigFile::parse(text, "config.toml").unwrap();
            file.settings("play")[0].words(takes).map_err(|error| error.to_string())
        };
        assert_eq!(words("quiet = false", Takes::Nothing).unwrap(), [""; 0]);
        assert_eq!(words("at = ['62,90', 5]", Takes::Many).unwrap(), ["--at=62,90", "--at=5"]);
        assert_eq!(words("at = '62,90'", Takes::Many).unwrap(), ["--at=62,90"]);
        assert_eq!(words("window-ms = 22.5", Takes::One).unwrap(), ["--window-ms=22.5"]);
        for (text, takes, said) in [
            ("quiet = 1", Takes::Nothing, "config.toml: quiet: expected true or false, found 1"),
            ("at = [[1]]", Takes::Many, "config.toml: at: expected a list of texts or numbers, found [[1]]"),
            ("block = [1]", Takes::One, "config.toml: block: expected a text or a number, found [1]"),
            ("block = true", Takes::One, "config.toml: block: expected a text or a number, found true"),
        ] {
            assert_eq!(words(text, takes).unwrap_err(), said);
        }
    }

    #[test]
    fn a_fault_of_toml_has_its_line_and_column() {
        let said = ConfigFile::parse("quiet = true\nmodes = [\n", "config.toml").unwrap_err().to_string();
        assert!(said.starts_with("config.toml: ") && said.contains("line 2, column "), "{said}");
    }
}
