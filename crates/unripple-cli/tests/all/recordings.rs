//! Recordings made by a simulator that shares nothing with the program, with the faults of real benches: what is wrong is named, what can be survived, survived.
//!
//! A few rows at each run; all of them, on three sheets in three strengths, by `./soak 1 recordings`, which takes hours and goes on where it was stopped.

use crate::python;
use crate::skip;

use python::python;
use serde_json::Value;
use skip::skip;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The bench's folder.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings")
}

/// What the bench says of rows, one object for each, told as they come.
fn rows(python: &Path, arguments: &[&str]) -> Vec<Value> {
    let mut bench = Command::new(python);
    bench
        .arg(folder().join("run.py"))
        .args(["--program", env!("CARGO_BIN_EXE_unripple"), "--json"])
        .env("UNRIPPLE_CONFIG", "")
        .env("UNRIPPLE_CACHE", "")
        // The simulator's arrays are small: threads of its linear algebra would wait for each other on cores that others need.
        .env("OPENBLAS_NUM_THREADS", "1");
    let mut bench = bench.args(arguments).stdout(Stdio::piped()).spawn().unwrap();
    let lines = BufReader::new(bench.stdout.take().unwrap()).lines();
    let rows: Vec<Value> = lines
        .map(|line| serde_json::from_str(&line.unwrap()).unwrap())
        .inspect(|row: &Value| println!("{}", told(row)))
        .collect();
    // Ends with 1 where a row is not as wanted, which the rows themselves say better.
    let status = bench.wait().unwrap();
    assert!(status.code().is_some_and(|code| code < 2) && !rows.is_empty(), "{status}");
    rows
}

/// A row as a line: what was wrong, what came, what was wanted, the share of the clean contrast, what was said.
fn told(row: &Value) -> String {
    let list = |key: &str| -> Vec<String> {
        let values = row[key].as_array().into_iter().flatten();
        values.map(|value| value.as_f64().map_or("-".into(), |share| format!("{share:.2}"))).collect()
    };
    let text = |key: &str| row[key].as_str().unwrap_or_default();
    format!(
        "{:6} {:27} {:>7}  {:9} wanted {:22} exit {}  {:24} {}",
        text("surface"),
        text("fault"),
        row["strength"].to_string(),
        text("came"),
        text("wanted"),
        row["exit"],
        list("shares").join(" "),
        text("message"),
    )
}

#[test]
fn what_is_wrong_is_named_and_what_can_be_is_survived() {
    let python = match python("recordings", "numpy", &["numpy>=1.24,<3"]) {
        Ok(python) => python,
        Err(why) => return skip(&format!("Python with numpy is not here and cannot be had: {why}")),
    };
    let quick = folder().join("quick.txt").display().to_string();
    let all = std::env::var_os("UNRIPPLE_ALL_RECORDINGS").is_some();
    let jobs = std::thread::available_parallelism().map_or(1, usize::from).to_string();
    // Hours of rows are taken up again where they were stopped.
    let kept = concat!(env!("CARGO_TARGET_TMPDIR"), "/recordings.jsonl");
    let wanted = if all { vec!["--jobs", &jobs, "--kept", kept] } else { vec!["--rows", &quick] };
    let rows = rows(&python, &wanted);
    let wrong: Vec<String> = rows.iter().filter(|row| row["as_expected"] != true).map(told).collect();
    println!("{} rows", rows.len());
    assert!(
        wrong.is_empty(),
        "{} of {} otherwise than wanted:\n{}",
        wrong.len(),
        rows.len(),
        wrong.join("\n")
    );
    assert!(
        rows.iter().all(|row| row["came"] != "silent"),
        "nothing is to be silent, whatever the table wants"
    );
}
