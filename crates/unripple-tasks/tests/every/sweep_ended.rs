//! Sweeps that are ended in the middle, and rows that are left of them.

use super::sweeps::{GRID, Scratch, rows};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
#[cfg(unix)]
use std::{
    cell::{Cell, RefCell},
    process::Command,
    time::{Duration, Instant},
};
use unripple_tasks::Silent;
use unripple_tasks::sweep::{Ask, Plan, run};
#[cfg(unix)]
use unripple_tasks::sweep::{Piece, Workers, compute, run_with};
#[cfg(unix)]
use unripple_tasks::{Progress, TaskError};

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

/// A command that is ended from outside if its piece has the design 4, which is in shard 1; any other is computed.
#[cfg(unix)]
fn ended(piece: &Piece, compute: impl FnOnce()) -> Command {
    let ends = match piece {
        Piece::Shards(shards) => shards.contains(&1),
        Piece::Shard(shard) => *shard == 1,
        Piece::Design(index) => *index == 4,
    };
    let mut command = Command::new("sh");
    if ends {
        command.args(["-c", "kill -TERM $$"]);
    } else {
        compute();
        command.args(["-c", "true"]);
    }
    command
}

#[cfg(unix)]
#[test]
fn a_design_whose_process_somebody_ends_does_not_end_the_sweep() {
    let scratch = Scratch::new("sweep-term");
    let ask = scratch.ask(&GRID.replace("-1", "250"), "out");
    let command = |piece: Piece| ended(&piece, || compute(&ask, piece.clone(), &mut Silent).unwrap());
    let report = run_with(&ask, Some(&Workers { jobs: 3, command: &command }), &mut Silent).unwrap();
    assert_eq!((report.done, report.failed, report.failures[0].index), (8, 1, 4), "{report:?}");
    assert!(report.failures[0].error.contains("signal 15"), "{report:?}");
}

/// Cancelled some time after a process is ended, as where a signal is for all of its group and comes to this one last.
#[cfg(unix)]
struct Group<'c>(&'c Cell<Option<Instant>>);

#[cfg(unix)]
impl Progress for Group<'_> {
    fn cancelled(&self) -> bool {
        self.0.get().is_some_and(|sent| sent.elapsed() > Duration::from_millis(100))
    }
}

#[cfg(unix)]
#[test]
fn a_sweep_that_is_ended_with_its_processes_makes_no_rows_of_them() {
    let scratch = Scratch::new("sweep-group");
    let ask = scratch.ask(&GRID.replace("-1", "250"), "out");
    let (sent, asked) = (Cell::new(None), RefCell::new(Vec::new()));
    let command = |piece: Piece| {
        asked.borrow_mut().push(piece.to_string());
        sent.set((piece == Piece::Design(4)).then(Instant::now));
        ended(&piece, || compute(&ask, piece.clone(), &mut Silent).unwrap())
    };
    let workers = Workers { jobs: 1, command: &command };
    let error = run_with(&ask, Some(&workers), &mut Group(&sent)).unwrap_err();
    assert!(matches!(error, TaskError::Cancelled), "{error}");
    assert_eq!(asked.borrow().last().map(String::as_str), Some("design:4"));
    let out = scratch.0.join("out");
    assert!(out.join("rows/3.json").is_file() && !out.join("rows/4.json").exists());
}
