//! Responses of a surface on disk: a Zarr v3 group with one chunk of float32 per point.

mod array;
mod bands;
mod damage;
mod disk;
mod gather;
mod grow;
mod manifest;
mod outline;
mod plan;
mod put;
mod quality;
mod record;
mod state;
mod wav;

use crate::StoreError;
use crate::building::{Building, sweep};
use crate::listing::{self, MARKER, Said};
use crate::underway::undisturbed;
use array::Arrays;
use bands::Bands;
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use unripple_core::Point;

pub use bands::BandQuality;
pub use damage::Damage;
pub use plan::{LibraryPlan, MAY_DIFFER};
pub use put::Take;
pub use quality::Quality;
pub use record::Doubt;
pub use state::PointState;

/// The file that a process holds a lock on while it writes; inside an array's folder, where readers of Zarr ignore
/// it.
const LOCK: &str = "state/.lock";

/// A library of impulse responses on disk.
///
/// Files in the folder: `zarr.json` with the whole plan and its checksum; `position` (metres), `state`, `quality` and
/// `reciprocity_error` in few chunks, so that opening reads few files; `responses`, float32 in the order
/// `[point][actuator][sample]`, one chunk per point. Every chunk ends in its crc32c. There may also be `bands`,
/// quality by third-octave bands ([`Library::hold_bands`]).
///
/// A point counts as finished once its chunk is on the medium and its state says so, in that order. Each file is put
/// in place by renaming. So a process that is killed at any time loses no finished point, and others may read
/// meanwhile. Only one process writes at a time.
///
/// The Zarr group `calibration` beside the arrays records the measurement: a log, and the reasons to doubt the
/// responses, if there are any ([`Library::doubts`]).
///
/// ```
/// use unripple_core::{Conditions, Outline, Point, Port, Shape};
/// use unripple_store::{Library, LibraryPlan, Quality};
/// let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
/// let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.6e-3, outline };
/// let port = Port { name: "a1".into(), at: Point::from_mm(12.0, 31.0) };
/// let points = vec![Point::from_mm(62.0, 90.0), Point::from_mm(70.0, 90.0)];
/// let plan = LibraryPlan::new(vec![port], points, conditions, 3);
///
/// let folder = std::env::temp_dir().join(format!("unripple-doc-library-{}", std::process::id()));
/// let mut library = Library::create(&folder, &plan)?;
/// library.put(1, &[0.0, 1.0, -0.5], &[Quality::UNKNOWN])?;
///
/// let reader = Library::open(&folder)?;
/// assert_eq!(reader.done(), [1]);
/// assert_eq!(reader.get(1)?, [0.0, 1.0, -0.5]);
/// assert!(reader.verify().is_empty());
/// # std::fs::remove_dir_all(&folder).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
#[derive(Debug)]
pub struct Library {
    root: PathBuf,
    plan: LibraryPlan,
    arrays: Arrays,
    states: Vec<PointState>,
    damaged: Vec<Damage>,
    record: record::Record,
    lock: Option<File>,
}

impl Library {
    /// Opens a library for writing: a new one, or an existing one with the same plan, apart from the keys
    /// [`MAY_DIFFER`].
    ///
    /// # Errors
    /// [`StoreError::Content`] if no library can hold the plan; [`StoreError::Occupied`] if the folder holds
    /// something else, a library of another plan (the error says what differs), or one that another process is
    /// writing; [`StoreError::Write`]; and those of [`Library::open`].
    pub fn create(folder: impl AsRef<Path>, plan: &LibraryPlan) -> Result<Self, StoreError> {
        let folder = folder.as_ref();
        plan.check(&folder.display().to_string())?;
        if manifest::path(folder).exists() {
            return Self::resume(folder, plan);
        }
        vacant(folder)?;
        sweep(folder);
        let building = Building::beside(folder)?;
        make(&building, plan)?;
        building.put(folder).map_err(StoreError::write(folder))?;
        disk::sync_folder(above(folder))?;
        let mut library = Self::open(folder)?;
        library.acquire()?;
        Ok(library)
    }

    /// Checks whether [`Library::create`] can use a folder, for callers that compute for long before they create
    /// it: the folder must hold a library, be empty, or not exist.
    ///
    /// # Errors
    /// [`StoreError::Occupied`] if something else is there, [`StoreError::Write`] if the folder cannot be examined.
    pub fn may_be_at(folder: impl AsRef<Path>) -> Result<(), StoreError> {
        let folder = folder.as_ref();
        if manifest::path(folder).exists() { Ok(()) } else { vacant(folder) }
    }

    fn resume(folder: &Path, plan: &LibraryPlan) -> Result<Self, StoreError> {
        let mut library = Self::open(folder)?;
        if let Some(difference) = plan.difference(&library.plan) {
            let expected = "a library of the same plan, or none";
            return Err(StoreError::Occupied { path: folder.into(), expected, found: difference });
        }
        library.acquire()?;
        Ok(library)
    }

    /// Opens a library for reading. Damage to states is tolerated: a point whose state cannot be read counts as
    /// measured if its responses can be read.
    ///
    /// # Errors
    /// [`StoreError::Read`] and [`StoreError::Content`] if the metadata of the whole library or the positions are
    /// missing or damaged, with the file, what it should hold and what it holds.
    pub fn open(folder: impl AsRef<Path>) -> Result<Self, StoreError> {
        let root = folder.as_ref().to_path_buf();
        let (mut plan, count) = manifest::read(&root)?;
        let file = manifest::path(&root).display().to_string();
        // Before any memory is taken for them: there can be as many points as the positions' file has room for.
        let room = fs::metadata(root.join("position").join("c.0.0")).map_or(0, |m| m.len() / 16);
        if count as u64 > room.max(1) {
            let found = format!("room for {room} in {}", root.join("position").display());
            return Err(StoreError::content(&file, format!("positions of {count} points"), found));
        }
        plan.points = vec![Point::default(); count];
        plan.check(&file)?;
        let arrays = Arrays::of(&plan);
        let bytes = arrays.position.read(&root, 0)?;
        let coordinates: Vec<f64> = array::floats(&bytes).collect();
        plan.points = coordinates.as_chunks::<2>().0.iter().map(|[x, y]| Point::new(*x, *y)).collect();
        plan.check(&arrays.position.chunk(&root, 0).display().to_string())?;
        let mut library = Self {
            root,
            plan,
            arrays,
            states: Vec::new(),
            damaged: Vec::new(),
            record: record::Record::default(),
            lock: None,
        };
        library.refresh();
        Ok(library)
    }

    /// Whether a folder looks like a library, sound or damaged, rather than anything else.
    pub fn is_at(folder: impl AsRef<Path>) -> bool {
        folder.as_ref().is_dir() && manifest::path(folder.as_ref()).is_file()
    }

    /// Reads the states of the points again, for a reader while another process writes.
    pub fn refresh(&mut self) {
        (self.states, self.damaged) = self.read_states();
        // Damage is tolerated here, as that of `quality` is; [`Library::verify`] reports it.
        self.arrays.bands = Bands::read(&self.root, &self.plan).ok().flatten();
        self.record = record::read_or_doubt(&self.root);
    }

    /// The plan that the library was made for: points, actuators, samples.
    pub fn plan(&self) -> &LibraryPlan {
        &self.plan
    }

    /// Path of the library's folder.
    pub fn path(&self) -> &Path {
        &self.root
    }

    /// Positions of all points, finished or not, in metres.
    pub fn points(&self) -> &[Point] {
        &self.plan.points
    }

    /// State of a point: missing, measured or bad; `None` beyond the last.
    pub fn state(&self, point: usize) -> Option<PointState> {
        self.states.get(point).copied()
    }

    /// Indices of the points that are measured and not bad, ascending.
    pub fn done(&self) -> Vec<usize> {
        self.in_state(PointState::Measured)
    }

    /// Indices of the points in one state, ascending.
    pub fn in_state(&self, state: PointState) -> Vec<usize> {
        self.states.iter().enumerate().filter(|(_, s)| **s == state).map(|(point, _)| point).collect()
    }

    /// Index of the finished point nearest to a place in metres; `None` if no point is finished.
    pub fn nearest(&self, place: Point) -> Option<usize> {
        let distance = |point: &usize| self.plan.points[*point].distance(place);
        self.done().into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Takes the lock, so that this process is the only one that writes, and reads the states again.
    fn acquire(&mut self) -> Result<(), StoreError> {
        if self.lock.is_some() {
            return Ok(());
        }
        let path = self.root.join(LOCK);
        let file = File::options().create(true).truncate(false).write(true).open(&path);
        let file = file.map_err(StoreError::write(&path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(fs::TryLockError::WouldBlock) => {
                return Err(StoreError::Occupied {
                    path: self.root.clone(),
                    expected: "a library that nobody else is writing",
                    found: "one that another process is writing".into(),
                });
            }
            Err(fs::TryLockError::Error(error)) => return Err(StoreError::write(&path)(error)),
        }
        self.lock = Some(file);
        if matches!(listing::read(&self.root), Ok(Said::Unfinished)) {
            // The marker is from its construction, which was complete.
            undisturbed(|| fs::remove_file(self.root.join(MARKER))).map_err(StoreError::write(&self.root))?;
        }
        self.arrays.all().for_each(|array| disk::sweep(&array.folder(&self.root)));
        self.refresh();
        Ok(())
    }
}

/// Refuses a place that something else is at.
fn vacant(folder: &Path) -> Result<(), StoreError> {
    let occupied = |found: &str| StoreError::Occupied {
        path: folder.into(),
        expected: "no such folder yet, an empty one, or a library",
        found: found.into(),
    };
    match fs::symlink_metadata(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(StoreError::write(folder)(error)),
        Ok(metadata) if !metadata.is_dir() => Err(occupied("something that is not a folder")),
        Ok(_) => match fs::read_dir(folder).map_err(StoreError::write(folder))?.next() {
            None => Ok(()),
            Some(_) => Err(occupied("a folder with other things in it")),
        },
    }
}

/// The folder that a path is in.
fn above(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A library without any response.
fn make(building: &Building, plan: &LibraryPlan) -> Result<(), StoreError> {
    let root = building.path();
    let file = manifest::path(root);
    let description = manifest::encode(plan, &file.display().to_string())?;
    let arrays = Arrays::of(plan);
    for array in arrays.all() {
        array.describe(root)?;
    }
    let places = plan.points.iter().flat_map(|p| [p.x.to_le_bytes(), p.y.to_le_bytes()]);
    arrays.position.write(root, 0, &places.flatten().collect::<Vec<u8>>())?;
    arrays.reciprocity.write_unknown(root, 0)?;
    let states = vec![0; arrays.state.bytes()];
    for block in 0..arrays.state.chunks() {
        arrays.state.write(root, block, &states)?;
        arrays.quality.write_unknown(root, block)?;
    }
    for array in arrays.all() {
        array.sync(root)?;
    }
    disk::write(&file, &[&description])?;
    disk::sync_folder(root)
}
