//! Output folders: whole or not at all, and never over what is not ours.

use std::fs;
use std::path::{Path, PathBuf};
use unripple_store::{MARKER, OutputDir, StoreError, write_file};

/// A folder of this test's own, gone at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("unripple-outputs-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// Names of what is in it, hidden files too.
    fn names(&self) -> Vec<String> {
        names(&self.0)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn names(path: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(path).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn appears_whole_at_commit() {
    let scratch = Scratch::new("whole");
    let place = scratch.0.join("a/b/out");
    let out = OutputDir::create(&place).unwrap();
    out.write("report.json", b"{}").unwrap();
    assert!(!place.exists());
    let committed = out.commit().unwrap();
    assert!(!committed.replaced);
    assert_eq!(names(&committed.path), [MARKER, "report.json"]);
    assert_eq!(names(&scratch.0.join("a/b")), ["out"]);
}

#[test]
fn nothing_is_left_of_an_abandoned_run() {
    let scratch = Scratch::new("abandoned");
    let out = OutputDir::create(scratch.0.join("a/b/out")).unwrap();
    out.write("half", b"1").unwrap();
    drop(out);
    assert_eq!(scratch.names(), [""; 0]);
}

#[test]
fn an_earlier_run_is_replaced_whole() {
    let scratch = Scratch::new("earlier");
    let place = scratch.0.join("out");
    let first = OutputDir::create(&place).unwrap();
    first.write("old.png", b"old").unwrap();
    assert!(!first.commit().unwrap().replaced);
    let second = OutputDir::create(&place).unwrap();
    second.write("new.png", b"new").unwrap();
    assert_eq!(names(&place), [MARKER, "old.png"], "kept until the commit");
    assert!(second.commit().unwrap().replaced);
    assert_eq!(names(&place), [MARKER, "new.png"]);
    assert_eq!(scratch.names(), ["out"]);
    fs::create_dir(scratch.0.join("empty")).unwrap();
    assert!(!OutputDir::create(scratch.0.join("empty")).unwrap().commit().unwrap().replaced);
}

#[test]
fn what_is_not_ours_is_refused() {
    let scratch = Scratch::new("foreign");
    let thesis = scratch.0.join("thesis");
    fs::create_dir(&thesis).unwrap();
    fs::write(thesis.join("chapter.tex"), "years").unwrap();
    let file = scratch.0.join("file");
    fs::write(&file, "x").unwrap();
    for (place, found) in [
        (thesis.clone(), "a folder with other things in it"),
        (file.clone(), "something that is not a folder"),
        (std::env::current_dir().unwrap(), "the folder you are in"),
    ] {
        let error = OutputDir::create(&place).unwrap_err();
        assert!(!error.is_bad_input());
        assert!(error.to_string().ends_with(found), "{error}");
    }
    let under_a_file = OutputDir::create(file.join("out")).unwrap_err();
    assert!(matches!(under_a_file, StoreError::Write { .. }), "{under_a_file}");
    assert!(OutputDir::create("/proc/unripple/out").is_err());
    assert_eq!(scratch.names(), ["file", "thesis"]);
    assert_eq!(names(&thesis), ["chapter.tex"]);
}

#[test]
fn a_place_taken_meanwhile_is_respected() {
    let scratch = Scratch::new("race");
    let place = scratch.0.join("out");
    let out = OutputDir::create(&place).unwrap();
    fs::create_dir(&place).unwrap();
    fs::write(place.join("theirs"), "x").unwrap();
    assert!(matches!(out.commit(), Err(StoreError::Occupied { .. })));
    assert_eq!(names(&place), ["theirs"]);
    assert_eq!(scratch.names(), ["out"]);
}

#[test]
fn files_are_whole_or_not_at_all() {
    let scratch = Scratch::new("file");
    let path = scratch.0.join("a.txt");
    write_file(&path, b"one").unwrap();
    write_file(&path, b"two").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"two");
    fs::create_dir(scratch.0.join("taken")).unwrap();
    assert!(matches!(write_file(scratch.0.join("taken"), b"x"), Err(StoreError::Write { .. })));
    assert!(matches!(write_file("..", b"x"), Err(StoreError::Occupied { .. })));
    assert_eq!(scratch.names(), ["a.txt", "taken"]);
}
