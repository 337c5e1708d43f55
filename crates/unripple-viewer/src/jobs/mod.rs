//! What takes a while and is done by the same program beside this one: calibrations, the list of devices, the doctor.

mod quality;
mod running;

use crate::board::Board;
use crate::link::Caller;
use crate::lock::lock;
use crate::wire::Job;
use running::Running;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Jobs at once.
const MOST: usize = 2;

/// How long jobs are waited for at the end, and how often they are looked at then.
const ENDING: Duration = Duration::from_secs(3);
const LOOKED: Duration = Duration::from_millis(20);

/// Distance of points of a calibration that says none, in mm.
const GRID_MM: f64 = 15.0;

/// The jobs there are.
pub struct Jobs {
    board: Arc<Board>,
    program: PathBuf,
    folder: PathBuf,
    given: AtomicU64,
    running: Mutex<Vec<Arc<Running>>>,
}

impl Jobs {
    /// None yet; libraries go to `folder`.
    pub fn new(board: Arc<Board>, program: PathBuf, folder: PathBuf) -> Self {
        Self { board, program, folder, given: AtomicU64::new(0), running: Mutex::new(Vec::new()) }
    }

    /// Starts or ends a job on a surface, given as the text of its file.
    pub fn obey(&self, job: &Job, toml: String, caller: &Caller) {
        if let Some(id) = job.stop {
            lock(&self.running).iter().filter(|running| running.id == id).for_each(|running| running.stop());
        }
        let Some(kind) = &job.start else { return };
        if let Err(why) = self.start(kind, job, toml) {
            caller.refuse(&why);
        }
    }

    fn start(&self, kind: &str, job: &Job, toml: String) -> Result<(), String> {
        let mut running = lock(&self.running);
        running.retain(|running| !running.is_over());
        if running.len() >= MOST {
            return Err(format!("jobs: expected at most {MOST} at once, found one more"));
        }
        let id = self.given.fetch_add(1, Ordering::Relaxed) + 1;
        let name = format!("unripple-view-{}-{id}.toml", std::process::id());
        let surface = std::env::temp_dir().join(name);
        let path = surface.display().to_string();
        let mut arguments = vec![kind.to_owned()];
        let mut library = None;
        match kind {
            "devices" => {}
            "doctor" => arguments.push(path),
            "calibrate" => {
                let place = self.folder.join(plain(job.name.as_deref().unwrap_or("library"))?);
                let grid = job.grid_mm.unwrap_or(GRID_MM);
                arguments.extend([path, "--grid-mm".into(), grid.to_string()]);
                if let Some(seed) = job.unknowns {
                    arguments.extend(["--unknowns".into(), seed.to_string()]);
                }
                arguments.extend(["-o".into(), place.display().to_string()]);
                library = Some(place);
            }
            other => return Err(format!("job: expected calibrate, doctor or devices, found {other}")),
        }
        arguments.push("--json".into());
        let file = Sheet::put(surface, &toml)?;
        let started = Running::start(id, &self.program, arguments, library, file, self.board.clone())?;
        running.push(started);
        Ok(())
    }

    /// Ends all of them, and waits until they have.
    pub fn close(&self) {
        let running = lock(&self.running).clone();
        running.iter().for_each(|running| running.stop());
        let began = Instant::now();
        while running.iter().any(|running| !running.is_over()) && began.elapsed() < ENDING {
            std::thread::sleep(LOOKED);
        }
    }
}

/// The surface as a file, for a program beside this one; gone when it is dropped.
pub struct Sheet {
    path: PathBuf,
}

impl Sheet {
    fn put(path: PathBuf, toml: &str) -> Result<Self, String> {
        let failed = |path: &Path, error| format!("writing {} for a job: {error}", path.display());
        // A file that is there already is somebody else's.
        let opened = File::options().write(true).create_new(true).open(&path);
        let mut file = opened.map_err(|error| failed(&path, error))?;
        let sheet = Self { path };
        file.write_all(toml.as_bytes()).map_err(|error| failed(&sheet.path, error))?;
        Ok(sheet)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Sheet {
    fn drop(&mut self) {
        // A file that is gone already need not be removed.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// A name that is one folder and nowhere else.
fn plain(name: &str) -> Result<&str, String> {
    let legal = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    if name.chars().all(legal) && !name.starts_with('-') {
        return Ok(name);
    }
    Err(format!("name of a library: expected letters, digits, - and _, found {}", name.escape_debug()))
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn a_library_stays_in_its_folder() {
        assert_eq!(plain("film_2-a"), Ok("film_2-a"));
        for name in ["..", "a/b", "../x", "-o", "a b", "a\0", "é", "C:\\x"] {
            assert!(plain(name).is_err(), "{name}");
        }
    }
}
