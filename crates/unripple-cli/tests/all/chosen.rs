//! `place` on a library: which of its actuators to keep.

use crate::common;

use common::{SMALL_FILM, Scratch, json, number, refused, run};
use serde_json::Value;

/// Places of four actuators more than the small film has, in mm.
const MORE: [&str; 4] = ["9, 84", "95, 137", "141, 106", "40, 140"];

/// A film of few modes with six actuators.
fn film() -> String {
    let more = MORE.map(|at| format!("[[actuator]]\nat_mm = [{at}]\n"));
    SMALL_FILM.replace("48000", "8000") + &more.concat()
}

/// The path of a library of the film in a folder: points 10 mm apart, responses of 30 ms.
fn library(scratch: &Scratch) -> String {
    let (film, library) = (scratch.file("film.toml", film()), scratch.join("library"));
    let made = json(&["respond", &film, "--grid-mm", "10", "--length-ms", "30", "-o", &library]);
    assert_eq!((number(&made, "/points"), number(&made, "/actuators")), (196.0, 6.0));
    library
}

/// The report on a choice with a window of 20 ms.
fn chosen(library: &str, more: &[&str]) -> Value {
    json(&[&["place", library, "--window-ms", "20"], more].concat())
}

/// Names of the actuators of a layout in a report.
fn names(report: &Value, which: &str) -> Vec<String> {
    let actuators = report[which]["actuators"].as_array().unwrap();
    actuators.iter().map(|actuator| actuator["name"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn the_actuators_to_keep_are_told_by_name() {
    let scratch = Scratch::new("chosen");
    let (library, out) = (library(&scratch), scratch.join("out"));
    let report = chosen(&library, &["--count", "2", "--targets", "8", "-o", &out]);
    let after = names(&report, "after");
    assert_eq!(std::fs::read_to_string(format!("{out}/actuators.txt")).unwrap(), after.join("\n") + "\n");
    let all = names(&report, "before");
    assert_eq!(all, ["a1", "a2", "a3", "a4", "a5", "a6"]);
    assert!(
        after.len() == 2 && after.is_sorted() && after.iter().all(|name| all.contains(name)),
        "{after:?}"
    );
    assert_eq!((number(&report, "/places"), number(&report, "/count")), (6.0, 2.0));
    assert_eq!(["/placed_for", "/evaluated_on"].map(|key| number(&report, key)), [8.0, 24.0]);
    assert_eq!(report["held_out"], true);
    assert!(report["judged_on"].as_str().unwrap().contains("196 points"), "{report}");
    // All pairs were compared.
    assert_eq!(number(&report, "/certificate/layouts"), 15.0);
    let [best, most] = ["/restarts/best", "/certificate/objective"].map(|key| number(&report, key));
    assert!((best / most - 1.0).abs() < 1e-4 && number(&report, "/restarts/polished") == best, "{report}");
    let more = report["one_more"]["name"].as_str().unwrap();
    assert!(all.iter().any(|name| name == more) && !after.iter().any(|name| name == more), "{more}");
    let rows = report["each_number"].as_array().unwrap();
    assert_eq!(rows.iter().filter_map(|row| row["actuators"].as_u64()).collect::<Vec<_>>(), [1, 2, 3, 4]);
    assert!(report["notes"].to_string().contains("measure again"), "{}", report["notes"]);
    for name in ["places.svg", "numbers.svg", "report.json", "report.md"] {
        assert!(scratch.path().join("out").join(name).is_file(), "{name}");
    }
    let text = std::fs::read_to_string(format!("{out}/report.md")).unwrap();
    for part in ["2 actuators chosen, among 6 of a library (the 196 points of ", "\nall of the library "] {
        assert!(text.contains(part), "{part:?} in {text}");
    }
}

#[test]
fn all_actuators_reach_what_a_focus_from_the_library_does() {
    let scratch = Scratch::new("chosen-all");
    let (library, out) = (library(&scratch), scratch.join("out"));
    let at = ["--at", "60.5,90"];
    let report = chosen(&library, &[&["--count", "6", "-o", &out][..], &at[..]].concat());
    let seen = scratch.join("seen");
    let focus = ["focus", &library, "--window-ms", "20", "--between", "nearest", "--no-figures", "-o", &seen];
    let focus = json(&[&focus[..], &at[..]].concat());
    let contrast = number(&focus, "/targets/0/contrast");
    for which in ["before", "after"] {
        let found = number(&report, &format!("/{which}/mean_contrast"));
        assert!((found / contrast - 1.0).abs() < 1e-4, "{which}: {found} {contrast}");
    }
    assert!(report["held_out"] == false && report["one_more"].is_null(), "{report}");
    assert!(report["notes"].to_string().contains("0.50 mm away"), "{}", report["notes"]);
    // With no place left there is no map of one more.
    let files: Vec<&str> = report["files"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(files.contains(&"numbers.svg") && !files.contains(&"places.svg"), "{files:?}");
}

#[test]
fn kept_actuators_and_areas_limit_the_choice() {
    let scratch = Scratch::new("chosen-kept");
    let library = library(&scratch);
    let quick = ["--targets", "4", "--restarts", "1"];
    let report = chosen(&library, &[&["--count", "1", "--keep", "a4"][..], &quick[..]].concat());
    let after = names(&report, "after");
    assert!(after.len() == 2 && after.iter().any(|name| name == "a4"), "{after:?}");
    assert_eq!((number(&report, "/places"), report["kept"].to_string().as_str()), (5.0, r#"["a4"]"#));
    // Those on the left half and the others: a1, a3 and a6.
    let half = ["--count", "2", "--within", "0,0,75,0,75,150,0,150"];
    let report = chosen(&library, &[&half[..], &quick[..]].concat());
    assert!(names(&report, "after").iter().all(|name| ["a1", "a3", "a6"].contains(&name.as_str())));
    assert_eq!(number(&report, "/places"), 3.0);
    assert_eq!(names(&report, "before").len(), 6);
}

#[test]
fn what_needs_a_model_is_refused_and_so_is_what_the_library_does_not_have() {
    let scratch = Scratch::new("chosen-refused");
    let (library, out) = (library(&scratch), scratch.join("out"));
    for (typed, said) in [
        (&["--like", "a1"][..], "--like: expected a surface, whose modes it needs, found a library"),
        (&["--place", "10,10"], "--place: expected a surface, whose modes it needs, found a library"),
        (&["--grid-mm", "5"], "--grid-mm: expected a surface, whose modes it needs, found a library"),
        (&["--mounting-mm", "1"], "--mounting-mm: expected a surface, whose modes it needs, found a library"),
        (&["--tension-percent", "1"], "--tension-percent: expected a surface"),
        (&["--method", "concentrate"], "--method: expected a surface, whose modes it needs, found a library"),
        (&["--set", "sheet.tension_n_per_m=220"], "a library"),
        (&["--count", "7"], "--count: expected at most 6, the actuators of the library"),
        (&["--count", "1", "--keep-all"], "--count: expected at most 0"),
        (&["--keep", "a9"], "--keep: expected one of a1, a2, a3, a4, a5, a6, found `a9`"),
        (&["--count", "2", "--at", "200,90"], "--at: expected points on the surface"),
        (&["--count", "2", "--at", "0.5,0.5"], "--at: expected points at most 12.41 mm"),
        (&["--count", "2", "--apart-mm", "400"], "--count, --apart-mm: expected room for 2"),
    ] {
        let errors = refused(&[&["place", &library, "--window-ms", "20", "-o", &out], typed].concat(), 2);
        assert!(errors.contains(said), "{typed:?}: {said:?} in {errors}");
    }
    let errors = refused(&["place", &library, "--count", "2", "--window-ms", "31", "-o", &out], 2);
    assert!(
        errors.contains("--window-ms: expected at most 30.000 ms, the length of the responses"),
        "{errors}"
    );
    assert_eq!(scratch.names(), ["film.toml", "library"]);
}

#[test]
fn the_window_is_the_recommended_one_where_responses_are_as_long() {
    let scratch = Scratch::new("chosen-window");
    let library = library(&scratch);
    let output = run(&["place", &library, "--count", "2", "--targets", "4", "--restarts", "0", "--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let window = number(&report, "/window_s");
    assert!((5e-3..=30e-3 + 1e-9).contains(&window), "{window}");
    assert!(report["window_why"].as_str().is_some_and(|why| !why.is_empty()), "{report}");
}
