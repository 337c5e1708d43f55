//! SHA-256 of files and folders.

use crate::TaskError;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// SHA-256 of bytes, as hexadecimal digits.
pub fn of_bytes(bytes: &[u8]) -> String {
    digits(Sha256::new_with_prefix(bytes))
}

/// SHA-256, as hexadecimal digits, of a file's bytes; for a folder, of the names, lengths and bytes of all
/// its files, in the order of their names.
///
/// # Errors
/// [`TaskError::Input`] of what cannot be read.
pub fn of_path(path: &Path) -> Result<String, TaskError> {
    let refused = |error: io::Error| TaskError::Input(format!("{}: {error}", path.display()));
    let mut hash = Sha256::new();
    if !path.is_dir() {
        copy(path, &mut hash).map_err(refused)?;
        return Ok(digits(hash));
    }
    let mut files = Vec::new();
    list(path, &mut files).map_err(refused)?;
    files.sort();
    for file in files {
        let name = file.strip_prefix(path).unwrap_or(&file).to_string_lossy().into_owned();
        let length = file.metadata().map_err(refused)?.len();
        hash.update(format!("{name}\0{length}\0"));
        copy(&file, &mut hash).map_err(refused)?;
    }
    Ok(digits(hash))
}

fn copy(path: &Path, hash: &mut Sha256) -> io::Result<()> {
    let mut file = File::open(path)?;
    // A library's files have some kilobytes each, recordings some megabytes.
    let mut buffer = vec![0; 1 << 16];
    loop {
        match io::Read::read(&mut file, &mut buffer)? {
            0 => return Ok(()),
            n => hash.update(&buffer[..n]),
        }
    }
}

fn list(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        match entry.file_type()?.is_dir() {
            true => list(&entry.path(), files)?,
            false => files.push(entry.path()),
        }
    }
    Ok(())
}

fn digits(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        assert_eq!(of_bytes(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn a_folder_is_what_its_files_are() {
        let folder = std::env::temp_dir().join(format!("unripple-hash-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("c/0")).unwrap();
        std::fs::write(folder.join("c/0/1"), b"one").unwrap();
        std::fs::write(folder.join("zarr.json"), b"{}").unwrap();
        let before = of_path(&folder).unwrap();
        assert_eq!(before, of_path(&folder).unwrap());
        // The same bytes under another name are another folder.
        std::fs::rename(folder.join("c/0/1"), folder.join("c/0/2")).unwrap();
        assert_ne!(before, of_path(&folder).unwrap());
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(of_path(&folder).is_err());
    }
}
