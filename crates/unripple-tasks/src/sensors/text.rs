//! The report of the task `sensors` as text.

use super::planned::below;
use super::{Report, SensingAsk, Unknown};
use crate::report::{add_notes, markdown};
use crate::thinned::thinned;
use std::fmt::Write;

/// Rows of the table of unknowns that are printed: all are in the JSON.
const UNKNOWNS: usize = 24;

impl Report {
    /// The report as Markdown, with its figures.
    pub(super) fn markdown(&self) -> String {
        let heading = format!("{}: {} {} planned", self.surface, self.count, named(self.sensing));
        let pictures = [
            ("sensitivity.png", "The planned places, and the sensitivity of all"),
            ("numbers.png", "Deviations against the number of places"),
        ];
        markdown(&heading, &of(self), &self.files, &pictures)
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        of(self)
    }
}

fn named(sensing: SensingAsk) -> &'static str {
    match sensing {
        SensingAsk::Sweeps => "sensors",
        SensingAsk::Taps => "taps",
    }
}

/// The report as lines of text.
fn of(report: &Report) -> String {
    let mut text = String::new();
    let pitch = report.pitch_m.map_or(String::new(), |pitch| format!(", {:.2} mm apart", 1e3 * pitch));
    let kept = match report.kept_m.len() {
        0 => String::new(),
        kept => format!(", beside {kept} that are kept"),
    };
    let _ = writeln!(
        text,
        "{}: {} {} planned{kept}, chosen among {} places{pitch}, for a fit of {} unknowns at {} frequencies from {:.0} to {:.0} Hz, \
         with a signal-to-noise ratio of {} dB.\n",
        report.surface,
        report.count,
        named(report.sensing),
        report.places,
        report.unknowns.len(),
        report.lines,
        report.band_hz[0],
        report.band_hz[1],
        report.snr_db,
    );
    for (at, number) in report.at_m.iter().zip(1..) {
        let [x, y] = at.map(|x| 1e3 * x);
        let end = if number % 4 == 0 || number == report.at_m.len() { "\n" } else { "    " };
        let _ = write!(text, "{number:>3} {x:7.2}, {y:7.2} mm{end}");
    }
    unknowns(&mut text, report);
    certificate(&mut text, report);
    numbers(&mut text, report);
    add_notes(&mut text, &report.notes);
    text
}

/// Standard deviations before and after.
fn unknowns(text: &mut String, report: &Report) {
    let _ = writeln!(text, "\nstandard deviation           prior      planned       random         even");
    let shown = |deviation: Option<f64>| deviation.map_or("-".into(), |deviation| format!("{deviation:.2e}"));
    // What is told best beside its prior comes first.
    let mut rows: Vec<&Unknown> = report.unknowns.iter().collect();
    rows.sort_by(|a, b| (a.planned / a.prior).total_cmp(&(b.planned / b.prior)));
    for unknown in rows.iter().take(UNKNOWNS) {
        let _ = writeln!(
            text,
            "{:<22} {:>11} {:>12} {:>12} {:>12} {}",
            unknown.name,
            shown(Some(unknown.prior)),
            shown(Some(unknown.planned)),
            shown(unknown.random),
            shown(unknown.even),
            if unknown.unit.is_empty() { "of it" } else { unknown.unit }
        );
    }
    if rows.len() > UNKNOWNS {
        let _ = writeln!(text, "and {} more, which are told less", rows.len() - UNKNOWNS);
    }
    if let [a, b] = report.worst_pair.unknowns.as_slice() {
        let _ = writeln!(
            text,
            "told apart worst: {a} and {b} (correlation {:.3})",
            report.worst_pair.correlation
        );
    }
    if !report.untold.is_empty() {
        let _ = writeln!(text, "told by no place: {}", report.untold.join(", "));
    }
}

/// How good the places are.
fn certificate(text: &mut String, report: &Report) {
    let certificate = &report.certificate;
    let percent =
        |share: Option<f64>| share.map_or("-".into(), |share| format!("{:.1} %", below(100.0 * share, 10.0)));
    let _ = writeln!(
        text,
        "\nD-efficiency, at least: planned {}, random {}, even {}; {:.1} unknowns are told",
        percent(Some(certificate.efficiency)),
        percent(certificate.random),
        percent(certificate.even),
        certificate.told
    );
    let least = report.reached.iter().copied().fold(f64::INFINITY, f64::min);
    let _ = writeln!(
        text,
        "search: {} beginnings reached {} to {}",
        report.reached.len(),
        percent(Some(least)),
        percent(Some(certificate.efficiency))
    );
    let _ = writeln!(text, "certificate: {}", certificate.certificate);
}

/// The deviations of every number of places, or of some where there are many.
fn numbers(text: &mut String, report: &Report) {
    let all = &report.each_number;
    let _ =
        writeln!(text, "\nplaces  deviation over prior: mean    worst                         efficiency");
    for i in thinned(all.len(), report.count) {
        let number = &all[i];
        let _ = writeln!(
            text,
            "{:6} {:27.4} {:8.4}  {:<22} {:8.1} %",
            number.places,
            number.mean_deviation,
            number.worst_deviation,
            number.worst,
            below(100.0 * number.efficiency, 10.0)
        );
    }
}
