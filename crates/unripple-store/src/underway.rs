//! Outputs under construction, so that whoever ends the program can remove them first.

use crate::listing;
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// All there is in this process. Names within are made and changed only while this is locked, so that nothing comes into a
/// folder while it is taken away.
static ALL: Mutex<Vec<Entry>> = Mutex::new(Vec::new());

/// A file or folder under way, to be removed if the work does not end well.
#[derive(Debug)]
pub(crate) struct Entry {
    id: u64,
    pub(crate) what: What,
    /// Folders above that were made for it, deepest first: they go with it if nothing else came into them.
    pub(crate) parents: Vec<PathBuf>,
}

/// The kind of output under way, which says how it is removed.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// Nothing: not made yet.
    Nothing,
    /// A single file, removed alone.
    File(PathBuf),
    /// A folder with all that is in it.
    Folder(PathBuf),
    /// A finished folder whose place another took: the files that it lists, and nothing else.
    Listed(PathBuf),
}

impl Entry {
    /// It stays where it is from now on.
    pub(crate) fn finish(&mut self) {
        self.what = What::Nothing;
        self.parents.clear();
    }

    /// Nobody is left to tell about a failure to tidy up.
    fn remove(&mut self) {
        let _ = match std::mem::replace(&mut self.what, What::Nothing) {
            What::Nothing => Ok(()),
            What::File(path) => fs::remove_file(path),
            What::Folder(path) => listing::remove_unfinished(&path),
            What::Listed(path) => listing::remove(&path),
        };
        for parent in &self.parents {
            let _ = fs::remove_dir(parent);
        }
    }
}

/// A thing under construction: taken away when this is dropped, or by [`abandon_all`], unless it was finished.
#[derive(Debug)]
pub struct Underway {
    id: u64,
}

impl Underway {
    /// Makes a thing, and says in its entry what it has made.
    pub(crate) fn begin<T, E>(make: impl FnOnce(&mut Entry) -> Result<T, E>) -> Result<(Self, T), E> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let underway = Self { id: COUNT.fetch_add(1, Ordering::Relaxed) };
        lock().push(Entry { id: underway.id, what: What::Nothing, parents: Vec::new() });
        let made = underway.held(make)?;
        Ok((underway, made))
    }

    /// Does something with it that is not interrupted by taking it away.
    pub(crate) fn held<T>(&self, act: impl FnOnce(&mut Entry) -> T) -> T {
        let mut all = lock();
        let mut gone = Entry { id: self.id, what: What::Nothing, parents: Vec::new() };
        act(all.iter_mut().find(|entry| entry.id == self.id).unwrap_or(&mut gone))
    }

    /// Leaves it where it is.
    pub fn keep(self) {
        self.held(Entry::finish);
    }
}

impl Drop for Underway {
    fn drop(&mut self) {
        let mut all = lock();
        if let Some(index) = all.iter().position(|entry| entry.id == self.id) {
            all.remove(index).remove();
        }
    }
}

/// Does something that makes names, while nothing is taken away.
pub(crate) fn undisturbed<T>(act: impl FnOnce() -> T) -> T {
    let _all = lock();
    act()
}

/// While this lives, nothing is begun and nothing is finished in this process: whoever tries waits.
#[derive(Debug)]
pub struct Abandoned {
    _all: MutexGuard<'static, Vec<Entry>>,
}

/// Takes away everything in this process that is under construction, for whoever ends it. Threads that write meanwhile write
/// into files without a name, or wait until what is returned here is dropped: keep it to the end.
///
/// ```
/// let place = std::env::temp_dir().join(format!("unripple-doc-abandon-{}", std::process::id()));
/// let out = unripple_store::OutputDir::create(&place)?;
/// out.write("report.md", b"# Report\n")?;
/// let abandoned = unripple_store::abandon_all();
/// assert!(!out.path().exists() && !place.exists());
/// # drop(abandoned);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
#[must_use = "others go on as soon as it is dropped"]
pub fn abandon_all() -> Abandoned {
    let mut all = lock();
    // The last one first: it may be within an earlier one.
    all.iter_mut().rev().for_each(Entry::remove);
    Abandoned { _all: all }
}

fn lock() -> MutexGuard<'static, Vec<Entry>> {
    // Whoever panicked meanwhile has left a list that is as good as before.
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}
