//! The report of the task `place` as text.

use super::placed::Layout;
use super::{Report, Second};
use crate::report::{add_notes, markdown};
use crate::several::several;
use crate::thinned::thinned;
use std::fmt::Write;

impl Report {
    /// The report as Markdown, with its figures.
    pub(super) fn markdown(&self) -> String {
        let heading = format!("{}: {} {}", self.surface, several(self.count, "actuator"), self.found());
        let pictures = [
            ("places.png", "The layout, and the contrast with one more actuator at each place"),
            ("numbers.png", "Contrast against the number of actuators"),
        ];
        markdown(&heading, &of(self), &self.files, &pictures)
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        of(self)
    }
}

/// The report as lines of text.
fn of(report: &Report) -> String {
    let mut text = String::new();
    let pitch = report.pitch_m.map_or(String::new(), |pitch| format!(", {:.2} mm apart", 1e3 * pitch));
    let kept = match report.kept.as_slice() {
        [] => String::new(),
        kept => format!(", in addition to {} kept ones", kept.len()),
    };
    let others = if report.held_out { " others" } else { "" };
    let chosen = match &report.judged_on {
        Some(told) => format!("chosen{kept}, among {} of a library ({told})", report.places),
        None => format!("placed{kept}, chosen among {} places{pitch}", report.places),
    };
    let aim = match &report.second_search {
        None => format!("{} of time reversal", report.objective),
        Some(second) => {
            let Second { objective, method, .. } = second;
            format!("{objective} of {method}, from layouts for the {} of time reversal", report.objective)
        }
    };
    let _ = writeln!(
        text,
        "{}: {} {chosen}, for the {aim} (window {:.1} ms) at {}; evaluated on {}{others}.\n",
        report.surface,
        several(report.count, "actuator"),
        1e3 * report.window_s,
        several(report.placed_for, "target"),
        report.evaluated_on,
    );
    for (actuator, number) in report.after.actuators.iter().zip(1..) {
        let [x, y] = actuator.at_m.map(|x| 1e3 * x);
        let end = if number % 4 == 0 || number == report.after.actuators.len() { "\n" } else { "    " };
        let _ = write!(text, "{:<6} {x:7.2}, {y:7.2} mm{end}", actuator.name);
    }
    layouts(&mut text, report);
    search(&mut text, report);
    second(&mut text, report);
    numbers(&mut text, report);
    methods(&mut text, report);
    add_notes(&mut text, &report.notes);
    text
}

/// The table of layouts: contrast and energy of each.
fn layouts(text: &mut String, report: &Report) {
    let reference =
        report.random.as_ref().map_or(report.after.energy_for_peak, |random| random.energy_for_peak);
    let _ = writeln!(text, "\ncontrast                  mean  median   worst  energy for the same peak");
    let mut row = |name: &str, layout: &Layout| {
        let _ = writeln!(
            text,
            "{name:<22} {:7.1} {:7.1} {:7.1}  {:.2}",
            layout.mean_contrast,
            layout.median_contrast,
            layout.worst_contrast,
            layout.energy_for_peak / reference
        );
    };
    row(report.found(), &report.after);
    report.before.iter().for_each(|before| row(report.own(), before));
    if let Some(random) = &report.random {
        let _ = writeln!(
            text,
            "{:<22} {:7.1} {:>7} {:7.1}  1.00  (deviation of the mean {:.1})",
            format!("random, {} layouts", random.layouts),
            random.mean_contrast,
            "",
            random.worst_contrast,
            random.deviation
        );
    }
    for build in &report.mounting {
        let name = format!("errors up to {} mm", 1e3 * build.error_m);
        let _ = writeln!(
            text,
            "{name:<22} {:7.1}                        (deviation of the mean {:.1}, {} builds)",
            build.mean_contrast, build.deviation, build.builds
        );
    }
    let [x, y] = report.after.worst_at_m.map(|x| 1e3 * x);
    let _ = writeln!(text, "\nworst target of the placed layout:  {x:.1}, {y:.1} mm");
}

/// Lines on the search: the values that it reached, and whether the layout is the best of all.
fn search(text: &mut String, report: &Report) {
    let restarts = &report.restarts;
    let least = restarts.reached.iter().copied().fold(f64::INFINITY, f64::min);
    let polished = match (&report.judged_on, &report.second_search) {
        (Some(_), _) => String::new(),
        (None, None) => format!(" on the grid, the final layout {:.2} off the grid", restarts.polished),
        (None, Some(_)) => format!(" on the grid, and {:.2} off it", restarts.polished),
    };
    let which = if report.second_search.is_some() { "search for time reversal" } else { "search" };
    let _ = writeln!(
        text,
        "{which}: {} reached {least:.2} to {:.2}{polished}; certificate: {}",
        several(restarts.reached.len(), "starting layout"),
        restarts.best,
        report.certificate.certificate
    );
    if let Some(more) = &report.one_more {
        let [x, y] = more.at_m.map(|x| 1e3 * x);
        let name = more.name.as_ref().map_or(String::new(), |name| format!("{name} "));
        let _ =
            writeln!(text, "one more actuator: best {name}at {x:.1}, {y:.1} mm, with {:.2}", more.objective);
    }
}

/// What a second search found, beside the layout with which it began.
fn second(text: &mut String, report: &Report) {
    let Some(second) = &report.second_search else { return };
    let Second { method, objective, layouts, most_layouts, searched, evaluated, .. } = second;
    let number = |value: f64| match second.by {
        _ if !value.is_finite() => "-".to_owned(),
        "energy_for_peak" => format!("{value:.3e}"),
        _ => format!("{value:.2}"),
    };
    let others = if report.held_out { "others" } else { "targets, in full" };
    let _ = writeln!(
        text,
        "\n{objective} of {method}\n{:<24} {:>3} searched on {:>5} {others}",
        "", searched.targets, evaluated.targets
    );
    for (name, on, then) in [
        ("best for time reversal", searched.time_reversal, evaluated.time_reversal),
        ("found", searched.found, evaluated.found),
    ] {
        let _ = writeln!(text, "{name:<24} {:>15} {:>12}", number(on), number(then));
    }
    let _ = writeln!(
        text,
        "search by it: {} of at most {most_layouts} evaluated; {}",
        several(*layouts, "layout"),
        second.certificate
    );
}

/// The contrast of every number of actuators, or of some where there are many.
fn numbers(text: &mut String, report: &Report) {
    let all = &report.each_number;
    let _ = writeln!(text, "\nactuators  contrast: mean   worst");
    for i in thinned(all.len(), report.count) {
        let number = &all[i];
        let _ = writeln!(
            text,
            "{:9} {:15.1} {:7.1}",
            number.actuators, number.mean_contrast, number.worst_contrast
        );
    }
}

/// Results by method.
fn methods(text: &mut String, report: &Report) {
    if report.methods.is_empty() {
        return;
    }
    let _ = writeln!(
        text,
        "\nmethod, with loads, means    contrast   felt contrast (dB)   felt level at the limit (dB)   energy for a peak"
    );
    for row in &report.methods {
        for (when, means) in [("before", row.before.as_ref()), ("placed", Some(&row.after))] {
            if let Some(means) = means {
                let tenths = |figure: Option<f64>| figure.map_or("-".into(), |figure| format!("{figure:.1}"));
                let energy = means.energy_for_peak.map_or("-".into(), |energy| format!("{energy:.3e}"));
                let [contrast, felt, level] =
                    [means.contrast, means.felt_contrast_db, means.felt_level_db].map(tenths);
                let _ = writeln!(
                    text,
                    "{:<20} {when:<7} {contrast:>8} {felt:>20} {level:>30} {energy:>19}",
                    row.method
                );
            }
        }
    }
}
