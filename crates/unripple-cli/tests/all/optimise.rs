//! `optimise`: what has been asked for is computed without Python, and who asks is named where there is no Python.
#![cfg(unix)]

use crate::common;

use common::{Scratch, json, program};
use std::fs;
use std::os::unix::fs::PermissionsExt;

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

/// A stand-in for Python: it answers each line that it is asked, writes what it was told, and after two generations has nothing more to ask.
const OPTIMISER: &str = r#"#!/bin/sh
echo "$*" >> "$4/begun"
while read -r line; do
    generation=${line#*'"generation":'}
    generation=${generation%%[,\}]*}
    since=${line#*'"since":'}
    echo "$generation since ${since%%[,\}]*}" >> "$4/told"
    if [ "$generation" = 2 ]; then
        echo '{"over": "two are enough"}'
        continue
    fi
    {
        echo '# asked for by a script'
        echo 'format = 1'
        echo 'folder = "../.."'
        echo 'task = "modes"'
        echo 'surface = "film.toml"'
        echo 'ask = { top_hz = 250 }'
        echo 'figures = ["/frequencies_hz/0"]'
        for tension in $((200 - generation)) 250; do
            echo '[[design]]'
            echo "\"surface:sheet.tension_n_per_m\" = $tension"
        done
    } > "$4/asked/$generation.toml"
    echo "{\"generation\": $generation}"
done
"#;

#[test]
fn one_process_asks_for_all_generations() {
    let scratch = Scratch::new("optimise-asked");
    scratch.file("film.toml", common::SMALL_FILM);
    let plan = scratch.file("plan.toml", PLAN.replace("generations = 2", "generations = 5"));
    let (script, out) = (scratch.file("optimiser", OPTIMISER), scratch.join("out"));
    fs::set_permissions(&script, fs::Permissions::from_mode(0o755)).unwrap();
    let search = || {
        let args = ["optimise", &plan, "--no-figures", "--json", "--jobs", "2", "-o", &out];
        let done = program().args(args).env("UNRIPPLE_PYTHON", &script).output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        serde_json::from_slice::<serde_json::Value>(&done.stdout).unwrap()
    };
    let report = search();
    assert_eq!((report["designs"].as_u64(), report["done"].as_u64()), (Some(4), Some(2)));
    let ended = (report["ended"]["by"].as_str(), report["ended"]["why"].as_str());
    assert_eq!(ended, (Some("optimiser"), Some("two are enough")));
    let read = |file: &str| fs::read_to_string(format!("{out}/{file}")).unwrap();
    assert_eq!(read("begun"), format!("-m unripple ask {out}\n"));
    assert_eq!(read("told"), "0 since 0\n1 since 0\n2 since 1\n");
    // Begun anew, it is told everything.
    assert_eq!(search()["ended"], report["ended"]);
    assert!(read("told").ends_with("2 since 1\n2 since 0\n"), "{}", read("told"));
}

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
