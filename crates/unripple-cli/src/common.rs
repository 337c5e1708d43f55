//! What can be typed with every command: how it prints, and keys of the surface file that are set otherwise.

use crate::args::Arguments;
use crate::error::CliError;
use std::collections::BTreeMap;
use unripple_tasks::SurfaceAsk;

/// What was typed that is no command's own.
pub struct Common {
    /// Whether one JSON object is printed.
    pub json: bool,
    set: BTreeMap<String, String>,
}

impl Common {
    /// What was typed.
    ///
    /// # Errors
    /// [`CliError::Input`] of `--set` without a key and a value, or with one key twice.
    pub fn of(arguments: &Arguments) -> Result<Self, CliError> {
        let mut set = BTreeMap::new();
        for text in &arguments.set {
            let refused = |expected: &str| CliError::Input(format!("--set {text}: expected {expected}"));
            let (key, value) = text
                .split_once('=')
                .filter(|(key, _)| !key.trim().is_empty())
                .ok_or_else(|| refused("KEY=VALUE, as in sheet.tension_n_per_m=220"))?;
            if set.insert(key.trim().to_owned(), value.trim().to_owned()).is_some() {
                return Err(refused("each key once"));
            }
        }
        Ok(Self { json: arguments.json, set })
    }

    /// The surface of this name, with the keys that were set.
    pub fn surface(&self, name: &str) -> SurfaceAsk {
        match self.set.is_empty() {
            true => SurfaceAsk::Name(name.into()),
            false => SurfaceAsk::Set { name: name.into(), set: self.set.clone() },
        }
    }

    /// Refuses `--set` for a command that reads no surface file.
    ///
    /// # Errors
    /// [`CliError::Input`].
    pub fn without_surface(&self) -> Result<(), CliError> {
        match self.set.is_empty() {
            true => Ok(()),
            false => Err(CliError::Input("--set: expected a command that reads a surface file".into())),
        }
    }
}
