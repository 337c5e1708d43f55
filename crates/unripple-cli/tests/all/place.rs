//! `place`: layouts that are better than random ones and keep to the rules, written as surfaces that other commands read.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;
use unripple::core::{Point, Surface};
use unripple_store::{load_surface, to_toml};

/// The paper's film in a fifth of its band: a dozen modes, and one ring of places at its rim.
const FILM: [&str; 4] = ["place", "hudin-2012", "--set", "drive.band_hz=[0,600]"];

/// Side of the film, in metres.
const SIDE: f64 = 0.15;

/// The report on the film with three actuators near its rim.
fn placed(more: &[&str]) -> Value {
    json(&[&FILM[..], &["--count", "3", "--rim-mm", "6,12"], more].concat())
}

/// Names and places (m) of a layout in a report.
fn layout(report: &Value, which: &str) -> Vec<(String, Point)> {
    let actuators = report[which]["actuators"].as_array().unwrap();
    let of = |actuator: &Value| {
        let at = Point::new(number(actuator, "/at_m/0"), number(actuator, "/at_m/1"));
        (actuator["name"].as_str().unwrap().to_owned(), at)
    };
    actuators.iter().map(of).collect()
}

fn names(layout: &[(String, Point)]) -> Vec<&str> {
    layout.iter().map(|(name, _)| name.as_str()).collect()
}

/// Names and places (m) of a surface's actuators.
fn actuators(surface: &Surface) -> Vec<(String, Point)> {
    surface.actuators.iter().map(|actuator| (actuator.name.clone(), actuator.at)).collect()
}

/// Whether two layouts have the same names, and the same places but for rounding.
fn same(a: &[(String, Point)], b: &[(String, Point)]) -> bool {
    let near = |((_, a), (_, b)): (&(String, Point), &(String, Point))| a.distance(*b) < 1e-12;
    names(a) == names(b) && a.iter().zip(b).all(near)
}

/// Distance from the rim of the film, in metres.
fn to_rim(at: Point) -> f64 {
    [at.x, SIDE - at.x, at.y, SIDE - at.y].into_iter().fold(f64::INFINITY, f64::min)
}

/// Whether a number is between two others, but for rounding.
fn within(found: f64, least: f64, most: f64) -> bool {
    (least - 1e-9..=most + 1e-9).contains(&found)
}

#[test]
fn a_placed_surface_is_written_and_passes_check() {
    let scratch = Scratch::new("place-written");
    let out = scratch.join("placed");
    let report = placed(&["-o", &out]);
    let held = |name: &str| scratch.path().join("placed").join(name).is_file();
    for name in ["surface.toml", "report.json", "report.md"] {
        assert!(held(name), "{name}");
    }
    let files: Vec<&str> = report["files"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    for figure in ["places", "numbers"] {
        for ending in ["svg", "pdf", "png", "csv"] {
            assert!(files.contains(&format!("{figure}.{ending}").as_str()), "{figure}.{ending}: {files:?}");
        }
    }
    assert!(files.iter().all(|name| held(name)), "{files:?}");
    let bytes = std::fs::read(format!("{out}/report.json")).unwrap();
    let stored: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(stored["after"], report["after"]);
    // Those of the file that were taken away lend their names, in their order.
    let (file, after) = (format!("{out}/surface.toml"), layout(&report, "after"));
    assert_eq!(names(&after), ["a1", "a2", "a3"]);
    assert_eq!(json(&["check", &file])["ok"], true);
    let written = load_surface(&file).unwrap();
    assert!(same(&actuators(&written), &after), "{after:?}");
    let film = load_surface("hudin-2012").unwrap();
    assert!(same(&layout(&report, "before"), &actuators(&film)), "{report}");
    assert_eq!(written.emission.band, [0.0, 600.0]);
    assert_eq!(written.outline, film.outline);
}

#[test]
fn placed_actuators_are_better_than_random_ones() {
    let report = placed(&[]);
    let contrast = |which: &str| number(&report, &format!("/{which}/mean_contrast"));
    assert!(contrast("after") > contrast("random"), "{report}");
    assert_eq!(["/placed_for", "/evaluated_on"].map(|key| number(&report, key)), [20.0, 60.0]);
    assert_eq!(report["held_out"], true);
    assert!(report["files"].as_array().unwrap().is_empty());
    for (_, at) in layout(&report, "after") {
        assert!(within(to_rim(at), 6e-3, 12e-3), "{at}");
    }
    // There are few enough layouts on the grid to compare all, none is better than the best of them, and that one is taken.
    let (best, most) = (number(&report, "/restarts/best"), number(&report, "/certificate/objective"));
    assert!(best <= most * (1.0 + 1e-3), "{best} {most}");
    assert!(number(&report, "/restarts/polished") >= most * (1.0 - 1e-3), "{report}");
    let rows = report["each_number"].as_array().unwrap();
    let numbers: Vec<u64> = rows.iter().filter_map(|row| row["actuators"].as_u64()).collect();
    assert_eq!(numbers, [1, 2, 3, 4, 5, 6]);
}

#[test]
fn what_is_kept_stays_where_it_is() {
    let own = actuators(&load_surface("hudin-2012").unwrap());
    let report = placed(&["--keep", "a5", "--keep", "a1"]);
    let after = layout(&report, "after");
    assert_eq!(names(&after), ["a1", "a2", "a3", "a4", "a5"]);
    assert!(same(&[after[0].clone(), after[4].clone()], &[own[0].clone(), own[4].clone()]), "{after:?}");
    assert_eq!(report["kept"].as_array().unwrap().len(), 2);
    let all = json(&[&FILM[..], &["--count", "1", "--rim-mm", "6,12", "--keep-all"]].concat());
    let after = layout(&all, "after");
    assert!(after.len() == 9 && same(&after[..8], &own) && after[8].0 == "a9", "{after:?}");
}

#[test]
fn places_keep_to_the_areas_and_distances_that_are_set() {
    let half = ["--keep-out", "0,0,75,0,75,150,0,150"];
    for (_, at) in layout(&placed(&half), "after") {
        assert!(within(at.x, SIDE / 2.0, SIDE), "{at}");
    }
    for (_, at) in layout(&placed(&["--within", "0,0,75,0,75,75,0,75", "--apart-mm", "20"]), "after") {
        assert!(within(at.x, 0.0, SIDE / 2.0) && within(at.y, 0.0, SIDE / 2.0), "{at}");
    }
    let apart = layout(&placed(&["--apart-mm", "60"]), "after");
    for (i, (_, a)) in apart.iter().enumerate() {
        for (_, b) in &apart[..i] {
            assert!(a.distance(*b) >= 60e-3 - 1e-9, "{a} {b}");
        }
    }
    // Places that are listed are taken as they are.
    let places = ["--place", "10,10", "--place", "20,140", "--place", "135,70", "--count", "2"];
    let listed = [(10.0, 10.0), (20.0, 140.0), (135.0, 70.0)].map(|(x, y)| Point::from_mm(x, y));
    for (_, at) in layout(&json(&[&FILM[..], &places].concat()), "after") {
        assert!(listed.iter().any(|place| place.distance(at) < 1e-9), "{at}");
    }
}

#[test]
fn actuators_with_an_extent_lie_wholly_on_the_sheet_and_outside_areas() {
    let scratch = Scratch::new("place-extent");
    let mut film = load_surface("hudin-2012").unwrap();
    film.emission.band = [0.0, 600.0];
    film.actuators.iter_mut().for_each(|actuator| actuator.contact_radius = 8e-3);
    let file = scratch.file("discs.toml", to_toml(&film));
    let half = ["place", &file, "--count", "3", "--keep-out", "0,0,75,0,75,150,0,150", "--restarts", "1"];
    let targets = ["--at", "62,90", "--at", "90,40", "--window-ms", "10"];
    // Three reach into the area or beyond the rim with 8 mm, three do not.
    let places = ["78,20", "82,75", "100,4", "90,140", "120,60", "110,110"];
    let places: Vec<&str> = places.iter().flat_map(|place| ["--place", *place]).collect();
    let report = json(&[&half[..], &targets, &places].concat());
    assert_eq!(report["places"], 3);
    for (_, at) in layout(&report, "after") {
        assert!(at.x >= 83e-3 && to_rim(at) >= 8e-3, "{at}");
    }
    // Nor do they between the places of a grid.
    let report = json(&[&half[..], &targets, &["--grid-mm", "12"]].concat());
    for (_, at) in layout(&report, "after") {
        assert!(within(at.x, 83e-3, SIDE) && within(to_rim(at), 8e-3, SIDE), "{at}");
    }
}

#[test]
fn targets_that_are_given_are_those_of_the_evaluation() {
    let report = placed(&["--at", "62,90", "--at", "90,60,3", "--method", "time-reversal"]);
    assert_eq!(["/placed_for", "/evaluated_on"].map(|key| number(&report, key)), [2.0, 2.0]);
    assert_eq!(report["held_out"], false);
    let notes = report["notes"].as_array().unwrap();
    assert!(notes.iter().any(|note| note["topic"] == "targets"), "{notes:?}");
    let method = &report["methods"][0];
    assert_eq!(method["method"], "time-reversal");
    assert_eq!(method["targets"], 2);
    assert!(number(method, "/before/contrast") > 0.0 && number(method, "/after/contrast") > 0.0);
}

#[test]
fn targets_count_by_where_they_are() {
    let scratch = Scratch::new("place-importance");
    let left = "0,0,75,0,75,150,0,150";
    // Whether it is said by an area or by a table, only the weights' ratios matter.
    let table = scratch.file("map.csv", "x_mm,y_mm,weight\n37.5,75,6\n112.5,75,2\n");
    let by_table = placed(&["--importance", &table, "--restarts", "2", "--window-ms", "10"]);
    let area = format!("{left}:3");
    let by_area = placed(&["--important", &area, "--restarts", "2", "--window-ms", "10"]);
    let mean = |report: &Value| number(report, "/after/mean_contrast");
    assert!((mean(&by_table) / mean(&by_area) - 1.0).abs() < 1e-6, "{by_table} {by_area}");
    // With a factor of 0 no target is there, as with an area for the screen.
    let none = placed(&["--important", &format!("{left}:0"), "--restarts", "2", "--window-ms", "10"]);
    assert!(number(&none, "/after/worst_at_m/0") >= SIDE / 2.0, "{none}");
    assert_eq!(["/placed_for", "/evaluated_on"].map(|key| number(&none, key)), [20.0, 60.0]);
}

#[test]
fn the_worst_target_can_be_what_counts_with_errors_to_bear() {
    let report = placed(&["--mounting-mm", "2", "--tension-percent", "3", "--objective", "worst"]);
    assert_eq!(report["objective"], "least contrast");
    let [placed, random] =
        ["after", "random"].map(|which| number(&report, &format!("/{which}/worst_contrast")));
    assert!(placed > random, "{placed} {random}");
    let builds = report["mounting"].as_array().unwrap();
    let errors: Vec<f64> = builds.iter().map(|build| number(build, "/error_m")).collect();
    assert!(!errors.is_empty() && errors.is_sorted(), "{errors:?}");
}

#[test]
fn layouts_can_be_compared_by_what_drives_of_a_method_reach() {
    let places = ["--place", "12,20", "--place", "75,9", "--place", "139,60", "--place", "10,90"];
    let drives = ["--method", "inverse", "--by", "felt-contrast", "--evaluations", "5"];
    let targets = ["--count", "2", "--at", "62,90", "--at", "90,40,2", "--window-ms", "15"];
    let report = json(&[&FILM[..], &targets, &places, &drives].concat());
    let second = &report["second_search"];
    assert_eq!(second["method"], "inverse");
    assert_eq!(second["by"], "felt_contrast_db");
    assert_eq!(second["objective"], "mean felt contrast (dB)");
    assert!(number(second, "/layouts") <= 5.0 && number(second, "/most_layouts") == 5.0, "{second}");
    let [before, found] = ["time_reversal", "found"].map(|key| number(second, &format!("/searched/{key}")));
    assert!(found >= before, "{second}");
    // The table by method is of the layout that was found, at the same targets with the same weights.
    let [table, found] = [(&report, "/methods/0/after/felt_contrast_db"), (second, "/evaluated/found")]
        .map(|(of, key)| number(of, key));
    assert!(table > 0.0 && (table / found - 1.0).abs() < 1e-4, "{report}");
    assert!(placed(&["--restarts", "1"])["second_search"].is_null());
}

#[test]
fn the_text_has_the_layouts_beside_each_other() {
    let output = run(&[&FILM[..], &["--count", "3", "--rim-mm", "6,12"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let rows = ["\nplaced ", "\nlayout of the file ", "\nrandom, 20 layouts "];
    let discs = "note (focal disc): a focal disc, of radius ";
    for part in ["3 actuators placed", "certificate: ", discs].iter().chain(&rows) {
        assert!(text.contains(part), "{part:?} in {text}");
    }
}

#[test]
fn bad_input_is_refused_with_the_option() {
    let scratch = Scratch::new("place-refused");
    let out = scratch.join("out");
    for (typed, option) in [
        (&["--like", "a9"][..], "--like: expected one of a1, a2"),
        (&["--keep", "a9"], "--keep: expected one of a1, a2"),
        (&["--keep", "a1", "--keep-all"], "--keep-all"),
        (&["--count", "0"], "--count: expected 1 to 1000, found 0"),
        (&["--count", "900", "--rim-mm", "6,12"], "--keep-out: expected at least 900"),
        (&["--count", "2", "--place", "10,10"], "--place"),
        (&["--rim-mm", "12,6"], "--rim-mm: expected two distances"),
        (&["--rim-mm", "6"], "--rim-mm"),
        (&["--within", "0,0,10,10"], "--within 0,0,10,10: expected at least three corners"),
        (&["--keep-out", "0,0,10,10,20,0,5"], "--keep-out 0,0,10,10,20,0,5: expected pairs X,Y"),
        (&["--screen", "200,200,300,200,300,300"], "--screen"),
        (&["--at", "200,90"], "--at: expected points on the surface"),
        (&["--at", "62,90,0"], "--at: expected numbers above 0"),
        (&["--important", "0,0,10,10,20,0"], "--important 0,0,10,10,20,0: expected X,Y,X,Y,X,Y...:WEIGHT"),
        (
            &["--important", "0,0,150,0,150,150,0,150:0"],
            "--importance, --important: expected weights above 0",
        ),
        (&["--importance", "none.csv"], "none.csv"),
        (&["--evaluations", "5"], "--evaluations: expected a figure that layouts are compared by, as --by"),
        (&["--by", "contrast", "--evaluations", "0"], "--evaluations: expected 1 to 1000"),
        (&["--by", "loudness"], "--by"),
        (&["--grid-mm", "-1"], "--grid-mm"),
        (
            &["--keep-out", "0,0,150,0,150,150,0,150"],
            "--place, --grid-mm, --rim-mm, --within, --keep-out: expected at least",
        ),
        (
            &["--objective", "quantile", "--share-percent", "150"],
            "--share-percent: expected a share from 0 to 100 %, found 150 %",
        ),
        (&["--mounting-mm", "-1"], "--mounting-mm"),
        (&["--mounting-mm", "20"], "--mounting-mm: expected at most a quarter of the shortest wavelength"),
        (&["--set", "sheet.tension_n_per_m=0", "--tension-percent", "5"], "--tension-percent: expected 0 %"),
        (
            &["--place", "400,400", "--place", "10,10", "--count", "1"],
            "--place: expected points on the surface",
        ),
        (&["--tension-percent", "80"], "--tension-percent: expected a share from 0 to 50 %, found 80 %"),
        (&["--apart-mm", "nan"], "--apart-mm"),
        (&["--window-ms", "0"], "--window-ms"),
    ] {
        let errors = refused(&[&FILM[..], typed, &["-o", &out]].concat(), 2);
        assert!(errors.contains(option), "{typed:?}: {option:?} in {errors}");
    }
    assert!(scratch.names().is_empty(), "{:?}", scratch.names());
}
