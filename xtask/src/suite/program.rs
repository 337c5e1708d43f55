//! Runs one test program as cargo would, and keeps its output.

use super::build::Program;
use super::tally::Tally;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Tests of one program that run at once where its neighbours use the other cores. One alone would run on the main thread, whose name is not
/// the test's.
const THREADS: &str = "2";

/// Priority of a program on the processor's cores.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// Normal priority: it has a core whenever it needs one.
    Prompt,
    /// Low priority: it takes the time that prompt programs leave.
    Yielding,
}

/// Result of running a program.
pub struct End {
    /// Whether it ended with status 0, after printing the result of all its tests.
    pub passed: bool,
    /// Counts of tests that passed and failed.
    pub tally: Tally,
    /// What it wrote on standard output and standard error, in order.
    pub output: String,
    /// Time from its start to its end.
    pub took: Duration,
}

/// Runs a program in its package's folder, with the environment that cargo would set.
pub fn run(program: &Program, pace: Pace, folder: &Path) -> Result<End, String> {
    let began = Instant::now();
    // A file, not a pipe: what a program started and did not end would keep a pipe open.
    let kept = folder.join(format!("{}-{}.txt", program.package, program.name));
    let said = |error: std::io::Error| format!("{}: {error}", kept.display());
    let out = File::create(&kept).map_err(said)?;
    let errors = out.try_clone().map_err(said)?;
    let mut command = start(&program.path, pace);
    if pace == Pace::Yielding && std::env::var_os("RUST_TEST_THREADS").is_none() {
        command.env("RUST_TEST_THREADS", THREADS);
    }
    let status = command
        .current_dir(&program.folder)
        .env("CARGO_MANIFEST_DIR", &program.folder)
        .env("CARGO_MANIFEST_PATH", program.folder.join("Cargo.toml"))
        .env("CARGO_PKG_NAME", &program.package)
        .env("CARGO_PKG_VERSION", &program.version)
        // Results of earlier runs are not what is tested.
        .env("UNRIPPLE_CACHE", "")
        .stdin(Stdio::null())
        .stdout(out)
        .stderr(errors)
        .status()
        .map_err(|error| format!("{}: {error}", program.path.display()))?;
    let bytes = std::fs::read(&kept).map_err(said)?;
    let mut output = String::from_utf8_lossy(&bytes).into_owned();
    let counted = Tally::of(&output);
    let passed = status.success() && counted.is_some_and(|tally| tally.failed == 0);
    let mut tally = counted.unwrap_or_default();
    if !passed && tally.failed == 0 {
        // It was ended before it came to its count.
        tally.failed = 1;
        output.push_str(&format!("{status}, without a result\n"));
    }
    Ok(End { passed, tally, output, took: began.elapsed() })
}

/// A program that yields has a lower priority, where there is the command for that.
fn start(path: &Path, pace: Pace) -> Command {
    let lower = pace == Pace::Yielding && cfg!(unix) && Path::new("/usr/bin/nice").exists();
    if !lower {
        return Command::new(path);
    }
    let mut command = Command::new("/usr/bin/nice");
    command.args(["-n", "10"]).arg(path);
    command
}
