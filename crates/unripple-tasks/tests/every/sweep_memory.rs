//! Sweeps in which memory is lacking: for one design, or for a while.

use super::sweeps::{Scratch, rows};
#[cfg(unix)]
use std::{cell::RefCell, process::Command};
use unripple::core::Memory;
#[cfg(unix)]
use unripple_tasks::Progress;
use unripple_tasks::Silent;
use unripple_tasks::sweep::run;
#[cfg(unix)]
use unripple_tasks::sweep::{Piece, Row, Workers, compute, run_with};

/// Four designs in two shards, one of which needs 350 GiB.
const PLAN: &str = r#"format = 1
task = "modes"
surface = "hudin-2012"
figures = ["/count"]
shard = 2
[[axis]]
ask = "top_hz"
values = [200, 400000, 250, 300]
"#;

/// Keeps what it is told.
#[cfg(unix)]
#[derive(Default)]
struct Told(Vec<String>);

#[cfg(unix)]
impl Progress for Told {
    fn tell(&mut self, line: &str) {
        self.0.push(line.into());
    }
}

#[test]
fn a_design_that_needs_more_memory_than_there_is_is_a_row_with_the_numbers() {
    let scratch = Scratch::new("sweep-large");
    let report = run(&scratch.ask(PLAN, "out"), &mut Silent).unwrap();
    assert_eq!((report.done, report.failed, report.failures[0].index), (4, 1, 1), "{report:?}");
    let found = rows(&scratch.0.join("out"), 2);
    let failed: Vec<usize> = found.iter().filter(|row| row.error.is_some()).map(|row| row.index).collect();
    assert_eq!(failed, [1]);
    let error = found[1].error.as_deref().unwrap();
    let numbers: Vec<f64> = error.split(' ').filter_map(|word| word.parse().ok()).collect();
    // The frequency; the memory available and needed, in GiB; the number of unknowns.
    let [hz, available, needed, unknowns, ..] = numbers[..] else { panic!("{error}") };
    assert!(hz == 400e3 && unknowns > 1e4, "{error}");
    assert!(available > 0.0 && available <= 4.0 && needed > 100.0, "{error}");
    assert!(error.contains("GiB, found ") && found[1].figures.is_empty() && !found[1].lacks_memory);
    assert!(found.iter().filter(|row| row.index != 1).all(|row| row.figures.get("/count").is_some()));
    assert!(!scratch.read("out/parts/0.jsonl").contains("lacks_memory"));
}

#[test]
fn memory_that_was_lacking_for_a_while_leaves_no_row() {
    let scratch = Scratch::new("sweep-while");
    let plan = PLAN.replace("400000", "400");
    let ask = scratch.ask(&plan, "out");
    // What the machine has is looked at again before a design is given up.
    let report = Memory::of(1.0).during(|| run(&ask, &mut Silent)).unwrap();
    assert_eq!((report.done, report.failed), (4, 0), "{report:?}");
    run(&scratch.ask(&plan, "whole"), &mut Silent).unwrap();
    assert_eq!(scratch.read("out/table.csv"), scratch.read("whole/table.csv"));
}

#[cfg(unix)]
#[test]
fn a_design_that_neighbours_took_the_memory_of_is_tried_alone() {
    let scratch = Scratch::new("sweep-neighbours");
    run(&scratch.ask(PLAN, "whole"), &mut Silent).unwrap();
    let ask = scratch.ask(PLAN, "out");
    let asked = RefCell::new(Vec::new());
    let command = |piece: Piece| {
        asked.borrow_mut().push(piece.to_string());
        // Together they have no memory; the row of design 3 is there from an earlier run.
        let memory = if matches!(piece, Piece::Shards(_)) { Memory::of(1.0) } else { Memory::default() };
        memory.during(|| compute(&ask, piece, &mut Silent)).unwrap();
        Command::new("true")
    };
    compute(&ask, Piece::Design(3), &mut Silent).unwrap();
    let mut told = Told::default();
    let workers = Workers { jobs: 2, command: &command };
    let report = run_with(&ask, Some(&workers), &mut told).unwrap();
    assert_eq!((report.done, report.failed), (4, 1), "{report:?}");
    assert_eq!(*asked.borrow(), ["shards:0", "shards:1", "design:0", "design:1", "design:2"]);
    assert!(told.0.iter().any(|line| line.contains("shard 0: designs that memory was lacking for")));
    let [whole, found] = ["whole", "out"].map(|name| rows(&scratch.0.join(name), 2));
    let apart =
        |row: &Row| (row.index, row.hash.clone(), row.figures.clone(), row.error.is_some(), row.lacks_memory);
    assert_eq!(found.iter().map(apart).collect::<Vec<_>>(), whole.iter().map(apart).collect::<Vec<_>>());
    assert!(!scratch.0.join("out/rows").exists());
}
