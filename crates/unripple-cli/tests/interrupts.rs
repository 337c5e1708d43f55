//! Ctrl+C at any moment of any command: nothing is left that nobody asked for, nothing of anybody's is touched.
//!
//! `UNRIPPLE_INTERRUPTS` sets how often each command is interrupted, `UNRIPPLE_SEED` the moments.
#![cfg(unix)]

mod common;

use common::dice::{Dice, number};
use common::{SMALL_FILM, Scratch, run};
use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use unripple_store::{Library, PointState, load_surface, to_toml};

/// A command that takes longer is interrupted before this, in ms.
const LONGEST: u64 = 2500;

/// A command, and what may be new in the folder after it was interrupted.
struct Case {
    arguments: &'static str,
    leaves: &'static [&'static str],
}

const CASES: [Case; 19] = [
    Case { arguments: "design film.toml", leaves: &[] },
    Case { arguments: "modes film.toml --max-hz 1400", leaves: &[] },
    Case { arguments: "check film.toml", leaves: &[] },
    Case { arguments: "devices", leaves: &[] },
    Case { arguments: "doctor film.toml --tuio 0", leaves: &[] },
    Case { arguments: "focus film.toml --at 62,90 -o out", leaves: &[] },
    Case { arguments: "focus film.toml --waveform 62,90,burst:300,5 -o made/here/out", leaves: &["made"] },
    Case { arguments: "compare hudin-2012 --at 62,90 -o out", leaves: &[] },
    Case { arguments: "place hudin-2012 --rim-mm 6,12 -o out", leaves: &[] },
    Case { arguments: "field film.toml --drive drive.wav --frames 10 -o out", leaves: &[] },
    Case { arguments: "export lib -o out", leaves: &[] },
    Case { arguments: "export lib -o lib.sofa", leaves: &["lib.sofa"] },
    Case { arguments: "reproduce -o out", leaves: &[] },
    Case { arguments: "respond film.toml --grid-mm 6 --length-ms 40 -o new-lib", leaves: &["new-lib"] },
    Case { arguments: "calibrate film.toml --grid-mm 50 --sweep-ms 100 -o new-lib", leaves: &["new-lib"] },
    Case {
        arguments: "calibrate film.toml --at 60,60 --device tape --tape takes -o new-lib",
        leaves: &["takes", "new-lib"],
    },
    Case { arguments: "fit measured --at 60,60 -o fitted", leaves: &["fitted"] },
    Case {
        arguments: "play film.toml --seconds 20 --record taps.jsonl --keep-drive kept.wav",
        leaves: &["taps.jsonl", "kept.wav"],
    },
    Case { arguments: "view film.toml --port 0 --no-browser --seconds 5", leaves: &[] },
];

impl Case {
    /// Whether a signal ends it by its default, rather than being a wish that the command answers.
    fn is_cut_short(&self) -> bool {
        !["play ", "view "].iter().any(|command| self.arguments.starts_with(command))
    }
}

/// Every file below a folder, and what is in it; folders end in a slash.
fn all(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.file_type().unwrap().is_dir() {
            found.insert(format!("{name}/"), Vec::new());
            found.extend(
                all(&entry.path()).into_iter().map(|(below, text)| (format!("{name}/{below}"), text)),
            );
        } else {
            found.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    found
}

/// A folder with things of the user's and of earlier runs.
fn folder() -> Scratch {
    let scratch = Scratch::new("interrupts");
    let film = scratch.file("film.toml", SMALL_FILM);
    scratch.file("notes.txt", "an afternoon");
    // One whose actuators hear each other well, for a fit.
    let mut surface = load_surface("hudin-2012").unwrap();
    surface.emission.band[1] = 1000.0;
    let paper = scratch.file("paper.toml", to_toml(&surface));
    let [out, library, measured] = ["out", "lib", "measured"].map(|name| scratch.join(name));
    for arguments in [
        vec!["focus", film.as_str(), "--at", "40,50", "-o", &out],
        vec!["respond", &film, "--grid-mm", "20", "--length-ms", "20", "-o", &library],
        vec!["calibrate", &paper, "-o", &measured],
    ] {
        let output = run(&arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    fs::copy(scratch.path().join("out/drive.wav"), scratch.path().join("drive.wav")).unwrap();
    scratch
}

/// Runs a command in a folder and sends it a signal after a while, unless it has ended by then.
fn interrupted(folder: &Path, arguments: &str, signal: &str, after: Duration) -> Output {
    let mut command = common::program();
    command.args(arguments.split(' ')).current_dir(folder);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let (mut child, began) = (command.spawn().unwrap(), Instant::now());
    while child.try_wait().unwrap().is_none() {
        if began.elapsed() >= after {
            send(signal, child.id());
            break;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.wait_with_output().unwrap()
}

/// One that has ended cannot be sent any signal.
fn send(signal: &str, process: u32) {
    let _ = Command::new("kill").args([signal, &process.to_string()]).stderr(Stdio::null()).status();
}

/// Whether a folder is one whole run: all that its hidden file lists is there, of that length.
fn is_whole(files: &BTreeMap<String, Vec<u8>>, place: &str) -> bool {
    let Some(list) = files.get(&format!("{place}/.unripple")) else { return false };
    let text = String::from_utf8_lossy(list);
    let mut lines = text.lines().skip(2).map(|line| line.splitn(3, ' ').collect::<Vec<_>>()).peekable();
    let there = |words: &Vec<&str>| {
        files.get(&format!("{place}/{}", words[2])).map(Vec::len) == words[0].parse().ok()
    };
    lines.peek().is_some() && lines.all(|words| there(&words))
}

/// What is wrong with what is there now.
fn faults(case: &Case, before: &BTreeMap<String, Vec<u8>>, after: &BTreeMap<String, Vec<u8>>) -> Vec<String> {
    let mut faults = Vec::new();
    let is_out = |name: &str| name.starts_with("out/");
    for (name, bytes) in before.iter().filter(|(name, _)| !is_out(name)) {
        if after.get(name) != Some(bytes) {
            faults.push(format!("{name} was touched"));
        }
    }
    let same =
        before.iter().filter(|(name, _)| is_out(name)).eq(after.iter().filter(|(name, _)| is_out(name)));
    if !(same || is_whole(after, "out")) {
        faults.push("out is neither the old one nor a new one".into());
    }
    for name in after.keys().filter(|name| !before.contains_key(*name) && !is_out(name)) {
        let top = name.split('/').next().unwrap_or_default();
        if !case.leaves.contains(&top) || name.contains(".unripple-") || name.ends_with(".part") {
            faults.push(format!("{name} was left"));
        }
    }
    if after.contains_key("made/") && !is_whole(after, "made/here/out") {
        faults.push("made is not whole".into());
    }
    if let Some(wav) = after.get("kept.wav") {
        let counted = wav.get(4..8).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap()));
        if counted != Some(wav.len() as u32 - 8) {
            faults.push("kept.wav is not closed".into());
        }
    }
    if let Some(taps) = after.get("taps.jsonl") {
        let lines = taps.split_inclusive(|byte| *byte == b'\n');
        let whole =
            |line: &[u8]| line.ends_with(b"\n") && serde_json::from_slice::<serde_json::Value>(line).is_ok();
        if taps.is_empty() || !lines.into_iter().all(whole) {
            faults.push("taps.jsonl is not whole".into());
        }
    }
    faults
}

/// Takes away what an interrupted command was allowed to leave.
fn tidy(folder: &Path, leaves: &[&str]) {
    for place in leaves.iter().map(|name| folder.join(name)) {
        let _ = if place.is_dir() { fs::remove_dir_all(place) } else { fs::remove_file(place) };
    }
}

#[test]
fn nothing_is_left_of_what_was_interrupted() {
    let (rounds, seed) = (number("UNRIPPLE_INTERRUPTS", 4), number("UNRIPPLE_SEED", 1));
    println!("seed {seed}, {rounds} rounds");
    let mut dice = Dice(seed);
    let scratch = folder();
    let (mut wrong, signals) = (Vec::new(), ["-INT", "-TERM", "-INT", "-HUP"]);
    let mut cut_short = 0;
    for case in &CASES {
        let began = Instant::now();
        let untouched = all(scratch.path());
        let first = interrupted(scratch.path(), case.arguments, "-INT", Duration::from_millis(LONGEST));
        let lasts = began.elapsed().as_millis().min(u128::from(LONGEST)) as u64;
        let mut before = all(scratch.path());
        wrong.extend(
            faults(case, &untouched, &before).into_iter().map(|fault| format!("{}: {fault}", case.arguments)),
        );
        let mut ended = [0; 2];
        ended[usize::from(first.status.signal().is_some())] += 1;
        for round in 0..rounds {
            if case.leaves != ["new-lib"] || round % 3 == 0 {
                tidy(scratch.path(), case.leaves);
                before.retain(|name, _| !case.leaves.contains(&name.split('/').next().unwrap_or_default()));
            }
            let after = Duration::from_millis(dice.below(lasts + lasts / 8));
            let signal = signals[(round % 4) as usize];
            let output = interrupted(scratch.path(), case.arguments, signal, after);
            ended[usize::from(output.status.signal().is_some())] += 1;
            let now = all(scratch.path());
            // What was begun is taken up: only what was there before all is to stay as it was.
            before.retain(|name, _| !case.leaves.contains(&name.split('/').next().unwrap_or_default()));
            let said = String::from_utf8_lossy(&output.stderr);
            if !(output.status.success() || output.status.signal().is_some()) {
                wrong.push(format!("{} {signal} after {after:?}: {} {said}", case.arguments, output.status));
            }
            let faults = faults(case, &before, &now);
            wrong.extend(faults.iter().map(|f| format!("{} {signal} after {after:?}: {f}", case.arguments)));
            before = now;
        }
        println!(
            "{:74} {lasts:5} ms {:3} ended by the signal {:3} by themselves",
            case.arguments, ended[1], ended[0]
        );
        cut_short += ended[1];
        if lasts == LONGEST && case.is_cut_short() && ended[1] == 0 {
            wrong.push(format!("{}: no signal ended it, of {rounds} and one", case.arguments));
        }
        if case.leaves == ["new-lib"] {
            taken_up(&scratch, case.arguments);
        }
        tidy(scratch.path(), case.leaves);
    }
    assert!(cut_short > 0, "no signal ended any command");
    assert!(wrong.is_empty(), "{}\n{:?}", wrong.join("\n"), scratch.names());
}

/// A library that was being filled is filled by the same command, and is a whole one then.
fn taken_up(scratch: &Scratch, arguments: &str) {
    let output = common::program().args(arguments.split(' ')).current_dir(scratch.path()).output().unwrap();
    assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
    let library = Library::open(scratch.path().join("new-lib")).unwrap();
    assert_eq!(library.verify(), []);
    assert!(library.in_state(PointState::Missing).is_empty());
}

/// A standard output that takes nothing: what is given to a program, and what keeps it open.
fn blocked() -> (Stdio, UnixStream) {
    let (mut to, from) = UnixStream::pair().unwrap();
    to.set_nonblocking(true).unwrap();
    for size in [4096, 1] {
        while to.write(&vec![b' '; size]).is_ok() {}
    }
    to.set_nonblocking(false).unwrap();
    (OwnedFd::from(to).into(), from)
}

/// Waits for something that has to come. What does not come in this time never will, and whoever waits fails by what is not there.
fn wait_for(mut come: impl FnMut() -> bool) {
    let began = Instant::now();
    while !come() && began.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A sitting that was asked to end waits for somebody to take its summary; whoever asks again does not wait.
#[test]
fn a_second_ctrl_c_does_not_wait() {
    let scratch = Scratch::new("second");
    let film = scratch.file("film.toml", SMALL_FILM);
    let [taps, kept] = ["taps.jsonl", "kept.wav"].map(|name| scratch.join(name));
    let (full, _nobody) = blocked();
    let mut command = common::program();
    command.args(["play", &film, "--record", &taps, "--keep-drive", &kept]);
    let mut child = command.stdout(full).stderr(Stdio::piped()).spawn().unwrap();
    let mut told = BufReader::new(child.stderr.take().unwrap()).lines().map_while(Result::ok);
    let began = told.any(|line| line.contains("finger 1 at"));
    // Nor does it wait for whoever reads of its fingers.
    let reader = std::thread::spawn(move || told.count());
    send("-INT", child.id());
    // The drive is kept when the sitting is over: the first wish was heard.
    wait_for(|| Path::new(&kept).exists());
    let waits = child.try_wait().unwrap().is_none();
    send("-INT", child.id());
    wait_for(|| child.try_wait().unwrap().is_some());
    let _ = child.kill();
    let status = child.wait().unwrap();
    reader.join().unwrap();
    assert!(began && waits, "{began} {waits} {status}");
    assert_eq!(status.signal(), Some(2), "{status}");
    assert_eq!(scratch.names(), ["film.toml", "kept.wav", "taps.jsonl"]);
    let case = Case { arguments: "", leaves: &["film.toml", "kept.wav", "taps.jsonl"] };
    assert_eq!(faults(&case, &BTreeMap::new(), &all(scratch.path())), Vec::<String>::new());
}

/// Nobody can tidy up after SIGKILL but the next run.
#[test]
fn killed_runs_lose_nothing_and_the_next_one_tidies_up() {
    let (rounds, seed) = (number("UNRIPPLE_INTERRUPTS", 4), number("UNRIPPLE_SEED", 1));
    println!("seed {seed}, {rounds} rounds");
    let mut dice = Dice(seed);
    let scratch = Scratch::new("killed");
    let film = scratch.file("film.toml", SMALL_FILM);
    let library = scratch.join("lib");
    assert!(
        run(&["respond", &film, "--grid-mm", "20", "--length-ms", "20", "-o", &library]).status.success()
    );
    let export = "export lib -o out";
    let began = Instant::now();
    assert!(interrupted(scratch.path(), export, "-KILL", Duration::from_secs(60)).status.success());
    let lasts = began.elapsed().as_micros() as u64;
    let (exported, mut left) = (all(scratch.path()), 0);
    for round in 0..5 * rounds {
        let after = Duration::from_micros(dice.below(lasts + lasts / 4));
        interrupted(scratch.path(), export, "-KILL", after);
        let now = all(scratch.path());
        left += usize::from(now != exported);
        let out = |files: &BTreeMap<String, Vec<u8>>| {
            files
                .iter()
                .filter(|(name, _)| name.starts_with("out/"))
                .map(|(n, b)| (n.clone(), b.clone()))
                .collect::<Vec<_>>()
        };
        assert!(out(&now) == out(&exported), "round {round} after {after:?}");
    }
    println!("{left} of {} killed runs left something", 5 * rounds);
    assert!(interrupted(scratch.path(), export, "-KILL", Duration::from_secs(60)).status.success());
    assert!(all(scratch.path()) == exported, "{:?}", scratch.names());
}
