//! Places that are searched for by what drives of a method reach: the layout is the best of all where all can be computed, none is worse than
//! the one for time reversal, and the search ends when it is told to.

use std::collections::BTreeSet;
use unripple::act::{Act, Judging, Level, Readouts, model};
use unripple::core::{Actuator, Point, Surface};
use unripple::focus::{Method, Options, Target};
use unripple_tasks::place::{Ask, ByAsk, Second};
use unripple_tasks::{Progress, Report, Silent, SurfaceAsk, TaskError, place};

/// Window of all drives, in s.
const WINDOW: f64 = 15e-3;

/// Targets, in m.
const AT: [[f64; 2]; 2] = [[62e-3, 90e-3], [90e-3, 40e-3]];

/// Places to choose from, in m.
const PLACES: [[f64; 2]; 6] =
    [[12e-3, 20e-3], [20e-3, 138e-3], [75e-3, 9e-3], [139e-3, 60e-3], [110e-3, 140e-3], [10e-3, 90e-3]];

/// Two of the places, in a fifth of the film's band.
fn asked(method: Method, by: ByAsk) -> Ask {
    let surface = SurfaceAsk::Set {
        name: "hudin-2012".into(),
        set: [("drive.band_hz".to_owned(), "[0, 600]".to_owned())].into(),
    };
    Ask {
        surface,
        count: 2,
        places_m: PLACES.to_vec(),
        points_m: AT.to_vec(),
        window_s: Some(WINDOW),
        restarts: 3,
        methods: vec![method],
        by: Some(by),
        ..Ask::default()
    }
}

/// What a search found: the numbers of the places, and the report of the second search.
fn searched(ask: &Ask) -> (BTreeSet<usize>, Second) {
    let report = place::run(ask, &mut Silent).unwrap();
    let text = report.text();
    for part in ["best for time reversal", "search for time reversal: ", "search by it: "] {
        assert!(text.contains(part), "{part:?} in {text}");
    }
    let number = |at: [f64; 2]| {
        let same = |place: &[f64; 2]| (place[0] - at[0]).hypot(place[1] - at[1]) < 1e-9;
        PLACES.iter().position(same).expect("one of the places")
    };
    let second = report.second_search.expect("a second search");
    (report.after.actuators.iter().map(|actuator| number(actuator.at_m)).collect(), second)
}

/// The film with actuators at two of the places.
fn film(places: [usize; 2]) -> Surface {
    let mut film = unripple_store::load_surface("hudin-2012").unwrap();
    film.emission.band = [0.0, 600.0];
    let force = film.actuators[0].clone();
    let put = |i: usize| {
        let [x, y] = PLACES[i];
        Actuator { name: format!("at {i}"), at: Point::new(x, y), ..force.clone() }
    };
    film.actuators = places.map(put).to_vec();
    film
}

/// The mean contrast of drives of the inverse filter from a layout, each computed and evaluated as a focus is.
fn contrast(places: [usize; 2]) -> f64 {
    let film = film(places);
    let known = model(&film, None, &[]).unwrap();
    let (plant, _) = Judging::of(&film, None, |hz| model(&film, Some(hz), &[])).unwrap();
    let on = Readouts::thinned(&plant);
    let options = Options { method: Method::Inverse, window: WINDOW, ..Options::default() };
    let one = |[x, y]: [f64; 2]| {
        let targets = [Target::at(Point::new(x, y))];
        let act = Act {
            surface: &film,
            responses: &plant,
            targets: &targets,
            options: &options,
            level: Level::Limit,
        };
        act.run_from(&known, &on).unwrap().judged.measured.targets[0].contrast.unwrap()
    };
    AT.into_iter().map(one).sum::<f64>() / AT.len() as f64
}

#[test]
fn the_best_of_all_layouts_for_a_method_is_found_where_that_for_time_reversal_is_another() {
    let (found, second) = searched(&asked(Method::Inverse, ByAsk::Contrast));
    let pairs = (0..PLACES.len()).flat_map(|i| (0..i).map(move |j| [j, i]));
    let all: Vec<([usize; 2], f64)> = pairs.map(|pair| (pair, contrast(pair))).collect();
    let best = all.iter().fold(all[0], |best, next| if next.1 > best.1 { *next } else { best });
    assert_eq!(found, BTreeSet::from(best.0), "{all:?}");
    assert!((second.searched.found / best.1 - 1.0).abs() < 1e-4, "{second:?} {best:?}");
    // The one for time reversal is among them.
    let other = |value: f64| (value / second.searched.time_reversal - 1.0).abs() < 1e-4;
    assert!(all.iter().any(|(_, value)| other(*value)), "{second:?} {all:?}");
    assert!(second.searched.time_reversal < second.searched.found, "{second:?}");
    assert_eq!((second.method, second.by, second.searched.targets), ("inverse", "contrast", 2));
    assert!(second.settled && second.layouts <= second.most_layouts, "{second:?}");
}

#[test]
fn no_layout_takes_more_energy_than_the_one_to_begin_with() {
    let ask = asked(Method::Concentrate, ByAsk::EnergyForPeak);
    let (_, second) = searched(&ask);
    assert!(second.searched.found <= second.searched.time_reversal, "{second:?}");
    assert!(second.searched.found > 0.0 && second.evaluated.found > 0.0, "{second:?}");
    // With no layout but that one there is nothing to choose.
    let (_, first) = searched(&Ask { evaluations: Some(1), ..ask });
    assert_eq!((first.layouts, first.most_layouts, first.settled), (1, 1, false));
    assert_eq!(first.searched.found, first.searched.time_reversal);
    assert_eq!(first.searched.time_reversal, second.searched.time_reversal);
}

#[test]
fn results_by_method_have_the_weights_of_the_targets_as_the_search_by_them_has() {
    // More targets than are simulated, of which those that weigh most come last.
    let points_m = (0..8).map(|i| [40e-3 + 10e-3 * f64::from(i), 70e-3]).collect();
    let weights = (1..=8).map(f64::from).collect();
    let ask = Ask {
        points_m,
        weights,
        restarts: 0,
        evaluations: Some(1),
        ..asked(Method::Inverse, ByAsk::Contrast)
    };
    let report = place::run(&ask, &mut Silent).unwrap();
    let (table, second) = (&report.methods[0], report.second_search.expect("a second search"));
    assert!(table.targets < 8, "{table:?}");
    assert_eq!(table.targets, second.evaluated.targets);
    let (mean, found) = (table.after.contrast.expect("a contrast"), second.evaluated.found);
    assert!((mean / found - 1.0).abs() < 1e-4, "{mean} {found}");
}

#[test]
fn one_actuator_at_the_best_of_all_places_is_said_to_be_that() {
    let (found, second) = searched(&Ask { count: 1, ..asked(Method::Inverse, ByAsk::Contrast) });
    assert_eq!((found.len(), second.settled), (1, true), "{second:?}");
    assert_eq!(second.certificate, "every place was evaluated: the best on these places");
    // Without all of them, nothing is known.
    let few = Ask { count: 1, evaluations: Some(2), ..asked(Method::Inverse, ByAsk::Contrast) };
    assert!(searched(&few).1.certificate.starts_with("their number ended the search"));
}

/// Whoever waits goes after two layouts of the second search.
#[derive(Default)]
struct Leaves {
    searching: bool,
    layouts: usize,
}

impl Progress for Leaves {
    fn stage(&mut self, what: &str) {
        self.searching = what.starts_with("search by the felt contrast (dB) of felt: at most");
    }

    fn done(&mut self, _share: f64) {
        self.layouts += usize::from(self.searching);
    }

    fn cancelled(&self) -> bool {
        self.layouts >= 2
    }
}

#[test]
fn a_second_search_that_is_cancelled_ends_before_the_next_layout() {
    let mut leaves = Leaves::default();
    let ended = place::run(&asked(Method::Felt, ByAsk::FeltContrast), &mut leaves);
    assert!(matches!(ended, Err(TaskError::Cancelled)), "{ended:?}");
    assert_eq!(leaves.layouts, 2);
}
