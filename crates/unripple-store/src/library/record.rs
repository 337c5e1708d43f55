//! The record of a library's measurement: a log, and the reasons to doubt the library.

use super::{Library, disk, manifest};
use crate::StoreError;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the record: a Zarr group of its own, so that readers of Zarr accept it.
const FOLDER: &str = "calibration";
/// The attribute of the Zarr group that holds the record.
const KEY: &str = "unripple_calibration";
/// The attribute with the checksum of [`KEY`].
const CHECK: &str = "crc32c";
/// Version of the content of [`KEY`]; a record of another version counts as a doubt.
const FORMAT: u32 = 1;
/// Name of the check that finds the record itself damaged.
const OF_RECORD: &str = "record";

/// A reason to doubt a library, or some of its points.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Doubt {
    /// Name of the check that found it, a short word: `reciprocity`, `latency`, `model`.
    pub check: String,
    /// What was found, what it should be and what to do, in a sentence. Points and channels count from 1.
    pub what: String,
    /// Indices of the points concerned, from 0, ascending; empty if it is the whole library.
    #[serde(default)]
    pub points: Vec<usize>,
}

impl Doubt {
    /// A doubt about the whole library.
    ///
    /// ```
    /// use unripple_store::Doubt;
    /// let doubt = Doubt::of("model", "point 3: expected what the sheet does, found something else").at(vec![2]);
    /// assert_eq!((doubt.check.as_str(), doubt.points), ("model", vec![2]));
    /// ```
    pub fn of(check: &str, what: impl Into<String>) -> Self {
        Self { check: check.into(), what: what.into(), points: Vec::new() }
    }

    /// This doubt restricted to some points, given by their indices from 0.
    #[must_use]
    pub fn at(self, points: Vec<usize>) -> Self {
        Self { points, ..self }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

/// All that is stored beside the plan and the responses.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Record {
    format: u32,
    doubtful: Vec<Doubt>,
    log: BTreeMap<String, Value>,
    points: BTreeMap<usize, Value>,
}

impl Record {
    /// The record for a library in which points have other indices; `pairs` are (new, old) indices of the points that
    /// it keeps.
    pub(crate) fn renumbered(&self, pairs: &[(usize, usize)]) -> Self {
        let new = |old: &usize| pairs.iter().find(|(_, other)| other == old).map(|(new, _)| *new);
        let doubtful = self.doubtful.iter().map(|doubt| {
            let points = doubt.points.iter().filter_map(new).collect();
            Doubt { points, ..doubt.clone() }
        });
        let points = self.points.iter().filter_map(|(old, said)| Some((new(old)?, said.clone())));
        Self { doubtful: doubtful.collect(), points: points.collect(), ..self.clone() }
    }
}

/// Where the record is.
pub(crate) fn path(root: &Path) -> PathBuf {
    root.join(FOLDER).join("zarr.json")
}

/// The record of a library; an empty one if it has none.
///
/// # Errors
/// [`StoreError::Content`] and [`StoreError::Read`] for damage.
pub(crate) fn read(root: &Path) -> Result<Record, StoreError> {
    let file = path(root);
    if fs::symlink_metadata(&file).is_err() {
        return Ok(Record::default());
    }
    let name = file.display().to_string();
    let wrong = |expected: &str, found: String| Err(StoreError::content(&name, expected, found));
    let group = manifest::json(&file)?;
    let attributes = group.get("attributes").unwrap_or(&Value::Null);
    let Some(value) = attributes.get(KEY) else {
        return wrong("the record of a calibration", format!("a file without `{KEY}`"));
    };
    let stated = attributes.get(CHECK).and_then(Value::as_str).unwrap_or_default();
    let found = manifest::checksum(value);
    if stated != found {
        return wrong(&format!("a text with the checksum `{stated}`"), format!("`{found}`"));
    }
    match value.get("format") {
        Some(format) if *format == json!(FORMAT) => {}
        other => {
            let found = other.map_or("none".into(), Value::to_string);
            return wrong(&format!("a record of format {FORMAT}"), found);
        }
    }
    serde_json::from_value(value.clone())
        .or_else(|error| wrong("the record of a calibration", error.to_string()))
}

/// The record, or one whose only doubt is that it cannot be read, so that a library is not trusted because a file is
/// damaged.
pub(crate) fn read_or_doubt(root: &Path) -> Record {
    read(root).unwrap_or_else(|error| {
        let what = format!("the record of its calibration cannot be read, nor the doubts in it ({error})");
        Record { doubtful: vec![Doubt::of(OF_RECORD, what)], ..Record::default() }
    })
}

impl Library {
    /// Reasons to doubt the library, sorted by the name of the check that found them; empty if there are none. A
    /// record that cannot be read is such a reason.
    pub fn doubts(&self) -> &[Doubt] {
        &self.record.doubtful
    }

    /// Stores the reasons for doubt that the check named `check` has found, in place of those that it found
    /// before; an empty list removes them.
    ///
    /// # Errors
    /// [`StoreError::Write`], or [`StoreError::Occupied`] if another process writes.
    pub fn set_doubts(&mut self, check: &str, found: Vec<Doubt>) -> Result<(), StoreError> {
        self.acquire()?;
        let mut doubtful: Vec<Doubt> =
            self.record.doubtful.iter().filter(|doubt| doubt.check != check).cloned().collect();
        doubtful.extend(found.into_iter().map(|doubt| Doubt { check: check.into(), ..doubt }));
        doubtful.sort_by(|a, b| a.check.cmp(&b.check));
        self.write_record(Record { doubtful, ..self.record.clone() })
    }

    /// The entry of the measurement's log under a key.
    pub fn logged(&self, key: &str) -> Option<&Value> {
        self.record.log.get(key)
    }

    /// The whole log of the measurement, by key.
    pub fn log_book(&self) -> &BTreeMap<String, Value> {
        &self.record.log
    }

    /// Stores a value in the log under a key, in place of the one before; `null` removes it.
    ///
    /// # Errors
    /// As [`Library::set_doubts`].
    pub fn log(&mut self, key: &str, value: Value) -> Result<(), StoreError> {
        self.acquire()?;
        let mut record = self.record.clone();
        match value {
            Value::Null => record.log.remove(key),
            value => record.log.insert(key.into(), value),
        };
        self.write_record(record)
    }

    /// The log entry of a point: how it was measured.
    pub fn logged_point(&self, point: usize) -> Option<&Value> {
        self.record.points.get(&point)
    }

    /// Stores log entries of points, by index of the point. If the old and the new entry are objects, they are merged
    /// key by key, and a `null` removes its key; otherwise the new entry replaces the old one, and `null` removes it.
    /// The record is written once for all points.
    ///
    /// # Errors
    /// As [`Library::set_doubts`]; [`StoreError::Content`] for a point beyond the last.
    pub fn log_points(&mut self, points: BTreeMap<usize, Value>) -> Result<(), StoreError> {
        points.keys().try_for_each(|point| self.within(*point))?;
        self.acquire()?;
        let mut record = self.record.clone();
        for (point, value) in points {
            match (record.points.get_mut(&point), value) {
                (Some(Value::Object(known)), Value::Object(new)) => {
                    known.extend(new);
                    known.retain(|_, value| !value.is_null());
                }
                (_, Value::Null) => drop(record.points.remove(&point)),
                (_, mut value) => {
                    if let Value::Object(new) = &mut value {
                        new.retain(|_, value| !value.is_null());
                    }
                    record.points.insert(point, value);
                }
            }
        }
        self.write_record(record)
    }

    /// Removes the log entries of points, and the doubts about these points alone.
    pub(crate) fn forget_points(&mut self, points: &[usize]) -> Result<(), StoreError> {
        let mut record = self.record.clone();
        points.iter().for_each(|point| drop(record.points.remove(point)));
        record.doubtful.retain_mut(|doubt| {
            let whole = doubt.points.is_empty();
            doubt.points.retain(|point| !points.contains(point));
            whole || !doubt.points.is_empty()
        });
        self.write_record(record)
    }

    /// Indices of the actuators that were found dead or left out when the library was measured: their responses are
    /// zero.
    pub fn dead(&self) -> Vec<usize> {
        let named: Vec<&str> = self
            .logged("dead")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(Value::as_str)
            .collect();
        let ports = self.plan.ports.iter().enumerate();
        ports.filter(|(_, port)| named.contains(&port.name.as_str())).map(|(index, _)| index).collect()
    }

    /// Reason why the scale of the recordings is unknown; `None` if it is known. If it is unknown,
    /// displacements and velocities computed from the library have no absolute value.
    pub fn without_scale(&self) -> Option<&str> {
        self.logged("scale")?.get("unknown")?.as_str()
    }

    /// Writes a record in place of the one on disk.
    pub(crate) fn write_record(&mut self, record: Record) -> Result<(), StoreError> {
        let unchanged = record == self.record && read(&self.root).is_ok_and(|there| there == record);
        if unchanged {
            return Ok(());
        }
        let record = Record { format: FORMAT, ..record };
        let file = path(&self.root);
        let failed = |e: serde_json::Error| {
            StoreError::content(&file.display().to_string(), "a record that JSON holds", e.to_string())
        };
        let value = serde_json::to_value(&record).map_err(failed)?;
        let check = manifest::checksum(&value);
        let group =
            json!({ "zarr_format": 3, "node_type": "group", "attributes": { KEY: value, CHECK: check } });
        let bytes = serde_json::to_vec_pretty(&group).map_err(failed)?;
        let folder = self.root.join(FOLDER);
        if !folder.is_dir() {
            fs::create_dir(&folder).map_err(StoreError::write(&folder))?;
            disk::sync_folder(&self.root)?;
        }
        disk::write(&file, &[&bytes])?;
        disk::sync_folder(&folder)?;
        self.record = record;
        Ok(())
    }
}
