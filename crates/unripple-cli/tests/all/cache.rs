//! Truth: results that come from the cache are those computed, to the last bit, and the cache can be looked at, emptied and turned off.

use crate::common::{Scratch, program};
use serde_json::Value;
use std::process::Output;

/// Runs the program with its cache in a folder; an empty name turns it off.
fn run(folder: &str, arguments: &[&str]) -> Output {
    let output = program().env("UNRIPPLE_CACHE", folder).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A report without the record of its run, in which the date differs.
fn figures(output: &Output) -> Value {
    let mut report = json(output);
    report.as_object_mut().unwrap().remove("run");
    report
}

#[test]
fn a_second_run_finds_what_the_first_has_computed() {
    let scratch = Scratch::new("cache");
    let folder = &scratch.join("kept");
    // Meshes of some seconds.
    let modes = ["modes", "stadium-film", "--accuracy", "1e-4", "--max-hz", "2000", "--json"];
    let computed = run("", &modes);
    let look = |arguments: &[&str]| json(&run(folder, &[&["cache", "--json"], arguments].concat()));
    assert_eq!(look(&[])["entries"], 0);
    let [first, second] = [0, 1].map(|_| run(folder, &modes));
    assert_eq!(figures(&first), figures(&computed));
    assert_eq!(figures(&second), figures(&computed));
    // What is found is not solved for again.
    let told = run(folder, &[&["-v"][..], &modes[..6]].concat());
    let told = String::from_utf8(told.stderr).unwrap();
    assert!(!told.contains("unknowns"), "{told}");
    // After the last run: on a busy machine a small part, which each run finds anew, may take long enough to be kept.
    let held = look(&[]);
    assert!(held["entries"].as_u64().unwrap() >= 1 && held["bytes"].as_u64().unwrap() > 1000, "{held}");
    assert_eq!(held["folder"], folder.as_str());
    let emptied = look(&["--empty"]);
    assert_eq!((&emptied["emptied"], &emptied["entries"]), (&Value::from(true), &held["entries"]));
    assert_eq!(look(&[])["bytes"], 0);
}

#[test]
fn without_a_folder_nothing_is_kept() {
    let text = String::from_utf8(run("", &["cache"]).stdout).unwrap();
    assert!(text.contains("turned off"), "{text}");
}
