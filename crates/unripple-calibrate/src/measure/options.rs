use super::Channel;
use crate::CalibrateError;
use crate::error::require;
use unripple_core::{Layout, Surface};
use unripple_dsp::Sweep;

/// How responses are measured.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Seconds of an actuator's sweep.
    pub sweep: f64,
    /// Lowest frequency swept, in Hz.
    pub from: f64,
    /// Highest frequency swept, as a multiple of the top of the surface's band.
    pub over: f64,
    /// Drive, as a share of the surface's limit.
    pub level: f64,
    /// Seconds that the surface takes to come to rest; the responses of actuators are kept that far apart.
    pub ringing: f64,
    /// Seconds of each response that are kept.
    pub kept: f64,
    /// Times that each place is measured, and averaged.
    pub repeats: usize,
    /// Harmonics up to this order are kept apart from the responses.
    pub highest_order: usize,
    /// Times that a bad place is measured again before it is left as bad.
    pub again: u64,
    /// Signal to noise below which a response is bad, in dB.
    pub least_snr_db: f64,
    /// Distortion above which a response is bad, as a share of its power, in dB.
    pub most_distortion_db: f64,
    /// Samples that what is heard comes late by.
    pub latency: f64,
    /// Seconds by which the probe alone hears later than the sensors do; `None` to find it.
    pub probe_delay: Option<f64>,
    /// Whether what is measured is held against a model of the surface.
    pub model: bool,
    /// Actuators that are left out, since they are dead: what is heard of them is not judged.
    pub without: Vec<usize>,
}

impl Default for MeasureOptions {
    /// A sweep of 0.5 s from 60 Hz to a fifth above the band at the full limit, once; rest after 0.35 s, 100 ms kept.
    fn default() -> Self {
        Self {
            sweep: 0.5,
            from: 60.0,
            over: 1.2,
            level: 1.0,
            ringing: 0.35,
            kept: 0.1,
            repeats: 1,
            highest_order: 3,
            again: 2,
            least_snr_db: 20.0,
            most_distortion_db: -20.0,
            latency: 0.0,
            probe_delay: None,
            model: true,
            without: Vec::new(),
        }
    }
}

impl MeasureOptions {
    /// The sweep for a surface on a device.
    ///
    /// # Errors
    /// [`CalibrateError::Recording`] if the device runs at another rate than the surface; [`CalibrateError::Range`] for
    /// options out of range.
    pub(super) fn sweep(&self, surface: &Surface, layout: &Layout) -> Result<Sweep, CalibrateError> {
        let emission = &surface.emission;
        if (layout.rate - emission.rate).abs() > 1e-9 * emission.rate {
            return Err(CalibrateError::Recording {
                what: format!("sample rate of `{}`", layout.device),
                expected: format!("{} Hz, the surface's", emission.rate),
                found: format!("{} Hz", layout.rate),
            });
        }
        require(
            "level of the sweep",
            self.level > 0.0 && self.level <= 1.0,
            "above 0, at most 1",
            self.level,
        )?;
        require(
            "seconds kept of a response",
            self.kept > 0.0 && self.kept <= self.ringing,
            "at most those of ringing",
            self.kept,
        )?;
        require("repeats", self.repeats >= 1, "1 or more", self.repeats as f64)?;
        require("end of the sweep over the band's top", self.over >= 1.0, "1 or more", self.over)?;
        let [from, to] = self.swept(surface);
        Ok(Sweep {
            rate: emission.rate,
            from,
            to,
            seconds: self.sweep,
            amplitude: self.level * emission.limit,
            ..Sweep::default()
        })
    }

    /// The lowest and the highest frequency swept on a surface, in Hz.
    pub fn swept(&self, surface: &Surface) -> [f64; 2] {
        [self.from, (self.over * surface.emission.band[1]).min(0.45 * surface.emission.rate)]
    }

    /// Why a channel is bad, if it is: its first response that is worse than asked. `each` is what its responses are counted by.
    pub(super) fn fault(&self, channel: &Channel, each: &str) -> Option<String> {
        channel.quality.iter().enumerate().find_map(|(index, quality)| {
            if self.without.contains(&index) {
                return None;
            }
            let (number, snr_db) = (index + 1, quality.snr_db);
            if snr_db.is_nan() || snr_db < self.least_snr_db {
                let least = self.least_snr_db;
                return Some(format!(
                    "{each} {number}: signal to noise {snr_db:.1} dB, expected {least:.0} or more"
                ));
            }
            let most = self.most_distortion_db;
            let distortion = quality.distortion_db.filter(|db| *db > most)?;
            Some(format!(
                "{each} {number}: distortion {distortion:.1} dB, expected {most:.0} or less (is the drive clipped?)"
            ))
        })
    }

    /// Samples kept of a response.
    pub fn samples(&self, rate: f64) -> usize {
        (self.kept * rate).round() as usize + 1
    }
}
