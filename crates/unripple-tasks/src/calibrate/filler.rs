//! Scales, checks and stores measured points in a library.

use super::scale::Scales;
use crate::TaskError;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use unripple::core::{PROBE, Surface};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{self, BlowAccount, Channel, Sink};
use unripple_calibrate::signals::Reciprocity;
use unripple_store::{BandQuality, Library, PointState, Quality, StoreError, Take};

/// Key of a point's log entry for remarks on its recording.
pub const SAID: &str = "said";

/// Name of the check of responses against a model, and key of its log entries, for the library and for each point.
pub const CHECK: &str = "model";

/// Key of a point's log entry for the blows that it was measured by.
pub const BLOWS: &str = "blows";

/// A library that is being filled with measured responses, and what is needed to scale them.
pub struct LibraryFiller {
    /// The library that is being filled.
    pub library: Library,
    /// Number of points measured by a probe or by taps; the others lie at the actuators.
    pub probed: usize,
    /// Factor by which all that the probe measures is multiplied.
    probe: f64,
    /// Factor by which the signal of each actuator's sensor is multiplied.
    pub sensors: Vec<f64>,
    /// Indices of actuators that are left out: their responses are stored as zeros, since what was measured
    /// of them is noise.
    pub without: Vec<usize>,
    /// Indices of actuators whose sensor is dead: no responses need be measured at them.
    pub deaf: Vec<usize>,
    /// Points that were stored in this run.
    pub made: BTreeSet<usize>,
}

impl LibraryFiller {
    /// A library to fill, whose first `probed` points are measured by a probe or by taps and whose last
    /// points lie at the actuators; `without` are indices of actuators that are left out.
    pub fn new(
        library: Library,
        probed: usize,
        surface: &Surface,
        scales: &Scales,
        without: Vec<usize>,
    ) -> Self {
        let sensors = surface.actuators.iter().map(|actuator| scales.input(&actuator.name)).collect();
        let (deaf, made) = (Vec::new(), BTreeSet::new());
        Self { library, probed, probe: scales.input(PROBE), sensors, without, deaf, made }
    }

    /// This filler with a probe scale of 1, for taps, whose strength follows from the model, and for blows, whose force is recorded.
    pub fn by_taps(self) -> Self {
        Self { probe: 1.0, ..self }
    }

    /// Computes the reciprocity error of the responses between actuators from the channels of all sensors,
    /// and stores it in the library.
    pub fn reciprocity(&mut self, sensors: &[Channel]) -> Result<(), TaskError> {
        let alive: Vec<usize> = (0..sensors.len()).filter(|a| !self.without.contains(a)).collect();
        let mut flat = Vec::new();
        for drive in &alive {
            for heard in &alive {
                let scale = self.sensors[*heard];
                flat.extend(sensors[*heard].responses[*drive].iter().map(|x| x * scale));
            }
        }
        let found = Reciprocity::of(&flat, alive.len()).map_err(TaskError::work)?;
        Ok(self.library.set_reciprocity_error(found.error)?)
    }

    /// Stored responses at the actuators' sensors, with which later recordings are compared; `None` if no
    /// sensor was measured. Responses at dead or bad sensors are zero.
    pub fn heard(&self) -> Result<Option<Vec<Channel>>, TaskError> {
        let (samples, count) = (self.library.plan().samples, self.sensors.len());
        let known = |sensor: usize| {
            let state = self.library.state(self.probed + sensor);
            state == Some(PointState::Measured) && !self.without.contains(&sensor)
        };
        if !(0..count).any(known) {
            return Ok(None);
        }
        let channel = |(sensor, scale): (usize, &f64)| -> Result<Channel, TaskError> {
            if !known(sensor) {
                return Ok(Channel::of_responses(vec![vec![0.0; samples]; count]));
            }
            let values = self.library.get(self.probed + sensor)?;
            let rows = values.chunks_exact(samples);
            let rows = rows.map(|row| row.iter().map(|h| f64::from(*h) / scale).collect()).collect();
            Ok(Channel::of_responses(rows))
        };
        self.sensors.iter().enumerate().map(channel).collect::<Result<Vec<_>, _>>().map(Some)
    }

    /// Quality by third-octave bands as it is stored, after making room for it in the library; empty for
    /// taps, whose quality is not known by frequency.
    fn bands(&mut self, channel: &Channel) -> Result<Vec<Vec<BandQuality>>, StoreError> {
        let middles: Vec<f64> = channel.bands.first().into_iter().flatten().map(|band| band.hz).collect();
        if middles.is_empty() {
            return Ok(Vec::new());
        }
        self.library.hold_bands(&middles)?;
        let row = |(actuator, row): (usize, &Vec<measure::BandQuality>)| {
            if self.without.contains(&actuator) {
                return vec![BandQuality::UNKNOWN; middles.len()];
            }
            let kept = row.iter().map(|band| BandQuality {
                signal_to_noise_db: band.snr_db,
                coherence: band.coherence.unwrap_or(f64::NAN),
            });
            kept.collect()
        };
        Ok(channel.bands.iter().enumerate().map(row).collect())
    }

    /// Stores the responses of a channel as those of a point, and marks the point as bad if `bad`.
    fn store(&mut self, number: usize, channel: &Channel, bad: bool) -> Result<(), StoreError> {
        let (samples, quality) = self.kept(number, channel);
        let bands = self.bands(channel)?;
        let state = if bad { PointState::Bad } else { PointState::Measured };
        let take = Take { point: number, samples: &samples, quality: &quality, bands: &bands, state };
        self.library.put_all(&[take])
    }

    /// Whether all stored points were measured in this run.
    pub fn is_new(&self) -> bool {
        let there = |point: &usize| self.library.state(*point) != Some(PointState::Missing);
        (0..self.library.points().len()).filter(there).all(|point| self.made.contains(&point))
    }

    /// Records remarks on a recording in a point's log, and removes the earlier correction from it: first,
    /// so that no log speaks of other responses than are stored.
    fn note(&mut self, number: usize, channel: &Channel) -> Result<(), StoreError> {
        let said = channel.account.said();
        let blows = channel.account.blows.as_ref().map(told);
        let stale = |log: &Value| [SAID, CHECK, BLOWS].iter().any(|key| log.get(*key).is_some());
        if blows.is_none() && said.is_empty() && !self.library.logged_point(number).is_some_and(stale) {
            return Ok(());
        }
        let said = if said.is_empty() { Value::Null } else { json!(said) };
        self.library
            .log_points(BTreeMap::from([(number, json!({ SAID: said, CHECK: Value::Null, BLOWS: blows }))]))
    }

    /// Samples and qualities of a channel as they are stored.
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

impl Sink for LibraryFiller {
    fn missing(&self) -> Vec<usize> {
        self.library.in_state(PointState::Missing).into_iter().filter(|point| *point < self.probed).collect()
    }

    fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), CalibrateError> {
        let failed = |error: StoreError| CalibrateError::Sink { number, why: error.to_string() };
        self.note(number, channel)
            .and_then(|()| self.store(number, channel, fault.is_some()))
            .map_err(failed)?;
        self.made.insert(number);
        Ok(())
    }
}

/// Blows as the log has them.
fn told(blows: &BlowAccount) -> Value {
    let refused: Vec<String> = blows.refused.iter().map(ToString::to_string).collect();
    json!({ "used": blows.used, "peaks_n": blows.peaks_n, "usable_to_hz": blows.usable_to_hz, "refused": refused })
}

/// Quality of a response as the library stores it.
fn quality(quality: &unripple_calibrate::signals::Quality) -> Quality {
    Quality {
        signal_to_noise_db: quality.snr_db,
        coherence: quality.coherence.unwrap_or(f64::NAN),
        distortion: quality.distortion_db.map_or(f64::NAN, |db| 10f64.powf(db / 20.0)),
        decay_time: quality.decay.map_or(f64::NAN, |decay| decay.time),
    }
}
