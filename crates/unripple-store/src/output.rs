use crate::StoreError;
use crate::file::{sibling, write_file};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The hidden file that says that a folder is ours, so that a later run may replace it whole.
pub const MARKER: &str = ".unripple";
const MARKER_TEXT: &[u8] = b"Written by unripple. A later run may replace this folder whole.\n";

/// A folder of results in the making: built beside its place, put there in one step, gone if it never is.
///
/// An empty folder, or one that an earlier run wrote (it holds [`MARKER`]), is replaced whole. Anything else is refused
/// before any work is done.
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
/// # std::fs::remove_dir_all(&place).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
#[derive(Debug)]
pub struct OutputDir {
    place: PathBuf,
    build: PathBuf,
    parents: Vec<PathBuf>,
    done: bool,
}

/// What became of an output folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Committed {
    /// Where it is.
    pub path: PathBuf,
    /// Whether an earlier run's folder was replaced.
    pub replaced: bool,
}

impl OutputDir {
    /// Begins a folder that is to be at `path`; folders above it are made where missing.
    ///
    /// # Errors
    /// [`StoreError::Occupied`] if something else is there; [`StoreError::Write`] if the folder above cannot be written to.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        let place = match fs::canonicalize(path) {
            Ok(real) => real,
            Err(error) if error.kind() == ErrorKind::NotFound => path.into(),
            Err(error) => return Err(StoreError::write(path)(error)),
        };
        occupant(&place)?;
        let build = sibling(&place)?;
        let parents = missing_parents(&place);
        let out = Self { place, build, parents, done: false };
        fs::create_dir_all(out.build.parent().unwrap_or(Path::new("")))
            .and_then(|()| fs::create_dir(&out.build))
            .map_err(StoreError::write(path))?;
        out.write(MARKER, MARKER_TEXT)?;
        Ok(out)
    }

    /// Where to write now.
    pub fn path(&self) -> &Path {
        &self.build
    }

    /// Where it all will be.
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// Writes one file of the folder.
    ///
    /// # Errors
    /// [`StoreError::Write`] if it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        write_file(self.build.join(name), bytes)
    }

    /// Puts the folder in its place, replacing an earlier run's.
    ///
    /// # Errors
    /// As [`OutputDir::create`], if the place was taken meanwhile; what was there stays.
    pub fn commit(mut self) -> Result<Committed, StoreError> {
        let failed = |reason| StoreError::Write { path: self.place.clone(), reason };
        let before = occupant(&self.place)?;
        if before == Occupant::Nothing {
            fs::rename(&self.build, &self.place).map_err(failed)?;
        } else {
            let aside = sibling(&self.place)?;
            fs::rename(&self.place, &aside).map_err(failed)?;
            if let Err(error) = fs::rename(&self.build, &self.place) {
                // The earlier folder goes back; the error to report is the first one.
                let _ = fs::rename(&aside, &self.place);
                return Err(failed(error));
            }
            fs::remove_dir_all(&aside).map_err(StoreError::write(&aside))?;
        }
        self.done = true;
        Ok(Committed { path: self.place.clone(), replaced: before == Occupant::EarlierRun })
    }
}

impl Drop for OutputDir {
    fn drop(&mut self) {
        if self.done {
            return;
        }
        // Nobody is left to tell about a failure to tidy up.
        let _ = fs::remove_dir_all(&self.build);
        for parent in &self.parents {
            let _ = fs::remove_dir(parent);
        }
    }
}

/// What is at a place that may be written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Occupant {
    Nothing,
    EmptyFolder,
    EarlierRun,
}

fn occupant(place: &Path) -> Result<Occupant, StoreError> {
    let refuse = |found: &str| StoreError::Occupied {
        path: place.into(),
        expected: "no such folder yet, an empty one, or one that an earlier run wrote",
        found: found.into(),
    };
    let metadata = match fs::symlink_metadata(place) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Occupant::Nothing),
        Err(error) => return Err(StoreError::write(place)(error)),
    };
    if !metadata.is_dir() {
        return Err(refuse("something that is not a folder"));
    }
    if std::env::current_dir().is_ok_and(|here| here.starts_with(place)) {
        return Err(refuse("the folder you are in"));
    }
    if place.join(MARKER).is_file() {
        return Ok(Occupant::EarlierRun);
    }
    let mut items = fs::read_dir(place).map_err(StoreError::write(place))?;
    match items.next() {
        None => Ok(Occupant::EmptyFolder),
        Some(_) => Err(refuse("a folder with other things in it")),
    }
}

/// The folders above `place` that do not exist, deepest first.
fn missing_parents(place: &Path) -> Vec<PathBuf> {
    let above = place.ancestors().skip(1).filter(|p| !p.as_os_str().is_empty());
    above.take_while(|p| !p.exists()).map(Path::to_owned).collect()
}
