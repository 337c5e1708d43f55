//! The folder of a sweep: its plan, and the rows of each shard as a file that is complete or not there.

use super::{Plan, Row};
use crate::{Progress, TaskError, go_on};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use unripple_store::{PlanFile, StoreError, remove_left, write_durably};

/// File with the plan that the rows are of.
const KEPT: &str = "plan.json";

/// Folder of the shards that are done: a file of rows for each.
const PARTS: &str = "parts";

/// Folder of single designs whose shard is not done yet.
const ROWS: &str = "rows";

/// The folder that a sweep fills.
pub(super) struct Folder<'p> {
    /// The plan that all rows are of.
    pub plan: &'p Plan,
    path: PathBuf,
}

/// What the file of the plan holds.
#[derive(Serialize)]
struct Kept<'p> {
    format: u32,
    sha256: &'p str,
    surface_sha256: &'p str,
    designs: usize,
    shards: usize,
    plan: &'p PlanFile,
}

impl<'p> Folder<'p> {
    /// Opens or creates the folder of a plan; an existing folder must be empty or belong to the same plan.
    ///
    /// # Errors
    /// [`TaskError::Input`] if the folder is of another plan; [`TaskError::Work`] if other things are in it or it cannot be written to.
    pub fn open(plan: &'p Plan, path: &Path) -> Result<Self, TaskError> {
        opened(path, plan.hash(), &|kept| begin(plan, kept))?;
        let parts = path.join(PARTS);
        fs::create_dir_all(&parts).map_err(failed(&parts))?;
        [path, parts.as_path(), path.join(ROWS).as_path()].into_iter().for_each(remove_left);
        let folder = Self { plan, path: path.into() };
        folder.forget_kept();
        Ok(folder)
    }

    /// Removes kept rows of shards that are done, which a process that was killed did not come to: they would be back if a shard were
    /// removed to be computed once more.
    fn forget_kept(&self) {
        let Ok(entries) = fs::read_dir(self.path.join(ROWS)) else { return };
        for path in entries.flatten().map(|entry| entry.path()) {
            let index = path.file_stem().and_then(|stem| stem.to_str()?.parse::<usize>().ok());
            if index.is_some_and(|index| self.has(index / self.plan.file().shard)) {
                // What is gone already was removed by the process that did the shard.
                let _ = fs::remove_file(&path);
            }
        }
    }

    /// The path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    fn part(&self, shard: usize) -> PathBuf {
        self.path.join(PARTS).join(format!("{shard}.jsonl"))
    }

    fn row_file(&self, index: usize) -> PathBuf {
        self.path.join(ROWS).join(format!("{index}.json"))
    }

    /// Whether a shard is done.
    pub fn has(&self, shard: usize) -> bool {
        self.part(shard).is_file()
    }

    /// The shards that are not done, in order.
    ///
    /// # Errors
    /// [`TaskError::Work`] if the folder cannot be read.
    pub fn missing(&self) -> Result<Vec<usize>, TaskError> {
        let parts = self.path.join(PARTS);
        let mut done = BTreeSet::new();
        for entry in fs::read_dir(&parts).map_err(failed(&parts))? {
            let name = entry.map_err(failed(&parts))?.file_name();
            let shard = name.to_str().and_then(|name| name.strip_suffix(".jsonl")?.parse::<usize>().ok());
            done.extend(shard);
        }
        Ok((0..self.plan.shards()).filter(|shard| !done.contains(shard)).collect())
    }

    /// Computes a shard, and puts its rows in place. A design that memory was lacking for is tried once more after the others.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`]; [`TaskError::Work`] if the rows cannot be written.
    pub fn compute(&self, shard: usize, progress: &mut dyn Progress) -> Result<(), TaskError> {
        let mut rows = self.computed(shard, progress)?;
        for row in rows.iter_mut().filter(|row| row.lacks_memory) {
            *row = Row::settled(self.plan, row.index, progress)?;
        }
        self.put(shard, &rows)
    }

    /// As [`compute`](Self::compute), while other processes may take the memory: a shard with a design that it was lacking for is only
    /// kept, row by row, so that the design can be tried when they have ended.
    ///
    /// # Errors
    /// Those of [`compute`](Self::compute).
    pub fn compute_beside_others(&self, shard: usize, progress: &mut dyn Progress) -> Result<(), TaskError> {
        let rows = self.computed(shard, progress)?;
        match rows.iter().any(|row| row.lacks_memory) {
            true => rows.iter().try_for_each(|row| self.put_row(row)),
            false => self.put(shard, &rows),
        }
    }

    /// The rows of a shard, those that are kept already and those computed now.
    fn computed(&self, shard: usize, progress: &mut dyn Progress) -> Result<Vec<Row>, TaskError> {
        let mut rows = Vec::new();
        for index in self.plan.shard(shard) {
            go_on(progress)?;
            rows.push(match self.settled(index) {
                Some(row) => row,
                None => Row::computed(self.plan, index, progress)?,
            });
        }
        Ok(rows)
    }

    /// Stores the rows of a shard, which is then done, and removes the rows stored for single designs of it.
    ///
    /// # Errors
    /// [`TaskError::Work`] if they cannot be written.
    pub fn put(&self, shard: usize, rows: &[Row]) -> Result<(), TaskError> {
        let lines = rows.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>();
        let lines = lines.map_err(TaskError::work)?;
        write_durably(self.part(shard), |file| lines.iter().try_for_each(|line| writeln!(file, "{line}")))?;
        // What is left of single designs is of no further use, and in nobody's way.
        if self.path.join(ROWS).is_dir() {
            self.plan.shard(shard).for_each(|index| drop(fs::remove_file(self.row_file(index))));
            let _ = fs::remove_dir(self.path.join(ROWS));
        }
        Ok(())
    }

    /// Stores the row of a single design until its shard is done.
    ///
    /// # Errors
    /// [`TaskError::Work`] if it cannot be written.
    pub fn put_row(&self, row: &Row) -> Result<(), TaskError> {
        let rows = self.path.join(ROWS);
        fs::create_dir_all(&rows).map_err(failed(&rows))?;
        let line = serde_json::to_string(row).map_err(TaskError::work)?;
        Ok(write_durably(self.row_file(row.index), |file| writeln!(file, "{line}"))?)
    }

    /// The row that is kept of a design; `None` if there is none of this design as it is now, by this version: it is then computed again.
    fn row(&self, index: usize) -> Option<Row> {
        let text = fs::read_to_string(self.row_file(index)).ok()?;
        let row: Row = serde_json::from_str(&text).ok()?;
        row.is_of(&self.plan.design(index)).then_some(row)
    }

    /// The row that is kept of a design and will not change, as that of one that memory was lacking for may.
    pub fn settled(&self, index: usize) -> Option<Row> {
        self.row(index).filter(|row| !row.lacks_memory)
    }

    /// Whether all rows of a shard are kept, though some of them may not be settled.
    pub fn is_kept(&self, shard: usize) -> bool {
        self.plan.shard(shard).all(|index| self.row(index).is_some())
    }

    /// The rows of a shard that is done.
    ///
    /// # Errors
    /// [`TaskError::Input`] if its file cannot be read or is not what this program writes.
    pub fn rows(&self, shard: usize) -> Result<Vec<Row>, TaskError> {
        let path = self.part(shard);
        let text = fs::read_to_string(&path)
            .map_err(|reason| TaskError::from(StoreError::Read { path: path.clone(), reason }))?;
        rows_of(self.plan, &path, &text, self.plan.shard(shard))
    }

    /// Passes all rows to `take`, in the order of the designs; all shards must be done.
    ///
    /// # Errors
    /// Those of [`rows`](Self::rows) and of `take`.
    pub fn each(&self, take: &mut dyn FnMut(Row) -> Result<(), TaskError>) -> Result<(), TaskError> {
        (0..self.plan.shards()).try_for_each(|shard| self.rows(shard)?.into_iter().try_for_each(&mut *take))
    }
}

/// Rows from the lines of a file, which must be those of some designs.
fn rows_of(plan: &Plan, path: &Path, text: &str, designs: Range<usize>) -> Result<Vec<Row>, TaskError> {
    let refused = |found: String| {
        let (first, last) = (designs.start, designs.end.saturating_sub(1));
        TaskError::Input(format!(
            "{}: expected the rows of designs {first} to {last}, found {found}; remove the file to have it computed again",
            path.display()
        ))
    };
    let read = text.lines().map(serde_json::from_str::<Row>).collect::<Result<Vec<_>, _>>();
    let rows = read.map_err(|error| refused(error.to_string()))?;
    // Of this plan, too: another may have begun in the same folder at the same instant.
    let own = |row: &Row| row.hash == plan.design(row.index).hash;
    match rows.iter().map(|row| row.index).eq(designs.clone()) && rows.iter().all(own) {
        true => Ok(rows),
        false => Err(refused(format!("{} rows of others", rows.len()))),
    }
}

/// Turns an error of the system into one that says what could not be written.
pub(crate) fn failed(path: &Path) -> impl Fn(std::io::Error) -> TaskError + use<> {
    let path = path.to_path_buf();
    move |reason| StoreError::Write { path: path.clone(), reason }.into()
}

/// Writes the file of the plan, which makes a folder that of a sweep.
fn begin(plan: &Plan, path: &Path) -> Result<(), TaskError> {
    let kept = Kept {
        format: 1,
        sha256: plan.hash(),
        surface_sha256: plan.surface_sha256(),
        designs: plan.len(),
        shards: plan.shards(),
        plan: plan.file(),
    };
    let text = serde_json::to_string_pretty(&kept).map_err(TaskError::work)?;
    Ok(write_durably(path, |file| writeln!(file, "{text}"))?)
}

/// Opens the folder of a plan by its SHA-256, or begins it where nothing is yet: `begin` writes the file that makes a folder that of a
/// plan.
///
/// # Errors
/// [`TaskError::Input`] if the folder is of another plan; [`TaskError::Work`] if other things are in it or it cannot be written to.
pub(crate) fn opened(
    path: &Path,
    sha256: &str,
    begin: &dyn Fn(&Path) -> Result<(), TaskError>,
) -> Result<(), TaskError> {
    fs::create_dir_all(path).map_err(failed(path))?;
    let kept = path.join(KEPT);
    loop {
        match fs::read_to_string(&kept) {
            Ok(text) => return is_of(path, sha256, &text),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(failed(&kept)(error)),
            // Another process may have begun it meanwhile.
            Err(_) => match guest(path)? {
                Some(_) if kept.exists() => {}
                Some(found) => return Err(occupied(path, found)),
                None => begin(&kept)?,
            },
        }
    }
}

/// Refuses a folder whose rows are those of another plan.
fn is_of(path: &Path, sha256: &str, text: &str) -> Result<(), TaskError> {
    let kept: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
    match kept["sha256"].as_str() {
        Some(found) if found == sha256 => Ok(()),
        found => Err(TaskError::Input(format!(
            "{}: expected rows of this plan on this surface (SHA-256 {sha256}), found those of another ({}); name another folder",
            path.display(),
            found.unwrap_or("unknown")
        ))),
    }
}

/// Something in a folder that is not what a plan begins with; `None` if nothing is there.
fn guest(path: &Path) -> Result<Option<String>, TaskError> {
    let hidden = format!(".{KEPT}.");
    for entry in fs::read_dir(path).map_err(failed(path))? {
        let name = entry.map_err(failed(path))?.file_name().to_string_lossy().into_owned();
        // Programs that call shards may make the folders of what they expect.
        let expected =
            name == PARTS && fs::read_dir(path.join(PARTS)).is_ok_and(|mut parts| parts.next().is_none());
        if !expected && !name.starts_with(&hidden) {
            return Ok(Some(name));
        }
    }
    Ok(None)
}

fn occupied(path: &Path, found: String) -> TaskError {
    let expected = "no such folder yet, an empty one, or that of the same plan";
    StoreError::Occupied { path: path.into(), expected, found: format!("a folder with `{found}`") }.into()
}
