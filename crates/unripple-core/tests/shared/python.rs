//! A Python with packages, for tests by other people's readers.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The system's Python if that has the modules, or that of an environment of this name in the target folder; why there is none.
///
/// The environment is made, with packages from the network, where no test may be skipped: with `CI` or `UNRIPPLE_NOTHING_SKIPPED=1`.
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
            // Where a package is missing `venv` says so on standard output.
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
    // Anew each time: one that was cut short may have a Python without a `pip`.
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&folder))?;
    pip(&python)?;
    if has(&python) { Ok(python) } else { Err(format!("after installing {packages:?}: no {modules}")) }
}
