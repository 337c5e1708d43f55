//! `--accuracy` for every command that computes modes.

use crate::common;

use common::*;
use std::fs;

/// A hexagon of film, which needs a mesh, in a narrow band.
const HEXAGON: &str = r#"
format = 1
[outline]
polygon_mm = [[30, 0], [90, 0], [120, 52], [90, 104], [30, 104], [0, 52]]
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 70
[drive]
band_hz = [0, 900]
sample_rate_hz = 8000
[[actuator]]
at_mm = [40, 12]
[[actuator]]
at_mm = [84, 16]
"#;

#[test]
fn a_coarser_accuracy_reaches_every_command() {
    let folder = Scratch::new("accuracy");
    let file = folder.path().join("hexagon.toml");
    fs::write(&file, HEXAGON).unwrap();
    let file = file.display().to_string();
    let stated = |accuracy: &str| {
        let report = json(&["modes", &file, "--accuracy", accuracy]);
        // What the run is repeated from has it in the surface's own text.
        let text = report["run"]["ask"]["surface"]["toml"].as_str().unwrap();
        assert!(text.contains("\naccuracy = "), "{text}");
        report["relative_error"].as_f64().unwrap()
    };
    let (coarse, fine) = (stated("0.05"), stated("1e-5"));
    assert!(fine <= 1e-5 && coarse <= 0.05 && coarse > fine, "{coarse} {fine}");
    // The file may say it itself, and `--set` too.
    assert_eq!(json(&["modes", &file, "--set", "accuracy=0.05"])["relative_error"].as_f64(), Some(coarse));
    // Where nothing could be had, something coarser is.
    let library = folder.path().join("library").display().to_string();
    let out = folder.path().join("out").display().to_string();
    for arguments in [
        vec!["design", &file],
        vec!["focus", &file, "--at", "60,50", "-o", &out, "--no-figures"],
        vec!["respond", &file, "--grid-mm", "40", "-o", &library],
        vec!["focus", &library, "--at", "80,40", "-o", &out, "--no-figures"],
        vec!["compare", &file, "--at", "60,50", "--method", "inverse", "-o", &out],
        vec!["place", &file, "--at", "80,40", "--at", "45,70", "--count", "2", "--rim-mm", "8,16"],
    ] {
        let mut arguments = arguments;
        arguments.extend(["--accuracy", "0.05"]);
        json(&arguments);
    }
    assert!(
        refused(&["focus", &file, "--at", "60,50", "-o", &out, "--accuracy", "0"], 2).contains("accuracy")
    );
    assert!(
        refused(&["design", &file, "--accuracy", "0.1", "--set", "accuracy=0.1"], 2).contains("--accuracy")
    );
    assert!(refused(&["devices", "--accuracy", "0.1"], 2).contains("--accuracy"));
    assert!(refused(&["fit", &library, "--accuracy", "2"], 2).contains("accuracy"));
}

/// A plate supported along a square with a shallow dent in one side: meshes converge slowly at the dent.
const DENTED: &str = r#"
format = 1
[outline]
polygon_mm = [[0, 0], [100, 0], [100, 100], [50, 98], [0, 100]]
edge = "supported"
[sheet]
material = "glass"
thickness_mm = 1
decay_time_ms = 20
[drive]
band_hz = [0, 6000]
sample_rate_hz = 48000
[[actuator]]
at_mm = [20, 32]
[[actuator]]
at_mm = [74, 26]
"#;

#[test]
fn what_is_out_of_reach_is_had_with_its_error_unless_it_was_asked_for() {
    let folder = Scratch::new("dented");
    let file = folder.path().join("dented.toml");
    fs::write(&file, DENTED).unwrap();
    let (file, out) = (file.display().to_string(), folder.path().join("out").display().to_string());
    let modes = json(&["modes", &file]);
    let error = modes["relative_error"].as_f64().unwrap();
    assert!(error > 1e-4 && error < 1e-2, "{error}");
    let about_accuracy = |report: &serde_json::Value| {
        let notes = report["notes"].as_array().cloned().unwrap_or_default();
        notes
            .iter()
            .filter(|note| note["topic"] == "accuracy")
            .map(|note| note["text"].to_string())
            .collect::<String>()
    };
    assert!(about_accuracy(&modes).contains("not within 1e-6"), "{modes}");
    let focus = ["focus", &file, "--at", "60,50", "-o", &out, "--no-figures"];
    assert!(about_accuracy(&json(&focus)).contains("not within 1e-4, the default"));
    assert!(json(&["design", &file])["mode_count_exact"].as_f64().unwrap() > 3.0);
    let told = refused(&["modes", &file, "--accuracy", "1e-4"], 2);
    assert!(told.contains("expected an error of at most 1e-4"), "{told}");
    // With an accuracy that can be had nothing is remarked.
    assert_eq!(about_accuracy(&json(&["modes", &file, "--accuracy", "0.01"])), "");
}

/// A finer accuracy has smaller errors of decay times and responses too, and a finger on the sheet leaves those of responses unknown.
#[test]
fn errors_of_decay_times_and_responses_are_stated() {
    let folder = Scratch::new("stated");
    let file = folder.path().join("hexagon.toml");
    fs::write(&file, HEXAGON.replace("decay_time_ms = 70", "loss_factor = 0.02")).unwrap();
    let (file, out) = (file.display().to_string(), folder.path().join("out").display().to_string());
    let stated = |accuracy: &str| {
        let modes = json(&["modes", &file, "--accuracy", accuracy]);
        let of_decay: Vec<f64> =
            modes["decay_errors"].as_array().unwrap().iter().map(|error| error.as_f64().unwrap()).collect();
        assert_eq!(Some(of_decay.len() as u64), modes["count"].as_u64());
        let library = folder.path().join(accuracy).display().to_string();
        let made = json(&["respond", &file, "--grid-mm", "40", "--accuracy", accuracy, "-o", &library]);
        assert!(number(&made, "/left_out") > 0.0);
        let focus = ["focus", &file, "--at", "60,50", "-o", &out, "--no-figures", "--accuracy", accuracy];
        let focused = number(&json(&focus), "/response_error");
        assert!(focused > 0.0 && focused < 3.0, "{focused}");
        let touched = json(&[&focus[..], &["--finger", "60,50"]].concat());
        assert_eq!(touched.get("response_error"), None);
        (of_decay.into_iter().fold(0.0, f64::max), number(&made, "/response_error"))
    };
    let (coarse, fine) = (stated("1e-3"), stated("1e-5"));
    assert!(0.0 < fine.0 && fine.0 < coarse.0 && coarse.0 < 0.1, "{coarse:?} {fine:?}");
    assert!(0.0 < fine.1 && fine.1 < coarse.1, "{coarse:?} {fine:?}");
}
