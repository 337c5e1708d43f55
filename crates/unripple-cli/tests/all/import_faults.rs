//! Imports that are refused: what is wrong is named by file and place, and nothing is left behind that is in the way of the next import.

use crate::common;

use common::{SMALL_FILM, Scratch, json, refused};

/// Words of an import of a file to a folder, with more options.
fn words<'a>(surface: &'a str, file: &'a str, out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["import", surface, file, "-o", out][..], more].concat()
}

#[test]
fn values_beyond_single_precision_leave_no_library() {
    let scratch = Scratch::new("import-beyond");
    let surface = scratch.file("film.toml", SMALL_FILM);
    let out = scratch.join("out");
    let table = |value: &str| {
        let mut text = format!("time_s,a1 50 50,a2 50 50\n0,1,{value}\n");
        for sample in 1..=960 {
            text += &format!("{},0,0\n", f64::from(sample) / 48e3);
        }
        scratch.file("taps.csv", text)
    };
    let pattern = ["--pattern", "{actuator} {x_mm} {y_mm}"];
    let options =
        [&pattern[..], &["--kind", "impulse-responses", "--unit", "m/s", "--per", "newton"]].concat();
    let error = refused(&words(&surface, &table("1e300"), &out, &options), 2);
    let wanted = "taps.csv: column `a2 50 50`: expected values that single precision holds, found 1e300";
    assert!(error.contains(wanted), "{error}");
    json(&words(&surface, &table("0.5"), &out, &options));
    let modes = |mass: &str| {
        let text = "node,x_mm,y_mm,first\nfrequency_hz,,,200\ndamping_ratio,,,0.01\n";
        scratch.file("modes.csv", format!("{text}modal_mass_kg,,,{mass}\n1,12,31,1\n2,121,17,-1\n"))
    };
    let out = scratch.join("modal");
    let error = refused(&words(&surface, &modes("1e-60"), &out, &["--length-ms", "20"]), 2);
    assert!(error.contains("modes.csv: node 1: expected modes whose responses single precision"), "{error}");
    json(&words(&surface, &modes("1"), &out, &["--length-ms", "20"]));
}
