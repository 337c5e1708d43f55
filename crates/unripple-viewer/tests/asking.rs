//! Figures that pages ask for are those of the surface that they show.

mod common;

use common::{Served, until};
use serde_json::{Value, json};
use std::net::TcpStream;
use tungstenite::{Message, WebSocket};
use unripple::core::Point;
use unripple::drafting::Draft;
use unripple::physics::design::papers_surface;
use unripple_store::to_toml;
use unripple_tasks::target::PointAsk;
use unripple_tasks::{Silent, SurfaceAsk, focus, rerun};

type Page = WebSocket<TcpStream>;

fn say(page: &mut Page, message: Value) {
    page.send(Message::text(message.to_string())).unwrap();
}

/// Changes the tension, and waits until the page is told; the number of the edit.
fn tension(page: &mut Page, tension: f64) -> Value {
    say(page, json!({ "do": "edit", "tension_n_per_m": tension }));
    loop {
        let surface = until(page, "surface");
        if surface["values"]["tension_n_per_m"] == tension {
            return surface["edit"].clone();
        }
    }
}

/// The contrast measured of an act, and the number of the edit that it is of.
fn measured(page: &mut Page, id: u64) -> (f64, Value) {
    loop {
        let found = until(page, "measured");
        if found["id"] == id {
            return (found["report"]["targets"][0]["contrast"].as_f64().unwrap(), found["edit"].clone());
        }
    }
}

/// The same contrast, asked of the library and not of a viewer.
fn contrast(tension: f64) -> f64 {
    let mut surface = papers_surface();
    surface.emission.band[1] = 700.0;
    surface.sheet.tension = tension;
    let draft = Draft::of(&surface).unwrap();
    let acted = draft.focus(Point::from_mm(62.0, 90.0), None).unwrap();
    acted.judged.measured.targets[0].contrast.unwrap()
}

fn assert_alike(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-6, "{found}, not {expected}");
}

#[test]
fn what_is_measured_is_what_focus_finds_up_to_twice_the_band() {
    let served = Served::new(None);
    let mut page = served.page();
    until(&mut page, "surface");
    say(&mut page, json!({ "do": "measure", "id": 1, "at": [[62, 90]], "window_ms": 20 }));
    let found = &until(&mut page, "measured")["report"];
    assert_eq!(found["judged_on"], "hudin-2012, modes up to 1400 Hz");
    let mut surface = papers_surface();
    surface.emission.band[1] = 700.0;
    let at = Point::from_mm(62.0, 90.0);
    let ask = focus::Ask {
        surface: SurfaceAsk::Text { toml: to_toml(&surface), name: None },
        points: vec![PointAsk::at(at.x, at.y)],
        window_s: Some(20.0 * 1e-3),
        judge_hz: Some(1400.0),
        ..focus::Ask::default()
    };
    let wanted = serde_json::to_string(&focus::run(&ask, &mut Silent).unwrap()).unwrap();
    let wanted: Value = serde_json::from_str(&wanted).unwrap();
    for key in ["judged_on", "targets", "drive", "level", "notes"] {
        assert_eq!(found[key], wanted[key], "{key}");
    }
}

#[test]
fn a_surface_is_computed_however_much_waits() {
    let served = Served::new(None);
    let mut page = served.page();
    until(&mut page, "surface");
    for id in 0..60 {
        say(&mut page, json!({ "do": "measure", "id": id, "at": [[62, 90]], "method": "felt" }));
    }
    let edit = tension(&mut page, 151.0);
    say(&mut page, json!({ "do": "measure", "id": 99, "at": [[62, 90]] }));
    loop {
        let design = until(&mut page, "design");
        if design["edit"] == 1 && design["done"] == true {
            break;
        }
    }
    say(&mut page, json!({ "do": "measure", "id": 100, "at": [[62, 90]] }));
    let (found, of) = measured(&mut page, 100);
    assert_alike(found, contrast(151.0));
    assert_eq!((&edit, &of), (&json!(1), &json!(1)));
}

#[test]
fn an_act_is_of_the_surface_that_was_shown_when_it_was_asked_for() {
    let served = Served::new(None);
    let mut page = served.page();
    until(&mut page, "surface");
    let mut edits = vec![json!(0)];
    for id in 1..=3u32 {
        let wanted = 200.0 - 10.0 * f64::from(id);
        edits.push(tension(&mut page, wanted));
        say(&mut page, json!({ "do": "measure", "id": id, "at": [[62, 90]], "edit": edits[id as usize] }));
    }
    // The surface has become another while the first of them waited.
    let (found, of) = measured(&mut page, 3);
    assert_alike(found, contrast(170.0));
    assert_eq!(of, edits[3]);
    // A page that has not been told of the last edits asks about what it shows.
    for (id, wanted) in [(11, 190.0), (12, 180.0), (10, 200.0)] {
        say(&mut page, json!({ "do": "measure", "id": id, "at": [[62, 90]], "edit": edits[id - 10] }));
        let (found, of) = measured(&mut page, id as u64);
        assert_alike(found, contrast(wanted));
        assert_eq!(of, edits[id - 10]);
    }
    say(&mut page, json!({ "do": "measure", "id": 20, "at": [[62, 90]], "edit": 77 }));
    let fault = until(&mut page, "fault");
    assert!(fault["text"].as_str().unwrap().starts_with("edit: expected 0 to 3, found 77"), "{fault}");
}

#[test]
fn a_file_and_the_way_back_are_editions_too() {
    let served = Served::new(None);
    let mut page = served.page();
    let before = until(&mut page, "surface");
    let text = before["toml"].as_str().unwrap();
    let answer = served.post(&text.replace("tension_n_per_m = 200", "tension_n_per_m = 150"));
    assert_eq!(common::status(&answer), 200);
    say(&mut page, json!({ "do": "measure", "id": 1, "at": [[62, 90]] }));
    assert_alike(measured(&mut page, 1).0, contrast(150.0));
    say(&mut page, json!({ "do": "undo" }));
    let back = loop {
        let surface = until(&mut page, "surface");
        if surface["values"]["tension_n_per_m"] == 200.0 {
            break surface["edit"].clone();
        }
    };
    say(&mut page, json!({ "do": "measure", "id": 2, "at": [[62, 90]], "edit": back }));
    let (found, of) = measured(&mut page, 2);
    assert_alike(found, contrast(200.0));
    assert_eq!((&before["edit"], of), (&json!(0), back));
}

#[test]
fn what_a_page_measures_is_told_to_it_alone_and_kept_for_it() {
    let served = Served::new(None);
    let (mut one, mut other) = (served.page(), served.page());
    until(&mut one, "surface");
    say(&mut one, json!({ "do": "measure", "id": 1, "at": [[62, 90]] }));
    measured(&mut one, 1);
    say(&mut other, json!({ "do": "measure", "id": 2, "at": [[40, 50]] }));
    assert_eq!(until(&mut other, "measured")["id"], 2);
    for id in [1, 2] {
        assert_eq!(common::status(&served.get(&format!("/drive.wav?id={id}"), "")), 200, "{id}");
    }
}

#[test]
fn files_are_those_of_the_act_that_is_named() {
    let served = Served::new(None);
    let mut page = served.page();
    until(&mut page, "surface");
    say(&mut page, json!({ "do": "measure", "id": 5, "at": [[62, 90]] }));
    measured(&mut page, 5);
    let answer = served.get("/report.json?id=5", "");
    assert_eq!(common::status(&answer), 200);
    // What is downloaded repeats the run.
    let (_, text) = answer.split_once("\r\n\r\n").unwrap();
    let report: Value = serde_json::from_str(text).unwrap();
    let file = std::env::temp_dir().join(format!("unripple-asking-{}.json", std::process::id()));
    std::fs::write(&file, text).unwrap();
    let again = rerun::run(&rerun::Ask { report: file.clone(), output: None }, &mut Silent).unwrap();
    std::fs::remove_file(file).unwrap();
    let again: Value = serde_json::from_str(again.json.get()).unwrap();
    for key in ["contrast", "peak_displacement_m", "felt_level_db"] {
        assert_alike(again["targets"][0][key].as_f64().unwrap(), report["targets"][0][key].as_f64().unwrap());
    }
    say(&mut page, json!({ "do": "measure", "id": 6, "at": [[40, 50]] }));
    measured(&mut page, 6);
    let answer = served.get("/drive.wav?id=5", "");
    assert!(common::status(&answer) == 404 && answer.contains("measure again"), "{answer}");
    assert_eq!(common::status(&served.get("/drive.wav", "")), 200);
}
