//! The search: how good it is, what it keeps, and that it does not depend on threads.

use crate::bench::{WINDOW, aims, film, places, plant};
use unripple_core::{Actuator, Outline, Point, Shape};
use unripple_placement::{
    Aim, Forms, Objective, PlacementError, Plant, Polish, Rules, Search, figure, reached_each,
};

#[test]
fn placed_actuators_beat_random_ones_on_other_targets() {
    let (plants, places, trained, tested) = ([plant(3e3)], places(2.07e-3), aims(0, 20), aims(20, 60));
    let forms = Forms::new(&plants, &places, &trained, WINDOW, 0.0).unwrap();
    let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
    let at = |layout: &[usize]| layout.iter().map(|a| places[*a]).collect::<Vec<Point>>();
    // The ratios to random layouts that an independent program found.
    for (count, least, least_worst) in [(4, 1.2, 1.1), (8, 1.4, 1.35), (16, 1.6, 1.5)] {
        let random: Vec<_> = search.random(count, 20, 1).unwrap().iter().map(|layout| at(layout)).collect();
        let random = reached_each(&plants, &random, &tested, WINDOW).unwrap();
        let mean = |of: Objective| random.iter().map(|r| figure(r, &tested, of)).sum::<f64>() / 20.0;
        let found = search.restarts(count, 6, 2).unwrap();
        let best = found.into_iter().reduce(|a, b| if b.score > a.score { b } else { a }).unwrap();
        let placed = &reached_each(&plants, &[at(&best.actuators)], &tested, WINDOW).unwrap()[0];
        let ratio = |of: Objective| figure(placed, &tested, of) / mean(of);
        assert!(ratio(Objective::Mean) > least, "{count}: {}", ratio(Objective::Mean));
        assert!(ratio(Objective::Worst) > least_worst, "{count}: {}", ratio(Objective::Worst));
    }
}

#[test]
fn threads_change_nothing() {
    let found = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (plants, places, aims) = ([plant(1e3)], places(4e-3), aims(0, 8));
            let forms = Forms::new(&plants, &places, &aims, WINDOW, 0.5e-3).unwrap();
            let search =
                Search { forms: &forms, at: &places, kept: 0, apart: 5e-3, objective: Objective::Worst };
            (search.restarts(5, 5, 7).unwrap(), search.best_of_all(2), search.each_number(4).unwrap())
        })
    };
    let (one, two) = (found(1), found(2));
    assert_eq!(one, two);
}

#[test]
fn distances_and_actuators_that_stay_are_kept() {
    let (mut surface, force) = film(1e3);
    surface.actuators =
        vec![Actuator { name: "stays".into(), at: Point::from_mm(9.0, 75.0), ..force.clone() }];
    let plants = [Plant::new(surface, &force).unwrap()];
    let (places, aims, apart) = (places(3e-3), aims(0, 8), 30e-3);
    let forms = Forms::new(&plants, &places, &aims, WINDOW, 0.0).unwrap();
    let at: Vec<Point> = [Point::from_mm(9.0, 75.0)].into_iter().chain(places).collect();
    let search = Search { forms: &forms, at: &at, kept: 1, apart, objective: Objective::Mean };
    for found in search.restarts(4, 4, 1).unwrap() {
        assert_eq!((found.actuators[0], found.actuators.len()), (0, 5));
        for (i, a) in found.actuators.iter().enumerate() {
            assert!(found.actuators[..i].iter().all(|b| at[*a].distance(at[*b]) >= apart));
        }
    }
}

#[test]
fn the_polish_keeps_the_rules_and_gains() {
    let (plants, pitch, trained) = ([plant(1500.0)], 6e-3, aims(0, 12));
    let places = places(pitch);
    let rules = Rules { from_rim: [6e-3, 12e-3], ..Rules::default() };
    let forms = Forms::new(&plants, &places, &trained, WINDOW, 0.0).unwrap();
    let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
    let best = search.restarts(4, 2, 1).unwrap().remove(0);
    let grid: Vec<Point> = best.actuators.iter().map(|a| places[*a]).collect();
    let polish = Polish {
        plants: &plants,
        aims: &trained,
        window: WINDOW,
        mounting: 0.0,
        rules: &rules,
        apart: 0.0,
        objective: Objective::Mean,
    };
    let (polished, score) = polish.polished(grid.clone(), pitch).unwrap();
    assert!(score > best.score, "{score} {}", best.score);
    let outline = &plants[0].surface().outline;
    assert!(polished.iter().all(|at| rules.allow(outline, *at)));
    assert!(polished.iter().zip(&grid).all(|(to, from)| to.distance(*from) < 3.0 * pitch));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (plants, places) = ([plant(1e3)], places(4e-3));
    let aim = |weight| Aim { at: Point::from_mm(62.0, 90.0), weight };
    for (window, weight) in
        [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (1e9, 1.0), (30e-3, 0.0), (30e-3, f64::NAN)]
    {
        let found = Forms::new(&plants, &places, &[aim(weight)], window, 0.0);
        assert!(matches!(found, Err(PlacementError::Range(_))), "{window} {weight}");
    }
    let outside = [Point::from_mm(200.0, 10.0)];
    assert!(matches!(
        Forms::new(&plants, &outside, &[aim(1.0)], WINDOW, 0.0),
        Err(PlacementError::Physics(_))
    ));
    let small = unripple_core::Memory::of(1e4);
    let found = small.during(|| Forms::new(&plants, &places, &[aim(1.0)], WINDOW, 0.0));
    assert!(matches!(found, Err(PlacementError::TooLarge { .. })));
    assert!(Objective::Quantile(1.5).check().is_err() && Objective::Quantile(0.1).check().is_ok());
    // A rim band that holds no place of a coarse grid.
    let disc = Outline::new(Shape::Circle { radius: 0.05 });
    assert!(Rules { from_rim: [1e-9, 2e-9], ..Rules::default() }.grid(&disc, 1e-2).unwrap().is_empty());
}
