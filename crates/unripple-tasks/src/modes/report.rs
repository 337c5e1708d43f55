//! Report of the task `modes`.

use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt::Write;
use unripple::act::Note;
use unripple::core::Pole;

/// Largest number of modes in the text report; JSON has all.
const LISTED: usize = 40;

/// The modes of a surface, lowest first: of the sheet alone, and of the sheet with its actuators on it.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the surface in its file.
    pub surface: String,
    /// Highest frequency up to which modes were computed, in Hz.
    pub max_hz: f64,
    /// Number of modes of the sheet alone.
    pub count: usize,
    /// Natural frequency of each mode of the sheet alone, in Hz.
    pub frequencies_hz: Vec<f64>,
    /// Decay time of each mode of the sheet alone, in which its amplitude falls to 1/e, in s; `None` for a
    /// mode that does not decay.
    pub decay_times_s: Vec<Option<f64>>,
    /// Share of bending in the stiffness of each mode, from 0 to 1; tension makes the remainder.
    pub bending_shares: Vec<f64>,
    /// Upper bound of the relative error of the natural frequencies; 0 if there are rounding errors alone.
    pub relative_error: f64,
    /// Upper bound of the relative error of the decay time of each mode of the sheet alone; `None` where it is not known and for a mode
    /// that does not decay.
    pub decay_errors: Vec<Option<f64>>,
    /// The modes with the masses, springs, coils and electrical loads of the actuators; `None` if no actuator loads the sheet.
    pub loaded: Option<Loaded>,
    /// Remarks on the surface, if any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
}

/// The modes of a sheet with its actuators on it, lowest first.
#[derive(Clone, Debug, Serialize)]
pub struct Loaded {
    /// Number of modes of the sheet with its actuators.
    pub count: usize,
    /// Natural frequency of each mode of the sheet with its actuators, in Hz.
    pub frequencies_hz: Vec<f64>,
    /// Decay time of each mode of the sheet with its actuators, in which its amplitude falls to 1/e, in s;
    /// `None` for a mode that does not decay.
    pub decay_times_s: Vec<Option<f64>>,
}

impl Loaded {
    /// The frequencies and decay times of poles, one for each mode.
    pub(super) fn of(modes: &[Pole]) -> Self {
        Self {
            count: modes.len(),
            frequencies_hz: modes.iter().map(|mode| mode.omega / TAU).collect(),
            decay_times_s: modes.iter().map(|mode| (mode.sigma > 0.0).then(|| 1.0 / mode.sigma)).collect(),
        }
    }
}

/// A frequency (Hz) and a decay time (s) as columns; dashes where there is none.
fn columns(hz: Option<&f64>, decay: Option<&Option<f64>>) -> String {
    let hz = hz.map_or("-".into(), |hz| format!("{hz:.4}"));
    let ms = decay.map_or("-".into(), |decay| format!("{:.3}", 1e3 * decay.unwrap_or(f64::INFINITY)));
    format!("{hz:>14} {ms:>15}")
}

impl Report {
    /// The table of a surface whose actuators load it: modes with them first, beside those of the sheet alone.
    fn both(&self, loaded: &Loaded) -> String {
        let mut text = format!(
            "{}: {} modes up to {} Hz with the actuators on it, {} of the sheet alone\n",
            self.surface, loaded.count, self.max_hz, self.count
        );
        text += "         with the actuators              the sheet alone\n";
        text += "  mode   frequency Hz   decay time ms   frequency Hz   decay time ms   bending share %\n";
        let rows = loaded.count.max(self.count);
        for i in 0..rows.min(LISTED) {
            let with = columns(loaded.frequencies_hz.get(i), loaded.decay_times_s.get(i));
            let alone = columns(self.frequencies_hz.get(i), self.decay_times_s.get(i));
            let share =
                self.bending_shares.get(i).map_or("-".into(), |share| format!("{:.3}", 100.0 * share));
            let _ = writeln!(text, "{:6} {with} {alone} {share:>17}", i + 1);
        }
        text + &more(rows) + &self.remarks()
    }
}

impl Report {
    /// What follows the table: motions as a rigid body, the error of the frequencies, and notes.
    fn remarks(&self) -> String {
        let mut text = self.rigid();
        let _ = match self.relative_error {
            0.0 => writeln!(text, "  relative error of a frequency: rounding alone"),
            error => writeln!(text, "  relative error of a frequency: at most {error:.1e}"),
        };
        text += &self.of_decay();
        for note in &self.notes {
            let _ = writeln!(text, "note, {}: {}", note.topic, note.text);
        }
        text
    }

    /// The line on the error of decay times, if any mode decays.
    fn of_decay(&self) -> String {
        let decaying = self.decay_times_s.iter().filter(|decay| decay.is_some()).count();
        if decaying == 0 {
            return String::new();
        }
        let largest = self.decay_errors.iter().flatten().copied().reduce(f64::max);
        let unknown = decaying - self.decay_errors.iter().flatten().count();
        let known = match largest {
            None => format!("not known ({})", self.why_unknown()),
            Some(0.0) => "rounding alone".into(),
            Some(error) => format!("at most {error:.1e}"),
        };
        let but = if largest.is_some() && unknown > 0 {
            format!(", not known of {unknown} modes ({})", self.why_unknown())
        } else {
            String::new()
        };
        format!("  relative error of a decay time: {known}{but}\n")
    }

    /// Why the error of a decay time is not known: its bound is too large, which smaller errors of frequencies may change.
    fn why_unknown(&self) -> &'static str {
        match self.relative_error {
            0.0 => "above 50 %",
            _ => "above 50 %; a finer --accuracy may tell",
        }
    }

    /// The line on motions as a rigid body among the modes, if there are any.
    fn rigid(&self) -> String {
        match self.frequencies_hz.iter().take_while(|hz| **hz == 0.0).count() {
            0 => String::new(),
            1 => "  the first is the motion as a rigid body of a sheet that nothing holds\n".into(),
            n => format!("  the first {n} are the motions as a rigid body of a sheet that nothing holds\n"),
        }
    }
}

/// The line on how many of `count` modes are not listed.
fn more(count: usize) -> String {
    match count.checked_sub(LISTED) {
        Some(left) if left > 0 => format!("   ... and {left} more; --json lists all\n"),
        _ => String::new(),
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        if let Some(loaded) = &self.loaded {
            return self.both(loaded);
        }
        let mut text = format!("{}: {} modes up to {} Hz\n", self.surface, self.count, self.max_hz);
        text += "  mode   frequency Hz   decay time ms   bending share %\n";
        let rows = self.frequencies_hz.iter().zip(&self.decay_times_s).zip(&self.bending_shares);
        for (i, ((hz, decay), bending)) in rows.enumerate().take(LISTED) {
            let share = 100.0 * bending;
            let _ = writeln!(text, "{:6} {} {share:17.3}", i + 1, columns(Some(hz), Some(decay)));
        }
        text + &more(self.count) + &self.remarks()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_error_of_a_decay_time_has_its_reason() {
        let mut report = Report {
            surface: "film".into(),
            max_hz: 500.0,
            count: 2,
            frequencies_hz: vec![100.0, 200.0],
            decay_times_s: vec![Some(0.1); 2],
            bending_shares: vec![0.1; 2],
            relative_error: 1e-2,
            decay_errors: vec![None; 2],
            loaded: None,
            notes: Vec::new(),
        };
        let line = "  relative error of a decay time: ";
        let said = report.of_decay();
        assert_eq!(said, format!("{line}not known (above 50 %; a finer --accuracy may tell)\n"));
        report.decay_errors[0] = Some(0.2);
        let said = report.of_decay();
        assert!(said.contains(", not known of 1 modes (above 50 %; a finer"), "{said}");
        report.relative_error = 0.0;
        assert!(report.of_decay().contains("not known of 1 modes (above 50 %)"));
    }
}
