//! Report of the task `listen`.

use crate::report::markdown;
use serde::Serialize;
use std::f64::consts::PI;
use std::fmt::Write;
use unripple::act::Note;
use unripple_calibrate::ringing::{RungMode, SteadyTone};

/// What is heard in the recording of a knock.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// The recording, as it was named.
    pub recording: String,
    /// Channel that was listened to, from 1.
    pub channel: usize,
    /// Sample rate, in Hz.
    pub sample_rate_hz: f64,
    /// Length of the recording, in s.
    pub length_s: f64,
    /// Times of all hits, in s.
    pub hits_s: Vec<f64>,
    /// Beginning and end of the part that was used, in s.
    pub used_s: [f64; 2],
    /// The modes, lowest first.
    pub modes: Vec<Rung>,
    /// The modes as `fit --modes` takes them, without doubtful ones.
    pub modes_text: String,
    /// Frequency of the mains in Hz; `None` if nothing of it was heard.
    pub mains_hz: Option<f64>,
    /// Harmonics of the mains, which are no modes.
    pub hum: Vec<Tone>,
    /// Other tones that do not decay, and are no modes.
    pub tones: Vec<Tone>,
    /// Notes on the recording.
    pub notes: Vec<Note>,
    /// Files in the output folder, beside the report.
    pub files: Vec<String>,
}

/// A mode that rings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rung {
    /// Natural frequency, in Hz.
    pub frequency_hz: f64,
    /// Ends of its 95 % interval by the noise, in Hz.
    pub frequency_interval_hz: [f64; 2],
    /// Decay time in s, in which the amplitude falls to 1/e.
    pub decay_time_s: f64,
    /// Ends of its 95 % interval by the noise, in s.
    pub decay_interval_s: [f64; 2],
    /// Quality factor Q = πfτ.
    pub quality_factor: f64,
    /// Level relative to the strongest mode, in dB.
    pub level_db: f64,
    /// Amplitude over its standard deviation, in dB.
    pub clarity_db: f64,
    /// Whether it may be sound of the room: less than 24 dB clear of the noise.
    pub doubtful: bool,
}

impl Rung {
    pub(super) fn of(found: &RungMode) -> Self {
        Self {
            frequency_hz: found.hz,
            frequency_interval_hz: found.hz_interval,
            decay_time_s: found.decay_time,
            decay_interval_s: found.decay_interval,
            quality_factor: PI * found.hz * found.decay_time,
            level_db: found.level_db,
            clarity_db: found.clarity_db,
            doubtful: found.is_doubtful(),
        }
    }

    /// Modes as `fit --modes` takes them: those that are not doubtful.
    pub(super) fn typed(modes: &[Self]) -> String {
        let one = |mode: &Self| format!("{:.2}:{:.2}", mode.frequency_hz, 1e3 * mode.decay_time_s);
        modes.iter().filter(|mode| !mode.doubtful).map(one).collect::<Vec<_>>().join(",")
    }
}

/// A tone that does not decay.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tone {
    /// Frequency of the tone, in Hz.
    pub frequency_hz: f64,
    /// Level relative to the strongest mode, in dB.
    pub level_db: f64,
}

impl Tone {
    pub(super) fn of(found: &SteadyTone) -> Self {
        Self { frequency_hz: found.hz, level_db: found.level_db }
    }
}

impl Report {
    /// The report as Markdown, with its figures.
    pub(super) fn markdown(&self) -> String {
        let pictures = [
            ("recording.png", "The recording, its hits, and the part that was used"),
            ("modes.png", "Frequencies and decay times"),
        ];
        markdown(&self.recording, &crate::Report::text(self), &self.files, &pictures)
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = String::new();
        let ms =
            |times: &[f64]| times.iter().map(|s| format!("{:.0}", 1e3 * s)).collect::<Vec<_>>().join(", ");
        let hits = if self.hits_s.len() == 1 { "hit" } else { "hits" };
        let _ = writeln!(
            text,
            "{}: {} {hits} at {} ms; listened from {:.0} to {:.0} ms\n",
            self.recording,
            self.hits_s.len(),
            ms(&self.hits_s),
            1e3 * self.used_s[0],
            1e3 * self.used_s[1]
        );
        let _ = writeln!(
            text,
            "frequency Hz   95 % interval          decay ms   95 % interval      Q   level dB"
        );
        for mode in &self.modes {
            let ([low, high], [short, long]) = (mode.frequency_interval_hz, mode.decay_interval_s);
            let (hz, decay) =
                (format!("{low:.2} to {high:.2}"), format!("{:.1} to {:.1}", 1e3 * short, 1e3 * long));
            let _ = writeln!(
                text,
                "{:12.2}   {hz:<20} {:10.2}   {decay:<15} {:>4.0} {:10.1}{}",
                mode.frequency_hz,
                1e3 * mode.decay_time_s,
                mode.quality_factor,
                mode.level_db,
                if mode.doubtful { "  doubtful" } else { "" }
            );
        }
        let tones = |tones: &[Tone]| {
            tones.iter().map(|tone| format!("{:.1}", tone.frequency_hz)).collect::<Vec<_>>().join(", ")
        };
        if let Some(mains) = self.mains_hz.filter(|_| !self.hum.is_empty()) {
            let _ = writeln!(text, "left out: hum of the mains ({mains:.0} Hz) at {} Hz", tones(&self.hum));
        }
        if !self.tones.is_empty() {
            let _ = writeln!(text, "left out: steady tones at {} Hz", tones(&self.tones));
        }
        for note in &self.notes {
            let _ = writeln!(text, "note ({}): {}", note.topic, note.text);
        }
        if !self.modes_text.is_empty() {
            let _ = writeln!(text, "\nFor a fit:\n  unripple fit SURFACE --modes {}", self.modes_text);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Report as _;

    #[test]
    fn doubtful_modes_are_marked_and_not_for_a_fit() {
        let rung = |hz: f64, clarity_db: f64| {
            let (hz_interval, decay_interval) = ([hz, hz], [0.1, 0.1]);
            Rung::of(&RungMode {
                hz,
                hz_interval,
                decay_time: 0.1,
                decay_interval,
                level_db: 0.0,
                clarity_db,
            })
        };
        let modes = vec![rung(100.0, 40.0), rung(150.0, 20.0), rung(200.0, 24.5)];
        assert_eq!(modes.iter().map(|mode| mode.doubtful).collect::<Vec<_>>(), [false, true, false]);
        assert_eq!(Rung::typed(&modes), "100.00:100.00,200.00:100.00");
        let alone = Report { modes: modes[1..2].to_vec(), ..Report::default() }.text();
        assert!(alone.contains("doubtful") && !alone.contains("--modes"), "{alone}");
    }
}
