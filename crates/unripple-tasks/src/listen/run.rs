//! Listens to the recording of a knock.

use super::{Ask, Report, Rung, Tone, figure};
use crate::figures::Columns;
use crate::{Progress, TaskError, figures, folder, go_on};
use unripple::act::Note;
use unripple::dsp::rms;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::ringing::{Knock, ListenOptions, listen};
use unripple_store::{Wav, read_wav};

/// Longest recording in s: more is no knock, and takes minutes.
const LONGEST: f64 = 600.0;

/// Equal samples in a row at the largest magnitude that are no chance: the recording is clipped.
const IN_A_ROW: usize = 4;

/// Finds natural frequencies and decay times in a recording of a knock, and writes a report and figures to a folder if the request names
/// one.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; [`TaskError::Input`] of a recording that cannot be read, has no hit, or has too little
/// after it; those of writing the folder; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let columns = Columns::of(ask.columns)?;
    let options = options(ask)?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let wav = read_wav(&ask.recording)?;
    let channel = channel(ask, &wav)?;
    let sound = &wav.channels[channel];
    go_on(progress)?;
    progress.stage("listening");
    let heard = listen(sound, wav.rate, &options).map_err(|error| refused(ask, error))?;
    go_on(progress)?;
    let mut report = reported(ask, &wav, channel, &heard);
    if let Some((out, record)) = out {
        if !ask.no_figures {
            progress.stage("figures");
            let drawn = figure::all(&report, sound);
            report.files = figures::write(&out, &columns.fit(drawn))?;
        }
        record.write(&out, &report)?;
        out.write("report.md", report.markdown().as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(report)
}

/// The options of listening, after a check of what the recording does not decide.
fn options(ask: &Ask) -> Result<ListenOptions, TaskError> {
    if let Some([low, high]) = ask.band_hz.filter(|[low, high]| !(1.0..*high).contains(low)) {
        let expected = "two frequencies from 1 Hz, the lower first";
        return Err(TaskError::ask("band_hz", expected, format!("{low} and {high}")));
    }
    if let Some(mains) = ask.mains_hz.filter(|mains| !(10.0..=1000.0).contains(mains)) {
        return Err(TaskError::ask("mains_hz", "10 to 1000 Hz", mains));
    }
    if !(-200.0..=0.0).contains(&ask.least_db) {
        return Err(TaskError::ask("least_db", "-200 to 0 dB", ask.least_db));
    }
    if !(1..=1000).contains(&ask.most) {
        return Err(TaskError::ask("most", "1 to 1000", ask.most));
    }
    let hit = match ask.hit {
        Some(0) => return Err(TaskError::ask("hit", "a number from 1", 0)),
        hit => hit.map(|number| number - 1),
    };
    Ok(ListenOptions { band: ask.band_hz, mains: ask.mains_hz, hit, most: ask.most, least_db: ask.least_db })
}

/// The error of listening, of the option that it is about where one was given: a band that the sample rate does not allow, or a hit that is
/// not there or has too little after it.
fn refused(ask: &Ask, error: CalibrateError) -> TaskError {
    match error {
        CalibrateError::Range(error) if ask.band_hz.is_some() && error.what.ends_with("frequency in Hz") => {
            TaskError::ask("band_hz", error.expected, error.found)
        }
        CalibrateError::Recording { what, expected, found } if ask.hit.is_some() && what == "hit" => {
            TaskError::ask("hit", expected, found)
        }
        error => error.into(),
    }
}

/// Index of the channel to listen to.
fn channel(ask: &Ask, wav: &Wav) -> Result<usize, TaskError> {
    let name = ask.recording.display();
    let count = wav.channels.len();
    let seconds = wav.channels.first().map_or(0.0, |channel| channel.len() as f64 / wav.rate);
    if seconds > LONGEST {
        return Err(TaskError::Input(format!("{name}: expected at most {LONGEST} s, found {seconds:.0} s")));
    }
    match ask.channel {
        Some(number) if (1..=count).contains(&number) => Ok(number - 1),
        Some(number) => Err(TaskError::ask("channel", format!("1 to {count}"), number)),
        None => {
            let louder =
                |a: usize, b: usize| if rms(&wav.channels[b]) > rms(&wav.channels[a]) { b } else { a };
            Ok((0..count).reduce(louder).unwrap_or(0))
        }
    }
}

fn reported(ask: &Ask, wav: &Wav, channel: usize, heard: &Knock) -> Report {
    let sound = &wav.channels[channel];
    let modes: Vec<Rung> = heard.modes.iter().map(Rung::of).collect();
    Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "listen",
        recording: ask.recording.display().to_string(),
        channel: channel + 1,
        sample_rate_hz: wav.rate,
        length_s: sound.len() as f64 / wav.rate,
        hits_s: heard.hits.clone(),
        used_s: heard.used,
        modes_text: Rung::typed(&modes),
        modes,
        mains_hz: heard.mains,
        hum: heard.hum.iter().map(Tone::of).collect(),
        tones: heard.tones.iter().map(Tone::of).collect(),
        notes: notes(ask, wav, sound, heard),
        files: Vec::new(),
    }
}

/// What is to be doubted.
fn notes(ask: &Ask, wav: &Wav, sound: &[f64], heard: &Knock) -> Vec<Note> {
    let mut notes = Vec::new();
    let mut add = |topic: &'static str, text: String| notes.push(Note { topic, text });
    if heard.hits.len() > 1 && ask.hit.is_none() {
        let text = format!("{} hits were heard; what follows the last of them is used", heard.hits.len());
        add("hits", text);
    }
    if is_clipped(sound) {
        add(
            "clipping",
            "the recording is clipped: decay times of strong modes are too long; record more softly".into(),
        );
    }
    if wav.channels.len() > 1 && ask.channel.is_none() {
        add("channel", format!("the loudest of {} channels is used", wav.channels.len()));
    }
    if heard.modes.is_empty() {
        add("modes", "no mode is clear of the noise".into());
    }
    let doubtful = heard.modes.iter().filter(|mode| mode.is_doubtful()).count();
    if doubtful > 0 {
        let text = format!(
            "{doubtful} of {} are less than 24 dB clear of the noise, as sound of a room is: they are not in the list for a fit",
            heard.modes.len()
        );
        add("doubtful", text);
    }
    notes
}

/// Whether samples stay at the largest magnitude.
fn is_clipped(sound: &[f64]) -> bool {
    let largest = sound.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let at = |x: &f64| x.abs() > 0.9999 * largest;
    largest > 0.0
        && sound
            .windows(IN_A_ROW)
            .any(|row| row.iter().all(at) && row[0].signum() == row[IN_A_ROW - 1].signum())
}
