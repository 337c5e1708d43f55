//! Figures of the task `place`: the layout, and the contrast of every number of actuators.

use super::Report;
use crate::figures::Scene;
use unripple::core::{Point, Surface};
use unripple_plot::{
    Axis, ColourMap, Colours, Dash, Figure, Ink, Line, Mark, Marker, Plot, Points, Rule, Scatter, Symbol,
};

/// What is drawn beside a report.
pub(super) struct Drawn {
    /// The surface on which places are drawn.
    pub surface: Surface,
    /// The places to choose from.
    pub places: Vec<Point>,
    /// The objective with one more actuator at each place, not a number where that is not free.
    pub one_more: Vec<f64>,
}

/// The figures with their names.
pub(super) fn all(report: &Report, drawn: &Drawn) -> Vec<(&'static str, Figure)> {
    let mut all = Vec::new();
    // Where all places are taken, there is nothing to show of one more.
    if drawn.one_more.iter().any(|score| score.is_finite()) {
        all.push(("places", places(report, drawn)));
    }
    all.push(("numbers", numbers(report)));
    all
}

/// The actuators as placed, on what one more would reach at each place.
fn places(report: &Report, drawn: &Drawn) -> Figure {
    let Drawn { surface, places, one_more } = drawn;
    let scene = Scene::new(surface, &[], 0.0);
    let marker = |at: [f64; 2], symbol: Symbol, name: &str| Marker { at, symbol, name: name.into() };
    let mut markers: Vec<Marker> =
        report.after.actuators.iter().map(|a| marker(a.at_m, Symbol::Actuator, &a.name)).collect();
    markers.push(marker(report.after.worst_at_m, Symbol::Target, "worst"));
    // Places beside an actuator are not free.
    let least = one_more.iter().copied().fold(f64::INFINITY, f64::min);
    let most = one_more.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let scatter = Scatter {
        points: places.iter().map(|at| [at.x, at.y]).collect(),
        values: one_more.clone(),
        outline: scene.outline.clone(),
        markers,
        colours: Colours {
            title: format!("{} with one more actuator", capital(&report.objective)),
            map: ColourMap::Sequential,
            // What differs from place to place is small beside what all reach.
            low: (most > least).then_some(least),
            ..Colours::default()
        },
        ..Scatter::default()
    };
    let description =
        "Places of the actuators, with the contrast that one more actuator would give at each place".into();
    Figure { width_mm: 110.0, description, ..Figure::of(scatter) }
}

/// Contrast against the number of actuators, beside the layout of the file and random ones.
fn numbers(report: &Report) -> Figure {
    let x: Vec<f64> = report.each_number.iter().map(|number| number.actuators as f64).collect();
    let of = |figure: fn(&super::Number) -> f64| report.each_number.iter().map(figure).collect::<Vec<_>>();
    let line = |y: Vec<f64>, label: &str, ink: usize, dash: Dash| {
        let (x, ink) = (x.clone(), Ink::Palette(ink));
        Line { x, y, label: label.into(), ink, dash, ..Line::default() }
    };
    let mut layers = vec![
        line(of(|number| number.mean_contrast), "placed, mean of the targets", 0, Dash::Solid).into(),
        line(of(|number| number.worst_contrast), "placed, worst target", 1, Dash::Dashed).into(),
    ];
    if let Some(random) = &report.random {
        let random = Points {
            x: vec![report.after.actuators.len() as f64],
            y: vec![random.mean_contrast],
            error: vec![[random.deviation; 2]],
            label: format!("random layouts, mean of {}", random.layouts),
            ink: Ink::Palette(3),
            mark: Mark::Ring,
        };
        layers.push(random.into());
    }
    if let Some(before) = &report.before {
        let own = Points {
            x: vec![before.actuators.len() as f64],
            y: vec![before.mean_contrast],
            label: report.own().into(),
            ink: Ink::Palette(2),
            mark: Mark::Diamond,
            ..Points::default()
        };
        layers.push(own.into());
    }
    layers.push(Rule { at: report.after.actuators.len() as f64, ..Rule::default() }.into());
    let plot = Plot {
        x: Axis::new("Number of actuators"),
        y: Axis::new("Contrast of time reversal"),
        layers,
        ..Plot::default()
    };
    let description =
        "Contrast of time reversal against the number of actuators, each layout made from the one before"
            .into();
    Figure { description, ..Figure::of(plot) }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
