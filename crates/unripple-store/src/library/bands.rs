//! Quality of responses in third-octave bands: an array beside `quality` that a library may have.

use super::array::{Array, floats};
use super::plan::LibraryPlan;
use super::{Library, PointState, Take, manifest};
use crate::StoreError;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Quality of one response in one third-octave band. NaN where it is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandQuality {
    /// Signal-to-noise ratio, in dB; −∞ if there is no more than noise.
    pub signal_to_noise_db: f64,
    /// Coherence, 0 to 1: the share of the power that repeated recordings have in common.
    pub coherence: f64,
}

impl BandQuality {
    /// Unknown quality: NaN in both fields.
    pub const UNKNOWN: Self = Self { signal_to_noise_db: f64::NAN, coherence: f64::NAN };
}

/// Values of one response in one band: signal-to-noise ratio and coherence.
pub(crate) const FIGURES: usize = 2;

/// The attribute with the middle frequencies of the bands, in Hz.
const MIDDLES: &str = "middle_hz";
/// The attribute with the checksum of [`MIDDLES`]: values without their frequencies mean nothing.
const CHECK: &str = "crc32c";
/// Largest number of bands: thirds of an octave over more than twenty octaves.
const MOST: usize = 64;

/// The array, and the centre frequencies of its bands in Hz, ascending.
#[derive(Clone, Debug)]
pub(crate) struct Bands {
    /// The Zarr array, `[point][actuator][band][figure]`.
    pub array: Array,
    /// Centre frequencies of the bands in Hz, ascending.
    pub middles: Vec<f64>,
}

impl Bands {
    fn of(plan: &LibraryPlan, middles: &[f64]) -> Self {
        let attributes = json!({
            MIDDLES: middles,
            CHECK: manifest::checksum(&json!(middles)),
            "figure": ["signal_to_noise_db", "coherence"],
        });
        Self { array: Array::by_bands(plan, middles.len(), attributes), middles: middles.to_vec() }
    }

    /// Reads the bands of a library; `None` if it has no such array. The array exists once its metadata do.
    ///
    /// # Errors
    /// [`StoreError::Content`] and [`StoreError::Read`] for damage to the metadata.
    pub fn read(root: &Path, plan: &LibraryPlan) -> Result<Option<Self>, StoreError> {
        let file = path(root);
        if std::fs::symlink_metadata(&file).is_err() {
            return Ok(None);
        }
        let name = file.display().to_string();
        let metadata = manifest::json(&file)?;
        let attributes = metadata.get("attributes").unwrap_or(&Value::Null);
        let value = attributes.get(MIDDLES).unwrap_or(&Value::Null);
        let stated = attributes.get(CHECK).and_then(Value::as_str).unwrap_or_default();
        let found = manifest::checksum(value);
        if stated != found {
            let expected = format!("`{MIDDLES}` with the checksum `{stated}`");
            return Err(StoreError::content(&name, expected, format!("`{found}`")));
        }
        let middles: Vec<f64> = value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        check(&middles, &name)?;
        Ok(Some(Self::of(plan, &middles)))
    }

    /// Bytes of one point's values.
    fn bytes(&self, plan: &LibraryPlan) -> usize {
        plan.ports.len() * self.middles.len() * FIGURES * size_of::<f64>()
    }
}

/// Where the metadata of the array are.
pub(crate) fn path(root: &Path) -> PathBuf {
    manifest::path(&root.join(Array::BANDS))
}

/// Refuses what are no centre frequencies of bands.
fn check(middles: &[f64], file: &str) -> Result<(), StoreError> {
    let ascending = middles.windows(2).all(|pair| pair[0] < pair[1]);
    let positive = middles.iter().all(|hz| hz.is_finite() && *hz > 0.0);
    if (1..=MOST).contains(&middles.len()) && ascending && positive {
        return Ok(());
    }
    let expected = format!("centre frequencies of 1 to {MOST} bands in Hz, positive and ascending");
    Err(StoreError::content(file, expected, told(middles)))
}

/// How many bands there are, and from where to where.
fn told(middles: &[f64]) -> String {
    match middles {
        [] => "none".into(),
        [only] => format!("one at {only} Hz"),
        [first, .., last] => format!("{} from {first} to {last} Hz", middles.len()),
    }
}

impl Library {
    /// Centre frequencies of the bands for which this library stores quality, in Hz and ascending; `None` if it
    /// stores none.
    pub fn bands(&self) -> Option<&[f64]> {
        self.arrays.bands.as_ref().map(|bands| bands.middles.as_slice())
    }

    /// Adds storage for the quality of responses in bands with these centre frequencies, in Hz and
    /// ascending. The quality is unknown until a [`Take`] supplies it. Does nothing if the library has these
    /// bands already.
    ///
    /// # Errors
    /// [`StoreError::Content`] if these are no valid centre frequencies, if the library has other bands, or if the metadata of
    /// its bands are damaged; [`StoreError::Write`]; [`StoreError::Occupied`] if another process writes.
    pub fn hold_bands(&mut self, middles: &[f64]) -> Result<(), StoreError> {
        let name = path(&self.root).display().to_string();
        check(middles, &name)?;
        self.acquire()?;
        if let Some(held) = Bands::read(&self.root, &self.plan)? {
            if held.middles == middles {
                return Ok(());
            }
            let expected = format!("bands as they are there, {}", told(&held.middles));
            return Err(StoreError::content(&name, expected, told(middles)));
        }
        let bands = Bands::of(&self.plan, middles);
        bands.array.make_folder(&self.root)?;
        for chunk in 0..bands.array.chunks() {
            bands.array.write_unknown(&self.root, chunk)?;
        }
        // Values first: a process that is killed in between leaves no array.
        bands.array.describe(&self.root)?;
        bands.array.sync(&self.root)?;
        super::disk::sync_folder(&self.root)?;
        self.arrays.bands = Some(bands);
        Ok(())
    }

    /// Quality of a point's responses in frequency bands, `[actuator][band]`. It is unknown where nothing was stored,
    /// and for a missing point; `None` if this library has no bands.
    ///
    /// # Errors
    /// [`StoreError::Content`] and [`StoreError::Read`] for a point beyond the last, and for damage.
    pub fn band_quality(&self, point: usize) -> Result<Option<Vec<Vec<BandQuality>>>, StoreError> {
        self.within(point)?;
        let Some(bands) = &self.arrays.bands else { return Ok(None) };
        let count = bands.middles.len();
        if self.states[point] == PointState::Missing {
            return Ok(Some(vec![vec![BandQuality::UNKNOWN; count]; self.plan.ports.len()]));
        }
        let bytes = bands.array.read(&self.root, point / bands.array.along)?;
        let own = bytes.chunks_exact(bands.bytes(&self.plan)).nth(point % bands.array.along);
        let values: Vec<f64> = floats(own.unwrap_or_default()).collect();
        let of = |[signal_to_noise_db, coherence]: &[f64; FIGURES]| BandQuality {
            signal_to_noise_db: *signal_to_noise_db,
            coherence: *coherence,
        };
        let rows = values.as_chunks::<FIGURES>().0.chunks_exact(count);
        Ok(Some(rows.map(|row| row.iter().map(of).collect()).collect()))
    }

    /// Refuses a take whose bands are not those of the library; one may have none.
    pub(crate) fn bands_fit(&self, take: &Take<'_>) -> Result<(), StoreError> {
        let held = self.bands().map_or(0, <[f64]>::len);
        let fit = take.bands.len() == self.plan.ports.len() && take.bands.iter().all(|row| row.len() == held);
        if take.bands.is_empty() || (held > 0 && fit) {
            return Ok(());
        }
        let name = self.root.display().to_string();
        let expected = match held {
            0 => "no quality by bands, since the library has no array for it yet".into(),
            held => format!("quality values of {} responses in {held} bands", self.plan.ports.len()),
        };
        let widths: Vec<String> = take.bands.iter().map(|row| row.len().to_string()).collect();
        let found = format!("that of {} in {}", take.bands.len(), widths.join(", "));
        Err(StoreError::content(&name, expected, found))
    }

    /// Writes the quality of some takes by bands; unknown for those that have none, whatever was there of an earlier take.
    pub(crate) fn write_bands(&self, takes: &[Take<'_>]) -> Result<(), StoreError> {
        let Some(bands) = &self.arrays.bands else { return Ok(()) };
        let mut chunks: BTreeMap<usize, Vec<&Take<'_>>> = BTreeMap::new();
        takes.iter().for_each(|take| chunks.entry(take.point / bands.array.along).or_default().push(take));
        for (chunk, takes) in chunks {
            let mut bytes = bands.array.read(&self.root, chunk)?;
            for take in takes {
                let known = take.bands.iter().flatten();
                let known = known.flat_map(|band| [band.signal_to_noise_db, band.coherence]);
                let values = known.chain(std::iter::repeat(f64::NAN)).flat_map(f64::to_le_bytes);
                let mut points = bytes.chunks_exact_mut(bands.bytes(&self.plan));
                if let Some(own) = points.nth(take.point % bands.array.along) {
                    own.iter_mut().zip(values).for_each(|(to, from)| *to = from);
                }
            }
            bands.array.write(&self.root, chunk, &bytes)?;
        }
        bands.array.sync(&self.root)
    }
}
