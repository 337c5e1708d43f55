//! How loud drives are, and how like their targets, as reports say it.

use unripple::act::{Act, Hearing, LISTEN_M, Level, Readouts, Report, model};
use unripple::core::{Point, Responses, Surface};
use unripple::focus::{Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::sample;

/// The paper's film with a band up to 800 Hz, at a sample rate as far above it as its own, and its responses.
fn film() -> (Surface, Responses) {
    let mut surface = papers_surface();
    (surface.emission.band, surface.emission.rate) = ([0.0, 800.0], 12.8e3);
    let responses = model(&surface, None, &[]).unwrap();
    (surface, responses)
}

fn options() -> Options {
    Options { window: 20e-3, ..Options::default() }
}

fn report((surface, responses): &(Surface, Responses), target: Target, level: Level) -> Report {
    let (targets, options) = ([target], options());
    let act = Act { surface, responses, targets: &targets, options: &options, level };
    act.run().unwrap().report(surface, &options)
}

fn target() -> Target {
    Target::at(Point::from_mm(62.0, 90.0))
}

#[test]
fn a_single_focus_has_an_exposure_level_that_follows_its_drive() {
    let film = film();
    let [low, high] = [10e-6, 20e-6].map(|peak| report(&film, target(), Level::Peak(peak)));
    let [low_db, high_db] = [&low, &high].map(|report| {
        let sound = report.sound.as_ref().unwrap();
        assert_eq!((sound.a_weighted_level_db, sound.level_db, &sound.unknown), (None, None, &None));
        assert_eq!(sound.at_m, [0.075, 0.075, LISTEN_M]);
        [sound.a_weighted_exposure_db, sound.exposure_db, sound.peak_db].map(Option::unwrap)
    });
    for (low, high) in low_db.iter().zip(high_db) {
        assert!((high - low - 20.0 * 2f64.log10()).abs() < 1e-4, "{low} {high}");
    }
    // Below 1 kHz the weighting only takes away.
    assert!(low_db[0] < low_db[1], "{low_db:?}");
    for text in [low.text(), low.markdown()] {
        let line = format!("sound 0.3 m above the middle: {:.1} dB(A) sound exposure level", low_db[0]);
        assert!(text.contains(&line) && text.contains("rigid baffle"), "{text}");
        assert!(text.contains("structural similarity: "), "{text}");
    }
}

#[test]
fn a_repeated_focus_has_the_mean_level_of_its_exposures() {
    let (film, hz) = (film(), 2.0);
    let once = report(&film, target(), Level::Peak(10e-6)).sound.unwrap();
    let repeated = report(&film, target().repeated(hz), Level::Peak(10e-6)).sound.unwrap();
    assert_eq!(repeated.a_weighted_exposure_db, None);
    let expected = once.a_weighted_db().unwrap() + 10.0 * hz.log10();
    let found = repeated.a_weighted_level_db.unwrap();
    // Half a second apart, hardly anything is left of one pulse at the next.
    assert!((found - expected).abs() < 0.2, "{found} dB, expected {expected} dB");
    assert!((repeated.peak_db.unwrap() - once.peak_db.unwrap()).abs() < 0.2, "{repeated:?} {once:?}");
}

#[test]
fn farther_away_it_is_less_loud() {
    let (surface, responses) = film();
    let (targets, options) = ([target()], options());
    let act = Act {
        surface: &surface,
        responses: &responses,
        targets: &targets,
        options: &options,
        level: Level::Peak(10e-6),
    };
    let near = act.run().unwrap();
    let far = act.run_on(&Readouts::of(&responses).heard_at(4.0)).unwrap().judged.sound.unwrap();
    let own = Hearing::new(&surface, &responses, 4.0).unwrap().sound(&near.drive, None).unwrap();
    assert_eq!(far, own);
    let [near, far] = [near.judged.sound.unwrap(), far].map(|sound| sound.exposure_db.unwrap());
    // A point source would lose 22.5 dB.
    assert!((12.0..30.0).contains(&(near - far)), "{near} {far}");
    assert!(Hearing::new(&surface, &responses, 0.0).is_err());
}

#[test]
fn a_library_has_no_level_and_says_why() {
    let (surface, responses) = film();
    let Responses::Modal(modal) = &responses else { panic!("modes") };
    let lattice: Vec<Point> = (0..144)
        .map(|i| Point::from_mm(7.0 + 12.0 * f64::from(i % 12), 7.0 + 12.0 * f64::from(i / 12)))
        .collect();
    let stored = Responses::Sampled(sample(modal, &lattice, 600));
    let found = report(&(surface, stored), Target::at(lattice[65]), Level::Limit);
    let sound = found.sound.as_ref().unwrap();
    assert_eq!((sound.a_weighted_db(), sound.peak_db), (None, None));
    assert!(sound.unknown.as_ref().is_some_and(|why| why.contains("points of a library")), "{sound:?}");
    assert!(found.text().contains("above the middle: unknown ("), "{}", found.text());
    assert_eq!(found.ssim, None);
}

#[test]
fn without_a_scale_images_are_alike_and_levels_unknown() {
    let report = report(&film(), target(), Level::Limit);
    let alike = report.ssim.unwrap();
    assert!((0.0..1.0).contains(&alike.peak_velocity) && alike.rms_velocity < 1.0, "{alike:?}");
    assert!((alike.target_gaussian_m - report.focal_radius_m / 3.0).abs() < 1e-12);
    let unscaled = report.without_scale();
    assert_eq!(unscaled.ssim, Some(alike));
    let sound = unscaled.sound.unwrap();
    assert!(sound.a_weighted_db().is_none() && sound.peak_db.is_none());
    assert!(sound.unknown.is_some_and(|why| why.contains("scale")));
}
