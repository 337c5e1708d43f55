//! Figures of the task `sensors`: the sensitivity of all places, and the deviations with every number of places.

use super::Report;
use super::setting::Setting;
use crate::figures::Scene;
use unripple_placement::Approximate;
use unripple_plot::{
    Axis, ColourMap, Colours, Dash, Figure, Ink, Line, Marker, Plot, Rule, Scale, Scatter, Symbol,
};

/// The figures with their names.
pub(super) fn all(report: &Report, setting: &Setting, best: &Approximate) -> Vec<(&'static str, Figure)> {
    vec![("sensitivity", sensitivity(report, setting, best)), ("numbers", numbers(report))]
}

/// The planned places on the sensitivity of all: 1 where the best shares have a part, less elsewhere.
fn sensitivity(report: &Report, setting: &Setting, best: &Approximate) -> Figure {
    let scene = Scene::new(&setting.surface, &[], 0.0);
    let marker = |at: [f64; 2], name: String| Marker { at, symbol: Symbol::Target, name };
    let planned = report.at_m.iter().zip(1..).map(|(at, number)| marker(*at, number.to_string()));
    let kept = report.kept_m.iter().map(|at| marker(*at, "kept".into()));
    let markers = scene.markers.iter().cloned().chain(planned).chain(kept).collect();
    let unknowns = setting.informations.unknowns() as f64;
    let values: Vec<f64> = best.sensitivity.iter().map(|sensitivity| sensitivity / unknowns).collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let scatter = Scatter {
        points: setting.places.iter().map(|at| [at.x, at.y]).collect(),
        outline: scene.outline.clone(),
        markers,
        colours: Colours {
            title: "Sensitivity over the number of unknowns".into(),
            map: ColourMap::Sequential,
            // Where much is known before, all places are near 1.
            low: (least < 0.99).then_some(least),
            ..Colours::default()
        },
        values,
        ..Scatter::default()
    };
    let description =
        "The planned places, on the sensitivity of all places to more measurements beside the best shares"
            .into();
    Figure { width_mm: 110.0, description, ..Figure::of(scatter) }
}

/// Deviations relative to the priors against the number of places.
fn numbers(report: &Report) -> Figure {
    let x: Vec<f64> = report.each_number.iter().map(|number| number.places as f64).collect();
    let line = |of: fn(&super::Number) -> f64, label: &str, ink: usize, dash: Dash| {
        let y = report.each_number.iter().map(of).collect();
        Line { x: x.clone(), y, label: label.into(), ink: Ink::Palette(ink), dash, ..Line::default() }
    };
    let layers = vec![
        line(|number| number.mean_deviation, "geometric mean", 0, Dash::Solid).into(),
        line(|number| number.worst_deviation, "worst unknown", 1, Dash::Dashed).into(),
        Rule { at: report.count as f64, ..Rule::default() }.into(),
    ];
    let plot = Plot {
        x: Axis::new("Number of places"),
        // The mean is a thousandth of the worst where some unknowns are hardly told.
        y: Axis { scale: Scale::Logarithmic, ..Axis::new("Deviation over that of the prior") },
        layers,
        ..Plot::default()
    };
    let description =
        "Standard deviations of what a fit finds, relative to those of the priors, against the number of places"
            .into();
    Figure { description, ..Figure::of(plot) }
}
