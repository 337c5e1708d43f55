//! The surface of a plan, which each design changes in its own way.

use crate::record::{of_bytes, of_path};
use crate::{SurfaceAsk, TaskError};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use unripple_store::{
    BUILTINS, LARGEST_TEXT, Library, StoreError, parse_surface_with, read_drawing, set_keys, surface_files,
    to_toml,
};

/// The surface that a plan names.
#[derive(Clone, Debug)]
pub(super) enum Ground {
    /// A surface file, read once.
    Text {
        /// Name of the file in messages, as the plan has it.
        name: String,
        /// Text of the file.
        toml: String,
        /// SVG files that it may name; `None` for a built-in surface, which names none.
        drawings: Option<Drawings>,
    },
    /// A library of responses, by its path.
    Library(String),
}

/// SVG files that a surface file and its designs name, each read once.
#[derive(Clone, Debug)]
pub(super) struct Drawings {
    /// The folder of the surface file.
    folder: PathBuf,
    read: Arc<Mutex<BTreeMap<String, String>>>,
}

impl Drawings {
    /// The text of a file.
    fn text(&self, svg: &str) -> Result<String, StoreError> {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(text) = read.get(svg) {
            return Ok(text.clone());
        }
        let text = read_drawing(&self.folder, svg)?;
        read.insert(svg.to_owned(), text.clone());
        Ok(text)
    }
}

impl Ground {
    /// The surface that a plan in this folder names, and the SHA-256 of the files that it is read from, in
    /// hexadecimal digits.
    ///
    /// # Errors
    /// [`TaskError::Input`] if there is no such surface or it, or an SVG file that it names, cannot be read.
    pub fn of(folder: &Path, surface: &str) -> Result<(Self, String), TaskError> {
        if let Some(builtin) = BUILTINS.iter().find(|builtin| builtin.name == surface) {
            let (name, toml) = (builtin.name.into(), builtin.text.into());
            return Ok((Self::Text { name, toml, drawings: None }, of_bytes(builtin.text.as_bytes())));
        }
        let path = path_of(folder, surface);
        if Library::is_at(&path) {
            let hash = of_path(Path::new(&path))?;
            return Ok((Self::Library(path), hash));
        }
        let is_small =
            std::fs::metadata(&path).is_ok_and(|file| file.is_file() && file.len() <= LARGEST_TEXT as u64);
        if !is_small {
            // What is not there, is a folder or is too long is refused there, and better.
            SurfaceAsk::Name(path.clone()).load()?;
        }
        let toml = std::fs::read_to_string(&path)
            .map_err(|error| TaskError::Input(format!("{path}: expected a surface file, found {error}")))?;
        let drawings = Drawings { folder: self::folder(Path::new(&path)).into(), read: Arc::default() };
        let hash = hash(&toml, surface, &drawings)?;
        Ok((Self::Text { name: surface.into(), toml, drawings: Some(drawings) }, hash))
    }

    /// The folder that SVG files are relative to; `None` of a surface that can name none.
    pub fn folder(&self) -> Option<&Path> {
        match self {
            Self::Text { drawings: Some(drawings), .. } => Some(&drawings.folder),
            Self::Text { drawings: None, .. } | Self::Library(_) => None,
        }
    }

    /// The surface with keys of its file set to other values, which are written as in the file.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a path that no key can have; [`TaskError::Faults`] of a surface with SVG files that has faults.
    pub fn with(&self, keys: Vec<(String, String)>) -> Result<SurfaceAsk, TaskError> {
        let (name, toml, drawings) = match self {
            Self::Library(path) if keys.is_empty() => return Ok(SurfaceAsk::Name(path.clone())),
            Self::Library(path) => {
                return Ok(SurfaceAsk::Set { name: path.clone(), set: keys.into_iter().collect() });
            }
            Self::Text { name, toml, drawings } => (name, set_keys(toml, name, &keys)?, drawings),
        };
        let drawn = Cell::new(false);
        // Most surfaces name no file, and are left to the task to read.
        let toml = match drawings.as_ref().filter(|_| toml.contains("svg")) {
            None => toml,
            Some(drawings) => {
                let fetch = |svg: &str| {
                    drawn.set(true);
                    drawings.text(svg)
                };
                match parse_surface_with(&toml, name, &fetch) {
                    // A surface by its text alone can name no file.
                    Ok(surface) if drawn.get() => to_toml(&surface),
                    Err(faults) if drawn.get() => return Err(TaskError::Faults(Box::new(faults))),
                    Ok(_) | Err(_) => toml,
                }
            }
        };
        Ok(SurfaceAsk::Text { toml, name: Some(name.clone()) })
    }
}

/// SHA-256 of the text of a surface file and of the SVG files that it names.
fn hash(toml: &str, name: &str, drawings: &Drawings) -> Result<String, TaskError> {
    let hashes = RefCell::new(vec![of_bytes(toml.as_bytes())]);
    let refused = RefCell::new(None);
    // Other faults than files that are not there are those of each design.
    let _ = parse_surface_with(toml, name, &|svg| {
        let text = drawings.text(svg);
        match &text {
            Ok(text) => hashes.borrow_mut().push(of_bytes(text.as_bytes())),
            Err(error) => *refused.borrow_mut() = Some(TaskError::Input(format!("{name}: {error}"))),
        }
        text
    });
    match (refused.into_inner(), hashes.into_inner().as_slice()) {
        (Some(error), _) => Err(error),
        (None, [one]) => Ok(one.clone()),
        (None, several) => Ok(of_bytes(several.concat().as_bytes())),
    }
}

/// The folder that a file is in.
pub(super) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// The folder that a plan in a file names its surface and its files from; `named` is the one that the plan says, if it does.
pub(crate) fn origin(plan: &Path, named: Option<&str>) -> PathBuf {
    named.map_or_else(|| folder(plan).to_path_buf(), |named| folder(plan).join(named))
}

/// Files that are read for the surface that a plan in this folder names; none for a built-in surface.
pub(super) fn reads(folder: &Path, surface: &str) -> Vec<PathBuf> {
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
