//! Long tasks that pages ask for: calibrations, the list of devices, the doctor.

mod quality;
mod running;

use crate::notices::Notices;
use running::{Running, Work};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use unripple_session::{Job, lock};
use unripple_tasks::{DeviceAsk, SurfaceAsk, calibrate, devices, doctor};

/// Largest number of jobs at once: one that measures, and one that looks.
const MOST: usize = 2;

/// How long jobs are waited for at the end, and how often they are looked at then. A longer call is left behind; the
/// program ends.
const ENDING: Duration = Duration::from_secs(3);
const LOOKED: Duration = Duration::from_millis(20);

/// Distance of points of a calibration that says none, in mm. Some eighty points on the paper's film.
const GRID_MM: f64 = 15.0;

/// Name of the surface's file when people save it.
const SAVED: &str = "surface.toml";

/// The long tasks that pages have started.
pub struct Jobs {
    notices: Arc<Notices>,
    folder: PathBuf,
    given: AtomicU64,
    running: Mutex<Vec<Arc<Running>>>,
}

impl Jobs {
    /// An empty list of jobs; calibrations write their libraries to `folder`.
    pub fn new(notices: Arc<Notices>, folder: PathBuf) -> Self {
        Self { notices, folder, given: AtomicU64::new(0), running: Mutex::new(Vec::new()) }
    }

    /// Starts or stops a job, as a page requests. The surface is given as the text of its file.
    ///
    /// # Errors
    /// Reason why the job cannot be started.
    pub fn obey(&self, job: &Job, toml: String) -> Result<(), String> {
        if let Some(id) = job.stop {
            lock(&self.running).iter().filter(|running| running.id == id).for_each(|running| running.stop());
        }
        let Some(kind) = &job.start else { return Ok(()) };
        let mut running = lock(&self.running);
        running.retain(|running| !running.is_over());
        if running.len() >= MOST {
            return Err(format!("jobs: expected at most {MOST} at once, found one more"));
        }
        let (work, command) = self.work(kind, job, toml)?;
        let id = self.given.fetch_add(1, Ordering::Relaxed) + 1;
        running.push(Running::start(id, work, command, self.notices.clone())?);
        Ok(())
    }

    /// The task of a job, and the command line that does the same.
    fn work(&self, kind: &str, job: &Job, toml: String) -> Result<(Work, String), String> {
        let surface = SurfaceAsk::Text { toml, name: None };
        match kind {
            "devices" => Ok((Work::Devices(devices::Ask::default()), "unripple devices".into())),
            "doctor" => {
                let ask = doctor::Ask { surface, ..doctor::Ask::default() };
                Ok((Work::Doctor(Box::new(ask)), format!("unripple doctor {SAVED}")))
            }
            "calibrate" => {
                let output = self.folder.join(plain(job.name.as_deref().unwrap_or("library"))?);
                let grid = job.grid_mm.unwrap_or(GRID_MM);
                let seed = job.unknowns.map_or(String::new(), |seed| format!(" --unknowns {seed}"));
                let command =
                    format!("unripple calibrate {SAVED} --grid-mm {grid}{seed} -o {}", output.display());
                let device = DeviceAsk { unknowns: job.unknowns, ..DeviceAsk::default() };
                let pitch_m = Some(grid / 1e3);
                let ask = calibrate::Ask { surface, device, pitch_m, output, ..calibrate::Ask::default() };
                Ok((Work::Calibrate(Box::new(ask)), command))
            }
            other => Err(format!("job: expected calibrate, doctor or devices, found {other}")),
        }
    }

    /// Stops all jobs, and waits until they have ended, at most 3 s.
    pub fn close(&self) {
        let running = lock(&self.running).clone();
        running.iter().for_each(|running| running.stop());
        let began = Instant::now();
        while running.iter().any(|running| !running.is_over()) && began.elapsed() < ENDING {
            std::thread::sleep(LOOKED);
        }
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
