//! Recordings made elsewhere: checks them, and aligns them to the start of playback.

use super::fault::Fault;
use super::planned::Wanted;
use super::read::{Needed, Reader};
use std::collections::BTreeMap;
use std::path::PathBuf;
use unripple::core::{Drive, Layout};
use unripple::dsp::median;
use unripple_calibrate::measure::Wires;
use unripple_calibrate::signals::{Delay, shift};

/// Seconds by which a recording may end before the played file, whose last quarter of a second is silence.
const SHORT: f64 = 0.2;

/// Number of samples before the first sound of the sweeps: 5 ms at 48 kHz, as many as a response's lead.
const MARGIN: f64 = 240.0;

/// Number of samples by which a recording may begin after the played file, whose first few blocks are
/// silence.
const AFTER: f64 = 1024.0;

/// Least correlation of the sensors' signals in two recordings of the same sweeps: differing clocks and a
/// sheet that warms leave as much.
const LEAST: f64 = 0.3;

/// Correlation below which channels are checked for having been swapped, and above which another channel
/// counts as the right one.
const LIKE: f64 = 0.7;

/// Number of pieces of the drive that are searched for lost samples.
const PIECES: usize = 8;

/// Number of channels from which a recording's delay is found. Three can outvote one that is wrong; more
/// take longer.
const TELLING: usize = 3;

/// Seconds by which the start of playback may differ between actuators: less than the spacing of sweeps.
const AGREE: f64 = 0.05;

/// Largest number of actuators whose own sensors are used to find the start of playback.
const ASKED: usize = 16;

/// Reads recordings, and aligns each to the start of playback.
#[derive(Clone, Debug)]
pub struct Takes {
    folder: PathBuf,
    /// How the files of recordings are read and checked.
    pub reader: Reader,
    /// Which channels belong to which actuators, sensors, probe and reference.
    pub wires: Wires,
    /// The drive that is played.
    pub drive: Drive,
    /// Channels from which delays are found, each with its signal for a drive that begins at time 0, apart
    /// from a latency common to all recordings.
    known: Vec<(usize, Vec<f64>)>,
    /// Number of samples by which each recording begins before the drive, by its file name.
    late: BTreeMap<String, f64>,
}

impl Takes {
    /// Reads recordings from `folder` that were made while `drive` was played.
    pub fn new(folder: PathBuf, reader: Reader, wires: Wires, drive: Drive) -> Self {
        Self { folder, reader, wires, drive, known: Vec::new(), late: BTreeMap::new() }
    }

    /// The channels, sample rate and full scale of recordings.
    pub fn layout(&self) -> &Layout {
        &self.reader.layout
    }

    fn rate(&self) -> f64 {
        self.reader.layout.rate
    }

    /// Inputs from which a recording's delay can be found wherever the probe is: the reference, or else the
    /// actuators' sensors.
    pub fn telling(&self) -> Vec<usize> {
        self.wires.reference.map_or_else(|| self.wires.sensors.clone(), |reference| vec![reference])
    }

    /// Learns from the recording of the actuators how to align all others: it stores the signals of the
    /// loudest channels that record the drive, shifted by whole samples so that playback begins a little
    /// after their first sample.
    pub fn learn(&mut self, wanted: &Wanted) -> Result<(), Fault> {
        let lines = self.lines(wanted)?;
        let telling = loudest(&lines, self.telling());
        let late = self.began(&lines).ok_or_else(|| self.unlike(wanted, 0.0))?.round() - MARGIN;
        self.begun(wanted, late)?;
        self.known = telling.into_iter().map(|input| (input, self.moved(&lines[input], late))).collect();
        self.late.insert(wanted.file.clone(), late);
        Ok(())
    }

    /// Sample at which playback began, from the channels that record the drive.
    fn began(&self, lines: &[Vec<f64>]) -> Option<f64> {
        let anchor = self.heard_themselves(lines);
        match self.wires.reference {
            Some(reference) => self.of_reference(&lines[reference], anchor),
            None => anchor,
        }
    }

    /// Sample at which playback began, from the signal of each actuator at its own sensor: all but dead
    /// actuators agree.
    fn heard_themselves(&self, lines: &[Vec<f64>]) -> Option<f64> {
        let own = |(actuator, input): (usize, &usize)| {
            let sent = self.drive.channels().get(*self.wires.drives.get(actuator)?)?;
            Some(self.like(&lines[*input], sent)?.samples)
        };
        let step = self.wires.sensors.len().div_ceil(ASKED).max(1);
        let all: Vec<f64> = self.wires.sensors.iter().enumerate().step_by(step).filter_map(own).collect();
        let near = |at: f64| -> Vec<f64> {
            all.iter().copied().filter(|other| (other - at).abs() < AGREE * self.rate()).collect()
        };
        all.iter().map(|at| near(*at)).max_by_key(Vec::len).and_then(median)
    }

    /// Sample at which playback began, from the reference channel. That records all outputs or one; since
    /// all play the same sweep, only `anchor` shows which.
    fn of_reference(&self, line: &[f64], anchor: Option<f64>) -> Option<f64> {
        let whole = self.like(line, &sum(self.drive.channels()))?;
        let one = |sent: &Vec<f64>| self.like(line, sent).filter(|like| like.correlation > whole.correlation);
        let mut alone = self.drive.channels().iter().filter_map(one).map(|delay| delay.samples);
        let nearest = match anchor {
            Some(anchor) => alone.min_by(|a, b| (a - anchor).abs().total_cmp(&(b - anchor).abs())),
            // Nothing else decides: the one with which all that is played is in the recording.
            None => alone.find(|late| {
                let left = line.len() as f64 - late;
                *late >= -AFTER && left >= self.drive.samples() as f64 - SHORT * self.rate()
            }),
        };
        nearest.or(Some(whole.samples))
    }

    /// Reads a recording as a device would have made it, `[input][sample]`: aligned to the start of the
    /// drive, and cut to the length of the drive.
    pub fn take(&mut self, wanted: &Wanted) -> Result<Vec<Vec<f32>>, Fault> {
        let lines = self.lines(wanted)?;
        let late = match self.late.get(&wanted.file) {
            Some(late) => *late,
            None => self.late(wanted, &lines)?,
        };
        self.late.insert(wanted.file.clone(), late);
        let samples = self.drive.samples();
        let left = lines[0].len() as f64 - late;
        if left < samples as f64 - SHORT * self.rate() {
            let seconds = |count: f64| format!("{:.2} s", count.max(0.0) / self.rate());
            let why = format!(
                "expected {} of recording after the start of play.wav, found {}",
                seconds(samples as f64),
                seconds(left)
            );
            return Err(Fault::new(&wanted.file, why, "record until after it has ended"));
        }
        // Within a millionth of a whole number of samples, none is split.
        let late = if (late - late.round()).abs() < 1e-6 { late.round() } else { late };
        let whole = late.floor();
        let lines = lines.iter().map(|line| {
            let line = self.moved(line, whole);
            let line = if late > whole { shift(&line, whole - late) } else { line };
            line.into_iter().map(|x| x as f32).collect()
        });
        Ok(lines.collect())
    }

    /// Number of samples by which a recording begins before the drive: the delay on which the channels in
    /// `known` agree; 0 if `known` is empty.
    fn late(&self, wanted: &Wanted, lines: &[Vec<f64>]) -> Result<f64, Fault> {
        if self.known.is_empty() {
            return Ok(0.0);
        }
        let delays = self.known.iter().map(|(input, known)| self.like(&lines[*input], known));
        let delays: Vec<Delay> = delays.flatten().collect();
        let likeness = median(delays.iter().map(|delay| delay.correlation)).unwrap_or(0.0);
        if likeness < LIKE {
            self.in_place(wanted, lines)?;
        }
        let late = median(delays.iter().map(|delay| delay.samples));
        let late = late.filter(|_| likeness >= LEAST).ok_or_else(|| self.unlike(wanted, likeness))?;
        match self.begun(wanted, late) {
            Ok(()) => Ok(late),
            Err(fault) => Err(self.lost(wanted, lines, late).unwrap_or(fault)),
        }
    }

    /// The fault of a recording that seems to begin too late because samples were lost in it: its first
    /// piece is in place, and later ones are too early.
    fn lost(&self, wanted: &Wanted, lines: &[Vec<f64>], late: f64) -> Option<Fault> {
        let length = self.drive.samples() / PIECES;
        let reach = (late.abs() + MARGIN + AFTER) as usize;
        let piece = |n: usize| {
            let from = n * length;
            let first = from.saturating_sub(reach);
            let one = |(input, known): &(usize, Vec<f64>)| {
                let (line, known) = (lines[*input].get(first..)?, &known[from..from + length]);
                let found = self.like(&line[..line.len().min(from + length + reach - first)], known)?.samples;
                // The likeness is that of what is there, not of all that was searched.
                let there = line.get(usize::try_from(found.round() as i64).ok()?..)?;
                let sum = |f: &dyn Fn(f64, f64) -> f64| {
                    there.iter().zip(known).map(|(x, y)| f(*x, *y)).sum::<f64>()
                };
                let likeness = sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt();
                Some((likeness, found + first as f64 - from as f64))
            };
            let best = self.known.iter().filter_map(one).max_by(|a, b| a.0.total_cmp(&b.0));
            best.filter(|(likeness, _)| *likeness >= LIKE).map(|(_, late)| late)
        };
        let begin = piece(0).filter(|begin| *begin >= -MARGIN - AFTER)?;
        let near = |at: f64| (at - late).abs() < (at - begin).abs();
        let after = (1..PIECES).find(|n| piece(*n).is_some_and(near))?;
        let seconds = |n: usize| (n * length) as f64 / self.rate();
        let why = format!(
            "expected all samples that were played, found {:.0} lost between {:.2} and {:.2} s of play.wav",
            begin - late,
            seconds(after.saturating_sub(2)),
            seconds(after + 1)
        );
        Some(Fault::new(&wanted.file, why, "record again, without gaps"))
    }

    fn like(&self, line: &[f64], known: &[f64]) -> Option<Delay> {
        Delay::between(line, known, self.rate(), self.reader.band).ok()
    }

    /// Returns a fault if the signal of a channel in `known` is found in another channel of the recording.
    fn in_place(&self, wanted: &Wanted, lines: &[Vec<f64>]) -> Result<(), Fault> {
        for (input, known) in &self.known {
            let likeness = |line: &Vec<f64>| self.like(line, known).map_or(0.0, |delay| delay.correlation);
            let all: Vec<f64> = lines.iter().map(likeness).collect();
            let Some(best) = (0..all.len()).max_by(|a, b| all[*a].total_cmp(&all[*b])) else { continue };
            if best != *input && all[best] >= LIKE {
                let why = format!(
                    "expected {} to receive the sweeps as in earlier recordings, found its signal in {}",
                    self.reader.named(*input),
                    self.reader.named(best)
                );
                return Err(Fault::new(&wanted.file, why, "record again, channels in the order of the plan"));
            }
        }
        Ok(())
    }

    /// Returns a fault if the recording was begun too late.
    fn begun(&self, wanted: &Wanted, late: f64) -> Result<(), Fault> {
        if late >= -MARGIN - AFTER {
            return Ok(());
        }
        let after = -(late + MARGIN) / self.rate();
        let why =
            format!("expected a recording that begins before play.wav, found one begun {after:.3} s later");
        Err(Fault::new(&wanted.file, why, "begin to record first, then to play"))
    }

    /// The samples of a recording from sample `late` on, as many as the drive has.
    fn moved(&self, line: &[f64], late: f64) -> Vec<f64> {
        let at = |i: usize| usize::try_from(i as i64 + late as i64).ok().and_then(|i| line.get(i));
        (0..self.drive.samples()).map(|i| at(i).copied().unwrap_or(0.0)).collect()
    }

    /// Reads the channels of a recording, and checks that the channels it is needed for have a signal:
    /// sensors may be dead, but not all of them.
    fn lines(&self, wanted: &Wanted) -> Result<Vec<Vec<f64>>, Fault> {
        let mut all: Vec<usize> = self.wires.reference.into_iter().collect();
        if wanted.at.is_some() {
            all.extend(self.wires.probe);
        }
        let needed = Needed { all: &all, any: &self.wires.sensors };
        self.reader.read(&self.folder, &wanted.file, &needed)
    }

    fn unlike(&self, wanted: &Wanted, likeness: f64) -> Fault {
        let names: Vec<&str> =
            self.telling().iter().map(|input| self.layout().inputs[*input].as_str()).collect();
        let why = format!(
            "expected {} to receive the sweeps of play.wav with a correlation of {LEAST} or more, found {likeness:.2}",
            names.join(", ")
        );
        let hint = "record while play.wav plays, channels in the order of the plan; if it did play, samples were lost, the clocks are far \
                    apart, or the latency jitters from sweep to sweep: use one audio interface for both, with larger buffers";
        Fault::new(&wanted.file, why, hint)
    }
}

/// The loudest of the channels `inputs`, at most [`TELLING`] of them.
fn loudest(lines: &[Vec<f64>], mut inputs: Vec<usize>) -> Vec<usize> {
    let power = |input: &usize| lines[*input].iter().map(|x| x * x).sum::<f64>();
    inputs.sort_by(|a, b| power(b).total_cmp(&power(a)));
    inputs.truncate(TELLING);
    inputs
}

fn sum(channels: &[Vec<f64>]) -> Vec<f64> {
    let length = channels.first().map_or(0, Vec::len);
    (0..length).map(|i| channels.iter().map(|channel| channel[i]).sum()).collect()
}
