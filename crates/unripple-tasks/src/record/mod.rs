//! Records of runs: how a report was made, in enough detail to make it again.

mod hash;

use crate::report::SCHEMA_NAME;
use crate::{SurfaceAsk, TaskError, source};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use unripple::core::clock;
use unripple_store::{Library, OutputDir, date, to_toml};

pub use hash::{of_bytes, of_path};

/// Callback for the path of a file that a task reads; it may change the path.
pub type Visit<'a> = dyn FnMut(&mut PathBuf) -> Result<(), TaskError> + 'a;

/// A request for a task that can be recorded: it states which files it reads, and where its results go.
pub trait Request: Clone + Serialize + DeserializeOwned {
    /// Name of the command that performs the request.
    const COMMAND: &'static str;

    /// Mutable references to the surfaces that the request names.
    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        Vec::new()
    }

    /// Calls `visit` with the path of each file and folder that the request reads besides those of its
    /// surfaces; `visit` may change the path in place.
    ///
    /// # Errors
    /// Those of `visit`.
    fn inputs(&mut self, _visit: &mut Visit<'_>) -> Result<(), TaskError> {
        Ok(())
    }

    /// Files and folders that the request reads, which no output may replace.
    fn reads(&self) -> Vec<PathBuf> {
        let mut ask = self.clone();
        let mut paths: Vec<_> =
            ask.surfaces().into_iter().flat_map(|surface| source::reads(surface)).collect();
        let mut list = |path: &mut PathBuf| {
            paths.push(path.clone());
            Ok(())
        };
        // Listing has no errors.
        let _ = ask.inputs(&mut list);
        paths
    }

    /// Sets where the results are written, or (`None`) that none are, where the task allows that; other
    /// outputs are switched off.
    fn send_to(&mut self, output: Option<PathBuf>);
}

/// A surface that was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SurfaceRead {
    /// The surface as the task's options name it.
    pub asked: SurfaceAsk,
    /// Name of the surface, from its file.
    pub name: String,
    /// SHA-256, in hexadecimal digits, of the surface's text (TOML), which the recorded request contains.
    pub sha256: String,
}

/// A file or folder that was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRead {
    /// Absolute path of the file or folder.
    pub path: PathBuf,
    /// SHA-256 of the file's bytes, or of the names and bytes of all files in the folder, in hexadecimal
    /// digits.
    pub sha256: String,
}

/// How a report was made: the program, the request with the text of its surfaces, and the files that were read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Name of the JSON schema that the report conforms to; empty in records of earlier versions.
    #[serde(default)]
    pub schema: String,
    /// Name of the program.
    pub program: String,
    /// Version of the program.
    pub version: String,
    /// The commit that the program was built from, where that is known.
    pub commit: Option<String>,
    /// When the run began: date and time of day, UTC, as ISO 8601 writes them.
    pub date: String,
    /// Command that was run.
    pub command: String,
    /// The request as JSON, in SI units; surfaces are included as text, other files by their absolute
    /// paths.
    pub ask: Value,
    /// Surface files that were read.
    pub surfaces: Vec<SurfaceRead>,
    /// Other files that were read, and libraries of responses.
    pub files: Vec<FileRead>,
}

/// A report with the record of how it was made, as files and `--json` hold both.
#[derive(Serialize)]
struct Recorded<'a, R> {
    #[serde(flatten)]
    report: &'a R,
    run: &'a Record,
}

/// Key of the log entry of a library for the record of the run that began it.
const LOGGED: &str = "run";

/// Commit of the program and the hash of its sources, which the program itself sets: it is built anew with each of them, this crate is
/// not.
static COMMIT: OnceLock<[&str; 2]> = OnceLock::new();

/// Sets the commit that the program was built from, for records, and a hash of its sources, for [the cache](crate::cache); an empty text leaves
/// it unknown. Only the first call has an effect.
pub fn built_from(commit: &'static str, sources: &'static str) {
    // A second call changes nothing, as promised.
    let _ = COMMIT.set([commit, sources]);
}

/// The commit that the program was built from, where that is known.
fn commit() -> Option<String> {
    COMMIT.get().map(|[commit, _]| *commit).filter(|commit| !commit.is_empty()).map(str::to_owned)
}

/// The hash of the sources that the program was built from, where that is known.
pub(crate) fn sources() -> Option<&'static str> {
    COMMIT.get().map(|[_, sources]| *sources).filter(|sources| !sources.is_empty())
}

impl Record {
    /// Makes the record of a request that is about to be performed, with surfaces and files as they are
    /// now.
    ///
    /// ```
    /// use unripple_tasks::{Record, focus};
    ///
    /// let record = Record::of(&focus::Ask::default())?;
    /// assert_eq!(record.command, "focus");
    /// assert!(record.ask["surface"]["toml"].as_str().is_some_and(|text| text.contains("tension_n_per_m = 200")));
    /// # Ok::<(), unripple_tasks::TaskError>(())
    /// ```
    ///
    /// # Errors
    /// [`TaskError::Input`] of a file that is there and cannot be read. What is not there, and a surface with faults, is left to the task,
    /// which says it better.
    pub fn of<A: Request>(ask: &A) -> Result<Self, TaskError> {
        let mut ask = ask.clone();
        let (mut surfaces, mut files) = (Vec::new(), Vec::new());
        for surface in ask.surfaces() {
            match surface {
                SurfaceAsk::Name(library) if Library::is_at(&*library) => {
                    let path = absolute(Path::new(library))?;
                    library.clone_from(&path.to_string_lossy().into_owned());
                    files.push(FileRead { sha256: of_path(&path)?, path });
                }
                _ => {
                    let Ok(read) = surface.load() else { continue };
                    let toml = to_toml(&read);
                    let (name, sha256) = (read.name, of_bytes(toml.as_bytes()));
                    let called = Some(surface.to_string());
                    let asked = std::mem::replace(surface, SurfaceAsk::Text { toml, name: called });
                    surfaces.push(SurfaceRead { asked, name, sha256 });
                }
            }
        }
        ask.inputs(&mut |path| {
            *path = absolute(path)?;
            if path.exists() {
                files.push(FileRead { path: path.clone(), sha256: of_path(path)? });
            }
            Ok(())
        })?;
        Ok(Self {
            schema: SCHEMA_NAME.into(),
            program: "unripple".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            commit: commit(),
            date: now(),
            command: A::COMMAND.into(),
            ask: serde_json::to_value(&ask).map_err(TaskError::work)?,
            surfaces,
            files,
        })
    }

    /// A report with this record, as indented JSON.
    ///
    /// # Errors
    /// [`TaskError::Work`] of what JSON cannot hold.
    pub fn json(&self, report: &impl Serialize) -> Result<String, TaskError> {
        serde_json::to_string_pretty(&Recorded { report, run: self }).map_err(TaskError::work)
    }

    /// Writes a report with this record as `report.json`.
    ///
    /// # Errors
    /// Those of [`json`](Self::json) and of writing.
    pub fn write(&self, out: &OutputDir, report: &impl Serialize) -> Result<(), TaskError> {
        Ok(out.write("report.json", self.json(report)?.as_bytes())?)
    }

    /// Stores this record in the log of a library that is about to be filled; a library that is continued
    /// keeps the record of the run that began it.
    ///
    /// # Errors
    /// Those of [`Library::log`].
    pub(crate) fn log(&self, library: &mut Library) -> Result<(), TaskError> {
        if library.logged(LOGGED).is_none() {
            library.log(LOGGED, serde_json::to_value(self).map_err(TaskError::work)?)?;
        }
        Ok(())
    }

    /// Returns the recorded request, after a check that the files that it reads have not changed.
    ///
    /// # Errors
    /// [`TaskError::Input`] that names what is gone or has changed, or the field that this version does not know.
    pub fn ask<A: Request>(&self) -> Result<A, TaskError> {
        for file in &self.files {
            let found = match file.path.exists() {
                true => of_path(&file.path)?,
                false => "none".into(),
            };
            if found != file.sha256 {
                return Err(TaskError::Input(format!(
                    "{}: expected the file as the run read it (SHA-256 {}), found {found}",
                    file.path.display(),
                    file.sha256
                )));
            }
        }
        asked(self.ask.clone())
    }
}

/// Converts a JSON value to a request; fields that are absent get their defaults.
///
/// # Errors
/// [`TaskError::Input`] of a field that the command does not know, or of a value that the field cannot have.
pub fn asked<A: Request>(ask: Value) -> Result<A, TaskError> {
    serde_json::from_value(ask)
        .map_err(|error| TaskError::Input(format!("the options of `{}`: {error}", A::COMMAND)))
}

/// Date and time of day now, UTC, as ISO 8601 writes them: `2026-03-14T09:26:53Z`.
pub fn now() -> String {
    let seconds = clock::unix_seconds();
    format!("{}Z", date(seconds).replace(' ', "T"))
}

fn absolute(path: &Path) -> Result<PathBuf, TaskError> {
    std::path::absolute(path).map_err(|error| TaskError::Input(format!("{}: {error}", path.display())))
}
