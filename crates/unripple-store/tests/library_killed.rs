//! A writer killed at any moment loses no finished point, and others read meanwhile.

mod library_common;

use library_common::{Folder, plan, quality, samples};
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::time::Duration;
use unripple_store::{Library, PointState};

const ROLE: &str = "UNRIPPLE_LIBRARY_WRITER";
const POINTS: usize = 400;

/// Does nothing by itself: the other tests run it in a process of its own, to be killed.
#[test]
fn writer() {
    let Ok(folder) = std::env::var(ROLE) else { return };
    let plan = plan(POINTS, 2, 100);
    let mut library = Library::create(folder, &plan).unwrap();
    for point in library.in_state(PointState::Missing) {
        library.put(point, &samples(&plan, point), &quality(&plan, point)).unwrap();
        println!("finished {point}");
    }
}

#[test]
fn a_killed_writer_loses_no_finished_point() {
    let folder = Folder::new("killed");
    let plan = plan(POINTS, 2, 100);
    let mut finished: Vec<usize> = Vec::new();
    for round in 0..12 {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["writer", "--exact", "--nocapture"])
            .env(ROLE, &folder.0)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let wanted = 7 * round % 11;
        for line in lines.by_ref().take(wanted + 4).map_while(Result::ok) {
            finished.extend(line.strip_prefix("finished ").and_then(|point| point.parse::<usize>().ok()));
        }
        std::thread::sleep(Duration::from_micros(700 * round as u64));
        if let Ok(mut reader) = Library::open(&folder.0) {
            reader.refresh();
            assert!(reader.verify().is_empty());
        }
        child.kill().unwrap();
        child.wait().unwrap();
        let told = lines.map_while(Result::ok);
        finished.extend(told.filter_map(|line| line.strip_prefix("finished ")?.parse::<usize>().ok()));
        let Ok(library) = Library::open(&folder.0) else {
            assert!(finished.is_empty());
            continue;
        };
        assert!(library.verify().is_empty());
        for point in &finished {
            assert_eq!(library.get(*point).unwrap(), samples(&plan, *point));
            assert_eq!(library.quality(*point).unwrap(), quality(&plan, *point));
        }
    }
    assert!(finished.len() > 20, "{}", finished.len());
    let mut whole = Library::create(&folder.0, &plan).unwrap();
    for point in whole.in_state(PointState::Missing) {
        whole.put(point, &samples(&plan, point), &quality(&plan, point)).unwrap();
    }
    let responses = whole.responses().unwrap();
    assert!((0..POINTS).all(|p| responses.response(1, p) == &samples(&plan, p)[100..]));
}
