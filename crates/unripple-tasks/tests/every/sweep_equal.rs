//! Sweeps with designs that are equal: the table is that of computing each, and each is computed once.

use super::sweeps::{Scratch, rows};
use std::fs;
#[cfg(unix)]
use unripple_tasks::sweep::{Ask, Piece, Workers, compute, run_with};
use unripple_tasks::sweep::{Plan, Row, run};
use unripple_tasks::{Silent, commands};
#[cfg(unix)]
use {std::cell::RefCell, std::process::Command};

/// Eight designs, of which three are different, and one of those fails.
const PLAN: &str = r#"format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 250 }
figures = ["/count", "/frequencies_hz/0"]
shard = 3
[[axis]]
key = "sheet.tension_n_per_m"
values = [150, -1, 150.0, 200]
[[axis]]
key = "sheet.thickness_mm"
values = [0.1, 0.1]
"#;

/// Index of the first design that is equal to each.
const FIRST: [usize; 8] = [0, 0, 2, 2, 0, 0, 6, 6];

#[test]
fn the_table_is_that_of_computing_each() {
    let scratch = Scratch::new("sweep-equal");
    let ask = scratch.ask(PLAN, "out");
    let report = run(&ask, &mut Silent).unwrap();
    assert_eq!((report.done, report.failed), (8, 2), "{report:?}");
    let plan = Plan::open(&ask.plan).unwrap();
    for row in rows(&scratch.0.join("out"), 3) {
        let design = plan.design(row.index);
        assert_eq!((&row.hash, &row.values), (&design.hash, &design.values));
        assert_eq!(row.hash, plan.design(FIRST[row.index]).hash);
        match commands::run("modes", plan.ask(&design).unwrap(), &mut Silent) {
            Ok(done) => {
                let alone: serde_json::Value = serde_json::from_str(&done.json).unwrap();
                for (pointer, value) in &row.figures.0 {
                    assert_eq!(Some(value), alone.pointer(pointer), "{pointer} of design {}", row.index);
                }
                assert_eq!(row.figures.0.len(), 2);
            }
            Err(error) => assert_eq!(row.error, Some(error.to_string())),
        }
    }
    // What stands in for a computation that nobody repeats.
    let again = scratch.0.join("again");
    fs::create_dir_all(again.join("parts")).unwrap();
    fs::copy(scratch.0.join("out/plan.json"), again.join("plan.json")).unwrap();
    let marked = scratch.read("out/parts/0.jsonl").replace("\"/count\":", "\"/count\":1000");
    fs::write(again.join("parts/0.jsonl"), marked).unwrap();
    run(&scratch.ask(PLAN, "again"), &mut Silent).unwrap();
    let is_marked =
        |row: &Row| row.figures.get("/count").is_some_and(|count| count.to_string().starts_with("1000"));
    let found: Vec<bool> = rows(&again, 3).iter().map(is_marked).collect();
    assert_eq!(found, [true, true, false, false, true, true, false, false]);
}

#[cfg(unix)]
#[test]
fn processes_leave_equal_designs_to_each_other() {
    let scratch = Scratch::new("sweep-equal-jobs");
    run(&scratch.ask(PLAN, "whole"), &mut Silent).unwrap();
    let ask: Ask = scratch.ask(PLAN, "out");
    let asked = RefCell::new(Vec::new());
    let command = |piece: Piece| {
        asked.borrow_mut().push(piece.to_string());
        compute(&ask, piece, &mut Silent).unwrap();
        Command::new("true")
    };
    let report = run_with(&ask, Some(&Workers { jobs: 2, command: &command }), &mut Silent).unwrap();
    assert_eq!((report.done, report.failed), (8, 2), "{report:?}");
    assert_eq!(scratch.read("out/table.csv"), scratch.read("whole/table.csv"));
    // The designs 3 to 5 are all equal to earlier ones: no process is given their shard.
    assert_eq!(*asked.borrow(), ["shards:0", "shards:2"]);
    assert!(!scratch.0.join("out/rows").exists());
}
