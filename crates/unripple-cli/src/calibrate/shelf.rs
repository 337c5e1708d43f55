//! Measured points on their way into a library.

use crate::error::CliError;
use unripple::dsp::Reciprocity;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Sink};
use unripple_store::{Library, PointState, Quality};

/// A library that is being filled.
pub struct Shelf {
    pub library: Library,
    /// Points that this campaign measures; the rest are the actuators' own.
    pub probed: usize,
}

impl Shelf {
    /// Keeps how reciprocal the actuators are, from what each hears of all.
    pub fn reciprocity(&mut self, sensors: &[Channel]) -> Result<(), CliError> {
        let count = sensors.len();
        let flat: Vec<f64> = (0..count)
            .flat_map(|drive| sensors.iter().flat_map(move |heard| heard.responses[drive].iter().copied()))
            .collect();
        let found = Reciprocity::of(&flat, count).map_err(CliError::work)?;
        Ok(self.library.set_reciprocity_error(found.error)?)
    }
}

impl Sink for Shelf {
    fn missing(&self) -> Vec<usize> {
        self.library.in_state(PointState::Missing).into_iter().filter(|point| *point < self.probed).collect()
    }

    fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), CalibrateError> {
        let samples: Vec<f32> = channel.responses.iter().flatten().map(|h| *h as f32).collect();
        let quality: Vec<Quality> = channel.quality.iter().map(quality).collect();
        let kept = match fault {
            None => self.library.put(number, &samples, &quality),
            Some(_) => self.library.put_bad(number, &samples, &quality),
        };
        kept.map_err(|error| CalibrateError::Sink { number, why: error.to_string() })
    }
}

/// What the store keeps of a quality.
fn quality(quality: &unripple::dsp::Quality) -> Quality {
    Quality {
        signal_to_noise_db: quality.snr_db,
        coherence: quality.coherence.unwrap_or(f64::NAN),
        distortion: quality.distortion_db.map_or(f64::NAN, |db| 10f64.powf(db / 20.0)),
        decay_time: quality.decay.map_or(f64::NAN, |decay| decay.time),
    }
}
