//! Maps of contrast against acts at their places, one by one.

use unripple::act::{Act, ActError, Level, model};
use unripple::contrast_map::{ContrastMap, MapOptions, contrast_map};
use unripple::core::{Actuator, ActuatorKind, CoilDrive, Outline, Point, Responses, Shape, Surface};
use unripple::focus::{Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::sample;

fn exact(surface: &Surface, responses: &Responses, at: Point, window: f64) -> f64 {
    let options = Options { window, ..Options::default() };
    let act = Act { surface, responses, targets: &[Target::at(at)], options: &options, level: Level::Limit };
    act.run().unwrap().judged.measured.targets[0].contrast.unwrap()
}

/// Cells of a map that have a contrast, picked by a seeded generator.
fn picked(map: &ContrastMap, count: usize) -> Vec<usize> {
    let known: Vec<usize> = (0..map.contrast.len()).filter(|c| map.contrast[*c].is_some()).collect();
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        known[(state >> 33) as usize % known.len()]
    };
    (0..count).map(|_| next()).collect()
}

/// Rms and largest of the relative errors of a map at some of its places.
fn errors(surface: &Surface, options: &MapOptions, count: usize) -> [f64; 2] {
    let responses = model(surface, None, &[]).unwrap();
    let map = contrast_map(&responses, options).unwrap();
    let error = |cell: usize| {
        let exact = exact(surface, &responses, map.grid.centre(cell), options.window);
        (map.contrast[cell].unwrap() / exact - 1.0).abs()
    };
    let errors: Vec<f64> = picked(&map, count).into_iter().map(error).collect();
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / count as f64).sqrt();
    [rms, errors.iter().copied().fold(0.0, f64::max)]
}

/// A small film: quick to measure whole.
fn small() -> Surface {
    let mut film = papers_surface();
    film.outline = Outline::new(Shape::Rectangle { width: 0.1, height: 0.06 });
    let keep = [(12.0, 31.0), (40.0, 6.0), (93.0, 22.0), (70.0, 55.0)];
    film.actuators.truncate(keep.len());
    film.actuators.iter_mut().zip(keep).for_each(|(a, (x, y))| a.at = Point::from_mm(x, y));
    film.emission.band[1] = 2000.0;
    film
}

#[test]
fn on_the_grid_of_figures_the_map_is_exact() {
    for window in [5e-3, 0.0211] {
        let [rms, worst] = errors(&small(), &MapOptions { window, across: 13, cells: 8.0 }, 6);
        assert!(rms < 2e-5 && worst < 5e-5, "{window}: {rms} {worst}");
    }
}

#[test]
fn by_default_the_map_of_the_papers_surface_is_within_two_per_cent() {
    let [rms, worst] = errors(&papers_surface(), &MapOptions::default(), 5);
    assert!(rms < 0.02 && worst < 0.05, "{rms} {worst}");
}

/// Coils that a voltage drives: loaded modes, in quadrature too, and overdamped ones.
#[test]
fn loaded_modes_have_their_map() {
    let mut film = small();
    film.emission.band[1] = 1000.0;
    let kind = ActuatorKind::MovingMagnet {
        force_constant: 6.0,
        resistance: 6.2,
        inductance: 1.9e-3,
        moving_mass: 0.3e-3,
        driven_by: CoilDrive::Voltage,
    };
    film.actuators.iter_mut().for_each(|a| *a = Actuator { kind, ..a.clone() });
    let [rms, worst] = errors(&film, &MapOptions { window: 8e-3, across: 9, cells: 8.0 }, 5);
    assert!(rms < 2e-5 && worst < 5e-5, "{rms} {worst}");
}

#[test]
fn a_round_film_has_its_map_inside_the_rim_only() {
    let mut disc = small();
    disc.outline = Outline::new(Shape::Circle { radius: 0.05 });
    disc.emission.band[1] = 1000.0;
    let places = [(50.0, 8.0), (88.0, 60.0), (20.0, 75.0), (33.0, 22.0)];
    disc.actuators.iter_mut().zip(places).for_each(|(a, (x, y))| a.at = Point::from_mm(x, y));
    let options = MapOptions { window: 10e-3, across: 11, cells: 8.0 };
    let map = contrast_map(&model(&disc, None, &[]).unwrap(), &options).unwrap();
    let inside = |cell: usize| disc.outline.contains(map.grid.centre(cell));
    assert!((0..11 * 11).all(|cell| map.contrast[cell].is_some() == inside(cell)));
    assert!(map.contrast.iter().flatten().count() > 80 && map.contrast[0].is_none());
    let [rms, worst] = errors(&disc, &options, 4);
    assert!(rms < 2e-5 && worst < 5e-5, "{rms} {worst}");
}

#[test]
fn nothing_outside_the_focal_disc_is_no_contrast() {
    let mut film = small();
    // One mode.
    film.emission.band[1] = 355.0;
    let responses = model(&film, None, &[]).unwrap();
    assert!(4.0 / 3.0 * responses.conditions().lambda_min > 0.12);
    let map = contrast_map(&responses, &MapOptions { window: 5e-3, across: 7, cells: 8.0 }).unwrap();
    assert!(map.contrast.iter().all(Option::is_none), "{:?}", map.contrast);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let film = small();
    let responses = model(&film, None, &[]).unwrap();
    let good = MapOptions { window: 5e-3, across: 5, cells: 2.0 };
    for bad in [
        MapOptions { window: 0.0, ..good },
        MapOptions { window: f64::NAN, ..good },
        MapOptions { window: 1e9, ..good },
        MapOptions { window: 1e-6, ..good },
        MapOptions { across: 0, ..good },
        MapOptions { across: 5000, ..good },
        MapOptions { cells: f64::NAN, ..good },
        MapOptions { cells: 1e9, ..good },
    ] {
        let error = contrast_map(&responses, &bad).unwrap_err();
        assert!(error.to_string().contains("expected") && error.to_string().contains("found"), "{error}");
    }
    let Responses::Modal(modal) = &responses else { panic!("modes") };
    let stored = Responses::Sampled(sample(modal, &[Point::from_mm(50.0, 30.0)], 100));
    assert!(matches!(contrast_map(&stored, &good), Err(ActError::NeedsModes { .. })));
}
