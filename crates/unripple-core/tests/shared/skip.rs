//! Skipping of tests that need a program which is not part of the workspace and is not installed.

use std::io::Write;

/// Reports the calling test as skipped, or fails it if no test may be skipped, that is with `CI` or `UNRIPPLE_NOTHING_SKIPPED=1` in the
/// environment.
///
/// The reason is written directly to standard error, past the capture of test output, so that a person sees it, and to the file that
/// `UNRIPPLE_SKIPPED` names, which `./check` prints at its end.
#[track_caller]
pub fn skip(why: &str) {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let none = set("CI") || std::env::var_os("UNRIPPLE_NOTHING_SKIPPED").is_some_and(|value| value == "1");
    assert!(!none, "{why}; nothing may be skipped here");
    let thread = std::thread::current();
    let line = format!("SKIPPED: {}: {why}\n", thread.name().unwrap_or("a test"));
    // The output of printing macros would be captured.
    let _ = std::io::stderr().write_all(line.as_bytes());
    if let Some(path) = std::env::var_os("UNRIPPLE_SKIPPED") {
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}
