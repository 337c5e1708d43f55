//! Calibration by taps: the model by which their forces are found, and what is said where there is none.

use crate::bench;
use crate::common;

use bench::FILM;
use common::{Scratch, run};
use unripple_store::Library;

#[test]
fn taps_are_measured_by_a_fitted_model_if_there_is_one() {
    let scratch = Scratch::new("taps");
    let film = scratch.file("film.toml", FILM);
    let calibrate = ["calibrate", &film, "--unknowns", "5", "--at", "52,47", "--by", "tap", "--repeats", "2"];
    let tapped = |folder: &str, more: &[&str]| {
        let folder = scratch.join(folder);
        let output = run(&[&calibrate[..], more, &["-o", &folder]].concat());
        assert!(output.status.success());
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        (Library::open(&folder).unwrap().logged_point(0).unwrap()["taps"]["fitted"].clone(), said)
    };
    let (fitted, said) = tapped("fitted", &[]);
    assert!(fitted == true && !said.contains("forces of taps"), "{said}");
    let (fitted, said) = tapped("unfitted", &["--no-model"]);
    let expected = "at 1 point the forces of taps are computed with the model of the surface file";
    assert!(fitted == false && said.contains(expected) && said.contains("(--no-model)"), "{said}");
    // The point stays as it was measured, whatever a later run knows, and whoever uses it is told.
    let (fitted, said) = tapped("unfitted", &[]);
    assert!(fitted == false && said.contains(expected), "{said}");
    let focused = run(&["focus", &scratch.join("unfitted"), "--at", "52,47", "-o", &scratch.join("touch")]);
    let warned = String::from_utf8_lossy(&focused.stderr);
    assert!(focused.status.success() && warned.contains(expected), "{warned}");
}
