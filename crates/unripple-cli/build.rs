//! Tells the program from which commit it was built, where there is a repository, and from which sources.

use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    let git = |arguments: &[&str]| {
        let output =
            Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
        Some(String::from_utf8(output.stdout).ok()?.trim().to_owned()).filter(|text| !text.is_empty())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_default();
    println!("cargo::rustc-env=UNRIPPLE_COMMIT={commit}");
    // Another commit is another program. Files that are not there would have it built again each time.
    let head = git(&["symbolic-ref", "--quiet", "HEAD"]);
    let paths = ["HEAD"].into_iter().map(str::to_owned).chain(head);
    for path in paths
        .filter_map(|name| git(&["rev-parse", "--git-path", &name]))
        .filter(|path| Path::new(path).exists())
    {
        println!("cargo::rerun-if-changed={path}");
    }
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-env=UNRIPPLE_SOURCES={}", sources().unwrap_or_default());
}

/// A hash of the sources of all crates and of the versions of their dependencies; `None` where they are not beside this one.
fn sources() -> Option<String> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?;
    let mut files = vec![crates.join("../Cargo.lock"), crates.join("../Cargo.toml")];
    for entry in fs::read_dir(crates).ok()? {
        let folder = entry.ok()?.path().join("src");
        println!("cargo::rerun-if-changed={}", folder.display());
        collect(&folder, &mut files);
    }
    files.sort();
    let mut hash = DefaultHasher::new();
    for file in files {
        let content = fs::read(&file).ok()?;
        (file.strip_prefix(crates).ok()?, content).hash(&mut hash);
    }
    Some(format!("{:016x}", hash.finish()))
}

/// Adds all files below a folder.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() { collect(&path, files) } else { files.push(path) }
    }
}
