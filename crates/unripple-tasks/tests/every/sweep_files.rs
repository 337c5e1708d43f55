//! Files that plans name: where they are looked for, that a change is noticed, and that each is read once.

use super::sweeps::{Scratch, rows};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use unripple_store::{BUILTINS, set_keys};
use unripple_tasks::sweep::{Plan, run};
use unripple_tasks::{Progress, Record, Silent, SurfaceAsk, respond, sweep};

/// Text of the paper's film by another name, with a narrow band, whose modes are few, and a tension in N/m.
pub(crate) fn film(name: &str, tension: f64) -> String {
    let text = BUILTINS.iter().find(|builtin| builtin.name == "hudin-2012").unwrap().text;
    let keys = [
        ("name", name.to_owned()),
        ("drive.band_hz", "[0, 600]".into()),
        ("drive.sample_rate_hz", "4800".into()),
        ("sheet.tension_n_per_m", tension.to_string()),
    ];
    set_keys(text, "other.toml", &keys.map(|(key, value)| (key.to_owned(), value))).unwrap()
}

/// A rectangle as a drawing, 150 mm wide and of some height.
fn rectangle(height: u32) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"200mm\" viewBox=\"0 0 200 200\">\
         <path d=\"M0 0 H150 V{height} H0 Z\" fill=\"none\" stroke=\"black\"/></svg>"
    )
}

/// Two designs that compare two surfaces, of which only the first takes the other from a file.
const COMPARE: &str = r#"format = 1
task = "compare"
surface = "first.toml"
figures = ["/surfaces/0/label", "/surfaces/1/label", "/surfaces/1/methods/0/contrast_at_limit"]
shard = 1
[ask]
points = [{ at_m = [0.062, 0.09] }]
methods = ["concentrate"]
no_tradeoffs = true
[[axis]]
ask = "others"
values = [["other.toml"], [{ name = "hudin-2012", set = { "drive.band_hz" = "[0, 600]", "drive.sample_rate_hz" = "4800" } }]]
"#;

#[test]
fn files_that_a_request_names_are_relative_to_the_plan_and_a_change_is_noticed() {
    let scratch = Scratch::new("sweep-others");
    fs::write(scratch.0.join("first.toml"), film("first", 250.0)).unwrap();
    fs::write(scratch.0.join("other.toml"), film("other", 150.0)).unwrap();
    let ask = scratch.ask(COMPARE, "out");
    let report = run(&ask, &mut Silent).unwrap();
    assert_eq!((report.done, report.failed), (2, 0), "{report:?}");
    let labels: Vec<String> = rows(&scratch.0.join("out"), 2)
        .iter()
        .map(|row| row.figures.get("/surfaces/1/label").unwrap().as_str().unwrap().to_owned())
        .collect();
    assert_eq!(labels, ["other", "hudin-2012"]);
    let read: Vec<_> = Record::of(&ask).unwrap().files.into_iter().map(|file| file.path).collect();
    assert_eq!(read, ["plan.toml", "first.toml", "other.toml"].map(|name| scratch.0.join(name)));
    let before = Plan::open(&ask.plan).unwrap();
    fs::write(scratch.0.join("other.toml"), film("other", 160.0)).unwrap();
    let after = Plan::open(&ask.plan).unwrap();
    assert_ne!(before.hash(), after.hash());
    assert_ne!(before.design(0).hash, after.design(0).hash);
    assert_eq!(before.design(1).hash, after.design(1).hash);
    let refused = run(&ask, &mut Silent).unwrap_err().to_string();
    assert!(refused.contains("expected rows of this plan"), "{refused}");
}

#[test]
fn a_plan_elsewhere_says_from_where_it_names_files() {
    let scratch = Scratch::new("sweep-elsewhere");
    fs::write(scratch.0.join("first.toml"), film("first", 250.0)).unwrap();
    fs::write(scratch.0.join("other.toml"), film("other", 150.0)).unwrap();
    let here = Plan::open(&scratch.ask(COMPARE, "out").plan).unwrap();
    let elsewhere = scratch.0.join("some/plans");
    fs::create_dir_all(&elsewhere).unwrap();
    let file = elsewhere.join("plan.toml");
    fs::write(&file, format!("folder = \"../..\"\n{COMPARE}")).unwrap();
    let there = Plan::open(&file).unwrap();
    assert_eq!((there.hash(), there.design(0).hash), (here.hash(), here.design(0).hash));
    let ask = sweep::Ask { plan: file.clone(), ..sweep::Ask::default() };
    let read: Vec<_> = Record::of(&ask).unwrap().files.into_iter().map(|file| file.path).collect();
    let named = ["plan.toml", "../../first.toml", "../../other.toml"];
    assert_eq!(read, named.map(|name| elsewhere.join(name)));
    // Also of a plan with faults, whose reader tells them.
    fs::write(&file, format!("folder = \"../..\"\nshard = 0\n{}", COMPARE.replace("shard = 1\n", "")))
        .unwrap();
    let read: Vec<_> = Record::of(&ask).unwrap().files.into_iter().map(|file| file.path).collect();
    assert_eq!(read, ["plan.toml", "../../first.toml"].map(|name| elsewhere.join(name)));
}

#[test]
fn drawings_of_all_designs_are_relative_to_the_plan_and_change_each_of_them() {
    let scratch = Scratch::new("sweep-shapes");
    let plan = "format = 1\ntask = \"focus\"\nsurface = \"hudin-2012\"\n\
                ask = { shapes = [{ svg = { file = \"shapes/ring.svg\" } }] }\n\
                [[axis]]\nask = \"window_s\"\nvalues = [0.01, 0.02]\n";
    let ask = scratch.ask(plan, "out");
    let drawing = scratch.0.join("shapes/ring.svg");
    let hashes = || {
        let plan = Plan::open(&ask.plan).unwrap();
        let request = plan.ask(&plan.design(1)).unwrap();
        assert_eq!(request["shapes"][0]["svg"]["file"].as_str().map(Path::new), Some(drawing.as_path()));
        [plan.hash().to_owned(), plan.design(0).hash, plan.design(1).hash]
    };
    let missing = hashes();
    fs::create_dir(scratch.0.join("shapes")).unwrap();
    fs::write(&drawing, rectangle(20)).unwrap();
    let there = hashes();
    fs::write(&drawing, rectangle(30)).unwrap();
    let changed = hashes();
    for (i, hash) in there.iter().enumerate() {
        assert!(*hash != missing[i] && *hash != changed[i], "{i}");
    }
}

#[test]
fn a_surface_of_several_files_is_read_once() {
    let scratch = Scratch::new("sweep-drawn");
    let keys = [("outline.rectangle_mm", ""), ("outline.svg", "\"rim.svg\"")];
    let text = set_keys(
        &film("drawn", 200.0),
        "drawn.toml",
        &keys.map(|(key, value)| (key.to_owned(), value.to_owned())),
    )
    .unwrap();
    fs::create_dir(scratch.0.join("surfaces")).unwrap();
    let files =
        ["drawn.toml", "rim.svg", "low.svg", "other.toml"].map(|name| scratch.0.join("surfaces").join(name));
    for (file, text) in files.iter().zip([text, rectangle(150), rectangle(145), film("other", 300.0)]) {
        fs::write(file, text).unwrap();
    }
    let plan = "format = 1\ntask = \"focus\"\nsurface = \"surfaces/drawn.toml\"\n\
                ask = { points = [{ at_m = [0.062, 0.09] }], on = \"surfaces/other.toml\" }\n\
                [[axis]]\nkey = \"outline.svg\"\nvalues = [\"rim.svg\", \"low.svg\", \"none.svg\"]\n";
    let ask = scratch.ask(plan, "out");
    let plan = Plan::open(&ask.plan).unwrap();
    let surfaces = |index: usize| {
        let request = plan.ask(&plan.design(index))?;
        let read = |field: &str| {
            serde_json::from_value::<SurfaceAsk>(request[field].clone()).unwrap().load().unwrap()
        };
        Ok::<_, unripple_tasks::TaskError>([read("surface"), read("on")])
    };
    let heights =
        |index: usize| surfaces(index).map(|found| found.map(|surface| surface.outline.extent().1)).unwrap();
    let first = [heights(0), heights(1)];
    assert!((first[0][0] - 0.15).abs() < 1e-6 && (first[1][0] - 0.145).abs() < 1e-6, "{first:?}");
    let refused = surfaces(2).unwrap_err().to_string();
    assert!(refused.contains("none.svg"), "{refused}");
    // What a design names is a part of what it is, too.
    let hash = |index: usize| Plan::open(&ask.plan).unwrap().design(index).hash;
    let before = [hash(0), hash(1)];
    fs::write(&files[2], rectangle(140)).unwrap();
    assert!(hash(0) == before[0] && hash(1) != before[1]);
    files.iter().for_each(|file| fs::remove_file(file).unwrap());
    assert_eq!([heights(0), heights(1)], first);
    assert!(Plan::open(&ask.plan).is_err());
}

/// Removes the responses of a library once the first shard is done.
struct Spoiled<'f> {
    folder: &'f Path,
    done: Cell<bool>,
}

impl Progress for Spoiled<'_> {
    fn cancelled(&self) -> bool {
        if !self.done.get() && self.folder.join("out/parts/0.jsonl").exists() {
            self.done.set(true);
            for entry in fs::read_dir(self.folder.join("library/responses")).unwrap() {
                let path = entry.unwrap().path();
                if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("c.")) {
                    fs::remove_file(path).unwrap();
                }
            }
        }
        false
    }
}

/// Computes a library of the paper's film in a narrow band, at a few points, into a folder.
pub(crate) fn library(output: &Path) {
    let set = [("drive.band_hz", "[0, 600]"), ("drive.sample_rate_hz", "4800")];
    let set: BTreeMap<String, String> = set.map(|(key, value)| (key.to_owned(), value.to_owned())).into();
    let ask = respond::Ask {
        surface: SurfaceAsk::Set { name: "hudin-2012".into(), set },
        pitch_m: 0.03,
        length_s: None,
        output: output.into(),
    };
    respond::run(&ask, &mut Silent).unwrap();
}

#[test]
fn a_library_is_read_once() {
    let scratch = Scratch::new("sweep-library");
    library(&scratch.0.join("library"));
    let plan = "format = 1\ntask = \"focus\"\nsurface = \"library\"\nshard = 1\n\
                figures = [\"/window_s\", \"/judged_on\"]\nask = { points = [{ at_m = [0.06, 0.09] }] }\n\
                [[axis]]\nask = \"window_s\"\nvalues = [0.01, 0.009]\n";
    // Only options vary: no file has keys that could be set.
    let key = plan.replace("ask = \"window_s\"", "key = \"sheet.thickness_mm\"");
    let refused = run(&scratch.ask(&key, "keys"), &mut Silent).unwrap_err();
    assert!(refused.is_bad_input(), "{refused}");
    let expected = "surface:sheet.thickness_mm: expected options of the task alone to vary";
    assert!(refused.to_string().contains(expected) && !scratch.0.join("keys").exists(), "{refused}");
    let ask = scratch.ask(plan, "out");
    let mut spoiled = Spoiled { folder: &scratch.0, done: Cell::new(false) };
    let report = run(&ask, &mut spoiled).unwrap();
    assert!(spoiled.done.get());
    assert_eq!((report.done, report.failed), (2, 0), "{report:?}");
}
