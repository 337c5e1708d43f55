//! A surface in a request: by its name, its file or its text.

use crate::TaskError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use unripple::core::Surface;
use unripple_store::{Library, load_surface_with, parse_surface};

/// A surface in a request: the name of a built-in surface or of a file, such a name with changed keys, or
/// the text of a surface file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum SurfaceAsk {
    /// The name of a built-in surface, or the path of a surface file; for tasks that accept a library of
    /// responses, also its path.
    Name(String),
    /// A surface by its name, with keys of its file set to other values.
    Set {
        /// The name of a built-in surface, or the path of a surface file.
        name: String,
        /// New values by the paths of their keys, such as `sheet.tension_n_per_m`, written as in the file.
        /// An empty value removes the key.
        set: BTreeMap<String, String>,
    },
    /// The text of a surface file.
    Text {
        /// Text of the surface file, in TOML.
        toml: String,
        /// Name of the surface in error messages, such as that of the file it was read from; "surface" if
        /// absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        name: Option<String>,
    },
}

impl Default for SurfaceAsk {
    /// The surface of the paper, `hudin-2012`.
    fn default() -> Self {
        Self::Name("hudin-2012".into())
    }
}

impl From<&str> for SurfaceAsk {
    fn from(name: &str) -> Self {
        Self::Name(name.into())
    }
}

impl From<&String> for SurfaceAsk {
    fn from(name: &String) -> Self {
        Self::Name(name.clone())
    }
}

impl std::fmt::Display for SurfaceAsk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Name(name) | Self::Set { name, .. } => f.write_str(name),
            Self::Text { name, .. } => f.write_str(name.as_deref().unwrap_or("the surface's text")),
        }
    }
}

impl SurfaceAsk {
    /// Pairs of the keys that are set to other values and these values.
    pub(crate) fn keys(&self) -> Vec<(String, String)> {
        match self {
            Self::Set { set, .. } => set.iter().map(|(key, value)| (key.clone(), value.clone())).collect(),
            _ => Vec::new(),
        }
    }

    /// Reads the surface from its file or text.
    ///
    /// # Errors
    /// [`TaskError::Faults`] with all faults of the file or text; [`TaskError::Input`] if there is no surface of that name;
    /// [`TaskError::Ask`] for changed keys of a library.
    pub fn load(&self) -> Result<Surface, TaskError> {
        match self {
            Self::Name(name) => Ok(load_surface_with(name, &[])?),
            Self::Set { name, .. } if Library::is_at(name) => {
                Err(TaskError::ask("set", "a surface file, whose keys it sets", "a library"))
            }
            Self::Set { name, .. } => Ok(load_surface_with(name, &self.keys())?),
            Self::Text { toml, name } => parse_surface(toml, name.as_deref().unwrap_or("surface"))
                .map_err(|faults| TaskError::Faults(Box::new(faults))),
        }
    }
}
