//! Layouts that bear errors of their places.

use crate::bench::{WINDOW, aims, places, plant};
use unripple_core::{Point, Random};
use unripple_placement::{Forms, Objective, Search, figure, reached_each};

/// Error along each axis, in metres.
const ERROR: f64 = 1e-3;

#[test]
fn a_layout_that_bears_errors_beats_the_nominal_one_in_200_builds() {
    let (plants, places, trained, tested) = ([plant(3e3)], places(2.07e-3), aims(0, 20), aims(20, 30));
    let mut random = Random::seeded(3);
    let offsets: Vec<[f64; 2]> =
        (0..200 * 8).map(|_| [random.between(-ERROR, ERROR), random.between(-ERROR, ERROR)]).collect();
    let built = |layout: &[usize]| -> f64 {
        let builds: Vec<Vec<Point>> = (0..200)
            .map(|b| {
                let off = |(i, a): (usize, &usize)| {
                    let [x, y] = offsets[8 * b + i];
                    Point::new(places[*a].x + x, places[*a].y + y)
                };
                layout.iter().enumerate().map(off).collect()
            })
            .collect();
        let reached = reached_each(&plants, &builds, &tested, WINDOW).unwrap();
        reached.iter().map(|build| figure(build, &tested, Objective::Mean)).sum::<f64>() / 200.0
    };
    let best = |mounting: f64| {
        let forms = Forms::new(&plants, &places, &trained, WINDOW, mounting).unwrap();
        let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
        let found = search.restarts(8, 6, 1).unwrap();
        let best = found.into_iter().reduce(|a, b| if b.score > a.score { b } else { a }).unwrap();
        (built(&best.actuators), best.score)
    };
    let ((nominal, at_best), (robust, expected)) = (best(0.0), best(ERROR));
    assert!(robust > nominal, "{robust} {nominal}");
    // What is expected of errors is less than without them, and near what builds reach on targets placed for.
    assert!(expected < at_best && (robust / expected - 1.0).abs() < 0.1, "{robust} {expected} {at_best}");
}
