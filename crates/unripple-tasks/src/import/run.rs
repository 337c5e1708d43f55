//! Reads files of other programs, and writes a library of responses.

use super::assembled::Assembled;
use super::from_wav::is_exported;
use super::joining::assembled;
use super::labels::Labels;
use super::{Ask, Report, read};
use crate::numbers::above_zero;
use crate::record::{now, of_bytes};
use crate::{Progress, Record, TaskError, filling, go_on, wavelength};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::path::Path;
use unripple::act::{carries, unit};
use unripple::core::{Point, Port, SampledResponses, Surface};
use unripple_calibrate::measure::MOST_KEPT;
use unripple_store::{Library, LibraryPlan};

/// Reads responses or modes from files of other programs, and writes them as a library of responses of a surface.
///
/// # Errors
/// Those of [`SurfaceAsk::load`](crate::SurfaceAsk::load); [`TaskError::Ask`] with the field that says what the files do not say;
/// [`TaskError::Input`] of a file with a fault, by its place, and of points and actuators that are not the surface's; [`TaskError::Work`]
/// where files cannot be written; [`TaskError::Cancelled`].
///
/// ```
/// use unripple_tasks::{Silent, import};
///
/// let folder = std::env::temp_dir().join(format!("unripple-import-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let header: Vec<String> = (1..=8).map(|n| format!("a{n} 62 90")).collect();
/// let mut text = format!("time_s,{}\n", header.join(","));
/// for sample in 0..=960 {
///     text += &format!("{}{}\n", f64::from(sample) / 48e3, if sample == 0 { ",1" } else { ",0" }.repeat(8));
/// }
/// std::fs::write(folder.join("taps.csv"), text)?;
/// let ask = import::Ask {
///     files: vec![folder.join("taps.csv")],
///     pattern: Some("{actuator} {x_mm} {y_mm}".into()),
///     kind: Some(import::Kind::ImpulseResponses),
///     unit: Some("mm/s".into()),
///     per: Some(import::Per::Newton),
///     output: folder.join("library"),
///     ..import::Ask::default()
/// };
/// assert_eq!(import::run(&ask, &mut Silent)?.points, 1);
/// # std::fs::remove_dir_all(folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    let record = Record::of(ask)?;
    check(ask, &surface)?;
    unused(ask)?;
    Library::may_be_at(&ask.output)?;
    go_on(progress)?;
    progress.stage("files");
    let labels = Labels::of(ask)?;
    let found = read::all(&ask.files, &labels, progress)?;
    go_on(progress)?;
    progress.stage("responses");
    let assembled = assembled(ask, &surface, found, progress)?;
    let plan = plan(ask, &record, &surface, &assembled)?;
    go_on(progress)?;
    let mut library = Library::create(&ask.output, &plan)?;
    record.log(&mut library)?;
    library.log("dead", if ask.without.is_empty() { Value::Null } else { json!(ask.without) })?;
    fill(&mut library, &assembled, progress)?;
    let done = library.done();
    wavelength::log(&mut library, &done, &surface)?;
    for left in &assembled.left_out {
        progress.tell(&format!("left out: {left}"));
    }
    Ok(Report::of(ask, &surface.name, &plan, assembled, wavelength::logged(&library)))
}

/// Refuses a request that makes no sense, before files are read.
fn check(ask: &Ask, surface: &Surface) -> Result<(), TaskError> {
    if ask.files.is_empty() {
        return Err(TaskError::ask("files", "a file or a folder to import", "none"));
    }
    if let Some([low, high]) = ask.band_hz
        && !(low >= 0.0 && low < high && high.is_finite())
    {
        return Err(TaskError::ask(
            "band_hz",
            "a frequency from 0 Hz up and a higher one",
            format!("{low}, {high}"),
        ));
    }
    if let Some(length) = ask.length_s {
        above_zero(length, "length_s", "s")?;
        if length > MOST_KEPT {
            return Err(TaskError::ask("length_s", format!("at most {MOST_KEPT} s"), format!("{length} s")));
        }
    }
    if ask.offset_m.iter().any(|offset| !offset.is_finite()) {
        return Err(TaskError::ask("offset_m", "finite numbers", format!("{:?}", ask.offset_m)));
    }
    let known = |name: &String| surface.actuators.iter().any(|actuator| actuator.name == *name);
    let all = || surface.actuators.iter().map(|a| a.name.as_str()).collect::<Vec<_>>().join(", ");
    for (field, unknown) in [
        ("actuator_names", ask.actuator_names.iter().map(|(name, _)| name).find(|name| !known(name))),
        ("without", ask.without.iter().find(|name| !known(name))),
    ] {
        if let Some(name) = unknown {
            return Err(TaskError::ask(field, format!("names among {}", all()), format!("`{name}`")));
        }
    }
    match ask.without.len() < surface.actuators.len() {
        true => Ok(()),
        false => Err(TaskError::ask("without", "an actuator that is left", "all of them")),
    }
}

/// Refuses what says actuators and places beside folders alone that say them themselves.
fn unused(ask: &Ask) -> Result<(), TaskError> {
    let given = [
        ("table", ask.table.as_ref().map(|path| path.display().to_string())),
        ("pattern", ask.pattern.clone()),
        ("length_unit", ask.length_unit.clone()),
    ];
    let given = given.into_iter().find_map(|(field, text)| text.map(|text| (field, text)));
    match given.filter(|_| ask.files.iter().all(|path| is_exported(path))) {
        Some((field, text)) => {
            let expected = "none, since folders that `export` wrote say actuators and places in m";
            Err(TaskError::ask(field, expected, format!("`{text}`")))
        }
        None => Ok(()),
    }
}

/// The plan of the library.
fn plan(
    ask: &Ask,
    record: &Record,
    surface: &Surface,
    assembled: &Assembled,
) -> Result<LibraryPlan, TaskError> {
    let Assembled { points, samples, conditions, .. } = assembled;
    let length = (samples - 1) as f64 / conditions.rate;
    carries(conditions, length).map_err(|error| TaskError::Input(format!("`length_s`: {error}")))?;
    let file = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let hashes: String = record.files.iter().map(|file| file.sha256.as_str()).collect();
    // Whatever changes a response must make another library, so that none is taken for one that was finished before.
    let options = serde_json::to_string(&Ask { files: Vec::new(), output: "".into(), ..ask.clone() });
    let hashes = [hashes, options.map_err(TaskError::work)?].concat();
    let about = [
        ("device", "import".to_owned()),
        ("files", ask.files.iter().map(|path| file(path)).collect::<Vec<_>>().join(", ")),
        ("sha256", of_bytes(hashes.as_bytes())),
        ("software", format!("unripple {}", env!("CARGO_PKG_VERSION"))),
        ("created", now()),
    ];
    let ports = surface.actuators.iter().map(|a| Port { name: a.name.clone(), at: a.at }).collect();
    Ok(LibraryPlan {
        drive_units: surface.actuators.iter().map(|a| unit(&a.kind).to_owned()).collect(),
        surface: Some(surface.clone()),
        provenance: about.into_iter().map(|(key, text)| (key.to_owned(), text)).collect(),
        ..LibraryPlan::new(ports, points.clone(), conditions.clone(), *samples)
    })
}

/// Stores the responses of all points that are missing in the library.
fn fill(library: &mut Library, assembled: &Assembled, progress: &mut dyn Progress) -> Result<(), TaskError> {
    let key = |at: &Point| [at.x.to_bits(), at.y.to_bits()];
    let index: HashMap<[u64; 2], usize> =
        assembled.points.iter().enumerate().map(|(point, at)| (key(at), point)).collect();
    let ports = library.plan().ports.clone();
    filling::fill(library, &[], progress, &mut |places| {
        let rows = places.iter().filter_map(|at| index.get(&key(at)));
        let data = rows.flat_map(|point| assembled.rows.row(*point)).collect();
        let conditions = assembled.conditions.clone();
        SampledResponses::new(ports.clone(), places.to_vec(), conditions, assembled.samples, data)
            .map_err(TaskError::work)
    })
}
