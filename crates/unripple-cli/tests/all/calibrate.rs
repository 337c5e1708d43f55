//! Calibrations of a virtual surface that is not as it is told: killed and taken up again, by probe and by taps.

use crate::common;

use common::{Scratch, json, number, refused};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;
use unripple_store::{Library, LibraryPlan, load_surface, to_toml};

const POINTS: [&str; 4] = ["--at=62,90", "--at=67,85", "--at=57,95", "--at=100,60"];

fn calibration(library: &str) -> Vec<&str> {
    // In a third of the band, where a calibration takes a quarter of the time.
    let band = ["--set", "drive.band_hz=[0, 1000]"];
    [&["calibrate", "hudin-2012", "--unknowns", "3", "-o", library][..], &band, &POINTS].concat()
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
        let mut child = crate::common::program()
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

    // When a library was begun is told as that of `respond` is, in ISO 8601, UTC.
    for library in [&whole, &torn] {
        let created = Library::open(library).unwrap().plan().provenance["created"].clone();
        let shape: String = created.chars().map(|c| if c.is_ascii_digit() { '0' } else { c }).collect();
        assert_eq!(shape, "0000-00-00T00:00:00Z", "{created}");
    }

    let focus = ["focus", &whole, "--at", "62,90", "--window-ms", "30", "-o", &scratch.join("out")];
    let focus = json(&focus);
    assert_eq!(focus["taken_on"], "library");
    let other = [&calibration(&whole)[..], &["--at=20,20"]].concat();
    assert!(refused(&other, 1).contains("points: 12 instead of 13"));
}

/// A library that was swept from 60 Hz on, as all once were, of a film whose lowest mode lies where sweeps begin below by now.
#[test]
fn a_library_is_gone_on_with_by_the_sweep_that_it_was_begun_with() {
    let scratch = Scratch::new("calibrate-before");
    let mut film = load_surface("hudin-2012").unwrap();
    (film.sheet.tension, film.emission.band[1]) = (45.0, 700.0);
    let file = scratch.file("film.toml", to_toml(&film));
    let (whole, begun, silent) = (scratch.join("whole"), scratch.join("begun"), scratch.join("silent"));
    let into = |library| ["calibrate", &file, "--unknowns", "3", "-o", library, "--at=62,90"];
    json(&into(&whole));
    let plan = Library::open(&whole).unwrap().plan().clone();
    let from = |plan: &LibraryPlan| {
        plan.provenance["swept Hz"].split_whitespace().next().and_then(|hz| hz.parse::<f64>().ok()).unwrap()
    };
    assert!(from(&plan) < 55.0, "{}", from(&plan));

    let mut before = plan.clone();
    before.provenance.insert("swept Hz".into(), "60 840".into());
    drop(Library::create(&begun, &before).unwrap());
    json(&into(&begun));
    let library = Library::open(&begun).unwrap();
    assert_eq!(from(library.plan()), 60.0);
    let runs = library.logged("runs").unwrap().as_array().unwrap();
    assert_eq!(runs.last().unwrap()["swept_hz"][0], 60.0);

    // Before that, nothing was said of it.
    let mut before = plan;
    before.provenance.remove("swept Hz");
    drop(Library::create(&silent, &before).unwrap());
    let said = refused(&into(&silent), 1);
    assert!(said.contains("`swept Hz`") && said.contains("into another library"), "{said}");
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
