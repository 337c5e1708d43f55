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

/// A surface, and a universal file of a computed library of 4 points on it.
fn universal(scratch: &Scratch) -> (String, String) {
    let (surface, library) = (scratch.file("film.toml", SMALL_FILM), scratch.join("film"));
    json(&["respond", &surface, "--grid-mm", "50", "--length-ms", "20", "-o", &library]);
    let file = scratch.join("film.uff");
    json(&["export", &library, "-o", &file]);
    (surface, file)
}

#[test]
fn a_label_that_is_not_understood_is_asked_about() {
    let scratch = Scratch::new("import-label");
    let (surface, file) = universal(&scratch);
    let text = std::fs::read_to_string(&file).unwrap();
    let (file, out) = (scratch.file("odd.uff", text.replace("m/s ", "ips ")), scratch.join("out"));
    let error = refused(&words(&surface, &file, &out, &[]), 2);
    assert!(error.contains("--unit: expected the unit of what was measured"), "{error}");
    assert!(error.contains("the label `ips`"), "{error}");
    json(&words(&surface, &file, &out, &["--unit", "in/s"]));
}

#[test]
fn the_unit_of_places_that_is_asked_for_goes_before_that_of_the_file() {
    let scratch = Scratch::new("import-length");
    let (surface, file) = universal(&scratch);
    // In the file's metres, all points would be off the sheet of 150 mm.
    let offset = ["--offset-mm", "149.5,100"];
    assert!(
        refused(&words(&surface, &file, &scratch.join("m"), &offset), 2).contains("a point on the surface")
    );
    json(&words(&surface, &file, &scratch.join("mm"), &[&offset[..], &["--length-unit", "mm"]].concat()));
}

#[test]
fn what_no_response_would_use_is_refused() {
    let scratch = Scratch::new("import-unused");
    let (surface, file) = universal(&scratch);
    let out = scratch.join("out");
    let error = refused(&words(&surface, &file, &out, &["--actuator", "a1=99"]), 2);
    assert!(error.contains("--actuator: expected a name or node in the files for a1, found `99`"), "{error}");
    let folder = scratch.join("wav");
    json(&["export", &scratch.join("film"), "-o", &folder]);
    let table = scratch.file("places.csv", "file,actuator,x_mm,y_mm\n");
    for more in [["--table", &table], ["--pattern", "{actuator}.wav"], ["--length-unit", "mm"]] {
        let error = refused(&words(&surface, &folder, &out, &more), 2);
        assert!(error.contains(&format!("{}: expected none, since folders", more[0])), "{error}");
    }
    json(&words(&surface, &folder, &out, &[]));
}
