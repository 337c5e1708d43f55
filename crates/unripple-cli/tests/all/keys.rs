//! docs/json.md defines every key of every report, which `common::run` holds all tests to; here, of the commands that no other test asks.

use crate::common;

use common::guide::undefined;
use common::{Scratch, json, run};
use serde_json::Value;
use std::collections::BTreeSet;

#[test]
fn keys_that_the_guide_does_not_define_are_found() {
    let report: Value = serde_json::from_str(
        r#"{
            "count": 2,
            "contrast": 3.0,
            "notes": [{ "topic": "a", "txet": "b" }, { "text": "c" }],
            "run": { "command": "modes", "when": 1, "ask": { "top_hz": null }, "files": [{ "path": "x" }] }
        }"#,
    )
    .unwrap();
    let found = ["/contrast", "/notes/txet", "/run/when"].map(String::from);
    assert_eq!(undefined(&report), BTreeSet::from(found));
}

#[test]
fn faults_and_materials_are_defined() {
    let scratch = Scratch::new("keys");
    let file = scratch.file("film.toml", "format = 1\nnaem = \"A film\"\n");
    let output = run(&["check", &file, "--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(!report["faults"].as_array().unwrap().is_empty(), "{report}");
    assert!(undefined(&report).is_empty(), "{:?}", undefined(&report));
    assert!(!json(&["materials"])["materials"].as_array().unwrap().is_empty());
}

#[test]
fn addresses_of_a_page_are_defined() {
    let view = ["view", "hudin-2012", "--port", "0", "--no-browser", "--seconds", "0.2"];
    assert!(json(&view)["url"].as_str().unwrap().starts_with("http://127.0.0.1:"));
}

#[test]
fn changes_of_tension_are_defined() {
    let film = ["drift", "hudin-2012", "--set", "drive.band_hz=[0, 1000]"];
    let drift = [&film[..], &["--seconds", "2", "--changed-percent", "0.5"]].concat();
    let drift = json(&[&drift[..], &["--changing-percent-per-min", "2"]].concat());
    assert!(!drift["pings"].as_array().unwrap().is_empty(), "{drift}");
}
