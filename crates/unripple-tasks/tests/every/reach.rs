//! A surface whose modes above its band are out of reach: every task that evaluates a drive does so on those of the band, and says it.

use super::folder;
use unripple::core::Point;
use unripple_tasks::target::{LineAsk, PointAsk, ShapeAsk};
use unripple_tasks::waveform::{SoundAsk, WaveformAsk};
use unripple_tasks::{
    Report, Silent, Solved, Source, SurfaceAsk, compare, doctor, field, focus, stroke, waveform,
};

/// A strip of film with a mass on it. No wave runs along it below 7556 Hz, half a wavelength across. The band ends just above, with few
/// modes in it, while twice the band has more than 4 GiB take with a mass on the film.
const STRIP: &str = r#"format = 1
name = "strip"
[outline]
rectangle_mm = [7500, 5]
edge = "supported"
[sheet]
material = "BoPET"
thickness_mm = 0.025
tension_n_per_m = 200
decay_time_ms = 5
[drive]
band_hz = [0, 7620]
sample_rate_hz = 48000
limit = 0.01
[[actuator]]
name = "a1"
kind = "moving-magnet"
at_mm = [3700, 2]
force_constant_n_per_a = 1
resistance_ohm = 6
inductance_mh = 0
moving_mass_mg = 1
driven_by = "current"
[[actuator]]
name = "a2"
kind = "force"
at_mm = [3900, 3]
"#;

const AT: [f64; 2] = [3.8, 2.4e-3];

fn strip() -> SurfaceAsk {
    SurfaceAsk::Text { toml: STRIP.into(), name: None }
}

/// The note of a report, or its text, must say on which modes a drive was evaluated, and why.
fn says_why(text: &str) {
    assert!(
        text.contains("of the band, up to 7620 Hz, since those up to 15240 Hz are out of reach"),
        "{text}"
    );
    assert!(text.contains("GiB"), "{text}");
}

fn noted(report: &unripple::act::Report) {
    assert_eq!(report.judged_on.as_deref(), Some("strip, modes up to 7620 Hz"));
    let judged = report.notes.iter().find(|note| note.topic == "judged on");
    says_why(&judged.expect("a note").text);
    says_why(&report.text());
}

#[test]
fn drives_are_evaluated_on_what_is_within_reach() {
    let (surface, solved) = (strip().load().unwrap(), Solved::default());
    let source = || Source::of(surface.clone()).with(&solved);
    let (points, window_s) = (vec![PointAsk::at(AT[0], AT[1])], Some(5e-3));
    let ask = focus::Ask { surface: strip(), points: points.clone(), window_s, ..focus::Ask::default() };
    let made = focus::make_on(&ask, source(), &mut Silent).unwrap();
    noted(&made.report);

    let samples = field::DriveAsk::Samples { channels: made.drive.channels().to_vec(), rate_hz: 48e3 };
    let ask = field::Ask {
        surface: strip(),
        drive: samples,
        points_m: vec![AT],
        frames: 0,
        ..field::Ask::default()
    };
    noted(&field::make_on(&ask, source(), made.drive, &mut Silent).unwrap().report);

    let lines = vec![LineAsk { points_m: vec![AT, [AT[0] + 1e-3, AT[1]]], closed: false }];
    let path = ShapeAsk::Lines { lines, filled: false };
    let ask = stroke::Ask { surface: strip(), path, window_s, ..stroke::Ask::default() };
    noted(&stroke::make_on(&ask, source(), &mut Silent).unwrap().report);

    let sound = SoundAsk::Burst { hz: 7600.0, cycles: 20.0 };
    let waveforms = vec![WaveformAsk { at_m: AT, sound, level_m: 1e-9 }];
    let ask = waveform::Ask { surface: strip(), waveforms, window_s, ..waveform::Ask::default() };
    let report = waveform::make_on(&ask, source(), &mut Silent).unwrap().report;
    assert_eq!(report.judged_on.as_deref(), Some("strip, modes up to 7620 Hz"));
    // Waveforms are evaluated on three times the band by default, as far as the sample rate allows.
    let note = |topic: &str| report.notes.iter().find(|note| note.topic == topic).expect(topic).text.clone();
    let (judged, planned) = (note("judged on"), note("planned on"));
    assert!(judged.contains("up to 7620 Hz, since those up to 21600 Hz are out of reach"), "{judged}");
    assert!(planned.contains("up to 7620 Hz, since those up to 15240 Hz are out of reach"), "{planned}");

    let output = folder("reach-compare");
    let methods = vec![unripple::focus::Method::TimeReversal];
    let place = Some(output.clone());
    let ask = compare::Ask {
        surface: strip(),
        points,
        window_s,
        methods,
        no_tradeoffs: true,
        output: place,
        ..compare::Ask::default()
    };
    says_why(&compare::run(&ask, &mut Silent).unwrap().text());
    says_why(&std::fs::read_to_string(output.join("report.md")).unwrap());
    std::fs::remove_dir_all(output).unwrap();
    assert!(surface.outline.contains(Point::new(AT[0], AT[1])));
}

#[test]
fn a_doctor_judges_on_the_modes_that_others_do() {
    let report =
        doctor::run(&doctor::Ask { surface: strip(), ..doctor::Ask::default() }, &mut Silent).unwrap();
    says_why(&report.text());
}
