//! Tests that cannot run report it where a person sees it, and fail if no test may be skipped.

#[path = "shared/skip.rs"]
mod skip;

use std::process::{Command, Output};

/// Environment variable that is set in the child process, whose test is to be skipped.
const ROLE: &str = "UNRIPPLE_SKIPPING";
const WHY: &str = "there is no such program here";

#[test]
fn a_test_that_needs_what_is_not_here() {
    if std::env::var_os(ROLE).is_some() {
        skip::skip(WHY);
    }
}

/// Runs the test above in a child process with these environment variables, its output captured as `cargo test` does.
fn watched(environment: &[(&str, &str)]) -> Output {
    let mut command = Command::new(std::env::current_exe().unwrap());
    for name in ["CI", "UNRIPPLE_NOTHING_SKIPPED", "UNRIPPLE_SKIPPED"] {
        command.env_remove(name);
    }
    let test = ["--exact", "a_test_that_needs_what_is_not_here"];
    command.args(test).env(ROLE, "1").envs(environment.iter().copied()).output().unwrap()
}

#[test]
fn a_skipped_test_is_seen() {
    let file = std::env::temp_dir().join(format!("unripple-skipping-{}", std::process::id()));
    let output = watched(&[("CI", ""), ("UNRIPPLE_SKIPPED", file.to_str().unwrap())]);
    let line = format!("SKIPPED: a_test_that_needs_what_is_not_here: {WHY}\n");
    let written = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains(&line), "{output:?}");
    assert_eq!(written, line);
}

#[test]
fn where_nothing_may_be_skipped_it_fails() {
    for name in ["CI", "UNRIPPLE_NOTHING_SKIPPED"] {
        let output = watched(&[(name, "1")]);
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(!output.status.success() && said.contains("nothing may be skipped here"), "{output:?}");
    }
}
