//! Searches: asks for the designs of one generation after the other, computes them, and says what was found.

use super::asker::{Asker, by_python};
use super::course::Course;
use super::folder::Folder;
use super::{Ask, Report, Search, figure, table};
use crate::figures::Columns;
use crate::sweep::{Piece, Row, TABLE, Workers};
use crate::{Progress, Record, TaskError, figures, go_on, source};
use std::collections::HashMap;
use std::path::Path;
use std::process::Command;
use unripple::act::Note;
use unripple_store::write_file;

/// Name of the report in the folder.
const REPORT: &str = "optimise.json";

/// Name of the surface file of the best design.
const BEST: &str = "best.toml";

/// How a search starts processes.
pub struct Crew<'c> {
    /// Number of processes at a time, at least 1.
    pub jobs: usize,
    /// The command of a process that computes a piece of a sweep, from the plan and the folder of that sweep; see [`Workers`].
    pub command: &'c dyn Fn(&Path, &Path, Piece) -> Command,
}

/// Searches by a plan, in this process, and asks the Python package for designs. What is in the folder already is neither asked for nor
/// computed again, so that a search goes on after any kill; a design that fails is a row with its error, and counts as worse than all
/// others.
///
/// ```
/// use unripple_tasks::{Silent, optimise};
///
/// let folder = std::env::temp_dir().join(format!("unripple-doc-optimise-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let text = r#"
///     format = 1
///     task = "modes"
///     surface = "hudin-2012"
///     ask = { top_hz = 200 }
///     optimise = { generations = 1 }
///     [[objective]]
///     figure = "/frequencies_hz/0"
///     want = "least"
///     [[axis]]
///     key = "sheet.tension_n_per_m"
///     from = 100
///     to = 400
/// "#;
/// std::fs::write(folder.join("plan.toml"), text)?;
/// // What an optimiser is told is in asked/0.json; these designs are somebody's own.
/// let own = |folder: &std::path::Path, generation: usize| {
///     let asked = folder.join(format!("asked/{generation}"));
///     let question = std::fs::read_to_string(asked.with_extension("json")).unwrap();
///     let question: serde_json::Value = serde_json::from_str(&question).unwrap();
///     let designs = [150, 250].map(|tension| format!("[[design]]\n\"surface:sheet.tension_n_per_m\" = {tension}\n"));
///     let text = format!("{}{}", question["head"].as_str().unwrap(), designs.concat());
///     std::fs::write(asked.with_extension("toml"), text).map_err(unripple_tasks::TaskError::work)
/// };
/// let ask = optimise::Ask { plan: folder.join("plan.toml"), output: Some(folder.join("out")), ..optimise::Ask::default() };
/// let report = optimise::run_with(&ask, &own, None, &mut Silent)?;
/// assert_eq!((report.designs, report.best.map(|best| best.index)), (2, Some(0)));
/// assert!(report.best_surface.is_some_and(|text| text.contains("tension_n_per_m = 150")));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`Search::open`] and of [`by_python`]; [`TaskError::Ask`] of options that make no sense; [`TaskError::Input`] of a folder with
/// designs of another plan; [`TaskError::Work`] of one with other things in it, and of what cannot be written; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    run_with(ask, &by_python, None, progress)
}

/// As [`run`], with another optimiser, and with processes that compute the designs.
///
/// # Errors
/// Those of [`run`] and of `asker`; [`TaskError::Work`] of a process that cannot be started, or that ends with an error of its own.
pub fn run_with(
    ask: &Ask,
    asker: &Asker<'_>,
    crew: Option<&Crew<'_>>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    go_on(progress)?;
    let columns = Columns::of(ask.columns)?;
    let output =
        ask.output.as_deref().ok_or_else(|| TaskError::ask("output", "a folder for the designs", "none"))?;
    let search = Search::open(&ask.plan)?;
    // Before the work, as of every task: files may change meanwhile.
    let record = Record::of(ask)?;
    let folder = Folder::open(&search, output)?;
    let mut course = Course::default();
    let asker = (!ask.no_ask).then_some(asker);
    let gone = source::keeping(|| go(&search, &folder, asker, crew, &mut course, progress));
    let file = folder.file(TABLE);
    // Also of a search that could not go on, unless more is there already, as before one of its first generations came to be refused.
    if gone.is_ok() || table::rows(&file) <= course.told.len() {
        table::write(&file, search.file(), &search.names(), &course.told)?;
    }
    gone?;
    let mut report = Report::of(&search, &course)?;
    report.files.push(TABLE.into());
    if let Some(text) = &report.best_surface {
        write_file(folder.file(BEST), text.as_bytes())?;
        report.files.push(BEST.into());
    }
    if !ask.no_figures && !course.told.is_empty() {
        progress.stage("figures");
        match drawn(&search, &folder, &course, columns) {
            Ok(files) => report.files.extend(files),
            // The table is what was asked for.
            Err(error) => report.notes.push(Note { topic: "figures", text: error.to_string() }),
        }
    }
    write_file(folder.file(REPORT), record.json(&report)?.as_bytes())?;
    progress.tell(&format!("wrote {}", folder.file(TABLE).display()));
    Ok(report)
}

/// Goes through the generations: asks for those that have not been asked for, and computes what is missing.
fn go(
    search: &Search,
    folder: &Folder,
    asker: Option<&Asker<'_>>,
    crew: Option<&Crew<'_>>,
    course: &mut Course,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    let mut known = HashMap::new();
    for generation in 0..search.file().generations {
        go_on(progress)?;
        if !folder.is_asked(generation) {
            course.to_ask = Some(generation);
            folder.put_question(generation, &course.told)?;
            let Some(asker) = asker else { return Ok(()) };
            progress.stage(&format!("asking for generation {generation}"));
            asker(folder.path(), generation)?;
            if !folder.is_asked(generation) {
                return Err(TaskError::Work(format!(
                    "generation {generation} was asked for, but nothing came"
                )));
            }
            course.to_ask = None;
        }
        folder.remove_question(generation);
        let rows = computed(folder, generation, &known, crew, progress)?;
        if let Some(name) = folder.asker(generation)
            && !course.optimisers.contains(&name)
        {
            course.optimisers.push(name);
        }
        course.take(search, generation, rows, &mut known);
    }
    Ok(())
}

/// The rows of a generation that has been asked for, by processes or in this one.
fn computed(
    folder: &Folder,
    generation: usize,
    known: &HashMap<String, Row>,
    crew: Option<&Crew<'_>>,
    progress: &mut dyn Progress,
) -> Result<Vec<Row>, TaskError> {
    let Some(crew) = crew else { return folder.rows(generation, known, None, progress) };
    let (plan, place) = folder.sweep(generation);
    let command = |piece: Piece| (crew.command)(&plan, &place, piece);
    let workers = Workers { jobs: crew.jobs, command: &command };
    folder.rows(generation, known, Some(&workers), progress)
}

/// Draws the figures, and returns the names of their files.
fn drawn(
    search: &Search,
    folder: &Folder,
    course: &Course,
    columns: Columns,
) -> Result<Vec<String>, TaskError> {
    let objectives = &search.file().objectives;
    let Some(figure) = figure::all(objectives, &course.told, &course.front) else { return Ok(Vec::new()) };
    let figures = columns.fit(vec![figure]);
    let mut names = Vec::new();
    for (name, bytes) in figures::files(&figures)? {
        write_file(folder.file(&name), &bytes)?;
        names.push(name);
    }
    Ok(names)
}
