//! Velocity and displacement at the targets against time.

use super::When;
use unripple::field::{TargetFigures, Trace};
use unripple_plot::{Axis, Figure, Ink, Rule, Traces, prefixed};

/// Largest number of targets whose traces are drawn: the palette has seven colours, and more lines cannot be followed.
const MOST: usize = 8;

/// Figure of velocity and displacement at the targets against time, sampled at `rate` (Hz), with the
/// instant of the first target as a dashed line. For a target of several points, the traces are those of
/// its first point.
pub fn traces(targets: &[TargetFigures], traces: &[Trace], rate: f64, when: When) -> Figure {
    let units = |pick: fn(&Trace) -> &Vec<f64>, unit: &str| {
        let largest = traces.iter().flat_map(pick).fold(0.0, |m: f64, v| m.max(v.abs()));
        prefixed(largest, unit)
    };
    let instant = targets.first().map(|target| Rule {
        at: target.instant_s,
        label: when.words(targets).to_owned(),
        ..Rule::default()
    });
    let at = place(targets);
    let panel = |pick: fn(&Trace) -> &Vec<f64>, quantity: &str, (multiplier, unit): (f64, String)| {
        let named = traces.iter().zip(targets).take(MOST).enumerate();
        let lines = named.map(|(i, (trace, target))| unripple_plot::Trace {
            label: name(target),
            values: pick(trace).clone(),
            ink: Ink::Palette(i),
        });
        Traces {
            x: Axis::new("Time (ms)").times(1e3),
            step: 1.0 / rate,
            traces: lines.collect(),
            unit,
            multiplier,
            rules: instant.clone().into_iter().collect(),
            lane_mm: (traces.len() < 3).then_some(20.0),
            title: format!("{quantity} {at}"),
            ..Traces::default()
        }
    };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![
            panel(|t| &t.velocity, "velocity", units(|t| &t.velocity, "m/s")).into(),
            panel(|t| &t.displacement, "displacement", units(|t| &t.displacement, "m")).into(),
        ],
        description: "Velocity and displacement at the targets against time".into(),
        ..Figure::default()
    }
}

/// Text on where the motion that the traces show takes place.
fn place(targets: &[TargetFigures]) -> String {
    let target = if targets.len() == 1 { "at the target" } else { "at the targets" };
    let shapes = targets.iter().any(|target| target.points > 1);
    format!("{target}{}", if shapes { ", of a shape at its first point" } else { "" })
}

/// Label of a target's trace: its place, to a tenth of a millimetre.
fn name(target: &TargetFigures) -> String {
    let [x, y] = target.at_m.map(|m| (m * 1e4).round() / 10.0);
    let shape = if target.points > 1 { "shape " } else { "" };
    format!("{shape}({x}, {y}) mm")
}
