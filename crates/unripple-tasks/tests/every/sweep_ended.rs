//! Sweeps that are ended in the middle, and rows that are left of them.

use super::sweeps::{GRID, Scratch, rows};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use unripple_tasks::Silent;
use unripple_tasks::sweep::{Ask, Plan, run};

/// The row of a design that is as good as one of this program, but for what `change` makes of it, kept in a folder.
fn keep(folder: &Path, plan: &Plan, index: usize, change: &dyn Fn(&mut Value)) {
    let design = plan.design(index);
    let mut row = json!({
        "index": index, "hash": design.hash, "version": env!("CARGO_PKG_VERSION"), "values": design.values,
        "figures": { "/count": 1234, "/frequencies_hz/0": 0.5, "/relative_error": 0 },
    });
    change(&mut row);
    fs::create_dir_all(folder.join("rows")).unwrap();
    fs::write(folder.join(format!("rows/{index}.json")), format!("{row}\n")).unwrap();
}

#[test]
fn kept_rows_of_another_plan_or_version_are_computed_again() {
    let scratch = Scratch::new("sweep-stale");
    run(&scratch.ask(GRID, "whole"), &mut Silent).unwrap();
    let ask = scratch.ask(GRID, "out");
    let (out, plan) = (scratch.0.join("out"), Plan::open(&ask.plan).unwrap());
    // So that the folder is that of the plan.
    run(&Ask { shard: Some(2), ..ask.clone() }, &mut Silent).unwrap();
    keep(&out, &plan, 0, &|row| row["version"] = "0.0.1".into());
    keep(&out, &plan, 1, &|row| row["hash"] = plan.design(7).hash.into());
    keep(&out, &plan, 2, &|row| row["index"] = 5.into());
    keep(&out, &plan, 3, &|row| row["lacks_memory"] = true.into());
    fs::write(out.join("rows/5.json"), "{\"index\": 5, \"ha").unwrap();
    run(&ask, &mut Silent).unwrap();
    assert_eq!(scratch.read("out/table.csv"), scratch.read("whole/table.csv"));
    assert!(!out.join("rows").exists());
}

#[test]
fn a_kept_row_is_not_computed_again_and_goes_with_its_shard() {
    let scratch = Scratch::new("sweep-kept");
    let ask = scratch.ask(GRID, "out");
    let (out, plan) = (scratch.0.join("out"), Plan::open(&ask.plan).unwrap());
    run(&Ask { shard: Some(2), ..ask.clone() }, &mut Silent).unwrap();
    keep(&out, &plan, 0, &|_| ());
    run(&ask, &mut Silent).unwrap();
    assert_eq!(rows(&out, 3)[0].figures.get("/count"), Some(&json!(1234)));
    // What a process that was killed left beside a shard that is done does not come back with it.
    keep(&out, &plan, 1, &|_| ());
    run(&ask, &mut Silent).unwrap();
    fs::remove_file(out.join("parts/0.jsonl")).unwrap();
    run(&ask, &mut Silent).unwrap();
    assert!(rows(&out, 3).iter().all(|row| row.figures.get("/count") != Some(&json!(1234))));
}
