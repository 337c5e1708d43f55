//! What takes a while and is done by the same program beside this one: calibrations, the list of devices, the doctor.

mod quality;
mod running;

use crate::board::Board;
use crate::link::Caller;
use crate::wire::Job;
use running::Running;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};

/// Jobs at once.
const MOST: usize = 2;

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
            self.lock().iter().filter(|running| running.id == id).for_each(|running| running.stop());
        }
        let Some(kind) = &job.start else { return };
        if let Err(why) = self.start(kind, job, toml) {
            caller.refuse(&why);
        }
    }

    fn start(&self, kind: &str, job: &Job, toml: String) -> Result<(), String> {
        let mut running = self.lock();
        running.retain(|running| !running.is_over());
        if running.len() >= MOST {
            return Err(format!("jobs: expected at most {MOST} at once, found one more"));
        }
        let id = self.given.fetch_add(1, Ordering::Relaxed) + 1;
        let surface = self.put(id, &toml)?;
        let mut arguments = vec![kind.to_owned()];
        let mut library = None;
        match kind {
            "devices" => {}
            "doctor" => arguments.push(surface.display().to_string()),
            "calibrate" => {
                let place = self.folder.join(plain(job.name.as_deref().unwrap_or("library"))?);
                let grid = job.grid_mm.unwrap_or(GRID_MM);
                arguments.extend([surface.display().to_string(), "--grid-mm".into(), grid.to_string()]);
                if let Some(seed) = job.unknowns {
                    arguments.extend(["--unknowns".into(), seed.to_string()]);
                }
                arguments.extend(["-o".into(), place.display().to_string()]);
                library = Some(place);
            }
            other => return Err(format!("job: expected calibrate, doctor or devices, found {other}")),
        }
        arguments.push("--json".into());
        let started = Running::start(id, &self.program, arguments, library, surface, self.board.clone())?;
        running.push(started);
        Ok(())
    }

    /// The surface as a file, for a program beside this one.
    fn put(&self, id: u64, toml: &str) -> Result<PathBuf, String> {
        let name = format!("unripple-view-{}-{id}.toml", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, toml).map_err(|error| format!("writing the surface for a job: {error}"))?;
        Ok(path)
    }

    /// Ends all of them.
    pub fn close(&self) {
        self.lock().iter().for_each(|running| running.stop());
    }

    /// What another thread left behind when it panicked is still a list.
    fn lock(&self) -> MutexGuard<'_, Vec<Arc<Running>>> {
        self.running.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
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
