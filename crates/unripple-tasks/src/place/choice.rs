//! What a choice among the actuators of a library works on: the actuators, and the points that are targets.

use super::Ask;
use super::ask::TESTED;
use super::importance::Importance;
use super::numbers::numbers;
use super::setting::{footprint, named_targets, of_targets, reach, target_rules, without_weight};
use crate::TaskError;
use crate::areas::{from_rim, polygons};
use crate::numbers::above_zero;
use crate::source::Stored;
use crate::window::carries;
use unripple::act::{Note, chosen_window, lasting};
use unripple::core::{Actuator, Point, Responses, SampledResponses, Surface, window_samples};
use unripple_placement::{Aim, Rules, spread};

/// Distance in m within which a point counts as being at an actuator: there the field is more than a sum of free waves.
const SAME: f64 = 1e-6;

/// Largest distance of a target from the nearest point of the library, over the shortest wavelength: as for a focus.
const NEAR: f64 = 0.25;

/// What a choice works on.
pub(super) struct Choice {
    /// The surface that the library describes.
    pub surface: Surface,
    /// The responses of the library.
    pub responses: SampledResponses,
    /// The points of the library, in words.
    pub told: String,
    /// Indices of all actuators that move the surface: those that are kept, those to choose from, all others.
    pub ports: Vec<usize>,
    /// Number of kept actuators.
    pub kept: usize,
    /// Number of actuators to choose from.
    pub places: usize,
    /// The targets that actuators are chosen for.
    pub trained: Vec<Aim>,
    /// The targets on which choices are evaluated.
    pub tested: Vec<Aim>,
    /// Window T, in s.
    pub window: f64,
    /// Reason for the default window.
    pub window_why: Option<String>,
    /// Notes on the library and the targets.
    pub notes: Vec<Note>,
}

/// Names of the fields that need a model, and whether the request sets them.
pub(super) fn needing_modes(ask: &Ask) -> [(&'static str, bool); 7] {
    [
        ("like", ask.like.is_some()),
        ("places_m", !ask.places_m.is_empty()),
        ("pitch_m", ask.pitch_m.is_some()),
        ("mounting_m", ask.mounting_m != 0.0),
        ("tension", ask.tension != 0.0),
        ("method", !ask.methods.is_empty()),
        ("by", ask.by.is_some()),
    ]
}

impl Choice {
    /// The choice that a request asks for among the actuators of a library, after a check of its values.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of numbers and names that make no sense, or of targets far from all points of the library.
    pub fn of(ask: &Ask, surface: Surface, stored: Stored) -> Result<Self, TaskError> {
        numbers(ask)?;
        let Stored { responses, told, mut notes, .. } = stored;
        let (ports, kept, places) = actuators(ask, &responses, &surface.actuators)?;
        let importance = Importance::of(ask)?;
        let (trained, tested) = match ask.points_m.is_empty() {
            true => spread_targets(ask, &importance, &responses)?,
            false => {
                let (aims, nearby) = nearest(ask, &responses)?;
                notes.extend(nearby);
                (aims.clone(), aims)
            }
        };
        let candidates = &ports[..kept + places];
        let (window, window_why) = window(ask, &surface, &responses, candidates, kept)?;
        notes.extend(of_targets(&responses.conditions, ask.points_m.is_empty()));
        let text = "responses are those of the library, with all actuators that loaded the surface when it was made: those that are taken \
                    off no longer do, others that are mounted do, so measure again with the actuators that are kept";
        notes.push(Note { topic: "loads", text: text.into() });
        Ok(Self { surface, responses, told, ports, kept, places, trained, tested, window, window_why, notes })
    }

    /// The places of the kept actuators and of those to choose from.
    pub fn at(&self) -> Vec<Point> {
        self.ports[..self.kept + self.places].iter().map(|port| self.responses.ports[*port].at).collect()
    }

    /// Least distance between two actuators, in m: by default that at which two of the smallest ones would touch, since those that are
    /// mounted have room.
    pub fn apart(&self, ask: &Ask) -> f64 {
        let least = self.surface.actuators.iter().map(reach).reduce(f64::min);
        ask.apart_m.unwrap_or(2.0 * least.unwrap_or(0.0))
    }
}

/// Indices of the actuators that move the surface, the kept ones first, then those to choose from; the number of both. `mounted` are those
/// of the surface, whose footprints count; of others the places alone do.
fn actuators(
    ask: &Ask,
    responses: &SampledResponses,
    mounted: &[Actuator],
) -> Result<(Vec<usize>, usize, usize), TaskError> {
    let outline = &responses.conditions.outline;
    let name = |port: usize| responses.ports[port].name.as_str();
    // Responses of dead actuators are zero.
    let moves = |port: &usize| {
        (0..responses.points.len())
            .any(|point| responses.response(*port, point).iter().any(|value| *value != 0.0))
    };
    let alive: Vec<usize> = (0..responses.ports.len()).filter(moves).collect();
    if let Some(unknown) = ask.keep.iter().find(|kept| !alive.iter().any(|port| name(*port) == *kept)) {
        let names = alive.iter().map(|port| name(*port)).collect::<Vec<_>>().join(", ");
        return Err(TaskError::ask("keep", format!("one of {names}"), format!("`{unknown}`")));
    }
    let rules = Rules {
        from_rim: from_rim(ask.rim_m)?,
        within: polygons("within_m", &ask.within_m)?,
        keep_out: polygons("keep_out_m", &ask.keep_out_m)?,
        ..Rules::default()
    };
    // What is mounted fits on the sheet.
    let kept = |actuator: &Actuator| rules.keeps_out(footprint(actuator), actuator.at);
    let keeps_out = |port: usize| mounted.get(port).is_none_or(kept);
    // An actuator may be at the very rim.
    let anywhere = ask.rim_m.is_none() && ask.within_m.is_empty() && ask.keep_out_m.is_empty();
    let allowed =
        |port: &usize| anywhere || rules.allow(outline, responses.ports[*port].at) && keeps_out(*port);
    let stays = |port: &usize| ask.keep_all || ask.keep.iter().any(|kept| kept == name(*port));
    let (mut all, others): (Vec<usize>, Vec<usize>) = alive.into_iter().partition(stays);
    let (free, beyond): (Vec<usize>, Vec<usize>) = others.into_iter().partition(allowed);
    let (kept, places) = (all.len(), free.len());
    if places < ask.count {
        let expected = format!("at most {places}, the actuators of the library to choose from");
        return Err(TaskError::ask("count", expected, ask.count));
    }
    all.extend(free);
    all.extend(beyond);
    Ok((all, kept, places))
}

/// The points of the library that are nearest to the targets of a request, and notes on those that are not the same.
fn nearest(ask: &Ask, responses: &SampledResponses) -> Result<(Vec<Aim>, Vec<Note>), TaskError> {
    let most = NEAR * responses.conditions.lambda_min;
    let mut notes = Vec::new();
    let mut aims = named_targets(ask, &responses.conditions.outline)?;
    for aim in &mut aims {
        let asked = aim.at;
        // A library without any point is refused when it is opened.
        let stored = responses.nearest(asked).map_or(asked, |point| responses.points[point]);
        let apart = asked.distance(stored);
        if apart > most {
            let expected = format!(
                "points at most {:.2} mm, a quarter of the shortest wavelength, from one of the library",
                1e3 * most
            );
            let found = format!("{asked}, {:.2} mm from the nearest, {stored}", 1e3 * apart);
            return Err(TaskError::ask("points_m", expected, found));
        }
        if apart > 1e-9 {
            let text = format!(
                "{stored} is used for {asked}, {:.2} mm away: it is the nearest finished point",
                1e3 * apart
            );
            notes.push(Note { topic: "library", text });
        }
        aim.at = stored;
    }
    Ok((aims, notes))
}

/// Points of the library spread evenly over the surface: those that actuators are chosen for, and others on which choices are evaluated.
fn spread_targets(
    ask: &Ask,
    importance: &Importance,
    responses: &SampledResponses,
) -> Result<(Vec<Aim>, Vec<Aim>), TaskError> {
    let conditions = &responses.conditions;
    let rules = target_rules(ask, conditions.lambda_min);
    let free = |at: &Point| responses.ports.iter().all(|port| port.at.distance(*at) > SAME);
    let may = |at: &&Point| rules.allow(&conditions.outline, **at) && free(at);
    let mut left: Vec<Point> = responses.points.iter().filter(may).copied().collect();
    let room = left.len();
    left.retain(|at| importance.at(*at) > 0.0);
    let count = left.len().min((1 + TESTED) * ask.targets);
    let mut aims = Vec::with_capacity(count);
    for even in spread(&conditions.outline, &rules, 0, count) {
        let apart = |i: &usize| left[*i].distance(even);
        if let Some(next) = (0..left.len()).min_by(|a, b| apart(a).total_cmp(&apart(b))) {
            let at = left.swap_remove(next);
            aims.push(Aim { at, weight: importance.at(at) });
        }
    }
    if aims.len() < 2 {
        if room >= 2 {
            return Err(without_weight(format!("{} of {room} points of the library", aims.len())));
        }
        let expected = "at least two points of the library that may be targets";
        let found = format!("{} at least a shortest wavelength from the rim, or in the areas", aims.len());
        return Err(TaskError::ask("points_m, targets_within_m", expected, found));
    }
    // Where points are few, half of them are left for the evaluation.
    let tested = aims.split_off(ask.targets.min(aims.len() / 2));
    Ok((aims, tested))
}

/// The window in s, and why, where it is not that of the request: the one recommended for the kept actuators and as many of the
/// `candidates` as are chosen, if the responses are as long.
fn window(
    ask: &Ask,
    surface: &Surface,
    responses: &SampledResponses,
    candidates: &[usize],
    kept: usize,
) -> Result<(f64, Option<String>), TaskError> {
    let conditions = &responses.conditions;
    let stored = Responses::Sampled(responses.clone());
    if let Some(window) = ask.window_s {
        let window = above_zero(window, "window_s", "s")?;
        carries(conditions, window, "window_s")?;
        if window_samples(window, conditions.rate) >= responses.samples() {
            let most = format!("at most {:.3} ms, the length of the responses", 1e3 * lasting(&stored));
            return Err(TaskError::ask("window_s", most, format!("{} ms", 1e3 * window)));
        }
        return Ok((window, None));
    }
    let (stay, free) = candidates.split_at(kept);
    let step = free.len() as f64 / ask.count as f64;
    let evenly = (0..ask.count).map(|i| free[((i as f64 + 0.5) * step) as usize]);
    let actuators =
        stay.iter().copied().chain(evenly).filter_map(|port| surface.actuators.get(port).cloned());
    let thinned = Surface { actuators: actuators.collect(), ..surface.clone() };
    let chosen = chosen_window(&thinned, &stored);
    carries(conditions, chosen.seconds, "window_s")?;
    Ok((chosen.seconds, Some(chosen.why)))
}

#[cfg(test)]
mod tests {
    use super::super::ask::ImportantAsk;
    use super::*;
    use unripple::core::{ActuatorKind, Conditions, Outline, Port, Shape};

    /// Responses of `alive` actuators, and of a dead one before them, on a grid of points 10 mm apart.
    fn responses(alive: usize) -> SampledResponses {
        let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
        let conditions = Conditions { rate: 1000.0, band: [0.0, 100.0], lambda_min: 0.0196, outline };
        let at = |i: usize| Point::new(0.01 + 0.03 * i as f64, 0.01);
        let ports: Vec<Port> = (0..=alive).map(|i| Port { name: format!("a{i}"), at: at(i) }).collect();
        let grid = (0..19 * 9).map(|i| Point::new(0.01 * (i % 19 + 1) as f64, 0.01 * (i / 19 + 1) as f64));
        let points: Vec<Point> = grid.collect();
        let each =
            points.iter().flat_map(|_| (0..=alive).flat_map(|port| [port.min(1) as f32, 0.5 * port as f32]));
        let data = each.collect();
        SampledResponses::new(ports, points, conditions, 2, data).unwrap()
    }

    #[test]
    fn dead_actuators_are_no_choice() {
        let ask = Ask { count: 2, keep: vec!["a3".into()], ..Ask::default() };
        assert_eq!(actuators(&ask, &responses(4), &[]).unwrap(), (vec![3, 1, 2, 4], 1, 3));
        let dead = Ask { keep: vec!["a0".into()], ..ask.clone() };
        let error = actuators(&dead, &responses(4), &[]).unwrap_err();
        assert_eq!(error.to_string(), "keep: expected one of a1, a2, a3, a4, found `a0`");
        let many = Ask { count: 4, ..ask };
        let error = actuators(&many, &responses(4), &[]).unwrap_err();
        assert!(error.to_string().starts_with("count: expected at most 3, the actuators"), "{error}");
    }

    #[test]
    fn actuators_that_the_rules_leave_out_come_last() {
        let left = vec![vec![[0.0, 0.0], [0.055, 0.0], [0.055, 0.1], [0.0, 0.1]]];
        let ask = Ask { count: 1, keep_out_m: left, ..Ask::default() };
        assert_eq!(actuators(&ask, &responses(4), &[]).unwrap(), (vec![2, 3, 4, 1], 0, 3));
        let all = Ask { count: 1, keep_all: true, ..Ask::default() };
        assert!(actuators(&all, &responses(4), &[]).is_err());
    }

    #[test]
    fn actuators_that_reach_into_an_area_are_left_out() {
        let responses = responses(4);
        let left = vec![vec![[0.0, 0.0], [0.055, 0.0], [0.055, 0.1], [0.0, 0.1]]];
        let ask = Ask { count: 1, keep_out_m: left, ..Ask::default() };
        let disc = |port: &Port| Actuator {
            name: port.name.clone(),
            at: port.at,
            kind: ActuatorKind::Force,
            contact_radius: 0.02,
        };
        // The one at 70 mm begins at 50 mm, and none need be clear of the rim at 10 mm.
        let mounted: Vec<Actuator> = responses.ports.iter().map(disc).collect();
        assert_eq!(actuators(&ask, &responses, &mounted).unwrap(), (vec![3, 4, 1, 2], 0, 2));
    }

    #[test]
    fn targets_are_points_of_the_library_and_held_out_from_each_other() {
        let responses = responses(4);
        // 17 x 7 of the points are a wavelength from the rim.
        for (targets, expected) in [(20, [20, 60]), (40, [40, 79]), (100, [59, 60])] {
            let ask = Ask { targets, ..Ask::default() };
            let (trained, tested) = spread_targets(&ask, &Importance::of(&ask).unwrap(), &responses).unwrap();
            assert_eq!([trained.len(), tested.len()], expected);
            let all: Vec<Point> = trained.iter().chain(&tested).map(|aim| aim.at).collect();
            for (i, at) in all.iter().enumerate() {
                assert!(responses.points.contains(at) && !all[..i].contains(at), "{at}");
                assert!(responses.conditions.outline.to_rim(*at) > 0.0195, "{at}");
            }
        }
        let corner = vec![vec![[0.0, 0.0], [0.015, 0.0], [0.015, 0.015], [0.0, 0.015]]];
        let ask = Ask { targets_within_m: corner, ..Ask::default() };
        let error = |ask: &Ask| {
            let refused = spread_targets(ask, &Importance::of(ask).unwrap(), &responses).unwrap_err();
            refused.to_string()
        };
        // Its only point is an actuator's.
        let none = error(&ask);
        assert!(none.starts_with("points_m, targets_within_m: expected at least two points"), "{none}");
        let area_m = vec![[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]];
        let ask = Ask { important: vec![ImportantAsk { area_m, weight: 0.0 }], ..Ask::default() };
        let unweighed = error(&ask);
        assert!(unweighed.starts_with("importance, important: expected weights above 0"), "{unweighed}");
    }

    #[test]
    fn targets_that_are_named_are_the_nearest_points() {
        let responses = responses(1);
        let ask = Ask { points_m: vec![[0.052, 0.051]], weights: vec![3.0], ..Ask::default() };
        let (aims, notes) = nearest(&ask, &responses).unwrap();
        assert!(aims[0].at.distance(Point::new(0.05, 0.05)) < 1e-12 && aims[0].weight == 3.0, "{aims:?}");
        assert!(notes[0].text.contains("2.24 mm away"), "{notes:?}");
        let between = Ask { points_m: vec![[0.0555, 0.0555]], ..Ask::default() };
        let error = nearest(&between, &responses).unwrap_err().to_string();
        assert!(error.starts_with("points_m: expected points at most 4.90 mm"), "{error}");
    }
}
