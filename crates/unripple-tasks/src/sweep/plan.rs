//! A plan of a sweep, opened: every design by its index alone.

use super::design::{Design, canonical};
use super::equal::Equal;
use super::files::{self, Files};
use super::flat::is_of_the_clock;
use super::surface::{Ground, origin};
use super::tasks::tasks;
use super::values;
use crate::commands::{Command, find, unknown};
use crate::cost::Estimate;
use crate::record::of_bytes;
use crate::{SurfaceAsk, TaskError, machine};
use serde_json::{Map, Value, json};
use std::ops::Range;
use std::path::Path;
use unripple::act::model_cost;
use unripple_store::{PlanFile, Varied, load_plan};

/// A plan with its surface, as a sweep computes it. Designs are found by arithmetic from their index; none is held in memory.
///
/// ```
/// use unripple_tasks::sweep::Plan;
///
/// let file = std::env::temp_dir().join(format!("unripple-doc-plan-{}.toml", std::process::id()));
/// let text = r#"
///     format = 1
///     task = "modes"
///     surface = "hudin-2012"
///     shard = 50
///     [[axis]]
///     key = "sheet.tension_n_per_m"
///     from = 100
///     to = 400
///     steps = 1000
///     [[axis]]
///     key = "sheet.thickness_mm"
///     values = [0.1, 0.125]
/// "#;
/// std::fs::write(&file, text)?;
/// let plan = Plan::open(&file)?;
/// assert_eq!((plan.len(), plan.shards(), plan.shard(39)), (2000, 40, 1950..2000));
/// let last = plan.design(1999);
/// assert_eq!(last.values.get("surface:sheet.tension_n_per_m"), Some(&400.0.into()));
/// assert_eq!(plan.ask(&last)?["surface"]["name"], "hudin-2012");
/// # std::fs::remove_file(&file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Plan {
    file: PlanFile,
    ground: Ground,
    surface_sha256: String,
    files: Files,
    /// SHA-256 of the files that the fields of all designs name.
    asked: Map<String, Value>,
    hash: String,
    equal: Equal,
}

impl Plan {
    /// Reads a plan from its file, and the surface that it names.
    ///
    /// # Errors
    /// [`TaskError::Faults`] with all faults of the file; [`TaskError::Input`] of a surface that is not there, of keys that surface files do not
    /// have, of any key where the surface is a library, of fields with values of the wrong kind, and of figures that depend on the clock.
    pub fn open(path: &Path) -> Result<Self, TaskError> {
        Self::of(path, load_plan(path, &tasks())?)
    }

    /// The plan that was read from a file, with its surface.
    ///
    /// # Errors
    /// Those of [`open`](Self::open) but for faults of the file.
    pub(crate) fn of(path: &Path, file: PlanFile) -> Result<Self, TaskError> {
        let origin = origin(path, file.folder.as_deref());
        Self::with_files_from(&origin, path, file)
    }

    /// As [`open`](Self::open), with files named from another folder than the plan says.
    ///
    /// # Errors
    /// Those of [`open`](Self::open).
    pub(crate) fn open_from(origin: &Path, path: &Path) -> Result<Self, TaskError> {
        Self::with_files_from(origin, path, load_plan(path, &tasks())?)
    }

    /// The plan that was read from a file at `path`, and names files from the folder `origin`.
    fn with_files_from(origin: &Path, path: &Path, file: PlanFile) -> Result<Self, TaskError> {
        let shown = path.display();
        let varies = |pointer: &&String| is_of_the_clock(pointer) || pointer.split('/').nth(1) == Some("run");
        if let Some(pointer) = file.figures.iter().find(varies) {
            let expected = "expected values that are the same in every run";
            return Err(TaskError::Input(format!(
                "{shown}: figures: {expected}, found `{pointer}`, a time by the clock or a record of the run"
            )));
        }
        let (ground, surface_sha256) = Ground::of(origin, &file.surface)?;
        let files = Files::of(origin, ground.folder());
        let asked = files.named(files::asked(&file).iter().map(|(varied, value)| (varied, *value)));
        let mut named = files.named(files::values(&file.designs).into_iter());
        named.extend(asked.clone());
        let mut kept = json!({
            "task": file.task, "surface": surface_sha256, "ask": file.ask, "shard": file.shard, "designs": file.designs,
            "figures": file.figures,
        });
        if !named.is_empty() {
            kept["files"] = named.into();
        }
        let hash = of_bytes(canonical(&kept).as_bytes());
        let equal = Equal::of(&file.designs);
        let plan = Self { file, ground, surface_sha256, files, asked, hash, equal };
        for varied in plan.file.designs.varied() {
            plan.check(varied).map_err(|found| match found {
                TaskError::Input(text) => TaskError::Input(format!("{shown}: {varied}: {text}")),
                other => other,
            })?;
        }
        plan.check_ask(0).map_err(|error| TaskError::Input(format!("{shown}: {error}")))?;
        Ok(plan)
    }

    /// Checks that what varies is known, in the first design that has it.
    fn check(&self, varied: &Varied) -> Result<(), TaskError> {
        let has = |index: &usize| values::of(&self.file.designs, *index).iter().any(|(own, _)| own == varied);
        let first = (0..self.len()).find(has);
        let index = first.unwrap_or_default();
        match varied {
            Varied::Ask(_) => self.check_ask(index),
            Varied::Surface(key) => self.check_key(key, index),
        }
    }

    /// Checks that the request of a design has fields of the right kinds.
    fn check_ask(&self, index: usize) -> Result<(), TaskError> {
        self.fields(&self.design(index)).map(drop)
    }

    /// The request of a design without its surface, with its files named from the current folder.
    fn fields(&self, design: &Design) -> Result<Value, TaskError> {
        (self.task()?.renamed)(design.fields(&self.file)?, &mut self.files.clone())
    }

    /// Checks that surface files have a key; values that they cannot have are left to the designs.
    fn check_key(&self, key: &str, index: usize) -> Result<(), TaskError> {
        if let Ground::Library(_) = self.ground {
            let expected =
                "expected options of the task alone to vary, since the surface is a library of responses";
            return Err(TaskError::Input(format!("{expected}, found a key of a surface file")));
        }
        let faults = match self.surface(index) {
            Ok(surface) => match surface.load() {
                Err(TaskError::Faults(faults)) => faults,
                // What else a surface may be refused for is the task's to say.
                Ok(_) | Err(_) => return Ok(()),
            },
            Err(TaskError::Faults(faults)) => faults,
            Err(other) => return Err(other),
        };
        let unknown = faults.faults().iter().find(|fault| {
            let own = key
                .strip_prefix(&fault.key)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
            own && fault.found.starts_with("an unknown key")
        });
        match unknown {
            Some(fault) => Err(TaskError::Input(fault.to_string())),
            None => Ok(()),
        }
    }

    /// The surface of a design.
    fn surface(&self, index: usize) -> Result<SurfaceAsk, TaskError> {
        self.ground.with(self.design(index).keys())
    }

    /// Number of designs.
    pub fn len(&self) -> usize {
        self.file.designs.len()
    }

    /// Whether there is no design; a plan that could be opened has at least one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of shards.
    pub fn shards(&self) -> usize {
        self.len().div_ceil(self.file.shard)
    }

    /// Indices of the designs of a shard, which is counted from 0.
    pub fn shard(&self, shard: usize) -> Range<usize> {
        let end = |shard: usize| shard.saturating_mul(self.file.shard).min(self.len());
        end(shard)..end(shard.saturating_add(1))
    }

    /// The design with an index, counted from 0.
    pub fn design(&self, index: usize) -> Design {
        let own = values::of(&self.file.designs, index);
        let mut files = self.asked.clone();
        files.extend(self.files.named(own.iter().map(|(varied, value)| (varied, value))));
        Design::of(&self.file, &self.surface_sha256, files, index, own)
    }

    /// The index of the first design that is equal to the one with an index: its own if there is no earlier one.
    pub(super) fn first(&self, index: usize) -> usize {
        self.equal.first(index)
    }

    /// The request of a design: what all designs have, its own values, and its surface.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a key or a field that its values cannot be put under, and of fields with values of the wrong kind;
    /// [`TaskError::Faults`] of a surface with SVG files that has faults.
    pub fn ask(&self, design: &Design) -> Result<Value, TaskError> {
        let mut ask = self.fields(design)?;
        let surface = self.ground.with(design.keys())?;
        ask["surface"] = serde_json::to_value(surface).map_err(TaskError::work)?;
        Ok(ask)
    }

    /// The task that designs are given to.
    ///
    /// # Errors
    /// [`unknown`], which no plan that could be opened is refused with.
    pub(super) fn task(&self) -> Result<&'static Command, TaskError> {
        find(&self.file.task).ok_or_else(|| unknown(&self.file.task, &[]))
    }

    /// SHA-256, in hexadecimal digits, of everything that determines the table.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// SHA-256 of the surface as the plan names it, in hexadecimal digits.
    pub(crate) fn surface_sha256(&self) -> &str {
        &self.surface_sha256
    }

    /// The surface with keys of its file set to other values, which are written as in the file.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a path that no key can have; [`TaskError::Faults`] of a surface with SVG files that has faults.
    pub(crate) fn surface_with(&self, keys: Vec<(String, String)>) -> Result<SurfaceAsk, TaskError> {
        self.ground.with(keys)
    }

    /// SHA-256, in hexadecimal digits, of each file that the plan names, by `ask:NAME` or `surface:NAME`.
    pub(crate) fn named(&self) -> Map<String, Value> {
        let mut named = self.files.named(files::values(&self.file.designs).into_iter());
        named.extend(self.asked.clone());
        named
    }

    /// The same of the files that all designs name.
    pub(crate) fn asked(&self) -> &Map<String, Value> {
        &self.asked
    }

    /// The plan as its file has it.
    pub fn file(&self) -> &PlanFile {
        &self.file
    }

    /// What the modes of the first design cost on this machine; `None` where that is not known.
    pub(super) fn estimate(&self) -> Option<Estimate> {
        let surface = self.surface(0).ok()?.load().ok()?;
        let cost = machine::memory().during(|| model_cost(&surface, None, &[]));
        cost.ok().map(Estimate::of)
    }
}
