//! The figure of a drive: one lane per actuator.

use unripple::core::Drive;
use unripple_plot::{Axis, Figure, Trace, Traces, prefixed};

/// Largest number of channels drawn in one figure: more lanes are too low to be read.
const MOST: usize = 16;

/// Figure of a drive (in `unit`) against time, one lane per actuator, for at most the first sixteen
/// actuators.
pub fn channels(drive: &Drive, unit: &str) -> Figure {
    let shown = drive.channels().len().min(MOST);
    let traces = drive.names().iter().zip(drive.channels()).take(shown);
    let (multiplier, unit) = prefixed(drive.peak(), unit);
    let title = match drive.channels().len() {
        all if all > shown => format!("drive, first {shown} of {all} actuators"),
        _ => "drive".to_owned(),
    };
    Figure {
        width_mm: 120.0,
        panels: vec![
            Traces {
                x: Axis::new("Time (ms)").times(1e3),
                step: 1.0 / drive.rate(),
                traces: traces.map(|(name, values)| Trace::new(name, values.clone())).collect(),
                unit,
                multiplier,
                title,
                ..Traces::default()
            }
            .into(),
        ],
        description: "What each actuator is sent, against time".into(),
        ..Figure::default()
    }
}
