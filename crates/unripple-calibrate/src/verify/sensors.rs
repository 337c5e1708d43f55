//! Comparison of each sensor's recordings with the model at its actuator's place.

use super::checker::Projected;
use super::judge::Bench;
use super::verdict::Doubted;
use unripple_core::{ActuatorKind, Point};

/// Smallest correlation of a sensor's responses with the model at its place, at which the sensor is not
/// doubted.
const UNLIKE: f64 = 0.5;

/// Doubts about single sensors.
pub(super) fn doubts(bench: &Bench) -> Vec<Doubted> {
    let quick = bench.quick;
    let late = quick.fitted.late.value;
    let port = |n: usize| {
        let [x, y] = quick.fitted.actuators[n].at.map(|c| c.value);
        Point::new(x, y)
    };
    let name = |n: usize| bench.surface.actuators[quick.actuators[n]].name.clone();
    // A piezoelectric patch senses the bending of the sheet, not the velocity of its place.
    let listens =
        |n: usize| !matches!(bench.surface.actuators[quick.actuators[n]].kind, ActuatorKind::Piezo { .. });
    let heard: Vec<Projected> = quick.sensed.iter().map(|row| bench.sheet.checker.project(row)).collect();
    let mut doubts = Vec::new();
    for (n, row) in heard.iter().enumerate().filter(|(n, _)| listens(*n)) {
        let own = bench.sheet.checker.at(row, port(n), late);
        if own.likeness > UNLIKE {
            continue;
        }
        let why = match bench.sheet.anywhere(row, late) {
            _ if own.likeness < -UNLIKE => "is reversed".to_owned(),
            Some(spot) if spot.found.unexplained() < bench.limit() => {
                let near = (0..heard.len()).find(|m| port(*m).distance(spot.at) < 0.2 * bench.wave);
                match near {
                    Some(other) => format!("records motion at `{}`: are two sensors swapped?", name(other)),
                    None => format!("records motion at {}: is it wired to its own channel?", spot.at),
                }
            }
            _ => "records what the model explains nowhere: is it wired to its own channel?".to_owned(),
        };
        doubts.push(Doubted { what: format!("sensor of `{}` {why}", name(n)), points: Vec::new() });
    }
    doubts
}
