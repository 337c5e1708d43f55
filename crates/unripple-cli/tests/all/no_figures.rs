//! `--no-figures`: reports without a picture, in folders without one.

use crate::common;

use common::{Scratch, json};

const FILM: &str = "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
                    thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 700]\n\
                    sample_rate_hz = 16000\n[[actuator]]\nat_mm = [12, 31]\n[[actuator]]\nat_mm = [140, 44]\n\
                    [[actuator]]\nat_mm = [40, 140]\n";

/// Endings of pictures and animations, and of their data.
const DRAWN: [&str; 4] = [".svg", ".png", ".pdf", ".csv"];

/// Whether a folder holds pictures. It holds a report in either case, which names every file of it and links to no other.
fn is_drawn(folder: &Scratch, out: &str) -> bool {
    let place = folder.path().join(out);
    let names: Vec<String> = std::fs::read_dir(&place)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    let text = |name: &str| std::fs::read_to_string(place.join(name)).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text("report.json")).unwrap();
    for file in report["files"].as_array().unwrap() {
        assert!(names.iter().any(|name| *file == **name), "{file}: {names:?}");
    }
    let page = text("report.md");
    for link in page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()) {
        assert!(names.iter().any(|name| name == link), "{link}: {names:?}");
    }
    let drawn = names.iter().any(|name| DRAWN.iter().any(|ending| name.ends_with(ending)));
    assert_eq!(page.contains("!["), drawn, "{names:?}\n{page}");
    drawn
}

#[test]
fn a_folder_without_figures_has_its_report() {
    let scratch = Scratch::new("no-figures");
    let file = scratch.file("film.toml", FILM);
    let drive = scratch.join("focus/drive.wav");
    for (name, arguments) in [
        ("focus", vec!["focus", &file, "--at", "62,90", "--window-ms", "20"]),
        ("field", vec!["field", &file, "--drive", &drive, "--at", "62,90", "--frames", "2"]),
        ("compare", vec!["compare", &file, "--at", "62,90", "--window-ms", "20"]),
        ("surfaces", vec!["compare", &file, &file, "--at", "62,90", "--window-ms", "20"]),
        ("place", vec!["place", &file, "--at", "62,90", "--count", "2", "--rim-mm", "8,20"]),
        ("sensors", vec!["sensors", &file, "--count", "2", "--grid-mm", "25", "--profile", "0"]),
        ("fit", vec!["fit", &file, "--modes", "171.4,270.8,343", "--sides-known"]),
    ] {
        let out = scratch.join(name);
        json(&[&arguments[..], &["--no-figures", "-o", &out]].concat());
        assert!(!is_drawn(&scratch, name), "{name}");
        // The same command draws without the option.
        let name = format!("{name}-drawn");
        let out = scratch.join(&name);
        json(&[&arguments[..], &["-o", &out]].concat());
        assert!(is_drawn(&scratch, &name), "{name}");
    }
}
