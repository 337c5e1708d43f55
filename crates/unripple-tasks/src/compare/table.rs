//! The table of a comparison: a line for each method on each surface.

use super::compared::Compared;
use super::row::Row;
use std::fmt::Write;
use unripple::act::{LISTEN_M, Level, Note};
use unripple::field::TargetFigures;
use unripple::focus::Method;
use unripple::physics::design::milliseconds;

/// Headings of the first columns: the method; with several surfaces also the surface, its window and its
/// number of modes.
const METHOD: [&str; 1] = ["method"];
const SURFACE: [&str; 4] = ["surface", "method", "window ms", "modes"];

/// Headings of the figures, in the order of `figures`: what a fingertip feels, what the surface does, what
/// that takes.
const FIGURES: [&str; 16] = [
    "felt dB",
    "felt contrast",
    "felt background",
    "felt worst",
    "drive for felt",
    "contrast",
    "background",
    "worst spot",
    "spot mm",
    "peak m/s",
    "energy for peak",
    "power mW",
    "sound dB(A)",
    "peak at limit",
    "plan ms",
    "drive ms",
];

/// The table of a comparison: rows of all surfaces, to be written as text.
pub(super) struct Table<'a> {
    /// The surfaces, each with its rows.
    pub surfaces: &'a [Compared],
    /// Whether there are several surfaces, so that each row names its surface.
    pub several: bool,
    /// The requested level.
    pub level: Level,
}

impl Table<'_> {
    /// The table for a terminal, with its notes.
    pub fn text(&self) -> String {
        let mut text = format!("{self}\n\n");
        let all: Vec<Vec<String>> = std::iter::once(self.headings()).chain(self.cells()).collect();
        // Names are read from the left, numbers from the right.
        let names = if self.several { 2 } else { 1 };
        for row in &all {
            for (i, cell) in row.iter().enumerate() {
                let width = all.iter().map(|row| row[i].chars().count()).max().unwrap_or(0);
                let space = if i == 0 { "" } else { "  " };
                let _ = match i < names {
                    true => write!(text, "{space}{cell:<width$}"),
                    false => write!(text, "{space}{cell:>width$}"),
                };
            }
            text.push('\n');
        }
        for (name, note) in self.notes() {
            let _ = write!(text, "\nnote ({name}): {}", note.text);
        }
        text
    }

    /// The table as Markdown, with its notes.
    pub fn markdown(&self) -> String {
        let mut text = format!("{self}\n\n");
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let headings = self.headings();
        let rule = vec!["---".to_owned(); headings.len()];
        text.push_str(&line(&headings));
        text.push_str(&line(&rule));
        self.cells().for_each(|row| text.push_str(&line(&row)));
        for (name, note) in self.notes() {
            let _ = write!(text, "\n- **{name}**: {}", note.text);
        }
        text.push('\n');
        text
    }

    fn headings(&self) -> Vec<String> {
        let names: &[&str] = if self.several { &SURFACE } else { &METHOD };
        names.iter().chain(&FIGURES).map(|heading| (*heading).to_owned()).collect()
    }

    /// The rows of each surface: time reversal, to which the others are related, then the method made for
    /// what is felt, then all others.
    fn rows(&self) -> impl Iterator<Item = (&Compared, &Row)> {
        let place = |row: &&Row| match row.method {
            method if method == Method::TimeReversal.name() => 0,
            method if method == Method::Felt.name() => 1,
            _ => 2,
        };
        self.surfaces.iter().flat_map(move |on| {
            let mut rows: Vec<&Row> = on.methods.iter().collect();
            rows.sort_by_key(place);
            rows.into_iter().map(move |row| (on, row))
        })
    }

    /// The cells of each row, in the order of the headings.
    fn cells(&self) -> impl Iterator<Item = Vec<String>> {
        self.rows().map(move |(on, row)| {
            let method = row.method.to_owned();
            let mut cells = match self.several {
                true => vec![on.label.clone(), method, milliseconds(on.window_s), on.modes.to_string()],
                false => vec![method],
            };
            cells.extend(figures(row));
            cells
        })
    }

    /// Notes on all drives, each with the name of its method and, with several surfaces, of its surface.
    fn notes(&self) -> impl Iterator<Item = (String, &Note)> {
        self.rows().flat_map(move |(on, row)| {
            let name = match self.several {
                true => format!("{}, {}", on.label, row.method),
                false => row.method.to_owned(),
            };
            row.notes.iter().map(move |note| (name.clone(), note))
        })
    }

    /// What drives are evaluated on, in words.
    fn judged_on(&self) -> String {
        let libraries = self.surfaces.iter().filter(|on| on.judged_on.is_some()).count();
        let modes = format!("simulated with modes up to {} Hz", self.judged_to());
        match libraries {
            0 => modes,
            all if all == self.surfaces.len() => "evaluated on the points of the library".into(),
            _ => format!("{modes}, or evaluated on the points of libraries"),
        }
    }

    /// Highest frequency of the modes that drives are evaluated on, in Hz, as text: the least and the
    /// greatest of all surfaces if they differ.
    fn judged_to(&self) -> String {
        let tops = || self.surfaces.iter().filter(|on| on.judged_on.is_none()).map(|on| on.judged_to_hz);
        let [least, most] =
            [tops().fold(f64::INFINITY, f64::min), tops().fold(0.0, f64::max)].map(|hz| format!("{hz:.0}"));
        if least == most { most } else { format!("{least} to {most}") }
    }
}

/// The sentence above the table: what all rows have in common.
impl std::fmt::Display for Table<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.surfaces {
            [on] if !self.several => {
                write!(f, "Window {} ms, first target, ", milliseconds(on.window_s))?;
            }
            _ => f.write_str("First target, ")?,
        }
        match self.level {
            Level::Linear => f.write_str("each as strong as linear theory and the drive limit allow")?,
            Level::Limit => f.write_str("at the drive limit")?,
            Level::Peak(metres) => {
                write!(f, "each moving it by {} µm if the drive limit lets it", three(metres * 1e6))?;
            }
            Level::Felt(db) => {
                write!(f, "each felt there {db:.1} dB above threshold if the drive limit lets it")?;
            }
        }
        let of = if self.several { " on the same surface" } else { "" };
        let height = self.rows().next().map_or(LISTEN_M, |(_, row)| row.sound.at_m[2]);
        write!(
            f,
            ", {}. Energy for the same peak and peak at the drive limit are relative to time \
             reversal's{of}; power: mechanical, into the sheet, on average; sound: A-weighted, {height} m above the middle, exposure \
             level of one drive or mean level of a repeated one; felt: dB above threshold, and below the target's level; drive for the same \
             felt level in dB over time reversal's.",
            self.judged_on()
        )
    }
}

/// The figures of a row, of its first target.
fn figures(row: &Row) -> [String; 16] {
    let number = |x: Option<f64>, digits: usize| x.map_or("-".into(), |x| format!("{x:.digits$}"));
    let target = row.targets.first();
    let of = |figure: fn(&TargetFigures) -> Option<f64>| target.and_then(figure);
    [
        number(of(|t| t.felt_level_db), 1),
        number(of(|t| t.felt_contrast_db), 1),
        number(of(|t| t.felt_background_db), 1),
        number(of(|t| t.felt_worst_spot_db), 1),
        format!("{:.1}", row.drive_for_level_db),
        number(of(|t| t.contrast), 1),
        number(of(|t| t.background_contrast), 1),
        number(of(|t| t.worst_spot), 2),
        number(of(|t| t.spot_diameter_m.map(|d| d * 1e3)), 2),
        target.filter(|t| t.peak_velocity_m_s.is_finite()).map_or("-".into(), |t| three(t.peak_velocity_m_s)),
        format!("{:.2}", row.energy_for_peak),
        row.mean_mechanical_power_w.map_or("-".into(), |watts| three(1e3 * watts)),
        number(row.sound.a_weighted_db(), 1),
        three(row.peak_at_limit),
        format!("{:.1}", row.plan_s * 1e3),
        format!("{:.2}", row.drive_s * 1e3),
    ]
}

/// A number with three significant digits, which is as precise as a level is known.
fn three(value: f64) -> String {
    let digits = (2.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.digits$}")
}
