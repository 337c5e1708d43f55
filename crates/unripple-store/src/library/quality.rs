//! Quality of stored responses.

use super::array::{BLOCK, floats};
use super::{Library, Take};
use crate::StoreError;

/// Quality of one response: signal-to-noise ratio, coherence, distortion, decay. NaN where it is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Signal-to-noise ratio, in dB.
    pub signal_to_noise_db: f64,
    /// Mean coherence over the band, 0 to 1.
    pub coherence: f64,
    /// Amplitude of the harmonics over that of the linear response: the square root of the ratio of their energies.
    pub distortion: f64,
    /// Time in which the amplitude decays to 1/e, in seconds.
    pub decay_time: f64,
}

/// Values of one response: the four fields of [`Quality`].
const FIGURES: usize = 4;

impl Quality {
    /// Unknown quality: NaN in all fields.
    pub const UNKNOWN: Self = Self {
        signal_to_noise_db: f64::NAN,
        coherence: f64::NAN,
        distortion: f64::NAN,
        decay_time: f64::NAN,
    };

    fn values(self) -> [f64; FIGURES] {
        [self.signal_to_noise_db, self.coherence, self.distortion, self.decay_time]
    }

    fn of([signal_to_noise_db, coherence, distortion, decay_time]: [f64; FIGURES]) -> Self {
        Self { signal_to_noise_db, coherence, distortion, decay_time }
    }
}

impl Library {
    /// The quality of a point's responses, one per actuator; all unknown where nothing was stored.
    ///
    /// # Errors
    /// [`StoreError::Content`] and [`StoreError::Read`] for a point beyond the last, and for damage.
    pub fn quality(&self, point: usize) -> Result<Vec<Quality>, StoreError> {
        self.within(point)?;
        let bytes = self.arrays.quality.read(&self.root, point / BLOCK)?;
        let size = self.quality_bytes();
        let own = bytes.chunks_exact(size).nth(point % BLOCK).unwrap_or_default();
        let values: Vec<f64> = floats(own).collect();
        Ok(values.as_chunks::<FIGURES>().0.iter().map(|figures| Quality::of(*figures)).collect())
    }

    /// Reciprocity error: relative difference between responses measured in both directions between actuators, as a
    /// ratio, for the whole library; `None` where it is not known.
    ///
    /// # Errors
    /// [`StoreError::Content`] and [`StoreError::Read`] for damage.
    pub fn reciprocity_error(&self) -> Result<Option<f64>, StoreError> {
        let bytes = self.arrays.reciprocity.read(&self.root, 0)?;
        Ok(floats(&bytes).next().filter(|value| !value.is_nan()))
    }

    /// Sets the [`Library::reciprocity_error`], a ratio.
    ///
    /// # Errors
    /// [`StoreError::Write`], or [`StoreError::Occupied`] if another process writes.
    pub fn set_reciprocity_error(&mut self, value: f64) -> Result<(), StoreError> {
        self.acquire()?;
        self.arrays.reciprocity.write(&self.root, 0, &value.to_le_bytes())?;
        self.arrays.reciprocity.sync(&self.root)
    }

    /// Bytes of one point's qualities.
    fn quality_bytes(&self) -> usize {
        self.plan.ports.len() * FIGURES * size_of::<f64>()
    }

    /// Writes the qualities of some takes, all of points in one block, into it.
    pub(crate) fn write_qualities(&self, block: usize, takes: &[&Take<'_>]) -> Result<(), StoreError> {
        let mut bytes = self.arrays.quality.read(&self.root, block)?;
        let size = self.quality_bytes();
        for take in takes {
            let values = take.quality.iter().flat_map(|q| q.values()).flat_map(f64::to_le_bytes);
            if let Some(own) = bytes.chunks_exact_mut(size).nth(take.point % BLOCK) {
                own.iter_mut().zip(values).for_each(|(to, from)| *to = from);
            }
        }
        self.arrays.quality.write(&self.root, block, &bytes)
    }
}
