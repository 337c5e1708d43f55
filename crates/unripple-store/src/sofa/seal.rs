//! The seal of an export: bytes after the end that HDF5 counts, with a checksum by which an unchanged export is
//! recognised.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// What the last bytes begin with; the checksum of all before them follows in eight hexadecimal digits.
const NAME: &str = "unripple export ";

/// Bytes of the whole seal: the name and eight hexadecimal digits.
const SEAL: u64 = NAME.len() as u64 + 8;

/// Ends a file with its seal.
pub(super) fn seal(file: &mut File) -> io::Result<()> {
    let length = file.seek(SeekFrom::End(0))?;
    let text = text(file, length)?;
    file.seek(SeekFrom::End(0))?;
    file.write_all(text.as_bytes())
}

/// Whether a file is as it was sealed; `None` if it has no seal.
pub(super) fn is_whole(file: &mut File) -> io::Result<Option<bool>> {
    let Some(length) = file.metadata()?.len().checked_sub(SEAL) else { return Ok(None) };
    let mut last = Vec::new();
    file.seek(SeekFrom::Start(length))?;
    file.read_to_end(&mut last)?;
    // The cheap test first.
    if !last.starts_with(NAME.as_bytes()) {
        return Ok(None);
    }
    Ok(Some(last == text(file, length)?.as_bytes()))
}

/// The seal of the first bytes of a file.
fn text(file: &mut File, length: u64) -> io::Result<String> {
    file.seek(SeekFrom::Start(0))?;
    let (mut left, mut chunk, mut check) = (file.take(length), vec![0; 1 << 16], 0);
    loop {
        match left.read(&mut chunk)? {
            0 => return Ok(format!("{NAME}{check:08x}")),
            n => check = crc32c::crc32c_append(check, &chunk[..n]),
        }
    }
}
