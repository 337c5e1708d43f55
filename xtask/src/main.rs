//! House rules, tests and documentation checks: `cargo xtask tidy`, `test`, `docs` and `circles`.

mod circles;
mod constants;
mod descriptions;
mod docs;
mod floors;
mod items;
mod matrices;
mod openings;
mod quantities;
mod seeds;
mod sizes;
mod suite;
mod words;
#[cfg(test)]
mod workflows;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The profile in which everything is built that tests, the page and the documentation's commands use.
const PROFILE: &str = "checked";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let task = arguments.next().unwrap_or_default();
    let root = root();
    let faults = match task.as_str() {
        "tidy" => tidy(&root),
        "test" => suite::run(&root, &arguments.collect::<Vec<_>>()),
        "docs" => docs::run_all(&root),
        "circles" => {
            let circles = circles::find(&root);
            circles.iter().for_each(|circle| print!("{circle}"));
            println!("circles: {}", circles.len());
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!(
                "usage: cargo xtask tidy | test [--built FILE | OPTIONS OF CARGO TEST] | docs | circles"
            );
            return ExitCode::from(2);
        }
    };
    faults.iter().for_each(|fault| eprintln!("{fault}"));
    if faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Finds every breach of the house rules, one line each.
fn tidy(root: &Path) -> Vec<String> {
    let mut faults = floors::check(root);
    faults.extend(matrices::check(root));
    faults.extend(openings::check(root));
    faults.extend(seeds::check(root));
    faults.extend(sizes::check(root));
    faults.extend(words::check(root));
    faults.extend(descriptions::check(root));
    faults.extend(constants::check(root));
    faults.extend(quantities::check(root));
    faults
}

/// The faults that a rule finds in the sources of crates, tests and examples left out. Of each the rule gives the line, from 0, and
/// what is wrong.
fn sources(root: &Path, rule: &dyn Fn(&str) -> Vec<(usize, String)>) -> Vec<String> {
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
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Files below `folder` whose name ends in one of `endings`. Hidden folders, build output, and output of the README's commands, which may
/// be running, are left out.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
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

#[cfg(test)]
mod tests {
    #[test]
    fn the_house_is_tidy() {
        let root = super::root();
        assert!(super::files(&root, &[".rs"]).len() > 10, "the walk found no code");
        let faults = super::tidy(&root);
        assert!(faults.is_empty(), "\n{}", faults.join("\n"));
    }
}
