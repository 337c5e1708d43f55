//! What a test says that cannot run here, for want of a program that is no part of the workspace.

use std::io::Write;

/// Skips the calling test, or fails it where nothing may be skipped: with `CI` or `UNRIPPLE_NOTHING_SKIPPED=1` in the environment.
///
/// The reason goes past what captures the output of tests, so that a person sees it, and to the file that `UNRIPPLE_SKIPPED` names,
/// which `./check` reads out at its end.
#[track_caller]
pub fn skip(why: &str) {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let none = set("CI") || std::env::var_os("UNRIPPLE_NOTHING_SKIPPED").is_some_and(|value| value == "1");
    assert!(!none, "{why}; nothing may be skipped here");
    let thread = std::thread::current();
    let line = format!("SKIPPED: {}: {why}\n", thread.name().unwrap_or("a test"));
    // The macros of printing would be captured.
    let _ = std::io::stderr().write_all(line.as_bytes());
    if let Some(path) = std::env::var_os("UNRIPPLE_SKIPPED") {
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}
