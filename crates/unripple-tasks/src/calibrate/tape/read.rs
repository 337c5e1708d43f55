//! Reading of a recording's channels, with checks of their number, sample rate, silence and clipping.

use super::fault::Fault;
use std::path::Path;
use unripple::core::Layout;
use unripple::dsp::resample;
use unripple_calibrate::signals::{Band, clipped};
use unripple_store::{Wav, read_wav};

/// Number of samples in runs at the largest magnitude up to which a channel does not count as clipped.
const FLAT: usize = 20;

/// Least sample rate of a recording that is to be resampled, as a multiple of the highest swept frequency:
/// twice, and the resampler's transition.
const ROOM: f64 = 2.2;

/// How recordings are read: their channels, sample rate and band.
#[derive(Clone, Debug)]
pub struct Reader {
    /// The channels that recordings must have, and the sample rate of the surface.
    pub layout: Layout,
    /// The band of frequencies that the sweeps cover.
    pub band: Band,
    /// Whether recordings of another sample rate are resampled to that of the surface.
    pub resample: bool,
}

/// Channels of a recording that must have a signal, by index.
pub struct Needed<'a> {
    /// Channels all of which must have a signal.
    pub all: &'a [usize],
    /// Channels at least one of which must have a signal, such as sensors, of which some may be dead.
    pub any: &'a [usize],
}

impl Reader {
    /// Reads the channels of a recording, and checks them for silence and clipping; resamples them if
    /// needed and allowed.
    pub fn read(&self, folder: &Path, file: &str, needed: &Needed<'_>) -> Result<Vec<Vec<f64>>, Fault> {
        let wav = self.wav(folder, file)?;
        let silent = |line: &[f64]| {
            let mean = line.iter().sum::<f64>() / line.len().max(1) as f64;
            line.iter().all(|x| (x - mean).abs() <= 1e-9 * mean.abs().max(f64::MIN_POSITIVE))
        };
        let quiet: Vec<usize> = (0..wav.channels.len()).filter(|i| silent(&wav.channels[*i])).collect();
        let dead = needed.any.iter().all(|input| quiet.contains(input)).then(|| needed.any.first()).flatten();
        if let Some(input) = needed.all.iter().find(|input| quiet.contains(input)).or(dead) {
            let why = format!("expected sound in {}, found silence", self.named(*input));
            return Err(Fault::new(file, why, "look at its cable and gain, and record again"));
        }
        for input in needed.all.iter().chain(needed.any).filter(|input| !quiet.contains(input)) {
            let flat = clipped(&wav.channels[*input], f64::INFINITY);
            if flat > FLAT {
                let why = format!("{} is clipped: {flat} samples at its largest value", self.named(*input));
                let mend = "turn its gain down, and record again, all points with the same gain";
                return Err(Fault::new(file, why, mend));
            }
        }
        self.at_rate(wav, file)
    }

    /// Reads a recording without checks or resampling, except that it must have all channels.
    pub fn wav(&self, folder: &Path, file: &str) -> Result<Wav, Fault> {
        let wav = read_wav(folder.join(file)).map_err(|error| {
            let why = error.to_string();
            // The path that the message begins with is the file that is named anyway.
            let why = why.split_once(": ").map_or(why.as_str(), |(_, why)| why).to_owned();
            Fault::new(file, why, "save it as WAV of integers, float32 or float64")
        })?;
        let inputs = &self.layout.inputs;
        if wav.channels.len() != inputs.len() {
            let found = wav.channels.len();
            let why = format!("expected {} channels ({}), found {found}", inputs.len(), inputs.join(", "));
            let mend =
                "record all of them into one file, in that order, or list those recorded with `tape_inputs`";
            return Err(Fault::new(file, why, mend));
        }
        Ok(wav)
    }

    fn at_rate(&self, wav: Wav, file: &str) -> Result<Vec<Vec<f64>>, Fault> {
        let rate = self.layout.rate;
        if wav.rate == rate {
            return Ok(wav.channels);
        }
        let why = format!("expected {rate} Hz, found {} Hz", wav.rate);
        if !self.resample {
            let mend = "record at that rate, or have it resampled by `resample`";
            return Err(Fault::new(file, why, mend));
        }
        if wav.rate < ROOM * self.band.high[1] {
            let least = ROOM * self.band.high[1];
            let why = format!("{why}, too low for the sweeps ({least:.0} Hz or more)");
            return Err(Fault::new(file, why, "record at a higher rate"));
        }
        Ok(wav.channels.iter().map(|line| resample(line, wav.rate / rate)).collect())
    }

    /// Number (from 1) and name of an input channel, for messages.
    pub fn named(&self, input: usize) -> String {
        format!("channel {} (`{}`)", input + 1, self.layout.inputs[input])
    }
}
