//! Panels of both halves of Fig. 1: fields side by side, and curves against time.

use crate::reproduce::fields::largest;
use unripple::field::{self, Snapshot};
use unripple_plot::{Axis, Colours, Ink, Legend, Line, Plot, Shot, Strip, prefixed};
use unripple_tasks::figures::{Scene, drawn};

/// Panel of velocity fields side by side, whose colours saturate at `high` (m/s).
pub(super) fn strip(
    scene: &Scene,
    cells: &field::Grid,
    snapshots: &[Snapshot],
    high: f64,
    caption: impl Fn(f64) -> String,
) -> Strip {
    let (multiplier, unit) = prefixed(high, "m/s");
    let shot = |s: &Snapshot| Shot { grid: drawn(cells, &s.velocity), caption: caption(s.instant) };
    Strip {
        shots: snapshots.iter().map(shot).collect(),
        outline: scene.outline.clone(),
        markers: scene.markers.clone(),
        colours: Colours {
            title: format!("Velocity ({unit})"),
            multiplier,
            high: Some(high),
            ..Colours::default()
        },
        ..Strip::default()
    }
}

/// A curve of samples against time, with a height for a wide, low panel.
pub(super) fn curve(values: &[f64], rate: f64, unit: &str, name: &str) -> Plot {
    let (multiplier, unit) = prefixed(largest(values), unit);
    let x = (0..values.len()).map(|i| i as f64 / rate).collect();
    let line = Line { x, y: values.to_vec(), ink: Ink::Palette(0), width_pt: Some(0.6), ..Line::default() };
    Plot {
        x: Axis::new("Time (ms)").times(1e3),
        y: Axis::new(format!("{name} ({unit})")).times(multiplier),
        layers: vec![line.into()],
        legend: Legend::None,
        height_mm: Some(24.0),
        ..Plot::default()
    }
}
