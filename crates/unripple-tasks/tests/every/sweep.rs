//! Sweeps: rows that are the same whoever computes them, plans that are refused, processes that die.

use serde_json::Value;
use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::process::Command;
use unripple_tasks::sweep::{Ask, Plan, Row, run};
#[cfg(unix)]
use unripple_tasks::sweep::{Piece, Workers, compute, run_with};
use unripple_tasks::{Progress, Report, Silent, TaskError, commands};

/// A folder of a test's own, gone afterwards.
pub(crate) struct Scratch(pub(crate) PathBuf);

impl Scratch {
    pub(crate) fn new(name: &str) -> Self {
        let folder = super::folder(name);
        fs::create_dir(&folder).unwrap();
        Self(folder)
    }

    /// The request for a plan of this text, whose rows go to a folder.
    pub(crate) fn ask(&self, plan: &str, output: &str) -> Ask {
        let file = self.0.join("plan.toml");
        fs::write(&file, plan).unwrap();
        Ask { plan: file, output: Some(self.0.join(output)), no_figures: true, ..Ask::default() }
    }

    pub(crate) fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A grid of 4 x 2 designs in 3 shards, two of which have a tension that no sheet has.
pub(crate) const GRID: &str = r#"format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 250 }
figures = ["/count", "/frequencies_hz/0", "/relative_error"]
shard = 3
[[axis]]
key = "sheet.tension_n_per_m"
values = [150, 200, -1, 300]
[[axis]]
key = "sheet.thickness_mm"
from = 0.1
to = 0.2
steps = 2
"#;

/// Cancels after so many looks.
struct After(Cell<usize>);

impl Progress for After {
    fn cancelled(&self) -> bool {
        self.0.set(self.0.get().saturating_sub(1));
        self.0.get() == 0
    }
}

pub(crate) fn rows(folder: &Path, shards: usize) -> Vec<Row> {
    let part = |shard: usize| fs::read_to_string(folder.join(format!("parts/{shard}.jsonl"))).unwrap();
    let all: String = (0..shards).map(part).collect();
    all.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn rows_are_what_the_task_says_of_each_design() {
    let scratch = Scratch::new("sweep-rows");
    let ask = scratch.ask(GRID, "out");
    let report = run(&ask, &mut Silent).unwrap();
    assert_eq!((report.designs, report.shards, report.done, report.failed, report.missing), (8, 3, 8, 2, 0));
    assert_eq!(report.failures.iter().map(|failed| failed.index).collect::<Vec<_>>(), [4, 5]);
    assert!(report.failures[0].error.contains("tension_n_per_m"), "{}", report.failures[0].error);
    assert!(report.failure().is_none() && report.text().contains("design 4 failed"), "{}", report.text());
    let plan = Plan::open(&ask.plan).unwrap();
    let rows = rows(&scratch.0.join("out"), 3);
    assert_eq!(rows.iter().map(|row| row.index).collect::<Vec<_>>(), (0..8).collect::<Vec<_>>());
    for row in rows.iter().filter(|row| row.error.is_none()) {
        let design = plan.design(row.index);
        assert_eq!((&row.values, &row.hash), (&design.values, &design.hash));
        let done = commands::run("modes", plan.ask(&design).unwrap(), &mut Silent).unwrap();
        let alone: Value = serde_json::from_str(&done.json).unwrap();
        assert_eq!(row.figures.0.len(), 3);
        for (pointer, value) in &row.figures.0 {
            assert_eq!(Some(value), alone.pointer(pointer), "{pointer} of design {}", row.index);
        }
    }
    let least = report.extremes.iter().find(|extreme| extreme.figure == "/frequencies_hz/0").unwrap();
    let hz = |row: &Row| row.figures.get("/frequencies_hz/0").and_then(Value::as_f64);
    let known: Vec<f64> = rows.iter().filter_map(hz).collect();
    assert_eq!(least.least, known.iter().copied().fold(f64::INFINITY, f64::min));
    assert_eq!(least.greatest, known.iter().copied().fold(0.0, f64::max));
    let table = scratch.read("out/table.csv");
    let heading = table.lines().next().unwrap();
    assert_eq!(
        heading,
        "index,surface:sheet.tension_n_per_m,surface:sheet.thickness_mm,hash,version,/count,/frequencies_hz/0,/relative_error,error"
    );
    assert!(table.contains("\r\n7,300,0.2,") && table.ends_with("\r\n"));
}

#[test]
fn what_was_cut_short_goes_on_to_the_same_bits() {
    let scratch = Scratch::new("sweep-cut");
    run(&scratch.ask(GRID, "whole"), &mut Silent).unwrap();
    let ask = scratch.ask(GRID, "cut");
    let mut looks = 2;
    while let Err(error) = run(&ask, &mut After(Cell::new(looks))) {
        assert!(matches!(error, TaskError::Cancelled), "{error}");
        looks += 3;
        assert!(looks < 1000);
    }
    assert!(looks > 8, "it was never cut short within a shard");
    for shard in [2, 0, 1] {
        run(&Ask { shard: Some(shard), ..scratch.ask(GRID, "shards") }, &mut Silent).unwrap();
    }
    for file in ["table.csv", "parts/0.jsonl", "parts/1.jsonl", "parts/2.jsonl"] {
        let whole = scratch.read(&format!("whole/{file}"));
        assert_eq!(whole, scratch.read(&format!("cut/{file}")), "{file}");
        assert_eq!(whole, scratch.read(&format!("shards/{file}")), "{file}");
    }
}

#[test]
fn a_part_of_another_plan_is_refused_though_its_designs_have_the_same_numbers() {
    let scratch = Scratch::new("sweep-part");
    let other = scratch.ask(&GRID.replace("150", "160"), "other");
    run(&Ask { shard: Some(0), ..other }, &mut Silent).unwrap();
    let ask = scratch.ask(GRID, "out");
    run(&Ask { shard: Some(1), ..ask.clone() }, &mut Silent).unwrap();
    fs::copy(scratch.0.join("other/parts/0.jsonl"), scratch.0.join("out/parts/0.jsonl")).unwrap();
    let refused = run(&ask, &mut Silent).unwrap_err().to_string();
    assert!(
        refused.contains("0.jsonl: expected the rows of designs 0 to 2, found 3 rows of others"),
        "{refused}"
    );
}

#[test]
fn the_report_of_the_last_shard_is_of_the_whole() {
    let scratch = Scratch::new("sweep-last");
    let ask = scratch.ask(GRID, "out");
    for shard in [0, 1, 2] {
        run(&Ask { shard: Some(shard), ..ask.clone() }, &mut Silent).unwrap();
    }
    let report: Value = serde_json::from_str(&scratch.read("out/sweep.json")).unwrap();
    assert_eq!((&report["shard"], &report["run"]["ask"]["shard"]), (&Value::Null, &Value::Null));
    assert_eq!(report["done"], 8);
}

#[test]
fn rows_of_another_plan_are_not_mixed_in() {
    let scratch = Scratch::new("sweep-mixed");
    let ask = scratch.ask(GRID, "out");
    run(&Ask { shard: Some(0), ..ask.clone() }, &mut Silent).unwrap();
    let before = Plan::open(&ask.plan).unwrap();
    let other = scratch.ask(&GRID.replace("150", "160"), "out");
    let refused = run(&other, &mut Silent).unwrap_err().to_string();
    let after = Plan::open(&other.plan).unwrap();
    assert!(refused.contains(before.hash()) && refused.contains(after.hash()), "{refused}");
    fs::create_dir(scratch.0.join("mine")).unwrap();
    fs::write(scratch.0.join("mine/notes.txt"), "an afternoon").unwrap();
    let refused = run(&scratch.ask(GRID, "mine"), &mut Silent).unwrap_err().to_string();
    assert!(refused.contains("`notes.txt`"), "{refused}");
    // A part that is not what was written is no row.
    let ask = scratch.ask(GRID, "out");
    fs::write(scratch.0.join("out/parts/1.jsonl"), "{}\n").unwrap();
    let refused = run(&ask, &mut Silent).unwrap_err().to_string();
    assert!(refused.contains("1.jsonl: expected the rows of designs 3 to 5"), "{refused}");
}

#[test]
fn bad_plans_are_refused_with_their_place_and_numbers() {
    let scratch = Scratch::new("sweep-bad");
    let axis = "values = [150, 200, -1, 300]";
    let cases = [
        (GRID.replace("task = \"modes\"", "task = \"mode\""), "(nearest: \"modes\")"),
        (GRID.replace("task = \"modes\"", "task = \"play\""), "task: expected"),
        (GRID.replace("top_hz", "top_herz"), "plan.toml:4:9: ask.top_herz: expected one of"),
        (GRID.replace("shard = 3", "shards = 3"), "plan.toml:6:1: shards: expected one of"),
        (GRID.replace("sheet.thickness_mm", "sheet.thicknes_mm"), "(nearest: thickness_mm)"),
        (GRID.replace("sheet.thickness_mm", "actuator[99].at_mm"), "but there are only 8"),
        (GRID.replace(axis, "values = []"), "axis[0].values: expected a list of at least one value"),
        (GRID.replace(axis, "from = 2\nto = 1\nsteps = 5"), "an empty range has no values, found 1"),
        (
            GRID.replace(axis, "from = 1\nto = 2\nsteps = 1000000000000"),
            "expected a whole number from 2 to 10000000",
        ),
        (
            GRID.replace(axis, "from = 1\nto = 2\nsteps = 9000000"),
            "at most 10000000 designs, found 18000000 designs",
        ),
        (GRID.replace("top_hz = 250", "top_hz = \"high\""), "the options of `modes`"),
        (GRID.replace("/count", "/methods/0/plan_s"), "a time by the clock"),
        (GRID.replace("/count", "/run/date"), "a record of the run"),
        (GRID.replace("hudin-2012", "nowhere.toml"), "no surface"),
        (format!("{GRID}[sobol]\ncount = 10\n"), "from and to, between which Sobol points lie"),
        (
            format!("{GRID}[[design]]\n\"surface:sheet.tension_n_per_m\" = 1\n"),
            "[[axis]] or [[design]], not both",
        ),
    ];
    for (plan, expected) in cases {
        let refused = run(&scratch.ask(&plan, "out"), &mut Silent).unwrap_err();
        assert!(refused.is_bad_input(), "{refused}");
        assert!(refused.to_string().contains(expected), "{expected}: {refused}");
    }
    assert!(!scratch.0.join("out").exists());
    let refused = run(&Ask { shard: Some(3), ..scratch.ask(GRID, "out") }, &mut Silent).unwrap_err();
    assert_eq!(refused.to_string(), "shard: expected 0 to 2, found 3");
}

#[test]
fn a_list_may_vary_anything_in_each_design() {
    let scratch = Scratch::new("sweep-list");
    let plan = r#"format = 1
task = "modes"
surface = "hudin-2012"
[[design]]
"surface:sheet.material" = "glass"
"surface:sheet.thickness_mm" = 0.5
"ask:top_hz" = 300
[[design]]
"ask:top_hz" = 200
"#;
    let ask = Ask { no_figures: false, ..scratch.ask(plan, "out") };
    let report = run(&ask, &mut Silent).unwrap();
    assert_eq!((report.done, report.failed), (2, 0), "{report:?}");
    assert!(report.files.iter().any(|file| file == "sweep.svg"), "{report:?}");
    let table = scratch.read("out/table.csv");
    let mut lines = table.lines();
    assert!(
        lines
            .next()
            .unwrap()
            .starts_with("index,ask:top_hz,surface:sheet.material,surface:sheet.thickness_mm,")
    );
    assert!(
        lines.next().unwrap().starts_with("0,300,glass,0.5,")
            && lines.next().unwrap().starts_with("1,200,,,")
    );
}

#[test]
fn counting_computes_nothing() {
    let scratch = Scratch::new("sweep-count");
    let sobol = "format = 1\ntask = \"design\"\nsurface = \"hudin-2012\"\nsobol = { count = 100, seed = 3 }\n\
                 [[axis]]\nkey = \"sheet.tension_n_per_m\"\nfrom = 100\nto = 400\nlog = true\n";
    let report = run(&Ask { count: true, ..scratch.ask(sobol, "out") }, &mut Silent).unwrap();
    assert_eq!((report.designs, report.shards, report.done, report.missing), (100, 5, 0, 100));
    assert!(report.first_modes.is_some_and(|cost| cost.seconds > 0.0) && !scratch.0.join("out").exists());
    let plan = Plan::open(&scratch.0.join("plan.toml")).unwrap();
    let tension = |index| plan.design(index).values.0[0].1.as_f64().unwrap();
    let low = (0..100).filter(|index| tension(*index) < 200.0).count();
    assert!((48..=52).contains(&low), "{low} of 100 in the lower half of ratios");
}

/// Whether a process of a piece dies at once: all that compute the design 4 do.
#[cfg(unix)]
fn dies(piece: &Piece) -> bool {
    match piece {
        Piece::Shards(shards) => shards.contains(&1),
        Piece::Shard(shard) => *shard == 1,
        Piece::Design(index) => *index == 4,
    }
}

#[cfg(unix)]
#[test]
fn a_design_that_ends_its_process_is_a_row() {
    let scratch = Scratch::new("sweep-dies");
    let plan = GRID.replace("-1", "250");
    run(&scratch.ask(&plan, "whole"), &mut Silent).unwrap();
    let ask = scratch.ask(&plan, "out");
    let command = |piece: Piece| {
        let mut command = Command::new("sh");
        command.arg("-c");
        if dies(&piece) {
            command.arg("kill -9 $$");
        } else {
            compute(&ask, piece, &mut Silent).unwrap();
            command.arg("true");
        }
        command
    };
    let workers = Workers { jobs: 2, command: &command };
    let report = run_with(&ask, Some(&workers), &mut Silent).unwrap();
    assert_eq!((report.done, report.failed), (8, 1), "{report:?}");
    assert!(report.failures[0].index == 4 && report.failures[0].error.contains("signal 9"), "{report:?}");
    let (whole, found) = (rows(&scratch.0.join("whole"), 3), rows(&scratch.0.join("out"), 3));
    for (whole, found) in whole.iter().zip(&found).filter(|(row, _)| row.index != 4) {
        assert_eq!(whole, found);
    }
    assert!(!scratch.0.join("out/rows").exists());
    // It is done, and no process is started again.
    let none = |_: Piece| -> Command { panic!("nothing is missing") };
    run_with(&ask, Some(&Workers { jobs: 2, command: &none }), &mut Silent).unwrap();
}

#[cfg(unix)]
#[test]
fn a_process_that_fails_by_itself_ends_the_sweep() {
    let scratch = Scratch::new("sweep-fails");
    let command = |_: Piece| {
        let mut command = Command::new("sh");
        command.args(["-c", "exit 1"]);
        command
    };
    let workers = Workers { jobs: 3, command: &command };
    let error = run_with(&scratch.ask(GRID, "out"), Some(&workers), &mut Silent).unwrap_err();
    assert!(matches!(&error, TaskError::Work(text) if text.contains("exit status 1")), "{error}");
}

#[test]
fn a_sweep_is_repeated_from_its_report() {
    let scratch = Scratch::new("sweep-rerun");
    run(&scratch.ask(GRID, "out"), &mut Silent).unwrap();
    let ask =
        serde_json::json!({ "report": scratch.0.join("out/sweep.json"), "output": scratch.0.join("again") });
    commands::run("rerun", ask, &mut Silent).unwrap();
    assert_eq!(scratch.read("out/table.csv"), scratch.read("again/table.csv"));
}
