//! A JACK server with its dummy driver, for tests.
#![allow(dead_code)] // Each test file uses its own part of this.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};
use unripple_core::Device;
use unripple_devices::{Bridge, DevicesError};

/// Message for a test that is skipped, since there is no server.
pub const NONE: &str = "there is no jackd here (Debian: apt install jackd2)";

/// A server for one test, which ends with it.
pub struct Server {
    child: Child,
    pub name: String,
    /// Samples in a cycle, as it was started.
    pub period: usize,
    /// Where what it says is kept.
    said: PathBuf,
}

impl Server {
    /// Starts a server; `None` where there is no `jackd`.
    pub fn start(period: usize) -> Option<Self> {
        static STARTED: AtomicU32 = AtomicU32::new(0);
        let number = STARTED.fetch_add(1, Ordering::Relaxed);
        Self::named(&format!("unripple-test-{}-{number}", std::process::id()), period)
    }

    /// Starts a server under a name, for one that comes back.
    pub fn named(name: &str, period: usize) -> Option<Self> {
        Self::with(name, period, &["--no-realtime"])
    }

    /// A server with real-time priority 10, where the system grants it.
    pub fn real_time(name: &str, period: usize) -> Option<Self> {
        Self::with(name, period, &["--realtime", "--realtime-priority", "10"])
    }

    fn with(name: &str, period: usize, scheduling: &[&str]) -> Option<Self> {
        let said = std::env::temp_dir().join(format!("{name}.jackd"));
        let output = File::create(&said).unwrap();
        let child = Command::new("jackd")
            .args(scheduling)
            .args(["--no-mlock", "--name", name])
            .args(["-d", "dummy", "-r", "48000", "-p", &period.to_string(), "-C", "2", "-P", "2"])
            .stdout(output.try_clone().unwrap())
            .stderr(output)
            .spawn();
        let Ok(child) = child else {
            // Nobody wrote to it.
            let _ = std::fs::remove_file(said);
            return None;
        };
        Some(Self { child, name: name.to_owned(), period, said })
    }

    /// What the server has said, and how the kernel sees it: for whoever wonders why it gives no answer.
    fn story(&self) -> String {
        let read = |path: &Path| std::fs::read_to_string(path).unwrap_or_else(|error| error.to_string());
        let stat = read(Path::new(&format!("/proc/{}/stat", self.child.id())));
        format!("jackd {}: {stat}\n{}", self.child.id(), read(&self.said))
    }

    /// Lets the server stand still, as on a machine that is overloaded, or go on.
    pub fn stand_still(&self, still: bool) {
        let signal = if still { "-STOP" } else { "-CONT" };
        let sent = Command::new("kill").args([signal, &self.child.id().to_string()]).status();
        assert!(sent.is_ok_and(|status| status.success()), "no {signal} for the server");
        // Threads go on until one of them has been told, which takes its time where others are at work.
        let start = Instant::now();
        while still && !self.stands_still() {
            assert!(start.elapsed() < Duration::from_secs(20), "the server does not stand still");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Whether all its threads stand still, by the kernel.
    fn stands_still(&self) -> bool {
        let tasks =
            std::fs::read_dir(format!("/proc/{}/task", self.child.id())).into_iter().flatten().flatten();
        let mut states = tasks.filter_map(|task| std::fs::read_to_string(task.path().join("stat")).ok());
        states.all(|stat| stat.rsplit_once(") ").is_some_and(|(_, rest)| rest.starts_with('T')))
    }

    /// Asks the server to end, and waits until it has.
    pub fn stop(&mut self) {
        if let Ok(None) = self.child.try_wait() {
            let _ = Command::new("kill").arg(self.child.id().to_string()).status();
            // One that stands still hears of it once it goes on.
            let _ = Command::new("kill").args(["-CONT", &self.child.id().to_string()]).status();
            let _ = self.child.wait();
        }
    }

    /// Ends the server as a crash does: it tells nobody.
    pub fn crash(&mut self) {
        // One that has ended cannot be ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    /// Runs a device as a client of the server, as soon as that answers.
    pub fn bridge(&self, client: &str, device: impl Fn() -> Box<dyn Device>) -> Result<Bridge, DevicesError> {
        let start = Instant::now();
        loop {
            match Bridge::start(device(), client, Some(&self.name)) {
                Err(DevicesError::Jack { .. }) if start.elapsed() < Duration::from_secs(10) => {
                    std::thread::sleep(Duration::from_millis(50));
                }
                Err(error) => {
                    eprintln!("no answer: {}", self.story());
                    return Err(error);
                }
                other => return other,
            }
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop();
        // It is gone already where a server of the same name came after this one.
        let _ = std::fs::remove_file(&self.said);
    }
}
