//! Verification of a library: files that are not as they were written.

use super::bands::{self, Bands};
use super::{Library, PointState, manifest, record};
use crate::StoreError;
use std::fmt;
use std::path::{Path, PathBuf};

/// One file of a library that is not as it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// The file that is damaged or missing.
    pub file: PathBuf,
    /// Index of the point whose responses are lost; `None` if none are.
    pub point: Option<usize>,
    /// What the file should hold.
    pub expected: String,
    /// What the file holds.
    pub found: String,
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: expected {}, found {}", self.file.display(), self.expected, self.found)
    }
}

impl Damage {
    pub(crate) fn of(error: &StoreError, file: &Path, point: Option<usize>) -> Self {
        let (expected, found) = match error {
            StoreError::Content { expected, found, .. } => (expected.clone(), found.clone()),
            StoreError::Read { reason, .. } => ("a file".to_owned(), reason.to_string()),
            other => ("a sound file".to_owned(), other.to_string()),
        };
        Self { file: file.into(), point, expected, found }
    }
}

impl Library {
    /// Reads all files of the library and returns what is damaged: chunks of the wrong size or checksum, missing
    /// chunks, metadata that differ from the plan. Points without damage stay readable.
    pub fn verify(&self) -> Vec<Damage> {
        let mut damage = Vec::new();
        let mut note = |result: Result<(), StoreError>, file: PathBuf, point| {
            if let Err(error) = result {
                damage.push(Damage::of(&error, &file, point));
            }
        };
        note(manifest::read(&self.root).map(drop), manifest::path(&self.root), None);
        note(record::read(&self.root).map(drop), record::path(&self.root), None);
        note(Bands::read(&self.root, &self.plan).map(drop), bands::path(&self.root), None);
        let arrays = &self.arrays;
        for array in arrays.all() {
            note(array.check(&self.root), manifest::path(&array.folder(&self.root)), None);
        }
        for array in std::iter::once(&arrays.position).chain(arrays.known_or_not()) {
            for chunk in 0..array.chunks() {
                note(array.read(&self.root, chunk).map(drop), array.chunk(&self.root, chunk), None);
            }
        }
        let (states, blocks) = self.read_states();
        let stored = states.iter().enumerate().filter(|(_, state)| **state != PointState::Missing);
        for (point, _) in stored {
            let file = arrays.responses.chunk(&self.root, point);
            note(arrays.responses.read(&self.root, point).map(drop), file, Some(point));
        }
        damage.extend(blocks);
        damage
    }

    /// Makes a damaged library writable again, and returns what was damaged. Points whose responses are lost become
    /// missing, so that they can be measured again, and their log entries are removed. States and qualities that
    /// cannot be read are written anew, as far as they are known. The array of quality by bands is removed if its
    /// frequencies are lost.
    ///
    /// # Errors
    /// [`StoreError::Write`], or [`StoreError::Occupied`] if another process writes. The metadata of the whole
    /// library and the positions cannot be repaired: [`Library::open`] refuses a library without them.
    pub fn repair(&mut self) -> Result<Vec<Damage>, StoreError> {
        self.acquire()?;
        let damage = self.verify();
        let lost: Vec<usize> = damage.iter().filter_map(|damage| damage.point).collect();
        lost.iter().for_each(|point| self.states[*point] = PointState::Missing);
        // Log entries and doubts are removed with the responses. A record that cannot be read leaves a doubt, which
        // is stored.
        self.forget_points(&lost)?;
        if Bands::read(&self.root, &self.plan).is_err() {
            let file = bands::path(&self.root);
            match &self.arrays.bands {
                Some(known) => known.array.describe(&self.root)?,
                None => std::fs::remove_file(&file).map_err(StoreError::write(&file))?,
            }
        }
        let arrays = &self.arrays;
        for array in arrays.known_or_not() {
            for chunk in (0..array.chunks()).filter(|chunk| array.read(&self.root, *chunk).is_err()) {
                array.write_unknown(&self.root, chunk)?;
            }
            array.sync(&self.root)?;
        }
        for array in arrays.all().filter(|array| array.check(&self.root).is_err()) {
            array.describe(&self.root)?;
        }
        if !damage.is_empty() {
            self.write_states(&(0..arrays.state.chunks()).collect::<Vec<_>>())?;
            self.damaged.clear();
        }
        Ok(damage)
    }
}
