//! Measured points on their way into a library.

use super::scale::Scales;
use crate::error::CliError;
use unripple::core::{PROBE, Surface};
use unripple::dsp::Reciprocity;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Sink};
use unripple_store::{Library, PointState, Quality};

/// A library that is being filled.
pub struct Shelf {
    pub library: Library,
    /// Points that this campaign measures; the rest are the actuators' own.
    pub probed: usize,
    /// What is heard at a point is multiplied by this.
    probe: f64,
    /// What each actuator's sensor hears, by this.
    sensors: Vec<f64>,
    /// Actuators that are left out: their responses are zero, since what was heard of them is noise.
    pub without: Vec<usize>,
}

impl Shelf {
    pub fn new(
        library: Library,
        probed: usize,
        surface: &Surface,
        scales: &Scales,
        without: Vec<usize>,
    ) -> Self {
        let sensors = surface.actuators.iter().map(|actuator| scales.input(&actuator.name)).collect();
        Self { library, probed, probe: scales.input(PROBE), sensors, without }
    }

    /// For taps, whose strength the model tells: scales do not matter.
    pub fn by_taps(self) -> Self {
        Self { probe: 1.0, ..self }
    }

    /// Keeps how reciprocal the actuators are, from what each hears of all.
    pub fn reciprocity(&mut self, sensors: &[Channel]) -> Result<(), CliError> {
        let alive: Vec<usize> = (0..sensors.len()).filter(|a| !self.without.contains(a)).collect();
        let mut flat = Vec::new();
        for drive in &alive {
            for heard in &alive {
                let scale = self.sensors[*heard];
                flat.extend(sensors[*heard].responses[*drive].iter().map(|x| x * scale));
            }
        }
        let found = Reciprocity::of(&flat, alive.len()).map_err(CliError::work)?;
        Ok(self.library.set_reciprocity_error(found.error)?)
    }

    /// A channel as it is kept.
    fn kept(&self, number: usize, channel: &Channel) -> (Vec<f32>, Vec<Quality>) {
        let own = number.checked_sub(self.probed);
        let scale = own.map_or(self.probe, |actuator| self.sensors.get(actuator).copied().unwrap_or(1.0));
        let (mut samples, mut qualities) = (Vec::new(), Vec::new());
        for (actuator, (response, found)) in channel.responses.iter().zip(&channel.quality).enumerate() {
            if self.without.contains(&actuator) {
                samples.extend(std::iter::repeat_n(0.0_f32, response.len()));
                qualities.push(Quality::UNKNOWN);
            } else {
                samples.extend(response.iter().map(|h| (h * scale) as f32));
                qualities.push(quality(found));
            }
        }
        (samples, qualities)
    }
}

impl Sink for Shelf {
    fn missing(&self) -> Vec<usize> {
        self.library.in_state(PointState::Missing).into_iter().filter(|point| *point < self.probed).collect()
    }

    fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), CalibrateError> {
        let (samples, quality) = self.kept(number, channel);
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
