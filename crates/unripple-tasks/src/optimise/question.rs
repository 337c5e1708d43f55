//! What an optimiser is asked for a generation: the unknowns, and what came of the designs before.

use super::folder::Folder;
use super::told::Told;
use crate::TaskError;
use std::path::Path;

/// The question for the designs of a generation.
pub struct Question<'q> {
    folder: &'q Folder,
    generation: usize,
    told: &'q [Told],
}

impl<'q> Question<'q> {
    /// The question of a generation, counted from 0, after all designs of those before.
    pub(super) fn of(folder: &'q Folder, generation: usize, told: &'q [Told]) -> Self {
        Self { folder, generation, told }
    }

    /// The folder of the search.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The generation, counted from 0.
    pub fn generation(&self) -> usize {
        self.generation
    }

    /// The question as a line of JSON, with what came of the designs of all generations but the first `since`, which an optimiser has been
    /// told already.
    ///
    /// # Errors
    /// [`TaskError::Input`] if the folder that the plan names files from is not there.
    pub fn json(&self, since: usize) -> Result<String, TaskError> {
        self.folder.question(self.generation, self.told, since)
    }

    /// Writes the question, with all that has been told, to `asked/G.json` in the folder of the search.
    ///
    /// # Errors
    /// Those of [`json`](Self::json); [`TaskError::Work`] if it cannot be written.
    pub fn put(&self) -> Result<(), TaskError> {
        self.folder.put_question(self.generation, &self.json(0)?)
    }
}
