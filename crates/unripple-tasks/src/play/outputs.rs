//! Check of the files that a session of play is to write, before it begins.

use super::ask::Ask;
use crate::record::Request;
use crate::{DeviceKind, TaskError};
use std::fs;
use std::path::{Path, PathBuf};
use unripple_store::{check_kept_wav, check_new_file};

/// Checks that the output files of a session can be written; creates none.
pub fn check(ask: &Ask) -> Result<(), TaskError> {
    let record = ask.touch.record.as_ref();
    if let Some(path) = &ask.keep_drive {
        // Files are no device to play through at all, which is said where devices are opened.
        let clock = ask.clock().filter(|_| ask.device.device != DeviceKind::Tape);
        if let Some(clock) = clock {
            let text =
                format!("`keep_drive`: expected a run that needs no clock, found one in real time ({clock})");
            return Err(TaskError::Input(text));
        }
        if record.is_some_and(|record| place(record) == place(path)) {
            let text = "`keep_drive`: expected another file than that of `record`, found the same";
            return Err(TaskError::Input(text.into()));
        }
        check_kept_wav(path, &ask.reads())?;
    }
    Ok(record.map_or(Ok(()), check_new_file)?)
}

/// Canonical path of a file, whether or not it exists.
fn place(path: &Path) -> PathBuf {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let made = || Some(fs::canonicalize(folder).ok()?.join(path.file_name()?));
    fs::canonicalize(path).ok().or_else(made).unwrap_or_else(|| path.into())
}
