//! Figures: what they say of themselves, how wide they are, and what is drawn of a library.

use crate::common;

use common::{Scratch, json, number, refused};
use serde_json::Value;

const FILM: &str = "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
                    thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 700]\n\
                    sample_rate_hz = 16000\n[[actuator]]\nat_mm = [12, 31]\n[[actuator]]\nat_mm = [140, 44]\n";

fn text(out: &str, name: &str) -> String {
    std::fs::read_to_string(format!("{out}/{name}")).unwrap()
}

#[test]
fn figures_say_what_they_show() {
    let scratch = Scratch::new("figures");
    let (file, out, shown) = (scratch.file("film.toml", FILM), scratch.join("out"), scratch.join("shown"));
    json(&["focus", &file, "--at", "62,90", "--window-ms", "20", "-o", &out]);
    let holds = |out: &str, figure: &str, said: &str| {
        let drawn = text(out, figure);
        assert!(drawn.contains(said), "{said} in {figure}");
    };
    holds(&out, "focus.svg", ">at the focal instant, t\u{a0}=\u{a0}20.00\u{a0}ms</text>");
    holds(&out, "focus.svg", ">when largest at the target,");
    holds(&out, "traces.svg", ">focal instant</text>");
    for said in ["velocity", "displacement"] {
        holds(&out, "traces.svg", &format!(">{said} at the target</text>"));
    }
    holds(&out, "traces.svg", ">(62, 90) mm</text>");
    holds(&out, "traces-a.csv", "\"(62, 90) mm\",20,");
    let drive = format!("{out}/drive.wav");
    let field = ["field", &file, "--drive", &drive, "--at", "62,90", "--frames", "0", "-o", &shown];
    json(&field);
    holds(&shown, "snapshot.svg", ">at the instant of largest velocity,");
    json(&[&field[..], &["--at-ms", "19"]].concat());
    holds(&shown, "snapshot.svg", ">at the requested instant, t\u{a0}=\u{a0}19.00\u{a0}ms</text>");
    holds(&shown, "traces.svg", ">requested instant</text>");
}

#[test]
fn figures_are_as_wide_as_columns_of_a_page() {
    let scratch = Scratch::new("columns");
    let (file, out) = (scratch.file("film.toml", FILM), scratch.join("out"));
    let names = ["traces", "drive", "focus", "peaks", "felt"];
    let focus = ["focus", &file, "--at", "62,90", "--window-ms", "20", "-o", &out];
    for (columns, widths) in [
        (&[][..], [178, 120, 178, 178, 89]),
        (&["--columns", "1"][..], [86; 5]),
        (&["--columns", "2"][..], [178; 5]),
    ] {
        json(&[&focus[..], columns].concat());
        for (name, width) in names.iter().zip(widths) {
            let drawn = text(&out, &format!("{name}.svg"));
            assert!(
                drawn.contains(&format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\"")),
                "{name}"
            );
        }
    }
    for command in ["focus", "compare", "place"] {
        let refusal = refused(&[command, &file, "--at", "62,90", "--columns", "3", "-o", &out], 2);
        assert!(refusal.contains("--columns: expected 1 or 2, found 3"), "{refusal}");
    }
}

/// A library of the film at points 15 mm apart, and what the command that made it reported.
fn library(scratch: &Scratch) -> (String, Value) {
    let (file, library) = (scratch.file("film.toml", FILM), scratch.join("library"));
    let made = json(&["respond", &file, "--grid-mm", "15", "--length-ms", "40", "-o", &library]);
    (library, made)
}

/// Linear theory is checked by what a library knows, and what it does not know is said.
#[test]
fn libraries_have_the_notes_on_linear_theory() {
    let scratch = Scratch::new("library-notes");
    let (library, _) = library(&scratch);
    let out = scratch.join("out");
    let focus = ["focus", &library, "--at", "60,90", "--window-ms", "20", "--no-figures", "-o", &out];
    for (peak_um, thick) in [("20", false), ("2000", true)] {
        let report = json(&[&focus[..], &["--peak-um", peak_um]].concat());
        let notes = report["notes"].as_array().unwrap().iter();
        let of_theory: Vec<&str> = notes
            .filter(|note| note["topic"] == "linear theory")
            .map(|note| note["text"].as_str().unwrap())
            .collect();
        let says = |what: &str| of_theory.iter().any(|text| text.contains(what));
        assert!(says("are not known between the points of a library"), "{of_theory:?}");
        assert_eq!(says("is above the sheet's thickness of 125 µm"), thick, "{peak_um}: {of_theory:?}");
        let page = text(&out, "report.md");
        assert!(of_theory.iter().all(|said| page.contains(said)), "{page}");
    }
}

#[test]
fn a_library_is_drawn_at_its_points() {
    let scratch = Scratch::new("scatter");
    let (library, made) = library(&scratch);
    let out = scratch.join("out");
    let points = number(&made, "/points") as usize;
    let report = json(&["focus", &library, "--at", "60,90", "--window-ms", "20", "-o", &out]);
    assert_eq!(report["taken_on"], "library");
    for (name, what) in [
        ("focus-a", "Velocity ("),
        ("focus-b", "Displacement ("),
        ("peaks-a", "Velocity ("),
        ("peaks-b", "Displacement ("),
        ("felt", "Felt (dB above threshold)"),
    ] {
        let table = text(&out, &format!("{name}.csv"));
        assert!(table.starts_with(&format!("x (mm),y (mm),{what}")), "{name}: {table}");
        assert_eq!(table.lines().count(), points + 1, "{name}: {table}");
    }
    // The target is one of them, and its largest velocity at least that at the focal instant.
    let peaks = text(&out, "peaks-a.csv");
    let unit = [("(m/s)", 1.0), ("(mm/s)", 1e-3), ("(µm/s)", 1e-6)]
        .into_iter()
        .find(|(unit, _)| peaks.contains(unit));
    let there = peaks.lines().find_map(|line| line.strip_prefix("60,90,")).unwrap();
    let largest = there.parse::<f64>().unwrap() * unit.unwrap().1;
    assert!(largest > 0.999 * number(&report, "/targets/0/peak_velocity_m_s").abs(), "{largest}");
    for name in ["focus", "peaks", "felt"] {
        assert!(text(&out, &format!("{name}.svg")).matches("<circle").count() >= points, "{name}");
        for ending in ["png", "pdf"] {
            let file = format!("{name}.{ending}");
            assert!(report["files"].as_array().unwrap().iter().any(|known| *known == *file), "{file}");
        }
    }
}
