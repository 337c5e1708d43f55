//! What is said of a draft against `design` and against an act, each made by itself.

use std::sync::Arc;
use unripple::act::{Act, Level, model, recommended_window};
use unripple::core::{Outline, Point, Shape, Surface};
use unripple::drafting::{Draft, figures};
use unripple::focus::{Options, Target};
use unripple::physics::design;
use unripple::physics::design::papers_surface;

/// A small round film.
fn disc() -> Surface {
    let mut disc = papers_surface();
    disc.outline = Outline::new(Shape::Circle { radius: 0.05 });
    disc.emission.band[1] = 1500.0;
    let places = [(50.0, 8.0), (88.0, 60.0), (20.0, 75.0), (33.0, 22.0)];
    disc.actuators.truncate(places.len());
    disc.actuators.iter_mut().zip(places).for_each(|(a, (x, y))| a.at = Point::from_mm(x, y));
    disc
}

#[test]
fn figures_are_those_that_design_prints() {
    for surface in [papers_surface(), disc()] {
        let alone = design(&surface).unwrap();
        let draft = Draft::of(&surface).unwrap();
        let (printed, shown) = (alone.to_string(), draft.figures());
        for (figure, alone) in shown.iter().zip(figures(&alone)) {
            assert_eq!((figure.key, &figure.text), (alone.key, &alone.text), "{}", surface.name);
            assert!((figure.value / alone.value - 1.0).abs() < 1e-4, "{figure:?} {alone:?}");
            assert!(printed.contains(&figure.text), "{figure:?}");
        }
        let value = |key: &str| shown.iter().find(|f| f.key == key).map(|f| f.value);
        assert_eq!(value("modes"), alone.mode_count_exact.map(|count| count as f64));
        assert!((value("window_recommended").unwrap() / 1e3 / alone.window_recommended_s - 1.0).abs() < 1e-9);
    }
}

#[test]
fn figures_by_law_are_near() {
    let surface = papers_surface();
    let (law, counted) = (Draft::by_law(&surface).unwrap(), Draft::of(&surface).unwrap().figures());
    assert!(law.len() >= 12);
    for law in &law {
        let counted = counted.iter().find(|counted| counted.key == law.key).unwrap();
        // The window is that of statistics until modes are known, and contrast that of the window.
        let near = match law.key {
            "window_recommended" => 0.5,
            "contrast_predicted" | "contrast_endless" => 0.15,
            _ => 0.05,
        };
        assert!((law.value / counted.value - 1.0).abs() < near, "{law:?} {counted:?}");
    }
}

#[test]
fn a_spot_has_the_contrast_of_the_act() {
    for surface in [papers_surface(), disc()] {
        let at = Point::from_mm(47.0, 60.0);
        let responses = model(&surface, None, &[]).unwrap();
        let window = recommended_window(&surface, &responses);
        let options = Options { window, limit: surface.emission.limit, ..Options::default() };
        let (surface, responses) = (&surface, &responses);
        let act =
            Act { surface, responses, targets: &[Target::at(at)], options: &options, level: Level::Limit };
        let alone = &act.run().unwrap().judged.measured.targets[0];
        let draft = Draft::of(surface).unwrap();
        let spot = draft.spot(at, None).unwrap();
        assert_eq!(spot.window, window);
        assert!((spot.contrast.unwrap() / alone.contrast.unwrap() - 1.0).abs() < 1e-9, "{spot:?}");
        assert!((spot.peak_velocity / alone.peak_velocity_m_s - 1.0).abs() < 1e-9, "{spot:?}");
        let other = draft.spot(at, Some(0.5 * window)).unwrap();
        assert!(other.contrast < spot.contrast, "{other:?}");
    }
}

#[test]
fn a_focus_is_evaluated_on_modes_up_to_twice_the_band() {
    let mut film = papers_surface();
    film.emission.band[1] = 1000.0;
    let at = Point::from_mm(47.0, 60.0);
    let draft = Draft::of(&film).unwrap();
    let found = draft.focus(at, Some(0.02)).unwrap();
    assert_eq!(draft.judged().unwrap().1.hz, 2000.0);
    let [known, wide] = [None, Some(2000.0)].map(|hz| model(&film, hz, &[]).unwrap());
    let options = Options { window: 0.02, limit: film.emission.limit, ..Options::default() };
    let (surface, targets, level) = (&film, &[Target::at(at)], Level::default());
    let act = Act { surface, responses: &wide, targets, options: &options, level };
    let alone = act.run_from(&known, &act.readouts()).unwrap();
    assert_eq!(found.drive, alone.drive);
    assert_eq!(found.judged.measured.targets, alone.judged.measured.targets);
    // On its own modes the drive is the same but for its level, and other figures come of it.
    let own = Act { responses: &known, ..act }.run().unwrap();
    assert_eq!(own.focused.drive, found.focused.drive);
    assert_ne!(own.judged.measured.targets, found.judged.measured.targets);
}

#[test]
fn modes_are_solved_for_once() {
    let draft = Draft::of(&disc()).unwrap();
    let first = Arc::clone(draft.responses().unwrap());
    let map = draft.map(Some(5e-3), 6).unwrap();
    assert_eq!(map.contrast.len(), 36);
    assert!(Arc::ptr_eq(&first, draft.responses().unwrap()));
}

#[test]
fn without_modes_there_are_figures_all_the_same() {
    let mut wide = papers_surface();
    wide.outline = Outline::new(Shape::Rectangle { width: 3.0, height: 2.0 });
    wide.emission.band[1] = 20e3;
    let draft = Draft::of(&wide).unwrap();
    let modes = draft.figures().into_iter().find(|f| f.key == "modes").unwrap();
    assert!(modes.label.contains("Weyl") && modes.value > 1e5, "{modes:?}");
    assert!(draft.design().mode_count_exact_reason.is_some());
    let error = draft.spot(Point::from_mm(50.0, 50.0), None).unwrap_err();
    assert!(error.to_string().contains("expected"), "{error}");
    let none = {
        wide.actuators.clear();
        Draft::of(&wide)
    };
    assert!(none.is_err());
}
