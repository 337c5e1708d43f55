//! A Python interpreter with packages, for tests that read our files with other software.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Path of a Python interpreter that has some modules: the system's, or that of a virtual environment of this name in the target folder.
///
/// The environment is created, with packages from the network, only if no test may be skipped: with `CI` or `UNRIPPLE_NOTHING_SKIPPED=1`.
///
/// # Errors
/// Why there is no such interpreter, in words.
pub fn python(name: &str, modules: &str, packages: &[&str]) -> Result<PathBuf, String> {
    let has = |python: &Path| {
        let found = Command::new(python).args(["-c", &format!("import {modules}")]).output();
        found.is_ok_and(|output| output.status.success())
    };
    let own = PathBuf::from("python3");
    if has(&own) {
        return Ok(own);
    }
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().ok_or("no target folder")?;
    let folder = target.join(name);
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if has(&python) {
        return Ok(python);
    }
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if !set("CI") && std::env::var_os("UNRIPPLE_NOTHING_SKIPPED").is_none_or(|value| value != "1") {
        return Err("only ./check --all installs it".into());
    }
    let run = |command: &mut Command| match command.output() {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => {
            // If a package is missing, `venv` reports it on standard output.
            let said = [output.stderr, output.stdout].concat();
            let said = String::from_utf8_lossy(&said).into_owned();
            Err(said.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("").to_owned())
        }
        Err(error) => Err(format!("python3: {error}")),
    };
    let pip = |python: &Path| {
        let pip = ["-m", "pip", "install", "--quiet", "--retries", "3", "--timeout", "20"];
        run(Command::new(python).args(pip).args(packages))
    };
    // Created anew each time: an environment that was interrupted may have a Python without `pip`.
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&folder))?;
    pip(&python)?;
    if has(&python) { Ok(python) } else { Err(format!("after installing {packages:?}: no {modules}")) }
}
