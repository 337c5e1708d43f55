//! How strongly `focus` drives a surface unless told otherwise: as far as linear theory allows, and never above the limit.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;

/// Thickness of the paper's film, in metres.
const THICKNESS: f64 = 125e-6;

/// Topics of all notes but that on levels as felt, which do not hold for a single pulse.
fn topics(report: &Value) -> Vec<&str> {
    let all = report["notes"].as_array().unwrap().iter().map(|note| note["topic"].as_str().unwrap());
    all.filter(|topic| *topic != "felt").collect()
}

/// The note on what a method does at this level.
fn on_method(report: &Value) -> &str {
    let mut notes = report["notes"].as_array().unwrap().iter();
    notes.find(|note| note["topic"] == "method").unwrap()["text"].as_str().unwrap()
}

fn moved(report: &Value) -> f64 {
    THICKNESS * number(report, "/linearity/displacement_over_thickness")
}

#[test]
fn the_first_command_stays_within_linear_theory() {
    let scratch = Scratch::new("level-first");
    let out = scratch.join("out");
    let report = json(&["focus", "hudin-2012", "--at", "62,90", "-o", &out]);
    let peak = number(&report, "/targets/0/peak_displacement_m").abs();
    assert!((peak / (0.5 * THICKNESS) - 1.0).abs() < 0.01, "{peak}");
    assert_eq!(topics(&report), ["window"], "{}", report["notes"]);
    assert_eq!(report["linearity"]["holds"], true);
    let level = &report["level"];
    assert_eq!(level["decided_by"], "thickness");
    let below = number(level, "/below_limit");
    assert!((below * number(&report, "/drive/peak") - 1.0).abs() < 1e-9 && below > 100.0, "{level}");
    assert!((number(level, "/below_limit_db") - 20.0 * below.log10()).abs() < 1e-9);
    let page = std::fs::read_to_string(format!("{out}/report.md")).unwrap();
    assert!(
        page.contains("half the sheet's thickness (62.5 µm)") && page.contains("below the peak limit of 1 N"),
        "{page}"
    );

    let full = json(&["focus", "hudin-2012", "--at", "62,90", "--full-limit", "-o", &out]);
    assert_eq!((&full["level"]["decided_by"], number(&full, "/drive/peak")), (&Value::from("limit"), 1.0));
    assert!(topics(&full).contains(&"linear theory"));
    // Ratios do not depend on the level, nor does the ratio of levels on what is asked.
    for key in ["contrast", "background_contrast", "worst_spot", "displacement_contrast", "spot_diameter_m"] {
        let path = format!("/targets/0/{key}");
        let (a, b) = (number(&report, &path), number(&full, &path));
        assert!((a / b - 1.0).abs() < 1e-6, "{key}: {a} {b}");
    }
    let peaks =
        number(&full, "/targets/0/peak_velocity_m_s") / number(&report, "/targets/0/peak_velocity_m_s");
    assert!((peaks / below - 1.0).abs() < 1e-6, "{peaks} {below}");
}

#[test]
fn nothing_moves_by_more_than_half_the_thickness_whatever_is_asked() {
    let scratch = Scratch::new("level-all");
    let out = scratch.join("out");
    for arguments in [
        &["--at", "40,50,0.3", "--at", "100,90,-1"][..],
        &["--at", "40,50,1,20", "--at", "100,90,0.5,10"],
        &["--shape", "circle:75,75,25"],
        &["--at", "62,90", "--judge-hz", "3000"],
        &["--at", "62,90", "--method", "felt"],
    ] {
        let film = ["focus", "hudin-2012", "--set", "drive.band_hz=[0, 1500]", "--no-figures"];
        let report = json(&[&film[..], &["--window-ms", "20", "-o", &out], arguments].concat());
        let most = moved(&report) / (0.5 * THICKNESS);
        assert!((0.97..1.05).contains(&most), "{arguments:?}: {most}");
        assert!(topics(&report).is_empty(), "{arguments:?}: {}", report["notes"]);
        assert_eq!(report["level"]["decided_by"], "thickness");
    }
}

#[test]
fn a_thick_plate_is_driven_to_its_limit() {
    let scratch = Scratch::new("level-plate");
    let out = scratch.join("out");
    let report = json(&["focus", "glass-plate", "--at", "62,90", "--window-ms", "3", "-o", &out]);
    let level = &report["level"];
    assert_eq!(level["decided_by"], "limit");
    assert!(number(level, "/below_limit_db").abs() < 1e-6 && number(level, "/linear_theory_allows") > 1.0);
    // Of its notes none is on the level: that waves of 20 kHz on it radiate is one on the model.
    assert_eq!(topics(&report), ["model"], "{}", report["notes"]);
}

/// A slack thick film gets tight before it moves by half its thickness; a weak plate breaks.
#[test]
fn tension_and_yield_decide_where_they_come_first() {
    let scratch = Scratch::new("level-bounds");
    let out = scratch.join("out");
    let sheet = |name: &str, sheet: &str| {
        scratch.file(
            name,
            format!(
                "format = 1\nname = \"A sheet\"\n[outline]\nrectangle_mm = [150, 120]\n[sheet]\nyoung_gpa = 4\n\
                 density_kg_m3 = 1400\npoisson_ratio = 0.3\nthickness_mm = 1\ndecay_time_ms = 40\n{sheet}\n[drive]\n\
                 band_hz = [0, 1500]\nsample_rate_hz = 16000\nlimit = 5\n[[actuator]]\nat_mm = [12, 31]\n\
                 [[actuator]]\nat_mm = [140, 44]\n[[actuator]]\nat_mm = [40, 110]\n"
            ),
        )
    };
    for (bound, file, key, half) in [
        ("tension", sheet("slack.toml", "tension_n_per_m = 5"), "tension_change", 0.05),
        ("yield", sheet("weak.toml", "tension_n_per_m = 0\nstrength_mpa = 0.02"), "share_of_yield", 0.5),
    ] {
        let report = json(&["focus", &file, "--at", "62,70", "--window-ms", "30", "-o", &out]);
        assert_eq!(report["level"]["decided_by"], bound);
        let found = number(&report, &format!("/linearity/{key}"));
        assert!((found / half - 1.0).abs() < 1e-3, "{bound}: {found}");
        // The discs around a target take up most of so small a sheet.
        assert_eq!(topics(&report), ["outside"], "{}", report["notes"]);
        assert_eq!(report["linearity"]["holds"], true);
    }
}

#[test]
fn what_a_method_does_at_its_limit_is_void_below_it_and_said_to_be() {
    let scratch = Scratch::new("level-methods");
    let out = scratch.join("out");
    let film = ["focus", "hudin-2012", "--set", "drive.band_hz=[0, 1500]", "--no-figures"];
    let focus = |arguments: &[&str]| {
        json(&[&film[..], &["--at", "62,90", "--window-ms", "30", "-o", &out], arguments].concat())
    };
    let limited = focus(&["--method", "limited"]);
    let concentrate = focus(&["--method", "concentrate", "--strength", "0.98"]);
    for key in ["/targets/0/contrast", "/targets/0/peak_velocity_m_s", "/drive/energy", "/drive/peak"] {
        let (a, b) = (number(&limited, key), number(&concentrate, key));
        assert!((a / b - 1.0).abs() < 1e-6, "{key}: {a} {b}");
    }
    let said = on_method(&limited);
    assert!(
        said.contains("the limit is not reached") && said.contains("concentrate with a strength of 0.98"),
        "{said}"
    );
    assert!(focus(&["--method", "limited", "--full-limit"])["notes"][0]["topic"] == "linear theory");

    let hard = focus(&["--method", "one-bit"]);
    let soft = focus(&[]);
    let said = on_method(&hard);
    assert!(said.contains("but this level needs less"), "{said}");
    let price = |r: &Value| number(r, "/drive/energy") / number(r, "/targets/0/peak_velocity_m_s").powi(2);
    assert!(said.contains(&format!("for {:.2} times the energy", price(&soft) / price(&hard))), "{said}");
    assert_eq!(topics(&hard), ["method"]);
}

#[test]
fn levels_exclude_each_other() {
    for other in [["--peak-um", "40"], ["--felt-db", "3"]] {
        let all = ["focus", "hudin-2012", "--at", "62,90", "--full-limit", other[0], other[1], "-o", "x"];
        assert!(refused(&all, 2).contains("cannot be used with"));
    }
    let waveform = ["focus", "hudin-2012", "--waveform", "62,90,click:2", "--full-limit", "-o", "x"];
    assert!(refused(&waveform, 2).contains("--full-limit"));
    let help = String::from_utf8(run(&["focus", "--help"]).stdout).unwrap();
    assert!(help.contains("--full-limit") && help.contains("half the sheet's thickness"));
}
