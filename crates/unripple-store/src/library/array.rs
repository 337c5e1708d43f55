//! One checksummed Zarr v3 array of a library.

use super::bands::{self, Bands};
use super::plan::LibraryPlan;
use super::{disk, manifest};
use crate::StoreError;
use crate::underway::undisturbed;
use serde_json::{Value, json};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Points whose states, or qualities, are in one chunk: few files to open, little to write again for each point.
pub(crate) const BLOCK: usize = 256;

/// Points whose qualities by bands are in one chunk, which is then about as large as one of qualities.
const BAND_BLOCK: usize = 64;

/// Bytes of the crc32c checksum behind each chunk. Its 32 bits; readers of Zarr expect as many.
const CHECK: usize = 4;

/// Type of an array's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    U8,
    F32,
    F64,
}

/// One Zarr array of a library: chunked along its first axis only, checksummed, nothing compressed.
#[derive(Clone, Debug)]
pub(crate) struct Array {
    /// Name of the array, and of its folder.
    pub name: &'static str,
    shape: Vec<usize>,
    /// Length of a chunk along the first axis.
    pub along: usize,
    kind: Kind,
    axes: &'static [&'static str],
    attributes: Value,
}

/// The arrays of a library.
#[derive(Clone, Debug)]
pub(crate) struct Arrays {
    /// Impulse responses, `[point][actuator][sample]`, float32.
    pub responses: Array,
    /// Positions of the points in metres, `[point][2]`, float64.
    pub position: Array,
    /// State of each point: missing, measured or bad.
    pub state: Array,
    /// Quality of each response, `[point][actuator][figure]`.
    pub quality: Array,
    /// Relative error of reciprocity, one value for the whole library.
    pub reciprocity: Array,
    /// Quality by third-octave bands; only some libraries have it.
    pub bands: Option<Bands>,
}

impl Arrays {
    /// Shapes and types of the arrays that a plan requires.
    pub fn of(plan: &LibraryPlan) -> Self {
        let (points, ports) = (plan.points.len(), plan.ports.len());
        let responses = Array {
            name: "responses",
            shape: vec![points, ports, plan.samples],
            along: 1,
            kind: Kind::F32,
            axes: &["point", "actuator", "sample"],
            attributes: json!({ "units": "m/s per (drive unit times second)" }),
        };
        let position = Array {
            name: "position",
            shape: vec![points, 2],
            along: points,
            kind: Kind::F64,
            axes: &["point", "xy"],
            attributes: json!({ "units": "m" }),
        };
        let state = Array {
            name: "state",
            shape: vec![points],
            along: BLOCK,
            kind: Kind::U8,
            axes: &["point"],
            attributes: json!({ "meaning": ["missing", "measured", "bad"] }),
        };
        let quality = Array {
            name: "quality",
            shape: vec![points, ports, 4],
            along: BLOCK,
            kind: Kind::F64,
            axes: &["point", "actuator", "figure"],
            attributes: json!({ "figure": ["signal_to_noise_db", "coherence", "distortion", "decay_time_s"] }),
        };
        let reciprocity = Array {
            name: "reciprocity_error",
            shape: vec![],
            along: 1,
            kind: Kind::F64,
            axes: &[],
            attributes: json!({}),
        };
        Self { responses, position, state, quality, reciprocity, bands: None }
    }

    /// All arrays of the library, in the order in which they are checked.
    pub fn all(&self) -> impl Iterator<Item = &Array> {
        let always = [&self.responses, &self.position, &self.state, &self.quality, &self.reciprocity];
        always.into_iter().chain(self.bands.as_ref().map(|bands| &bands.array))
    }

    /// The arrays of quality figures, in which NaN means unknown.
    pub fn known_or_not(&self) -> impl Iterator<Item = &Array> {
        [&self.quality, &self.reciprocity].into_iter().chain(self.bands.as_ref().map(|bands| &bands.array))
    }
}

impl Array {
    /// The name of the array of qualities by bands.
    pub const BANDS: &str = "bands";

    /// The array of quality by bands, `[point][actuator][band][figure]`, for `count` bands.
    pub fn by_bands(plan: &LibraryPlan, count: usize, attributes: Value) -> Self {
        Self {
            name: Self::BANDS,
            shape: vec![plan.points.len(), plan.ports.len(), count, bands::FIGURES],
            along: BAND_BLOCK,
            kind: Kind::F64,
            // Not `figure`, which is of another length beside it: readers that know dimensions by name want one length for each.
            axes: &["point", "actuator", "band", "band_figure"],
            attributes,
        }
    }

    /// The array's metadata, as in its `zarr.json`.
    pub fn metadata(&self) -> Value {
        let (kind, fill) = match self.kind {
            Kind::U8 => ("uint8", json!(0)),
            Kind::F32 => ("float32", json!("NaN")),
            Kind::F64 => ("float64", json!("NaN")),
        };
        let chunk: Vec<usize> = self.chunk_shape().collect();
        json!({
            "zarr_format": 3,
            "node_type": "array",
            "shape": self.shape,
            "data_type": kind,
            "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": chunk } },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "." } },
            "fill_value": fill,
            "codecs": [{ "name": "bytes", "configuration": { "endian": "little" } }, { "name": "crc32c" }],
            "attributes": self.attributes,
            "dimension_names": self.axes,
        })
    }

    fn chunk_shape(&self) -> impl Iterator<Item = usize> {
        self.shape.iter().enumerate().map(|(axis, n)| if axis == 0 { self.along } else { *n })
    }

    /// Number of chunks along the first axis.
    pub fn chunks(&self) -> usize {
        self.shape.first().map_or(1, |n| n.div_ceil(self.along))
    }

    /// Folder of the array below the library's.
    pub fn folder(&self, root: &Path) -> PathBuf {
        root.join(self.name)
    }

    /// Path of the chunk with index `number` along the first axis, for a library in the folder `root`.
    pub fn chunk(&self, root: &Path, number: usize) -> PathBuf {
        let key = match self.shape.len() {
            0 => "c".to_owned(),
            axes => format!("c.{number}{}", ".0".repeat(axes - 1)),
        };
        self.folder(root).join(key)
    }

    /// Number of bytes of a chunk's values.
    pub fn bytes(&self) -> usize {
        let size = match self.kind {
            Kind::U8 => 1,
            Kind::F32 => 4,
            Kind::F64 => 8,
        };
        self.chunk_shape().fold(size, usize::saturating_mul)
    }

    /// The values of a chunk, as bytes.
    pub fn read(&self, root: &Path, number: usize) -> Result<Vec<u8>, StoreError> {
        let path = self.chunk(root, number);
        let mut bytes = disk::read_sized(&path, self.bytes().saturating_add(CHECK) as u64)?;
        let check = bytes.split_off(self.bytes());
        let (stated, found) =
            (u32::from_le_bytes(check.try_into().unwrap_or_default()), crc32c::crc32c(&bytes));
        if stated != found {
            let expected = format!("values with the checksum {stated:08x}");
            return Err(StoreError::content(&path.display().to_string(), expected, format!("{found:08x}")));
        }
        Ok(bytes)
    }

    /// Writes the values of chunk `number`, as bytes; its name is on the medium after [`Array::sync`].
    pub fn write(&self, root: &Path, number: usize, bytes: &[u8]) -> Result<(), StoreError> {
        let check = crc32c::crc32c(bytes).to_le_bytes();
        disk::write(&self.chunk(root, number), &[bytes, &check])
    }

    /// Writes a chunk of unknown values, NaN.
    pub fn write_unknown(&self, root: &Path, number: usize) -> Result<(), StoreError> {
        let unknown = f64::NAN.to_le_bytes();
        let bytes: Vec<u8> = unknown.into_iter().cycle().take(self.bytes()).collect();
        self.write(root, number, &bytes)
    }

    /// Brings the names of written chunks onto the medium, so that they survive a crash.
    pub fn sync(&self, root: &Path) -> Result<(), StoreError> {
        disk::sync_folder(&self.folder(root))
    }

    /// Makes the folder of its chunks.
    pub fn make_folder(&self, root: &Path) -> Result<(), StoreError> {
        let folder = self.folder(root);
        let made = undisturbed(|| match std::fs::create_dir(&folder) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
            done => done,
        });
        made.map_err(StoreError::write(&folder))
    }

    /// Makes the array's folder and writes its metadata.
    pub fn describe(&self, root: &Path) -> Result<(), StoreError> {
        self.make_folder(root)?;
        let text = serde_json::to_vec_pretty(&self.metadata()).unwrap_or_default();
        disk::write(&manifest::path(&self.folder(root)), &[&text])
    }

    /// Checks that the array's metadata on disk agree with the plan.
    pub fn check(&self, root: &Path) -> Result<(), StoreError> {
        let path = manifest::path(&self.folder(root));
        let (mut found, mut expected) = (manifest::json(&path)?, self.metadata());
        // Other tools may add attributes.
        for value in [&mut found, &mut expected] {
            value.as_object_mut().map(|object| object.remove("attributes"));
        }
        let differs = |(key, value): (&String, &Value)| found.get(key) != Some(value);
        let keys = expected.as_object().into_iter().flatten();
        match keys.into_iter().find(|pair| differs(*pair)) {
            None => Ok(()),
            Some((key, value)) => {
                let found = found.get(key).map_or("nothing".into(), Value::to_string);
                let file = path.display().to_string();
                Err(StoreError::content(&file, format!("`{key}`: {value}"), found))
            }
        }
    }
}

/// Little-endian values of a chunk.
pub(crate) fn floats(bytes: &[u8]) -> impl Iterator<Item = f64> {
    bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes))
}
