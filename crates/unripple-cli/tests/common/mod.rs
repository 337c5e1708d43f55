//! Running the binary as a user would.
#![allow(dead_code)] // Each test file uses its own part of this.

pub mod dice;
pub mod guide;
pub mod schema;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A film of few modes with two actuators: quick, and a sound server has as many ports.
pub const SMALL_FILM: &str = r#"format = 1
name = "A small film"
[outline]
rectangle_mm = [150, 150]
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 70
[drive]
band_hz = [0, 700]
sample_rate_hz = 48000
[[actuator]]
at_mm = [12, 31]
[[actuator]]
at_mm = [121, 17]
"#;

/// A folder of this test's own, gone afterwards.
pub struct Scratch(PathBuf);

impl Scratch {
    pub fn new(name: &str) -> Self {
        // Numbers of processes are not enough: containers share folders. One that is there is somebody else's.
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_nanos();
        let path = std::env::temp_dir().join(format!("unripple-{name}-{}-{now}", std::process::id()));
        std::fs::create_dir(&path).unwrap();
        Self(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// A file in it, with this text.
    pub fn file(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        let path = self.0.join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    }

    pub fn join(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    /// Names of everything in it, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The program, without the configuration file and the cache of whoever runs the tests.
pub fn program() -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_unripple"));
    program.env("UNRIPPLE_CONFIG", "").env("UNRIPPLE_CACHE", "");
    program
}

/// A run of the program; a report that it prints as JSON is [held](hold) to what is published of reports.
pub fn run(arguments: &[&str]) -> Output {
    let output = program().args(arguments).output().unwrap();
    if arguments.contains(&"--json")
        && let Ok(report) = serde_json::from_slice(&output.stdout)
    {
        hold(arguments, &report);
    }
    output
}

/// Fails unless the guide defines every key of a report, and the schema allows all of it.
pub fn hold(arguments: &[&str], report: &Value) {
    let undefined = guide::undefined(report);
    assert!(undefined.is_empty(), "{arguments:?}: {undefined:?} are not defined in docs/json.md");
    let faults = schema::faults(report);
    assert!(faults.is_empty(), "{arguments:?}: not as report-1.json describes: {faults:#?}");
}

/// Standard output of a run that must succeed, as JSON.
pub fn json(arguments: &[&str]) -> Value {
    let output = run(&[arguments, &["--json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Standard error of a run that must end with this status, and print nothing on standard output.
pub fn refused(arguments: &[&str], status: i32) -> String {
    let output = run(arguments);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {errors}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert!(!errors.contains("panicked"), "{errors}");
    errors
}

pub fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {value}"))
}
