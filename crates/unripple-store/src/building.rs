//! Folders under construction: hidden beside their destination, and locked while the process that fills them lives.

use crate::StoreError;
use crate::listing::{self, MARKER, Said, UNFINISHED};
use crate::underway::{Entry, Underway, What};
use std::collections::hash_map::RandomState;
use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher, Hasher};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Characters of the destination's name that the hidden name has, so that the latter has at most 255 bytes.
const SHOWN: usize = 40;

/// Letters of the random part of a hidden name. Sixteen hexadecimal digits hold the 64 random bits.
const LETTERS: usize = 16;

/// Names that are tried: one is enough, unless somebody has 2^64 folders.
const TRIES: usize = 16;

/// A hidden folder that only this process fills. It is removed when dropped, unless it was put in place.
#[derive(Debug)]
pub(crate) struct Building {
    path: PathBuf,
    underway: Underway,
    /// Locked for as long as the maker lives, whatever ends it. Some file systems have no locks.
    _lock: Option<File>,
}

impl Building {
    /// Makes a new hidden folder beside `place`, its destination; parent folders that are missing are made
    /// as well.
    pub fn beside(place: &Path) -> Result<Self, StoreError> {
        for _ in 0..TRIES {
            if let Some(building) = Self::locked(place)? {
                return Ok(building);
            }
        }
        Err(StoreError::write(place)(ErrorKind::AlreadyExists.into()))
    }

    /// Makes a hidden folder, and locks it before it is marked as unfinished, so that no other process takes it for
    /// one that a killed run left. None if another process removed it before it was locked.
    fn locked(place: &Path) -> Result<Option<Self>, StoreError> {
        let (underway, path) = Underway::begin(|entry| {
            above(place, &mut entry.parents).map_err(StoreError::write(place))?;
            let path = made(place)?;
            entry.what = What::Folder(path.clone());
            Ok::<_, StoreError>(path)
        })?;
        let lock = File::open(&path).ok();
        let tried = lock.as_ref().map(File::try_lock);
        if matches!(tried, Some(Err(TryLockError::WouldBlock))) {
            return Ok(None);
        }
        match underway.held(|_| fs::write(path.join(MARKER), UNFINISHED)) {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            done => {
                done.map(|()| Some(Self { path, underway, _lock: lock })).map_err(StoreError::write(place))
            }
        }
    }

    /// Present path of the hidden folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Runs an action that changes the folder's name or names in it, which [`abandon_all`](crate::abandon_all) cannot
    /// interrupt.
    pub fn held<T>(&self, act: impl FnOnce(&mut Entry) -> T) -> T {
        self.underway.held(act)
    }

    /// Makes a new file in the folder.
    pub fn file(&self, name: &str) -> io::Result<File> {
        self.held(|_| File::options().read(true).write(true).create_new(true).open(self.path.join(name)))
    }

    /// Moves the folder to its destination, which must not exist yet or be an empty folder.
    pub fn put(self, place: &Path) -> io::Result<()> {
        self.held(|entry| {
            // Unlike on other systems, a folder cannot be renamed onto an empty one everywhere.
            match fs::rename(&self.path, place) {
                Err(error) if fs::remove_dir(place).is_err() => return Err(error),
                Err(_) => fs::rename(&self.path, place)?,
                Ok(()) => {}
            }
            entry.finish();
            Ok(())
        })
    }
}

/// Makes the folders above `place` that are missing, and adds them to `made`, deepest first.
fn above(place: &Path, made: &mut Vec<PathBuf>) -> io::Result<()> {
    let above = place.ancestors().skip(1).filter(|p| !p.as_os_str().is_empty());
    let missing: Vec<&Path> = above.take_while(|p| !p.exists()).collect();
    for folder in missing.into_iter().rev() {
        match fs::create_dir(folder) {
            Ok(()) => made.insert(0, folder.into()),
            // Somebody else was quicker, whose folder it is then.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

fn made(place: &Path) -> Result<PathBuf, StoreError> {
    for _ in 0..TRIES {
        let path = hidden(place)?;
        match fs::create_dir(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            done => return done.map(|()| path).map_err(StoreError::write(place)),
        }
    }
    Err(StoreError::write(place)(ErrorKind::AlreadyExists.into()))
}

/// A unique hidden name beside `place`. Process numbers would not be unique, since containers share folders.
pub(crate) fn hidden(place: &Path) -> Result<PathBuf, StoreError> {
    let Some(start) = start(place) else {
        return Err(StoreError::Occupied {
            path: place.into(),
            expected: "a path that ends in a name",
            found: "none".into(),
        });
    };
    let random = RandomState::new().build_hasher().finish();
    Ok(place.with_file_name(format!("{start}{random:0LETTERS$x}")))
}

/// How hidden names beside `place` begin.
fn start(place: &Path) -> Option<String> {
    let name = place.file_name()?.to_string_lossy();
    Some(format!(".{}.unripple-", name.chars().take(SHOWN).collect::<String>()))
}

/// Removes what killed runs left beside `place`: hidden folders with our mark whose process no longer lives.
/// Everything else stays, and so does anything that cannot be examined.
pub(crate) fn sweep(place: &Path) {
    let (Some(start), Some(above)) = (start(place), place.parent()) else { return };
    let above = if above.as_os_str().is_empty() { Path::new(".") } else { above };
    for entry in fs::read_dir(above).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let random = name.to_str().and_then(|name| name.strip_prefix(&start));
        let ours = random.is_some_and(|r| r.len() == LETTERS && r.bytes().all(|b| b.is_ascii_hexdigit()));
        if ours && entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            // What cannot be removed now is there for the next one.
            let _ = bury(&entry.path(), place);
        }
    }
}

/// Removes unfinished files and folders that killed programs have left in a folder. Those of programs that still run stay, and so does
/// everything else.
///
/// ```
/// let folder = std::env::temp_dir().join(format!("unripple-doc-left-{}", std::process::id()));
/// std::fs::create_dir_all(folder.join(".7.jsonl.unripple-0123456789abcdef"))?;
/// std::fs::write(folder.join("notes.txt"), "an afternoon")?;
/// unripple_store::remove_left(&folder);
/// assert_eq!(std::fs::read_dir(&folder)?.count(), 1);
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn remove_left(folder: impl AsRef<Path>) {
    let folder = folder.as_ref();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let parts = name.to_str().and_then(|name| name.strip_prefix('.')?.rsplit_once(".unripple-"));
        let Some((shown, random)) = parts else { continue };
        let ours = random.len() == LETTERS && random.bytes().all(|b| b.is_ascii_hexdigit());
        if ours && entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            // What cannot be removed now is there for the next one.
            let _ = bury(&entry.path(), &folder.join(shown));
        }
    }
}

fn bury(folder: &Path, place: &Path) -> io::Result<()> {
    let lock = File::open(folder)?;
    if lock.try_lock().is_err() {
        return Ok(());
    }
    match listing::read(folder)? {
        Said::Unfinished => listing::remove_unfinished(folder),
        // Only if it is empty: the killed process had just made it, or had removed everything else.
        Said::Nothing => fs::remove_dir(folder),
        // An earlier run's folder that was replaced; kept if nothing is in its place, or if it holds other files.
        Said::Files(files) if place.exists() && listing::guests(folder, &files)?.is_none() => {
            listing::remove(folder)
        }
        _ => Ok(()),
    }
}
