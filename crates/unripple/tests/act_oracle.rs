//! An act against its definitions, and against what is known of the paper's surface.

use unripple::act::{Act, ActError, Level, LevelKind, model, recommended_window};
use unripple::core::{Point, Responses, Surface};
use unripple::field::{Aim, MeasureOptions, measure};
use unripple::focus::{Options, Target, focus};
use unripple::physics::design::papers_surface;

fn paper() -> (Surface, Responses) {
    let surface = papers_surface();
    let responses = model(&surface, None, &[]).unwrap();
    (surface, responses)
}

#[test]
fn figures_are_those_of_the_definitions() {
    let (surface, responses) = paper();
    let targets = [Target::at(Point::from_mm(62.0, 90.0))];
    let options = Options { limit: surface.emission.limit, ..Options::default() };
    let act = Act {
        surface: &surface,
        responses: &responses,
        targets: &targets,
        options: &options,
        level: Level::Limit,
    };
    let acted = act.run().unwrap();
    // Computed independently, in Python, from dense matrices.
    let found = &acted.judged.measured.targets[0];
    for (what, found, expected) in [
        ("peak velocity", found.peak_velocity_m_s, 171.672_134),
        ("contrast", found.contrast.unwrap(), 25.074_560_6),
        ("background contrast", found.background_contrast.unwrap(), 27.630_007_8),
    ] {
        assert!((found / expected - 1.0).abs() < 2e-5, "{what}: {found} {expected}");
    }
    let drive = focus(&responses, &targets, &options).unwrap().drive.as_emitted();
    let aim = Aim { points: targets[0].points.clone(), instant: 30e-3 };
    let direct = measure(&responses, &drive, &[aim], &MeasureOptions::default()).unwrap();
    assert_eq!(direct.targets, acted.judged.measured.targets);
    let report = acted.report(&surface, &options);
    assert_eq!((report.method, report.window_s), (Some("time-reversal"), Some(30e-3)));
    assert!(report.notes.iter().any(|note| note.topic == "linear theory"), "{:?}", report.notes);
}

#[test]
fn levels_are_met_and_those_beyond_the_limit_refused() {
    let (surface, responses) = paper();
    let targets =
        [Target::at(Point::from_mm(40.0, 50.0)), Target::at(Point::from_mm(100.0, 90.0)).with_gain(0.5)];
    let options = Options { limit: surface.emission.limit, ..Options::default() };
    let act =
        |level| Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
    let peak = act(Level::Peak(40e-6)).run().unwrap();
    assert!((peak.judged.measured.targets[0].peak_displacement_m.abs() / 40e-6 - 1.0).abs() < 1e-6);
    let felt = act(Level::Felt(10.0)).run().unwrap();
    assert!((felt.judged.measured.targets[0].felt_level_db.unwrap() - 10.0).abs() < 1e-4);
    for (level, kind) in [
        (Level::Peak(1.0), LevelKind::Peak),
        (Level::Peak(-1e-6), LevelKind::Peak),
        (Level::Peak(f64::NAN), LevelKind::Peak),
        (Level::Felt(200.0), LevelKind::Felt),
        (Level::Felt(f64::NAN), LevelKind::Felt),
    ] {
        let focused = focus(&responses, &targets, &options).unwrap();
        let error = act(level).send(&focused).unwrap_err();
        assert!(matches!(&error, ActError::Level { what, .. } if *what == kind), "{error}");
        assert!(error.to_string().contains("expected") && !error.is_failed_work(), "{error}");
    }
}

#[test]
fn the_window_is_that_of_the_modes_or_as_long_as_samples_last() {
    let (surface, responses) = paper();
    let own = recommended_window(&surface, &responses);
    assert!((own - 0.042_170_404).abs() < 1e-8, "{own}");
    let Responses::Modal(modal) = &responses else { panic!("modes") };
    let short = unripple::physics::sample(modal, &[Point::from_mm(62.0, 90.0)], 961);
    assert_eq!(recommended_window(&surface, &Responses::Sampled(short)), 0.02);
}
