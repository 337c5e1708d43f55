//! `optimise`: what has been asked for is computed without Python, and who asks is named where there is no Python.
#![cfg(unix)]

use crate::common;

use common::{Scratch, json, program};
use std::fs;

/// The lowest first mode of a film, by its tension.
const PLAN: &str = r#"format = 1
task = "modes"
surface = "film.toml"
ask = { top_hz = 250 }
optimise = { generations = 2 }
[[objective]]
figure = "/frequencies_hz/0"
want = "least"
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
"#;

#[test]
fn what_has_been_asked_for_is_computed_by_processes() {
    let scratch = Scratch::new("optimise");
    scratch.file("film.toml", common::SMALL_FILM);
    let (plan, out) = (scratch.file("plan.toml", PLAN), scratch.join("out"));
    let report = json(&["optimise", &plan, "--no-ask", "--jobs", "2", "-o", &out]);
    assert_eq!((report["to_ask"].as_u64(), report["designs"].as_u64()), (Some(0), Some(0)));
    let question: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(format!("{out}/asked/0.json")).unwrap()).unwrap();
    // The surface by its name in the plan, from the folder of that.
    let head = question["head"].as_str().unwrap();
    assert!(head.contains("folder = \"../..\"\n") && head.contains("surface = \"film.toml\"\n"), "{head}");
    let designs =
        [300, 150, -1].map(|tension| format!("[[design]]\n\"surface:sheet.tension_n_per_m\" = {tension}\n"));
    fs::write(format!("{out}/asked/0.toml"), format!("{head}{}", designs.concat())).unwrap();
    let report = json(&["optimise", &plan, "--no-ask", "--jobs", "2", "-o", &out]);
    assert_eq!((report["designs"].as_u64(), report["failed"].as_u64()), (Some(3), Some(1)));
    assert_eq!((report["best"]["index"].as_u64(), report["to_ask"].as_u64()), (Some(1), Some(1)));
    let best = fs::read_to_string(format!("{out}/best.toml")).unwrap();
    assert!(best.contains("tension_n_per_m = 150"), "{best}");
    let refused = program()
        .args(["optimise", &plan, "-o", &out])
        .env("UNRIPPLE_PYTHON", "/no/such/python")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(1), "{said}");
    assert!(said.contains("pip install 'unripple[optimise]'") && said.contains("with --no-ask"), "{said}");
}
