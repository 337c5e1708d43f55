//! Responses at the surface's points from its actuators, from what was read: names and places joined to the surface, all of one length.

use super::assembled::{Assembled, Rows};
use super::found::Found;
use super::measured::Measured;
use super::on_surface::{key, limited, on_sheet, resolved};
use super::spectrum::Converter;
use super::units::settle;
use super::{Ask, Quantity, from_modes};
use crate::{Progress, TaskError, go_on};
use std::collections::{BTreeMap, BTreeSet};
use unripple::act::unit;
use unripple::core::{Point, Surface, window_samples};

/// Most points that a message names.
const LISTED: usize = 3;

/// Joins what was read to the surface.
///
/// # Errors
/// [`TaskError::Ask`] of names that no response has; [`TaskError::Input`] of an actuator or a place that is not the surface's, of responses
/// that are there twice, not there, or of other lengths;
/// those of [`settle`] and [`Converter::convert`]; [`TaskError::Cancelled`].
pub(super) fn assembled(
    ask: &Ask,
    surface: &Surface,
    mut found: Found,
    progress: &mut dyn Progress,
) -> Result<Assembled, TaskError> {
    names_are_used(ask, &found)?;
    match (found.responses.is_empty(), found.modes.pop()) {
        (false, None) => responses(ask, surface, found, progress),
        (true, Some(modes)) if found.modes.is_empty() => {
            from_modes::modal(ask, surface, modes, found.left_out)
        }
        (true, Some(modes)) => {
            Err(TaskError::Input(format!("{}: expected modes of one file, found several", modes.from)))
        }
        (false, Some(modes)) => Err(TaskError::Input(format!(
            "{}: expected responses or modes, found both; import them one after the other",
            modes.from
        ))),
        (true, None) => {
            let left = found.left_out.join("; ");
            Err(TaskError::Input(format!("expected responses or modes, found none ({left})")))
        }
    }
}

/// Refuses names of actuators that no response and no node has.
fn names_are_used(ask: &Ask, found: &Found) -> Result<(), TaskError> {
    let is_used = |other: &String| {
        found.responses.iter().any(|measured| measured.who.names.contains(other))
            || found.modes.iter().any(|modes| modes.names.contains(other))
    };
    match ask.actuator_names.iter().find(|(_, other)| !is_used(other)) {
        Some((name, other)) => {
            let expected = format!("a name or node in the files for {name}");
            Err(TaskError::ask("actuator_names", expected, format!("`{other}`, which no response is to")))
        }
        None => Ok(()),
    }
}

/// A response, and where it is from.
type Response = (Vec<f64>, String);

/// Responses by point and actuator, as they are joined.
struct Joining<'a> {
    ask: &'a Ask,
    surface: &'a Surface,
    converter: Converter,
    /// Index of each point by its place.
    index: BTreeMap<[i64; 2], usize>,
    points: Vec<Point>,
    /// The response of each point to each actuator.
    rows: Vec<Vec<Option<Response>>>,
    /// Length of the responses, and where the first of them is from.
    samples: Option<(usize, String)>,
    band: [f64; 2],
    told: [BTreeSet<&'static str>; 3],
    lowest: Option<f64>,
}

fn responses(
    ask: &Ask,
    surface: &Surface,
    found: Found,
    progress: &mut dyn Progress,
) -> Result<Assembled, TaskError> {
    let mut joining = Joining {
        ask,
        surface,
        converter: Converter::new(surface.emission.rate, ask.band_hz),
        index: BTreeMap::new(),
        points: Vec::new(),
        rows: Vec::new(),
        samples: None,
        band: surface.emission.band,
        told: [const { BTreeSet::new() }; 3],
        lowest: None,
    };
    let count = found.responses.len();
    for (n, measured) in found.responses.into_iter().enumerate() {
        go_on(progress)?;
        joining.join(measured)?;
        progress.done((n + 1) as f64 / count as f64);
    }
    joining.whole(found.left_out)
}

impl Joining<'_> {
    fn join(&mut self, measured: Measured) -> Result<(), TaskError> {
        let Measured { from, who, at, signal, sign, says } = measured;
        let (actuator, _) = resolved(self.ask, self.surface, &who, &from)?;
        let name = &self.surface.actuators[actuator].name;
        if self.ask.without.contains(name) {
            return Ok(());
        }
        let point = self.point(at, &from)?;
        if let Some((_, other)) = &self.rows[point][actuator] {
            return Err(TaskError::Input(format!(
                "{from}: expected one response of {at} to {name}, found another in {other}"
            )));
        }
        let settled = settle(self.ask, &says, &signal, unit(&self.surface.actuators[actuator].kind), &from)?;
        let mut converted = self.converter.convert(&signal, &settled, sign, &from)?;
        if let Some(value) = converted.values.iter().find(|value| !(**value as f32).is_finite()) {
            return Err(TaskError::Input(format!(
                "{from}: expected values that single precision holds, found {value:e}"
            )));
        }
        if let Some(length) = self.ask.length_s {
            converted.values.resize(window_samples(length, self.surface.emission.rate) + 1, 0.0);
        }
        let length = converted.values.len();
        match &self.samples {
            None => self.samples = Some((length, from.clone())),
            Some((samples, _)) if *samples == length => {}
            Some((samples, first)) => {
                return Err(TaskError::Input(format!(
                    "{from}: expected {samples} samples, as in {first}, found {length} (`length_s` makes all of one length)"
                )));
            }
        }
        if settled.quantity == Quantity::Acceleration {
            self.lowest = Some(self.lowest.map_or(converted.band[0], |lowest| lowest.max(converted.band[0])));
        }
        self.band = [self.band[0].max(converted.band[0]), self.band[1].min(converted.band[1])];
        let [kinds, quantities, per] = &mut self.told;
        kinds.insert(settled.kind.name());
        quantities.insert(settled.quantity.name());
        per.insert(settled.per.symbol());
        self.rows[point][actuator] = Some((converted.values, from));
        Ok(())
    }

    /// Index of the point at a place, which is added if it is new.
    fn point(&mut self, at: Point, from: &str) -> Result<usize, TaskError> {
        on_sheet(self.surface, at, from)?;
        let next = self.points.len();
        let index = *self.index.entry(key(at)).or_insert(next);
        if index == next {
            self.points.push(at);
            self.rows.push(vec![None; self.surface.actuators.len()]);
        }
        Ok(index)
    }

    /// All responses, without points that lack some.
    fn whole(self, mut left_out: Vec<String>) -> Result<Assembled, TaskError> {
        let (surface, without) = (self.surface, &self.ask.without);
        let is_needed = |actuator: usize| !without.contains(&surface.actuators[actuator].name);
        let needed: Vec<usize> = (0..surface.actuators.len()).filter(|a| is_needed(*a)).collect();
        let unmeasured: Vec<&str> = needed
            .iter()
            .filter(|a| self.rows.iter().all(|row| row[**a].is_none()))
            .map(|a| surface.actuators[*a].name.as_str())
            .collect();
        if !unmeasured.is_empty() {
            let found = format!("none of {}", unmeasured.join(", "));
            let expected = "responses to all actuators, or the names of those that were not measured";
            return Err(TaskError::ask("without", expected, found));
        }
        let samples = self.samples.map_or(0, |(samples, _)| samples);
        let (mut points, mut rows, mut lacking) = (Vec::new(), Vec::new(), Vec::new());
        for (at, row) in self.points.into_iter().zip(self.rows) {
            if needed.iter().any(|actuator| row[*actuator].is_none()) {
                lacking.push(at.to_string());
                continue;
            }
            let each = row.into_iter().flat_map(|response| match response {
                Some((values, _)) => values.into_iter().map(|value| value as f32).collect::<Vec<f32>>(),
                None => vec![0.0; samples],
            });
            points.push(at);
            rows.push(each.collect());
        }
        if points.is_empty() {
            return Err(TaskError::Input(format!(
                "expected points with responses to all actuators, found {} with some of them",
                lacking.len()
            )));
        }
        if !lacking.is_empty() {
            let named = lacking[..lacking.len().min(LISTED)].join(", ");
            left_out.push(format!("{} points without responses to all actuators: {named}", lacking.len()));
        }
        let conditions = limited(surface, self.band)?;
        let [kinds, quantities, per] = self.told;
        let (rows, lowest) = (Rows::Stored(rows), self.lowest);
        Ok(Assembled {
            points,
            rows,
            samples,
            conditions,
            kinds,
            quantities,
            per,
            lowest,
            modes: None,
            left_out,
        })
    }
}
