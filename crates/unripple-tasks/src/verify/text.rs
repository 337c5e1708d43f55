//! The report of `verify` as text.

use super::Report;
use super::report::{FocusFigures, Measured, State};
use crate::report::add_notes;
use std::fmt::Write;

/// Number of causes that are printed.
const CAUSES: usize = 3;

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = String::new();
        let verb = if self.state == State::Planned { "would be" } else { "was" };
        let _ = writeln!(
            text,
            "the drive {verb} played at level {:.3}: peak {:.4} {}, {:.0} % of the limit, {:.3} s at each of {} places\n",
            self.level,
            self.drive_peak,
            self.drive_unit,
            100.0 * self.limit_share,
            self.recording_s,
            self.places.len()
        );
        self.focus(&mut text);
        self.places(&mut text);
        if let Some(measured) = &self.measured {
            parting(measured, &mut text);
            self.verdict(measured, &mut text);
        }
        add_notes(&mut text, &self.notes);
        text
    }

    fn failure(&self) -> Option<String> {
        let why = || {
            let causes = self.measured.as_ref().and_then(|measured| measured.causes.first());
            let likely = causes.map_or_else(String::new, |cause| format!("; likeliest: {}", cause.text));
            format!("the bench does not do what was predicted{likely}")
        };
        (self.state == State::Differs).then(why)
    }
}

impl Report {
    /// Velocity, contrast and spot: predicted, measured.
    fn focus(&self, text: &mut String) {
        let measured = self.measured.as_ref().map(|measured| measured.focus);
        let _ = writeln!(
            text,
            "{:32}{:>12}{:>12}",
            "",
            "predicted",
            if measured.is_some() { "measured" } else { "" }
        );
        let mut row = |what: &str, of: &dyn Fn(&FocusFigures) -> Option<f64>, digits: usize| {
            let said = |value: Option<f64>| {
                value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
            };
            let found = measured.map_or_else(String::new, |focus| said(of(&focus)));
            let _ = writeln!(text, "{what:32}{:>12}{found:>12}", said(of(&self.predicted)));
        };
        let unit =
            if self.scaled { "velocity at the focus, mm/s" } else { "velocity at the focus, relative" };
        row(unit, &|focus| Some(1e3 * focus.velocity_m_s), 3);
        row("contrast over the places", &|focus| focus.contrast, 2);
        row("spot, mm", &|focus| focus.spot_m.map(|width| 1e3 * width), 2);
        let _ = writeln!(text, "at {:.2} ms\n", 1e3 * self.instant_s);
    }

    fn places(&self, text: &mut String) {
        let _ = writeln!(text, "place mm            predicted peak   measured peak   difference");
        for place in &self.places {
            let at = format!("{:.1}, {:.1}", 1e3 * place.at_m[0], 1e3 * place.at_m[1]);
            let found =
                place.measured_peak_m_s.map_or_else(|| "-".into(), |v| format!("{:.3} mm/s", 1e3 * v));
            let off = place.difference.map_or_else(|| "-".into(), |off| format!("{:.1} %", 100.0 * off));
            let known = format!("{:.3} mm/s", 1e3 * place.predicted_peak_m_s);
            let _ = writeln!(text, "{at:20}{known:>14}{found:>16}{off:>13}");
        }
    }

    fn verdict(&self, measured: &Measured, text: &mut String) {
        let _ = writeln!(
            text,
            "{:.1} % of the recordings' amplitude is unexplained (noise {:.1} %), latency {:.3} ms",
            100.0 * measured.unexplained,
            100.0 * measured.noise,
            1e3 * measured.latency_s
        );
        match self.state {
            State::Agrees => *text += "the bench does what was predicted\n",
            _ if measured.causes.is_empty() => {
                *text += "the bench differs, and none of the causes known explains it\n"
            }
            _ => *text += "the bench differs; likeliest causes:\n",
        }
        for cause in measured.causes.iter().take(CAUSES) {
            let _ =
                writeln!(text, "  {} (leaves {:.1} % unexplained)", cause.text, 100.0 * cause.unexplained);
        }
    }
}

/// Where the difference is largest.
fn parting(measured: &Measured, text: &mut String) {
    let time = measured.times.iter().max_by(|a, b| a.share.total_cmp(&b.share));
    let band = measured.bands.iter().max_by(|a, b| a.share.total_cmp(&b.share));
    if let Some((time, band)) = time.zip(band) {
        let _ = writeln!(
            text,
            "\nthe difference lies most from {:.1} to {:.1} ms ({:.0} % of it), and from {:.0} to {:.0} Hz ({:.0} %)",
            1e3 * time.span_s[0],
            1e3 * time.span_s[1],
            100.0 * time.share,
            band.band_hz[0],
            band.band_hz[1],
            100.0 * band.share
        );
    }
}
