//! What a search for places works on: the surface without the actuators that are placed, the places, the targets.

use super::ask::TESTED;
use super::importance::Importance;
use super::numbers::numbers;
use super::refused::refused;
use super::{Ask, cost};
use crate::areas::{from_rim, polygons};
use crate::numbers::above_zero;
use crate::sweep::short;
use crate::window::{carries, conditions};
use crate::{Progress, TaskError, go_on, point};
use std::collections::HashSet;
use std::f64::consts::PI;
use std::fmt::Display;
use unripple::act::{Note, accuracy, chosen_window, less_accurate, model};
use unripple::core::{Actuator, ActuatorKind, Conditions, Outline, Patch, Point, Random, Responses, Surface};
use unripple::physics::Transducer;
use unripple_placement::{Aim, Plant, Rules, spread};

/// Share of the shortest wavelength that is the default spacing of places: shapes change little between two of them, and the polish moves
/// actuators further.
const PITCH: f64 = 1.0 / 7.0;

/// Area of a focal disc, as a share of the surface's, from which a note says so. On the paper's film up to 500 Hz, where it is 1.2, the mean
/// contrasts of random layouts differ by half; up to 1000 Hz, where it is 0.3, by a tenth.
const LARGE_DISC: f64 = 0.4;

/// What a search works on.
pub(super) struct Setting {
    /// The surface as it is.
    pub surface: Surface,
    /// The models of the surface that layouts are optimised for, with the kept actuators only.
    pub plants: Vec<Plant>,
    /// What an actuator to be placed is like.
    pub kind: Actuator,
    /// Where actuators may be.
    pub rules: Rules,
    /// Spacing of the grid of places, in m; `None` where places are listed.
    pub pitch: Option<f64>,
    /// The places to choose from.
    pub places: Vec<Point>,
    /// The targets that actuators are placed for.
    pub trained: Vec<Aim>,
    /// The targets on which layouts are evaluated.
    pub tested: Vec<Aim>,
    /// Whether these are others than those that actuators are placed for.
    pub held_out: bool,
    /// Window T, in s.
    pub window: f64,
    /// Reason for the default window.
    pub window_why: Option<String>,
}

impl Setting {
    /// The settings for a request on a surface, after a check of its values.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of numbers and names that make no sense; those of solving for modes.
    pub fn of(ask: &Ask, surface: Surface, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        numbers(ask)?;
        let kind = kind(ask, &surface)?;
        let kept = Surface { actuators: kept(ask, &surface)?, ..surface.clone() };
        let lambda_min = conditions(&surface).lambda_min;
        let rules = Rules {
            from_rim: from_rim(ask.rim_m)?,
            within: polygons("within_m", &ask.within_m)?,
            keep_out: polygons("keep_out_m", &ask.keep_out_m)?,
            footprint: footprint(&kind),
        };
        let (trained, tested) = targets(ask, &surface, lambda_min)?;
        let held_out = ask.points_m.is_empty();
        let pitch = ask.places_m.is_empty().then(|| ask.pitch_m.unwrap_or(PITCH * lambda_min));
        let places = places(ask, &surface, &kind, &rules, pitch)?;
        let window_s = ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
        window_s.map_or(Ok(()), |window| carries(&conditions(&surface), window, "window_s"))?;
        bearable(ask, &surface, lambda_min)?;
        cost::announce(ask, (&kept, &kind), &places, progress);
        progress.stage("modes");
        let plants = plants(ask, &kept, &kind)?;
        go_on(progress)?;
        if plants[0].responses(&places[..1]).map_err(refused)?.poles.is_empty() {
            // Refused in the words of all commands, with the next mode.
            model(&surface, None, &[])?;
        }
        let (window, window_why) = window(ask, &plants[0], &places)?;
        Ok(Self {
            surface,
            plants,
            kind,
            rules,
            pitch,
            places,
            trained,
            tested,
            held_out,
            window,
            window_why,
        })
    }

    /// Least distance between two actuators, in m: by default that at which two of those placed would touch.
    pub fn apart(&self, ask: &Ask) -> f64 {
        ask.apart_m.unwrap_or(2.0 * reach(&self.kind))
    }

    /// Notes on effects that the search leaves out, and on results that are less accurate than usual.
    pub fn notes(&self, ask: &Ask) -> Vec<Note> {
        let mut notes = Vec::new();
        let error = self.plants[0].frequency_error();
        notes.extend(less_accurate(error, accuracy(&self.surface).aim));
        let there = Actuator { at: self.places[0], ..self.kind.clone() };
        let loads =
            Transducer::of(&there, &self.surface.outline).is_ok_and(|transducer| transducer.load.is_some());
        if loads {
            let text = "while places are compared, the actuators to be placed do not load the sheet: their masses, springs and electrical \
                        damping count only in the results by method";
            let second = if ask.by.is_some() { ", and in the search by them" } else { "" };
            notes.push(Note { topic: "loads", text: format!("{text}{second}") });
        }
        if ask.by.is_some() && (ask.mounting_m > 0.0 || ask.tension > 0.0) {
            let text = "errors of places and tension count in the first search; the one by results of the method takes places and tension \
                        to be exact";
            notes.push(Note { topic: "errors", text: text.into() });
        }
        notes.extend(of_targets(&conditions(&self.surface), self.held_out));
        notes
    }

    /// The surface's own actuators that are not kept.
    pub fn moved(&self) -> impl Iterator<Item = &Actuator> {
        let stay = &self.plants[0].surface().actuators;
        self.surface.actuators.iter().filter(move |actuator| !stay.contains(actuator))
    }

    /// Layouts with random errors of the actuators' places, up to `error` (m) along each axis: `builds` of
    /// them.
    pub fn perturbed(&self, places: &[Point], error: f64, builds: usize, seed: u64) -> Vec<Vec<Point>> {
        let mut random = Random::seeded(seed);
        let mut off = |place: &Point| {
            let moved =
                Point::new(place.x + random.between(-error, error), place.y + random.between(-error, error));
            // Where none can be, it is put where it was meant to be.
            if self.plants[0].holds(moved) { moved } else { *place }
        };
        (0..builds).map(|_| places.iter().map(&mut off).collect()).collect()
    }

    /// The surface with new actuators at `places` (m) instead of those that are not kept; they take over the channels and names of
    /// these, as far as there are any.
    pub fn built(&self, places: &[Point]) -> Surface {
        let stay = &self.plants[0].surface().actuators;
        let put = |name: String, at: &Point| Actuator { name, at: *at, ..self.kind.clone() };
        let mut places = places.iter();
        let mut actuators = Vec::new();
        for own in &self.surface.actuators {
            match stay.contains(own) {
                true => actuators.push(own.clone()),
                false => actuators.extend(places.next().map(|at| put(own.name.clone(), at))),
            }
        }
        let old: HashSet<&str> = self.surface.actuators.iter().map(|a| a.name.as_str()).collect();
        let new = (1..).map(|i| format!("a{i}")).filter(|name| !old.contains(name.as_str()));
        actuators.extend(places.zip(new).map(|(at, name)| put(name, at)));
        Surface { actuators, ..self.surface.clone() }
    }
}

/// What an actuator covers of the sheet, about its place.
pub(super) fn footprint(actuator: &Actuator) -> Patch {
    match actuator.kind {
        ActuatorKind::Piezo { patch, .. } => patch,
        _ => Patch::Round { radius: actuator.contact_radius },
    }
}

/// Largest distance from the place of an actuator to where it touches the sheet, in m.
pub(super) fn reach(actuator: &Actuator) -> f64 {
    match footprint(actuator) {
        Patch::Round { radius } => radius,
        Patch::Rectangular { sides: [width, height], .. } => 0.5 * width.hypot(height),
    }
}

/// Notes on targets: that focal discs are large, where they cover much of the surface, and that layouts are evaluated on the targets
/// that they were optimised for, where these are not held out.
pub(super) fn of_targets(conditions: &Conditions, held_out: bool) -> Vec<Note> {
    let radius = conditions.focal_radius();
    let covered = PI * radius * radius / conditions.outline.area();
    let discs = format!(
        "a focal disc, of radius {:.1} mm, has {:.0} % of the area of the surface: contrasts are ratios to the little that is left \
         outside, differ much between targets, and a layout that is good for some may not be for others; a band up to higher \
         frequencies has smaller discs",
        1e3 * radius,
        100.0 * covered
    );
    let seen = "layouts are evaluated on the targets that they were optimised for, since these were given";
    let discs = (covered > LARGE_DISC).then_some(Note { topic: "focal disc", text: discs });
    let seen = (!held_out).then(|| Note { topic: "targets", text: seen.into() });
    discs.into_iter().chain(seen).collect()
}

/// Share of the shortest wavelength up to which errors of places can be borne: four nodes tell nothing of larger ones.
const BEARABLE: f64 = 0.25;

/// Checks that the errors to be borne are such as the search can bear.
fn bearable(ask: &Ask, surface: &Surface, lambda_min: f64) -> Result<(), TaskError> {
    let most = BEARABLE * lambda_min;
    if ask.mounting_m > most {
        let expected = format!("at most a quarter of the shortest wavelength, {:.3} mm", 1e3 * most);
        return Err(TaskError::ask("mounting_m", expected, format!("{} mm", 1e3 * ask.mounting_m)));
    }
    if ask.tension > 0.0 && surface.sheet.tension == 0.0 {
        let found = format!("{} %", short(100.0 * ask.tension));
        return Err(TaskError::ask("tension", "0 % on a sheet without tension", found));
    }
    Ok(())
}

/// The kept actuators.
fn kept(ask: &Ask, surface: &Surface) -> Result<Vec<Actuator>, TaskError> {
    ask.keep.iter().try_for_each(|name| named(surface, name, "keep").map(drop))?;
    let stays = |actuator: &&Actuator| ask.keep_all || ask.keep.contains(&actuator.name);
    Ok(surface.actuators.iter().filter(stays).cloned().collect())
}

fn named<'a>(surface: &'a Surface, name: &str, field: &'static str) -> Result<&'a Actuator, TaskError> {
    surface.actuators.iter().find(|actuator| actuator.name == name).ok_or_else(|| {
        let names: Vec<&str> = surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
        let names = if names.is_empty() {
            "an actuator of the surface, which has none".into()
        } else {
            names.join(", ")
        };
        TaskError::ask(field, format!("one of {names}"), format!("`{name}`"))
    })
}

/// The actuator whose kind and constants the placed ones get.
fn kind(ask: &Ask, surface: &Surface) -> Result<Actuator, TaskError> {
    if let Some(name) = &ask.like {
        return named(surface, name, "like").cloned();
    }
    let first = surface.actuators.first().cloned();
    first.ok_or_else(|| {
        TaskError::ask("like", "a surface with an actuator, whose kind those placed get", "none")
    })
}

/// The places to choose from, on a grid of some pitch (m) or listed.
fn places(
    ask: &Ask,
    surface: &Surface,
    kind: &Actuator,
    rules: &Rules,
    pitch: Option<f64>,
) -> Result<Vec<Point>, TaskError> {
    let outline = &surface.outline;
    if let Some(at) = ask.places_m.iter().map(point).find(|at| !outline.contains(*at)) {
        return Err(TaskError::ask("places_m", "points on the surface", format!("{at}, beyond its edge")));
    }
    let mut places = match pitch {
        Some(pitch) => rules.grid(outline, pitch).map_err(refused)?,
        None => ask.places_m.iter().map(point).filter(|at| rules.allow(outline, *at)).collect(),
    };
    places.retain(|at| Transducer::of(&Actuator { at: *at, ..kind.clone() }, outline).is_ok());
    if places.len() < ask.count {
        let expected = format!("at least {}, one for each actuator", ask.count);
        let found = format!("{} places", places.len());
        return Err(TaskError::ask("places_m, pitch_m, rim_m, within_m, keep_out_m", expected, found));
    }
    Ok(places)
}

/// The targets that a request names, with their weights.
///
/// # Errors
/// [`TaskError::Ask`] of one that is not on the surface.
pub(super) fn named_targets(ask: &Ask, outline: &Outline) -> Result<Vec<Aim>, TaskError> {
    let weights = ask.weights.iter().copied().chain(std::iter::repeat(1.0));
    let aims = ask.points_m.iter().map(point).zip(weights).map(|(at, weight)| Aim { at, weight });
    let aims: Vec<Aim> = aims.collect();
    if let Some(aim) = aims.iter().find(|aim| !outline.contains(aim.at)) {
        let found = format!("{}, beyond its edge", aim.at);
        return Err(TaskError::ask("points_m", "points on the surface", found));
    }
    Ok(aims)
}

/// Where targets may be that a request does not name, with the shortest wavelength `lambda_min` (m).
pub(super) fn target_rules(ask: &Ask, lambda_min: f64) -> Rules {
    let within = ask.targets_within_m.iter().map(|area| area.iter().map(point).collect()).collect();
    // Near a rim that is held, nothing can be in focus.
    let from_rim = if ask.targets_within_m.is_empty() { lambda_min } else { 0.0 };
    Rules { from_rim: [from_rim, f64::INFINITY], within, ..Rules::default() }
}

/// The error where there would be room for targets, but places with a weight are few: those that were `found`.
pub(super) fn without_weight(found: impl Display) -> TaskError {
    TaskError::ask("importance, important", "weights above 0 where targets may be", found)
}

/// The targets that layouts are optimised for, and those on which they are evaluated.
fn targets(ask: &Ask, surface: &Surface, lambda_min: f64) -> Result<(Vec<Aim>, Vec<Aim>), TaskError> {
    let (outline, importance) = (&surface.outline, Importance::of(ask)?);
    if !ask.points_m.is_empty() {
        let aims = named_targets(ask, outline)?;
        return Ok((aims.clone(), aims));
    }
    let rules = target_rules(ask, lambda_min);
    let count = (1 + TESTED) * ask.targets;
    let mut trained = importance.spread(outline, &rules, count);
    if trained.len() < count {
        if spread(outline, &rules, 0, count).len() == count {
            return Err(without_weight("hardly any"));
        }
        let found = "hardly any: the surface is small compared with its shortest wavelength, or the areas lie beyond it";
        return Err(TaskError::ask("points_m, targets_within_m", "room for targets on the surface", found));
    }
    let tested = trained.split_off(ask.targets);
    Ok((trained, tested))
}

/// The models of the surface: with its nominal tension, and if the tension may deviate, also with a lower and a higher
/// one.
fn plants(ask: &Ask, kept: &Surface, kind: &Actuator) -> Result<Vec<Plant>, TaskError> {
    // A uniform error by three points: Gauss-Legendre, of degree five.
    let points = [(-(0.6_f64.sqrt()), 5.0 / 18.0), (0.0, 4.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let all = if ask.tension == 0.0 { &points[1..2] } else { &points[..] };
    let of = |(error, weight): &(f64, f64)| {
        let mut surface = kept.clone();
        surface.sheet.tension *= 1.0 + ask.tension * error;
        let mut plant = Plant::new(surface, kind).map_err(refused)?;
        plant.weight = *weight;
        Ok(plant)
    };
    // The first one is where places are looked up.
    let mut plants = all.iter().map(of).collect::<Result<Vec<_>, TaskError>>()?;
    let middle = plants.len() / 2;
    plants.swap(0, middle);
    Ok(plants)
}

/// The window in s, and why, where it is not that of the request.
fn window(ask: &Ask, plant: &Plant, places: &[Point]) -> Result<(f64, Option<String>), TaskError> {
    let kept = plant.surface();
    if let Some(window) = ask.window_s {
        return Ok((window, None));
    }
    let mut spread = kept.clone();
    let step = places.len() as f64 / ask.count as f64;
    let evenly: Vec<Point> = (0..ask.count).map(|i| places[((i as f64 + 0.5) * step) as usize]).collect();
    let named =
        |(i, at): (usize, &Point)| Actuator { name: format!("place {i}"), at: *at, ..plant.kind().clone() };
    spread.actuators.extend(evenly.iter().enumerate().map(named));
    let responses = plant.responses(&evenly).map_err(refused)?;
    let chosen = chosen_window(&spread, &Responses::Modal(responses));
    carries(&conditions(kept), chosen.seconds, "window_s")?;
    Ok((chosen.seconds, Some(chosen.why.clone())))
}
