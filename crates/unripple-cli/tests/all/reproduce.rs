//! The page of `unripple reproduce`: complete, consistent, and right where the paper's table is known.

use crate::common;

use common::{Scratch, json, refused};
use serde_json::Value;
use std::fs;

/// The guide that shows tables of this page.
const GUIDE: &str = include_str!("../../../../docs/any-surface.md");

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

/// What is between `before` and the next quotation mark or bracket, wherever `before` is.
fn references(page: &str, before: &str) -> Vec<String> {
    page.split(before).skip(1).map(|rest| rest.split(['"', ')']).next().unwrap().to_owned()).collect()
}

#[test]
fn makes_a_whole_page() {
    let folder = Scratch::new("reproduce");
    let report = json(&["reproduce", "--placements", "2", "-o", &folder.join("page")]);
    let written: Value =
        serde_json::from_str(&fs::read_to_string(folder.join("page/reproduce.json")).unwrap()).unwrap();
    assert_eq!(report, written);
    every_section_is_there(&folder, &report);
    every_figure_is_there(&folder, &report);
    table_1_is_right(&report);
    slips_are_apart_from_models(&report);
    the_guide_has_these_rows(&report);
    contrast_is_near_its_closed_form(&report);
}

fn every_section_is_there(folder: &Scratch, report: &Value) {
    let titles: Vec<&str> = list(&report["sections"]).iter().map(|s| s["title"].as_str().unwrap()).collect();
    let expected = [
        "Fig. 1",
        "Fig. 2a",
        "Fig. 2b",
        "Section 2",
        "Section 3.1",
        "Section 3.2",
        "Fig. 3",
        "Table 1",
        "Section 4",
        "Section 4",
        "Section 4",
        "Fig. 4",
        "Section 4",
    ];
    assert_eq!(titles.len(), expected.len());
    for file in ["index.html", "reproduce.md"] {
        let page = fs::read_to_string(folder.join(&format!("page/{file}"))).unwrap();
        for (title, start) in titles.iter().zip(expected) {
            assert!(title.starts_with(start), "{title}");
            assert!(page.contains(*title), "{title} in {file}");
        }
    }
    for section in list(&report["sections"]) {
        let (compared, predicted) = (list(&section["compared"]), list(&section["predicted"]));
        assert!(compared.len() + predicted.len() > 0, "{}", section["title"]);
        full(compared, &["what", "paper", "here", "why"]);
        full(predicted, &["what", "here", "why"]);
        // A quantity for which the paper has no figure is no reproduction.
        assert!(compared.iter().all(|row| !row["paper"].as_str().unwrap().contains("no figure")));
    }
}

/// Rows with these keys, each with a text that says something.
fn full(rows: &[Value], keys: &[&str]) {
    for row in rows {
        for key in keys {
            let text = row[key].as_str().unwrap();
            assert!(!text.is_empty() && !text.contains("NaN") && !text.contains("inf "), "{row}");
        }
    }
}

fn every_figure_is_there(folder: &Scratch, report: &Value) {
    let page = fs::read_to_string(folder.join("page/index.html")).unwrap();
    let text = fs::read_to_string(folder.join("page/reproduce.md")).unwrap();
    let mut named = references(&page, "src=\"");
    assert_eq!(named.len(), references(&page, "alt=\"").iter().filter(|alt| !alt.is_empty()).count());
    assert!(named.len() >= 9);
    named.extend(references(&text, "]("));
    named.extend(
        list(&report["sections"])
            .iter()
            .flat_map(|s| list(&s["figures"]))
            .flat_map(|f| list(&f["files"]))
            .map(|file| file.as_str().unwrap().to_owned()),
    );
    for file in named {
        let bytes =
            fs::read(folder.join(&format!("page/{file}"))).unwrap_or_else(|error| panic!("{file}: {error}"));
        let start: &[u8] = if file.ends_with(".svg") { b"<svg" } else { b"\x89PNG" };
        assert!(bytes.starts_with(start), "{file}");
    }
    assert!(!page.contains("http"), "the page stands alone");
}

fn section<'a>(report: &'a Value, title: &str) -> &'a Value {
    let section = list(&report["sections"]).iter().find(|s| s["title"].as_str().unwrap().starts_with(title));
    section.unwrap()
}

fn data<'a>(report: &'a Value, title: &str) -> &'a Value {
    &section(report, title)["data"]
}

/// Cells of a table's row.
fn cells(row: &Value) -> Vec<&str> {
    list(row).iter().map(|cell| cell.as_str().unwrap()).collect()
}

/// Misprints, which can be shown from the paper alone, come first, then differences of model.
fn slips_are_apart_from_models(report: &Value) {
    let table = &list(&section(report, "Section 4: the numbers")["table"])[1..];
    let natures: Vec<&str> = table.iter().map(|row| cells(row)[1]).collect();
    let misprints = natures.iter().take_while(|nature| **nature == "misprint or arithmetic").count();
    assert_eq!((misprints, natures.len()), (4, 10));
    assert!(natures[misprints..].iter().all(|nature| *nature == "model or assumption"), "{natures:?}");
}

/// The guide has the table of coils row for row, and each outline with its number of modes; its contrasts are means over more placements.
fn the_guide_has_these_rows(report: &Value) {
    for (title, columns) in [("Section 4: coils", 4), ("Section 2", 2)] {
        for row in list(&section(report, title)["table"]) {
            let line = format!("| {} |", cells(row)[..columns].join(" | "));
            assert!(GUIDE.contains(&line), "{line} is not in the guide");
        }
    }
}

fn table_1_is_right(report: &Value) {
    let expected = [(662.0, 44_155.0, 15.2, 514.0), (42.4, 2_825.0, 0.0742, 1.44)];
    let rows = list(data(report, "Table 1"));
    assert_eq!(rows.len(), expected.len());
    for (row, (celerity, hz, impedance, power)) in rows.iter().zip(expected) {
        for (key, value) in [
            ("celerity_m_s", celerity),
            ("frequency_hz", hz),
            ("impedance_n_s_per_m", impedance),
            ("power_w", power),
        ] {
            let found = row[key].as_f64().unwrap();
            assert!((found / value - 1.0).abs() < 0.01, "{key}: {found} against {value}");
        }
    }
}

/// Two placements are few, so that the bound is wide: it is there to catch a study of something else.
fn contrast_is_near_its_closed_form(report: &Value) {
    let rows = list(&data(report, "Section 3.1")["against_window_s"]);
    assert_eq!(rows.len(), 48);
    let ratio = |row: &Value| row["simulated"].as_f64().unwrap() / row["predicted"].as_f64().unwrap();
    let mean = rows.iter().map(ratio).sum::<f64>() / rows.len() as f64;
    assert!((mean - 1.0).abs() < 0.1, "{mean}");
}

#[test]
fn refuses_a_mean_without_a_spread() {
    let folder = Scratch::new("reproduce-refused");
    let errors = refused(&["reproduce", "--placements", "1", "-o", &folder.join("page")], 2);
    assert!(errors.contains("--placements: expected at least 2, found 1"), "{errors}");
    assert!(folder.names().is_empty());
}
