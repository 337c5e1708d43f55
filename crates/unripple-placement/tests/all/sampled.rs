//! Choices of a library's actuators against drives of exactly these actuators, evaluated at the points of the library.

use crate::bench::film;
use unripple_core::{Actuator, Point, Responses, SampledResponses};
use unripple_field::Field;
use unripple_focus::{Options, Target, focus};
use unripple_physics::{ResponseOptions, responses, sample};
use unripple_placement::{Aim, Forms, Objective, PlacementError, Search, reached_from};

/// Window in seconds, and samples of the responses: some more than it has.
const WINDOW: f64 = 20e-3;
const SAMPLES: usize = 140;

/// Places of ten forces, in mm.
const PLACES: [(f64, f64); 10] = [
    (12.0, 31.0),
    (9.0, 84.0),
    (40.0, 140.0),
    (95.0, 137.0),
    (141.0, 106.0),
    (138.0, 44.0),
    (103.0, 11.0),
    (50.0, 9.0),
    (25.0, 118.0),
    (120.0, 80.0),
];

/// Responses of the film up to 700 Hz from ten forces to 36 points.
fn library() -> SampledResponses {
    let (mut surface, force) = film(700.0);
    // As fast as its few modes need.
    surface.emission.rate = 6000.0;
    let placed = |(i, (x, y)): (usize, &(f64, f64))| Actuator {
        at: Point::from_mm(*x, *y),
        name: format!("p{i}"),
        ..force.clone()
    };
    surface.actuators = PLACES.iter().enumerate().map(placed).collect();
    let Responses::Modal(modal) = responses(&surface, &ResponseOptions::default()).unwrap() else {
        panic!("a model has modes")
    };
    let at = |i: usize| 15.0 + 24.0 * i as f64;
    let points: Vec<Point> = (0..36).map(|i| Point::from_mm(at(i % 6), at(i / 6))).collect();
    sample(&modal, &points, SAMPLES)
}

/// The library with some of its actuators alone.
fn only(library: &SampledResponses, ports: &[usize]) -> Responses {
    let names = ports.iter().map(|port| library.ports[*port].clone()).collect();
    let rows = (0..library.points.len()).flat_map(|point| ports.iter().map(move |port| (point, *port)));
    let data = rows.flat_map(|(point, port)| library.response(port, point).to_vec()).collect();
    let (points, conditions) = (library.points.clone(), library.conditions.clone());
    Responses::Sampled(SampledResponses::new(names, points, conditions, SAMPLES, data).unwrap())
}

/// Contrast at the focal instant, and energy for a peak of 1 m/s, of the drive to a target from some actuators.
fn driven(library: &SampledResponses, ports: &[usize], at: Point) -> [f64; 2] {
    let responses = only(library, ports);
    let options = Options { window: WINDOW, ..Options::default() };
    let drive = focus(&responses, &[Target::at(at)], &options).unwrap().drive;
    let then = Field::new(&responses, &drive, 8.0).unwrap().at_instant(WINDOW, &[at], &[at]).unwrap();
    [then.contrast().unwrap(), drive.energy() / then.velocity.powi(2)]
}

/// Three targets, all of them points of the library, with weights.
fn aims(library: &SampledResponses) -> Vec<Aim> {
    [(8, 1.0), (15, 2.0), (28, 1.0)].map(|(point, weight)| Aim { at: library.points[point], weight }).to_vec()
}

/// All choices of three actuators out of ten.
fn triples() -> Vec<Vec<usize>> {
    let all = (0..10).flat_map(|a| (a + 1..10).flat_map(move |b| (b + 1..10).map(move |c| vec![a, b, c])));
    all.collect()
}

#[test]
fn the_best_choice_of_a_librarys_actuators_is_that_of_their_drives() {
    let library = library();
    let aims = aims(&library);
    let ports: Vec<usize> = (0..10).collect();
    let forms = Forms::sampled(&library, &ports, &aims, WINDOW).unwrap();
    let at: Vec<Point> = library.ports.iter().map(|port| port.at).collect();
    let search = Search { forms: &forms, at: &at, kept: 0, apart: 0.0, objective: Objective::Mean };
    let mut best = (Vec::new(), 0.0);
    let triples = triples();
    assert_eq!(triples.len(), 120);
    for triple in triples {
        let all: Vec<[f64; 2]> = aims.iter().map(|aim| driven(&library, &triple, aim.at)).collect();
        for ([contrast, energy], reached) in all.iter().zip(reached_from(&forms, &triple)) {
            assert!((reached.contrast / contrast - 1.0).abs() < 1e-4, "{triple:?}: {reached:?} {contrast}");
            assert!((reached.energy / energy - 1.0).abs() < 1e-4, "{triple:?}: {reached:?} {energy}");
        }
        let mean = (all[0][0] + 2.0 * all[1][0] + all[2][0]) / 4.0;
        assert!((search.score(triple.clone()) / mean - 1.0).abs() < 1e-3, "{triple:?}");
        if mean > best.1 {
            best = (triple, mean);
        }
    }
    let found = search.best_of_all(3).unwrap();
    assert_eq!(found.actuators, best.0);
    assert!((found.score / best.1 - 1.0).abs() < 1e-3, "{} {}", found.score, best.1);
    let reached = search.restarts(3, 10, 1).unwrap();
    let reached = reached.into_iter().map(|found| found.score).fold(0.0, f64::max);
    assert!((reached / best.1 - 1.0).abs() < 1e-3, "{reached} {}", best.1);
}

#[test]
fn a_part_of_the_actuators_has_their_part_of_the_forms() {
    let library = library();
    let aims = aims(&library);
    let forms = Forms::sampled(&library, &[7, 2, 5], &aims, WINDOW).unwrap();
    assert_eq!((forms.actuators(), forms.cases()), (3, 3));
    for (reached, aim) in reached_from(&forms, &[0, 2]).iter().zip(&aims) {
        let [contrast, _] = driven(&library, &[7, 5], aim.at);
        assert!((reached.contrast / contrast - 1.0).abs() < 1e-4, "{reached:?} {contrast}");
    }
}

#[test]
fn the_unit_of_the_responses_does_not_matter() {
    let library = library();
    let aims = aims(&library);
    let data: Vec<f32> = library.data().iter().map(|h| 1e-15 * h).collect();
    let (ports, points) = (library.ports.clone(), library.points.clone());
    let small = SampledResponses::new(ports, points, library.conditions.clone(), SAMPLES, data).unwrap();
    let [usual, small] = [&library, &small].map(|library| {
        reached_from(&Forms::sampled(library, &[0, 4, 9], &aims, WINDOW).unwrap(), &[0, 1, 2])
    });
    for (usual, small) in usual.iter().zip(&small) {
        assert!((small.contrast / usual.contrast - 1.0).abs() < 1e-4, "{usual:?} {small:?}");
        assert!((small.energy / usual.energy * 1e-30 - 1.0).abs() < 1e-4, "{usual:?} {small:?}");
    }
}

#[test]
fn what_a_library_does_not_hold_is_refused() {
    let library = library();
    let aim = |at| [Aim { at, weight: 1.0 }];
    let there = aim(library.points[8]);
    let forms = |ports: &[usize], aims: &[Aim], window| Forms::sampled(&library, ports, aims, window);
    // The responses are as long as their last sample is late.
    assert!(forms(&[0], &there, (SAMPLES - 1) as f64 / 6000.0).is_ok());
    for window in [SAMPLES as f64 / 6000.0, 0.0, 1e-6, -1.0, f64::NAN, 1e9] {
        assert!(matches!(forms(&[0], &there, window), Err(PlacementError::Range(_))), "{window}");
    }
    assert!(matches!(forms(&[10], &there, WINDOW), Err(PlacementError::Range(_))));
    let light = [Aim { at: library.points[8], weight: 0.0 }];
    assert!(matches!(forms(&[0], &light, WINDOW), Err(PlacementError::Range(_))));
    let far = Point::from_mm(500.0, 500.0);
    assert!(matches!(forms(&[0], &aim(far), WINDOW), Err(PlacementError::Target { at, .. }) if at == far));
    // Without a point outside the focal disc, and without an actuator that moves the target.
    let lone = library.select(&[8]).unwrap();
    let found = Forms::sampled(&lone, &[0], &there, WINDOW);
    assert!(matches!(found, Err(PlacementError::Target { .. })), "{found:?}");
    let (ports, points) = (library.ports.clone(), library.points.clone());
    let silent = vec![0.0; library.data().len()];
    let dead = SampledResponses::new(ports, points, library.conditions.clone(), SAMPLES, silent).unwrap();
    let found = Forms::sampled(&dead, &[0, 1], &there, WINDOW);
    assert!(matches!(found, Err(PlacementError::Target { .. })), "{found:?}");
}
