//! Calibrations of a virtual surface that is not as it is told: killed and taken up again, by probe and by taps.

mod common;

use common::{Scratch, json, number, refused};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

const POINTS: [&str; 4] = ["--at=62,90", "--at=67,85", "--at=57,95", "--at=100,60"];

fn calibration(library: &str) -> Vec<&str> {
    [&["calibrate", "hudin-2012", "--unknowns", "3", "-o", library][..], &POINTS].concat()
}

fn chunk(library: &Path, point: usize) -> PathBuf {
    library.join(format!("responses/c.{point}.0.0"))
}

#[test]
fn killed_and_taken_up_again_is_the_same_library() {
    let scratch = Scratch::new("calibrate");
    let (whole, torn) = (scratch.join("whole"), scratch.join("torn"));
    let made = json(&calibration(&whole));
    assert_eq!((number(&made, "/measured"), number(&made, "/probed")), (12.0, 4.0));
    assert!(number(&made, "/signal_to_noise_db/median") > 30.0);
    assert!(number(&made, "/latency_samples").abs() < 0.1);

    // Killed as soon as the first point is there, and again at the third, whatever it is doing.
    for point in [0, 2] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_unripple"))
            .args(calibration(&torn))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while !chunk(Path::new(&torn), point).exists() && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(5));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_eq!(number(&json(&calibration(&torn)), "/measured"), 12.0);
    for point in 0..12 {
        let [a, b] = [&whole, &torn].map(|library| std::fs::read(chunk(Path::new(library), point)).unwrap());
        assert!(a == b, "point {point}");
    }

    let focus = ["focus", &whole, "--at", "62,90", "--window-ms", "30", "-o", &scratch.join("out")];
    let focus = json(&focus);
    assert_eq!(focus["taken_on"], "library");
    let other = [&calibration(&whole)[..], &["--at=20,20"]].concat();
    assert!(refused(&other, 1).contains("points: 12 instead of 13"));
}

#[test]
fn what_cannot_be_calibrated_is_refused() {
    let scratch = Scratch::new("calibrate-refused");
    let library = scratch.join("lib");
    let with = |more: &[&'static str]| {
        let all: Vec<String> = ["calibrate", "hudin-2012", "-o", &library].map(str::to_owned).to_vec();
        let all = all.into_iter().chain(more.iter().map(|text| (*text).to_owned())).collect::<Vec<_>>();
        refused(&all.iter().map(String::as_str).collect::<Vec<_>>(), 2)
    };
    assert!(with(&["--at", "162,90"]).contains("beyond its edge"));
    assert!(with(&["--at", "62,90", "--wire", "a1"]).contains("NAME=CHANNEL"));
    assert!(with(&["--at", "62,90", "--level", "2"]).contains("level"));
    assert!(with(&["--at", "62,90", "--repeats", "0"]).contains("--repeats"));
    let jack = [
        "calibrate",
        "hudin-2012",
        "--device",
        "jack",
        "--jack-server",
        "nowhere",
        "--at=1,1",
        "-o",
        &library,
    ];
    assert!(refused(&jack, 1).contains("JACK"));
}
