//! The search against all layouts, where there are few.

use crate::bench::{WINDOW, aims, places, plant};
use unripple_core::Point;
use unripple_placement::{Forms, Objective, Search};

#[test]
fn ten_restarts_find_the_best_of_all_layouts() {
    let all = places(2.07e-3);
    let places: Vec<Point> = (0..48).map(|i| all[i * all.len() / 48]).collect();
    let aims = aims(0, 20);
    let forms = Forms::new(&[plant(3e3)], &places, &aims, WINDOW, 0.0).unwrap();
    for objective in [Objective::Mean, Objective::Worst] {
        let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective };
        assert_eq!(search.layouts(4), 194_580.0);
        let best = search.best_of_all(4).unwrap();
        // The figure of all layouts, by another order of sums.
        let again = search.score(best.actuators.clone());
        assert!((best.score / again - 1.0).abs() < 1e-4, "{} {again}", best.score);
        let found = search.restarts(4, 10, 5).unwrap();
        let reached = found.iter().map(|found| found.score).fold(0.0, f64::max);
        assert!(reached <= best.score * 1.0001, "{reached} {}", best.score);
        if objective == Objective::Mean {
            assert!(reached > best.score * 0.9999, "{reached} {}", best.score);
        }
    }
}

#[test]
fn no_certificate_where_layouts_are_too_many_or_none() {
    let places = places(4e-3);
    let aims = aims(0, 4);
    let forms = Forms::new(&[plant(1e3)], &places, &aims, WINDOW, 0.0).unwrap();
    let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
    assert!(search.best_of_all(8).is_none() && search.best_of_all(0).is_none());
    let far = Search { apart: 1.0, ..search };
    assert!(far.best_of_all(2).is_none());
    assert!(far.restarts(2, 1, 1).is_err() && far.each_number(2).is_err());
}

#[test]
fn nearly_all_places_are_chosen_as_fast_as_few() {
    let all = places(2.07e-3);
    let places: Vec<Point> = (0..40).map(|i| all[i * all.len() / 40]).collect();
    let forms = Forms::new(&[plant(1e3)], &places, &aims(0, 4), WINDOW, 0.0).unwrap();
    let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
    // 780 layouts; without the end of each loop some 10^11 sets would be begun.
    let best = search.best_of_all(38).unwrap();
    let found = search.restarts(38, 4, 1).unwrap().into_iter().map(|found| found.score).fold(0.0, f64::max);
    assert!(found <= best.score * 1.0001, "{found} {}", best.score);
}
