//! The search by scores that are evaluated layout by layout.

use crate::bench::{WINDOW, aims, places, plant};
use std::collections::BTreeSet;
use unripple_core::Point;
use unripple_placement::{Forms, Objective, Refining, Search};

const REFINING: Refining = Refining { evaluations: 10_000, spacing: 20e-3, seed: 1 };

/// Forms of a few places at the rim of the film, and these places.
fn few() -> (Forms, Vec<Point>) {
    let places: Vec<Point> = places(6e-3).into_iter().step_by(5).collect();
    (Forms::new(&[plant(800.0)], &places, &aims(0, 6), WINDOW, 0.0).unwrap(), places)
}

fn mean<'a>(forms: &'a Forms, at: &'a [Point]) -> Search<'a> {
    Search { forms, at, kept: 0, apart: 5e-3, objective: Objective::Mean }
}

/// All layouts that differ from one in an actuator.
fn beside(search: &Search<'_>, layout: &[usize]) -> Vec<Vec<usize>> {
    let mut all = Vec::new();
    for position in 0..layout.len() {
        let mut rest = layout.to_vec();
        rest.remove(position);
        let free = (0..search.at.len()).filter(|b| search.is_free(&rest, *b));
        all.extend(free.map(|b| rest.iter().copied().chain([b]).collect()));
    }
    all
}

#[test]
fn no_move_is_better_than_what_was_found_and_each_layout_is_evaluated_once() {
    let (forms, at) = few();
    let (search, worst) = (mean(&forms, &at), Search { objective: Objective::Worst, ..mean(&forms, &at) });
    // What the moves are tried by is the mean, what counts is the worst target.
    let start = search.restarts(3, 1, 4).unwrap().remove(0).actuators;
    let mut seen = BTreeSet::new();
    let found = search.refined(std::slice::from_ref(&start), &REFINING, |layout| {
        let mut set = layout.to_vec();
        set.sort_unstable();
        assert!(seen.insert(set), "{layout:?} again");
        Ok::<f64, ()>(worst.score(layout.to_vec()))
    });
    let found = found.unwrap().unwrap();
    assert!(found.settled && found.evaluations == seen.len(), "{found:?}");
    assert!(found.score >= worst.score(start), "{found:?}");
    for layout in beside(&search, &found.actuators) {
        assert!(worst.score(layout.clone()) <= found.score * (1.0 + 1e-5), "{layout:?} {found:?}");
    }
}

#[test]
fn the_number_of_evaluations_ends_the_search() {
    let (forms, at) = few();
    let search = mean(&forms, &at);
    let starts = search.random(3, 3, 2).unwrap();
    for evaluations in [1, 3, 10] {
        let mut count = 0;
        let found = search.refined(&starts, &Refining { evaluations, ..REFINING }, |layout| {
            count += 1;
            Ok::<f64, ()>(search.score(layout.to_vec()))
        });
        let found = found.unwrap().unwrap();
        assert_eq!((count, found.evaluations, found.settled), (evaluations, evaluations, false));
        let most = starts.iter().take(evaluations).map(|start| search.score(start.clone()));
        assert!(found.score >= most.fold(0.0, f64::max), "{found:?}");
    }
    let none = search.refined(&[], &REFINING, |_| Ok::<f64, ()>(1.0));
    assert_eq!(none, Ok(None));
}

#[test]
fn layouts_without_a_score_are_left_and_errors_end_the_search() {
    let (forms, at) = few();
    let search = mean(&forms, &at);
    let start = search.random(2, 1, 2).unwrap();
    // Only layouts with the first place have a score.
    let found = search.refined(&start, &REFINING, |layout| {
        Ok::<f64, ()>(if layout.contains(&0) { layout.len() as f64 } else { f64::NEG_INFINITY })
    });
    let found = found.unwrap().unwrap();
    assert!(found.actuators.contains(&0) && found.score == 2.0 && found.settled, "{found:?}");
    let mut count: i32 = 0;
    let failed = search.refined(&start, &REFINING, |_| {
        count += 1;
        if count < 4 { Ok(f64::from(count)) } else { Err("cancelled") }
    });
    assert_eq!((failed, count), (Err("cancelled"), 4));
}
