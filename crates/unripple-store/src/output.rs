//! Folders of results: whole or not at all, and never over what is not ours.

use crate::StoreError;
use crate::building::{Building, sweep};
use crate::file::write_file;
use crate::listing::{self, MARKER, Said};
use crate::swap::swap;
use crate::underway::{Entry, What};
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A folder of results in the making: built beside its place, put there in one step, gone if it never is.
///
/// A folder that an earlier run wrote is replaced whole if it holds only what that run wrote, as it wrote it: the hidden file
/// [`MARKER`] lists that. Anything else is refused before any work is done, and again at the end.
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
    /// Whether that of an earlier run was replaced.
    pub replaced: bool,
}

impl OutputDir {
    /// Begins a folder that is to be at `path`; folders above it are made where missing.
    ///
    /// # Errors
    /// [`StoreError::Occupied`] if something else is there; [`StoreError::Write`] if the folder above cannot be written to.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        Self::create_beside(path, &[])
    }

    /// As [`OutputDir::create`], for work that reads these files and folders, none of which may be replaced.
    ///
    /// # Errors
    /// As [`OutputDir::create`], and [`StoreError::Reads`] if one of them is there.
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

    /// Path that the folder gets in the end.
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

    /// Puts the folder in its place, replacing an earlier run's. At every moment one of the two is there, whoever is killed.
    ///
    /// # Errors
    /// As [`OutputDir::create_beside`], if the place was taken meanwhile; what was there stays.
    pub fn commit(self) -> Result<Committed, StoreError> {
        let before = occupant(&self.place, &self.reads)?;
        let list = listing::of(self.path()).map_err(StoreError::write(&self.place))?;
        write_file(self.path().join(MARKER), list.as_bytes())?;
        let replaced = before == Occupant::EarlierRun;
        if replaced {
            // Held until that run is gone: nobody else is to take it for what a killed run left.
            let earlier = File::open(&self.place).ok();
            let _locked = earlier.as_ref().is_some_and(|folder| folder.try_lock().is_ok());
            self.building.held(|entry| self.replace(entry))?;
            listing::remove(self.path()).map_err(StoreError::write(self.path()))?;
        } else {
            self.building.put(&self.place).map_err(StoreError::write(&self.place))?;
        }
        Ok(Committed { path: self.place, replaced })
    }

    /// Changes places with the earlier run, and looks once more at what that holds, now that nobody reaches it by its name.
    fn replace(&self, entry: &mut Entry) -> Result<(), StoreError> {
        swap(self.path(), &self.place).map_err(StoreError::write(&self.place))?;
        let found = earlier(self.path());
        let Some(error) = found.err().filter(|_| !is_gone(self.path())) else {
            entry.what = What::Listed(self.path().into());
            return Ok(());
        };
        if swap(self.path(), &self.place).is_err() {
            // What somebody put there is under the hidden name now, and stays.
            entry.finish();
            return Err(error);
        }
        // Said of the place that people know.
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

/// Refuses a folder that is not an earlier run's, as that left it.
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
