//! Files written so that a crash loses nothing.

use crate::StoreError;
use crate::underway::{Underway, What};
use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// What ends the name of a file that is being written.
pub(crate) const PART: &str = ".part";

/// Writes a file so that it survives a crash right after: beside its place, onto the medium, then renamed.
///
/// The name itself is on the medium after [`sync_folder`].
pub(crate) fn write(path: &Path, parts: &[&[u8]]) -> Result<(), StoreError> {
    let beside = beside(path);
    let (underway, mut file) = Underway::begin(|entry| {
        // A file that is there was left by a killed process: only one process writes at a time.
        let file = File::create(&beside)?;
        entry.what = What::File(beside.clone());
        Ok(file)
    })
    .map_err(StoreError::write(path))?;
    let filled = parts.iter().try_for_each(|bytes| file.write_all(bytes)).and_then(|()| file.sync_all());
    filled.map_err(StoreError::write(path))?;
    let put = underway.held(|entry| fs::rename(&beside, path).map(|()| entry.finish()));
    put.map_err(StoreError::write(path))
}

/// Removes what killed processes were writing into a folder.
pub(crate) fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let part = entry.file_name().to_str().is_some_and(|name| {
            name.strip_suffix(PART).is_some_and(|name| name == "zarr.json" || name.starts_with("c"))
        });
        if part && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            // It does no harm where it is.
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(PART);
    path.with_file_name(name)
}

/// Puts the names in a folder onto the medium.
pub(crate) fn sync_folder(folder: &Path) -> Result<(), StoreError> {
    // Only Unix lets a folder be opened, and needs it.
    if cfg!(unix) {
        File::open(folder).and_then(|file| file.sync_all()).map_err(StoreError::write(folder))?;
    }
    Ok(())
}

/// Bytes of a regular file of exactly this size; nothing is read of one of another.
pub(crate) fn read_sized(path: &Path, size: u64) -> Result<Vec<u8>, StoreError> {
    let (mut file, found) = open(path)?;
    if found != size {
        let expected = format!("{size} bytes");
        return Err(StoreError::content(&path.display().to_string(), expected, format!("{found} bytes")));
    }
    take(&mut file, path, size)
}

/// Bytes of a regular file of at most this size.
pub(crate) fn read_bounded(path: &Path, most: u64) -> Result<Vec<u8>, StoreError> {
    let (mut file, found) = open(path)?;
    if found > most {
        let expected = format!("at most {most} bytes");
        return Err(StoreError::content(&path.display().to_string(), expected, format!("{found} bytes")));
    }
    take(&mut file, path, found)
}

fn open(path: &Path) -> Result<(File, u64), StoreError> {
    // Asked before it is opened: opening a pipe waits for a writer.
    let metadata = fs::metadata(path).map_err(StoreError::read(path))?;
    if !metadata.is_file() {
        return Err(StoreError::content(&path.display().to_string(), "a file", "something else"));
    }
    let file = File::open(path).map_err(StoreError::read(path))?;
    let size = file.metadata().map_err(StoreError::read(path))?.len();
    Ok((file, size))
}

fn take(file: &mut File, path: &Path, size: u64) -> Result<Vec<u8>, StoreError> {
    let memory = |_| StoreError::read(path)(std::io::ErrorKind::OutOfMemory.into());
    let length = usize::try_from(size).map_err(|_| memory(()))?;
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length).map_err(|_| memory(()))?;
    file.take(size).read_to_end(&mut bytes).map_err(StoreError::read(path))?;
    if bytes.len() != length {
        let found = format!("{} bytes", bytes.len());
        return Err(StoreError::content(&path.display().to_string(), format!("{size} bytes"), found));
    }
    Ok(bytes)
}
