//! The test programs of the workspace, built by cargo.

use crate::profile::PROFILE;
use serde_json::Value;
use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A test program, with what cargo would tell it in its environment.
pub struct Program {
    /// Name of its package.
    pub package: String,
    /// Name of its target; `lib` for the tests within the sources of a library.
    pub name: String,
    /// Path of the program.
    pub path: PathBuf,
    /// Folder of its package, in which it runs.
    pub folder: PathBuf,
    /// Version of its package.
    pub version: String,
}

impl std::fmt::Display for Program {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.package, self.name)
    }
}

/// Test programs that were built.
pub struct Built {
    /// All programs that were chosen.
    pub programs: VecDeque<Program>,
    /// Folder in which the programs' output is stored.
    pub folder: PathBuf,
}

/// Finds the test programs that the arguments choose. `--built FILE`: those in cargo's messages in that file; other arguments are passed to
/// `cargo test`, and those that it builds are taken; without arguments, all of the workspace.
pub fn programs(root: &Path, arguments: &[String]) -> Result<Built, String> {
    let messages = match arguments {
        [option, file] if option == "--built" => {
            std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?
        }
        [] => build(root, &["--workspace".to_owned()])?,
        chosen => build(root, chosen)?,
    };
    let packages = packages(root)?;
    let messages = messages.lines().filter_map(|line| serde_json::from_str(line).ok());
    let programs: VecDeque<Program> = messages.filter_map(|message| program(&message, &packages)).collect();
    let folder = programs.front().and_then(|program| program.path.parent()?.parent().map(Path::to_path_buf));
    let folder = folder.ok_or("cargo built no test program")?.join("tested");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(Built { programs, folder })
}

/// Cargo's messages, a line each in JSON, of the programs that it built.
fn build(root: &Path, chosen: &[String]) -> Result<String, String> {
    // `--lib` would ask for tests of the library that Python alone can load; `--tests` leaves out what its manifest says has none.
    let output = cargo(root)
        .args(["test", "--profile", PROFILE, "--tests", "--no-run"])
        .arg("--message-format=json-render-diagnostics")
        .args(chosen)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("cargo: {error}"))?;
    if !output.status.success() {
        return Err("the tests do not compile".into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

fn cargo(root: &Path) -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root);
    cargo
}

/// Name, version and folder.
type Package = (String, String, PathBuf);

/// Packages of the workspace by what cargo calls them in its messages.
fn packages(root: &Path) -> Result<BTreeMap<String, Package>, String> {
    let mut ask = cargo(root);
    let output =
        ask.args(["metadata", "--format-version", "1", "--no-deps"]).stderr(Stdio::inherit()).output();
    let told = output.map_err(|error| format!("cargo: {error}"))?.stdout;
    let told: Value = serde_json::from_slice(&told).map_err(|error| format!("cargo metadata: {error}"))?;
    let one = |package: &Value| {
        let text = |key: &str| package[key].as_str().map(str::to_owned);
        let folder = Path::new(package["manifest_path"].as_str()?).parent()?.to_path_buf();
        Some((text("id")?, (text("name")?, text("version")?, folder)))
    };
    Ok(told["packages"].as_array().into_iter().flatten().filter_map(one).collect())
}

/// The program that a message of cargo tells of, if it is one of tests.
fn program(message: &Value, packages: &BTreeMap<String, Package>) -> Option<Program> {
    if message["reason"] != "compiler-artifact" || message["profile"]["test"] != true {
        return None;
    }
    let path = PathBuf::from(message["executable"].as_str()?);
    let (package, version, folder) = packages.get(message["package_id"].as_str()?)?.clone();
    let is_library = message["target"]["kind"][0] == "lib";
    let name = if is_library { "lib" } else { message["target"]["name"].as_str()? };
    Some(Program { package, name: name.to_owned(), path, folder, version })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_test_programs_are_taken() {
        let package = ("unripple-x".to_owned(), "0.1.0".to_owned(), PathBuf::from("/x"));
        let packages = BTreeMap::from([("x#0.1.0".to_owned(), package)]);
        let message = |kind: &str, test: bool, executable: Option<&str>| {
            serde_json::json!({
                "reason": "compiler-artifact", "package_id": "x#0.1.0", "target": { "kind": [kind], "name": "all" },
                "profile": { "test": test }, "executable": executable,
            })
        };
        let found = |message: &Value| program(message, &packages).map(|program| program.to_string());
        assert_eq!(found(&message("test", true, Some("/t/all-1"))).as_deref(), Some("unripple-x all"));
        assert_eq!(found(&message("lib", true, Some("/t/x-1"))).as_deref(), Some("unripple-x lib"));
        // The program that tests start, and a library.
        assert_eq!(found(&message("bin", false, Some("/t/x"))), None);
        assert_eq!(found(&message("lib", false, None)), None);
    }
}
