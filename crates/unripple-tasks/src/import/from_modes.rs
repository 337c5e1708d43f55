//! Responses of modes that were identified elsewhere, at their nodes.

use super::assembled::{Assembled, Rows};
use super::measured::Who;
use super::modal::{Mode, Modes, Synthesis};
use super::on_surface::{By, key, limited, on_sheet, resolved};
use super::units::drive_per_reference;
use super::{Ask, Per};
use crate::TaskError;
use std::collections::BTreeSet;
use unripple::act::unit;
use unripple::core::{Point, Surface, window_samples};
use unripple_calibrate::measure::MOST_KEPT;

/// Amplitude that modes have decayed to at the end, as a natural logarithm: ln 1000, 60 dB.
const DECAYED: f64 = 6.907_755_278_982_137;

/// Responses of modes at their nodes to actuators at some of them.
///
/// # Errors
/// [`TaskError::Ask`] of an actuator without a node, or a length that has to be said; [`TaskError::Input`] of nodes off the sheet and of modes
/// that are all beyond the band.
pub(super) fn modal(
    ask: &Ask,
    surface: &Surface,
    found: Modes,
    mut left_out: Vec<String>,
) -> Result<Assembled, TaskError> {
    let rate = surface.emission.rate;
    let [low, high] = ask.band_hz.unwrap_or([0.0, 0.5 * rate]);
    let count = found.modes.len();
    let carried = |mode: &Mode| (low..=high).contains(&mode.hz()) && mode.hz() < 0.5 * rate;
    let modes: Vec<Mode> = found.modes.into_iter().filter(carried).collect();
    let top = modes.iter().map(Mode::hz).fold(0.0, f64::max);
    if modes.is_empty() {
        let expected = format!("modes from {low} to {high} Hz");
        return Err(TaskError::Input(format!("{}: expected {expected}, found none", found.from)));
    }
    if modes.len() < count {
        left_out.push(format!(
            "{}: {} modes beyond the band or half the sample rate",
            found.from,
            count - modes.len()
        ));
    }
    let drives = drives(ask, surface, &found.names, &found.places, &found.from)?;
    let samples = window_samples(duration(ask, &modes)?, rate) + 1;
    let (points, nodes) = distinct(&found.places);
    let (most, least) = (surface.emission.band[1].min(high).min(top), surface.emission.band[0].max(low));
    let conditions = limited(surface, [least, most])?;
    let kept = modes.len();
    let synthesis = Synthesis::new(modes, drives, nodes, 1.0 / rate, samples);
    // A library that is begun before this is known would be in the way of the next one.
    if let Some((node, most)) = synthesis.beyond_single() {
        return Err(TaskError::Input(format!(
            "{}: node {}: expected modes whose responses single precision holds, found up to {most:e}",
            found.from, found.names[node]
        )));
    }
    let told = |text| BTreeSet::from([text]);
    Ok(Assembled {
        points,
        samples,
        conditions,
        kinds: told("modes"),
        quantities: told("displacement"),
        per: told("N"),
        lowest: None,
        modes: Some(kept),
        left_out,
        rows: Rows::Modal(synthesis),
    })
}

/// The node of each actuator and the factor of its responses; `None` of those that are left out.
fn drives(
    ask: &Ask,
    surface: &Surface,
    names: &[String],
    places: &[Point],
    from: &str,
) -> Result<Vec<Option<(usize, f64)>>, TaskError> {
    // The surest node of each actuator, with how it is known and its distance.
    let mut surest: Vec<Option<(By, f64, usize)>> = vec![None; surface.actuators.len()];
    for (node, (name, at)) in names.iter().zip(places).enumerate() {
        on_sheet(surface, *at, &format!("{from}: node {name}"))?;
        // Most nodes are at no actuator.
        let who = Who { names: vec![name.clone()], at: Some(*at) };
        let Ok((actuator, by)) = resolved(ask, surface, &who, from) else { continue };
        let distance = surface.actuators[actuator].at.distance(*at);
        if surest[actuator].is_none_or(|(other, away, _)| by < other || (by == other && distance < away)) {
            surest[actuator] = Some((by, distance, node));
        }
    }
    let mut drives = Vec::with_capacity(surest.len());
    for (node, actuator) in surest.iter().zip(&surface.actuators) {
        drives.push(match node {
            _ if ask.without.contains(&actuator.name) => None,
            Some((_, _, node)) => {
                let scale = 1.0 / drive_per_reference(ask, Per::Newton, unit(&actuator.kind), from)?;
                Some((*node, scale))
            }
            None => {
                let expected = "a node for each actuator, by its place or by `actuator_names`, or the names of those without";
                let found = format!("none for {} at {} in {}", actuator.name, actuator.at, from);
                return Err(TaskError::ask("without, actuator_names", expected, found));
            }
        });
    }
    Ok(drives)
}

/// Different places, and the first node at each.
fn distinct(places: &[Point]) -> (Vec<Point>, Vec<usize>) {
    let mut known = BTreeSet::new();
    places.iter().enumerate().filter(|(_, at)| known.insert(key(**at))).map(|(node, at)| (*at, node)).unzip()
}

/// How long responses of modes are, in s: what the request says, or until the slowest mode has decayed.
fn duration(ask: &Ask, modes: &[Mode]) -> Result<f64, TaskError> {
    if let Some(length) = ask.length_s {
        return Ok(length);
    }
    let slowest = modes.iter().map(|mode| -mode.eigenvalue.re).fold(f64::INFINITY, f64::min);
    let seconds = DECAYED / slowest;
    match seconds <= MOST_KEPT {
        true => Ok(seconds),
        false => {
            let found = format!("none, and the slowest mode takes {seconds} s to decay by 60 dB");
            Err(TaskError::ask("length_s", "the length of the responses", found))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All orders of the first numbers.
    fn orders(count: usize) -> Vec<Vec<usize>> {
        let mut orders: Vec<Vec<usize>> = vec![Vec::new()];
        for next in 0..count {
            let longer = orders.iter().flat_map(|order| {
                (0..=order.len()).map(move |at| [&order[..at], &[next], &order[at..]].concat())
            });
            orders = longer.collect();
        }
        orders
    }

    #[test]
    fn the_surest_node_of_an_actuator_drives_it_in_any_order() {
        let surface = Ask::default().surface.load().unwrap();
        let ask = Ask {
            actuator_names: vec![("a1".into(), "3".into())],
            without: surface.actuators[3..].iter().map(|actuator| actuator.name.clone()).collect(),
            ..Ask::default()
        };
        let at = |actuator: usize| surface.actuators[actuator].at;
        // Towards the middle, so that all are on the sheet.
        let off = |actuator: usize| {
            let (at, middle) = (at(actuator), Point::new(0.06, 0.09));
            let share = 0.3e-3 / at.distance(middle);
            Point::new(at.x + share * (middle.x - at.x), at.y + share * (middle.y - at.y))
        };
        let nodes = [
            ("3", Point::new(0.05, 0.08)),
            ("9", at(0)),
            ("8", off(1)),
            ("7", at(1)),
            ("a3", Point::new(0.05, 0.07)),
            ("6", at(2)),
        ];
        for order in orders(nodes.len()) {
            let names: Vec<String> = order.iter().map(|n| nodes[*n].0.to_owned()).collect();
            let places: Vec<Point> = order.iter().map(|n| nodes[*n].1).collect();
            let drives = drives(&ask, &surface, &names, &places, "modes.csv").unwrap();
            let driven: Vec<&str> = drives.iter().flatten().map(|(node, _)| names[*node].as_str()).collect();
            assert_eq!(driven, ["3", "7", "a3"], "{names:?}");
        }
    }
}
