//! The folder of a sweep: its plan, and the rows of each shard as a file that is complete or not there.

use super::opened::{PARTS, failed, opened};
use super::{Plan, Row};
use crate::{Progress, TaskError, go_on};
use serde::Serialize;
use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use unripple_store::{PlanFile, StoreError, remove_left, write_durably};

/// Folder of single designs whose shard is not done yet.
const ROWS: &str = "rows";

/// What makes the row of a design, by its index.
type Compute<'c> = dyn FnMut(usize) -> Result<Row, TaskError> + 'c;

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
        let mut rows = self.computed(shard, true, &mut |index| self.row_of(index, &mut *progress))?;
        for at in 0..rows.len() {
            if rows[at].lacks_memory {
                let index = rows[at].index;
                rows[at] = match self.equal_within(&rows[..at], index) {
                    Some(row) => row,
                    None => Row::settled(self.plan, index, progress)?,
                };
            }
        }
        self.put(shard, &rows)
    }

    /// As [`compute`](Self::compute), while other processes compute other shards. A shard is only kept, row by row, where memory was lacking
    /// for a design, so that this can be tried when they have ended; and where a row is missing since an equal design is another shard's.
    ///
    /// # Errors
    /// Those of [`compute`](Self::compute).
    pub fn compute_beside_others(&self, shard: usize, progress: &mut dyn Progress) -> Result<(), TaskError> {
        let rows = self.computed(shard, false, &mut |index| self.row_of(index, &mut *progress))?;
        self.put_or_keep(shard, &rows)
    }

    /// Computes the row of a design.
    fn row_of(&self, index: usize, progress: &mut dyn Progress) -> Result<Row, TaskError> {
        go_on(progress)?;
        Row::computed(self.plan, index, progress)
    }

    /// The rows of a shard: those that are kept already, those of equal designs, and those of which `compute` makes one of a design. Unless
    /// the `whole` shard is wanted, a design that is equal to one of another shard has no row until there is one of that.
    fn computed(&self, shard: usize, whole: bool, compute: &mut Compute<'_>) -> Result<Vec<Row>, TaskError> {
        let designs = self.plan.shard(shard);
        let mut rows: Vec<Row> = Vec::new();
        for index in designs.clone() {
            let equal = || self.equal_within(&rows, index).or_else(|| self.equal_elsewhere(index));
            let row = match self.settled(index).or_else(equal) {
                Some(row) => row,
                None if whole || self.plan.first(index) >= designs.start => compute(index)?,
                None => continue,
            };
            rows.push(row);
        }
        Ok(rows)
    }

    /// The row of a design from that of an equal one among some rows, which are in the order of their designs.
    fn equal_within(&self, rows: &[Row], index: usize) -> Option<Row> {
        let first = self.plan.first(index);
        let at = rows.binary_search_by_key(&first, |row| row.index).ok().filter(|_| first < index)?;
        rows[at].again(self.plan.design(index))
    }

    /// The row of a design from that of an equal one which is kept, or of another shard that is done.
    pub fn equal_elsewhere(&self, index: usize) -> Option<Row> {
        let first = self.plan.first(index);
        if first == index {
            return None;
        }
        let row = self.settled(first).or_else(|| {
            let shard = first / self.plan.file().shard;
            // One line of it: what is wrong with others is told when the table is made of them.
            let text = fs::read_to_string(self.part(shard)).ok()?;
            let line = text.lines().nth(first - self.plan.shard(shard).start)?;
            serde_json::from_str::<Row>(line).ok()
        })?;
        row.again(self.plan.design(index))
    }

    /// Whether nothing is missing of a shard but rows of designs that are equal to those of earlier ones.
    pub fn waits(&self, shard: usize) -> bool {
        let designs = self.plan.shard(shard);
        let is_missing = |index: &usize| self.row(*index).is_none();
        // Most plans have no equal designs, and no file need be read.
        let (equal, own): (Vec<usize>, Vec<usize>) =
            designs.clone().partition(|index| self.plan.first(*index) < designs.start);
        equal.iter().any(is_missing) && !own.iter().any(is_missing)
    }

    /// Puts the rows of equal designs into all shards in which nothing else is missing, as far as they are there.
    ///
    /// # Errors
    /// [`TaskError::Work`] if the folder cannot be read, or rows cannot be written.
    pub fn share(&self) -> Result<(), TaskError> {
        for shard in self.missing()?.into_iter().filter(|shard| self.waits(*shard)) {
            let row = |index: usize| self.row(index).or_else(|| self.equal_elsewhere(index));
            let rows: Option<Vec<Row>> = self.plan.shard(shard).map(row).collect();
            if let Some(rows) = rows {
                self.put_or_keep(shard, &rows)?;
            }
        }
        Ok(())
    }

    /// Takes rows that are `known` by the hash of their design, as far as this version computed them. A shard that has no others is done.
    ///
    /// # Errors
    /// [`TaskError::Work`] if the folder cannot be read, or rows cannot be written.
    pub fn take(&self, known: &HashMap<String, Row>) -> Result<(), TaskError> {
        let row = |index: usize| {
            let design = self.plan.design(index);
            known.get(&design.hash).and_then(|row| row.again(design))
        };
        self.missing()?.into_iter().try_for_each(|shard| {
            let rows: Vec<Row> = self.plan.shard(shard).filter_map(row).collect();
            self.put_or_keep(shard, &rows)
        })
    }

    /// Stores the rows of a shard if they are all there and settled; otherwise those that are there, one by one.
    fn put_or_keep(&self, shard: usize, rows: &[Row]) -> Result<(), TaskError> {
        let whole = rows.len() == self.plan.shard(shard).len();
        match whole && !rows.iter().any(|row| row.lacks_memory) {
            true => self.put(shard, rows),
            false => rows.iter().try_for_each(|row| self.put_row(row)),
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_designs_are_computed_once() {
        let scratch = std::env::temp_dir().join(format!("unripple-equal-{}", std::process::id()));
        fs::create_dir(&scratch).unwrap();
        let file = scratch.join("plan.toml");
        let text = "format = 1\ntask = \"modes\"\nsurface = \"hudin-2012\"\nshard = 3\n\
                    [[axis]]\nkey = \"sheet.tension_n_per_m\"\nvalues = [150, 200, 150.0, 200, 250, 150, 250, 150]\n";
        fs::write(&file, text).unwrap();
        let plan = Plan::open(&file).unwrap();
        let folder = Folder::open(&plan, &scratch.join("out")).unwrap();
        let mut computed = Vec::new();
        let mut compute = |index: usize| {
            computed.push(index);
            Ok(Row::failed(plan.design(index), format!("that of {index}")))
        };
        // The last shard first, as one of several machines may do it.
        let last = folder.computed(2, false, &mut compute).unwrap();
        assert!(last.is_empty() && folder.waits(2) && !folder.waits(1));
        for shard in [0, 1] {
            let rows = folder.computed(shard, false, &mut compute).unwrap();
            folder.put_or_keep(shard, &rows).unwrap();
        }
        assert_eq!(computed, [0, 1, 4]);
        folder.share().unwrap();
        assert!(folder.missing().unwrap().is_empty());
        let mut told = Vec::new();
        let mut take = |row: Row| {
            assert_eq!(row.values, plan.design(row.index).values);
            told.extend(row.error);
            Ok(())
        };
        folder.each(&mut take).unwrap();
        assert_eq!(told, [0, 1, 0, 1, 4, 0, 4, 0].map(|first| format!("that of {first}")));
        fs::remove_dir_all(&scratch).unwrap();
    }
}
