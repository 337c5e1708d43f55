//! `.haptic`, data model 1: one amplitude envelope with points that may be emphasised, one frequency envelope.

use super::node::Node;
use super::notes::Notes;
use super::pitch::pitch;
use crate::StoreError;
use unripple_effects::limits::{SHARE, TIME};

/// The one major version of the format that is read: another may mean something else by the same keys.
const MAJOR: f64 = 1.0;

pub(super) fn read(root: &Node, notes: &mut Notes) -> Result<(), StoreError> {
    root.require("version", "an object")?.number_of("major", [MAJOR, MAJOR])?;
    let signals = root.require("signals", "an object")?;
    let envelopes = signals.require("continuous", "an object")?.require("envelopes", "an object")?;
    let items = envelopes.items("amplitude")?;
    let amplitude = points(&items, "amplitude", |a| a)?;
    let frequency = match envelopes.get("frequency") {
        Some(_) => points(&envelopes.items("frequency")?, "frequency", pitch)?,
        None => Vec::new(),
    };
    // Files without a pitch leave it to the device: the middle.
    let frequency = if frequency.is_empty() { vec![(0.0, pitch(0.5))] } else { frequency };
    for (item, (time, _)) in items.iter().zip(&amplitude) {
        if let Some(emphasis) = item.get("emphasis") {
            emphasis.number_of("frequency", SHARE)?;
            notes.pulse(*time, emphasis.number_of("amplitude", SHARE)?)?;
        }
    }
    if amplitude.last().is_some_and(|(end, _)| *end > 0.0) {
        notes.wave(0.0, amplitude, frequency)?;
    }
    Ok(())
}

fn points(items: &[Node], value: &str, unit: fn(f64) -> f64) -> Result<Vec<(f64, f64)>, StoreError> {
    let point = |item: &Node| Ok((item.number_of("time", TIME)?, unit(item.number_of(value, SHARE)?)));
    let points = items.iter().map(point).collect::<Result<Vec<_>, StoreError>>()?;
    Node::ascending(items, "time", &points)?;
    Ok(points)
}
