//! What is not ours stays: in the folder given to `-o`, and at files that are named as outputs.

use crate::common;

use common::{Scratch, refused, run};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// One actuator, few modes: quick.
const FILM: &str = r#"format = 1
name = "A small film"
[outline]
rectangle_mm = [150, 150]
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 70
[drive]
band_hz = [0, 600]
sample_rate_hz = 48000
[[actuator]]
at_mm = [12, 31]
"#;

/// Every file below a folder, and what is in it.
fn all(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.file_type().unwrap().is_symlink() {
            found.insert(name, fs::read_link(entry.path()).unwrap().into_os_string().into_encoded_bytes());
        } else if entry.file_type().unwrap().is_dir() {
            found.extend(
                all(&entry.path()).into_iter().map(|(below, text)| (format!("{name}/{below}"), text)),
            );
        } else {
            found.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    found
}

/// A surface and a first run in `out`.
fn begun(name: &str) -> (Scratch, String, String) {
    let scratch = Scratch::new(name);
    let (film, out) = (scratch.file("film.toml", FILM), scratch.join("out"));
    let output = run(&["focus", &film, "--at", "62,90", "-o", &out]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    (scratch, film, out)
}

/// Refuses with these words, and changes nothing at all.
fn kept(scratch: &Scratch, arguments: &[&str], status: i32, words: &[&str]) {
    let before = all(scratch.path());
    let errors = refused(arguments, status);
    for part in words {
        assert!(errors.contains(part), "{part:?} in {errors}");
    }
    let after = all(scratch.path());
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&before), names(&after));
    assert!(before == after, "files were changed");
}

#[test]
fn notes_and_libraries_in_an_output_folder_survive() {
    let (scratch, film, out) = begun("notes");
    fs::write(format!("{out}/notes.txt"), "an afternoon").unwrap();
    let library = format!("{out}/lib");
    assert!(
        run(&["respond", &film, "--grid-mm", "40", "--length-ms", "10", "-o", &library]).status.success()
    );
    kept(
        &scratch,
        &["focus", &film, "--at", "62,90", "-o", &out],
        1,
        &["will not write", "notes.txt", "lib"],
    );
    kept(&scratch, &["compare", &film, "--at", "62,90", "-o", &out], 1, &["notes.txt"]);
    kept(&scratch, &["place", &film, "--at", "62,90", "--count", "1", "-o", &out], 1, &["notes.txt"]);
    kept(&scratch, &["reproduce", "-o", &out], 1, &["notes.txt"]);
    kept(&scratch, &["export", &library, "-o", &out], 1, &["notes.txt"]);
    // A run inside an older run's folder makes that hold more than it wrote.
    fs::remove_file(format!("{out}/notes.txt")).unwrap();
    fs::remove_dir_all(&library).unwrap();
    assert!(run(&["focus", &film, "--at", "62,90", "-o", &format!("{out}/x")]).status.success());
    kept(&scratch, &["focus", &film, "--at", "62,90", "-o", &out], 1, &["`x`"]);
}

#[test]
fn a_report_that_somebody_edited_is_theirs() {
    let (scratch, film, out) = begun("edited");
    let again = ["focus", &film, "--at", "62,90", "-o", &out];
    let output = run(&again);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && said.contains("replaced the earlier run"), "{said}");
    let report = format!("{out}/report.md");
    let text = fs::read_to_string(&report).unwrap();
    fs::write(&report, text.replacen('0', "1", 1)).unwrap();
    kept(&scratch, &again, 1, &["`report.md`", "changed"]);
    // What is put back as it was is ours again.
    fs::write(&report, text).unwrap();
    assert!(run(&again).status.success());
}

#[test]
fn what_a_command_reads_is_never_replaced() {
    let (scratch, film, out) = begun("read");
    let drive = format!("{out}/drive.wav");
    let words = ["drive.wav", "read"];
    kept(&scratch, &["field", &film, "--drive", &drive, "-o", &out], 2, &words);
    let waveform = format!("62,90,{drive},2");
    kept(&scratch, &["focus", &film, "--waveform", &waveform, "-o", &out], 2, &words);
    let shape = format!("{out}/focus.svg");
    for option in ["--shape", "--path"] {
        let arguments = ["focus", &film, option, &shape, "--speed-mm-s", "100", "-o", &out];
        let less = ["focus", &film, option, &shape, "-o", &out];
        kept(&scratch, if option == "--path" { &arguments } else { &less }, 2, &["focus.svg", "read"]);
    }
    // Through a link, and by another way to the same folder.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&out, scratch.path().join("link")).unwrap();
        let link = scratch.join("link");
        kept(&scratch, &["field", &film, "--drive", &drive, "-o", &link], 2, &words);
        let linked = scratch.join("link/drive.wav");
        kept(&scratch, &["field", &film, "--drive", &linked, "-o", &format!("{out}/")], 2, &words);
    }
}

#[test]
fn a_folder_of_an_earlier_version_is_refused_with_what_to_do() {
    let (scratch, film, out) = begun("older");
    fs::write(
        format!("{out}/.unripple"),
        "Written by unripple. A later run may replace this folder whole.\n",
    )
    .unwrap();
    kept(&scratch, &["focus", &film, "--at", "62,90", "-o", &out], 1, &["earlier version", "delete"]);
}

#[test]
fn files_named_as_outputs_are_not_overwritten() {
    let scratch = Scratch::new("files");
    let film = scratch.file("film.toml", FILM);
    let notes = scratch.file("notes.txt", "an afternoon");
    let play = ["play", film.as_str(), "--seconds", "0.2"];
    let with = |more: &[&'static str], path: &str| -> Vec<String> {
        play.iter().chain(more).map(|word| (*word).to_owned()).chain([path.to_owned()]).collect()
    };
    for (option, path, status) in [
        ("--record", &notes, 1),
        ("--record", &film, 1),
        ("--keep-drive", &notes, 1),
        // The surface is read.
        ("--keep-drive", &film, 2),
    ] {
        let arguments = with(&[option], path);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        kept(&scratch, &arguments, status, &["will not write"]);
    }
    // What people did cannot be computed again; what was driven can.
    let (taps, drive) = (scratch.join("taps.jsonl"), scratch.join("drive.wav"));
    let recorded = with(&["--record"], &taps);
    let recorded: Vec<&str> = recorded.iter().map(String::as_str).collect();
    assert!(run(&recorded).status.success());
    kept(&scratch, &recorded, 1, &["taps.jsonl", "recordings are never overwritten"]);
    kept(&scratch, &["play", &film, "--session", &taps, "--record", &taps], 1, &["taps.jsonl"]);
    let driven = with(&["--keep-drive"], &drive);
    let driven: Vec<&str> = driven.iter().map(String::as_str).collect();
    assert!(run(&driven).status.success());
    let output = run(&driven);
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("replaced the earlier drive"));
    // Nothing is left of a sitting that could not begin.
    let late = scratch.join("late.jsonl");
    let jack = ["play", &film, "--device", "jack", "--jack-server", "nowhere", "--record", &late];
    kept(&scratch, &jack, 1, &["JACK"]);
}

#[test]
fn a_fit_is_not_begun_for_a_place_that_is_taken() {
    let scratch = Scratch::new("fit-place");
    let film = scratch.file("film.toml", FILM);
    let (library, notes) = (scratch.join("lib"), scratch.file("notes.txt", "an afternoon"));
    assert!(
        run(&["respond", &film, "--grid-mm", "40", "--length-ms", "10", "-o", &library]).status.success()
    );
    kept(&scratch, &["fit", &library, "--at", "60,60", "-o", &library], 2, &["read"]);
    kept(&scratch, &["fit", &library, "--at", "60,60", "-o", &notes], 1, &["will not write"]);
    let tape = scratch.join("tape");
    let arguments = ["calibrate", &film, "--at", "60,60", "--device", "tape", "--tape", &tape, "-o", &notes];
    kept(&scratch, &arguments, 1, &["will not write"]);
}

#[test]
fn a_full_disk_leaves_the_earlier_run() {
    let (scratch, film, out) = begun("full");
    let before = all(scratch.path());
    // Files end at 8 blocks of 512 or 1024 bytes, and whoever writes more is told so rather than killed.
    let limited = "trap '' XFSZ; ulimit -f 8; exec \"$@\"";
    let program = env!("CARGO_BIN_EXE_unripple");
    let arguments = ["-c", limited, "sh", program, "focus", &film, "--at", "40,50", "-o", &out];
    let output = std::process::Command::new("sh")
        .args(arguments)
        .env("UNRIPPLE_CONFIG", "")
        .env("UNRIPPLE_CACHE", "")
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert!(errors.contains("cannot write to"), "{errors}");
    assert!(all(scratch.path()) == before);
}

#[test]
fn two_outputs_are_two_files() {
    let scratch = Scratch::new("two-outputs");
    let film = scratch.file("film.toml", FILM);
    let one = scratch.join("one");
    kept(
        &scratch,
        &["play", &film, "--seconds", "0.2", "--record", &one, "--keep-drive", &one],
        2,
        &["--keep-drive"],
    );
}

#[cfg(unix)]
#[test]
fn two_outputs_by_two_ways_to_one_place_are_one() {
    let scratch = Scratch::new("one-place");
    let film = scratch.file("film.toml", FILM);
    let link = scratch.join("link");
    std::os::unix::fs::symlink(scratch.path(), &link).unwrap();
    let direct = scratch.join("a.wav");
    for other in ["./a.wav", "link/a.wav"].map(|name| scratch.join(name)) {
        let arguments = ["play", &film, "--seconds", "0.2", "--record", &other, "--keep-drive", &direct];
        kept(&scratch, &arguments, 2, &["--keep-drive", "found the same"]);
    }
}

/// A sitting that is refused has not begun.
#[test]
fn a_drive_that_cannot_be_kept_is_refused_before_anything_is_made() {
    let scratch = Scratch::new("clocked");
    let film = scratch.file("film.toml", FILM);
    let (taps, drive) = (scratch.join("taps.jsonl"), scratch.join("drive.wav"));
    for clock in [["--real-time"].as_slice(), &["--tuio", "0"], &["--websocket", "0"], &["--device", "jack"]]
    {
        // The window is no number of ms, which is found while drives are prepared.
        let both = ["play", &film, "--record", &taps, "--keep-drive", &drive];
        let late = ["--seconds", "0.2", "--window-ms", "-1"];
        let found = format!("real time ({}", clock[0]);
        kept(&scratch, &[&both[..], clock, &late[..2]].concat(), 2, &["--keep-drive", &found]);
        kept(&scratch, &[&both[..], clock, &late].concat(), 2, &["--keep-drive", &found]);
    }
}

#[cfg(unix)]
#[test]
fn a_place_that_is_taken_is_refused_before_drives_are_prepared() {
    let scratch = Scratch::new("taken");
    let film = scratch.file("film.toml", FILM);
    let notes = scratch.file("notes.txt", "an afternoon");
    let dangling = scratch.join("dangling");
    std::os::unix::fs::symlink(scratch.path().join("nothing"), &dangling).unwrap();
    let folder = scratch.path().display().to_string();
    for (place, word) in [(&notes, "not empty"), (&folder, "a folder"), (&dangling, "a link")] {
        // The window is no number of ms, which is found while drives are prepared.
        let arguments = ["play", film.as_str(), "--window-ms", "-1", "--record", place];
        kept(&scratch, &arguments, 1, &["will not write", word]);
    }
    let nowhere = scratch.join("no/taps.jsonl");
    kept(&scratch, &["play", &film, "--window-ms", "-1", "--record", &nowhere], 1, &["cannot write to"]);
}

#[test]
fn readers_that_go_away_are_no_failure() {
    let scratch = Scratch::new("readers");
    let (film, out) = (scratch.file("film.toml", FILM), scratch.join("out"));
    let closed = "\"$@\" 2>&1 | true; exit 0";
    let program = env!("CARGO_BIN_EXE_unripple");
    let arguments = ["-c", closed, "sh", program, "focus", &film, "--at", "62,90", "-o", &out];
    std::process::Command::new("sh")
        .args(arguments)
        .env("UNRIPPLE_CONFIG", "")
        .env("UNRIPPLE_CACHE", "")
        .status()
        .unwrap();
    assert_eq!(scratch.names(), ["film.toml", "out"]);
    // The status of the program itself, both of whose ends nobody reads.
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = crate::common::program();
    command.args(["focus", &film, "--at", "62,90", "-o", &out]);
    command.stdout(writer.try_clone().unwrap()).stderr(writer);
    assert!(command.status().unwrap().success());
    assert_eq!(scratch.names(), ["film.toml", "out"]);
}
