//! Figures of two repeated foci.

use super::repeated::{AMPLITUDE, LASTS, RATES, Repeated, STEADY, Tracked, steady};
use crate::reproduce::PaperSetup;
use crate::reproduce::places::{named, place};
use unripple::core::window_samples;
use unripple_plot::{
    Axis, Colours, Dash, Figure, Grid, Ink, Layer, Legend, Line, Plot, Rgb, Rule, Traces, prefixed,
};
use unripple_tasks::figures::{Scene, drawn};

/// Part of the traces in the detailed figure, in seconds on either side of a focus.
const CLOSE: f64 = 5e-3;

/// Figure of the displacement of the film when both are in focus, and of five points against time.
pub(super) fn overview(setup: &PaperSetup, repeated: &Repeated) -> Figure {
    let mut scene = Scene::new(&setup.surface, &[], 0.0);
    scene.markers.extend(repeated.points.iter().map(|point| named(point.at, point.name)));
    let grid: Grid = drawn(&repeated.cells, &repeated.shot.displacement);
    let (multiplier, unit) = prefixed(AMPLITUDE, "m");
    let colours = Colours { title: format!("Displacement ({unit})"), multiplier, ..Colours::default() };
    let from = steady(setup);
    let origin = window_samples(setup.window, setup.rate) as f64;
    let trace = |point: &Tracked| unripple_plot::Trace {
        label: point.hz.map_or_else(|| point.name.to_owned(), |hz| format!("{}, {hz} Hz", point.name)),
        values: point.displacement[from..].to_vec(),
        ink: Ink::Palette(usize::from(point.hz.is_some())),
    };
    let traces = Traces {
        x: Axis::new("Time (s)"),
        start: (from as f64 - origin) / setup.rate - repeated.period,
        step: 1.0 / setup.rate,
        traces: repeated.points.iter().map(trace).collect(),
        unit,
        multiplier,
        lane_mm: Some(12.0),
        ..Traces::default()
    };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![scene.map(grid, "", colours).into(), traces.into()],
        description: "Displacement of the film at a focus in E, and at five points against time".into(),
        ..Figure::default()
    }
}

/// Figure of the displacement around a focus of E alone, one of D alone, and one of both.
pub(super) fn closely(setup: &PaperSetup, repeated: &Repeated) -> Figure {
    let origin = setup.window + repeated.period;
    let panel = |after: f64, title: &str| {
        let (middle, reach) = (window_samples(origin + after, setup.rate), window_samples(CLOSE, setup.rate));
        let line = |point: &Tracked, label: &str, ink: Ink, width: f64| {
            let range = middle - reach..=middle + reach;
            Line {
                x: range.clone().map(|i| (i as f64 - middle as f64) / setup.rate).collect(),
                y: range.filter_map(|i| point.displacement.get(i).copied()).collect(),
                label: label.into(),
                ink,
                dash: Dash::Solid,
                width_pt: Some(width),
            }
        };
        let names: Vec<&str> = repeated.others().map(|p| p.name).collect();
        let once = |i: usize| if i == 0 { names.join(", ") } else { String::new() };
        let mut layers: Vec<Layer> = vec![Rule { at: 0.0, ..Rule::default() }.into()];
        layers.extend(
            repeated.others().enumerate().map(|(i, p)| line(p, &once(i), Ink::Rgb(Rgb::GREY), 0.6).into()),
        );
        let wide = |i: usize| [2.0, 0.9][i.min(1)];
        layers.extend(
            repeated
                .foci()
                .enumerate()
                .map(|(i, p)| line(p, p.name, Ink::Palette([5, 0][i.min(1)]), wide(i)).into()),
        );
        Plot {
            x: Axis::new("Time from focus (ms)").times(1e3),
            y: Axis::new("Displacement (µm)").times(1e6).from(-1.1 * AMPLITUDE).to(1.25 * AMPLITUDE),
            layers,
            legend: Legend::Above,
            title: title.into(),
            height_mm: Some(36.0),
        }
        .into()
    };
    Figure {
        width_mm: 178.0,
        columns: 3,
        panels: vec![panel(1.0 / RATES[0], "E alone"), panel(1.0 / RATES[1], "D alone"), panel(0.0, "both")],
        description: "Displacement at five points around single pulses".into(),
        ..Figure::default()
    }
}

/// Caption of [`overview`].
pub(super) fn overview_caption(setup: &PaperSetup, repeated: &Repeated) -> String {
    let after = repeated.shot.instant - setup.window - repeated.period;
    let rest: Vec<String> = repeated.points.iter().map(|p| format!("{} {}", p.name, place(p.at))).collect();
    format!(
        "Fig. 4. (a) Displacement at the extreme of the pulse in E when both are in focus, {:.2} ms {} that instant; squares are actuators. \
         (b) Displacement at five points over the last {:.2} s, zero being a focus of both. Points: {}.",
        after.abs() * 1e3,
        if after < 0.0 { "before" } else { "after" },
        LASTS - STEADY,
        rest.join(", ")
    )
}

/// Caption of [`closely`].
pub(super) fn closely_caption() -> String {
    "Single pulses of Fig. 4, closely: (a) a focus of E alone, (b) one of D alone, (c) one of both. Displacement is largest beside the focal \
     instant, where velocity is largest."
        .into()
}
