//! The surface of a plan, which each design changes in its own way.

use crate::record::{of_bytes, of_path};
use crate::{SurfaceAsk, TaskError};
use std::path::{Path, PathBuf};
use unripple_store::{BUILTINS, LARGEST_TEXT, Library, plan_surface, set_keys, surface_files};

/// The surface that a plan names.
#[derive(Clone, Debug)]
pub(super) enum Ground {
    /// A surface file, read once.
    Text {
        /// Name of the file in messages, as the plan has it.
        name: String,
        /// Text of the file.
        toml: String,
    },
    /// A surface that other files belong to, or a library of responses, by its path.
    Named(String),
}

impl Ground {
    /// The surface that a plan in this folder names, and the SHA-256 of the files that it is read from, in
    /// hexadecimal digits.
    ///
    /// # Errors
    /// [`TaskError::Input`] if there is no such surface or it cannot be read.
    pub fn of(folder: &Path, surface: &str) -> Result<(Self, String), TaskError> {
        if let Some(builtin) = BUILTINS.iter().find(|builtin| builtin.name == surface) {
            let ground = Self::Text { name: builtin.name.into(), toml: builtin.text.into() };
            return Ok((ground, of_bytes(builtin.text.as_bytes())));
        }
        let path = path_of(folder, surface);
        if Library::is_at(&path) {
            let hash = of_path(Path::new(&path))?;
            return Ok((Self::Named(path), hash));
        }
        let files = surface_files(&path, &[]);
        let is_small =
            std::fs::metadata(&path).is_ok_and(|file| file.is_file() && file.len() <= LARGEST_TEXT as u64);
        if !is_small {
            // What is not there, is a folder or is too long is refused there, and better.
            SurfaceAsk::Name(path.clone()).load()?;
        }
        if files.len() > 1 {
            let hashes = files.iter().map(|file| of_path(file)).collect::<Result<Vec<_>, _>>()?;
            return Ok((Self::Named(path), of_bytes(hashes.concat().as_bytes())));
        }
        let toml = std::fs::read_to_string(&path)
            .map_err(|error| TaskError::Input(format!("{path}: expected a surface file, found {error}")))?;
        let hash = of_bytes(toml.as_bytes());
        Ok((Self::Text { name: surface.into(), toml }, hash))
    }

    /// The surface with keys of its file set to other values, which are written as in the file.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a path that no key can have.
    pub fn with(&self, keys: Vec<(String, String)>) -> Result<SurfaceAsk, TaskError> {
        Ok(match self {
            Self::Text { name, toml } => {
                SurfaceAsk::Text { toml: set_keys(toml, name, &keys)?, name: Some(name.clone()) }
            }
            Self::Named(path) if keys.is_empty() => SurfaceAsk::Name(path.clone()),
            Self::Named(path) => SurfaceAsk::Set { name: path.clone(), set: keys.into_iter().collect() },
        })
    }
}

/// The folder that a plan's file is in.
pub(super) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Files that the plan in a file reads besides its own; none if it cannot be read, which its reader says.
pub(super) fn reads(plan: &Path) -> Vec<PathBuf> {
    plan_surface(plan).map_or_else(Vec::new, |surface| of_surface(folder(plan), &surface))
}

/// Files that are read for the surface that a plan in this folder names; none for a built-in surface.
fn of_surface(folder: &Path, surface: &str) -> Vec<PathBuf> {
    if BUILTINS.iter().any(|builtin| builtin.name == surface) {
        return Vec::new();
    }
    let path = path_of(folder, surface);
    if Library::is_at(&path) { vec![path.into()] } else { surface_files(&path, &[]) }
}

/// The path of a surface relative to a folder.
fn path_of(folder: &Path, surface: &str) -> String {
    folder.join(surface).to_string_lossy().into_owned()
}
