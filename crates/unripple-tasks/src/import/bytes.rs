//! The bytes of files that are read whole.

use crate::TaskError;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// The bytes of a regular file.
///
/// # Errors
/// [`TaskError::Input`] of a file that cannot be read, or for which there is no memory.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>, TaskError> {
    let refused = |error: std::io::Error| TaskError::Input(format!("{}: {error}", path.display()));
    let metadata = fs::metadata(path).map_err(refused)?;
    if !metadata.is_file() {
        return Err(TaskError::Input(format!("{}: expected a file, found something else", path.display())));
    }
    let mut bytes = Vec::new();
    let room = usize::try_from(metadata.len()).unwrap_or(usize::MAX);
    let memory = |_| refused(std::io::ErrorKind::OutOfMemory.into());
    bytes.try_reserve_exact(room).map_err(memory)?;
    File::open(path).and_then(|file| file.take(metadata.len()).read_to_end(&mut bytes)).map_err(refused)?;
    Ok(bytes)
}
