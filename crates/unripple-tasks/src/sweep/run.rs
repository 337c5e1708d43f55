//! Computes the rows of a sweep, or a part of them, and the table once all rows are computed.

use super::folder::Folder;
use super::table::TABLE;
use super::tally::Tally;
use super::{Ask, Piece, Plan, Report, Row, Workers, figure, supervised, table};
use crate::figures::Columns;
use crate::{Progress, Record, TaskError, figures, go_on, source};
use std::collections::HashMap;
use std::path::Path;
use unripple::act::Note;
use unripple_store::write_file;

/// Name of the report in the folder.
const REPORT: &str = "sweep.json";

/// Runs a plan's task for each design, shard after shard, in this process, and writes the table once all rows are computed. Shards that are
/// already in the folder are not computed again, so that a sweep continues after it was killed; a design that fails gets a row with its
/// error.
///
/// ```
/// use unripple_tasks::{Silent, sweep};
///
/// let folder = std::env::temp_dir().join(format!("unripple-doc-sweep-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let text = r#"
///     format = 1
///     task = "modes"
///     surface = "hudin-2012"
///     ask = { top_hz = 200 }
///     figures = ["/count", "/frequencies_hz/0"]
///     [[axis]]
///     key = "sheet.tension_n_per_m"
///     values = [150, 200, -1]
/// "#;
/// std::fs::write(folder.join("plan.toml"), text)?;
/// let ask = sweep::Ask {
///     plan: folder.join("plan.toml"),
///     output: Some(folder.join("out")),
///     no_figures: true,
///     ..sweep::Ask::default()
/// };
/// let report = sweep::run(&ask, &mut Silent)?;
/// assert_eq!((report.done, report.failed, report.failures[0].index), (3, 1, 2));
/// let table = std::fs::read_to_string(folder.join("out/table.csv"))?;
/// assert!(table.starts_with("index,surface:sheet.tension_n_per_m,hash,version,/count,/frequencies_hz/0,error\r\n0,150,"));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`Plan::open`]; [`TaskError::Ask`] of options that make no sense; [`TaskError::Input`] of a folder with rows of another plan;
/// [`TaskError::Work`] of one with other things in it, and of what cannot be written; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    run_with(ask, None, progress)
}

/// As [`run`], with processes that compute the shards; one shard alone is computed in this process.
///
/// # Errors
/// Those of [`run`]; [`TaskError::Work`] of a process that cannot be started, or that ends with an error of its own.
pub fn run_with(
    ask: &Ask,
    workers: Option<&Workers<'_>>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    go_on(progress)?;
    let columns = Columns::of(ask.columns)?;
    let plan = Plan::open(&ask.plan)?;
    if ask.count {
        return Ok(Report::counted(&plan));
    }
    if let Some(shard) = ask.shard.filter(|shard| *shard >= plan.shards()) {
        return Err(TaskError::ask("shard", format!("0 to {}", plan.shards() - 1), shard));
    }
    // Before the work, as of every task: files may change meanwhile. Whoever completes the last shard reports on the whole.
    let record = Record::of(&Ask { shard: None, ..ask.clone() })?;
    let folder = Folder::open(&plan, output(ask)?)?;
    source::keeping(|| match (ask.shard, workers) {
        (Some(shard), _) => one(&folder, shard, progress),
        (None, workers) => all(&folder, workers, "designs", progress),
    })?;
    let missing = folder.missing()?;
    let mut report = match missing.is_empty() {
        true => finished(&folder, (!ask.no_figures).then_some(columns), progress)?,
        false => {
            let mut tally = Tally::default();
            let rows = ask.shard.map_or_else(|| Ok(Vec::new()), |shard| folder.rows(shard))?;
            rows.iter().for_each(|row| tally.take(row));
            let designs = missing.iter().map(|shard| plan.shard(*shard).len()).sum();
            Report::of(&plan, &tally, designs)
        }
    };
    report.shard = ask.shard;
    if report.missing == 0 {
        report.shard = None;
        write_file(folder.file(REPORT), record.json(&report)?.as_bytes())?;
        progress.tell(&format!("wrote {}", folder.file(TABLE).display()));
    }
    Ok(report)
}

/// Computes the part of a sweep that is assigned to one of several processes. The table is left to the process that
/// started them.
///
/// # Errors
/// Those of [`run`].
pub fn compute(ask: &Ask, piece: Piece, progress: &mut dyn Progress) -> Result<(), TaskError> {
    go_on(progress)?;
    let plan = Plan::open(&ask.plan)?;
    let folder = Folder::open(&plan, output(ask)?)?;
    let is_there = |shard: &usize| *shard < plan.shards();
    source::keeping(|| match &piece {
        Piece::Shards(shards) if shards.iter().all(is_there) => {
            let mut left = shards.iter().filter(|shard| !folder.has(**shard));
            left.try_for_each(|shard| folder.compute_beside_others(*shard, progress))
        }
        Piece::Shard(shard) if is_there(shard) => one(&folder, *shard, progress),
        Piece::Design(index) if *index < plan.len() => {
            folder.put_row(&Row::settled(&plan, *index, progress)?)
        }
        Piece::Shards(_) | Piece::Shard(_) | Piece::Design(_) => {
            let expected = format!("one of {} shards or {} designs", plan.shards(), plan.len());
            Err(TaskError::ask("piece", expected, &piece))
        }
    })
}

/// The folder that rows go to.
fn output(ask: &Ask) -> Result<&Path, TaskError> {
    ask.output.as_deref().ok_or_else(|| TaskError::ask("output", "a folder for the rows", "none"))
}

/// Computes a shard, unless it is done.
fn one(folder: &Folder, shard: usize, progress: &mut dyn Progress) -> Result<(), TaskError> {
    if folder.has(shard) { Ok(()) } else { folder.compute(shard, progress) }
}

/// Computes all missing shards, with `what` as the name of that stage: by processes, or here one after the other.
fn all(
    folder: &Folder,
    workers: Option<&Workers<'_>>,
    what: &str,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    progress.stage(what);
    if let Some(workers) = workers {
        return supervised::run(workers, folder, progress);
    }
    let (missing, shards) = (folder.missing()?, folder.plan.shards());
    for (at, shard) in missing.iter().enumerate() {
        progress.done((shards - missing.len() + at) as f64 / shards as f64);
        one(folder, *shard, progress)?;
    }
    Ok(())
}

/// The rows of all designs of a plan, in order, those that its folder does not have computed first; no table is written. Rows that are
/// `known` by their hash are taken as they are, unless another version computed them. `what` is the name of the stage. To be called within
/// [`source::keeping`].
///
/// # Errors
/// Those of [`run`], but for those of the plan.
pub(crate) fn rows(
    plan: &Plan,
    path: &Path,
    known: &HashMap<String, Row>,
    workers: Option<&Workers<'_>>,
    what: &str,
    progress: &mut dyn Progress,
) -> Result<Vec<Row>, TaskError> {
    let folder = Folder::open(plan, path)?;
    folder.take(known)?;
    if !folder.missing()?.is_empty() {
        all(&folder, workers, what, progress)?;
    }
    let mut rows = Vec::new();
    folder.each(&mut |row| {
        rows.push(row);
        Ok(())
    })?;
    Ok(rows)
}

/// The shards of a plan that have to be computed into a folder, which takes the rows that are `known` by their hash: all that are missing,
/// but for those that only have designs which are equal to those of earlier shards.
///
/// # Errors
/// Those of [`run`], but for those of the plan and of computing.
pub(crate) fn shards(
    plan: &Plan,
    path: &Path,
    known: &HashMap<String, Row>,
) -> Result<Vec<usize>, TaskError> {
    let folder = Folder::open(plan, path)?;
    folder.take(known)?;
    Ok(folder.missing()?.into_iter().filter(|shard| !folder.waits(*shard)).collect())
}

/// Writes the table of all rows, and figures unless they are not wanted.
fn finished(
    folder: &Folder,
    columns: Option<Columns>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    progress.stage("table");
    let mut tally = Tally::default();
    folder.each(&mut |row| {
        tally.take(&row);
        go_on(progress)
    })?;
    table::write(folder, &tally)?;
    let mut report = Report::of(folder.plan, &tally, 0);
    report.files.push(TABLE.into());
    if let Some(columns) = columns {
        progress.stage("figures");
        match drawn(folder, &report, columns) {
            Ok(files) => report.files.extend(files),
            // The table is what was asked for; some plans have nothing to draw.
            Err(error) => report.notes.push(Note { topic: "figures", text: error.to_string() }),
        }
    }
    Ok(report)
}

/// Draws the figures, and returns the names of their files.
fn drawn(folder: &Folder, report: &Report, columns: Columns) -> Result<Vec<String>, TaskError> {
    let figures = columns.fit(figure::all(folder, report)?);
    let mut names = Vec::new();
    for (name, bytes) in figures::files(&figures)? {
        write_file(folder.file(&name), &bytes)?;
        names.push(name);
    }
    Ok(names)
}
