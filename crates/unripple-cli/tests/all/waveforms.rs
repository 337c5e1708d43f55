//! Waveforms, silence and strokes from the command line.

use crate::common;

use common::{Scratch, json, number, refused};

#[test]
fn two_tones_and_a_silence_are_reported_as_measured() {
    let scratch = Scratch::new("waveforms");
    let out = scratch.join("out");
    let report = json(&[
        "focus",
        "hudin-2012",
        "--waveform",
        "45,60,burst:250,20,2",
        "--waveform",
        "105,90,sine:80,100",
        "--silent",
        "75,40",
        "-o",
        &out,
    ]);
    for index in 0..2 {
        let figure = |key: &str| number(&report, &format!("/waveforms/{index}/{key}"));
        assert!((figure("gain") - 1.0).abs() < 0.02, "{}", figure("gain"));
        assert!(figure("error_db") < -30.0 && figure("crosstalk_db") < -20.0);
        assert!(figure("lost") < 0.01 && (figure("start_s") - 0.03).abs() < 1e-9);
    }
    assert!((number(&report, "/waveforms/0/asked_peak_m") / 2e-6 - 1.0).abs() < 0.05);
    assert!(number(&report, "/silent/0/level_db") < -30.0);
    assert_eq!(report["method"], "waveforms");
    assert!(
        std::fs::read_to_string(format!("{out}/report.md")).unwrap().contains("waveform (45.00, 60.00) mm")
    );
}

#[test]
fn strokes_are_reported_along_their_path() {
    let scratch = Scratch::new("stroke");
    let out = scratch.join("out");
    let report =
        json(&["focus", "hudin-2012", "--path", "line:60,75,80,75", "--speed-mm-s", "100", "-o", &out]);
    assert_eq!(number(&report, "/stroke/pulses"), 41.0);
    for key in ["level_range_db/0", "level_range_db/1", "peak_range_db/0", "peak_range_db/1"] {
        let db = number(&report, &format!("/stroke/{key}"));
        assert!(db.abs() < 1.0, "{key}: {db}");
    }
}

#[test]
fn what_does_not_go_together_is_refused() {
    let scratch = Scratch::new("waveform-refusals");
    let out = scratch.join("out");
    let wave = ["--waveform", "45,60,click:2"];
    for (arguments, expected) in [
        (vec!["--silent", "1,2"], "expected --waveform"),
        (vec!["--path", "line:60,75,80,75"], "expected --speed-mm-s"),
        (vec!["--speed-mm-s", "100", "--at", "1,2"], "expected --path"),
        ([&wave[..], &["--at", "1,2"]].concat(), "expected no --at"),
        ([&wave[..], &["--path", "line:1,2,3,4"]].concat(), "expected no --path"),
        (vec!["--waveform", "45,60,nowhere.wav"], "nowhere.wav"),
        (vec!["--waveform", "450,60,click:2"], "outside the surface"),
    ] {
        let errors = refused(&[&["focus", "hudin-2012"], &arguments[..], &["-o", &out]].concat(), 2);
        assert!(errors.contains(expected), "{expected:?} in {errors}");
    }
    assert!(scratch.names().is_empty());
}
