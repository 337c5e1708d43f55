//! The main job as a whole process, figures included: `cargo bench -p unripple --bench process`.

mod common;

use common::machine::{introduce, load, threads};
use common::table::{Table, number};
use common::times::Times;
use common::{Fault, Outcome};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Runs of each command.
const RUNS: usize = 10;

fn main() -> Outcome {
    introduce("process: unripple focus hudin-2012 --at 62,90, from start to exit", threads());
    let binary = match binary() {
        Ok(binary) => binary,
        Err(reason) => {
            println!("  skipped: {reason} (build it with `cargo build --release`)");
            return Ok(());
        }
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bench-process");
    let out = folder.to_string_lossy().into_owned();
    let mut table = Table::new(["", "runs", "best s", "median s", "worst s"]);
    let mut row = |arguments: &[&str]| -> Outcome {
        let times = timed(&binary, arguments)?;
        let name = arguments.iter().filter(|a| **a != out).copied().collect::<Vec<_>>().join(" ");
        let [best, median, worst] = [times.best(), times.median(), times.worst()].map(|t| number(t, 3));
        table.row([name, times.count().to_string(), best, median, worst]);
        Ok(())
    };
    row(&["focus", "hudin-2012", "--at", "62,90", "-o", &out])?;
    row(&["check", "hudin-2012"])?;
    table.print();
    println!("  {} files, {:.1} kB written by focus", written(&folder)?.0, written(&folder)?.1 / 1e3);
    std::fs::remove_dir_all(&folder)?;
    println!("  limit: the start of a process, near what `check` takes");
    println!("  load after {}", load());
    Ok(())
}

/// The release binary, brought up to date.
fn binary() -> Result<PathBuf, String> {
    let arguments = ["build", "--release", "--quiet", "--package", "unripple-cli"];
    let built = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .map_err(|error| error.to_string())?;
    if !built.status.success() {
        return Err("unripple-cli does not build".into());
    }
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().ok_or("no target folder")?;
    let path = target.join("release").join(format!("unripple{}", std::env::consts::EXE_SUFFIX));
    if path.exists() { Ok(path) } else { Err(format!("{} is not there", path.display())) }
}

fn timed(binary: &Path, arguments: &[&str]) -> Result<Times, Fault> {
    let mut fault = None;
    let times = Times::of(RUNS, |_| {
        let status =
            Command::new(binary).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).status();
        match status {
            Ok(status) if status.success() => {}
            Ok(status) => fault = Some(format!("{}: {status}", arguments.join(" "))),
            Err(error) => fault = Some(error.to_string()),
        }
    });
    fault.map_or(Ok(times), |fault| Err(fault.into()))
}

/// Files directly in a folder, and their bytes.
fn written(folder: &Path) -> std::io::Result<(usize, f64)> {
    let sizes: Vec<u64> = std::fs::read_dir(folder)?
        .map(|entry| Ok(entry?.metadata()?.len()))
        .collect::<std::io::Result<_>>()?;
    Ok((sizes.len(), sizes.iter().sum::<u64>() as f64))
}
