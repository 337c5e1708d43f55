//! Effects by name or file.

use super::{builtin_effects, import_haptic, near, parse_effects};
use crate::StoreError;
use crate::document::stem;
use crate::file::read_text;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use unripple_effects::{Effect, EffectSet, Kind, Region};

/// Endings of files that are imported rather than read.
const IMPORTED: [&str; 3] = ["haptic", "ahap", "hjif"];

/// Loads the built-in effects with this name, or else the effects in the file at this path: TOML, or one of
/// the formats of [`import_haptic`], whose effects are played where a finger touches and for as long as it
/// stays.
///
/// A file that happens to have a built-in's name is reached as `./name`.
///
/// # Errors
/// [`StoreError::Content`] if there is neither, with the nearest built-in name, or if an imported file is invalid;
/// [`StoreError::Surface`] with all faults of a TOML file; [`StoreError::Read`] if it cannot be read.
///
/// ```
/// let rain = unripple_store::load_effects("rain")?;
/// assert_eq!(rain.name, "Rain");
/// let error = unripple_store::load_effects("sandpapr").unwrap_err();
/// assert!(error.to_string().contains("(nearest: sandpaper)"));
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn load_effects(name_or_path: &str) -> Result<EffectSet, StoreError> {
    if let Some(builtin) = builtin_effects().iter().find(|builtin| builtin.name == name_or_path) {
        return Ok(parse_effects(builtin.text, builtin.name)?);
    }
    let path = Path::new(name_or_path);
    let text = read_text(path).map_err(|error| match error {
        StoreError::Read { reason, .. } if reason.kind() == ErrorKind::NotFound => unknown(name_or_path),
        other => other,
    })?;
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !IMPORTED.contains(&ending.as_str()) {
        return Ok(parse_effects(&text, name_or_path)?);
    }
    let (name, kind) = (stem(name_or_path), Kind::Score(import_haptic(&text, name_or_path)?));
    let effect =
        Effect { name: name.clone(), region: Region::Everywhere, level: super::level::DEFAULT, kind };
    Ok(EffectSet { name, about: String::new(), effects: vec![effect] })
}

/// The file that [`load_effects`] reads for a name; none for built-in effects.
pub fn effect_files(name_or_path: &str) -> Vec<PathBuf> {
    let known = builtin_effects().iter().any(|builtin| builtin.name == name_or_path);
    if known { Vec::new() } else { vec![name_or_path.into()] }
}

fn unknown(name: &str) -> StoreError {
    let names: Vec<&str> = builtin_effects().iter().map(|builtin| builtin.name).collect();
    let expected = format!("a file, or one of {}{}", names.join(", "), near(name, &names));
    StoreError::content(name, expected, "no such file")
}
