//! Options common to all commands: how results are printed, and keys of the surface file that are changed.

use crate::error::CliError;
use std::collections::BTreeMap;
use unripple_tasks::SurfaceAsk;
use unripple_tasks::text_forms::key_and_value;

/// The options that are common to all commands.
pub struct Common {
    /// Whether the report is printed as one JSON object.
    pub json: bool,
    set: BTreeMap<String, String>,
}

impl Common {
    /// Reads the common options: `--json`, `--set` and `--accuracy`.
    ///
    /// # Errors
    /// [`CliError::Input`] of `--set` without a key and a value, or with one key twice.
    pub fn of(json: bool, keys: &[String], accuracy: Option<&str>) -> Result<Self, CliError> {
        let mut set = BTreeMap::new();
        for text in keys {
            let refused = |expected: &str| CliError::Input(format!("--set {text}: expected {expected}"));
            let (key, value) =
                key_and_value(text).ok_or_else(|| refused("KEY=VALUE, as in sheet.tension_n_per_m=220"))?;
            if set.insert(key.to_owned(), value.to_owned()).is_some() {
                return Err(refused("each key once"));
            }
        }
        if let Some(accuracy) = accuracy
            && set.insert("accuracy".into(), accuracy.into()).is_some()
        {
            return Err(CliError::Input("--accuracy: expected once, found --set accuracy as well".into()));
        }
        Ok(Self { json, set })
    }

    /// The surface of this name, with the changed keys.
    pub fn surface(&self, name: &str) -> SurfaceAsk {
        match self.set.is_empty() {
            true => SurfaceAsk::Name(name.into()),
            false => SurfaceAsk::Set { name: name.into(), set: self.set.clone() },
        }
    }

    /// The surface of this name, with the changed keys and one more; `None` if that is among them.
    pub fn surface_with(&self, name: &str, key: &str, value: &str) -> Option<SurfaceAsk> {
        let mut set = self.set.clone();
        let before = set.insert(key.to_owned(), value.to_owned());
        before.is_none().then(|| SurfaceAsk::Set { name: name.into(), set })
    }

    /// The accuracy of `--accuracy`, for a command that reads no surface file and still computes modes; `--set` is refused.
    ///
    /// # Errors
    /// [`CliError::Input`] of `--set`, or of an accuracy that is no number.
    pub fn accuracy_alone(&self) -> Result<Option<f64>, CliError> {
        if self.set.keys().any(|key| key != "accuracy") {
            self.without_surface()?;
        }
        let Some(text) = self.set.get("accuracy") else { return Ok(None) };
        let refused = || CliError::Input(format!("--accuracy {text}: expected a ratio from 1e-12 to 0.1"));
        text.parse().map(Some).map_err(|_| refused())
    }

    /// Refuses `--set` for a command that reads no surface file.
    ///
    /// # Errors
    /// [`CliError::Input`].
    pub fn without_surface(&self) -> Result<(), CliError> {
        match self.set.is_empty() {
            true => Ok(()),
            false => {
                let option =
                    if self.set.keys().all(|key| key == "accuracy") { "--accuracy" } else { "--set" };
                Err(CliError::Input(format!("{option}: expected a command that reads a surface file")))
            }
        }
    }
}
