//! A surface played by fingers that are not there: felt, the same each time, and honest about what cannot be.

mod common;

use common::{Scratch, json, number, refused, run};

#[test]
fn fingers_feel_the_surface_within_a_block() {
    let played = json(&["play", "hudin-2012", "--seconds", "1.5", "--effect", "sandpaper", "--fingers", "3"]);
    assert!(number(&played, "/started") > 10.0 && number(&played, "/failed_cues") == 0.0, "{played}");
    assert!(number(&played, "/felt/level_db_median") > 5.0);
    assert!(number(&played, "/first_sample_s/worst") <= number(&played, "/block_s") + 1e-9);
    let window = number(&played, "/window_s");
    assert!((0.01..0.03).contains(&window));
    assert!(number(&played, "/focus_s/worst") <= window + 2.0 * number(&played, "/block_s"));
    assert_eq!((number(&played, "/lost_commands"), number(&played, "/refused")), (0.0, 0.0));
}

#[test]
fn a_recorded_session_gives_the_same_drive() {
    let scratch = Scratch::new("play-session");
    let [taps, first, again] = ["taps.jsonl", "first.wav", "again.wav"].map(|name| scratch.join(name));
    let play = |more: &[&str]| {
        json(&[&["play", "hudin-2012", "--effect", "corduroy", "--seconds", "1"][..], more].concat())
    };
    play(&["--fingers", "4", "--seed", "3", "--record", &taps]);
    for wav in [&first, &again] {
        let replayed = play(&["--session", &taps, "--keep-drive", wav]);
        assert!(number(&replayed, "/touches") > 10.0);
    }
    let [first, again] = [first, again].map(|path| std::fs::read(path).unwrap());
    assert!(first.len() > 100_000 && first == again);
}

#[test]
fn a_library_is_played_between_its_points() {
    let scratch = Scratch::new("play-library");
    let library = scratch.join("lib");
    json(&["respond", "hudin-2012", "--grid-mm", "7.5", "--length-ms", "30", "-o", &library]);
    let played = json(&["play", &library, "--seconds", "1", "--fingers", "2"]);
    assert!(number(&played, "/started") >= 1.0 && number(&played, "/failed_cues") == 0.0, "{played}");
    assert!(refused(&["play", &library, "--seconds", "1", "--follow-tension"], 2).contains("fit"));
}

#[test]
fn what_cannot_be_played_is_refused() {
    let with = |more: &[&str]| refused(&[&["play", "hudin-2012", "--seconds", "1"][..], more].concat(), 2);
    assert!(with(&["--effect", "sandpapr"]).contains("sandpaper"));
    assert!(with(&["--window-ms", "-3"]).contains("--window-ms"));
    assert!(with(&["--session", "nowhere.jsonl"]).contains("nowhere.jsonl"));
    assert!(with(&["--screen", "/dev/null"]).contains("/dev/null"));
    assert!(with(&["--device", "tape"]).contains("tape"));
    assert!(with(&["--block", "0"]).contains("block"));
    let jack = ["play", "hudin-2012", "--device", "jack", "--jack-server", "nowhere", "--seconds", "1"];
    assert!(refused(&jack, 1).contains("JACK"));
}

#[test]
fn ports_that_others_can_reach_are_warned_of() {
    let errors = |more: &[&str]| {
        let output = run(&[&["play", "hudin-2012", "--seconds", "0.1"][..], more].concat());
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{more:?}: {errors}");
        errors
    };
    let open = ["--listen", "0.0.0.0"];
    for port in [["--tuio", "0"], ["--websocket", "0"]] {
        let (own, others) = (errors(&port), errors(&[port, open].concat()));
        assert!(own.contains("touches from ") && !own.contains("warning"), "{own}");
        assert!(others.contains("warning: --listen 0.0.0.0: whoever can reach this address"), "{others}");
    }
    assert!(!errors(&open).contains("warning"), "no port is open");
}

#[test]
fn the_doctor_looks_at_every_stage() {
    let found = json(&["doctor", "hudin-2012", "--tuio", "0"]);
    let named = |name: &str| {
        let checks = found["checks"].as_array().unwrap();
        let check = checks.iter().find(|check| check["name"] == name);
        check.unwrap_or_else(|| panic!("no check `{name}`"))["verdict"].as_str().unwrap().to_owned()
    };
    for stage in ["surface", "model", "focus", "level", "device", "wiring", "blocks", "TUIO"] {
        assert_eq!(named(stage), "good", "{stage}");
    }
    let output = run(&["doctor", "hudin-2012", "--tuio", "0"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("why you may feel nothing"));
}
