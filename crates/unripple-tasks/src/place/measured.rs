//! Chooses among the actuators of a library, from its responses alone.

use super::choice::Choice;
use super::figure::Drawn;
use super::outcome::Outcome;
use super::placed::{Layout, More, Number, Placed, Random, Restarts};
use super::refused::refused;
use super::sought::{OTHERS, RANDOM, Sought, objective_name};
use super::{Ask, Report};
use crate::source::Stored;
use crate::{Progress, TaskError, go_on};
use unripple::core::Surface;
use unripple_placement::{Aim, Forms, Reached, Search, reached_from};

/// The actuators of a library to keep.
pub(super) fn outcome(
    ask: &Ask,
    surface: Surface,
    stored: Stored,
    progress: &mut dyn Progress,
) -> Result<Outcome, TaskError> {
    let choice = Choice::of(ask, surface, stored)?;
    go_on(progress)?;
    progress.stage("fields of all places");
    let forms = |ports: &[usize], aims: &[Aim]| {
        Forms::sampled(&choice.responses, ports, aims, choice.window).map_err(refused)
    };
    let at = choice.at();
    let trained = forms(&choice.ports[..at.len()], &choice.trained)?;
    go_on(progress)?;
    let tested = forms(&choice.ports, &choice.tested)?;
    let (kept, objective) = (choice.kept, ask.objective());
    let search = Search { forms: &trained, at: &at, kept, apart: choice.apart(ask), objective };
    let sought = Sought::of(ask, &search, progress)?;
    go_on(progress)?;
    progress.stage("evaluation");
    let report = report(ask, &choice, &search, &sought, &tested);
    let names: Vec<&str> = report.after.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
    let file = ("actuators.txt", names.join("\n") + "\n");
    let (places, one_more) = (at[kept..].to_vec(), sought.free(&search));
    Ok(Outcome { report, drawn: Drawn { surface: choice.surface, places, one_more }, file })
}

/// The report on what a search found, evaluated by the forms of the targets that are held out.
fn report(ask: &Ask, choice: &Choice, search: &Search<'_>, sought: &Sought, tested: &Forms) -> Report {
    let aims = &choice.tested;
    let reached = |set: &[usize]| reached_from(tested, set);
    let layout = |set: &[usize]| Layout::of(named(choice, set), &reached(set), aims);
    // Distances may be such that only a search finds room.
    let random = search.random(ask.count, RANDOM, ask.seed ^ OTHERS).ok().map(|random| {
        let random: Vec<Vec<Reached>> = random.iter().map(|set| reached(set)).collect();
        Random::of(&random, aims)
    });
    let each = sought.each.iter().map(|found| Number::of(found, &reached(&found.actuators), aims));
    let all: Vec<usize> = (0..choice.ports.len()).collect();
    let one_more = sought.one_more(search).map(|more| {
        let name = sought.next(search).map(|next| choice.responses.ports[choice.ports[next]].name.clone());
        More { name, ..more }
    });
    let best = sought.best.score;
    Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "place",
        surface: choice.surface.name.clone(),
        judged_on: Some(choice.told.clone()),
        count: ask.count,
        kept: named(choice, &all[..choice.kept]).into_iter().map(|actuator| actuator.name).collect(),
        places: choice.places,
        objective: objective_name(ask),
        window_s: choice.window,
        window_why: choice.window_why.clone(),
        placed_for: choice.trained.len(),
        evaluated_on: aims.len(),
        held_out: ask.points_m.is_empty(),
        before: Some(layout(&all)),
        after: layout(&sought.best.actuators),
        random,
        restarts: Restarts { reached: sought.reached.clone(), best, polished: best },
        certificate: sought.certificate.clone(),
        each_number: each.collect(),
        one_more,
        notes: choice.notes.clone(),
        ..Report::default()
    }
}

/// Names and places of some of the actuators of a choice, in the order of the library.
fn named(choice: &Choice, set: &[usize]) -> Vec<Placed> {
    let mut ports: Vec<usize> = set.iter().map(|a| choice.ports[*a]).collect();
    ports.sort_unstable();
    let one = |port: usize| {
        let port = &choice.responses.ports[port];
        Placed { name: port.name.clone(), at_m: [port.at.x, port.at.y] }
    };
    ports.into_iter().map(one).collect()
}
