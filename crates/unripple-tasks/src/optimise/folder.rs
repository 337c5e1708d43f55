//! The folder of a search: its plan, the designs that have been asked for, and the rows of each generation.

use super::Search;
use super::told::Told;
use crate::sweep::{self, Plan, Row, Workers, failed, opened};
use crate::{Progress, TaskError};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use unripple_store::{SearchFile, remove_left, write_durably};

/// Folder of what has been asked for: a plan of a sweep for each generation.
const ASKED: &str = "asked";

/// Folder of the generations, each the folder of a sweep.
const GENERATIONS: &str = "generations";

/// How the first line of a plan begins that an optimiser wrote; its name follows.
const BY: &str = "# asked for by ";

/// The folder that a search fills.
pub(super) struct Folder {
    search: Arc<Search>,
    path: PathBuf,
}

/// What the file of the plan holds.
#[derive(Serialize)]
struct Kept<'s> {
    format: u32,
    sha256: &'s str,
    plan: &'s SearchFile,
}

impl Folder {
    /// Opens the folder of a plan, or begins it: where nothing is yet, or the same plan.
    ///
    /// # Errors
    /// [`TaskError::Input`] if the folder is of another plan; [`TaskError::Work`] if other things are in it or it cannot be written to.
    pub fn open(search: &Arc<Search>, path: &Path) -> Result<Self, TaskError> {
        opened(path, search.hash(), &|kept| begin(search, kept))?;
        let folder = Self { search: search.clone(), path: path.into() };
        for made in [ASKED, GENERATIONS] {
            folder.make(made)?;
        }
        remove_left(path);
        Ok(folder)
    }

    /// Makes a folder within it, unless it is there, and removes what killed programs left in it.
    fn make(&self, name: &str) -> Result<(), TaskError> {
        let made = self.file(name);
        fs::create_dir_all(&made).map_err(failed(&made))?;
        remove_left(&made);
        Ok(())
    }

    /// The path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// The plan of a generation, as a sweep computes it.
    fn plan(&self, generation: usize) -> PathBuf {
        self.file(ASKED).join(format!("{generation}.toml"))
    }

    fn question_file(&self, generation: usize) -> PathBuf {
        self.file(ASKED).join(format!("{generation}.json"))
    }

    /// Whether the designs of a generation have been asked for.
    pub fn is_asked(&self, generation: usize) -> bool {
        self.plan(generation).is_file()
    }

    /// Number of generations from this one on that have been asked for.
    pub fn asked_from(&self, generation: usize) -> usize {
        (generation..).take_while(|later| self.is_asked(*later)).count()
    }

    /// The optimiser that asked for the designs of a generation, as it calls itself; `None` where it does not.
    pub fn asker(&self, generation: usize) -> Option<String> {
        let text = fs::read_to_string(self.plan(generation)).ok()?;
        Some(text.lines().next()?.strip_prefix(BY)?.trim().to_owned())
    }

    /// What an optimiser has to know for the designs of a generation, as a line of JSON: the unknowns, and what came of the designs of the
    /// generations before but for the first `since`.
    ///
    /// # Errors
    /// [`TaskError::Input`] if the folder that the plan names files from is not there.
    pub fn question(&self, generation: usize, told: &[Told], since: usize) -> Result<String, TaskError> {
        let (file, names) = (self.search.file(), self.search.names());
        let new = &told[told.partition_point(|told| told.generation < since)..];
        let generations = new.chunk_by(|one, other| one.generation == other.generation);
        let designs = |own: &[Told]| -> Vec<Value> { own.iter().map(|told| told.json(&names)).collect() };
        let question = json!({
            "format": 1, "generation": generation, "seed": file.seed, "population": file.population, "objectives": file.objectives.len(),
            "head": self.search.head(&self.file(ASKED))?, "unknowns": self.search.unknowns(), "since": since,
            "told": generations.map(designs).collect::<Vec<_>>(),
        });
        serde_json::to_string(&question).map_err(TaskError::work)
    }

    /// Writes the question of a generation.
    ///
    /// # Errors
    /// [`TaskError::Work`] if it cannot be written.
    pub fn put_question(&self, generation: usize, text: &str) -> Result<(), TaskError> {
        Ok(write_durably(self.question_file(generation), |file| writeln!(file, "{text}"))?)
    }

    /// Removes the question of a generation whose designs have been asked for.
    pub fn remove_question(&self, generation: usize) {
        // It is in nobody's way, and another process may have removed it.
        let _ = fs::remove_file(self.question_file(generation));
    }

    /// The rows of a generation that has been asked for, those that are missing computed first. Rows that are `known` by their hash are
    /// taken as they are.
    ///
    /// # Errors
    /// [`TaskError::Faults`] and [`TaskError::Input`] of a plan that is not of this search; those of a sweep.
    pub fn rows(
        &self,
        generation: usize,
        known: &HashMap<String, Row>,
        workers: Option<&Workers<'_>>,
        progress: &mut dyn Progress,
    ) -> Result<Vec<Row>, TaskError> {
        let plan = self.opened(generation)?;
        let what = format!("generation {generation}");
        sweep::rows(&plan, &self.place(generation), known, workers, &what, progress)
    }

    /// The shards of a generation that has been asked for which have to be computed: all that are missing, but for those in which all rows
    /// are `known` by their hash or are those of equal designs.
    ///
    /// # Errors
    /// Those of [`rows`](Self::rows), but for those of computing.
    pub fn shards(&self, generation: usize, known: &HashMap<String, Row>) -> Result<Vec<usize>, TaskError> {
        sweep::shards(&self.opened(generation)?, &self.place(generation), known)
    }

    /// The plan of a generation that has been asked for, which must be one of this search.
    fn opened(&self, generation: usize) -> Result<Plan, TaskError> {
        let file = self.plan(generation);
        let plan = match Plan::open(&file) {
            Ok(plan) if self.search.owns(&plan) => plan,
            // It says where files are from where the folder was when it was asked for; the folder may have been moved.
            Ok(_) | Err(_) => Plan::open_from(self.search.origin(), &file)?,
        };
        if !self.search.owns(&plan) {
            return Err(TaskError::Input(format!(
                "{}: expected designs of this search: its task, surface, options and figures, and a value for each unknown; found those of \
                 another; remove the file to have it asked for again",
                file.display()
            )));
        }
        Ok(plan)
    }

    /// The folder of the sweep of a generation.
    fn place(&self, generation: usize) -> PathBuf {
        self.file(GENERATIONS).join(generation.to_string())
    }

    /// Plan and folder of the sweep of a generation.
    pub fn sweep(&self, generation: usize) -> (PathBuf, PathBuf) {
        (self.plan(generation), self.place(generation))
    }
}

/// Writes the file of the plan, which makes a folder that of a search.
fn begin(search: &Search, path: &Path) -> Result<(), TaskError> {
    let kept = Kept { format: 1, sha256: search.hash(), plan: search.file() };
    let text = serde_json::to_string_pretty(&kept).map_err(TaskError::work)?;
    Ok(write_durably(path, |file| writeln!(file, "{text}"))?)
}
