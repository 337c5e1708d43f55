//! Output folders: complete or not at all, and never in place of what is not ours.

use crate::StoreError;
use crate::building::{Building, sweep};
use crate::file::write_file;
use crate::listing::{self, MARKER, Said};
use crate::swap::swap;
use crate::underway::{Entry, What};
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// An output folder under construction: filled in a hidden folder beside its destination, put in place in one step,
/// and removed if that never happens.
///
/// A folder of an earlier run is replaced as a whole if it holds only what that run wrote, unchanged; the hidden file
/// [`MARKER`] lists it. Anything else is refused before any work is done, and again at the end.
///
/// ```
/// use unripple_store::OutputDir;
/// let place = std::env::temp_dir().join(format!("unripple-doc-{}", std::process::id()));
/// let out = OutputDir::create(&place)?;
/// out.write("report.md", b"# Report\n")?;
/// assert!(!place.exists());
/// let committed = out.commit()?;
/// assert!(place.join("report.md").exists() && !committed.replaced);
/// assert!(OutputDir::create(&place)?.commit()?.replaced);
///
/// std::fs::write(place.join("notes.txt"), "not ours").unwrap();
/// assert!(OutputDir::create(&place).unwrap_err().to_string().contains("`notes.txt`"));
/// # std::fs::remove_dir_all(&place).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
#[derive(Debug)]
pub struct OutputDir {
    place: PathBuf,
    reads: Vec<PathBuf>,
    building: Building,
}

/// An output that was put in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Committed {
    /// Path of the output.
    pub path: PathBuf,
    /// Whether this output replaced that of an earlier run.
    pub replaced: bool,
}

impl OutputDir {
    /// Begins an output folder with destination `path`; missing parent folders are made.
    ///
    /// # Errors
    /// [`StoreError::Occupied`] if something else is there; [`StoreError::Write`] if the folder above cannot be written to.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        Self::create_beside(path, &[])
    }

    /// As [`OutputDir::create`], for work that reads the files and folders `reads`, none of which may be
    /// replaced.
    ///
    /// # Errors
    /// As [`OutputDir::create`], and [`StoreError::Reads`] if one of them is at the destination or in it.
    pub fn create_beside(path: impl AsRef<Path>, reads: &[PathBuf]) -> Result<Self, StoreError> {
        let path = path.as_ref();
        let place = match fs::canonicalize(path) {
            Ok(real) => real,
            Err(error) if error.kind() == ErrorKind::NotFound => path.into(),
            Err(error) => return Err(StoreError::write(path)(error)),
        };
        let reads: Vec<PathBuf> = reads.iter().filter_map(|read| fs::canonicalize(read).ok()).collect();
        occupant(&place, &reads)?;
        sweep(&place);
        let building = Building::beside(&place)?;
        Ok(Self { place, reads, building })
    }

    /// Path of the hidden folder, to write files to until [`OutputDir::commit`].
    pub fn path(&self) -> &Path {
        self.building.path()
    }

    /// Path of the destination, where [`OutputDir::commit`] puts the finished folder.
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// Writes one file of the folder.
    ///
    /// # Errors
    /// [`StoreError::Write`] if it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        write_file(self.path().join(name), bytes)
    }

    /// Puts the folder in place, replacing that of an earlier run. If the program is killed meanwhile, one of the two
    /// is in place; only on systems that cannot exchange two folders in one step may both be left under hidden names.
    ///
    /// # Errors
    /// As [`OutputDir::create_beside`], if the place was taken meanwhile; what was there stays.
    pub fn commit(self) -> Result<Committed, StoreError> {
        let before = occupant(&self.place, &self.reads)?;
        let list = listing::of(self.path()).map_err(StoreError::write(&self.place))?;
        write_file(self.path().join(MARKER), list.as_bytes())?;
        let replaced = before == Occupant::EarlierRun;
        if replaced {
            // Locked until the earlier folder is gone, so that no other process takes it for what a killed run left.
            let earlier = File::open(&self.place).ok();
            let _locked = earlier.as_ref().is_some_and(|folder| folder.try_lock().is_ok());
            self.building.held(|entry| self.replace(entry))?;
            listing::remove(self.path()).map_err(StoreError::write(self.path()))?;
        } else {
            self.building.put(&self.place).map_err(StoreError::write(&self.place))?;
        }
        Ok(Committed { path: self.place, replaced })
    }

    /// Exchanges the two folders, and checks the earlier one once more, now that nobody reaches it by its name.
    fn replace(&self, entry: &mut Entry) -> Result<(), StoreError> {
        swap(self.path(), &self.place).map_err(StoreError::write(&self.place))?;
        let found = earlier(self.path());
        let Some(error) = found.err().filter(|_| !is_gone(self.path())) else {
            entry.what = What::Listed(self.path().into());
            return Ok(());
        };
        if swap(self.path(), &self.place).is_err() {
            // The earlier folder, with what somebody put into it, stays under the hidden name.
            entry.finish();
            return Err(error);
        }
        // The error is to name the path that people know.
        earlier(&self.place).and(Err(error))
    }
}

/// Whether nothing is left of a folder, since another run has tidied up what this one had replaced.
fn is_gone(folder: &Path) -> bool {
    match fs::read_dir(folder) {
        Ok(mut items) => items.next().is_none(),
        Err(error) => error.kind() == ErrorKind::NotFound,
    }
}

/// The present content of a place that may be written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Occupant {
    Nothing,
    EmptyFolder,
    EarlierRun,
}

fn refuse(place: &Path, found: impl Into<String>) -> StoreError {
    StoreError::Occupied {
        path: place.into(),
        expected: "no such folder yet, an empty one, or one that holds only what an earlier run wrote",
        found: found.into(),
    }
}

fn occupant(place: &Path, reads: &[PathBuf]) -> Result<Occupant, StoreError> {
    let metadata = match fs::symlink_metadata(place) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Occupant::Nothing),
        Err(error) => return Err(StoreError::write(place)(error)),
    };
    if !metadata.is_dir() {
        return Err(refuse(place, "something that is not a folder"));
    }
    if std::env::current_dir().is_ok_and(|here| here.starts_with(place)) {
        return Err(refuse(place, "the folder you are in"));
    }
    if let Some(read) = reads.iter().find(|read| read.starts_with(place)) {
        return Err(StoreError::Reads { path: place.into(), read: read.clone() });
    }
    let mut items = fs::read_dir(place).map_err(StoreError::write(place))?;
    if items.next().is_none() {
        return Ok(Occupant::EmptyFolder);
    }
    earlier(place).map(|()| Occupant::EarlierRun)
}

/// Refuses a folder that is not the output of an earlier run, unchanged.
fn earlier(folder: &Path) -> Result<(), StoreError> {
    let failed = StoreError::write(folder);
    let files = match listing::read(folder) {
        Ok(Said::Files(files)) => files,
        Ok(Said::Nothing) => return Err(refuse(folder, "a folder with other things in it")),
        Ok(Said::Unfinished) => {
            return Err(refuse(folder, "what an interrupted run had begun; move it away or delete it"));
        }
        Ok(Said::Unlisted) => {
            let found = "one of an earlier version of this program, which did not list what it wrote; move it away or delete it";
            return Err(refuse(folder, found));
        }
        Err(error) => return Err(failed(error)),
    };
    match listing::guests(folder, &files).map_err(StoreError::write(folder))? {
        None => Ok(()),
        Some(guests) => {
            Err(refuse(folder, format!("{guests} there; move that away, or name another folder")))
        }
    }
}
