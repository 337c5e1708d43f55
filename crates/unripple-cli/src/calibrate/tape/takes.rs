//! Recordings that were brought back: checked, and brought to where playing began.

use super::plan::Wanted;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use unripple::core::{Drive, Layout};
use unripple::dsp::{Band, Delay, clipped, shift};
use unripple_calibrate::measure::Wires;
use unripple_store::read_wav;

/// Seconds by which a recording may end before what is played, of which the last quarter of a second is silence.
const SHORT: f64 = 0.2;

/// Samples that are left before what is first heard of the sweeps.
const MARGIN: f64 = 240.0;

/// Samples that a recording may begin after what is played, of which the first few blocks are silence.
const AFTER: f64 = 1024.0;

/// Samples at the largest magnitude, side by side, above which a channel is taken to be clipped.
const FLAT: usize = 20;

/// Least likeness of what sensors hear in two recordings of the same sweeps.
const LEAST: f64 = 0.7;

/// Channels that tell how late a recording is.
const TELLING: usize = 3;

/// A recording that cannot be used, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    pub file: String,
    pub why: String,
    pub mend: String,
}

impl Fault {
    pub fn json(&self) -> Value {
        json!({ "file": self.file, "why": self.why, "mend": self.mend })
    }
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}; {}", self.file, self.why, self.mend)
    }
}

/// Reads recordings.
#[derive(Clone, Debug)]
pub struct Takes {
    folder: PathBuf,
    pub layout: Layout,
    pub wires: Wires,
    band: Band,
    /// What is played.
    pub drive: Drive,
    /// What the telling channels hear of it where it begins at time 0, give or take a latency common to all recordings.
    known: Vec<(usize, Vec<f64>)>,
    /// Samples by which recordings have to be moved, by their file.
    late: BTreeMap<String, f64>,
}

impl Takes {
    /// Recordings in a folder, of this drive.
    pub fn new(folder: PathBuf, layout: Layout, wires: Wires, band: Band, drive: Drive) -> Self {
        Self { folder, layout, wires, band, drive, known: Vec::new(), late: BTreeMap::new() }
    }

    /// Inputs that hear the drive itself wherever the probe is: the reference, or the actuators' sensors.
    pub fn telling(&self) -> Vec<usize> {
        self.wires.reference.map_or_else(|| self.wires.sensors.clone(), |reference| vec![reference])
    }

    /// Learns from the recording of the actuators how any other one is to be moved: its loudest telling channels are
    /// kept, moved by whole samples to a little after where the sweeps begin.
    pub fn learn(&mut self, wanted: &Wanted) -> Result<(), Fault> {
        let lines = self.checked(wanted, &self.needed(wanted))?;
        let power = |input: &usize| lines[*input].iter().map(|x| x * x).sum::<f64>();
        let mut telling = self.telling();
        telling.sort_by(|a, b| power(b).total_cmp(&power(a)));
        telling.truncate(TELLING);
        let delays = telling.iter().filter_map(|input| {
            Delay::between(&lines[*input], &self.sent(*input), self.layout.rate, self.band).ok()
        });
        let late = median(delays.map(|delay| delay.samples).collect());
        let late = late.ok_or_else(|| self.unlike(wanted, 0.0))?.round() - MARGIN;
        self.begun(wanted, late)?;
        self.known = telling.into_iter().map(|input| (input, self.moved(&lines[input], late))).collect();
        self.late.insert(wanted.file.clone(), late);
        Ok(())
    }

    /// What a telling channel hears most of: its own actuator's drive, or, of the reference, that of any.
    fn sent(&self, input: usize) -> Vec<f64> {
        let channels = self.drive.channels();
        match self.wires.sensors.iter().position(|sensor| *sensor == input) {
            Some(actuator) if self.wires.reference.is_none() => channels[self.wires.drives[actuator]].clone(),
            _ => sum(channels),
        }
    }

    /// A recording as the device would have heard it: lines of what is played, brought to where that begins. Channels
    /// that nobody asks for are silent.
    pub fn take(&mut self, wanted: &Wanted) -> Result<Vec<Vec<f32>>, Fault> {
        let needed = self.needed(wanted);
        let lines = self.checked(wanted, &needed)?;
        let late = match self.late.get(&wanted.file) {
            Some(late) => *late,
            None => self.late(wanted, &lines)?,
        };
        self.late.insert(wanted.file.clone(), late);
        let samples = self.drive.samples();
        let left = lines[0].len() as f64 - late;
        if left < samples as f64 - SHORT * self.layout.rate {
            let seconds = |count: f64| format!("{:.2} s", count.max(0.0) / self.layout.rate);
            let why = format!(
                "expected {} from where play.wav begins, found {}",
                seconds(samples as f64),
                seconds(left)
            );
            return Err(self.fault(wanted, why, "record until after it has ended"));
        }
        // Within a millionth of a whole number of samples, none is split.
        let late = if (late - late.round()).abs() < 1e-6 { late.round() } else { late };
        let whole = late.floor();
        let lines = lines.iter().enumerate().map(|(input, line)| {
            if !needed.contains(&input) {
                return vec![0.0; samples];
            }
            let line = self.moved(line, whole);
            let line = if late > whole { shift(&line, whole - late) } else { line };
            line.into_iter().map(|x| x as f32).collect()
        });
        Ok(lines.collect())
    }

    /// Samples by which a recording has to be moved: as the telling channels agree; none where there are none.
    fn late(&self, wanted: &Wanted, lines: &[Vec<f64>]) -> Result<f64, Fault> {
        if self.known.is_empty() {
            return Ok(0.0);
        }
        let delays = self
            .known
            .iter()
            .map(|(input, known)| Delay::between(&lines[*input], known, self.layout.rate, self.band));
        let delays: Vec<Delay> = delays.filter_map(Result::ok).collect();
        let likeness = median(delays.iter().map(|delay| delay.correlation).collect()).unwrap_or(0.0);
        let late = median(delays.iter().map(|delay| delay.samples).collect());
        let late = late.filter(|_| likeness >= LEAST).ok_or_else(|| self.unlike(wanted, likeness))?;
        self.begun(wanted, late)?;
        Ok(late)
    }

    /// Refuses a recording that was begun too late.
    fn begun(&self, wanted: &Wanted, late: f64) -> Result<(), Fault> {
        if late >= -MARGIN - AFTER {
            return Ok(());
        }
        let after = -(late + MARGIN) / self.layout.rate;
        let why =
            format!("expected a recording from before play.wav began, found one from {after:.3} s after");
        Err(self.fault(wanted, why, "begin to record first, then to play"))
    }

    /// So many samples as are played, from `late` on.
    fn moved(&self, line: &[f64], late: f64) -> Vec<f64> {
        let at = |i: usize| usize::try_from(i as i64 + late as i64).ok().and_then(|i| line.get(i));
        (0..self.drive.samples()).map(|i| at(i).copied().unwrap_or(0.0)).collect()
    }

    /// Inputs that a recording is of use for.
    fn needed(&self, wanted: &Wanted) -> Vec<usize> {
        let own = wanted.at.is_none();
        let mut needed = self.telling();
        if own {
            needed.extend(&self.wires.sensors);
        } else {
            needed.extend(self.wires.probe);
        }
        needed.sort_unstable();
        needed.dedup();
        needed
    }

    /// The channels of a recording, if it is one of all inputs, at the rate, neither silent nor clipped.
    fn checked(&self, wanted: &Wanted, needed: &[usize]) -> Result<Vec<Vec<f64>>, Fault> {
        let refuse = |why: String, mend: &str| Err(self.fault(wanted, why, mend));
        let wav = match read_wav(self.folder.join(&wanted.file)) {
            Ok(wav) => wav,
            Err(error) => return refuse(error.to_string(), "save it as WAV of integers or float32"),
        };
        let (rate, inputs) = (self.layout.rate, &self.layout.inputs);
        if wav.rate != rate {
            return refuse(
                format!("expected {rate} Hz, found {} Hz", wav.rate),
                "record at that rate, without resampling afterwards",
            );
        }
        if wav.channels.len() != inputs.len() {
            return refuse(
                format!(
                    "expected {} channels ({}), found {}",
                    inputs.len(),
                    inputs.join(", "),
                    wav.channels.len()
                ),
                "record all of them into one file, in that order, or name those there are with --tape-inputs",
            );
        }
        for input in needed {
            let (line, name) = (&wav.channels[*input], &inputs[*input]);
            let mean = line.iter().sum::<f64>() / line.len().max(1) as f64;
            if line.iter().all(|x| (x - mean).abs() <= 1e-9) {
                return refuse(
                    format!("expected sound in channel {} (`{name}`), found silence", input + 1),
                    "look at its cable and gain, and record again",
                );
            }
            let flat = clipped(line, f64::INFINITY);
            if flat > FLAT {
                return refuse(
                    format!(
                        "channel {} (`{name}`) is clipped: {flat} samples at its largest value",
                        input + 1
                    ),
                    "turn its gain down, and record again, all points with the same gain",
                );
            }
        }
        Ok(wav.channels)
    }

    fn unlike(&self, wanted: &Wanted, likeness: f64) -> Fault {
        let names: Vec<&str> =
            self.telling().iter().map(|input| self.layout.inputs[*input].as_str()).collect();
        let why = format!(
            "expected {} to hear the sweeps of play.wav, likeness {LEAST} or more, found {likeness:.2}",
            names.join(", ")
        );
        self.fault(wanted, why, "record while play.wav plays, channels in the order of the plan")
    }

    fn fault(&self, wanted: &Wanted, why: String, mend: &str) -> Fault {
        Fault { file: wanted.file.clone(), why, mend: mend.into() }
    }
}

fn sum(channels: &[Vec<f64>]) -> Vec<f64> {
    let length = channels.first().map_or(0, Vec::len);
    (0..length).map(|i| channels.iter().map(|channel| channel[i]).sum()).collect()
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
