//! The files of the checkout that the rules read.

use std::path::{Path, PathBuf};

/// The faults that a rule finds in the sources of crates, tests and examples left out. Of each the rule gives the line, from 0, and
/// what is wrong.
pub fn faults(root: &Path, rule: &dyn Fn(&str) -> Vec<(usize, String)>) -> Vec<String> {
    let all = files(&root.join("crates"), &[".rs"]).into_iter().chain(files(&root.join("xtask"), &[".rs"]));
    let parts = |path: &Path| path.iter().map(|part| part.to_string_lossy().into_owned()).collect::<Vec<_>>();
    let held = |path: &PathBuf| {
        let parts = parts(path);
        let left_out = |part: &String| part == "tests" || part == "tests.rs";
        parts.iter().any(|part| part == "src") && !parts.iter().any(left_out)
    };
    let judged = |path: PathBuf| {
        let found = rule(&std::fs::read_to_string(&path).unwrap_or_default()).into_iter();
        found.map(move |(at, what)| format!("{}:{}: {what}", path.display(), at + 1)).collect::<Vec<_>>()
    };
    all.filter(held).flat_map(judged).collect()
}

/// The checkout's top folder.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Files below `folder` whose name ends in one of `endings`. Hidden folders, build output, and output of the README's commands, which may
/// be running, are left out.
pub fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut found = Vec::new();
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            let output = matches!(name.as_str(), "target" | "out" | "out-field" | "corpus" | "artifacts");
            if !output && !name.starts_with('.') {
                found.extend(files(&path, endings));
            }
        } else if endings.iter().any(|ending| name.ends_with(ending)) {
            found.push(path);
        }
    }
    found.sort();
    found
}
