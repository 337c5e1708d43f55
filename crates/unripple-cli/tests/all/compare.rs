//! `compare`: every method judged alike, its knobs' trades, its files.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;

const FILM: &str = "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
                    thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 1000]\n\
                    sample_rate_hz = 16000\n[[actuator]]\nat_mm = [12, 31]\n[[actuator]]\nat_mm = [140, 44]\n\
                    [[actuator]]\nat_mm = [40, 140]\n";

fn values(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// On a library of the same film, methods have the contrasts that `focus` has there; what needs modes says so.
#[test]
fn a_library_is_compared_on_its_own_points() {
    let scratch = Scratch::new("compare-library");
    let (file, library) = (scratch.file("film.toml", FILM), scratch.join("library"));
    json(&["respond", &file, "--grid-mm", "12", "--length-ms", "70", "-o", &library]);
    let at = ["--at", "62,90", "--window-ms", "30"];
    let report = json(&[&["compare", &library], &at[..]].concat());
    let names: Vec<&str> =
        report["methods"].as_array().unwrap().iter().map(|row| row["method"].as_str().unwrap()).collect();
    for needs in ["felt", "robust"] {
        let failed = report["failed"].as_array().unwrap().iter().any(|failed| failed["method"] == needs);
        assert!(failed && !names.contains(&needs), "{needs}: {names:?}");
    }
    assert!(report["judged_on"].as_str().unwrap().contains("points of"), "{}", report["judged_on"]);
    for (i, method) in
        names.iter().enumerate().filter(|(_, name)| ["time-reversal", "concentrate"].contains(name))
    {
        let out = scratch.join(method);
        let alone = json(&[&["focus", &library, "--method", method, "-o", &out], &at[..]].concat());
        let [one, other] = [
            number(&report, &format!("/methods/{i}/targets/0/contrast")),
            number(&alone, "/targets/0/contrast"),
        ];
        assert!((one / other - 1.0).abs() < 1e-6, "{method}: {one} {other}");
    }
    assert!(
        refused(&[&["compare", &library, "--judge-hz", "1500"], &at[..]].concat(), 2).contains("library")
    );
}

#[test]
fn all_methods_stand_side_by_side() {
    let scratch = Scratch::new("compare");
    let (file, out) = (scratch.file("film.toml", FILM), scratch.join("out"));
    let report = json(&["compare", &file, "--at", "62,90", "--window-ms", "30", "-o", &out]);
    let methods = report["methods"].as_array().unwrap();
    let names: Vec<&str> = methods.iter().map(|row| row["method"].as_str().unwrap()).collect();
    assert_eq!(&names[..4], ["time-reversal", "one-bit", "inverse", "concentrate"]);
    let of = |i: usize, key: &str| number(&report, &format!("/methods/{i}/{key}"));
    assert_eq!(of(0, "energy_for_peak"), 1.0);
    assert!(of(3, "targets/0/contrast") > 1.5 * of(0, "targets/0/contrast"));
    // All move as far as linear theory allows; what each reaches at the limit stands beside it.
    for (i, method) in names.iter().enumerate() {
        assert_eq!(methods[i]["level"]["decided_by"], "thickness", "{method}");
        let moved = of(i, "targets/0/peak_displacement_m").abs();
        assert!(moved < 1.02 * 62.5e-6 && moved > 20e-6, "{method}: {moved}");
    }
    assert!(of(1, "peak_at_limit") > 2.0 && of(0, "peak_at_limit") == 1.0);
    let text = report["methods"][4]["notes"][0]["text"].as_str().unwrap();
    assert!(names[4] == "limited" && text.contains("the limit is not reached"), "{text}");
    let full = json(&["compare", &file, "--at", "62,90", "--window-ms", "30", "--full-limit"]);
    let at = |i: usize, key: &str| number(&full, &format!("/methods/{i}/{key}"));
    let ratio = at(1, "targets/0/peak_velocity_m_s") / at(0, "targets/0/peak_velocity_m_s");
    assert!((ratio / of(1, "peak_at_limit") - 1.0).abs() < 1e-9);
    assert!(at(4, "targets/0/contrast") < of(4, "targets/0/contrast"), "shaped by the limit there");
    // The knob at 0 is time reversal itself, and contrast rises along it.
    for front in report["fronts"].as_array().unwrap().iter().filter(|f| f["knob"] == "strength") {
        let (contrast, energy) = (values(&front["contrast"]), values(&front["energy_for_peak"]));
        assert!((energy[0] - 1.0).abs() < 1e-6, "{energy:?}");
        assert!(contrast.last() > contrast.first(), "{contrast:?}");
        assert!(energy.windows(2).all(|pair| pair[1] >= pair[0] * (1.0 - 1e-6)), "{energy:?}");
    }
    let felt = report["felt"].as_array().unwrap();
    let drive: Vec<f64> = felt.iter().map(|row| row["drive_for_level_db"].as_f64().unwrap()).collect();
    assert_eq!(drive[0], 0.0);
    assert!(drive[1..].windows(2).all(|pair| pair[1] < pair[0]), "{drive:?}");
    for name in ["compare.svg", "compare.png", "report.json", "report.md"] {
        assert!(std::path::Path::new(&out).join(name).exists(), "{name}");
    }
    let focus = scratch.join("focus");
    let alone = json(&[
        "focus",
        &file,
        "--at",
        "62,90",
        "--window-ms",
        "30",
        "--method",
        "concentrate",
        "--judge-hz",
        "2000",
        "-o",
        &focus,
    ]);
    for key in ["targets/0/contrast", "sound/a_weighted_exposure_db"] {
        assert!((number(&alone, &format!("/{key}")) / of(3, key) - 1.0).abs() < 1e-9, "{key}");
    }
}

#[test]
fn a_table_needs_no_folder() {
    let scratch = Scratch::new("compare-table");
    let file = scratch.file("film.toml", FILM);
    let out = run(&["compare", &file, "--at", "62,90", "--window-ms", "20"]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.contains("concentrate") && text.contains("energy for peak"), "{text}");
    // What is felt comes first, and beside time reversal the method that is made for it.
    let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with("method ")).take(3).collect();
    let headings: Vec<&str> = lines[0].split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
    let first =
        ["method", "felt dB", "felt contrast", "felt background", "felt worst", "drive for felt", "contrast"];
    assert_eq!(headings[..first.len()], first);
    assert!(headings.contains(&"sound dB(A)") && text.contains("0.3 m above the middle"), "{text}");
    assert!(lines[1].starts_with("time-reversal ") && lines[2].starts_with("felt "), "{text}");
    assert!(refused(&["compare", &file], 2).contains("targets"));
    let errors =
        refused(&["focus", &file, "--at", "62,90", "--method", "inverse", "--strength", "1.5", "-o", "x"], 2);
    assert!(errors.contains("strength: expected 0 to 1, found 1.5"), "{errors}");
}

/// The drive of `felt` goes on for 4 ms after its focus, which a shorter window has no room for.
#[test]
fn methods_go_on_without_one_that_fails() {
    let scratch = Scratch::new("compare-failed");
    let (file, out) = (scratch.file("film.toml", FILM), scratch.join("out"));
    let compare = ["compare", &file, "--at", "62,90", "--window-ms", "3.5"];
    let report = json(&[&compare[..], &["-o", &out]].concat());
    let rows = |key: &str| report[key].as_array().unwrap().clone();
    let names = |key: &str| -> Vec<String> {
        rows(key).iter().map(|row| row["method"].as_str().unwrap().to_owned()).collect()
    };
    let methods = names("methods");
    for method in ["time-reversal", "one-bit", "inverse", "concentrate", "robust"] {
        assert!(methods.iter().any(|name| name == method), "{method}: {methods:?}");
    }
    assert!(!methods.iter().any(|name| name == "felt"), "{methods:?}");
    let failed = rows("failed");
    let felt: Vec<&Value> = failed.iter().filter(|row| row["method"] == "felt").collect();
    let why = "window (s): expected more than 0.004, the time from the focus to its end, found 0.0035";
    assert!(felt.len() == 1 && felt[0]["why"] == why, "{failed:?}");
    assert_eq!(names("felt"), ["time-reversal"], "nothing to hold against it");
    let page = std::fs::read_to_string(scratch.join("out/report.md")).unwrap();
    assert!(page.contains(&format!("\n**felt** failed: {why}\n")), "{page}");
    assert!(page.contains("](compare.png)"), "{page}");
    let text = String::from_utf8(run(&compare).stdout).unwrap();
    assert!(text.contains(&format!("\nfelt failed: {why}\n")), "{text}");
    assert!(text.contains("concentrate"), "{text}");
}

/// A level that some methods do not reach is theirs at their limit, and the others' as asked for.
#[test]
fn a_method_that_cannot_reach_a_level_is_shown_at_its_limit() {
    let scratch = Scratch::new("compare-weak");
    let weak = FILM.replace("sample_rate_hz", "limit = 1e-4\nsample_rate_hz");
    let file = scratch.file("weak.toml", weak);
    let compare = |level: &[&str]| {
        json(&[&["compare", file.as_str(), "--at", "62,90", "--window-ms", "30"], level].concat())
    };
    let full = compare(&["--full-limit"]);
    let rows = |report: &Value, key: &str| report[key].as_array().unwrap().clone();
    // Between what the weakest and what the strongest reach.
    let middle = |key: &str| {
        let mut all: Vec<f64> = rows(&full, "methods").iter().map(|row| number(row, key).abs()).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2 - 1].midpoint(all[all.len() / 2])
    };
    let (felt, moved) = ("/targets/0/felt_level_db", "/targets/0/peak_displacement_m");
    let peak = (1e6 * middle(moved)).to_string();
    for (report, decided, unit) in [
        (compare(&["--peak-um", &peak]), "peak_um", "\u{b5}m"),
        (compare(&["--felt-db", &middle(felt).to_string()]), "felt_db", "dB"),
    ] {
        let methods = rows(&report, "methods");
        assert_eq!(methods.len(), rows(&full, "methods").len());
        let mut short = 0;
        for (row, limit) in methods.iter().zip(rows(&full, "methods")) {
            let beyond = row["level"]["decided_by"] == "limit";
            assert!(beyond || row["level"]["decided_by"] == decided, "{row}");
            let notes = row["notes"].as_array().unwrap();
            let said = notes.iter().filter(|note| note["topic"] == "level").collect::<Vec<_>>();
            assert_eq!(said.len(), usize::from(beyond), "{row}");
            if beyond {
                short += 1;
                assert!(said[0]["text"].as_str().unwrap().contains(unit), "{}", said[0]);
                for key in [felt, "/targets/0/peak_velocity_m_s", "/drive/peak"] {
                    assert_eq!(number(row, key), number(&limit, key), "{key}");
                }
            }
        }
        assert!(short > 0 && short < methods.len(), "{short}");
    }
    // One act alone is refused: it would not be what was asked for.
    let out = scratch.join("out");
    let focus = ["focus", &file, "--at", "62,90", "--window-ms", "30", "--method", "inverse", "-o", &out];
    assert!(refused(&[&focus[..], &["--peak-um", &peak]].concat(), 2).contains("at most"));
}

/// The rows of one surface without what the clock says.
fn timeless(on: &Value) -> Vec<Value> {
    let mut rows = on["methods"].as_array().unwrap().clone();
    for row in &mut rows {
        let row = row.as_object_mut().unwrap();
        assert!(row.remove("plan_s").is_some() && row.remove("drive_s").is_some());
    }
    rows
}

#[test]
fn surfaces_are_compared_as_each_would_be_alone() {
    let scratch = Scratch::new("compare-surfaces");
    let stiff =
        FILM.replace("A film", "A stiff film").replace("tension_n_per_m = 200", "tension_n_per_m = 300");
    let (film, stiff) = (scratch.file("film.toml", FILM), scratch.file("stiff.toml", stiff));
    let at = ["--at", "62,90"];
    let both = json(&[&["compare", &film, &stiff][..], &at].concat());
    let varied = ["compare", &film, "--vary", "sheet.tension_n_per_m=200, 300"];
    let varied = json(&[&varied[..], &at].concat());
    let set = ["compare", &film, "--set", "sheet.tension_n_per_m=300", "--method", "concentrate"];
    let set = json(&[&set[..], &at].concat());
    assert!(both["failed"].is_null() && varied["failed"].is_null());
    for (place, (file, name)) in [(&film, "A film"), (&stiff, "A stiff film")].into_iter().enumerate() {
        let alone = json(&[&["compare", file, "--method", "concentrate"][..], &at].concat());
        let on = &both["surfaces"][place];
        assert_eq!(on["label"], name);
        for key in ["surface", "window_s", "window_why", "modes", "judged_to_hz"] {
            assert_eq!(on[key], alone[key], "{key}");
        }
        let rows = timeless(on);
        let names: Vec<&str> = rows.iter().map(|row| row["method"].as_str().unwrap()).collect();
        assert_eq!(names, ["time-reversal", "concentrate"]);
        assert_eq!(rows, timeless(&alone), "{name}");
        // Only the method asked for has a tradeoff.
        let fronts = alone["fronts"].as_array().unwrap();
        assert!(fronts.len() == 1 && fronts[0]["method"] == "concentrate", "{fronts:?}");
        assert_eq!(alone["felt"].as_array().unwrap().len(), 1);
    }
    let tighter = &varied["surfaces"][1];
    assert_eq!(tighter["label"], "sheet.tension_n_per_m=300");
    assert_eq!((&tighter["window_s"], &tighter["modes"]), (&set["window_s"], &set["modes"]));
    assert_eq!(timeless(tighter), timeless(&set));
    assert_eq!(varied["run"]["surfaces"][1]["asked"]["set"]["sheet.tension_n_per_m"], "300");
    assert!(number(tighter, "/modes") < number(&varied["surfaces"][0], "/modes"));
    let twice =
        ["compare", &film, "--set", "sheet.tension_n_per_m=300", "--vary", "sheet.tension_n_per_m=200"];
    assert!(refused(&[&twice[..], &at].concat(), 2).contains("a key that --set does not set"));
    let bare = ["compare", &film, "--vary", "sheet.tension_n_per_m"];
    assert!(refused(&[&bare[..], &at].concat(), 2).contains("expected KEY=VALUE,VALUE"));
}

#[test]
fn a_surface_without_the_target_fails_alone() {
    let scratch = Scratch::new("compare-outside");
    let small = FILM.replace("A film", "A small film").replace("[150, 150]", "[100, 100]");
    let small = small.replace("[140, 44]", "[90, 44]").replace("[40, 140]", "[40, 90]");
    let (film, small) = (scratch.file("film.toml", FILM), scratch.file("small.toml", small));
    let out = scratch.join("out");
    let asked = ["--at", "62,120", "--window-ms", "20"];
    let compare = [&["compare", &small, &film][..], &asked].concat();
    let report = json(&[&compare[..], &["--columns", "1", "-o", &out]].concat());
    let labels = |key: &str| -> Vec<String> {
        let all = report[key].as_array().unwrap().iter();
        all.map(|one| one["label"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(
        (labels("surfaces"), labels("failed")),
        (vec!["A film".to_owned()], vec!["A small film".to_owned()])
    );
    let why = report["failed"][0]["why"].as_str().unwrap();
    assert!(why.starts_with("target 1: (62.0000, 120.0000) mm is outside the surface"), "{why}");
    let page = std::fs::read_to_string(format!("{out}/report.md")).unwrap();
    assert!(page.contains(&format!("\n**A small film** failed: {why}\n")), "{page}");
    assert!(page.contains("| surface | method | window ms | modes | felt dB |"), "{page}");
    assert!(page.contains("| A film | concentrate | 20.0 |") && page.contains("](compare.png)"), "{page}");
    let drawn = std::fs::read_to_string(format!("{out}/compare.svg")).unwrap();
    assert!(drawn.contains("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"86mm\""));
    assert!(drawn.contains(">A film</text>") && drawn.contains(">concentrate</text>"));
    let table = std::fs::read_to_string(format!("{out}/compare-a.csv")).unwrap();
    assert!(table.starts_with("series,Contrast,Surface\r\ntime-reversal,"), "{table}");
    assert!(table.lines().skip(1).all(|line| line.ends_with(",A film")), "{table}");
    let text = String::from_utf8(run(&compare).stdout).unwrap();
    assert!(text.contains(&format!("\nA small film failed: {why}\n")), "{text}");
    // Where all fail, there is nothing to show.
    let none = refused(&[&["compare", &small, &small][..], &asked].concat(), 2);
    assert!(none.contains(&format!("small.toml: {why}")), "{none}");
}
