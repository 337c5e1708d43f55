//! Responses from WAV files: those that `export` writes, with `library.json`, and others, with a table or a pattern of their names.

use super::bytes::bytes;
use super::found::Found;
use super::labels::Labels;
use super::measured::{Measured, Says, Signal, Who};
use super::{Kind, Quantity, units};
use crate::TaskError;
use serde_json::Value;
use std::path::Path;
use unripple_store::read_wav;

/// The file beside WAV files that `export` has written.
const INDEX: &str = "library.json";

/// Whether a folder is one that `export` has written, which says actuators and places itself.
pub(super) fn is_exported(path: &Path) -> bool {
    path.join(INDEX).is_file()
}

/// Reads the WAV files of a folder.
pub(super) fn folder(path: &Path, labels: &Labels, found: &mut Found) -> Result<(), TaskError> {
    if is_exported(path) {
        return exported(path, &path.join(INDEX), labels, found);
    }
    let refused = |error: std::io::Error| TaskError::Input(format!("{}: {error}", path.display()));
    let mut files = Vec::new();
    for entry in std::fs::read_dir(path).map_err(refused)? {
        let file = entry.map_err(refused)?.path();
        if file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wav")) {
            files.push(file);
        }
    }
    if files.is_empty() {
        return Err(TaskError::Input(format!("{}: expected WAV files, found none", path.display())));
    }
    files.sort();
    files.iter().try_for_each(|name| file(name, labels, found))
}

/// Reads a WAV file whose actuator and place a table or its name says.
pub(super) fn file(path: &Path, labels: &Labels, found: &mut Found) -> Result<(), TaskError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let from = path.display().to_string();
    let wav = read_wav(path)?;
    let labels = labels.named(&name, &from)?;
    let channels = wav.channels.len();
    for label in labels {
        let channel = label.channel.or((channels == 1).then_some(1)).filter(|channel| *channel <= channels);
        let Some(channel) = channel else {
            return Err(TaskError::Input(format!(
                "{}: expected a `channel` from 1 to {channels} for `{name}`, found {}",
                label.from,
                label.channel.map_or("none".into(), |channel| channel.to_string())
            )));
        };
        let at = label.place(&name)?;
        found.responses.push(Measured {
            from: if channels == 1 { from.clone() } else { format!("{from}: channel {channel}") },
            who: label.who,
            at,
            signal: Signal::Time {
                start: 0.0,
                step: 1.0 / wav.rate,
                values: wav.channels[channel - 1].clone(),
            },
            sign: 1.0,
            says: Says::default(),
        });
    }
    Ok(())
}

/// Reads what `export` has written: a file for each point, with a channel for each actuator.
fn exported(path: &Path, index: &Path, labels: &Labels, found: &mut Found) -> Result<(), TaskError> {
    let file = index.display().to_string();
    let refused = |expected: &str, found: String| {
        TaskError::Input(format!("{file}: expected {expected}, found {found}"))
    };
    let about: Value = serde_json::from_slice(&bytes(index)?)
        .map_err(|error| refused("the JSON that `export` writes", error.to_string()))?;
    let list = |key: &str| {
        about[key].as_array().ok_or_else(|| refused(&format!("a list `{key}`"), about[key].to_string()))
    };
    let place = |value: &Value| match (value[0].as_f64(), value[1].as_f64()) {
        (Some(x), Some(y)) => Ok(labels.moved(x, y)),
        _ => Err(refused("a place `at_m`", value.to_string())),
    };
    let onset = about["onset_s"].as_f64().unwrap_or(0.0);
    let mut actuators = Vec::new();
    for actuator in list("actuators")? {
        let name = actuator["name"].as_str().unwrap_or_default().to_owned();
        let unit = actuator["drive_unit"].as_str().unwrap_or_default();
        let says = Says {
            kind: Some(Kind::ImpulseResponses),
            unit: Some((Quantity::Velocity, 1.0)),
            per: units::reference(unit),
            ..Says::default()
        };
        actuators.push((Who { names: vec![name], at: Some(place(&actuator["at_m"])?) }, says));
    }
    for entry in list("files")? {
        let name = entry["file"].as_str().unwrap_or_default();
        let at = place(&entry["at_m"])?;
        // A name alone: nothing outside the folder is read.
        if name.is_empty() || Path::new(name).file_name().is_none_or(|alone| alone != name) {
            return Err(refused("the name of a WAV file", format!("`{name}`")));
        }
        let wav = read_wav(path.join(name))?;
        if wav.channels.len() != actuators.len() {
            let found = format!("{} in {name}", wav.channels.len());
            return Err(refused(&format!("{} channels", actuators.len()), found));
        }
        for (values, (who, says)) in wav.channels.into_iter().zip(&actuators) {
            let signal = Signal::Time { start: -onset, step: 1.0 / wav.rate, values };
            let from = format!("{}: {}", path.join(name).display(), who.names[0]);
            found.responses.push(Measured { from, who: who.clone(), at, signal, sign: 1.0, says: *says });
        }
    }
    Ok(())
}
