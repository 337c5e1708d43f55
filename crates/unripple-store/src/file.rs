use crate::StoreError;
use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Largest text file read, in bytes.
pub const LARGEST_TEXT: usize = 1 << 20;

/// Bytes of a file, at most [`LARGEST_TEXT`] and one more: a caller that gets more than the limit refuses it.
pub(crate) fn read_start(path: &Path) -> Result<Vec<u8>, StoreError> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LARGEST_TEXT as u64 + 1).read_to_end(&mut bytes))
        .map_err(StoreError::read(path))?;
    Ok(bytes)
}

/// The text of a regular file of at most [`LARGEST_TEXT`] bytes.
pub(crate) fn read_text(path: &Path) -> Result<String, StoreError> {
    let name = path.display().to_string();
    let metadata = fs::metadata(path).map_err(StoreError::read(path))?;
    if !metadata.is_file() {
        return Err(StoreError::content(&name, "a file", "something else"));
    }
    let bytes = read_start(path)?;
    if bytes.len() > LARGEST_TEXT {
        return Err(too_large(&name, metadata.len()));
    }
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        StoreError::content(&name, "text in UTF-8", format!("another byte at {at}"))
    })
}

pub(crate) fn too_large(name: &str, bytes: u64) -> StoreError {
    StoreError::content(name, format!("at most {LARGEST_TEXT} bytes"), format!("{bytes}"))
}

/// Writes a file whole or not at all: beside its place first, then renamed into it.
///
/// # Errors
/// [`StoreError::Write`] if the folder cannot be written to; whatever was there before is still there.
///
/// ```
/// let path = std::env::temp_dir().join(format!("unripple-doc-{}.txt", std::process::id()));
/// unripple_store::write_file(&path, b"whole")?;
/// assert_eq!(std::fs::read(&path).unwrap(), b"whole");
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn write_file(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), StoreError> {
    let path = path.as_ref();
    write_beside(path, |file| file.write_all(bytes).map_err(StoreError::write(path)))
}

/// Lets `fill` write a new file beside `path`, then renames it into place; nothing is left if either fails.
pub(crate) fn write_beside(
    path: &Path,
    fill: impl FnOnce(&mut File) -> Result<(), StoreError>,
) -> Result<(), StoreError> {
    let beside = sibling(path)?;
    let mut file =
        File::options().write(true).create_new(true).open(&beside).map_err(StoreError::write(path))?;
    let written = fill(&mut file).and_then(|()| fs::rename(&beside, path).map_err(StoreError::write(path)));
    if written.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&beside);
    }
    written
}

/// A hidden name beside `path` that no other call of this process gives.
pub(crate) fn sibling(path: &Path) -> Result<PathBuf, StoreError> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let Some(name) = path.file_name() else {
        return Err(StoreError::Occupied {
            path: path.into(),
            expected: "a path that ends in a name",
            found: "none".into(),
        });
    };
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    let hidden = format!(".{}.unripple-{}-{count}", name.to_string_lossy(), std::process::id());
    Ok(path.with_file_name(hidden))
}
