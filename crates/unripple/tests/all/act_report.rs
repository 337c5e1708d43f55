//! What a report says beside its numbers: what they do not cover, and what comes first.

use unripple::act::{Act, Acted, Followed, Level, Report, Stroked, model};
use unripple::core::{ActuatorKind, CoilDrive, Point, Responses, Surface};
use unripple::field::WaveformFigures;
use unripple::focus::{Method, Options, Shaping, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::sample;

/// The paper's film with a band up to `top` Hz, at a sample rate as far above it as its own, and its responses.
fn film(top: f64) -> (Surface, Responses) {
    let mut surface = papers_surface();
    (surface.emission.band, surface.emission.rate) = ([0.0, top], 16.0 * top);
    let responses = model(&surface, None, &[]).unwrap();
    (surface, responses)
}

fn place() -> Point {
    Point::from_mm(62.0, 90.0)
}

fn options(method: Method) -> Options {
    Options { method, window: 20e-3, ..Options::default() }
}

fn run((surface, responses): &(Surface, Responses), target: Target) -> (Acted, Report) {
    let (targets, options) = ([target], options(Method::TimeReversal));
    let act = Act { surface, responses, targets: &targets, options: &options, level: Level::default() };
    let acted = act.run().unwrap();
    let report = acted.report(surface, &options);
    (acted, report)
}

/// The notes on a topic.
fn said<'a>(acted: &'a Acted, topic: &str) -> Vec<&'a str> {
    let notes = acted.judged.notes.iter().filter(|note| note.topic == topic);
    notes.map(|note| note.text.as_str()).collect()
}

/// Two places that no drive can move so differently (see the tests of the method): at the limit the note says that it gave up, and
/// below the level that is reached there that the limit does not bind.
#[test]
fn where_limited_gives_up_the_reason_is_said() {
    let (surface, responses) = film(800.0);
    let beside = Point::from_mm(62.02, 90.0);
    let targets = [Target::at(place()), Target::at(beside).with_gain(0.01)];
    let options = options(Method::Limited);
    let run = |level| {
        let act =
            Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
        act.run().unwrap()
    };
    let full = run(Level::Limit);
    assert_eq!(full.focused.shaping, Shaping::GaveUp { attempts: 6 });
    let notes = said(&full, "method");
    assert!(notes.len() == 1 && notes[0].starts_with("push has no effect"), "{notes:?}");
    assert!(notes[0].contains("6 attempts") && notes[0].contains("strength of 0.98"), "{notes:?}");
    let peak = full.judged.measured.targets[0].peak_displacement_m.abs();
    let low = run(Level::Peak(0.5 * peak));
    let notes = said(&low, "method");
    assert!(notes.len() == 1 && notes[0].starts_with("the limit is not reached"), "{notes:?}");
}

#[test]
fn felt_levels_have_a_caveat_where_motion_is_fast_or_short_and_none_elsewhere() {
    let low = film(500.0);
    let (lasting, report) = run(&low, Target::at(place()).repeated(50.0));
    let target = &lasting.judged.measured.targets[0];
    assert!(target.share_above_1khz < 0.01 && target.felt_duration_s.is_none(), "{target:?}");
    assert!(said(&lasting, "felt").is_empty(), "{:?}", lasting.judged.notes);
    assert!(report.text().contains("thresholds differ between persons"), "{}", report.text());

    let (short, report) = run(&low, Target::at(place()));
    let notes = said(&short, "felt");
    assert!(notes.len() == 1 && notes[0].contains("lasts") && !notes[0].contains("1000 Hz"), "{notes:?}");
    for text in [report.text(), report.markdown()] {
        assert!(text.contains("which does not apply here") && !text.contains("nothing is felt"), "{text}");
    }

    let (fast, _) = run(&film(3000.0), Target::at(place()));
    let notes = said(&fast, "felt");
    let share = fast.judged.measured.targets[0].share_above_1khz;
    let expected = format!("above 1000 Hz lie {:.0} % of the energy", 100.0 * share);
    assert!(share > 0.5 && notes.len() == 1 && notes[0].contains(&expected), "{share} {notes:?}");
}

#[test]
fn little_or_nothing_outside_the_discs_is_said() {
    // Four thirds of the wavelength are 151 mm, 91 mm and 19 mm on a square of 150 mm.
    for (top, expected) in [(300.0, "no place lies outside"), (500.0, "% of the surface"), (3000.0, "")] {
        let (acted, report) = run(&film(top), Target::at(place()));
        let notes = said(&acted, "outside");
        assert_eq!(notes.len(), usize::from(!expected.is_empty()), "{top} Hz: {notes:?}");
        assert!(notes.iter().all(|note| note.contains(expected)), "{top} Hz: {notes:?}");
        assert_eq!(report.targets[0].contrast.is_none(), top == 300.0);
    }
}

/// Lattices about the middle: the discs of 58 mm hold all of one, and all but the corners of the other.
#[test]
fn few_points_of_a_library_outside_the_discs_are_counted() {
    let (surface, responses) = film(800.0);
    let Responses::Modal(modal) = &responses else { panic!("modes") };
    for (count, pitch, expected) in
        [(3, 40.0, "no point of the library lies outside"), (5, 25.0, "over 4 of the library's points")]
    {
        let along = |i: i32| 75.0 + pitch * f64::from(i - count / 2);
        let lattice: Vec<Point> =
            (0..count * count).map(|i| Point::from_mm(along(i % count), along(i / count))).collect();
        let stored = Responses::Sampled(sample(modal, &lattice, 600));
        let (acted, _) = run(&(surface.clone(), stored), Target::at(Point::from_mm(75.0, 75.0)));
        let notes = said(&acted, "outside");
        assert!(notes.len() == 1 && notes[0].contains(expected), "{count}: {notes:?}");
    }
}

#[test]
fn the_strongest_place_elsewhere_stands_above_the_figures() {
    let (_, report) = run(&film(800.0), Target::at(place()));
    for (text, head, figure) in [
        (report.text(), "in focus at", "background contrast"),
        (report.markdown(), "in focus at", "| background contrast |"),
    ] {
        let at = |what: &str| text.find(what).unwrap_or_else(|| panic!("no {what} in {text}"));
        assert!(at(head) < at("strongest elsewhere") && at("strongest elsewhere") < at(figure), "{text}");
    }
}

/// Where a stroke or waveforms were asked for, they come first, and figures of one instant are left to the JSON.
#[test]
fn reports_of_strokes_and_waveforms_begin_with_them() {
    let (_, focus) = run(&film(800.0), Target::at(place()));
    let stroke = Stroked {
        pulses: 41,
        duration_s: 0.2,
        start_s: 0.03,
        asked_m_s: 0.01,
        level_range_db: [-0.26, 0.25],
        peak_range_db: [-0.2, 0.4],
    };
    let figures = WaveformFigures {
        at_m: [0.062, 0.09],
        points: 1,
        gain: 0.999,
        gain_range: None,
        error_db: -40.0,
        crosstalk_db: None,
        peak: 1e-6,
    };
    let followed = Followed { figures, start_s: 0.03, asked_peak_m: 1e-6, lost: 0.0 };
    let stroked = Report { stroke: Some(stroke), ..focus.clone() };
    let waved = Report { waveforms: vec![followed], ..focus };
    // The level is a velocity, too, and must not read like the speed that was asked for.
    let head = "stroke: 41 pulses in 200.0 ms, asked to move the surface at 10.000 mm/s at the focus (the level, not the speed along the \
                path); level along the path -0.26 to 0.25 dB";
    for (report, first, then) in [
        (stroked, head, "pulse in the middle of the path, (62.00, 90.00) mm"),
        (waved, "waveform (62.00, 90.00) mm: 1.000 µm asked, gain 0.9990", "dB above threshold"),
    ] {
        for text in [report.text(), report.markdown()] {
            let body = text.split_once('\n').unwrap().1.trim_start();
            assert!(body.starts_with(first) && body.contains(then), "{text}");
            assert!(!text.contains("in focus at") && !text.contains("background contrast"), "{text}");
        }
        assert!(serde_json::to_value(&report).unwrap()["targets"][0]["contrast"].is_number());
    }
}

/// With R the resistance, N coils of rms current I are heated by N R I², and of rms voltage U by at most N U²/R.
#[test]
fn coils_are_heated_by_their_currents() {
    for driven_by in [CoilDrive::Current, CoilDrive::Voltage] {
        let (mut surface, _) = film(500.0);
        let resistance = 6.2;
        for actuator in &mut surface.actuators {
            actuator.kind = ActuatorKind::MovingMagnet {
                force_constant: 0.6,
                resistance,
                inductance: 1.9e-3,
                moving_mass: 7e-6,
                driven_by,
            };
        }
        let responses = model(&surface, None, &[]).unwrap();
        let (_, report) = run(&(surface, responses), Target::at(place()));
        let heat = report.coil_heat.unwrap();
        let squares = 8.0 * report.drive.rms.powi(2);
        let (expected, at_most) = match driven_by {
            CoilDrive::Current => (squares * resistance, false),
            CoilDrive::Voltage => (squares / resistance, true),
        };
        assert!((heat.total_w / expected - 1.0).abs() < 1e-9 && heat.at_most == at_most, "{heat:?}");
        assert!(heat.largest_w >= heat.total_w / 8.0 && heat.largest_w < heat.total_w, "{heat:?}");
        assert!(report.text().contains("W of heat in the coils on average"), "{}", report.text());
    }
    assert_eq!(run(&film(500.0), Target::at(place())).1.coil_heat, None);
}

/// A plate that lies free, with force actuators: all is computed, and its motions as a rigid body are named, in a band from 0 Hz alone.
#[test]
fn a_sheet_that_nothing_holds_moves_as_a_rigid_body_and_it_is_said() {
    let mut plate = papers_surface();
    (plate.sheet.tension, plate.sheet.thickness) = (0.0, 1e-3);
    plate.outline.edges = unripple::core::Edges::All(unripple::core::Edge::Free);
    for (band, tension, count) in
        [([0.0, 3000.0], 0.0, Some(3)), ([0.0, 3000.0], 100.0, Some(1)), ([100.0, 3000.0], 0.0, None)]
    {
        (plate.emission.band, plate.sheet.tension) = (band, tension);
        let responses = model(&plate, None, &[]).unwrap();
        let Responses::Modal(modal) = &responses else { panic!("a surface without modes") };
        let still = modal.poles.iter().filter(|pole| pole.omega == 0.0).count();
        assert_eq!(still, count.unwrap_or(0), "{band:?}, {tension} N/m");
        let (acted, report) = run(&(plate.clone(), responses), Target::at(place()));
        let notes = said(&acted, "rigid motions");
        assert_eq!(notes.len(), usize::from(count.is_some()), "{notes:?}");
        let target = &report.targets[0];
        let known =
            [target.peak_velocity_m_s, target.peak_displacement_m, report.mean_mechanical_power_w.unwrap()];
        assert!(known.iter().all(|x| x.is_finite() && x.abs() > 0.0), "{known:?}");
        assert!(target.contrast.unwrap() > 2.0 && target.felt_level_db.is_some(), "{target:?}");
        let design = unripple::physics::design(&plate).unwrap();
        assert!(design.contrast_predicted.is_finite() && design.first_mode_hz > 0.0);
        let named = design.notes.iter().any(|note| note.topic == "rigid motions");
        assert_eq!(named, count.is_some());
    }
}
