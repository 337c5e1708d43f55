//! Velocity and displacement at the targets against time.

use unripple::field::{TargetFigures, Trace};
use unripple_plot::{Axis, Figure, Ink, Rule, Traces, prefixed};

/// Most targets whose traces are drawn: the palette has seven colours, and more lines cannot be followed.
const MOST: usize = 8;

/// Velocity and displacement of the targets against time; for a target of several points, of its first point.
pub fn traces(targets: &[TargetFigures], traces: &[Trace], rate: f64) -> Figure {
    let units = |pick: fn(&Trace) -> &Vec<f64>, unit: &str| {
        let largest = traces.iter().flat_map(pick).fold(0.0, |m: f64, v| m.max(v.abs()));
        prefixed(largest, unit)
    };
    let panel = |pick: fn(&Trace) -> &Vec<f64>, title: &str, (multiplier, unit): (f64, String)| {
        let named = traces.iter().zip(targets).take(MOST).enumerate();
        let lines = named.map(|(i, (trace, target))| unripple_plot::Trace {
            label: format!("({:.0}, {:.0})", target.at_m[0] * 1e3, target.at_m[1] * 1e3),
            values: pick(trace).clone(),
            ink: Ink::Palette(i),
        });
        Traces {
            x: Axis::new("Time (ms)").times(1e3),
            step: 1.0 / rate,
            traces: lines.collect(),
            unit,
            multiplier,
            rules: targets.first().map(|t| Rule { at: t.instant_s, ..Rule::default() }).into_iter().collect(),
            lane_mm: (traces.len() < 3).then_some(20.0),
            title: title.into(),
            ..Traces::default()
        }
    };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![
            panel(|t| &t.velocity, "velocity at the targets", units(|t| &t.velocity, "m/s")).into(),
            panel(|t| &t.displacement, "displacement at the targets", units(|t| &t.displacement, "m")).into(),
        ],
        description: "Velocity and displacement at the targets against time".into(),
        ..Figure::default()
    }
}
