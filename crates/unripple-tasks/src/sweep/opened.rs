//! Opens a folder that belongs to one plan, that of a sweep or of a search.

use crate::TaskError;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use unripple_store::StoreError;

/// File with the plan that the rows are of.
const KEPT: &str = "plan.json";

/// Folder of the shards that are done: a file of rows for each.
pub(super) const PARTS: &str = "parts";

/// Turns an error of the system into one that says what could not be written.
pub(crate) fn failed(path: &Path) -> impl Fn(std::io::Error) -> TaskError + use<> {
    let path = path.to_path_buf();
    move |reason| StoreError::Write { path: path.clone(), reason }.into()
}

/// Opens the folder of a plan by its SHA-256, or begins it where nothing is yet: `begin` writes the file that makes a folder that of a
/// plan.
///
/// # Errors
/// [`TaskError::Input`] if the folder is of another plan; [`TaskError::Work`] if other things are in it or it cannot be written to.
pub(crate) fn opened(
    path: &Path,
    sha256: &str,
    begin: &dyn Fn(&Path) -> Result<(), TaskError>,
) -> Result<(), TaskError> {
    fs::create_dir_all(path).map_err(failed(path))?;
    let kept = path.join(KEPT);
    loop {
        match fs::read_to_string(&kept) {
            Ok(text) => return is_of(path, sha256, &text),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(failed(&kept)(error)),
            // Another process may have begun it meanwhile.
            Err(_) => match guest(path)? {
                Some(_) if kept.exists() => {}
                Some(found) => return Err(occupied(path, found)),
                None => begin(&kept)?,
            },
        }
    }
}

/// Refuses a folder whose rows are those of another plan.
fn is_of(path: &Path, sha256: &str, text: &str) -> Result<(), TaskError> {
    let kept: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
    match kept["sha256"].as_str() {
        Some(found) if found == sha256 => Ok(()),
        found => Err(TaskError::Input(format!(
            "{}: expected rows of this plan on this surface (SHA-256 {sha256}), found those of another ({}); name another folder",
            path.display(),
            found.unwrap_or("unknown")
        ))),
    }
}

/// Something in a folder that is not what a plan begins with; `None` if nothing is there.
fn guest(path: &Path) -> Result<Option<String>, TaskError> {
    let hidden = format!(".{KEPT}.");
    for entry in fs::read_dir(path).map_err(failed(path))? {
        let name = entry.map_err(failed(path))?.file_name().to_string_lossy().into_owned();
        // Programs that call shards may make the folders of what they expect.
        let expected =
            name == PARTS && fs::read_dir(path.join(PARTS)).is_ok_and(|mut parts| parts.next().is_none());
        if !expected && !name.starts_with(&hidden) {
            return Ok(Some(name));
        }
    }
    Ok(None)
}

fn occupied(path: &Path, found: String) -> TaskError {
    let expected = "no such folder yet, an empty one, or that of the same plan";
    StoreError::Occupied { path: path.into(), expected, found: format!("a folder with `{found}`") }.into()
}
