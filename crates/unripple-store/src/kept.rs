//! Drives that were recorded during play, as WAV files with a signature by which a later run knows that it may
//! replace them.

use crate::building::sweep;
use crate::file::write_beside;
use crate::wav::{encode, into_io, spec};
use crate::{Committed, StoreError};
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use unripple_core::Drive;

/// Bytes of the last chunk: a list with one text, which says what wrote the file.
const TAIL: usize = 12 + 8 + TEXT;

/// Bytes of that text: 13 of the name, 8 of the checksum, and at least one 0.
const TEXT: usize = 22;

/// Where the format's own count of bytes ends. RIFF fixes it: four letters, then four bytes of count.
const COUNTED: u64 = 8;

/// The last chunk of a file whose other bytes, past that count, have this checksum.
fn tail(check: u32) -> Vec<u8> {
    let mut bytes = b"LIST".to_vec();
    bytes.extend((TAIL as u32 - 8).to_le_bytes());
    bytes.extend(b"INFOISFT");
    bytes.extend((TEXT as u32).to_le_bytes());
    bytes.extend(format!("unripple play{check:08x}").bytes());
    bytes.resize(TAIL, 0);
    bytes
}

/// Writes a drive as [`write_wav`](crate::write_wav) does, with a last chunk that signs it by a checksum. A file at
/// the path is replaced only if it has such a signature, is unchanged, and is not among `reads`, the files that the
/// same command reads.
///
/// # Errors
/// As [`check_kept_wav`] and [`write_wav`](crate::write_wav).
pub fn write_kept_wav(
    path: impl AsRef<Path>,
    reads: &[PathBuf],
    drive: &Drive,
) -> Result<Committed, StoreError> {
    let path = path.as_ref();
    let replaced = check_kept_wav(path, reads)?;
    let spec = spec(path, drive)?;
    write_beside(path, |file| {
        encode(BufWriter::new(&mut *file), spec, drive).map_err(|e| StoreError::write(path)(into_io(e)))?;
        sign(file).map_err(StoreError::write(path))
    })?;
    Ok(Committed { path: path.into(), replaced })
}

/// Checks whether [`write_kept_wav`] may write to a path, and returns whether it would replace an earlier
/// file. Also removes hidden folders that killed runs left beside that path.
///
/// # Errors
/// [`StoreError::Occupied`] if anything else is there, a signed file that was changed included; [`StoreError::Reads`]
/// if it is among `reads`; [`StoreError::Write`] if it cannot be examined.
pub fn check_kept_wav(path: impl AsRef<Path>, reads: &[PathBuf]) -> Result<bool, StoreError> {
    let path = path.as_ref();
    let real = match fs::canonicalize(path) {
        Err(error) if error.kind() == ErrorKind::NotFound && fs::symlink_metadata(path).is_err() => {
            sweep(path);
            return Ok(false);
        }
        other => other.map_err(StoreError::write(path))?,
    };
    let is = |read: &&PathBuf| fs::canonicalize(read).is_ok_and(|read| read == real);
    if let Some(read) = reads.iter().find(is) {
        return Err(StoreError::Reads { path: path.into(), read: read.clone() });
    }
    let kind = fs::metadata(&real).map_err(StoreError::write(path))?;
    if kind.is_file() && is_signed(&real).map_err(StoreError::write(path))? {
        sweep(&real);
        return Ok(true);
    }
    let expected = "a file that does not exist yet, or the unchanged drive of an earlier run";
    let found = if kind.is_file() { "another file" } else { "something that is not a file" };
    Err(StoreError::Occupied { path: path.into(), expected, found: found.into() })
}

/// Adds the last chunk to a WAV file, and counts it.
fn sign(file: &mut File) -> io::Result<()> {
    let length = file.seek(SeekFrom::End(0))?;
    let check = checksum(file, length)?;
    file.seek(SeekFrom::End(0))?;
    file.write_all(&tail(check))?;
    file.seek(SeekFrom::Start(4))?;
    file.write_all(&((length + TAIL as u64 - COUNTED) as u32).to_le_bytes())
}

fn is_signed(path: &Path) -> io::Result<bool> {
    let mut file = File::open(path)?;
    let Some(length) = file.metadata()?.len().checked_sub(TAIL as u64).filter(|length| *length > COUNTED)
    else {
        return Ok(false);
    };
    let mut last = Vec::new();
    file.seek(SeekFrom::Start(length))?;
    file.read_to_end(&mut last)?;
    // The cheap test first: most other files do not end like this.
    Ok(last.starts_with(&tail(0)[..TAIL - TEXT]) && last == tail(checksum(&mut file, length)?))
}

/// CRC-32C of the bytes after the format's count, up to `length`.
fn checksum(file: &mut File, length: u64) -> io::Result<u32> {
    file.seek(SeekFrom::Start(COUNTED))?;
    let (mut left, mut chunk, mut check) = (file.take(length - COUNTED), vec![0; 1 << 16], 0);
    loop {
        match left.read(&mut chunk)? {
            0 => return Ok(check),
            n => check = crc32c::crc32c_append(check, &chunk[..n]),
        }
    }
}
