//! What a plan of sensors works on: the places to choose from, and what a measurement at each would tell.

use super::{Ask, SensingAsk, cost};
use crate::areas::{from_rim, polygons};
use crate::fit::{MOST as MOST_WAVES, TOP, reach};
use crate::numbers::above_zero;
use crate::window::conditions;
use crate::{Place, Progress, TaskError, go_on, point};
use unripple::act::model;
use unripple::core::{Point, Surface};
use unripple::linalg::Mat;
use unripple::physics::design::expected_modes;
use unripple_calibrate::{FitOptions, Information, InformationOptions, Sensing, information};
use unripple_placement::{Informations, Picking, PlacementError, Rules};

/// Share of the shortest wavelength that is the default spacing of places: what a place tells changes little between two of them.
const PITCH: f64 = 0.25;

/// Largest number of places of a request. More are taken for a mistake.
const MOST: usize = 1000;

/// Number of modes below which it is seen first whether there is one at all.
const FEW: f64 = 10.0;

/// What a plan works on.
pub(super) struct Setting {
    /// The surface as it is.
    pub surface: Surface,
    /// Where places may be.
    pub rules: Rules,
    /// Spacing of the grid of places, in m; `None` where places are listed.
    pub pitch: Option<f64>,
    /// The places to choose from.
    pub places: Vec<Point>,
    /// The places that are measured in any case.
    pub kept: Vec<Point>,
    /// What is known of the unknowns of the fit.
    pub found: Information,
    /// What a measurement at each place tells, beside the priors and the places that are kept.
    pub informations: Informations,
}

impl Setting {
    /// What a request asks for, after a check of its numbers.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of numbers that make no sense; those of solving for modes.
    pub fn of(ask: &Ask, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let surface = ask.surface.load()?;
        let rules = Rules {
            from_rim: from_rim(ask.rim_m)?,
            within: polygons("within_m", &ask.within_m)?,
            keep_out: polygons("keep_out_m", &ask.keep_out_m)?,
            ..Rules::default()
        };
        numbers(ask, &surface)?;
        let lambda_min = conditions(&surface).lambda_min;
        let pitch = ask.places_m.is_empty().then(|| ask.pitch_m.unwrap_or(PITCH * lambda_min));
        let places = places(ask, &surface, &rules, pitch)?;
        let kept = on_surface("keep_m", &ask.keep_m, &surface)?;
        let [low, high] = surface.emission.band;
        let fit = FitOptions {
            band: Some([low, TOP * high]),
            profile: ask.profile,
            strays: 0,
            reach: reach(TOP * high),
            ..FitOptions::default()
        };
        let max_hz = fit.reach * high;
        cost::announce(&surface, (places.len() + kept.len(), ask.profile), (high, max_hz), progress);
        progress.stage("modes");
        if expected_modes(&surface, high) < FEW {
            // Refused in the words of all commands, with the next mode, where there is none.
            model(&surface, None, &[])?;
        }
        go_on(progress)?;
        progress.stage("what each place tells");
        let sensing = match ask.sensing {
            SensingAsk::Sweeps => Sensing::Sweeps,
            SensingAsk::Taps => Sensing::Taps,
        };
        let all: Vec<Point> = places.iter().chain(&kept).copied().collect();
        let options = InformationOptions { sensing, snr_db: ask.snr_db, fit };
        let found = information(&surface, &all, &options)?;
        go_on(progress)?;
        let informations = beside(&found, places.len())?;
        Ok(Self { surface, rules, pitch, places, kept, found, informations })
    }

    /// The search for places.
    pub fn picking<'a>(&'a self, ask: &Ask) -> Picking<'a> {
        Picking { informations: &self.informations, at: &self.places, kept: &self.kept, apart: ask.apart_m }
    }
}

/// The information of the places to choose from, with that of the priors and of the places that are kept, which come after them.
fn beside(found: &Information, places: usize) -> Result<Informations, TaskError> {
    let count = found.unknowns.len();
    let (each, kept) = found.at.split_at(places);
    if count == 0 {
        let expected = "expected places that tell something of the surface, found none";
        return Err(TaskError::Input(format!("{expected}: nothing moves there, or noise hides it")));
    }
    // In standard deviations of the priors, these are the identity.
    let before = Mat::from_fn(count, count, |i, j| {
        let prior = if i == j { 1.0 } else { 0.0 };
        prior + kept.iter().map(|one| one[(i, j)]).sum::<f64>()
    });
    Informations::new(&before, each).map_err(TaskError::work)
}

/// Checks the numbers of a request.
fn numbers(ask: &Ask, surface: &Surface) -> Result<(), TaskError> {
    let within = |field: &'static str, found: usize, least: usize, most: usize| match (least..=most)
        .contains(&found)
    {
        true => Ok(()),
        false => Err(TaskError::ask(field, format!("{least} to {most}"), found)),
    };
    within("count", ask.count, 1, MOST)?;
    within("restarts", ask.restarts, 0, MOST)?;
    within("up_to", ask.up_to.unwrap_or(1), 1, MOST)?;
    within("profile", ask.profile, 0, MOST_WAVES)?;
    ask.pitch_m.map_or(Ok(1.0), |pitch| above_zero(pitch, "pitch_m", "m"))?;
    if !(0.0..=1.0).contains(&ask.apart_m) {
        let found = format!("{} mm", 1e3 * ask.apart_m);
        return Err(TaskError::ask("apart_m", "a length from 0 to 1000 mm", found));
    }
    if !(-100.0..=120.0).contains(&ask.snr_db) {
        return Err(TaskError::ask("snr_db", "a number from -100 to 120 dB", ask.snr_db));
    }
    let least = if ask.sensing == SensingAsk::Taps { 2 } else { 1 };
    let found = surface.actuators.len();
    match found < least {
        true => Err(TaskError::Input(format!(
            "{}: expected at least {least} actuators, found {found}",
            surface.name
        ))),
        false => Ok(()),
    }
}

/// Places of a request, all of which must be on the surface.
fn on_surface(field: &'static str, places: &[Place], surface: &Surface) -> Result<Vec<Point>, TaskError> {
    let all: Vec<Point> = places.iter().map(point).collect();
    match all.iter().find(|at| !surface.outline.contains(**at)) {
        Some(at) => Err(TaskError::ask(field, "points on the surface", format!("{at}, beyond its edge"))),
        None => Ok(all),
    }
}

/// The places to choose from, on a grid of some pitch (m) or listed.
fn places(ask: &Ask, surface: &Surface, rules: &Rules, pitch: Option<f64>) -> Result<Vec<Point>, TaskError> {
    let listed = on_surface("places_m", &ask.places_m, surface)?;
    let places = match pitch {
        Some(pitch) => rules.grid(&surface.outline, pitch).map_err(TaskError::input)?,
        None => listed.into_iter().filter(|at| rules.allow(&surface.outline, *at)).collect(),
    };
    if places.len() < ask.count {
        let expected = format!("at least {}, one for each that is planned", ask.count);
        let fields = match pitch {
            Some(_) => "count, pitch_m, rim_m, within_m, keep_out_m",
            None => "count, places_m",
        };
        return Err(TaskError::ask(fields, expected, format!("{} places", places.len())));
    }
    Ok(places)
}

/// The error of a task for one of a search.
pub(super) fn refused(error: PlacementError) -> TaskError {
    match error {
        PlacementError::Few { expected, found } => {
            let room = |count: usize| format!("room for {count} places");
            TaskError::ask("count, apart_m", room(expected), room(found))
        }
        error => TaskError::work(error),
    }
}
