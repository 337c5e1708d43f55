//! Finds places for actuators, and evaluates the layout.

use super::budget::STARTS;
use super::figure::Drawn;
use super::outcome::Outcome;
use super::placed::{Build, Layout, Number, Placed, Random, Restarts};
use super::refused::refused;
use super::setting::Setting;
use super::sought::{OTHERS, RANDOM, Sought, objective_name};
use super::{Ask, Report, Second, by_method, choice, figure, measured, second};
use crate::figures::Columns;
use crate::{Progress, TaskError, figures, folder, go_on, source};
use unripple::core::{Actuator, Point, Surface};
use unripple_placement::{Aim, Forms, Found, Polish, Reached, Search, reached, reached_each};
use unripple_store::to_toml;

/// Errors of the places, in m, whose cost is told.
const ERRORS: [f64; 3] = [0.5e-3, 1e-3, 2e-3];

/// Random builds for each error. Their mean is within a quarter of their deviation.
const BUILDS: usize = 20;

/// Finds where actuators should be so that time reversal has the most contrast, evaluates the layout on targets that it was not placed
/// for, and writes the surface with it to a folder if the request names one. Of a library of responses it chooses the actuators to keep,
/// and writes their names.
///
/// ```
/// use unripple_tasks::{Silent, place};
///
/// // Four actuators near the rim of the paper's film, in a third of its band.
/// let surface = unripple_tasks::SurfaceAsk::Set {
///     name: "hudin-2012".into(),
///     set: [("drive.band_hz".to_owned(), "[0, 1000]".to_owned())].into(),
/// };
/// let ask = place::Ask { surface, count: 4, rim_m: Some([6e-3, 12e-3]), restarts: 2, ..place::Ask::default() };
/// let report = place::run(&ask, &mut Silent)?;
/// let random = report.random.map_or(0.0, |random| random.mean_contrast);
/// assert!(report.after.mean_contrast > 1.1 * random);
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of reading the surface or library and writing the folder;
/// [`TaskError::Input`] of places or models that the search does not fit; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let columns = Columns::of(ask.columns)?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let mut source = source::open(&ask.surface, progress)?;
    source.allows(&choice::needing_modes(ask))?;
    let Outcome { mut report, drawn, file } = match source.stored.take() {
        Some(stored) => measured::outcome(ask, source.surface, stored, progress)?,
        None => outcome(ask, source.surface, progress)?,
    };
    if let Some((out, record)) = out {
        if !ask.no_figures {
            progress.stage("figures");
            report.files = figures::write(&out, &columns.fit(figure::all(&report, &drawn)))?;
        }
        let (name, text) = file;
        out.write(name, text.as_bytes())?;
        record.write(&out, &report)?;
        out.write("report.md", report.markdown().as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(report)
}

/// The places for actuators on a surface.
fn outcome(ask: &Ask, surface: Surface, progress: &mut dyn Progress) -> Result<Outcome, TaskError> {
    let setting = Setting::of(ask, surface, progress)?;
    let (report, built, one_more) = found(ask, &setting, progress)?;
    let drawn = Drawn { surface: setting.surface, places: setting.places, one_more };
    Ok(Outcome { report, drawn, file: ("surface.toml", to_toml(&built)) })
}

/// The search, the surface with the placed actuators, and the objective with one more actuator at every
/// place.
fn found(
    ask: &Ask,
    setting: &Setting,
    progress: &mut dyn Progress,
) -> Result<(Report, Surface, Vec<f64>), TaskError> {
    let kept = setting.plants[0].kept();
    go_on(progress)?;
    progress.stage("fields of all places");
    let forms =
        Forms::new(&setting.plants, &setting.places, &setting.trained, setting.window, ask.mounting_m);
    let forms = forms.map_err(refused)?;
    let stay = setting.plants[0].surface().actuators.iter().map(|actuator| actuator.at);
    let at: Vec<Point> = stay.chain(setting.places.iter().copied()).collect();
    let objective = ask.objective();
    let search = Search { forms: &forms, at: &at, kept, apart: setting.apart(ask), objective };
    let mut sought = Sought::of(ask, &search, progress)?;
    let best = sought.best.score;
    let (places, polished, second) = settled(ask, setting, &search, &mut sought, progress)?;
    let built = setting.built(&places);
    let evaluated = Evaluated::of(ask, setting, &search, (&sought.each, &places), progress)?;
    progress.stage("methods");
    let methods = by_method::each(&ask.methods, setting, &built, progress)?;
    let one_more = sought.one_more(&search);
    let drawn = sought.free(&search);
    let report = Report {
        restarts: Restarts { reached: sought.reached, best, polished },
        certificate: sought.certificate,
        second_search: second,
        one_more,
        methods,
        ..evaluated.report(ask, setting, &built)
    };
    Ok((report, built, drawn))
}

/// The places of the final layout, the contrast of time reversal with actuators off the grid, and what a second search found, which may
/// choose another best layout on the grid.
fn settled(
    ask: &Ask,
    setting: &Setting,
    search: &Search<'_>,
    sought: &mut Sought,
    progress: &mut dyn Progress,
) -> Result<(Vec<Point>, f64, Option<Second>), TaskError> {
    go_on(progress)?;
    progress.stage("polish");
    let grid: Vec<Point> = sought.best.actuators[search.kept..].iter().map(|a| search.at[*a]).collect();
    let (places, polished) = match setting.pitch {
        Some(pitch) => polish(ask, setting).polished(grid, pitch).map_err(refused)?,
        None => (grid, sought.best.score),
    };
    let Some(by) = ask.by else { return Ok((places, polished, None)) };
    go_on(progress)?;
    let starts = sought.leading(STARTS);
    let found = second::searched(ask, by, setting, (search, starts.as_slice()), &places, progress)?;
    if let Some(chosen) = found.chosen {
        sought.choose(search, chosen);
    }
    Ok((found.places, polished, Some(found.second)))
}

fn polish<'a>(ask: &Ask, setting: &'a Setting) -> Polish<'a> {
    Polish {
        plants: &setting.plants,
        aims: &setting.trained,
        window: setting.window,
        mounting: ask.mounting_m,
        rules: &setting.rules,
        apart: setting.apart(ask),
        objective: ask.objective(),
    }
}

/// Layouts evaluated on targets that they were not optimised for.
struct Evaluated {
    before: Option<Vec<Reached>>,
    after: Vec<Reached>,
    random: Option<Random>,
    each: Vec<Number>,
    builds: Vec<Build>,
}

impl Evaluated {
    fn of(
        ask: &Ask,
        setting: &Setting,
        search: &Search<'_>,
        (each, places): (&[Found], &[Point]),
        progress: &mut dyn Progress,
    ) -> Result<Self, TaskError> {
        go_on(progress)?;
        progress.stage("evaluation");
        let (plants, aims, window) = (&setting.plants, &setting.tested, setting.window);
        let all = |layouts: &[Vec<Point>]| reached_each(plants, layouts, aims, window).map_err(refused);
        let at = |layout: &[usize]| layout[search.kept..].iter().map(|a| search.at[*a]).collect::<Vec<_>>();
        // Distances may be such that only a search finds room.
        let random = match search.random(ask.count, RANDOM, ask.seed ^ OTHERS) {
            Ok(random) => {
                let random = all(&random.iter().map(|layout| at(layout)).collect::<Vec<_>>())?;
                Some(Random::of(&random, aims))
            }
            Err(_) => None,
        };
        go_on(progress)?;
        let numbers = all(&each.iter().map(|found| at(&found.actuators)).collect::<Vec<_>>())?;
        let numbers = each.iter().zip(&numbers).map(|(found, reached)| Number::of(found, reached, aims));
        let mut builds = Vec::new();
        for error in ERRORS {
            go_on(progress)?;
            builds.push(Build::of(error, &all(&setting.perturbed(places, error, BUILDS, ask.seed))?, aims));
        }
        let after = all(&[places.to_vec()])?.remove(0);
        let before = before(setting, aims)?;
        Ok(Self { before, after, random, each: numbers.collect(), builds })
    }

    /// The report, as far as it is of the evaluation.
    fn report(self, ask: &Ask, setting: &Setting, built: &Surface) -> Report {
        let (before, after) = self.layouts(setting, built);
        Report {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "place",
            surface: setting.surface.name.clone(),
            count: ask.count,
            kept: setting.plants[0]
                .surface()
                .actuators
                .iter()
                .map(|actuator| actuator.name.clone())
                .collect(),
            places: setting.places.len(),
            pitch_m: setting.pitch,
            objective: objective_name(ask),
            window_s: setting.window,
            window_why: setting.window_why.clone(),
            placed_for: setting.trained.len(),
            evaluated_on: setting.tested.len(),
            held_out: setting.held_out,
            before,
            after,
            random: self.random,
            each_number: self.each,
            mounting: self.builds,
            notes: setting.notes(ask),
            ..Report::default()
        }
    }

    /// The layout that the surface has, if any, and the one that was found.
    fn layouts(&self, setting: &Setting, built: &Surface) -> (Option<Layout>, Layout) {
        let aims = &setting.tested;
        let own = |reached: &Vec<Reached>| Layout::of(Placed::all(&setting.surface.actuators), reached, aims);
        (self.before.as_ref().map(own), Layout::of(Placed::all(&built.actuators), &self.after, aims))
    }
}

/// What the surface's own actuators achieve, without the loads of those that are taken away, as those that are placed are compared; `None`
/// where these are of another kind.
fn before(setting: &Setting, aims: &[Aim]) -> Result<Option<Vec<Reached>>, TaskError> {
    let kind = &setting.kind;
    let alike = |own: &Actuator| own.kind == kind.kind && own.contact_radius == kind.contact_radius;
    if !setting.moved().all(alike) {
        return Ok(None);
    }
    let own: Vec<Point> = setting.moved().map(|actuator| actuator.at).collect();
    reached(&setting.plants, &own, aims, setting.window).map(Some).map_err(refused)
}
