//! `verify` on simulated benches: a true one agrees, and tension, wires and amplifiers are told apart by what a probe records.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;
use std::sync::LazyLock;

/// A film of few modes with six actuators, sampled so slowly that a bench takes a fraction of a second.
const FILM: &str = "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
                    thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 700]\n\
                    sample_rate_hz = 16000\n[[actuator]]\nname = \"a1\"\nat_mm = [12, 31]\n\
                    [[actuator]]\nname = \"a2\"\nat_mm = [140, 44]\n[[actuator]]\nname = \"a3\"\nat_mm = [40, 140]\n\
                    [[actuator]]\nname = \"a4\"\nat_mm = [30, 10]\n[[actuator]]\nname = \"a5\"\nat_mm = [118, 137]\n\
                    [[actuator]]\nname = \"a6\"\nat_mm = [84, 9]\n";

/// The film with a drive that focuses on it.
struct Bench {
    _folder: Scratch,
    film: String,
    drive: String,
}

static BENCH: LazyLock<Bench> = LazyLock::new(|| {
    let folder = Scratch::new("verify");
    let film = folder.file("film.toml", FILM);
    let out = folder.join("out");
    json(&["focus", &film, "--at", "62,90", "--window-ms", "30", "--no-figures", "-o", &out]);
    Bench { drive: format!("{out}/drive.wav"), film, _folder: folder }
});

/// The report of a bench, and whether the command ended with status 0.
fn verified(more: &[&str]) -> (Value, bool) {
    let bench = &*BENCH;
    let all = [&["verify", &bench.film, "--drive", &bench.drive, "--json"], more].concat();
    let output = run(&all);
    let errors = String::from_utf8_lossy(&output.stderr);
    let report =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{more:?}: {error}: {errors}"));
    (report, output.status.success())
}

/// The likeliest cause on a bench that must differ.
fn cause(more: &[&str]) -> Value {
    let (report, good) = verified(more);
    assert!(!good && report["state"] == "differs", "{more:?}: {report}");
    report["measured"]["causes"][0].clone()
}

#[test]
fn a_dry_run_says_what_would_be_played_and_plays_nothing() {
    let (plan, good) = verified(&["--dry-run", "--level", "0.5"]);
    assert!(good && plan["state"] == "planned" && plan.get("measured").is_none(), "{plan}");
    assert_eq!(plan["places"].as_array().unwrap().len(), 9);
    let (whole, _) = verified(&["--dry-run"]);
    for key in ["/drive_peak", "/limit_share", "/predicted/velocity_m_s", "/places/3/predicted_peak_m_s"] {
        let ratio = number(&plan, key) / number(&whole, key);
        assert!((ratio - 0.5).abs() < 1e-6, "{key}: {ratio}");
    }
    // The target and instant are those of the report beside the drive.
    assert!((number(&whole, "/places/0/at_m/0") - 0.062).abs() < 1e-9);
    assert!((number(&whole, "/instant_s") - 0.030).abs() < 1e-4);
}

#[test]
fn a_true_bench_does_what_was_predicted() {
    let (report, good) = verified(&[]);
    assert!(good && report["state"] == "agrees", "{report}");
    let measured = &report["measured"];
    for key in ["velocity_ratio", "contrast_ratio", "gain"] {
        let ratio = measured[key].as_f64().unwrap();
        assert!((ratio - 1.0).abs() < 0.03, "{key}: {ratio}");
    }
    assert!(measured["causes"].as_array().unwrap().is_empty(), "{measured}");
    assert!(number(measured, "/latency_s").abs() < 1e-6 && number(measured, "/unexplained") < 0.03);
    for gain in measured["gains"].as_array().unwrap() {
        assert!((gain["gain"].as_f64().unwrap() - 1.0).abs() < 0.03, "{gain}");
    }
}

#[test]
fn another_tension_is_found_with_its_size() {
    for percent in ["3", "-3"] {
        let found = cause(&["--changed-percent", percent]);
        assert_eq!(found["cause"], "tension", "{found}");
        let truth = percent.parse::<f64>().unwrap() / 100.0;
        assert!((found["tension_change"].as_f64().unwrap() - truth).abs() < 1e-3, "{found}");
    }
}

#[test]
fn exchanged_wires_are_named() {
    let found = cause(&["--swapped", "a1=a3"]);
    assert_eq!(found["cause"], "wires", "{found}");
    assert_eq!(found["actuators"], serde_json::json!(["a1", "a3"]));
    assert!(found["unexplained"].as_f64().unwrap() < 0.03, "{found}");
}

#[test]
fn an_amplifier_that_saturates_is_no_other_fault() {
    let found = cause(&["--clipped", "0.4"]);
    assert_eq!(found["cause"], "saturation", "{found}");
    let (report, _) = verified(&["--clipped", "0.4"]);
    let clip = found["clip"].as_f64().unwrap() / number(&report, "/drive_peak");
    // Tried in steps of a twentieth.
    assert!((clip - 0.4).abs() < 0.06, "{clip}");
    // At a quarter of the level nothing is clipped, so that nothing else is suspected.
    assert_eq!(report["measured"]["causes"].as_array().unwrap().len(), 1, "{report}");
}

#[test]
fn what_makes_no_sense_is_refused_by_its_option() {
    let bench = &*BENCH;
    let told =
        |more: &[&str]| refused(&[&["verify", &bench.film, "--drive", &bench.drive], more].concat(), 2);
    assert!(told(&["--level", "1.5"]).contains("--level"));
    assert!(told(&["--probe-mm", "200,20"]).contains("--probe-mm"));
    assert!(told(&["--swapped", "a1=a9"]).contains("--swapped"));
    assert!(told(&["--device", "tape"]).contains("device"));
    assert!(told(&["--probe-scale", "0"]).contains("--probe-scale"));
    assert!(told(&["--at", "62,90", "--at-ms", "5000"]).contains("--at-ms"));
}
