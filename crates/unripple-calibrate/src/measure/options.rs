//! Options of measuring responses: sweeps, pauses, repeats, limits of quality.

use super::{Channel, Knocked};
use crate::CalibrateError;
use crate::signals::{Quality, Sweep};
use unripple_core::{Layout, ModalResponses, Surface, require};

/// Amplitude decay time, in s, for which sweep, settle time and response length are chosen by default: they are 7, 5 and 1.4 times as
/// long.
const USUAL_DECAY: f64 = 0.07;

/// Options of a measurement: sweep, pauses, repeats, limits of quality.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Duration of one actuator's sweep, in s.
    pub sweep: f64,
    /// Lowest frequency swept, in Hz.
    pub start_hz: f64,
    /// Highest frequency swept, as a multiple of the top of the surface's band.
    pub stop_over_band: f64,
    /// Amplitude of the sweep, as a share of the surface's drive limit.
    pub level: f64,
    /// Time in which the surface comes to rest, in s; the responses to successive actuators are at least
    /// that far apart.
    pub settle_time: f64,
    /// Duration of each response that is stored, in s.
    pub response_length: f64,
    /// Number of recordings of each place; their responses are averaged.
    pub repeats: usize,
    /// Highest order of harmonics that the timing of the sweeps separates from the responses.
    pub highest_order: usize,
    /// Number of times that a bad place is measured again before it is stored as bad.
    pub retries: u64,
    /// Smallest signal-to-noise ratio of a good response, in dB.
    pub min_snr_db: f64,
    /// Largest harmonic distortion of a good response, relative to its power, in dB.
    pub max_distortion_db: f64,
    /// Latency of the device, in samples.
    pub latency: f64,
    /// Delay of the probe relative to the sensors, in s; `None` if it is to be determined.
    pub probe_delay: Option<f64>,
    /// Whether measured responses are compared with a model of the surface.
    pub model: bool,
    /// Indices of actuators that are left out because they are dead: their responses are not checked.
    pub without: Vec<usize>,
}

impl Default for MeasureOptions {
    /// One sweep of 0.5 s from 60 Hz to a fifth above the band at the full limit; rest after 0.35 s, 100 ms
    /// of each response stored.
    fn default() -> Self {
        Self {
            sweep: 0.5,
            start_hz: 60.0,
            stop_over_band: 1.2,
            level: 1.0,
            settle_time: 0.35,
            response_length: 0.1,
            repeats: 1,
            highest_order: 3,
            retries: 2,
            min_snr_db: 20.0,
            max_distortion_db: -20.0,
            latency: 0.0,
            probe_delay: None,
            model: true,
            without: Vec::new(),
        }
    }
}

/// Highest start of a sweep, relative to the frequency of the lowest mode: the beginning of a sweep is faded in.
const BELOW: f64 = 0.6;

/// Lowest start of a sweep that is chosen automatically, in Hz: no exciter moves below.
const LOWEST: f64 = 2.0;

/// Highest start of a sweep, relative to its end: above 1 / 1.8, the soft edges of the band that is swept overlap.
const BENEATH: f64 = 0.5;

/// Highest end of a sweep, relative to the sample rate: a tenth of the range below half of it is left for the filters of converters.
const HIGHEST: f64 = 0.45;

/// Largest number of repeats. Averaging that many improves the signal-to-noise ratio by 20 dB; if that is
/// not enough, another probe is needed.
pub const MOST_REPEATS: usize = 99;

/// Longest duration of a response that is stored, in s: it bounds memory, and no sheet rings that long.
pub const MOST_KEPT: f64 = 60.0;

impl MeasureOptions {
    /// Options suited to the decay times of a model of the surface: durations of sweep, pause and response
    /// in proportion to the slowest decay in the band, but at least those of [`MeasureOptions::default`],
    /// which are for decay times up to 70 ms. The sweep begins below the lowest mode, and at 60 Hz at most.
    /// If a surface rings for more than 42 s, a minute of each response is stored.
    ///
    /// A response has decayed to e⁻⁵ when the next one begins. The second harmonic precedes the linear
    /// response by about 1.2 decay times, for a sweep from 60 Hz to 3.6 kHz. Both hold for surfaces with
    /// long and with short decay times.
    pub fn for_model(model: &ModalResponses) -> Self {
        let usual = Self::default();
        let from = lowest(model).map_or(usual.start_hz, |hz| (BELOW * hz).clamp(LOWEST, usual.start_hz));
        let from = from.min(BENEATH * usual.end(model.conditions.band[1], model.conditions.rate));
        let times = slowest_decay(model, from) / USUAL_DECAY;
        // Surfaces that differ only in the last digits get the same plan.
        let times = if times > 1.001 { times.min(MOST_KEPT / usual.response_length) } else { 1.0 };
        let [sweep, ringing, kept] =
            [usual.sweep, usual.settle_time, usual.response_length].map(|seconds| times * seconds);
        Self { sweep, start_hz: from, settle_time: ringing, response_length: kept, ..usual }
    }

    /// Warnings, one sentence each, about durations (sweep, pause, response) that are too short for the
    /// decay times of a model of the surface.
    pub fn warnings(&self, model: &ModalResponses) -> Vec<String> {
        let suited = Self::for_model(model);
        let decay = 1e3 * slowest_decay(model, self.start_hz);
        let of = [
            ("sweep", self.sweep, suited.sweep, "the responses of harmonics overlap"),
            ("pause", self.settle_time, suited.settle_time, "a response begins before the last has decayed"),
            ("response", self.response_length, suited.response_length, "what decays later is left out"),
        ];
        let short = of.into_iter().filter(|(_, found, wanted, _)| *found < 0.999 * wanted);
        short
            .map(|(what, found, wanted, why)| {
                let [found, wanted] = [found, wanted].map(|s| 1e3 * s);
                format!("{what}: {found:.0} ms are short for a surface that rings for {decay:.0} ms ({wanted:.0} ms are enough): {why}")
            })
            .collect()
    }

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
            self.response_length > 0.0 && self.response_length <= MOST_KEPT,
            "above 0, at most 60",
            self.response_length,
        )?;
        let repeated = (1..=MOST_REPEATS).contains(&self.repeats);
        require("repeats", repeated, format!("1 to {MOST_REPEATS}"), self.repeats as f64)?;
        require(
            "end of the sweep over the band's top",
            self.stop_over_band >= 1.0,
            "1 or more",
            self.stop_over_band,
        )?;
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
        [self.start_hz, self.end(surface.emission.band[1], surface.emission.rate)]
    }

    /// The highest frequency swept for a band up to `top` (Hz), at `rate` samples per second.
    fn end(&self, top: f64, rate: f64) -> f64 {
        (self.stop_over_band * top).min(HIGHEST * rate)
    }

    /// The reason why a channel is bad, in words: a knock, unrecognised sweeps or the first response below
    /// the limits; `None` if it is good. `each` names what a response belongs to, such as "actuator".
    pub(super) fn fault(&self, channel: &Channel, each: &str) -> Option<String> {
        let matters = |knock: &&Knocked| !knock.left_out && knock.share_db > -self.min_snr_db;
        if let Some(knock) = channel.account.knocks.iter().find(matters) {
            let hit: Vec<String> = knock.actuators.iter().map(usize::to_string).collect();
            return Some(format!(
                "a knock at {:.2} s (in the sweeps of {each} {})",
                knock.at_s,
                hit.join(", ")
            ));
        }
        if let Some([unlike, all]) = channel.account.unlike {
            return Some(format!(
                "at the sensors {unlike} of {all} sweeps differ from the first recording, and noise does not explain it \
                 (samples lost, clocks far apart, a latency that jitters, or a surface that changed or is touched)"
            ));
        }
        let one = |(index, quality): (usize, &Quality)| {
            if self.without.contains(&index) {
                return None;
            }
            let (number, snr_db) = (index + 1, quality.snr_db);
            let most = self.max_distortion_db;
            if let Some(distortion) = quality.distortion_db.filter(|db| *db > most && snr_db > 0.0) {
                return Some(format!(
                    "{each} {number}: distortion {distortion:.1} dB, expected {most:.0} or less (is the drive clipped?)"
                ));
            }
            let least = self.min_snr_db;
            if snr_db >= least {
                return None;
            }
            Some(match snr_db > f64::NEG_INFINITY {
                true => {
                    format!("{each} {number}: signal to noise {snr_db:.1} dB, expected {least:.0} or more")
                }
                false => format!(
                    "{each} {number}: no response was recorded (signal to noise below 0 dB, expected {least:.0} or more); is it \
                     connected?"
                ),
            })
        };
        channel.quality.iter().enumerate().find_map(one)
    }

    /// Number of repeats, 1 to 99, with which a channel's worst response would have a signal-to-noise ratio of `wanted_db`, if
    /// `channel` was measured with the present options; 0 if 99 are not enough.
    pub fn repeats_for(&self, channel: &Channel, wanted_db: f64) -> usize {
        let worst = channel.quality.iter().map(|quality| quality.snr_db).fold(f64::INFINITY, f64::min);
        let times = self.repeats as f64 * 10f64.powf((wanted_db - worst) / 10.0);
        if times <= MOST_REPEATS as f64 { times.ceil().max(1.0) as usize } else { 0 }
    }

    /// Distance between the responses of successive sweeps, in samples, at least the stored length of a
    /// response.
    pub(super) fn apart(&self, rate: f64) -> usize {
        ((self.settle_time * rate).round() as usize).max(self.samples(rate))
    }

    /// Number of samples of each response that are stored, at `rate` samples per second.
    pub fn samples(&self, rate: f64) -> usize {
        (self.response_length * rate).round() as usize + 1
    }
}

/// The frequency of the lowest mode in the band, in Hz.
fn lowest(model: &ModalResponses) -> Option<f64> {
    let [low, high] = model.conditions.band.map(|hz| std::f64::consts::TAU * hz);
    let within = model.poles.iter().map(|pole| pole.omega).filter(|omega| (low..=high).contains(omega));
    within.min_by(f64::total_cmp).map(|omega| omega / std::f64::consts::TAU)
}

/// Longest amplitude decay time (to 1/e), in s, of the modes in the band above `from` Hz; 0 without modes there.
pub fn slowest_decay(model: &ModalResponses, from: f64) -> f64 {
    let [low, high] = model.conditions.band.map(|hz| std::f64::consts::TAU * hz);
    let low = low.max(std::f64::consts::TAU * from);
    let within = model.poles.iter().filter(|pole| (low..=high).contains(&pole.omega) && pole.sigma > 0.0);
    within.map(|pole| 1.0 / pole.sigma).fold(0.0, f64::max)
}
