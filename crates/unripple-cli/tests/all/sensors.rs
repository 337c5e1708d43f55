//! `sensors`: places that tell more than random ones and keep to the rules, and a certificate that holds.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;
use unripple::core::Point;

/// The paper's film in a tenth of its band, a uniform tension, and a coarse grid.
const FILM: [&str; 8] =
    ["sensors", "hudin-2012", "--set", "drive.band_hz=[0,400]", "--profile", "0", "--grid-mm", "12"];

fn planned(more: &[&str]) -> Value {
    json(&[&FILM[..], &["--restarts", "2"], more].concat())
}

/// The planned places of a report.
fn places(report: &Value) -> Vec<Point> {
    let of = |at: &Value| Point::new(number(at, "/0"), number(at, "/1"));
    report["at_m"].as_array().unwrap().iter().map(of).collect()
}

/// A figure of each unknown of a report.
fn deviations(report: &Value, which: &str) -> Vec<f64> {
    let unknowns = report["unknowns"].as_array().unwrap();
    unknowns.iter().map(|unknown| number(unknown, &format!("/{which}"))).collect()
}

#[test]
fn a_plan_is_certified_and_tells_more_than_random_places() {
    let report = planned(&["--count", "3"]);
    let of = |key: &str| number(&report, &format!("/certificate/{key}"));
    assert_eq!(report["certificate"]["certified"], true, "{report}");
    assert!(of("efficiency") > of("random") && of("efficiency") <= 1.0 && of("random") > 0.0, "{report}");
    assert!(of("even") <= of("efficiency") * (1.0 + 1e-9) && of("told") > 3.0, "{report}");
    let [prior, planned] = ["prior", "planned"].map(|which| deviations(&report, which));
    assert!(planned.iter().zip(&prior).all(|(planned, prior)| planned <= prior), "{report}");
    assert!(planned[0] < 0.1 * prior[0], "the tension is told: {report}");
    let rows = report["each_number"].as_array().unwrap();
    assert_eq!(rows.iter().filter_map(|row| row["places"].as_u64()).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
    let means: Vec<f64> = rows.iter().map(|row| number(row, "/mean_deviation")).collect();
    assert!(means.windows(2).all(|two| two[1] < two[0]), "{means:?}");
    // The order is that of what each adds; no two are one.
    let places = places(&report);
    assert!(places.len() == 3 && places[0].distance(places[1]) > 1e-3, "{places:?}");
    let correlation = number(&report, "/worst_pair/correlation");
    assert!(correlation.abs() <= 1.0 && report["worst_pair"]["unknowns"].as_array().unwrap().len() == 2);
}

#[test]
fn taps_tell_of_sensors_and_sweeps_of_drives() {
    let (sweeps, taps): (&[&str], &[&str]) = (&[], &["--taps"]);
    let (drive, sense) = ("drive gain of a1", "sensor gain of a1");
    for (options, told, untold) in [(sweeps, drive, sense), (taps, sense, drive)] {
        let report = planned(&[&["--count", "2", "--up-to", "2"][..], options].concat());
        let names = |list: &Value| -> Vec<String> {
            let of = |item: &Value| item["name"].as_str().or(item.as_str()).unwrap().to_owned();
            list.as_array().unwrap().iter().map(of).collect()
        };
        assert!(names(&report["unknowns"]).contains(&told.to_owned()), "{report}");
        assert!(names(&report["untold"]).contains(&untold.to_owned()), "{report}");
    }
}

#[test]
fn places_keep_to_the_rules_and_their_distances() {
    let report = planned(&[
        "--count",
        "3",
        "--up-to",
        "3",
        "--rim-mm",
        "20,60",
        "--apart-mm",
        "40",
        "--keep",
        "75,75",
    ]);
    let mut all = places(&report);
    for at in &all {
        let to_rim = [at.x, 0.15 - at.x, at.y, 0.15 - at.y].into_iter().fold(f64::INFINITY, f64::min);
        assert!((0.02 - 1e-9..=0.06 + 1e-9).contains(&to_rim), "{at}");
    }
    all.push(Point::from_mm(75.0, 75.0));
    for (i, a) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|b| a.distance(*b) >= 40e-3 - 1e-9), "{all:?}");
    }
    assert_eq!(report["kept_m"].as_array().unwrap().len(), 1);
    let listed = ["--count", "2", "--place", "40,50", "--place", "90,60", "--place", "110,120"];
    for at in places(&json(&[&FILM[..6], &listed].concat())) {
        let listed = [(40.0, 50.0), (90.0, 60.0), (110.0, 120.0)].map(|(x, y)| Point::from_mm(x, y));
        assert!(listed.iter().any(|place| place.distance(at) < 1e-9), "{at}");
    }
}

#[test]
fn the_folder_has_the_report_and_its_figures() {
    let scratch = Scratch::new("sensors-written");
    let out = scratch.join("planned");
    let report = planned(&["--count", "2", "-o", &out]);
    let files: Vec<&str> = report["files"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    for figure in ["sensitivity", "numbers"] {
        for ending in ["svg", "pdf", "png", "csv"] {
            assert!(files.contains(&format!("{figure}.{ending}").as_str()), "{figure}.{ending}: {files:?}");
        }
    }
    let held = |name: &str| scratch.path().join("planned").join(name).is_file();
    assert!(files.iter().copied().chain(["report.json", "report.md"]).all(held), "{files:?}");
    let output = run(&[&FILM[..], &["--count", "2", "--restarts", "0"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for part in ["2 sensors planned", "certificate: ", "told by no place: ", "\ntension "] {
        assert!(text.contains(part), "{part:?} in {text}");
    }
}

#[test]
fn bad_input_is_refused_with_the_option() {
    let scratch = Scratch::new("sensors-refused");
    let out = scratch.join("out");
    for (typed, option) in [
        (&["--count", "0"][..], "--count: expected 1 to 1000, found 0"),
        (&["--count", "900"], "--count, --grid-mm, --rim-mm, --within, --keep-out: expected at least 900"),
        (&["--keep", "400,400"], "--keep: expected points on the surface"),
        (&["--place", "400,400"], "--place: expected points on the surface"),
        (&["--rim-mm", "12,6"], "--rim-mm: expected two distances"),
        (&["--within", "0,0,10,10"], "--within 0,0,10,10: expected at least three corners"),
        (&["--apart-mm", "nan"], "--apart-mm"),
        (&["--apart-mm", "200"], "--count, --apart-mm: expected room for 4 places"),
        (&["--snr-db", "1e3"], "--snr-db: expected a number from -100 to 120 dB"),
    ] {
        let errors = refused(&[&FILM[..], typed, &["-o", &out]].concat(), 2);
        assert!(errors.contains(option), "{typed:?}: {option:?} in {errors}");
    }
    let errors = refused(&[&FILM[..4], &["--profile", "9", "-o", &out]].concat(), 2);
    assert!(errors.contains("--profile: expected 0 to 8, found 9"), "{errors}");
    assert!(scratch.names().is_empty(), "{:?}", scratch.names());
}
