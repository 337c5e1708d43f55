//! Reads files by the endings of their names.

use super::bytes::bytes;
use super::found::Found;
use super::labels::Labels;
use super::{from_arrays, from_table, from_uff, from_wav};
use crate::{Progress, TaskError, go_on};
use std::fs::File;
use std::path::PathBuf;

/// Endings of files that are read, for messages.
const ENDINGS: &str = ".uff, .unv, .csv, .npz or .mat, or a folder of WAV files";

/// Reads all files of a request, in their order.
///
/// # Errors
/// [`TaskError::Input`] of a file that cannot be read, is of no known kind, or has a fault, with the place of the fault; [`TaskError::Ask`] of
/// what has to be said about it; [`TaskError::Cancelled`].
pub(super) fn all(
    files: &[PathBuf],
    labels: &Labels,
    progress: &mut dyn Progress,
) -> Result<Found, TaskError> {
    let mut found = Found::default();
    for (n, path) in files.iter().enumerate() {
        go_on(progress)?;
        let name = path.display().to_string();
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            _ if path.is_dir() => from_wav::folder(path, labels, &mut found)?,
            Some("uff" | "unv") => from_uff::read(&bytes(path)?, &name, labels, &mut found)?,
            Some("csv") => from_table::read(&bytes(path)?, &name, labels, &mut found)?,
            Some("npz") => {
                let arrays = unripple_exchange::read_npz(&bytes(path)?, &name).map_err(TaskError::input)?;
                from_arrays::read(arrays, &name, labels, &mut found)?;
            }
            Some("mat") => {
                let arrays = unripple_exchange::read_mat(&bytes(path)?, &name).map_err(TaskError::input)?;
                from_arrays::read(arrays, &name, labels, &mut found)?;
            }
            Some("wav") => from_wav::file(path, labels, &mut found)?,
            Some("sofa" | "h5" | "hdf5") => {
                return Err(TaskError::Input(format!(
                    "{name}: expected {ENDINGS}, found HDF5, which the Python package imports (`import_measurements`)"
                )));
            }
            _ => {
                // What is not there is said by opening it.
                File::open(path).map_err(|error| TaskError::Input(format!("{name}: {error}")))?;
                return Err(TaskError::Input(format!("{name}: expected {ENDINGS}, found another ending")));
            }
        }
        progress.done((n + 1) as f64 / files.len() as f64);
    }
    Ok(found)
}
