//! The report of the task `fit_modes` as text.

use super::{Report, Value};
use crate::report::{add_notes, markdown};
use std::fmt::Write;

impl Report {
    /// The report as Markdown, with its figures.
    pub(super) fn markdown(&self) -> String {
        let pictures = [
            ("frequencies.png", "Measured against computed frequencies"),
            ("residuals.png", "Residuals, and the errors of a fit without each mode"),
        ];
        markdown(&format!("{}: fitted to frequencies", self.surface), &of(self), &self.files, &pictures)
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
    let _ = writeln!(
        text,
        "{}: fitted to {} frequencies with a relative error of {} %, from {} starts; {}\n",
        report.surface,
        report.modes.len() + report.spurious_hz.len(),
        rounded(100.0 * report.error),
        report.starts,
        report.sides
    );
    values(&mut text, &report.quantities);
    for untold in &report.untold {
        let how = match untold.factor {
            Some(factor) => format!("only to a factor of {factor:.1} either way"),
            None => "not at all".into(),
        };
        let _ = writeln!(
            text,
            "not told: {}, {how}; {} keeps the value of the file",
            untold.product, untold.held
        );
    }
    losses(&mut text, report);
    modes(&mut text, report);
    others(&mut text, report);
    add_notes(&mut text, &report.notes);
    text
}

/// A number without the digits that rounding adds.
fn rounded(value: f64) -> String {
    format!("{value:.4}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn values(text: &mut String, values: &[Value]) {
    let _ = writeln!(text, "quantity              value  95 % interval              in the file");
    for value in values {
        let [low, high] = value.interval;
        let _ = writeln!(
            text,
            "{:<14} {:>12.4e}  {:.4e} to {:.4e}   {:.4e} {}",
            value.quantity, value.value, low, high, value.nominal, value.unit
        );
    }
}

fn losses(text: &mut String, report: &Report) {
    let Some(losses) = &report.losses else { return };
    if let Some(factor) = losses.loss_factor {
        let interval = losses
            .interval
            .map_or(String::new(), |[low, high]| format!(", 95 % interval {low:.4} to {high:.4}"));
        let _ = writeln!(text, "loss factor {factor:.4}{interval}");
    }
    if let Some(rows) = &losses.decay_times {
        let _ = writeln!(text, "decay times of {} modes are in the fitted surface", rows.len());
    }
}

fn modes(text: &mut String, report: &Report) {
    let _ = writeln!(text, "\n  mode   measured Hz   computed Hz   residual %   without it %");
    for mode in &report.modes {
        let left_out = mode.left_out.map_or("-".into(), |error| format!("{:.2}", 100.0 * error));
        let _ = writeln!(
            text,
            "{:6} {:13.2} {:13.2} {:12.2} {left_out:>14}",
            mode.mode,
            mode.measured_hz,
            mode.computed_hz,
            100.0 * mode.residual
        );
    }
    let listed = |hz: &[f64]| hz.iter().map(|hz| format!("{hz:.1}")).collect::<Vec<_>>().join(", ");
    if !report.missed_hz.is_empty() {
        let _ = writeln!(text, "not heard: modes at {} Hz", listed(&report.missed_hz));
    }
    if !report.spurious_hz.is_empty() {
        let _ = writeln!(text, "no mode: {} Hz", listed(&report.spurious_hz));
    }
    // No more frequencies than unknowns leave no residual to judge by.
    let excess = match report.modes.len() > report.quantities.len() {
        true => format!("{:.2}", report.excess),
        false => "-".into(),
    };
    let _ = writeln!(text, "residuals over the stated error: {excess}");
}

fn others(text: &mut String, report: &Report) {
    if report.others.is_empty() {
        let _ = writeln!(text, "no other surface that was tried explains the frequencies as well");
        return;
    }
    let _ = writeln!(text, "\nThese explain the frequencies as well:");
    for (other, number) in report.others.iter().zip(1..) {
        let kind = if other.mirrored { ", a mirror image" } else { "" };
        let _ = writeln!(
            text,
            "\n{number}. {}{kind}; cost {:.1} instead of {:.1}",
            other.sides, other.cost, report.cost
        );
        if !other.mirrored {
            values(text, &other.quantities);
        }
        let telling = other
            .telling
            .as_ref()
            .map_or("nothing that was compared tells them apart", |told| told.text.as_str());
        let _ = writeln!(text, "   {telling}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit_modes::Mode;

    #[test]
    fn no_excess_is_printed_where_no_residual_is_left() {
        let value = Value {
            quantity: "tension".into(),
            unit: "N/m",
            value: 200.0,
            interval: [190.0, 210.0],
            nominal: 200.0,
        };
        let mode = Mode { mode: 1, measured_hz: 100.0, computed_hz: 100.0, residual: 0.0, left_out: None };
        let printed = |count: usize| {
            let (quantities, modes) = (vec![value.clone()], vec![mode; count]);
            of(&Report { quantities, modes, excess: 1.0, ..Report::default() })
        };
        assert!(printed(1).contains("stated error: -\n"), "{}", printed(1));
        assert!(printed(2).contains("stated error: 1.00\n"), "{}", printed(2));
    }
}
