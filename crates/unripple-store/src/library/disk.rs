use crate::StoreError;
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
    let filled = File::create(&beside).and_then(|mut file| {
        parts.iter().try_for_each(|bytes| file.write_all(bytes))?;
        file.sync_all()
    });
    let written = filled.and_then(|()| fs::rename(&beside, path)).map_err(StoreError::write(path));
    if written.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&beside);
    }
    written
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
