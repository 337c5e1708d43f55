//! Check of levels before a long measurement: what is too loud, what is too quiet, and what to do.

use super::campaign::Campaign;
use super::points::middle;
use crate::TaskError;
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use unripple::core::{Layout, PROBE};
use unripple_calibrate::measure::{Channel, Listen, MeasureOptions, Rig, Session, Wires};
use unripple_calibrate::signals::clipped;
use unripple_store::read_wav;

/// Peak, as a share of full scale, above which the next recording may clip.
const LOUD: f64 = 0.9;

/// Peak, as a share of full scale, below which the steps of integer samples matter: 40 dB below full scale.
const QUIET: f64 = 0.01;

/// Signal-to-noise ratio, in dB, that is worth aiming at: half a per cent of noise in a focus of ten actuators.
const AIM: f64 = 40.0;

/// Signal to noise below which a response is bad, in dB, with some to spare.
const LEAST: f64 = 23.0;

/// Number of samples in runs at the largest magnitude up to which a channel does not count as clipped. A
/// sine of 60 Hz in 16 bits at 48 kHz stays at its crest for three.
const FLAT: usize = 20;

/// Largest number of repeats that are worth their time: they raise the signal-to-noise ratio by 12 dB, and
/// the next 3 dB would double the time again.
const REPEATS: f64 = 16.0;

/// Level of one channel of a recording.
#[derive(Clone, Debug, Serialize)]
struct Level {
    /// Name of the file, for recordings made elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    /// Number of the channel, from 1.
    channel: usize,
    name: String,
    /// Largest magnitude, 1 being full scale.
    peak: f64,
    /// Number of clipped samples.
    clipped: usize,
    /// Signal-to-noise ratio of the worst response, in dB, if it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    signal_to_noise_db: Option<f64>,
    /// What to do about the level, if anything.
    advice: Option<String>,
    /// Whether the input must have a signal.
    #[serde(skip)]
    needed: bool,
}

/// Levels of all recorded channels, and advice on what to do about them.
#[derive(Clone, Debug, Serialize)]
pub struct Levels {
    levels: Vec<Level>,
    advice: Vec<String>,
}

impl Level {
    fn of(name: &str, channel: usize, line: &[f64], absolute: bool) -> Self {
        let peak = line.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let flat = clipped(line, f64::INFINITY);
        let flat = if flat > FLAT { flat } else { 0 };
        let db = |share: f64| 20.0 * share.log10();
        let advice = if flat > 0 {
            Some("clipped: turn its gain down by 6 dB or more".to_owned())
        } else if peak <= 0.0 {
            Some("silent: look at its cable and gain".into())
        } else if absolute {
            None
        } else if peak > LOUD {
            Some(format!("nearly clipped: turn its gain down by {:.0} dB", db(peak / 0.5).ceil()))
        } else if peak < QUIET {
            Some(format!("quiet: turn its gain up by {:.0} dB", db(0.5 / peak).floor()))
        } else {
            None
        };
        let name = name.to_owned();
        Self {
            file: None,
            channel,
            name,
            peak,
            clipped: flat,
            signal_to_noise_db: None,
            advice,
            needed: true,
        }
    }

    /// This level, without advice on silence, for an input that may be silent.
    fn unneeded(self) -> Self {
        let advice = self.advice.filter(|_| self.peak > 0.0);
        Self { advice, needed: false, ..self }
    }

    fn is_useless(&self) -> bool {
        self.needed && (self.clipped > 0 || self.peak <= 0.0)
    }

    /// Adds the signal-to-noise ratio of the channel's responses, measured with `settings`, and advice on
    /// how to raise it.
    fn judged(&mut self, channel: &Channel, without: &[usize], settings: &MeasureOptions) {
        let all = channel.quality.iter().enumerate().filter(|(actuator, _)| !without.contains(actuator));
        let worst = all.map(|(_, quality)| quality.snr_db).fold(f64::INFINITY, f64::min);
        if !worst.is_finite() {
            return;
        }
        self.signal_to_noise_db = Some(worst);
        if self.advice.is_some() || worst >= AIM {
            return;
        }
        let times = (10f64.powf((AIM - worst) / 10.0) * settings.repeats as f64).ceil();
        let louder = if settings.level < 1.0 { "`level` 1, " } else { "" };
        let repeats = times.min(REPEATS);
        self.advice = Some(if worst < LEAST {
            format!(
                "too much noise ({worst:.0} dB): {louder}a quieter place, more gain before the recorder, or `repeats` {repeats:.0}"
            )
        } else {
            format!(
                "a signal-to-noise ratio of {worst:.0} dB is enough; for a better one: {louder}`repeats` {repeats:.0} (which gives \
                 {:.0} dB)",
                worst + 10.0 * (repeats / settings.repeats as f64).log10()
            )
        });
    }
}

impl Levels {
    fn of(levels: Vec<Level>) -> Self {
        let named = |level: &Level| {
            let file = level.file.as_ref().map_or_else(String::new, |file| format!("{file}: "));
            Some(format!("{file}channel {} (`{}`): {}", level.channel, level.name, level.advice.as_ref()?))
        };
        let advice = levels.iter().filter_map(named).collect();
        Self { levels, advice }
    }

    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for level in &self.levels {
            let file = level.file.as_ref().map_or_else(String::new, |file| format!("{file:20}"));
            let peak = 20.0 * level.peak.log10();
            let noise = level
                .signal_to_noise_db
                .map_or_else(String::new, |db| format!(", worst response {db:5.1} dB over noise"));
            let _ = writeln!(
                text,
                "{file}channel {:2} {:12} peak {peak:6.1} dB{noise}",
                level.channel, level.name
            );
        }
        match self.advice.is_empty() {
            true => text += "levels are good\n",
            false => self.advice.iter().for_each(|line| {
                let _ = writeln!(text, "{line}");
            }),
        }
        text
    }

    /// Why the check of levels counts as failed: clipped or silent channels; `None` if there are none.
    pub(super) fn failure(&self) -> Option<String> {
        let useless = self.levels.iter().filter(|level| level.is_useless()).count();
        (useless > 0).then(|| format!("levels: {useless} channels are clipped or silent, see above"))
    }
}

/// Plays all sweeps once, records all inputs, and returns their levels.
pub(super) fn listen(
    known: &Campaign<'_>,
    rig: &mut dyn Rig,
    layout: &Layout,
    wires: &Wires,
) -> Result<Levels, TaskError> {
    let settings = MeasureOptions { repeats: 1, ..known.settings.clone() };
    let session = Session::new(known.surface, layout, wires.clone(), &settings)?;
    let (number, at) = (known.places.points.len(), middle(known.surface));
    let drive = super::tape::sweeps(&session, layout, at)?;
    rig.ready(number, at, 3)?;
    let outputs: Vec<usize> = (0..layout.outputs.len()).collect();
    let inputs: Vec<usize> = (0..layout.inputs.len()).collect();
    let scaled: Vec<Vec<f64>> =
        drive.channels().iter().map(|line| line.iter().map(|x| x * layout.full_scale).collect()).collect();
    let heard =
        unripple_calibrate::measure::record(rig.device(), &outputs, &scaled, &inputs, drive.samples())?;
    // The virtual surface is in SI units, and has no full scale.
    let absolute = known.scales.is_absolute();
    let level = |(input, line): (usize, &Vec<f64>)| {
        let level = Level::of(&layout.inputs[input], input + 1, line, absolute);
        // Nobody strikes while sweeps play.
        if wires.force == Some(input) { level.unneeded() } else { level }
    };
    let mut levels: Vec<Level> = heard.iter().enumerate().map(level).collect();
    let mut judge = |channels: Vec<Channel>, inputs: Vec<usize>| {
        for (channel, input) in channels.iter().zip(inputs) {
            levels[input].judged(channel, &settings.without, &settings);
        }
    };
    if !wires.sensors.is_empty() {
        judge(session.measure(rig, number, at, 4, Listen::Sensors)?, wires.sensors.clone());
    }
    if let Some(probe) = wires.probe {
        judge(session.measure(rig, number, at, 5, Listen::Probe)?, vec![probe]);
    }
    Ok(Levels::of(levels))
}

/// Returns the levels of all recordings; in those of the actuators' sensors the probe may be silent.
pub(super) fn look(files: &[(PathBuf, bool)], inputs: &[String]) -> Result<Levels, TaskError> {
    let mut levels = Vec::new();
    for (file, of_actuators) in files {
        let wav = read_wav(file)?;
        let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
        for (input, line) in wav.channels.iter().enumerate() {
            let unknown = "not planned".to_owned();
            let known = inputs.get(input).unwrap_or(&unknown);
            let level = Level { file: name.clone(), ..Level::of(known, input + 1, line, false) };
            levels.push(if *of_actuators && known == PROBE { level.unneeded() } else { level });
        }
    }
    if levels.is_empty() {
        let text = "`check_levels`: expected a recording in the folder, say actuators.wav, found none; record one while play.wav plays";
        return Err(TaskError::Work(text.into()));
    }
    Ok(Levels::of(levels))
}
