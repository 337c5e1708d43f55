//! A library's metadata.

use super::disk;
use super::outline::{OutlineText, place, point};
use super::plan::LibraryPlan;
use crate::{StoreError, parse_surface, to_toml};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use unripple_core::{Conditions, Point, Port};

/// Largest JSON text of a library in bytes, 16 MiB: what is longer is refused before it is read into memory.
const LARGEST: u64 = 1 << 24;
/// The attribute that says that a Zarr group is a library of responses.
const KEY: &str = "unripple_library";
/// The attribute with the checksum of [`KEY`].
const CHECK: &str = "crc32c";
/// Version of the content of [`KEY`]; a library of another version is refused, with its version in the message.
const FORMAT: u32 = 1;

/// Where the metadata of a library, or of an array in it, are.
pub(crate) fn path(folder: &Path) -> PathBuf {
    folder.join("zarr.json")
}

/// Everything about a library that fits a text.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    format: u32,
    quantity: String,
    unit: String,
    points: usize,
    samples: usize,
    sample_rate_hz: f64,
    band_hz: [f64; 2],
    lambda_min_m: f64,
    onset_s: f64,
    actuators: Vec<PortText>,
    outline: OutlineText,
    surface: Option<String>,
    provenance: BTreeMap<String, String>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PortText {
    name: String,
    at_m: [f64; 2],
    drive_unit: String,
}

/// The metadata of the whole as a Zarr group.
pub(crate) fn encode(plan: &LibraryPlan, file: &str) -> Result<Vec<u8>, StoreError> {
    let surface = plan.surface.as_ref().map(to_toml);
    if let Some(text) = &surface
        && parse_surface(text, file).ok().as_ref() != plan.surface.as_ref()
    {
        return Err(StoreError::content(file, "a surface that a surface file can hold", "another"));
    }
    let units = plan.ports.iter().zip(&plan.drive_units);
    let conditions = &plan.conditions;
    let text = Text {
        format: FORMAT,
        quantity: "normal velocity per impulse of drive".into(),
        unit: "m/s per (drive unit times second)".into(),
        points: plan.points.len(),
        samples: plan.samples,
        sample_rate_hz: conditions.rate,
        band_hz: conditions.band,
        lambda_min_m: conditions.lambda_min,
        onset_s: plan.onset,
        actuators: units
            .map(|(port, unit)| PortText {
                name: port.name.clone(),
                at_m: place(port.at),
                drive_unit: unit.clone(),
            })
            .collect(),
        outline: (&conditions.outline).into(),
        surface,
        provenance: plan.provenance.clone(),
    };
    let failed =
        |error: serde_json::Error| StoreError::content(file, "a plan that JSON holds", error.to_string());
    let value = serde_json::to_value(text).map_err(failed)?;
    let check = checksum(&value);
    let group = json!({ "zarr_format": 3, "node_type": "group", "attributes": { KEY: value, CHECK: check } });
    let bytes = serde_json::to_vec_pretty(&group).map_err(failed)?;
    if bytes.len() as u64 > LARGEST {
        return Err(StoreError::content(
            file,
            format!("a description of the library of at most {LARGEST} bytes"),
            bytes.len().to_string(),
        ));
    }
    Ok(bytes)
}

/// The plan of a library without its points, and how many there are.
pub(crate) fn read(folder: &Path) -> Result<(LibraryPlan, usize), StoreError> {
    let file = path(folder);
    let name = file.display().to_string();
    let group = json(&file)?;
    let wrong = |expected: &str, found: String| Err(StoreError::content(&name, expected, found));
    if group.get("zarr_format") != Some(&json!(3)) || group.get("node_type") != Some(&json!("group")) {
        return wrong("a Zarr group of format 3", "something else".into());
    }
    let attributes = group.get("attributes").unwrap_or(&Value::Null);
    let Some(value) = attributes.get(KEY) else {
        return wrong("a library of responses", format!("a Zarr group without `{KEY}`"));
    };
    let stated = attributes.get(CHECK).and_then(Value::as_str).unwrap_or_default();
    let found = checksum(value);
    if stated != found {
        return wrong(&format!("a text with the checksum `{stated}`"), format!("`{found}`"));
    }
    match value.get("format") {
        Some(format) if *format == json!(FORMAT) => {}
        other => {
            let found = other.map_or("none".into(), Value::to_string);
            return wrong(&format!("a library of format {FORMAT}"), found);
        }
    }
    match serde_json::from_value::<Text>(value.clone()) {
        Ok(text) => plan(text, &name),
        Err(error) => wrong("the description of a library", error.to_string()),
    }
}

/// A JSON file of bounded size.
pub(crate) fn json(file: &Path) -> Result<Value, StoreError> {
    let bytes = disk::read_bounded(file, LARGEST)?;
    let name = file.display().to_string();
    serde_json::from_slice(&bytes).map_err(|error| StoreError::content(&name, "JSON", error.to_string()))
}

/// CRC-32C of the JSON text without spaces and line breaks, so that other tools may reformat it.
pub(crate) fn checksum(value: &Value) -> String {
    format!("{:08x}", crc32c::crc32c(value.to_string().as_bytes()))
}

fn plan(text: Text, file: &str) -> Result<(LibraryPlan, usize), StoreError> {
    let surface = text.surface.map(|toml| parse_surface(&toml, file)).transpose()?;
    let (ports, drive_units) =
        text.actuators.into_iter().map(|a| (Port { name: a.name, at: point(a.at_m) }, a.drive_unit)).unzip();
    let plan = LibraryPlan {
        ports,
        drive_units,
        points: vec![Point::default()],
        conditions: Conditions {
            rate: text.sample_rate_hz,
            band: text.band_hz,
            lambda_min: text.lambda_min_m,
            outline: text.outline.into(),
        },
        samples: text.samples,
        onset: text.onset_s,
        surface,
        provenance: text.provenance,
    };
    plan.check(file)?;
    Ok((plan, text.points))
}
