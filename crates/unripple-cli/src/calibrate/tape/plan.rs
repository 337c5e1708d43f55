//! What is to be played, and what is to be recorded of it.

use crate::calibrate::points::Places;
use crate::error::CliError;
use serde_json::{Value, json};
use std::path::Path;
use unripple::core::{Device, Drive, Layout, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Listen, MeasureOptions, Rig, Session};
use unripple_devices::Tape;
use unripple_store::{write_file, write_wav};

/// What is to be played.
pub const PLAY: &str = "play.wav";

/// What was planned.
const PLAN: &str = "plan.json";

/// A recording that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Number of the point; that after the last stands for the actuators.
    pub number: usize,
    /// Number of the repeat there.
    pub repeat: usize,
    /// Its file's name.
    pub file: String,
    /// Where the probe is to be, if that matters.
    pub at: Option<Point>,
}

/// All recordings of a calibration, in order; first that of the actuators, where anything tells of them.
pub fn wanted(places: &Places, hears_itself: bool, repeats: usize) -> Vec<Wanted> {
    let digits = places.probed.to_string().len().max(3);
    let last = |repeat: usize| if repeat == 0 { String::new() } else { format!("-{}", repeat + 1) };
    let own = (0..repeats).filter(|_| hears_itself).map(|repeat| Wanted {
        number: places.points.len(),
        repeat,
        file: format!("actuators{}.wav", last(repeat)),
        at: None,
    });
    let points = places.points.iter().take(places.probed).enumerate();
    let points = points.flat_map(|(number, at)| {
        (0..repeats).map(move |repeat| Wanted {
            number,
            repeat,
            file: format!("point-{:0digits$}{}.wav", number + 1, last(repeat)),
            at: Some(*at),
        })
    });
    own.chain(points).collect()
}

/// A rig that hears nothing, and keeps what is driven in one recording.
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
        Err(CalibrateError::Rig { number, why: "a tape cannot tap".into() })
    }
}

/// What a session drives for one recording, full scale as 1.
pub fn drive(session: &Session, layout: &Layout, at: Point) -> Result<Drive, CliError> {
    let mut recorder = Recorder(Tape::recorder(layout.clone()).map_err(CliError::input)?);
    let listen = if session.wires().probe.is_some() { Listen::Probe } else { Listen::Sensors };
    let found = session.measure(&mut recorder, 0, at, 0, listen);
    // What it finds in the silence that it hears does not matter, error or not, once all was driven.
    if recorder.0.drive().iter().all(Vec::is_empty) {
        found?;
    }
    let channels = recorder.0.into_drive();
    let channels = channels.into_iter().map(|line| line.into_iter().map(f64::from).collect()).collect();
    Drive::new(layout.rate, layout.outputs.clone(), channels).map_err(CliError::input)
}

/// The plan as it is told in the folder, SI units.
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
        "format": 1,
        "surface": surface,
        "play": PLAY,
        "sample_rate_hz": layout.rate,
        "duration_s": drive.duration(),
        "full_scale": layout.full_scale,
        "outputs": layout.outputs,
        "inputs": layout.inputs,
        "sweep_s": settings.sweep,
        "sweeps_begin_s": drive.channels().iter().map(begins).collect::<Vec<_>>(),
        "level": settings.level,
        "repeats": settings.repeats,
        "recordings": recordings.collect::<Vec<_>>(),
    })
}

/// Puts what is to be played and the plan into the folder, unless they are there; another plan is refused.
pub fn put(folder: &Path, plan: &Value, drive: &Drive) -> Result<(), CliError> {
    let failed = |error: std::io::Error| CliError::Work(format!("{}: {error}", folder.display()));
    let (file, play) = (folder.join(PLAN), folder.join(PLAY));
    let text = serde_json::to_string_pretty(plan).map_err(CliError::work)? + "\n";
    match std::fs::read_to_string(&file) {
        Ok(found) if found == text => {}
        Ok(found) => return Err(differs(&file, plan, &found)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            std::fs::create_dir_all(folder).map_err(failed)?;
            if std::fs::read_dir(folder).map_err(failed)?.next().is_some() {
                return Err(CliError::Work(format!(
                    "will not write to {}: expected no such folder yet, an empty one, or one with the plan of this \
                     calibration, found one with other things in it",
                    folder.display()
                )));
            }
            // The plan first: what is to be played is written again wherever a plan is without it.
            write_file(&file, text.as_bytes())?;
        }
        Err(error) => return Err(failed(error)),
    }
    // Whoever has played it may have moved it away.
    if !play.exists() {
        write_wav(&play, drive)?;
    }
    Ok(())
}

/// Says what another plan has otherwise.
fn differs(file: &Path, plan: &Value, found: &str) -> CliError {
    let found: Value = serde_json::from_str(found).unwrap_or_default();
    let keys = plan.as_object().into_iter().flatten();
    let other = keys.map(|(key, value)| (key, value.to_string(), found.get(key).map(Value::to_string)));
    let said =
        other.into_iter().find(|(_, here, there)| there.as_ref() != Some(here)).map(|(key, here, there)| {
            let short = |text: String| match text.char_indices().nth(60) {
                Some((at, _)) => format!("{}...", &text[..at]),
                None => text,
            };
            format!("`{key}` {} instead of {}", short(there.unwrap_or_else(|| "nothing".into())), short(here))
        });
    CliError::Work(format!(
        "{}: expected the plan of this calibration, found {}; use its options again, or another folder",
        file.display(),
        said.unwrap_or_else(|| "other text".into())
    ))
}
