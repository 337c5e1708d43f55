//! Plans of sweeps and of searches, format 1: which keys of a surface file and which options of a task vary, and over which values.

mod axis;
mod designs;
mod search;
mod value;
mod varied;

pub use axis::{Axis, AxisValues};
pub use designs::Designs;
pub use search::{Bound, Objective, SearchFile, Want, load_search, parse_search};
pub use value::MOST_DESIGNS;
pub use varied::Varied;

use crate::StoreError;
use crate::document;
use crate::fault::FileFaults;
use crate::file::read_text_up_to;
use crate::surface::reader::{Entry, Faults, Section};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Keys at the top of a plan.
const KEYS: [&str; 11] =
    ["format", "name", "folder", "task", "surface", "ask", "shard", "axis", "sobol", "design", "figures"];

/// Keys that only a plan of a search has at its top.
const OF_SEARCH: [&str; 3] = ["optimise", "objective", "constraint"];

/// Designs in a shard where the plan does not say: of designs that take a second each, a third of a minute is lost if a process is killed.
const SHARD: usize = 20;

/// Most designs in a shard, which is held in memory while it is computed.
const LARGEST_SHARD: usize = 100_000;

/// Most figures that a plan may name; without names all of a report are kept.
const MOST_FIGURES: usize = 1000;

/// Largest text of a plan, in bytes: 32 MiB, a list of 100 000 designs with ten values each. A text takes some ten times its size in memory
/// while it is read, which every process of a sweep does.
const LARGEST_PLAN: usize = 1 << 25;

/// A task that plans may name, with the fields of its request that they may set.
pub type PlanTask = (&'static str, Vec<String>);

/// A plan of a sweep, as its file has it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanFile {
    /// Name of the plan, from its key `name` or that of its file.
    pub name: String,
    /// Folder that the surface and all files are named from, itself named from the folder of the plan; `None` for that of the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folder: Option<String>,
    /// Name of the task that every design is given to.
    pub task: String,
    /// Name of a built-in surface, or path of a file, relative to that folder.
    pub surface: String,
    /// Fields of the task's request that all designs have, in SI units.
    pub ask: BTreeMap<String, Value>,
    /// Number of designs in a shard.
    pub shard: usize,
    /// What varies, and over which values.
    pub designs: Designs,
    /// JSON pointers to the figures of a report that are kept; empty for all.
    pub figures: Vec<String>,
}

/// Reads a plan from its text. `file` is the name of the file in messages; `tasks` are those that it may name.
///
/// # Errors
/// [`FileFaults`] with all faults of the text, or only the first error of TOML syntax.
///
/// ```
/// use unripple_store::{PlanTask, parse_plan};
///
/// let text = r#"
///     format = 1
///     task = "modes"
///     surface = "hudin-2012"
///     ask = { top_hz = 300 }
///     [[axis]]
///     key = "sheet.tension_n_per_m"
///     from = 100
///     to = 400
///     steps = 4
/// "#;
/// let tasks: [PlanTask; 1] = [("modes", vec!["top_hz".into(), "accuracy".into()])];
/// let plan = parse_plan(text, "tensions.toml", &tasks)?;
/// assert_eq!((plan.name.as_str(), plan.designs.len()), ("tensions", 4));
/// let faults = parse_plan(&text.replace("top_hz", "top_herz"), "tensions.toml", &tasks).unwrap_err();
/// assert_eq!(faults.faults()[0].nearest.as_deref(), Some("top_hz"));
/// # Ok::<(), unripple_store::FileFaults>(())
/// ```
pub fn parse_plan(text: &str, file: &str, tasks: &[PlanTask]) -> Result<PlanFile, FileFaults> {
    let keys: Vec<&str> = KEYS.into_iter().chain(OF_SEARCH).collect();
    document::parse_up_to(LARGEST_PLAN, text, file, &keys, |root, name, faults| {
        for key in OF_SEARCH {
            // What it says of designs would only be told as wrong.
            if let Some(entry) = root.get(key) {
                entry.refuse("a plan of a sweep: `unripple optimise` computes this one", None, faults);
                return None;
            }
        }
        read(root, name, tasks, faults)
    })
}

/// Reads a plan from its file; see [`parse_plan`].
///
/// # Errors
/// [`StoreError::Read`] if the file cannot be read; [`StoreError::Surface`] with all faults of its text.
pub fn load_plan(path: impl AsRef<Path>, tasks: &[PlanTask]) -> Result<PlanFile, StoreError> {
    let path = path.as_ref();
    Ok(parse_plan(&read_text_up_to(path, LARGEST_PLAN)?, &path.display().to_string(), tasks)?)
}

/// The surface that the plan in a file names, and the folder that it is named from if the plan says so, whatever else the file says;
/// `None` where that cannot be told.
pub fn plan_surface(path: impl AsRef<Path>) -> Option<(String, Option<String>)> {
    let table: toml::Table = read_text_up_to(path.as_ref(), LARGEST_PLAN).ok()?.parse().ok()?;
    let text = |key: &str| table.get(key)?.as_str().map(str::to_owned);
    Some((text("surface")?, text("folder")))
}

fn read(root: &Section, name: Option<String>, tasks: &[PlanTask], faults: &mut Faults) -> Option<PlanFile> {
    let given = Given::read(root, tasks, faults);
    let shard = shard(root, SHARD, faults);
    let designs = designs::read(root, given.fields().as_deref(), faults);
    let figures = figures_of(root, faults);
    Some(PlanFile {
        name: name?,
        folder: given.folder?,
        task: given.task?.0.to_owned(),
        surface: given.surface?,
        ask: given.ask?,
        shard: shard?,
        designs: designs?,
        figures: figures?,
    })
}

/// What plans of both kinds say of the task that designs are given to; what has a fault is missing.
struct Given<'t> {
    folder: Option<Option<String>>,
    task: Option<&'t PlanTask>,
    surface: Option<String>,
    ask: Option<BTreeMap<String, Value>>,
}

impl<'t> Given<'t> {
    fn read(root: &Section, tasks: &'t [PlanTask], faults: &mut Faults) -> Self {
        let choices: Vec<(&'static str, &PlanTask)> = tasks.iter().map(|task| (task.0, task)).collect();
        let expected = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(" or ");
        let task = root.require("task", &expected, faults).and_then(|entry| entry.choice(&choices, faults));
        let folder = match root.get("folder") {
            Some(entry) => entry.line("a folder relative to that of this file", faults).map(Some),
            None => Some(None),
        };
        let expected = "the name of a built-in surface, or of a file relative to this one";
        let surface =
            root.require("surface", expected, faults).and_then(|entry| entry.line(expected, faults));
        let mut given = Self { folder, task, surface, ask: None };
        given.ask = ask(root, given.fields().as_deref(), faults);
        given
    }

    /// The fields of the task's request, if it is known.
    fn fields(&self) -> Option<Vec<&'t str>> {
        Some(self.task?.1.iter().map(String::as_str).collect())
    }
}

/// Number of designs in a shard.
fn shard(root: &Section, default: usize, faults: &mut Faults) -> Option<usize> {
    match root.get("shard") {
        Some(entry) => entry.count(1, LARGEST_SHARD, faults),
        None => Some(default),
    }
}

/// The figures that a plan names; none for all.
fn figures_of(root: &Section, faults: &mut Faults) -> Option<Vec<String>> {
    match root.get("figures") {
        Some(entry) => figures(&entry, faults),
        None => Some(Vec::new()),
    }
}

/// The fields that all designs have; `fields` are those that the task has, if it is known.
fn ask(root: &Section, fields: Option<&[&str]>, faults: &mut Faults) -> Option<BTreeMap<String, Value>> {
    let Some(entry) = root.get("ask") else { return Some(BTreeMap::new()) };
    let section = entry.section(faults)?;
    if let Some(fields) = fields {
        section.check_keys(fields, |_| None, faults);
    }
    let read =
        section.entries().into_iter().map(|(name, _, entry)| Some((name, value::json(&entry, faults)?)));
    read.collect::<Vec<_>>().into_iter().collect()
}

/// JSON pointers, each once.
fn figures(entry: &Entry, faults: &mut Faults) -> Option<Vec<String>> {
    let expected = format!("a list of at most {MOST_FIGURES} JSON pointers, as [\"/contrast\"]");
    let Some(items) = entry.items().filter(|items| items.len() <= MOST_FIGURES) else {
        entry.refuse(expected, None, faults);
        return None;
    };
    let mut found: Vec<String> = Vec::new();
    for item in &items {
        let pointer = pointer(item, faults)?;
        if found.contains(&pointer) {
            item.refuse("each pointer once", None, faults);
            return None;
        }
        found.push(pointer);
    }
    Some(found)
}

/// A JSON pointer to a figure; otherwise a fault.
fn pointer(entry: &Entry, faults: &mut Faults) -> Option<String> {
    let pointer = entry.line("a JSON pointer, as \"/contrast\"", faults)?;
    if pointer.starts_with('/') {
        return Some(pointer);
    }
    entry.refuse("a JSON pointer", Some(format!("\"/{}\"", pointer.replace('.', "/"))), faults);
    None
}
