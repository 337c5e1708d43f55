//! From a surface to a focus and back through the field: the files, the keys and the figures.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;

const FIGURES: [&str; 19] = [
    "peak_velocity_m_s",
    "peak_displacement_m",
    "peak_time_s",
    "contrast",
    "background_contrast",
    "worst_spot",
    "spot_diameter_m",
    "pulse_duration_s",
    "displacement_peak_time_s",
    "displacement_contrast",
    "displacement_background_contrast",
    "displacement_worst_spot",
    "displacement_spot_diameter_m",
    "displacement_pulse_duration_s",
    "felt_level_db",
    "felt_peak_time_s",
    "felt_contrast_db",
    "felt_background_db",
    "felt_worst_spot_db",
];

#[test]
fn field_on_the_drive_gives_the_figures_of_focus() {
    let scratch = Scratch::new("main-job");
    let out = scratch.join("out");
    let drive = format!("{out}/drive.wav");
    for method in ["time-reversal", "one-bit"] {
        let arguments =
            ["--at", "62,90", "--method", method, "--window-ms", "30", "--full-limit", "-o", &out];
        let focus = json(&[&["focus", "hudin-2012"], &arguments[..]].concat());
        assert_eq!(focus["method"], method);
        let field = json(&["field", "hudin-2012", "--drive", &drive, "--at", "62,90", "--at-ms", "30"]);
        for key in FIGURES {
            let path = format!("/targets/0/{key}");
            let (a, b) = (number(&focus, &path), number(&field, &path));
            assert!((a / b - 1.0).abs() < 1e-4, "{method} {key}: {a} {b}");
        }
        for key in ["peak", "rms", "energy"] {
            let path = format!("/drive/{key}");
            assert!((number(&focus, &path) / number(&field, &path) - 1.0).abs() < 1e-9);
        }
        assert!((number(&focus, "/lambda_min_m") - 0.014_549_727).abs() < 1e-8);
        assert_eq!(number(&focus, "/drive/peak"), 1.0);
    }
}

/// Figures of the same drive computed independently, in Python, from dense matrices.
#[test]
fn figures_agree_with_an_independent_computation() {
    let scratch = Scratch::new("independent");
    let out = scratch.join("out");
    // On the modes of the band, as there.
    let own = ["--judge-hz", "3000", "--full-limit", "-o", &out];
    let focus = json(&[&["focus", "hudin-2012", "--at", "62,90", "--window-ms", "30"], &own[..]].concat());
    for (key, expected) in [
        ("peak_velocity_m_s", 171.672_134),
        ("peak_displacement_m", 0.014_285_589_9),
        ("contrast", 25.074_560_6),
        ("background_contrast", 27.630_007_8),
        ("worst_spot", 3.798_403_6),
        ("displacement_contrast", 24.831_774_1),
        ("displacement_background_contrast", 20.984_497_9),
        ("displacement_worst_spot", 2.921_831_6),
    ] {
        let found = number(&focus, &format!("/targets/0/{key}"));
        assert!((found / expected - 1.0).abs() < 2e-5, "{key}: {found} {expected}");
    }
    assert!((number(&focus, "/drive/energy") - 0.017_181_704_5).abs() < 1e-7);
}

#[test]
fn a_run_leaves_drive_report_and_figures() {
    let scratch = Scratch::new("files");
    let out = scratch.join("out");
    let first = run(&["focus", "hudin-2012", "--at", "62,90", "-o", &out]);
    assert!(first.status.success());
    let again = run(&["focus", "hudin-2012", "--at", "40,50", "--peak-um", "40", "-o", &out, "--json"]);
    assert!(String::from_utf8_lossy(&again.stderr).contains("replaced the earlier run"));
    let report: serde_json::Value = serde_json::from_slice(&again.stdout).unwrap();
    let written: serde_json::Value =
        serde_json::from_slice(&std::fs::read(format!("{out}/report.json")).unwrap()).unwrap();
    assert_eq!(report, written);
    assert!((number(&report, "/targets/0/peak_displacement_m").abs() / 40e-6 - 1.0).abs() < 1e-6);
    // Nobody asked for the window, and levels as felt do not hold for a single pulse; of all else there is nothing to say.
    let topics: Vec<&serde_json::Value> =
        report["notes"].as_array().unwrap().iter().map(|note| &note["topic"]).collect();
    assert_eq!(topics, ["felt", "window"], "{}", report["notes"]);
    for file in report["files"].as_array().unwrap() {
        let bytes = std::fs::read(format!("{out}/{}", file.as_str().unwrap())).unwrap();
        assert!(bytes.len() > 1000, "{file}");
    }
    assert!(report["files"].as_array().unwrap().len() >= 9);
    let page = std::fs::read_to_string(format!("{out}/report.md")).unwrap();
    assert!(page.contains("| contrast |") && page.contains("![focus](focus.png)"));
}

#[test]
fn a_level_as_felt_is_met_and_what_is_felt_elsewhere_is_said() {
    let scratch = Scratch::new("felt");
    let out = scratch.join("out");
    for (level, at, said) in [
        ("2", "62,90", "dB below the threshold of sustained vibration, which does not apply here"),
        ("-6", "62,90", "dB below the threshold of sustained vibration, which does not apply here"),
        ("20", "40,50", "dB above the threshold of sustained vibration, which does not apply here"),
    ] {
        let report =
            json(&["focus", "hudin-2012", "--at", at, "--felt-db", level, "--window-ms", "30", "-o", &out]);
        let wanted: f64 = level.parse().unwrap();
        let reached = number(&report, "/targets/0/felt_level_db");
        assert!((reached - wanted).abs() < 1e-4);
        let elsewhere = reached - number(&report, "/targets/0/felt_worst_spot_db");
        assert!((number(&report, "/felt_outside_db") - elsewhere).abs() < 1e-9);
        let page = std::fs::read_to_string(format!("{out}/report.md")).unwrap();
        assert!(
            page.contains(said) && page.contains("| as felt |") && page.contains("![felt](felt.png)"),
            "{page}"
        );
    }
}

#[test]
fn field_finds_the_focus_by_itself_and_animates_it() {
    let scratch = Scratch::new("field");
    let (out, shown) = (scratch.join("out"), scratch.join("shown"));
    run(&["focus", "hudin-2012", "--at", "62,90", "--window-ms", "30", "-o", &out]);
    let drive = format!("{out}/drive.wav");
    let field = json(&["field", "hudin-2012", "--drive", &drive, "-o", &shown, "--frames", "12"]);
    let at = field["targets"][0]["at_m"].as_array().unwrap();
    let (x, y) = (at[0].as_f64().unwrap(), at[1].as_f64().unwrap());
    assert!((x - 0.062).hypot(y - 0.090) < 2e-3, "{x} {y}");
    assert!((number(&field, "/targets/0/instant_s") - 0.030).abs() < 1e-4);
    let movie = std::fs::File::open(format!("{shown}/animation.png")).unwrap();
    let reader = png::Decoder::new(std::io::BufReader::new(movie)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 12);
}

#[test]
fn two_fingers_at_their_own_rates_keep_their_gains() {
    let scratch = Scratch::new("rates");
    let out = scratch.join("out");
    let report = json(&[
        "focus",
        "hudin-2012",
        "--at",
        "40,50,1,20",
        "--at",
        "100,90,0.5,10",
        "--window-ms",
        "30",
        "-o",
        &out,
    ]);
    assert!((number(&report, "/period_s") - 0.1).abs() < 1e-9);
    let peak = |i: usize| number(&report, &format!("/targets/{i}/peak_velocity_m_s"));
    assert!(peak(0) > 1.2 * peak(1) && peak(1) > 0.0, "{} {}", peak(0), peak(1));
}

#[test]
fn shapes_are_targets_too() {
    let scratch = Scratch::new("shapes");
    let out = scratch.join("out");
    let svg = scratch.file(
        "ring.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="150mm" viewBox="0 0 150 150">
           <circle cx="75" cy="75" r="25" fill="none" stroke="black"/></svg>"#,
    );
    for shape in ["triangle:75,75,50", "circle:75,75,25", &svg] {
        let report = json(&["focus", "hudin-2012", "--shape", shape, "--window-ms", "30", "-o", &out]);
        assert!(number(&report, "/targets/0/points") > 20.0);
        assert!(number(&report, "/targets/0/contrast") > 3.0, "{report}");
    }
}

#[test]
fn losses_are_made_up_for() {
    let scratch = Scratch::new("losses");
    let out = scratch.join("out");
    let peak = |losses: &str| {
        let report = json(&[
            "focus",
            "hudin-2012",
            "--set",
            "drive.band_hz=[0, 1500]",
            "--no-figures",
            "--at",
            "62,90",
            "--window-ms",
            "60",
            "--losses",
            losses,
            "-o",
            &out,
        ]);
        number(&report, "/targets/0/peak_velocity_m_s") / number(&report, "/drive/energy").sqrt()
    };
    let (plain, uniform, per_mode) = (peak("none"), peak("uniform"), peak("per-mode"));
    assert!((uniform / per_mode - 1.0).abs() < 1e-3, "one decay time for all modes: {uniform} {per_mode}");
    assert!(uniform < plain, "time reversal is the matched filter: {uniform} {plain}");
}

#[test]
fn actuators_may_lie_on_top_of_each_other() {
    let scratch = Scratch::new("coincident");
    let film = |actuators: &str| {
        format!(
            "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
             thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 1000]\n\
             sample_rate_hz = 48000\n{actuators}"
        )
    };
    let coil = "[[actuator]]\nat_mm = [12, 31]\nkind = \"moving-magnet\"\nforce_constant_n_per_a = 6\n\
                resistance_ohm = 6.2\ninductance_mh = 1.9\nmoving_mass_mg = 100\ndriven_by = \"voltage\"\n";
    let force = "[[actuator]]\nat_mm = [12, 31]\n";
    let peak = |name: &str, actuators: &str| {
        let file = scratch.file(name, film(actuators));
        run(&["check", &file]);
        let out = scratch.join("out");
        let report =
            json(&["focus", &file, "--at", "62,90", "--window-ms", "20", "--full-limit", "-o", &out]);
        number(&report, "/targets/0/peak_velocity_m_s")
    };
    let (one, two) = (peak("one.toml", force), peak("two.toml", &force.repeat(2)));
    assert!((two / one - 2.0).abs() < 1e-6, "{one} {two}");
    let three = peak("coils.toml", &coil.repeat(3));
    assert!(three > 0.0 && three.is_finite());
}

#[test]
fn a_drive_may_know_of_the_finger() {
    let scratch = Scratch::new("aware");
    let out = scratch.join("out");
    let common =
        ["focus", "hudin-2012", "--at", "62,90", "--window-ms", "20", "--finger", "62,90", "-o", &out];
    // This is about the drive, and modes under a finger take long where there are many.
    let common = [&common[..], &["--full-limit", "--judge-hz", "3000"]].concat();
    let peak = |report: &Value| number(report, "/targets/0/peak_velocity_m_s").abs();
    let unaware = json(&common);
    let aware = json(&[&common[..], &["--finger-aware"]].concat());
    assert!(peak(&aware) > 1.5 * peak(&unaware));
    let notes = aware["notes"].as_array().unwrap();
    assert!(notes.iter().any(|note| note["topic"] == "fingers"), "{notes:?}");
    assert!(refused(&[&common[..6], &["--finger-aware", "-o", &out]].concat(), 2).contains("--finger"));
    let wide = [&common[..], &["--method", "robust", "--bear-tension-percent", "60"]].concat();
    assert!(refused(&wide, 2).contains("below 50"));
}
