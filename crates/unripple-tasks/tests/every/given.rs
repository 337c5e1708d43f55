//! Drives and fields on responses that are given: those that the tasks make from a surface by its name, to the last bit, and nothing is
//! solved twice.

use super::folder;
use serde::Serialize;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;
use unripple::core::{Contact, Point, Responses, Surface};
use unripple::physics::sample;
use unripple_tasks::figures::Columns;
use unripple_tasks::source::Stored;
use unripple_tasks::target::{LineAsk, PointAsk, ShapeAsk};
use unripple_tasks::waveform::{SoundAsk, WaveformAsk};
use unripple_tasks::{Silent, Solved, Source, SurfaceAsk, field, focus, stroke, waveform};

/// A film of few modes.
const FILM: &str = r#"format = 1
name = "film of its own"
[outline]
rectangle_mm = [150, 150]
edge = "supported"
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 60
[drive]
band_hz = [0, 700]
sample_rate_hz = 16000
limit = 0.1
[[actuator]]
name = "a1"
kind = "force"
at_mm = [22, 31]
[[actuator]]
name = "a2"
kind = "force"
at_mm = [127, 26]
"#;

fn film() -> SurfaceAsk {
    SurfaceAsk::Text { toml: FILM.into(), name: None }
}

fn surface() -> Surface {
    film().load().unwrap()
}

/// The film with responses of its band that were computed before.
fn given() -> Source {
    let (surface, solved) = (surface(), Solved::default());
    let responses = solved.model(&surface, None, &[]).unwrap();
    Source::computed(surface, responses).with(&solved)
}

fn json(report: &impl Serialize) -> Value {
    serde_json::to_value(report).unwrap()
}

/// Whether two responses are one and the same, rather than equal.
fn same(one: &Responses, other: &Responses) -> bool {
    match (one, other) {
        (Responses::Modal(one), Responses::Modal(other)) => Arc::ptr_eq(&one.shapes, &other.shapes),
        _ => false,
    }
}

/// Holds that figures are those that a task wrote in a folder, which is removed.
fn as_written(figures: &[(String, String)], folder: &Path) {
    let written = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let drawn = written.filter(|path| path.extension().is_some_and(|ending| ending == "svg"));
    assert_eq!(drawn.count(), figures.len());
    for (name, text) in figures {
        let file = std::fs::read_to_string(folder.join(format!("{name}.svg"))).unwrap();
        assert!(file == *text, "{name}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}

fn focus_ask() -> focus::Ask {
    let points = vec![PointAsk::at(0.062, 0.09)];
    focus::Ask { surface: film(), points, fingers_m: vec![[0.1, 0.04]], ..focus::Ask::default() }
}

#[test]
fn a_focus_is_that_of_the_surface() {
    let (source, output) = (given(), folder("given-focus"));
    let ask = focus_ask();
    let alone = focus::make(&ask, &mut Silent).unwrap();
    // The second time all that it is evaluated on is at hand as well.
    for _ in 0..2 {
        let made = focus::make_on(&ask, source.clone(), &mut Silent).unwrap();
        assert_eq!(made.drive, alone.drive);
        assert_eq!(json(&made.report), json(&alone.report));
    }
    let figures = focus::figures(&alone, Columns::One).unwrap();
    focus::run(&focus::Ask { output: Some(output.clone()), columns: Some(1), ..ask }, &mut Silent).unwrap();
    as_written(&figures, &output);
}

#[test]
fn a_focus_is_computed_from_what_is_given() {
    let (surface, solved) = (surface(), Solved::default());
    let finger = Contact { at: Point::from_mm(60.0, 80.0), finger: surface.finger };
    let touched = solved.model(&surface, None, &[finger]).unwrap();
    let source = Source::computed(surface, touched).with(&solved);
    let made = focus::make_on(&focus_ask(), source, &mut Silent).unwrap();
    assert_ne!(made.drive, focus::make(&focus_ask(), &mut Silent).unwrap().drive);
}

#[test]
fn a_folder_that_is_filled_from_what_is_given_is_that_of_the_surface() {
    let [named, filled] = ["named-folder", "given-folder"].map(folder);
    let ask = |place: &Path| focus::Ask { output: Some(place.into()), ..focus_ask() };
    let alone = focus::run(&ask(&named), &mut Silent).unwrap();
    let report = focus::run_on(&ask(&filled), given(), &mut Silent).unwrap();
    assert_eq!(json(&report), json(&alone));
    assert!(
        report.files.iter().any(|name| name == "drive.wav") && report.files.len() > 3,
        "{:?}",
        report.files
    );
    for name in report.files.iter().map(String::as_str).chain(["report.md"]) {
        let [one, other] = [&named, &filled].map(|folder| std::fs::read(folder.join(name)).unwrap());
        assert!(one == other, "{name}");
    }
    // The record names the surface that the request does.
    let record = |folder: &Path| {
        let text = std::fs::read_to_string(folder.join("report.json")).unwrap();
        serde_json::from_str::<Value>(&text).unwrap()["run"]["ask"]["surface"].take()
    };
    assert_eq!(record(&filled), record(&named));
    [named, filled].iter().for_each(|folder| std::fs::remove_dir_all(folder).unwrap());
}

#[test]
fn waveforms_are_those_of_the_surface() {
    let (source, output) = (given(), folder("given-waveform"));
    let sound = SoundAsk::Burst { hz: 250.0, cycles: 5.0 };
    let waveforms = vec![WaveformAsk { at_m: [0.062, 0.09], sound, level_m: 1e-6 }];
    let ask = waveform::Ask { surface: film(), waveforms, ..waveform::Ask::default() };
    let alone = waveform::make(&ask, &mut Silent).unwrap();
    for _ in 0..2 {
        let made = waveform::make_on(&ask, source.clone(), &mut Silent).unwrap();
        assert_eq!(made.drive, alone.drive);
        assert_eq!(json(&made.report), json(&alone.report));
    }
    let figures = waveform::figures(&alone, Columns::Own).unwrap();
    waveform::run(&waveform::Ask { output: Some(output.clone()), ..ask }, &mut Silent).unwrap();
    as_written(&figures, &output);
}

#[test]
fn a_stroke_is_that_of_the_surface() {
    let (source, output) = (given(), folder("given-stroke"));
    let lines = vec![LineAsk { points_m: vec![[0.06, 0.075], [0.065, 0.075]], closed: false }];
    let path = ShapeAsk::Lines { lines, filled: false };
    let ask = stroke::Ask { surface: film(), path, ..stroke::Ask::default() };
    let alone = stroke::make(&ask, &mut Silent).unwrap();
    for _ in 0..2 {
        let made = stroke::make_on(&ask, source.clone(), &mut Silent).unwrap();
        assert_eq!(made.drive, alone.drive);
        assert_eq!(json(&made.report), json(&alone.report));
    }
    let figures = stroke::figures(&alone, Columns::Own).unwrap();
    stroke::run(&stroke::Ask { output: Some(output.clone()), ..ask }, &mut Silent).unwrap();
    as_written(&figures, &output);
}

#[test]
fn a_field_is_that_of_the_surface() {
    let (source, output) = (given(), folder("given-field"));
    let drive = focus::make(&focus_ask(), &mut Silent).unwrap().drive;
    let samples = field::DriveAsk::Samples { channels: drive.channels().to_vec(), rate_hz: drive.rate() };
    let ask = field::Ask { surface: film(), drive: samples, frames: 0, ..field::Ask::default() };
    let alone = field::make(&ask, &mut Silent).unwrap();
    let made = [(); 2].map(|()| field::make_on(&ask, source.clone(), drive.clone(), &mut Silent).unwrap());
    for made in &made {
        assert_eq!(made.drive, alone.drive);
        assert_eq!(json(&made.report), json(&alone.report));
    }
    // What a drive is evaluated on is solved once.
    assert!(same(&made[0].responses, &made[1].responses));
    let figures = field::figures(&alone, Columns::Own).unwrap();
    field::run(&field::Ask { output: Some(output.clone()), ..ask }, &mut Silent).unwrap();
    as_written(&figures, &output);
}

#[test]
fn sampled_responses_are_told_of_and_evaluated_on_themselves() {
    let surface = surface();
    let places = [[62, 90], [20, 20], [75, 20], [130, 20], [20, 75], [130, 75], [20, 130], [130, 130]];
    let points = places.map(|[x, y]| Point::from_mm(f64::from(x), f64::from(y)));
    let Responses::Modal(modal) = Solved::default().model(&surface, None, &[]).unwrap() else {
        panic!("a surface without modes")
    };
    let stored = Stored {
        responses: sample(&modal, &points, 1600),
        told: "8 points of an array".into(),
        notes: Vec::new(),
        without_scale: Some("no scale".into()),
    };
    let source = Source::sampled(surface, stored);
    let ask = focus::Ask { fingers_m: Vec::new(), ..focus_ask() };
    let made = focus::make_on(&ask, source.clone(), &mut Silent).unwrap();
    assert_eq!(made.report.judged_on.as_deref(), Some("8 points of an array"));
    let figures = focus::figures(&made, Columns::Own).unwrap();
    // Velocities are unknown, what the actuators are sent is not.
    assert_eq!(figures.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["drive"]);
    let refused = focus::make_on(&focus_ask(), source, &mut Silent).unwrap_err();
    assert!(refused.to_string().contains("fingers_m without on"), "{refused}");
}

#[test]
fn the_last_four_models_are_kept() {
    let (film, solved) = (surface(), Solved::default());
    let model = |top: f64| solved.model(&film, Some(top), &[]).unwrap();
    let first: Vec<Responses> = [700.0, 750.0, 800.0, 850.0].map(model).into();
    // The top of the band is 700 Hz, and what was needed last is kept longest.
    assert!(same(&solved.model(&film, None, &[]).unwrap(), &first[0]));
    let _ = model(900.0);
    assert!(same(&model(700.0), &first[0]));
    assert!(same(&model(850.0), &first[3]));
    assert!(!same(&model(750.0), &first[1]));
    // Another surface is another model.
    let louder = Surface { name: "another".into(), ..film.clone() };
    assert!(!same(&solved.model(&louder, None, &[]).unwrap(), &first[0]));
}
