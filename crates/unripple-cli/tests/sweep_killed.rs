//! A sweep that is killed again and again and goes on each time: no row is lost, none is there twice, and all bits are those of an undisturbed run.
//!
//! `UNRIPPLE_KILLS` sets how often it is killed, `UNRIPPLE_SEED` the moments.
#![cfg(unix)]

mod common;

use common::dice::{Dice, number};
use common::{Scratch, json, refused};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A sweep of 240 designs, each of some milliseconds, in 240 shards; a few of them fail.
const PLAN: &str = r#"format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 400 }
figures = ["/count", "/frequencies_hz/0", "/frequencies_hz/1", "/decay_times_s/0"]
shard = 1
[[axis]]
key = "sheet.tension_n_per_m"
values = [-1, 150, 200, 250, 300, 350]
[[axis]]
key = "sheet.thickness_mm"
from = 0.05
to = 0.2
steps = 40
log = true
"#;

/// Number of designs of the plan.
const DESIGNS: usize = 240;

/// Time in which a process takes a shard, or ends, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// The shards that are done, with their bytes.
fn parts(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let Ok(entries) = fs::read_dir(out.join("parts")) else { return BTreeMap::new() };
    let files = entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    files
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(path).unwrap()))
        .collect()
}

/// When each shard was put in place.
fn times(out: &Path) -> BTreeMap<String, std::time::SystemTime> {
    let time = |name: &String| fs::metadata(out.join("parts").join(name)).unwrap().modified().unwrap();
    parts(out).keys().map(|name| (name.clone(), time(name))).collect()
}

/// Starts the sweep, on two processes.
fn start(plan: &str, out: &str) -> Child {
    let mut command = common::program();
    command.args(["sweep", plan, "--jobs", "2", "-o", out]);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// Waits until so many shards more are done, or the sweep has ended by itself.
fn wait_for(child: &mut Child, out: &Path, more: usize) {
    let (began, before) = (Instant::now(), parts(out).len());
    while parts(out).len() < before + more && child.try_wait().unwrap().is_none() {
        assert!(began.elapsed() < PATIENCE, "no shard was done");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Numbers of the processes that work on a plan, other than `own`.
fn processes(plan: &str, own: u32) -> Vec<u32> {
    let Ok(entries) = fs::read_dir("/proc") else { return Vec::new() };
    let number = |entry: fs::DirEntry| entry.file_name().to_str()?.parse::<u32>().ok();
    let works = |id: &u32| {
        let line = fs::read(format!("/proc/{id}/cmdline")).unwrap_or_default();
        String::from_utf8_lossy(&line).contains(plan)
    };
    entries.flatten().filter_map(number).filter(|id| *id != own).filter(works).collect()
}

fn send(signal: &str, process: u32) {
    let _ = Command::new("kill").args([signal, &process.to_string()]).stderr(Stdio::null()).status();
}

/// Waits until no process works on a plan: those that were started end with the one that started them.
fn wait_for_none(plan: &str) {
    let began = Instant::now();
    while !processes(plan, 0).is_empty() {
        assert!(began.elapsed() < PATIENCE, "processes outlive the one that started them");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Holds that all that is in a folder is what an undisturbed run has there.
fn agree(whole: &Path, out: &Path) {
    let (expected, found) = (parts(whole), parts(out));
    for (name, bytes) in &found {
        assert_eq!(expected.get(name), Some(bytes), "{name}");
    }
}

#[test]
fn a_sweep_killed_twenty_times_is_equal_to_a_serial_one() {
    let (kills, seed) = (number("UNRIPPLE_KILLS", 20), number("UNRIPPLE_SEED", 1));
    println!("seed {seed}, {kills} kills");
    let (scratch, mut dice) = (Scratch::new("sweep-killed"), Dice(seed));
    let (plan, serial, out) = (scratch.file("plan.toml", PLAN), scratch.join("serial"), scratch.join("out"));
    let report = json(&["sweep", &plan, "-o", &serial]);
    assert_eq!((report["done"].as_u64(), report["failed"].as_u64()), (Some(DESIGNS as u64), Some(40)));
    let (serial, place) = (Path::new(&serial), Path::new(&out));
    let mut during = 0;
    for kill in 0..kills {
        let before = times(place);
        let mut child = start(&plan, &out);
        wait_for(&mut child, place, dice.below(4) as usize);
        std::thread::sleep(Duration::from_millis(dice.below(15)));
        if kill % 4 == 3 {
            // One of the processes first: its shard is tried again.
            processes(&plan, child.id()).first().into_iter().for_each(|id| send("-KILL", *id));
            wait_for(&mut child, place, 1);
        }
        during += usize::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
        wait_for_none(&plan);
        agree(serial, place);
        // What was there is there, and was not computed again.
        let after = times(place);
        assert!(before.iter().all(|(name, time)| after.get(name) == Some(time)), "a row was computed twice");
    }
    assert!(during as u64 * 2 > kills, "the sweep was over after {during} of {kills} kills");
    let report = json(&["sweep", &plan, "--jobs", "2", "-o", &out]);
    assert_eq!((report["done"].as_u64(), report["missing"].as_u64()), (Some(DESIGNS as u64), Some(0)));
    assert_eq!(parts(serial), parts(place));
    let table = |folder: &Path| fs::read_to_string(folder.join("table.csv")).unwrap();
    assert_eq!(table(serial), table(place));
    let indices: Vec<usize> = fs::read_to_string(place.join("table.csv"))
        .unwrap()
        .split("\r\n")
        .skip(1)
        .filter_map(|line| line.split(',').next()?.parse().ok())
        .collect();
    assert_eq!(indices, (0..DESIGNS).collect::<Vec<_>>());
    // Nothing that was under way when a process was killed is left.
    for folder in [place.to_path_buf(), place.join("parts")] {
        let hidden = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().starts_with('.');
        assert_eq!(fs::read_dir(folder).unwrap().flatten().filter(hidden).count(), 0);
    }
}

#[test]
fn shards_of_an_array_make_the_same_table() {
    let scratch = Scratch::new("sweep-array");
    let plan = scratch.file("plan.toml", PLAN.replace("shard = 1\n", "shard = 80\n"));
    let [whole, out] = ["whole", "array"].map(|name| scratch.join(name));
    let counted = json(&["sweep", &plan, "--count"]);
    assert_eq!((counted["designs"].as_u64(), counted["shards"].as_u64()), (Some(DESIGNS as u64), Some(3)));
    json(&["sweep", &plan, "--no-figures", "-o", &whole]);
    // All at once, in a folder that is not there yet.
    let one = |shard: &str| {
        let mut command = common::program();
        command.args(["sweep", &plan, "--no-figures", "--shard", shard, "-o", &out]);
        command.stdout(Stdio::null()).spawn().unwrap()
    };
    let children = ["2", "0", "1"].map(one);
    assert!(children.into_iter().all(|mut child| child.wait().unwrap().success()));
    let table = |folder: &str| fs::read(Path::new(folder).join("table.csv")).unwrap();
    assert!(table(&whole) == table(&out));
    let refusal = refused(&["sweep", &plan, "--shard", "3", "-o", &out], 2);
    assert!(refusal.contains("--shard: expected 0 to 2, found 3"), "{refusal}");
    let refusal = refused(&["sweep", &plan, "--jobs", "0", "-o", &out], 2);
    assert!(refusal.contains("--jobs: expected at least 1, found 0"), "{refusal}");
}

#[test]
fn a_sweep_whose_designs_all_fail_has_failed() {
    let scratch = Scratch::new("sweep-all-fail");
    let plan = "format = 1\ntask = \"modes\"\nsurface = \"hudin-2012\"\n[[axis]]\nkey = \"sheet.tension_n_per_m\"\nvalues = [-1, -2]\n";
    let (plan, out) = (scratch.file("plan.toml", plan), scratch.join("out"));
    let output = common::run(&["sweep", &plan, "--no-figures", "-o", &out]);
    assert_eq!(output.status.code(), Some(1));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("all 2 designs failed"), "{errors}");
    assert!(fs::read_to_string(Path::new(&out).join("table.csv")).unwrap().contains("\r\n1,-2,"));
}
