//! Single files: text that is read, and files that are written whole or not at all.

use crate::StoreError;
use crate::building::Building;
use crate::underway::{Underway, What};
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// Largest text file read, in bytes: 1 MiB, some hundred times a long surface file.
pub const LARGEST_TEXT: usize = 1 << 20;

/// Bytes of a file, at most [`LARGEST_TEXT`] and one more: a caller that gets more than the limit refuses it.
pub(crate) fn read_start(path: &Path) -> Result<Vec<u8>, StoreError> {
    start(path, LARGEST_TEXT)
}

/// Bytes of a file, at most `most` and one more.
fn start(path: &Path, most: usize) -> Result<Vec<u8>, StoreError> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most as u64 + 1).read_to_end(&mut bytes))
        .map_err(StoreError::read(path))?;
    Ok(bytes)
}

/// The text of a regular file of at most [`LARGEST_TEXT`] bytes.
pub(crate) fn read_text(path: &Path) -> Result<String, StoreError> {
    read_text_up_to(path, LARGEST_TEXT)
}

/// The text of a regular file of at most `most` bytes.
pub(crate) fn read_text_up_to(path: &Path, most: usize) -> Result<String, StoreError> {
    let name = path.display().to_string();
    let metadata = fs::metadata(path).map_err(StoreError::read(path))?;
    if !metadata.is_file() {
        return Err(StoreError::content(&name, "a file", "something else"));
    }
    let bytes = start(path, most)?;
    if bytes.len() > most {
        return Err(longer_than(most, &name, metadata.len()));
    }
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        StoreError::content(&name, "text in UTF-8", format!("another byte at {at}"))
    })
}

pub(crate) fn too_large(name: &str, bytes: u64) -> StoreError {
    longer_than(LARGEST_TEXT, name, bytes)
}

fn longer_than(most: usize, name: &str, bytes: u64) -> StoreError {
    StoreError::content(name, format!("at most {most} bytes"), format!("{bytes}"))
}

/// Writes a file completely or not at all: first beside its destination, then renamed into place. If the path is a
/// symbolic link, the file that it leads to is replaced.
///
/// # Errors
/// [`StoreError::Write`] if the folder cannot be written to, [`StoreError::Occupied`] if a device or the like is there;
/// whatever was there before is still there.
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

/// As [`write_file`], for a file that `fill` writes in pieces, and that is flushed to the disk before it gets its name: even after a loss
/// of power the file is complete, or does not exist.
///
/// # Errors
/// Those of [`write_file`], and [`StoreError::Write`] with an error of `fill`.
///
/// ```
/// use std::io::Write;
///
/// let path = std::env::temp_dir().join(format!("unripple-doc-durable-{}.txt", std::process::id()));
/// unripple_store::write_durably(&path, |file| (0..3).try_for_each(|i| writeln!(file, "{i}")))?;
/// assert_eq!(std::fs::read(&path).unwrap(), b"0\n1\n2\n");
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn write_durably(
    path: impl AsRef<Path>,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), StoreError> {
    let path = path.as_ref();
    let durable = |file: &mut File| {
        let mut buffered = BufWriter::new(&mut *file);
        fill(&mut buffered)?;
        buffered.flush()?;
        drop(buffered);
        file.sync_all()
    };
    write_beside(path, |file| durable(file).map_err(StoreError::write(path)))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    // So that its name is on the disk too. Some systems cannot do that to a folder, or need not.
    let _ = File::open(folder.unwrap_or(Path::new("."))).and_then(|folder| folder.sync_all());
    Ok(())
}

/// Name of a file while it is being written, in a hidden folder beside its destination.
const CONTENT: &str = "content";

/// Lets `fill` write a new file beside `path`, then renames it into place; nothing is left if either fails.
pub(crate) fn write_beside(
    path: &Path,
    fill: impl FnOnce(&mut File) -> Result<(), StoreError>,
) -> Result<(), StoreError> {
    let place = replaceable(path)?;
    // A file makes no folders: one that is not there is more likely misspelt than wanted.
    if let Some(folder) = place.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::metadata(folder).map_err(StoreError::write(path))?;
    }
    let building = Building::beside(&place)?;
    let mut file = building.file(CONTENT).map_err(StoreError::write(path))?;
    fill(&mut file)?;
    building.held(|_| fs::rename(building.path().join(CONTENT), &place)).map_err(StoreError::write(path))
}

/// Where a file is to be written: at the end of links. What is neither a file nor a folder is refused.
fn replaceable(path: &Path) -> Result<PathBuf, StoreError> {
    let metadata = match fs::symlink_metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(path.into()),
        other => other.map_err(StoreError::write(path))?,
    };
    let linked = metadata.is_symlink();
    let place = if linked { fs::canonicalize(path).map_err(StoreError::write(path))? } else { path.into() };
    let kind = fs::metadata(&place).map_err(StoreError::write(path))?;
    if kind.is_file() || kind.is_dir() {
        return Ok(place);
    }
    let (expected, found) = ("a file, or none yet", "a device or the like".into());
    Err(StoreError::Occupied { path: path.into(), expected, found })
}

/// Checks whether [`new_file`] could make a file at a path, without making it: for callers that have long work to do
/// before they need the file.
///
/// # Errors
/// [`StoreError::Occupied`] if a file that is not empty, a folder or a link that leads nowhere is there, [`StoreError::Write`] if the
/// place cannot be looked at or its folder is not there.
///
/// ```
/// let path = std::env::temp_dir().join(format!("unripple-doc-check-{}.txt", std::process::id()));
/// unripple_store::check_new_file(&path)?;
/// assert!(!path.exists());
/// std::fs::write(&path, "an afternoon").unwrap();
/// assert!(unripple_store::check_new_file(&path).is_err());
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn check_new_file(path: impl AsRef<Path>) -> Result<(), StoreError> {
    let path = path.as_ref();
    let occupied = |found: &str| StoreError::Occupied {
        path: path.into(),
        expected: "a file that does not exist yet, since recordings are never overwritten",
        found: found.into(),
    };
    match fs::metadata(path) {
        // A pipe, say, which waits for its reader, or a file that was made to have a name.
        Ok(there) if !there.is_dir() && there.len() == 0 => Ok(()),
        Ok(there) => Err(occupied(if there.is_dir() { "a folder" } else { "one that is not empty" })),
        Err(error) if error.kind() != ErrorKind::NotFound => Err(StoreError::write(path)(error)),
        Err(_) if fs::symlink_metadata(path).is_ok() => Err(occupied("a link that leads nowhere")),
        Err(_) => match path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            Some(folder) => fs::metadata(folder).map(|_| ()).map_err(StoreError::write(path)),
            None => Ok(()),
        },
    }
}

/// Opens a new file for data that cannot be made again, such as recorded touches. Nothing but an empty file
/// is overwritten. A file that this function made is removed when the [`Underway`] is dropped, unless
/// [`Underway::keep`] is called.
///
/// # Errors
/// Those of [`check_new_file`], and [`StoreError::Write`] if it cannot be made.
///
/// ```
/// let path = std::env::temp_dir().join(format!("unripple-doc-new-{}.txt", std::process::id()));
/// let (file, underway) = unripple_store::new_file(&path)?;
/// drop(underway);
/// assert!(!path.exists());
/// # drop(file);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn new_file(path: impl AsRef<Path>) -> Result<(File, Underway), StoreError> {
    let path = path.as_ref();
    check_new_file(path)?;
    let mut options = File::options();
    let made = if path.exists() {
        let file = options.write(true).open(path);
        Underway::begin(|_| file)
    } else {
        Underway::begin(|entry| {
            let file = options.write(true).create_new(true).open(path)?;
            entry.what = What::File(path.into());
            Ok(file)
        })
    };
    made.map(|(underway, file)| (file, underway)).map_err(StoreError::write(path))
}
