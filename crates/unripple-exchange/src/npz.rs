//! Named arrays of numpy in one archive.

use crate::room::Room;
use crate::{Arrays, ExchangeError, npy, zip};

/// Reads the arrays of an NPZ file: real and complex numbers, integers, truth values and texts.
///
/// # Errors
/// [`ExchangeError::Content`] with the byte or the array at fault: an archive or an array that is cut short, damaged, or of a kind that is
/// not read here, such as objects; and arrays that would take more memory than 1032 times the file, or 4 GiB.
pub fn read_npz(bytes: &[u8], file: &str) -> Result<Arrays, ExchangeError> {
    zip::is_archive(bytes, file)?;
    let (mut arrays, mut room) = (Arrays::new(), Room::of(bytes.len(), file));
    for member in zip::members(bytes, file)? {
        let Some(name) = member.name.strip_suffix(".npy") else { continue };
        let unpacked = member.unpack(bytes, file)?;
        let array = npy::read(&unpacked, name, &mut room)?;
        if arrays.insert(name.to_owned(), array).is_some() {
            let at = crate::Place::Named(name.to_owned());
            return Err(ExchangeError::content(file, at, "each array once", "another of the same name"));
        }
    }
    Ok(arrays)
}
