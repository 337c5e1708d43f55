//! An act against its definitions, and against what is known of the paper's surface.

use unripple::act::{
    Act, ActError, DecidedBy, Level, LevelKind, chosen_window, model, recommended_window, windows,
};
use unripple::core::{ActuatorKind, CoilDrive, Edge, Edges, Outline, Point, Responses, Shape, Surface};
use unripple::field::{Aim, MeasureOptions, measure};
use unripple::focus::{Focuser, Method, Options, Shaping, Target, focus};
use unripple::physics::design::{Windows, papers_surface};

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
        let focuser = Focuser::new(&responses, &options).unwrap();
        let focused = focuser.focus(&targets).unwrap();
        let act = act(level);
        let error = act.send(&focuser, focused, &act.readouts()).unwrap_err();
        assert!(matches!(&error, ActError::Level { what, .. } if *what == kind), "{error}");
        assert!(error.to_string().contains("expected") && !error.is_failed_work(), "{error}");
    }
}

/// `limited` at a level given, by another route: the push whose drive at the limit has that level.
#[test]
fn limited_is_solved_for_the_level_asked() {
    let (surface, responses) = paper();
    let targets = [Target::at(Point::from_mm(62.0, 90.0))];
    let with = |push: f64, level: Level| {
        let options = Options { method: Method::Limited, push, ..Options::default() };
        let act =
            Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
        act.run().unwrap()
    };
    let pushed = with(0.25, Level::Limit);
    let figures = &pushed.judged.measured.targets[0];
    let asked = with(0.6, Level::Peak(figures.peak_displacement_m.abs()));
    let found = &asked.judged.measured.targets[0];
    assert_eq!([asked.focused.shaping, pushed.focused.shaping], [Shaping::Shaped; 2]);
    assert!((found.peak_velocity_m_s / figures.peak_velocity_m_s - 1.0).abs() < 1e-5);
    assert!((found.contrast.unwrap() / figures.contrast.unwrap() - 1.0).abs() < 1e-3);
    // Scaled down from its own push it would have been worse.
    let scaled = with(0.6, Level::Limit);
    assert!(found.contrast.unwrap() > 1.2 * scaled.judged.measured.targets[0].contrast.unwrap());
    assert!(asked.drive.peak() <= 1.0 && asked.judged.notes.iter().all(|note| note.topic != "method"));
    // Far below, the limit does not bind.
    let low = with(0.6, Level::default());
    assert_eq!(low.focused.shaping, Shaping::Unshaped);
    assert!(low.judged.notes.iter().any(|note| note.topic == "method"));
}

#[test]
fn a_sheet_of_which_nothing_is_known_is_driven_to_its_limit_and_that_is_said() {
    let (mut surface, responses) = paper();
    let targets = [Target::at(Point::from_mm(62.0, 90.0))];
    let options = Options::default();
    (surface.sheet.thickness, surface.sheet.strength, surface.sheet.tension) = (0.0, None, 0.0);
    let level = Level::default();
    let act = Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
    let acted = act.run().unwrap();
    assert_eq!((acted.strength.decided_by, acted.drive.peak()), (DecidedBy::Limit, 1.0));
    let note = acted.judged.notes.iter().find(|note| note.topic == "level").unwrap();
    assert!(!note.text.contains("  "), "{}", note.text);
}

#[test]
fn each_limit_has_its_headroom() {
    let (surface, responses) = paper();
    let targets = [Target::at(Point::from_mm(62.0, 90.0))];
    let options = Options { rms_limit: Some(0.02), total_rms: Some(0.03), ..Options::default() };
    let level = Level::default();
    let act = Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
    let acted = act.run().unwrap();
    let rms = |c: &Vec<f64>| (c.iter().map(|d| d * d).sum::<f64>() / c.len() as f64).sqrt();
    let channels = acted.drive.channels();
    let most = channels.iter().map(rms).fold(0.0, f64::max);
    let together = channels.iter().map(|c| rms(c).powi(2)).sum::<f64>().sqrt();
    let expected = [("peak", 1.0 / acted.drive.peak()), ("rms", 0.02 / most), ("total rms", 0.03 / together)];
    for (limit, (name, below)) in acted.strength.limits.iter().zip(expected) {
        assert_eq!(limit.limit, name);
        assert!((limit.below / below - 1.0).abs() < 1e-9 && limit.below > 1.0, "{limit:?}");
    }
    let least = expected.into_iter().map(|(_, below)| below).fold(f64::INFINITY, f64::min);
    assert!((acted.strength.below_limit / least - 1.0).abs() < 1e-9);
    let text = acted.report(&surface, &options).text();
    assert!(text.contains("below the rms limit of 0.02 N"), "{text}");
}

/// The traces of a repeated drive show its last pulse whole. What is evaluated ends with the drive, as before.
#[test]
fn a_repeated_drive_is_traced_until_half_a_window_after_its_last_focus() {
    let (surface, responses) = paper();
    let pulsed = |x: f64, y: f64, hz: f64| Target::at(Point::from_mm(x, y)).repeated(hz);
    let targets = [pulsed(62.0, 90.0, 50.0), pulsed(100.0, 60.0, 20.0)];
    let options = Options { window: 20e-3, ..Options::default() };
    let level = Level::Limit;
    let act = Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
    let focuser = Focuser::new(&responses, &options).unwrap();
    let on = act.readouts();
    let sent = act.send(&focuser, focuser.focus(&targets).unwrap(), &on).unwrap();
    let (rate, last) = (sent.drive.rate(), sent.drive.samples() - 1);
    // The second target is in focus at the drive's last sample.
    let [window, period] = [20e-3 * rate, rate / 20.0].map(|samples| samples.round() as usize);
    assert_eq!((last - window) % period, 0);
    assert_eq!(sent.until, last as f64 / rate);
    let judged = act.judge(&sent, &on).unwrap();
    for trace in &judged.traces {
        assert_eq!(trace.velocity.len(), last + window / 2 + 1);
    }
    let span = judged.measured.targets[1].span_s;
    assert!((span[1] - sent.until).abs() < 0.5 / rate, "{span:?}");
    // A single pulse is traced as long as it is evaluated.
    let once = [Target::at(Point::from_mm(62.0, 90.0))];
    let act = Act { targets: &once, ..act };
    let sent = act.send(&focuser, focuser.focus(&once).unwrap(), &on).unwrap();
    assert_eq!((sent.until, sent.traced), (40e-3, 40e-3));
}

/// Contrast and other ratios do not depend on the level; rounding to float32 is all that differs, and is left out here.
#[test]
fn ratios_do_not_depend_on_the_level() {
    let (_, responses) = paper();
    let targets = [Target::at(Point::from_mm(62.0, 90.0))];
    for method in [Method::TimeReversal, Method::OneBit, Method::Inverse, Method::Concentrate, Method::Felt] {
        let options = Options { method, window: 20e-3, ..Options::default() };
        let focuser = Focuser::new(&responses, &options).unwrap();
        let figures = |share: f64| {
            let drive = focuser.focus_at(&targets, share).unwrap().drive;
            let aim = Aim { points: targets[0].points.clone(), instant: 20e-3 };
            let measured = measure(&responses, &drive, &[aim], &MeasureOptions::default()).unwrap();
            let found = &measured.targets[0];
            [found.contrast, found.background_contrast, found.worst_spot, found.displacement_contrast]
                .map(Option::unwrap)
        };
        // A power of two leaves every digit, another share all but the last.
        assert_eq!(figures(1.0), figures(1.0 / 256.0), "{method}");
        for (a, b) in figures(1.0).into_iter().zip(figures(3.7e-3)) {
            assert!((a / b - 1.0).abs() < 1e-6, "{method}: {a} {b}");
        }
    }
}

#[test]
fn the_window_is_that_of_the_design_or_as_long_as_samples_last() {
    let (surface, responses) = paper();
    let own = recommended_window(&surface, &responses);
    let design = unripple::physics::design(&surface).unwrap();
    assert_eq!(own, design.window_recommended_s);
    let Responses::Modal(modal) = &responses else { panic!("modes") };
    let short = unripple::physics::sample(modal, &[Point::from_mm(62.0, 90.0)], 961);
    let chosen = chosen_window(&surface, &Responses::Sampled(short));
    assert_eq!(chosen.seconds, 0.02);
    assert!(chosen.why.starts_with("the longest that the responses last"), "{}", chosen.why);
    assert!(chosen.contrast < 0.9 * chosen.largest, "{chosen:?}");
}

#[test]
fn the_window_is_the_same_from_responses_at_hand_and_from_modes_of_its_own() {
    let mut panel = papers_surface();
    panel.actuators.truncate(3);
    for actuator in &mut panel.actuators {
        actuator.contact_radius = 2e-3;
        actuator.kind = ActuatorKind::MovingMagnet {
            force_constant: 0.2,
            resistance: 8.0,
            inductance: 0.0,
            moving_mass: 1e-4,
            driven_by: CoilDrive::Current,
        };
    }
    let mut drum = papers_surface();
    drum.outline = Outline::new(Shape::Circle { radius: 0.08 }).with_edges(Edges::All(Edge::Clamped));
    let mut stadium = papers_surface();
    stadium.outline = Outline::new(Shape::Stadium { straight: 0.03, radius: 0.06 });
    for round in [&mut drum, &mut stadium] {
        let (width, height) = round.outline.extent();
        let inwards = |at: f64, side: f64| 0.5 * side + 0.6 * (at - 0.075);
        for actuator in &mut round.actuators {
            actuator.at = Point::new(inwards(actuator.at.x, width), inwards(actuator.at.y, height));
        }
    }
    for mut surface in [papers_surface(), panel, drum, stadium] {
        surface.emission.band = [300.0, 1500.0];
        let responses = model(&surface, None, &[]).unwrap();
        let [at_hand, own] = [windows(&surface, &responses), Windows::of(&surface)].map(|w| w.recommended());
        assert_eq!(at_hand, own);
        assert_eq!(own.seconds, unripple::physics::design(&surface).unwrap().window_recommended_s);
        // Modes above the band, on which drives are evaluated, do not count.
        let more = model(&surface, Some(2000.0), &[]).unwrap();
        assert_eq!(windows(&surface, &more).recommended(), own);
    }
}

#[test]
fn a_band_between_modes_is_refused_with_the_next_one() {
    let mut film = papers_surface();
    let modes = unripple::physics::Modes::solve(&film, 400.0, 1e-6).unwrap();
    let [first, second] = [0, 1].map(|mode| modes.frequencies_hz()[mode]);
    for (band, above) in [([20.0, 40.0], first), ([first + 1.0, second - 1.0], second)] {
        film.emission.band = band;
        let error = model(&film, None, &[]).unwrap_err();
        let ActError::Empty { band: told, next: Some(next) } = error else { panic!("{error}") };
        assert!(told == band && (next / above - 1.0).abs() < 1e-5, "{next} {above}");
    }
    // Far below any mode, none is looked for up to the first.
    film.emission.band = [0.0, 1.0];
    let error = model(&film, None, &[]).unwrap_err();
    assert_eq!(error.to_string(), "drive.band_hz: expected modes within 0 to 1 Hz, found none");
    assert!(!error.is_failed_work());
}
