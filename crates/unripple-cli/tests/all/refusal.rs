//! Bad input: a clear error, the right exit status, and nothing left half-written.

use crate::common;

use common::{Scratch, refused, run};

const FILM: &str = r#"format = 1
name = "A film"
[outline]
rectangle_mm = [150, 150]
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 70
[drive]
band_hz = [0, 1000]
sample_rate_hz = 48000
[[actuator]]
at_mm = [12, 31]
"#;

/// Says what is wrong with a file, in `check` and in `focus` alike, and writes nothing.
fn faulty(text: &str, expected: &[&str]) {
    let scratch = Scratch::new(&format!("faulty-{}", expected.join("-").replace(['/', ' ', '`'], "")));
    let file = scratch.file("film.toml", text);
    let out = scratch.join("out");
    for arguments in [vec!["check", &file], vec!["focus", &file, "--at", "62,90", "-o", &out]] {
        let errors = refused(&arguments, 2);
        for part in expected {
            assert!(errors.contains(part), "{part:?} in {errors}");
        }
    }
    assert_eq!(scratch.names(), ["film.toml"]);
}

#[test]
fn files_with_faults_are_refused_with_their_place() {
    faulty("", &["film.toml"]);
    faulty(&FILM.replace("thickness_mm", "thicknes_mm"), &["film.toml:7:1", "thickness_mm"]);
    faulty(&FILM.replace("= 0.125", "= -0.125"), &["film.toml:7:16", "sheet.thickness_mm", "-0.125"]);
    faulty(&FILM.replace("[12, 31]", "[12, 310]"), &["film.toml:14", "actuator[0].at_mm", "310"]);
    faulty(&FILM.replace("= 200", "= nan"), &["film.toml:8", "sheet.tension_n_per_m"]);
    faulty(&FILM.replace("[0, 1000]", "[0, 30000]"), &["film.toml:11", "24000"]);
    faulty(&FILM.replace("[0, 1000]", "[0, 24000]"), &["film.toml:11:11", "drive.band_hz", "below 24000 Hz"]);
    faulty(&FILM.replace("48000", "44100.5"), &["film.toml:12:18", "drive.sample_rate_hz", "a whole number"]);
    faulty(&FILM[..FILM.find("[[actuator]]").unwrap()], &["actuator"]);
}

#[test]
fn rates_set_for_a_run_are_refused_as_those_of_a_file() {
    let scratch = Scratch::new("set-rates");
    let out = scratch.join("out");
    for command in [vec!["check"], vec!["focus", "--at", "62,90", "-o", &out], vec!["place", "-o", &out]] {
        let set = ["hudin-2012", "--set", "drive.sample_rate_hz=44100.5"];
        let errors = refused(&[&command[..], &set].concat(), 2);
        assert!(
            errors.contains("drive.sample_rate_hz") && errors.contains("a whole number of Hz"),
            "{errors}"
        );
    }
    assert!(scratch.names().is_empty());
}

/// No mode below 164 Hz: known only when it is computed, and said alike by all that compute.
#[test]
fn a_band_without_modes_is_refused_by_name() {
    let scratch = Scratch::new("empty-band");
    let out = scratch.join("out");
    for command in [
        vec!["focus", "--at", "62,90", "-o", &out],
        vec!["compare", "--at", "62,90", "-o", &out],
        vec!["place", "--at", "62,90", "--grid-mm", "10", "-o", &out],
        vec!["sensors", "--grid-mm", "10", "-o", &out],
        vec!["respond", "--grid-mm", "30", "-o", &out],
        vec!["calibrate", "--grid-mm", "30", "-o", &out],
    ] {
        let set = ["hudin-2012", "--set", "drive.band_hz=[20, 40]"];
        let errors = refused(&[&command[..], &set].concat(), 2);
        let said =
            "drive.band_hz: expected modes within 20 to 40 Hz, found none (the next mode is at 163.7 Hz)";
        assert!(errors.contains(said), "{command:?}: {errors}");
    }
    assert!(scratch.names().is_empty());
}

#[test]
fn outlines_that_cannot_be_are_refused() {
    let rim = "rectangle_mm = [150, 150]";
    let shaped = |to: &str| FILM.replace(rim, to);
    faulty(
        &shaped("polygon_mm = [[0, 0], [150, 150], [150, 0], [0, 180]]"),
        &["film.toml:4:14", "sides 0 and 2"],
    );
    faulty(&shaped("polygon_mm = [[0, 0], [150, 0], [75, 0]]"), &["film.toml:4:14", "without area"]);
    let hole = |lines: &str| format!("{FILM}[[hole]]\n{lines}\n");
    faulty(
        &hole("circle_mm = 9\ncentre_mm = [200, 75]"),
        &["film.toml:16:13", "hole[0].circle_mm", "outside the outline"],
    );
    faulty(&hole("circle_mm = 9\ncentre_mm = [145, 75]"), &["film.toml:16:13", "touches or crosses the rim"]);
    faulty(
        &hole("circle_mm = 9\ncentre_mm = [14, 30]"),
        &["film.toml:14:9", "actuator[0].at_mm", "in a hole"],
    );
}

#[test]
fn what_nothing_holds_is_refused() {
    let limp = FILM.replace("thickness_mm", "young_gpa = 0\nthickness_mm");
    let free = format!("{}\nedge = \"free\"", "rectangle_mm = [150, 150]");
    faulty(
        &limp.replace("rectangle_mm = [150, 150]", &free),
        &["film.toml:5:8", "no edge fixed and no stiffness"],
    );
    faulty(&limp.replace("= 200", "= 0"), &["sheet.tension_n_per_m", "neither tension nor stiffness"]);
}

#[test]
fn ten_thousand_actuators_are_refused() {
    let many = "[[actuator]]\nat_mm = [12, 31]\n".repeat(10_000);
    faulty(&format!("{FILM}{many}"), &["actuator", "10001"]);
}

#[test]
fn all_faults_come_at_once() {
    let scratch = Scratch::new("all-faults");
    let text =
        FILM.replace("= 0.125", "= -0.125").replace("[12, 31]", "[12, 310]").replace("tension", "tensoin");
    let file = scratch.file("film.toml", text);
    let output = run(&["check", &file, "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["ok"], false);
    assert_eq!(report["faults"].as_array().unwrap().len(), 3, "{report}");
}

#[test]
fn targets_must_lie_on_the_surface() {
    let scratch = Scratch::new("targets");
    let out = scratch.join("out");
    for (at, expected) in [
        ("162,90", "nearest legal point (150.0000, 90.0000) mm"),
        ("NaN,90", "expected X,Y[,GAIN[,HZ]]"),
        ("62", "found 1 numbers"),
        ("62,90,1,0", "expected a number above 0 Hz"),
        ("0,90", "no actuator can move"),
    ] {
        let errors = refused(&["focus", "hudin-2012", "--at", at, "-o", &out], 2);
        assert!(errors.contains(expected), "{expected:?} in {errors}");
    }
    let errors = refused(&["focus", "hudin-2012", "-o", &out], 2);
    assert!(errors.contains("expected --at or --shape"), "{errors}");
    let most = refused(&["focus", "hudin-2012", "--at", "62,90", "--peak-um", "1e9", "-o", &out], 2);
    assert!(most.contains("which the drive limit gives"), "{most}");
    let most = refused(&["focus", "hudin-2012", "--at", "62,90", "--felt-db", "300", "-o", &out], 2);
    assert!(most.contains("dB above threshold, which the drive limit gives, found 300"), "{most}");
    let both = ["focus", "hudin-2012", "--at", "62,90", "--felt-db", "3", "--peak-um", "3", "-o", &out];
    assert!(refused(&both, 2).contains("cannot be used with"));
    assert!(scratch.names().is_empty(), "{:?}", scratch.names());
}

#[test]
fn what_is_typed_in_another_form_is_refused_by_its_option() {
    let scratch = Scratch::new("forms");
    let out = scratch.join("out");
    for (command, option, typed, said) in [
        ("focus", "--at", "62", "--at 62: expected X,Y[,GAIN[,HZ]] in mm and Hz, found 1 numbers"),
        ("focus", "--shape", "triangle:1,2", "--shape triangle: 1,2: expected X,Y and a size in mm"),
        ("focus", "--shape", "circle:1,2,-3", "--shape circle:1,2,-3: size: expected a number above 0 mm"),
        ("focus", "--waveform", "1,a,click:2", "--waveform 1,a: expected X,Y in mm, found `a`"),
        ("focus", "--waveform", "1,2,sine:250", "--waveform 1,2,sine: 250: expected HZ,MS[,UM]"),
        (
            "focus",
            "--waveform",
            "1,2,click:2,-1",
            "--waveform: level: expected a number above 0 µm, found -1",
        ),
        ("calibrate", "--wire", "a1=", "--wire a1=: expected NAME=CHANNEL, found `a1=`"),
        ("calibrate", "--input-scale", "a1=x", "--input-scale a1=x: expected a number other than 0"),
        ("place", "--rim-mm", "4", "--rim-mm 4: expected LEAST,MOST in mm, found 1 numbers"),
        ("place", "--at", "1,2,3,4", "--at 1,2,3,4: expected X,Y[,WEIGHT] in mm, found 4 numbers"),
    ] {
        let errors = refused(&[command, "hudin-2012", option, typed, "-o", &out], 2);
        assert!(errors.contains(said), "{said:?} in {errors}");
    }
    let movie = refused(&["field", "hudin-2012", "--drive", "drive.wav", "--movie-ms", "30,0"], 2);
    assert!(movie.contains("--movie-ms 30,0: expected 0 <= FROM < TO, found otherwise"), "{movie}");
    assert!(scratch.names().is_empty());
}

#[test]
fn numbers_without_meaning_are_usage_errors() {
    let scratch = Scratch::new("numbers");
    let out = scratch.join("out");
    let focus = |option: &str, value: &str| {
        refused(&["focus", "hudin-2012", "--at", "62,90", option, value, "-o", &out], 2)
    };
    assert!(focus("--window-ms", "-3").contains("--window-ms: expected a number above 0 ms, found -3"));
    assert!(focus("--window-ms", "NaN").contains("found NaN"));
    assert!(focus("--felt-db", "inf").contains("--felt-db: expected a finite number of dB, found inf"));
    assert!(focus("--method", "one-bti").contains("one-bit"));
    assert!(focus("--judge-hz", "0").contains("Hz"));
    assert!(refused(&["modes", "hudin-2012", "--max-hz", "-1"], 2).contains("--max-hz"));
    assert!(refused(&["modes", "hudin-2012", "--accuracy", "2"], 2).contains("accuracy"));
    assert!(refused(&["modes", "hudin-2012", "--max-hz", "1e7"], 2).contains("GiB"));
    assert!(refused(&["design", "hudin-2021"], 2).contains("nearest: hudin-2012"));
    assert!(scratch.names().is_empty());
}

#[test]
fn foreign_folders_are_left_alone() {
    let scratch = Scratch::new("foreign");
    std::fs::create_dir(scratch.path().join("thesis")).unwrap();
    scratch.file("thesis/chapter.md", "years of work");
    let out = scratch.join("thesis");
    let errors = refused(&["focus", "hudin-2012", "--at", "62,90", "-o", &out], 1);
    assert!(errors.contains("will not write"), "{errors}");
    let file = scratch.file("file", "");
    refused(&["focus", "hudin-2012", "--at", "62,90", "-o", &format!("{file}/out")], 1);
    assert_eq!(scratch.names(), ["file", "thesis"]);
    assert_eq!(std::fs::read_to_string(format!("{out}/chapter.md")).unwrap(), "years of work");
}

#[test]
fn drives_that_do_not_fit_are_refused() {
    let scratch = Scratch::new("drives");
    let text = scratch.file("drive.wav", "not a wave");
    assert!(refused(&["field", "hudin-2012", "--drive", &text], 2).contains("WAV"));
    let film = scratch.file("film.toml", FILM);
    let out = scratch.join("out");
    assert!(run(&["focus", &film, "--at", "62,90", "-o", &out]).status.success());
    let drive = format!("{out}/drive.wav");
    let errors = refused(&["field", "hudin-2012", "--drive", &drive], 2);
    assert!(errors.contains('8') && errors.contains('1'), "{errors}");
    let late = ["field", &film, "--drive", &drive, "--at", "62,90", "--at-ms", "-1"];
    assert!(refused(&late, 2).contains("instant"));
    assert!(refused(&["field", &film, "--drive", "no-such.wav"], 2).contains("no-such.wav"));
}
