//! The recording of a knock as a whole: hits, modes, and what is no mode.

use super::hits::{Hit, hits};
use super::refined::refined;
use super::shifts::factors;
use super::sorted::{Tone, mains, once};
use super::sub_band::sub_band;
use crate::CalibrateError;
use rayon::prelude::*;
use unripple_core::OutOfRange;
use unripple_linalg::c64;

/// Width of a sub-band over the frequency where it begins: decay times are mostly shorter at higher frequencies, so that modes are wider.
const RELATIVE_WIDTH: f64 = 1.0 / 3.0;

/// Least width of a sub-band in Hz. Its filter takes 5/width of the beginning, 50 ms.
const LEAST_WIDTH: f64 = 100.0;

/// Distance of two sub-bands over the width of the lower.
const DISTANCE: f64 = 0.8;

/// Time after a hit in s until which the contact may last.
const CONTACT: f64 = 1e-3;

/// Least time after a hit in s in which anything can be heard.
const LEAST: f64 = 0.1;

/// Longest time after a hit in s that is used: by then modes are gone, and hum is well known.
const MOST: f64 = 3.0;

/// Highest frequency in Hz unless a band is named, and as a share of the sample rate.
const TOP: f64 = 5e3;
const TOP_SHARE: f64 = 0.4;

/// Logarithms of factors that grow or decay by more than this from sample to sample are no modes of the band.
const FASTEST: f64 = 0.7;

/// Half of a 95 % interval in standard deviations.
const HALF: f64 = 1.96;

/// Clarity in dB below which a mode may be one of the room: its sound, noise that decays, has tones of up to this clarity.
const DOUBTFUL: f64 = 24.0;

/// What to listen for.
#[derive(Clone, Debug, PartialEq)]
pub struct ListenOptions {
    /// Lowest and highest frequency in Hz; by default 20 to 5000, but no more than four tenths of the sample rate.
    pub band: Option<[f64; 2]>,
    /// Frequency of the mains in Hz; by default 50 or 60, whichever is heard.
    pub mains: Option<f64>,
    /// Number of the hit to listen to, from 0; by default the last.
    pub hit: Option<usize>,
    /// Largest number of modes, the strongest ones.
    pub most: usize,
    /// Least level of a mode relative to the strongest, in dB.
    pub least_db: f64,
}

impl Default for ListenOptions {
    fn default() -> Self {
        Self { band: None, mains: None, hit: None, most: 30, least_db: -60.0 }
    }
}

/// A mode that rings in a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungMode {
    /// Frequency in Hz.
    pub hz: f64,
    /// Ends of its 95 % interval in Hz, by the noise.
    pub hz_interval: [f64; 2],
    /// Decay time in s, in which the amplitude falls to 1/e.
    pub decay_time: f64,
    /// Ends of its 95 % interval in s, by the noise.
    pub decay_interval: [f64; 2],
    /// Level in dB relative to the strongest mode.
    pub level_db: f64,
    /// Amplitude over its standard deviation, in dB.
    pub clarity_db: f64,
}

impl RungMode {
    /// Whether it may be no mode of the surface, but sound of the room: less than 24 dB clear of the noise.
    pub fn is_doubtful(&self) -> bool {
        self.clarity_db < DOUBTFUL
    }
}

/// A tone that does not decay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyTone {
    /// Frequency in Hz.
    pub hz: f64,
    /// Level in dB relative to the strongest mode.
    pub level_db: f64,
}

/// What is heard in the recording of a knock.
#[derive(Clone, Debug, PartialEq)]
pub struct Knock {
    /// Times of all hits, in s.
    pub hits: Vec<f64>,
    /// Beginning and end of the part that was used, in s.
    pub used: [f64; 2],
    /// The modes, lowest first.
    pub modes: Vec<RungMode>,
    /// Frequency of the mains in Hz, if harmonics of it were heard.
    pub mains: Option<f64>,
    /// Harmonics of the mains.
    pub hum: Vec<SteadyTone>,
    /// Other tones that do not decay.
    pub tones: Vec<SteadyTone>,
}

/// Finds natural frequencies and decay times in a recording of a knock, one channel at `rate` samples a second.
///
/// # Errors
/// [`CalibrateError::Range`] of options or a rate out of range; [`CalibrateError::Recording`] of a recording without a hit, or with too
/// little after it.
pub fn listen(recording: &[f64], rate: f64, options: &ListenOptions) -> Result<Knock, CalibrateError> {
    let band = band(rate, options)?;
    let mean = recording.iter().sum::<f64>() / recording.len().max(1) as f64;
    let sound: Vec<f64> = recording.iter().map(|x| x - mean).collect();
    let hits = hits(&sound, rate);
    let (from, to) = used(&hits, sound.len(), rate, options.hit)?;
    let tones = once(tones(&sound[from..to], rate, band));
    let in_band = |tone: &&Tone| (band[0]..=band[1]).contains(&tone.hz[0]);
    let loudest = |modes_alone: bool| {
        let those = tones.iter().filter(|tone| !modes_alone || (in_band(tone) && tone.rings()));
        those.map(|tone| tone.amplitude).fold(0.0, f64::max)
    };
    // Where nothing rings, levels are relative to the strongest tone.
    let strongest = if loudest(true) > 0.0 { loudest(true) } else { loudest(false) };
    let level = |tone: &Tone| 20.0 * (tone.amplitude / strongest).log10();
    let mut modes: Vec<&Tone> =
        tones.iter().filter(in_band).filter(|tone| tone.rings() && level(tone) >= options.least_db).collect();
    modes.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    modes.truncate(options.most);
    modes.sort_by(|a, b| a.hz[0].total_cmp(&b.hz[0]));
    let mains = options.mains.or_else(|| mains(&tones));
    let is_hum = |tone: &&Tone| mains.is_some_and(|mains| tone.is_hum(mains));
    let steady = |tone: &Tone| SteadyTone { hz: tone.hz[0], level_db: level(tone) };
    let hum: Vec<SteadyTone> = tones.iter().filter(is_hum).map(steady).collect();
    Ok(Knock {
        hits: hits.iter().map(|hit| hit.from as f64 / rate).collect(),
        used: [from as f64 / rate, to as f64 / rate],
        modes: modes.into_iter().map(|tone| rung(tone, level(tone))).collect(),
        tones: tones.iter().filter(|tone| tone.is_steady() && !is_hum(tone)).map(steady).collect(),
        mains: mains.filter(|_| !hum.is_empty()),
        hum,
    })
}

fn rung(tone: &Tone, level_db: f64) -> RungMode {
    let [hz, spread] = tone.hz;
    let [decay, decay_spread] = tone.decay;
    let [slow, fast] = [decay - HALF * decay_spread, decay + HALF * decay_spread];
    RungMode {
        hz,
        hz_interval: [hz - HALF * spread, hz + HALF * spread],
        decay_time: 1.0 / decay,
        // A mode decays faster than three deviations, so that both ends are above 0.
        decay_interval: [1.0 / fast, 1.0 / slow],
        level_db,
        clarity_db: 20.0 * tone.clarity.log10(),
    }
}

/// The band to listen to, after a check of all options.
fn band(rate: f64, options: &ListenOptions) -> Result<[f64; 2], CalibrateError> {
    if !(1e3..=1e6).contains(&rate) {
        return Err(OutOfRange::new("sample rate in Hz", "1000 to 1000000", rate).into());
    }
    let top = TOP_SHARE * rate;
    let [low, high] = options.band.unwrap_or([20.0, TOP.min(top)]);
    if !(1.0..high).contains(&low) {
        return Err(OutOfRange::new("lowest frequency in Hz", "1 or more, below the highest", low).into());
    }
    if high.is_nan() || high > top {
        let expected = format!("at most {top}, four tenths of the sample rate");
        return Err(OutOfRange::new("highest frequency in Hz", expected, high).into());
    }
    if let Some(mains) = options.mains.filter(|mains| !(10.0..=1000.0).contains(mains)) {
        return Err(OutOfRange::new("frequency of the mains in Hz", "10 to 1000", mains).into());
    }
    if !(-200.0..=0.0).contains(&options.least_db) {
        return Err(OutOfRange::new("least level in dB", "-200 to 0", options.least_db).into());
    }
    Ok([low, high])
}

/// The samples after a hit that are used: from the end of its contact to the next hit or the end.
fn used(
    hits: &[Hit],
    length: usize,
    rate: f64,
    wanted: Option<usize>,
) -> Result<(usize, usize), CalibrateError> {
    let refused = |what: &str, expected: String, found: String| {
        Err(CalibrateError::Recording { what: what.into(), expected, found })
    };
    let Some(number) = wanted.or_else(|| hits.len().checked_sub(1)) else {
        return refused("knock", "a hit, which begins at once".into(), "none".into());
    };
    let Some(hit) = hits.get(number) else {
        return refused("hit", format!("1 to {}", hits.len()), (number + 1).to_string());
    };
    let from = (hit.to + (CONTACT * rate) as usize).min(length);
    let end = hits.get(number + 1).map_or(length, |next| next.from).min(from + (MOST * rate) as usize);
    let to = end.max(from);
    let seconds = (to - from) as f64 / rate;
    if seconds < LEAST {
        let expected = format!("at least {:.0} ms after it", 1e3 * LEAST);
        return refused("hit", expected, format!("{:.0} ms", 1e3 * seconds));
    }
    Ok((from, to))
}

/// The tones in all sub-bands.
fn tones(sound: &[f64], rate: f64, [low, high]: [f64; 2]) -> Vec<Tone> {
    let mut bands = Vec::new();
    let mut begin = low;
    while begin < high {
        let width = (RELATIVE_WIDTH * begin).max(LEAST_WIDTH);
        bands.push((bands.len(), begin + 0.4 * width, width));
        begin += DISTANCE * width;
    }
    let one = |(number, centre, width): (usize, f64, f64)| -> Vec<Tone> {
        let Some(band) = sub_band(sound, rate, centre, width) else { return Vec::new() };
        let logs = factors(&band.samples).into_iter().map(|factor| factor.ln());
        let logs: Vec<c64> = logs.filter(|log| log.re.abs() < FASTEST).collect();
        let found = refined(&band.samples, logs).unwrap_or_default();
        found.iter().filter_map(|one| Tone::of(one, &band, width, number)).collect()
    };
    bands.into_par_iter().map(one).collect::<Vec<_>>().concat()
}
