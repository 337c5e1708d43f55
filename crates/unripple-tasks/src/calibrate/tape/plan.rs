//! The plan of a calibration by recordings: the signal to play, and the recordings to make of it.

use super::planned::{PlannedPoints, Wanted};
use crate::TaskError;
use crate::calibrate::ask::Ask;
use serde_json::{Value, json};
use std::path::Path;
use unripple::core::{Device, Drive, Layout, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Listen, MeasureOptions, Rig, Session};
use unripple_devices::Tape;
use unripple_store::{write_file, write_wav};

/// Name of the file that is to be played.
pub const PLAY: &str = "play.wav";

/// Name of the file that contains the plan.
const PLAN: &str = "plan.json";

/// Version of the plan's format; another one is refused.
const FORMAT: u32 = 1;

/// Relative difference below which two numbers in plans count as the same; versions of the program may
/// round differently.
const SAME: f64 = 1e-9;

/// Keys that a plan of an earlier version may lack.
const NEW: [&str; 2] = ["ringing_s", "sweep_from_hz"];

/// Reads the plan in a folder; `None` if the folder has none.
pub fn found(folder: &Path) -> Result<Option<Value>, TaskError> {
    let file = folder.join(PLAN);
    let wrong = |expected: &str, found: String| {
        TaskError::Work(format!("{}: expected {expected}, found {found}", file.display()))
    };
    let text = match std::fs::read_to_string(&file) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(TaskError::Work(format!("{}: {error}", file.display()))),
    };
    let plan: Value = serde_json::from_str(&text)
        .map_err(|error| wrong("a plan that `calibrate` wrote", error.to_string()))?;
    match &plan["format"] {
        format if *format == json!(FORMAT) => Ok(Some(plan)),
        other => Err(wrong(&format!("a plan of format {FORMAT}"), other.to_string())),
    }
}

/// Takes over settings from an existing plan where the request does not specify them, so that recordings
/// are evaluated with the settings that they were made with.
pub fn apply(plan: &Value, ask: &Ask, settings: &mut MeasureOptions) {
    let seconds = |key: &str| plan[key].as_f64().filter(|seconds| *seconds > 0.0 && *seconds < 60.0);
    let usual = MeasureOptions::default();
    settings.settle_time = seconds("ringing_s").unwrap_or(usual.settle_time);
    settings.start_hz = plan["sweep_from_hz"].as_f64().filter(|hz| *hz > 0.0).unwrap_or(usual.start_hz);
    if ask.sweep_s.is_none() {
        settings.sweep = seconds("sweep_s").unwrap_or(settings.sweep);
    }
    // A plan that does not say is of a time when as much was kept of every surface.
    if ask.response_s.is_none() && seconds("ringing_s").is_none() {
        settings.response_length = usual.response_length;
    }
}

/// A rig whose inputs are silent, and which stores the drive of one recording.
struct Recorder(Tape);

impl Rig for Recorder {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.0
    }

    fn ready(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        let layout = self.0.layout().clone();
        let fresh = Tape::recorder(layout);
        self.0 = fresh.map_err(|error| CalibrateError::Rig { number, why: error.to_string() })?;
        Ok(())
    }

    fn tap(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        Err(CalibrateError::Rig { number, why: "recordings made elsewhere cannot be taps".into() })
    }
}

/// The drive that a session plays for one recording, in units of full scale, with one channel per actuator.
pub fn drive(session: &Session, layout: &Layout, at: Point) -> Result<Drive, TaskError> {
    let mut recorder = Recorder(Tape::recorder(layout.clone()).map_err(TaskError::input)?);
    let listen = if session.wires().probe.is_some() { Listen::Probe } else { Listen::Sensors };
    let found = session.measure(&mut recorder, 0, at, 0, listen);
    // What it finds in the silence that it records does not matter, error or not, once all was driven.
    if recorder.0.drive().iter().all(Vec::is_empty) {
        found?;
    }
    let channels = recorder.0.into_drive();
    let channels = channels.into_iter().map(|line| line.into_iter().map(f64::from).collect()).collect();
    Drive::new(layout.rate, layout.outputs.clone(), channels).map_err(TaskError::input)
}

/// The plan as it is written to the folder, in SI units.
pub fn told(
    surface: &str,
    layout: &Layout,
    drive: &Drive,
    settings: &MeasureOptions,
    wanted: &[Wanted],
) -> Value {
    let begins = |line: &Vec<f64>| line.iter().position(|x| *x != 0.0).map(|i| i as f64 / layout.rate);
    let recordings = wanted.iter().map(|one| {
        json!({ "file": one.file, "probe_at_m": one.at.map(|at| [at.x, at.y]), "repeat": one.repeat + 1 })
    });
    json!({
        "format": FORMAT,
        "surface": surface,
        "play": PLAY,
        "sample_rate_hz": layout.rate,
        "duration_s": drive.duration(),
        "full_scale": layout.full_scale,
        "outputs": layout.outputs,
        "inputs": layout.inputs,
        "sweep_s": settings.sweep,
        "sweep_from_hz": settings.start_hz,
        "ringing_s": settings.settle_time,
        "sweeps_begin_s": drive.channels().iter().map(begins).collect::<Vec<_>>(),
        "level": settings.level,
        "repeats": settings.repeats,
        "recordings": recordings.collect::<Vec<_>>(),
    })
}

/// Writes the plan and the file to play into the folder, unless they exist. An earlier plan with fewer
/// points is extended; one that differs otherwise is refused with a list of all differences.
pub fn put(folder: &Path, plan: &Value, drive: &Drive, before: Option<&Value>) -> Result<(), TaskError> {
    let failed = |error: std::io::Error| TaskError::Work(format!("{}: {error}", folder.display()));
    let (file, play) = (folder.join(PLAN), folder.join(PLAY));
    let text = serde_json::to_string_pretty(plan).map_err(TaskError::work)? + "\n";
    match before {
        Some(before) => {
            let other = differences(plan, before);
            if !other.is_empty() {
                return Err(TaskError::Work(format!(
                    "{}: expected the plan of this calibration, found another:\n{}\nuse its options again, or another folder",
                    file.display(),
                    other.join("\n")
                )));
            }
            if plan["recordings"] != before["recordings"] {
                write_file(&file, text.as_bytes())?;
            }
        }
        None => {
            std::fs::create_dir_all(folder).map_err(failed)?;
            if std::fs::read_dir(folder).map_err(failed)?.next().is_some() {
                return Err(TaskError::Work(format!(
                    "will not write to {}: expected no such folder yet, an empty one, or one with the plan of this \
                     calibration, found one with other things in it",
                    folder.display()
                )));
            }
            // The plan first: what is to be played is written again wherever a plan is without it.
            write_file(&file, text.as_bytes())?;
        }
    }
    // Whoever has played it may have moved it away.
    if !play.exists() {
        write_wav(&play, drive)?;
    }
    Ok(())
}

/// The differences between two plans, a line for each key, recordings last.
fn differences(plan: &Value, before: &Value) -> Vec<String> {
    let keys = plan.as_object().into_iter().flatten().filter(|(key, _)| *key != "recordings");
    let mut other: Vec<String> = keys
        .filter(|(key, here)| match before.get(key.as_str()) {
            Some(there) => !same(here, there),
            None => !NEW.contains(&key.as_str()),
        })
        .map(|(key, here)| {
            let there = before.get(key).map_or("nothing".to_owned(), Value::to_string);
            format!("  \"{key}\": {there} in the folder, {here} requested")
        })
        .collect();
    if other.is_empty() {
        other.extend(PlannedPoints::of(before).lost(&PlannedPoints::of(plan)));
    }
    other
}

/// Whether two values are the same, numbers within the last digits.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            (a - b).abs() <= SAME * a.abs().max(b.abs())
        }
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        _ => a == b,
    }
}
