//! Figures of the task `fit_modes`: measured against computed frequencies, and residuals.

use super::Report;
use unripple_plot::{Along, Axis, Dash, Figure, Ink, Layer, Line, Mark, Plot, Points, Rule, Scale, Span};

/// The figures with their names.
pub(super) fn all(report: &Report) -> Vec<(&'static str, Figure)> {
    vec![("frequencies", frequencies(report)), ("residuals", residuals(report))]
}

/// Measured against computed frequencies, with error bars of two standard deviations, on the line where both are equal.
fn frequencies(report: &Report) -> Figure {
    let computed: Vec<f64> = report.modes.iter().map(|mode| mode.computed_hz).collect();
    let measured: Vec<f64> = report.modes.iter().map(|mode| mode.measured_hz).collect();
    let bar = |hz: &f64| {
        let two = 2.0 * report.error;
        [hz * (1.0 - (-two).exp()), hz * two.exp_m1()]
    };
    let ends = [computed.first(), computed.last()].map(|hz| hz.copied().unwrap_or(1.0));
    let equal = Line {
        x: ends.to_vec(),
        y: ends.to_vec(),
        label: "equal".into(),
        ink: Ink::Palette(1),
        dash: Dash::Dashed,
        ..Line::default()
    };
    let error = measured.iter().map(bar).collect();
    let points = Points {
        x: computed,
        y: measured,
        error,
        label: "modes".into(),
        ink: Ink::Palette(0),
        mark: Mark::Disc,
    };
    let plot = Plot {
        x: Axis { scale: Scale::Logarithmic, ..Axis::new("Computed frequency (Hz)") },
        y: Axis { scale: Scale::Logarithmic, ..Axis::new("Measured frequency (Hz)") },
        layers: vec![equal.into(), points.into()],
        ..Plot::default()
    };
    let description =
        "Measured frequencies against those of the fitted surface, with two standard deviations".into();
    Figure { description, ..Figure::of(plot) }
}

/// Residuals of the modes, and the errors that a fit without each would make, beside the stated error.
fn residuals(report: &Report) -> Figure {
    let hz: Vec<f64> = report.modes.iter().map(|mode| mode.measured_hz).collect();
    let points = |y: Vec<f64>, label: &str, ink: usize, mark: Mark| Points {
        x: hz.clone(),
        y,
        label: label.into(),
        ink: Ink::Palette(ink),
        mark,
        ..Points::default()
    };
    let own = report.modes.iter().map(|mode| mode.residual).collect();
    let left_out: Vec<f64> = report.modes.iter().map(|mode| mode.left_out.unwrap_or(f64::NAN)).collect();
    let stated = Span {
        from: -2.0 * report.error,
        to: 2.0 * report.error,
        along: Along::X,
        label: "two deviations".into(),
        ..Span::default()
    };
    let mut layers: Vec<Layer> =
        vec![stated.into(), Rule { at: 0.0, along: Along::X, ..Rule::default() }.into()];
    // A single mode is told by no other.
    if left_out.iter().any(|error| error.is_finite()) {
        layers.push(points(left_out, "fit without it", 1, Mark::Ring).into());
    }
    layers.push(points(own, "fit", 0, Mark::Disc).into());
    let plot = Plot {
        x: Axis { scale: Scale::Logarithmic, ..Axis::new("Measured frequency (Hz)") },
        y: Axis::new("Residual (%)").times(100.0),
        layers,
        ..Plot::default()
    };
    let description = "Relative residuals of the modes, and the errors of fits without each".into();
    Figure { description, ..Figure::of(plot) }
}
