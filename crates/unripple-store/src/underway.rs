//! Outputs under construction, so that they can be removed before the program ends early.

use crate::listing;
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// All outputs under construction in this process. Names in them are made and changed only while this is locked, so
/// that nothing is added to a folder while it is removed.
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
    /// Marks the output as finished, so that it is not removed.
    pub(crate) fn finish(&mut self) {
        self.what = What::Nothing;
        self.parents.clear();
    }

    /// Removes the output. Errors are ignored: nobody is left to report them to.
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

/// Guard of an output under construction. The output is removed when this is dropped, or by [`abandon_all`], unless
/// it is finished.
#[derive(Debug)]
pub struct Underway {
    id: u64,
}

impl Underway {
    /// Begins an output: `make` makes it, and enters what it has made.
    pub(crate) fn begin<T, E>(make: impl FnOnce(&mut Entry) -> Result<T, E>) -> Result<(Self, T), E> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let underway = Self { id: COUNT.fetch_add(1, Ordering::Relaxed) };
        lock().push(Entry { id: underway.id, what: What::Nothing, parents: Vec::new() });
        let made = underway.held(make)?;
        Ok((underway, made))
    }

    /// Runs an action on the output that [`abandon_all`] cannot interrupt.
    pub(crate) fn held<T>(&self, act: impl FnOnce(&mut Entry) -> T) -> T {
        let mut all = lock();
        let mut gone = Entry { id: self.id, what: What::Nothing, parents: Vec::new() };
        act(all.iter_mut().find(|entry| entry.id == self.id).unwrap_or(&mut gone))
    }

    /// Keeps the output: it is finished, and no longer removed.
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

/// Runs an action that makes names, which [`abandon_all`] cannot interrupt.
pub(crate) fn undisturbed<T>(act: impl FnOnce() -> T) -> T {
    let _all = lock();
    act()
}

/// Guard that [`abandon_all`] returns. While it lives, no output is begun or finished in this process: threads that
/// try wait.
#[derive(Debug)]
pub struct Abandoned {
    _all: MutexGuard<'static, Vec<Entry>>,
}

/// Removes all outputs under construction in this process, before it ends early. Other threads can then write only to
/// files that have no name any more, or wait until the returned guard is dropped: keep it until the process ends.
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
    // The last one first, since it may be within an earlier one.
    all.iter_mut().rev().for_each(Entry::remove);
    Abandoned { _all: all }
}

fn lock() -> MutexGuard<'static, Vec<Entry>> {
    // A thread that panicked has left the list in order.
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}
