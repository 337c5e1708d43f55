//! A viewer that is told to stop ends what it does beside, and what was begun can be gone on with.

mod common;

use common::{Served, until};
use std::cell::Cell;
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tungstenite::{Message, WebSocket};
use unripple_store::{Library, PointState};
use unripple_tasks::{Progress, TaskError};
use unripple_viewer::task::{Ask, run};

/// Cancels a task when it has been asked so often whether to go on.
struct Asked {
    most: usize,
    count: Cell<usize>,
}

impl Progress for Asked {
    fn cancelled(&self) -> bool {
        self.count.set(self.count.get() + 1);
        self.count.get() >= self.most
    }
}

/// A folder that is gone when it is dropped.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("viewer-ending-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Starts a calibration of very many points, and waits until some are measured.
fn calibrating(folder: &Folder) -> (Served, Library) {
    let place = folder.path().to_path_buf();
    let served = Served::with(None, |view| view.folder = place);
    let mut page = served.page();
    page.send(Message::text(r#"{"do":"job","start":"calibrate","name":"film","grid_mm":3}"#)).unwrap();
    loop {
        let job = until(&mut page, "job");
        assert_eq!(job["state"], "running", "{job}");
        let library = Library::open(folder.path().join("film"));
        if let Some(library) = library.ok().filter(|library| library.in_state(PointState::Measured).len() > 2)
        {
            return (served, library);
        }
    }
}

#[test]
fn a_calibration_ends_with_the_viewer_and_its_library_can_be_gone_on_with() {
    let folder = Folder::new("viewer");
    let (mut served, begun) = calibrating(&folder);
    let began = Instant::now();
    served.stop();
    assert!(began.elapsed() < Duration::from_secs(2), "{:?}", began.elapsed());
    let left = Library::open(folder.path().join("film")).unwrap();
    let measured = |library: &Library| library.in_state(PointState::Measured).len();
    assert!(measured(&left) >= measured(&begun) && !left.in_state(PointState::Missing).is_empty());
}

/// Stops a job, and waits until it says that it is.
fn stop(page: &mut WebSocket<TcpStream>, id: u64) {
    page.send(Message::text(format!(r#"{{"do":"job","stop":{id}}}"#))).unwrap();
    while until(page, "job")["state"] != "stopped" {}
}

#[test]
fn a_calibration_that_is_stopped_says_so_before_it_measures_on() {
    let folder = Folder::new("stopped");
    let (served, _) = calibrating(&folder);
    let mut page = served.page();
    let id = until(&mut page, "job")["id"].as_u64().unwrap();
    let began = Instant::now();
    stop(&mut page, id);
    // Even where much else is at work.
    assert!(began.elapsed() < Duration::from_secs(2), "{:?}", began.elapsed());
}

/// Points of a library that another surface's calibration made are not those of one that is refused for its sake.
#[test]
fn a_calibration_that_fails_at_once_shows_no_points() {
    let folder = Folder::new("refused");
    let (served, _) = calibrating(&folder);
    let mut page = served.page();
    let id = until(&mut page, "job")["id"].as_u64().unwrap();
    stop(&mut page, id);
    page.send(Message::text(r#"{"do":"edit","tension_n_per_m":170}"#)).unwrap();
    page.send(Message::text(r#"{"do":"job","start":"calibrate","name":"film","grid_mm":3}"#)).unwrap();
    let mut shown = false;
    loop {
        let job = until(&mut page, "job");
        if job["id"].as_u64() == Some(id) {
            continue;
        }
        shown |= !job["quality"].is_null();
        if job["state"] == "failed" {
            break;
        }
        assert_eq!(job["state"], "running", "{job}");
    }
    assert!(!shown);
}

#[test]
fn a_surface_that_is_still_computed_can_be_given_up() {
    // The modes of this outline need a mesh and take seconds: long enough to be asked ten times whether to go on.
    let ask = Ask { surface: "stadium-film".into(), port: 0, ..Ask::default() };
    let mut opened = false;
    let progress = &mut Asked { most: 10, count: Cell::default() };
    let ended = run(&ask, progress, &mut |_| {
        opened = true;
        Err(TaskError::Cancelled)
    });
    assert!(matches!(ended, Err(TaskError::Cancelled)));
    assert!(!opened && progress.count.get() == 10, "asked {} times", progress.count.get());
}
