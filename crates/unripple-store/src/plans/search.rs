//! Plans of searches: what is unknown, which figures are to be most or least, and within which bounds others have to be.

use super::axis::{Axis, Chosen};
use super::designs::axes_of;
use super::value::ANY;
use super::{Given, KEYS, OF_SEARCH, PlanTask, figures_of, pointer, shard};
use crate::StoreError;
use crate::document;
use crate::fault::FileFaults;
use crate::file::read_text;
use crate::surface::reader::{Entry, Faults, Section};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Keys of the table that says how a search goes.
const OPTIMISE: [&str; 3] = ["seed", "population", "generations"];

/// Keys of an objective.
const OBJECTIVE: [&str; 2] = ["figure", "want"];

/// Keys of a constraint.
const CONSTRAINT: [&str; 3] = ["figure", "at_least", "at_most"];

/// Keys of plans of sweeps that plans of searches do not have: the optimiser chooses the designs.
const NOT_OF_SEARCH: [&str; 2] = ["sobol", "design"];

/// Seed where a plan does not say. Any other gives another search.
const SEED: usize = 1;

/// Least number of designs in a generation: evolution strategies need two parents and two others.
const LEAST_POPULATION: usize = 4;

/// Most designs in a generation.
const MOST_POPULATION: usize = 10_000;

/// Most generations of a search.
const MOST_GENERATIONS: usize = 100_000;

/// Most objectives: among more of them hardly any design is better than another.
const MOST_OBJECTIVES: usize = 8;

/// Most constraints.
const MOST_CONSTRAINTS: usize = 100;

/// Designs in a shard where the plan of a search does not say: a generation is small, and all processes are to have a part of it.
const SHARD: usize = 1;

/// A plan of a search, as its file has it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SearchFile {
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
    /// What is unknown, and among which values; ranges have no steps.
    pub axes: Vec<Axis>,
    /// JSON pointers to the figures of a report that are kept, those of objectives and constraints first.
    pub figures: Vec<String>,
    /// Seed of the optimiser.
    pub seed: u32,
    /// Number of designs in a generation; `None` for the optimiser's own rule.
    pub population: Option<usize>,
    /// Number of generations.
    pub generations: usize,
    /// What is to be most or least; more than one if a trade-off is searched.
    pub objectives: Vec<Objective>,
    /// Bounds that designs have to keep.
    pub constraints: Vec<Bound>,
}

/// A figure that is to be most or least.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Objective {
    /// JSON pointer to the figure in a report.
    pub figure: String,
    /// Which of its values are better.
    pub want: Want,
}

/// Which values of a figure are better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Want {
    /// The greater ones.
    Most,
    /// The smaller ones.
    Least,
}

/// A figure that has to be within bounds, in its own SI unit; there is at least one bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// JSON pointer to the figure in a report.
    pub figure: String,
    /// The least value that is allowed.
    pub at_least: Option<f64>,
    /// The greatest value that is allowed.
    pub at_most: Option<f64>,
}

/// Reads a plan of a search from its text. `file` is the name of the file in messages; `tasks` are those that it may name.
///
/// # Errors
/// [`FileFaults`] with all faults of the text, or only the first error of TOML syntax.
///
/// ```
/// use unripple_store::{PlanTask, Want, parse_search};
///
/// let text = r#"
///     format = 1
///     task = "design"
///     surface = "hudin-2012"
///     optimise = { generations = 10 }
///     [[objective]]
///     figure = "/contrast"
///     want = "most"
///     [[axis]]
///     key = "sheet.tension_n_per_m"
///     from = 100
///     to = 400
/// "#;
/// let tasks: [PlanTask; 1] = [("design", Vec::new())];
/// let plan = parse_search(text, "best.toml", &tasks)?;
/// assert_eq!((plan.generations, plan.objectives[0].want), (10, Want::Most));
/// let faults = parse_search(&text.replace("\"most\"", "\"mots\""), "best.toml", &tasks).unwrap_err();
/// assert_eq!(faults.faults()[0].nearest.as_deref(), Some("\"most\""));
/// # Ok::<(), unripple_store::FileFaults>(())
/// ```
pub fn parse_search(text: &str, file: &str, tasks: &[PlanTask]) -> Result<SearchFile, FileFaults> {
    let own = KEYS.into_iter().filter(|key| !NOT_OF_SEARCH.contains(key));
    let keys: Vec<&str> = own.chain(OF_SEARCH).collect();
    document::parse(text, file, &keys, |root, name, faults| read(root, name, tasks, faults))
}

/// Reads a plan of a search from its file; see [`parse_search`].
///
/// # Errors
/// [`StoreError::Read`] if the file cannot be read; [`StoreError::Surface`] with all faults of its text.
pub fn load_search(path: impl AsRef<Path>, tasks: &[PlanTask]) -> Result<SearchFile, StoreError> {
    let path = path.as_ref();
    Ok(parse_search(&read_text(path)?, &path.display().to_string(), tasks)?)
}

fn read(root: &Section, name: Option<String>, tasks: &[PlanTask], faults: &mut Faults) -> Option<SearchFile> {
    let given = Given::read(root, tasks, faults);
    let shard = shard(root, SHARD, faults);
    let expected = "tables headed [[axis]] with the unknowns, each with from and to, or values";
    let axes = root
        .require("axis", expected, faults)
        .and_then(|entry| axes_of(&entry, Chosen::BySearch, given.fields().as_deref(), faults));
    let figures = figures_of(root, faults);
    let steps = steps(root, faults);
    let objectives = objectives(root, faults);
    let constraints = constraints(root, faults);
    let (objectives, constraints, steps) = (objectives?, constraints?, steps?);
    let judged = objectives.iter().map(|objective| &objective.figure);
    let judged = judged.chain(constraints.iter().map(|bound| &bound.figure));
    let mut kept: Vec<String> = Vec::new();
    for figure in judged.chain(&figures?) {
        if !kept.contains(figure) {
            kept.push(figure.clone());
        }
    }
    Some(SearchFile {
        name: name?,
        folder: given.folder?,
        task: given.task?.0.to_owned(),
        surface: given.surface?,
        ask: given.ask?,
        shard: shard?,
        axes: axes?,
        figures: kept,
        seed: steps.seed,
        population: steps.population,
        generations: steps.generations,
        objectives,
        constraints,
    })
}

/// How a search goes.
struct Steps {
    seed: u32,
    population: Option<usize>,
    generations: usize,
}

fn steps(root: &Section, faults: &mut Faults) -> Option<Steps> {
    let expected = "a table with the number of generations, as { generations = 30 }";
    let section = root.require("optimise", expected, faults)?.section(faults)?;
    section.check_keys(&OPTIMISE, |_| None, faults);
    let seed = match section.get("seed") {
        Some(entry) => entry.count(0, u32::MAX as usize, faults),
        None => Some(SEED),
    };
    let population = match section.get("population") {
        Some(entry) => entry.count(LEAST_POPULATION, MOST_POPULATION, faults).map(Some),
        None => Some(None),
    };
    let expected = format!("a whole number from 1 to {MOST_GENERATIONS}");
    let generations = section
        .require("generations", &expected, faults)
        .and_then(|entry| entry.count(1, MOST_GENERATIONS, faults));
    Some(Steps { seed: u32::try_from(seed?).ok()?, population: population?, generations: generations? })
}

fn objectives(root: &Section, faults: &mut Faults) -> Option<Vec<Objective>> {
    let expected = format!("1 to {MOST_OBJECTIVES} tables headed [[objective]], each with figure and want");
    let entry = root.require("objective", &expected, faults)?;
    let items = tables(&entry, 1..=MOST_OBJECTIVES, &expected, faults)?;
    let read: Vec<Option<Objective>> = items
        .iter()
        .map(|item| {
            let section = item.section(faults)?;
            section.check_keys(&OBJECTIVE, |_| None, faults);
            let figure = figure(&section, faults);
            let want = section
                .require("want", "\"most\" or \"least\"", faults)
                .and_then(|entry| want(&entry, faults));
            Some(Objective { figure: figure?, want: want? })
        })
        .collect();
    let found = read.into_iter().collect::<Option<Vec<_>>>()?;
    let is_second = |at: &usize| found[..*at].iter().any(|other| other.figure == found[*at].figure);
    match (0..found.len()).find(is_second) {
        None => Some(found),
        Some(at) => {
            let told = format!("a second objective of {}", found[at].figure);
            faults.add(&items[at].key, items[at].span.clone(), told, "each figure once", None);
            None
        }
    }
}

fn want(entry: &Entry, faults: &mut Faults) -> Option<Want> {
    entry.choice(&[("most", Want::Most), ("least", Want::Least)], faults)
}

fn constraints(root: &Section, faults: &mut Faults) -> Option<Vec<Bound>> {
    let Some(entry) = root.get("constraint") else { return Some(Vec::new()) };
    let expected = format!("at most {MOST_CONSTRAINTS} tables headed [[constraint]]");
    let items = tables(&entry, 0..=MOST_CONSTRAINTS, &expected, faults)?;
    let read: Vec<Option<Bound>> =
        items.iter().map(|item| constraint(&item.section(faults)?, faults)).collect();
    read.into_iter().collect()
}

fn constraint(section: &Section, faults: &mut Faults) -> Option<Bound> {
    section.check_keys(&CONSTRAINT, |_| None, faults);
    let figure = figure(section, faults);
    let mut bound = |key: &str| match section.get(key) {
        Some(entry) => entry.number(&ANY, faults).map(Some),
        None => Some(None),
    };
    let (least, most) = (bound("at_least")?, bound("at_most")?);
    match (least, most) {
        (None, None) => {
            faults.add(&section.key, section.span.clone(), "no bound", "at_least or at_most", None);
            None
        }
        (Some(least), Some(most)) if least > most => {
            let expected = format!("a number from at_least = {least}: no figure is within these bounds");
            section.get("at_most")?.refuse(expected, None, faults);
            None
        }
        (at_least, at_most) => Some(Bound { figure: figure?, at_least, at_most }),
    }
}

/// The figure of an objective or a constraint.
fn figure(section: &Section, faults: &mut Faults) -> Option<String> {
    let expected = "a JSON pointer to a figure of the task's report, as \"/contrast\"";
    section.require("figure", expected, faults).and_then(|entry| pointer(&entry, faults))
}

/// The tables of a list, if there are as many as there may be; otherwise a fault.
fn tables<'a>(
    entry: &Entry<'a>,
    counts: std::ops::RangeInclusive<usize>,
    expected: &str,
    faults: &mut Faults,
) -> Option<Vec<Entry<'a>>> {
    let items = entry.items().filter(|items| counts.contains(&items.len()));
    if items.is_none() {
        entry.refuse(expected, None, faults);
    }
    items
}
