//! Surfaces by name or file.

use crate::document::{too_large, whole};
use crate::file::{LARGEST_TEXT, read_start, read_text};
use crate::names::nearest;
use crate::surface::parse_surface_with;
use crate::{BUILTINS, FileFaults, StoreError, set_keys};
use std::cell::RefCell;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use unripple_core::Surface;

/// Loads the built-in surface with this name, or else the surface file at this path.
///
/// A file that happens to have a built-in's name is reached as `./name`. An outline's `svg` is relative to the file.
///
/// # Errors
/// [`StoreError::UnknownSurface`] if there is neither, with the nearest built-in name; [`StoreError::Surface`] with all
/// faults of the file; [`StoreError::Read`] if it cannot be read.
///
/// ```
/// let film = unripple_store::load_surface("hudin-2012")?;
/// assert_eq!(film.sheet.tension, 200.0);
/// let error = unripple_store::load_surface("hudin-2021").unwrap_err();
/// assert!(error.to_string().ends_with("(nearest: hudin-2012)"));
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn load_surface(name_or_path: &str) -> Result<Surface, StoreError> {
    load_surface_with(name_or_path, &[])
}

/// As [`load_surface`], with keys of the surface file first set to other values ([`set_keys`]).
///
/// # Errors
/// Those of [`load_surface`] and [`set_keys`]. Lines of faults refer to the text after the keys were set.
pub fn load_surface_with(name_or_path: &str, keys: &[(String, String)]) -> Result<Surface, StoreError> {
    if let Some(builtin) = BUILTINS.iter().find(|b| b.name == name_or_path) {
        let text = set_keys(builtin.text, builtin.name, keys)?;
        return Ok(crate::parse_surface(&text, builtin.name)?);
    }
    let path = Path::new(name_or_path);
    let bytes = match read_start(path) {
        Err(StoreError::Read { reason, .. }) if reason.kind() == ErrorKind::NotFound => {
            return Err(unknown(name_or_path));
        }
        read => read?,
    };
    let text = decode(name_or_path, &bytes)?;
    let text = set_keys(text, name_or_path, keys)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    Ok(parse_surface_with(&text, name_or_path, &|svg| read_drawing(folder, svg))?)
}

/// The text of the SVG file that a surface file in `folder` calls `svg`, as [`load_surface`] reads it.
///
/// # Errors
/// [`StoreError::Content`] if there is no such file, or it is no text of at most 1 MiB; [`StoreError::Read`] if it cannot be read.
pub fn read_drawing(folder: &Path, svg: &str) -> Result<String, StoreError> {
    let file = folder.join(svg);
    read_text(&file).map_err(|error| match error {
        StoreError::Read { reason, .. } if reason.kind() == ErrorKind::NotFound => {
            StoreError::content(svg, "an SVG file", format!("no file {}", file.display()))
        }
        other => other,
    })
}

/// The files that [`load_surface_with`] reads for a name: none for a built-in surface, else the surface file and the SVG files that it
/// names.
pub fn surface_files(name_or_path: &str, keys: &[(String, String)]) -> Vec<PathBuf> {
    if BUILTINS.iter().any(|b| b.name == name_or_path) {
        return Vec::new();
    }
    let path = Path::new(name_or_path);
    let files = RefCell::new(vec![path.to_path_buf()]);
    let folder = path.parent().unwrap_or(Path::new(""));
    if let Ok(text) = read_text(path).and_then(|text| set_keys(&text, name_or_path, keys)) {
        // Faults of the file are reported by whoever loads it.
        let _ = parse_surface_with(&text, name_or_path, &|svg| {
            let file = folder.join(svg);
            files.borrow_mut().push(file.clone());
            read_text(&file)
        });
    }
    files.into_inner()
}

fn decode<'b>(file: &str, bytes: &'b [u8]) -> Result<&'b str, FileFaults> {
    if bytes.len() > LARGEST_TEXT {
        return Err(too_large(file));
    }
    std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to();
        let found = format!("the byte 0x{:02x}", bytes.get(at).copied().unwrap_or_default());
        whole(file, &String::from_utf8_lossy(bytes), at, &found, "text in UTF-8")
    })
}

fn unknown(name: &str) -> StoreError {
    let names: Vec<&str> = BUILTINS.iter().map(|b| b.name).collect();
    let nearest = nearest(name, names.iter().copied()).map(str::to_owned);
    StoreError::UnknownSurface { name: name.into(), builtins: names.join(", "), nearest }
}
