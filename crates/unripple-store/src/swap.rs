//! Exchange of two folders.

use crate::building::hidden;
use std::fs;
use std::io;
use std::path::Path;

/// Exchanges two folders, in one step where the system can.
pub(crate) fn swap(a: &Path, b: &Path) -> io::Result<()> {
    match at_once(a, b) {
        // The file system may not be able to exchange; any other error occurs again when renaming.
        Err(_) => by_renaming(a, b),
        done => done,
    }
}

#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn at_once(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn at_once(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Exchanges two folders in three steps. A program that is killed between the first and the second leaves both
/// folders under hidden names, complete.
fn by_renaming(a: &Path, b: &Path) -> io::Result<()> {
    let aside = hidden(b).map_err(io::Error::other)?;
    fs::rename(b, &aside)?;
    if let Err(error) = fs::rename(a, b) {
        // It goes back; the error to report is the first one.
        let _ = fs::rename(&aside, b);
        return Err(error);
    }
    fs::rename(&aside, a)
}

#[cfg(test)]
mod tests {
    use super::{at_once, by_renaming};
    use std::fs;

    #[test]
    fn folders_change_places_either_way() {
        let scratch = std::env::temp_dir().join(format!("unripple-swap-{}", std::process::id()));
        let [a, b] = ["a", "b"].map(|name| scratch.join(name));
        fs::create_dir(&scratch).unwrap();
        for folder in [&a, &b] {
            fs::create_dir(folder).unwrap();
            fs::write(folder.join(folder.file_name().unwrap()), "x").unwrap();
        }
        by_renaming(&a, &b).unwrap();
        assert!(a.join("b").exists() && b.join("a").exists());
        if cfg!(target_os = "linux") {
            at_once(&a, &b).unwrap();
            assert!(a.join("a").exists() && b.join("b").exists());
        }
        assert!(by_renaming(&scratch.join("none"), &b).is_err() && b.exists());
        assert_eq!(fs::read_dir(&scratch).unwrap().count(), 2);
        fs::remove_dir_all(&scratch).unwrap();
    }
}
