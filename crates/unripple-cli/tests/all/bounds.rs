//! Numbers that ask for more memory or time than there is: refused at once, with the bound, and nothing is written.

use crate::common;

use common::{Scratch, refused, run};
use std::time::{Duration, Instant};

/// Longest that a refusal may take: as long as the modes of a film on a busy machine.
const AT_ONCE: Duration = Duration::from_secs(60);

/// The words of a command line: `FILM` is a film with few modes in its band, and `@name` a path in a folder.
fn words(line: &str, scratch: &Scratch) -> Vec<String> {
    let word = |word: &str| match (word, word.strip_prefix('@')) {
        ("FILM", _) => ["hudin-2012", "--set", "drive.band_hz=[0, 1000]"].map(str::to_owned).to_vec(),
        (_, Some(name)) => vec![scratch.join(name)],
        _ => vec![word.to_owned()],
    };
    line.split(' ').flat_map(word).collect()
}

/// Refuses a command line within a short time, and leaves the folder as it was.
fn beyond(scratch: &Scratch, line: &str, expected: &str) {
    let (words, before, begun) = (words(line, scratch), scratch.names(), Instant::now());
    let errors = refused(&words.iter().map(String::as_str).collect::<Vec<_>>(), 2);
    assert!(errors.contains(expected), "{line}: {expected:?} in {errors}");
    assert!(begun.elapsed() < AT_ONCE, "{line}: {:?}", begun.elapsed());
    assert_eq!(scratch.names(), before, "{line}");
}

#[test]
fn numbers_beyond_all_memory_are_refused_at_once() {
    let scratch = Scratch::new("bounds");
    let short = "top frequency in Hz: expected a frequency whose waves are longer than 7 nm, found 1";
    for (line, expected) in [
        (
            "focus FILM --path line:60,75,80,75 --speed-mm-s 1e-9 -o @out",
            "--speed-mm-s: speed of a stroke (m/s): expected at least 5.78e-5, for a stroke of at most 350 s, found",
        ),
        (
            "focus hudin-2012 --at 62,90 --method concentrate --window-ms 60000 -o @out",
            "samples of the window times modes: expected at most 268435456, found",
        ),
        (
            "focus FILM --at 62,90 --judge-hz 1e100 -o @out",
            "--judge-hz: expected at least 1000 Hz, the top of the band, and less than",
        ),
        (
            "focus FILM --at 62,90 --listen-m 1000 -o @out",
            "--listen-m: expected a height from 0.05 to 100 m, found 1000",
        ),
        ("modes hudin-2012 --max-hz 1e100", short),
        ("respond FILM --grid-mm 30 --length-ms 1e300 -o @out", "--length-ms: expected at most 60 s, found"),
        (
            "respond FILM --grid-mm 30 --length-ms 60500 -o @out",
            "--length-ms: expected at most 60 s, found 60.5 s",
        ),
        (
            "calibrate FILM --at 62,90 --repeats 1000000000 -o @out",
            "--repeats: expected 1 to 99, found 1000000000",
        ),
        (
            "calibrate FILM --at 62,90 --response-ms 1e300 -o @out",
            "--response-ms: expected at most 60 s, found",
        ),
        (
            "calibrate FILM --device tape --tape @tape --grid-mm 0.3 -o @out",
            "--tape: expected at most 100000 recordings, found",
        ),
        ("place FILM --count 1000000000 -o @out", "--count: expected 1 to 1000, found 1000000000"),
        (
            "place FILM --grid-mm 0.001 -o @out",
            "cells of the grid of places: expected at most 4000000, found",
        ),
        (
            "reproduce --placements 1000000000 -o @out",
            "--placements: expected at most 10000, found 1000000000",
        ),
        ("play FILM --window-ms 100000 --seconds 1", "--window-ms: expected at most 10 s, found 100"),
    ] {
        beyond(&scratch, line, expected);
    }
    assert!(scratch.names().is_empty());
}

#[test]
fn evaluations_beyond_all_memory_are_refused_at_once() {
    let scratch = Scratch::new("bounds-field");
    let made = words("focus FILM --at 62,90 --window-ms 30 --no-figures -o @focused", &scratch);
    let output = run(&made.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let field = "field FILM --drive @focused/drive.wav --at 62,90";
    let places = format!("--at-ms 200000{}", " --at 62,90".repeat(49));
    for (options, expected) in [
        ("--frames 1000000000 -o @out", "--frames: expected at most 5000, found 1000000000"),
        (
            "--movie-ms 0,1e12 -o @out",
            "--movie-ms: expected an end after 417 s at the latest, found 1000000000 s",
        ),
        (places.as_str(), "values of the traces: expected at most 100000000, found"),
    ] {
        beyond(&scratch, &format!("{field} {options}"), expected);
    }
    assert_eq!(scratch.names(), ["focused"]);
}
