//! Output folders: whole or not at all, and never over what is not ours.

use std::fs;
use std::path::{Path, PathBuf};
use unripple_store::{MARKER, OutputDir, StoreError, write_file};

/// A folder of this test's own, gone at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("unripple-outputs-{}-{name}", std::process::id()));
        fs::create_dir(&path).unwrap();
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

#[test]
fn what_somebody_put_into_a_folder_of_ours_is_kept() {
    let scratch = Scratch::new("guests");
    let place = scratch.0.join("out");
    let first = OutputDir::create(&place).unwrap();
    first.write("report.md", b"# Report\n").unwrap();
    first.commit().unwrap();
    let refuse = |words: &str| {
        let error = OutputDir::create(&place).unwrap_err();
        assert!(matches!(error, StoreError::Occupied { .. }) && error.to_string().contains(words), "{error}");
    };
    fs::write(place.join("notes.txt"), "x").unwrap();
    refuse("`notes.txt`");
    fs::remove_file(place.join("notes.txt")).unwrap();
    fs::create_dir(place.join("lib")).unwrap();
    refuse("`lib`");
    fs::remove_dir(place.join("lib")).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/", place.join("root")).unwrap();
        refuse("`root`");
        fs::remove_file(place.join("root")).unwrap();
    }
    fs::write(place.join("report.md"), b"# Rapport").unwrap();
    refuse("`report.md`");
    fs::remove_file(place.join("report.md")).unwrap();
    fs::create_dir(place.join("report.md")).unwrap();
    refuse("`report.md`");
    fs::remove_dir(place.join("report.md")).unwrap();
    // What the user has deleted is not missed; the same bytes again are ours.
    assert!(OutputDir::create(&place).unwrap().commit().unwrap().replaced);
    assert_eq!(names(&place), [MARKER]);
}

#[test]
fn what_comes_into_the_folder_meanwhile_is_kept() {
    let scratch = Scratch::new("meanwhile");
    let place = scratch.0.join("out");
    OutputDir::create(&place).unwrap().commit().unwrap();
    let out = OutputDir::create(&place).unwrap();
    out.write("report.md", b"new").unwrap();
    fs::write(place.join("notes.txt"), "x").unwrap();
    assert!(matches!(out.commit(), Err(StoreError::Occupied { .. })));
    assert_eq!(names(&place), [MARKER, "notes.txt"]);
    assert_eq!(scratch.names(), ["out"]);
}

#[test]
fn folders_of_others_with_a_temporary_name_stay() {
    let scratch = Scratch::new("taken-names");
    // As another container leaves them, whose processes have the same numbers.
    let taken: Vec<String> =
        (0..64).map(|count| format!(".out.unripple-{}-{count}", std::process::id())).collect();
    for name in &taken {
        fs::create_dir(scratch.0.join(name)).unwrap();
        fs::write(scratch.0.join(name).join("theirs"), "x").unwrap();
    }
    if let Ok(out) = OutputDir::create(scratch.0.join("out")) {
        out.commit().unwrap();
    }
    for name in &taken {
        assert_eq!(names(&scratch.0.join(name)), ["theirs"]);
    }
}

#[cfg(unix)]
#[test]
fn devices_and_links_are_not_replaced_by_files() {
    let scratch = Scratch::new("links");
    let (real, link) = (scratch.0.join("real.txt"), scratch.0.join("link.txt"));
    fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink("real.txt", &link).unwrap();
    write_file(&link, b"new").unwrap();
    assert_eq!(fs::read(&real).unwrap(), b"new");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    let socket = scratch.0.join("socket");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    assert!(write_file(&socket, b"x").is_err());
    assert_eq!(scratch.names(), ["link.txt", "real.txt", "socket"]);
}

#[test]
fn what_killed_runs_left_is_removed_and_nothing_else() {
    let scratch = Scratch::new("stale");
    let place = scratch.0.join("out");
    OutputDir::create(&place).unwrap().commit().unwrap();
    let hidden = |letters: &str| scratch.0.join(format!(".out.unripple-{letters}"));
    let unfinished = b"unripple output, unfinished\n";
    // A killed run's; an earlier run's that was just replaced; the same with somebody's notes; not ours, by name or by what it says.
    let killed = hidden("00000000000000ab");
    fs::create_dir(&killed).unwrap();
    fs::write(killed.join(MARKER), unfinished).unwrap();
    fs::write(killed.join("half.png"), "x").unwrap();
    for (letters, more) in [("00000000000000ac", None), ("00000000000000ad", Some("notes.txt"))] {
        fs::create_dir(hidden(letters)).unwrap();
        fs::copy(place.join(MARKER), hidden(letters).join(MARKER)).unwrap();
        more.into_iter().for_each(|name| fs::write(hidden(letters).join(name), "x").unwrap());
    }
    for name in ["short", "00000000000000ae"] {
        fs::create_dir(hidden(name)).unwrap();
    }
    fs::write(hidden("short").join(MARKER), unfinished).unwrap();
    fs::write(hidden("00000000000000ae").join("theirs"), "x").unwrap();
    fs::create_dir(hidden("00000000000000af")).unwrap();
    // One whose maker lives.
    let living = OutputDir::create(&place).unwrap();
    living.write("report.md", b"x").unwrap();
    drop(OutputDir::create(&place).unwrap());
    let alive = living.path().file_name().unwrap().to_str().unwrap().to_owned();
    let mut expected = vec![
        ".out.unripple-00000000000000ad",
        ".out.unripple-00000000000000ae",
        ".out.unripple-short",
        &alive,
        "out",
    ];
    expected.sort_unstable();
    assert_eq!(scratch.names(), expected);
    living.commit().unwrap();
    assert_eq!(names(&place), [MARKER, "report.md"]);
}
