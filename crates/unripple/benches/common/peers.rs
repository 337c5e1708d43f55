//! Programs in Python that are compared with, run in a virtual environment of their own.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Python packages that the scripts need.
const PACKAGES: [&str; 4] = ["numpy>=2,<3", "scipy>=1.11,<2", "scikit-fem>=12,<13", "pyfar>=0.8,<0.9"];

/// What a script printed: lists of numbers by name.
pub type Answer = BTreeMap<String, Vec<f64>>;

/// Runs `benches/peers/SCRIPT`, which prints lines of a name and numbers, on `threads` threads.
///
/// The first run makes the environment `peers` in the target folder, which takes Python 3 and the network. An error
/// says why there is no answer.
pub fn run(script: &str, arguments: &[String], threads: usize) -> Result<Answer, String> {
    let python = environment()?;
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers").join(script);
    let threads = threads.to_string();
    let mut command = Command::new(python);
    command.arg(path).args(arguments).env("PYTHONDONTWRITEBYTECODE", "1");
    for name in ["OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"] {
        command.env(name, &threads);
    }
    Ok(text_of(&mut command)?.lines().filter_map(entry).collect())
}

/// The numbers that an answer has under a name.
pub fn numbers<'a>(answer: &'a Answer, name: &str) -> Result<&'a [f64], String> {
    answer.get(name).map(Vec::as_slice).ok_or_else(|| format!("the peer did not print `{name}`"))
}

fn entry(line: &str) -> Option<(String, Vec<f64>)> {
    let (name, rest) = line.split_once(' ')?;
    let numbers: Result<Vec<f64>, _> = rest.split_whitespace().map(str::parse).collect();
    Some((name.to_owned(), numbers.ok()?))
}

/// The environment's interpreter.
fn environment() -> Result<PathBuf, String> {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().ok_or("no target folder")?;
    let folder = target.join("peers");
    let python = ["bin/python", "Scripts/python.exe"];
    let found = || python.iter().map(|name| folder.join(name)).find(|path| path.exists());
    if found().is_none() {
        println!("  making an environment for the peers in {}", folder.display());
        text_of(Command::new("python3").args(["-m", "venv"]).arg(&folder))?;
    }
    let python = found().ok_or("the environment has no interpreter")?;
    if text_of(Command::new(&python).args(["-c", "import numpy, scipy, skfem, pyfar"])).is_err() {
        let options = ["-m", "pip", "install", "--quiet", "--retries", "1", "--timeout", "20"];
        text_of(Command::new(&python).args(options).args(PACKAGES))?;
    }
    Ok(python)
}

/// What a command printed, or the last line of its complaint.
fn text_of(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    Err(format!("{name}: {}", complaint.lines().last().unwrap_or("failed without a word")))
}
