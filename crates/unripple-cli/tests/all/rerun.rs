//! Runs repeated from their reports: elsewhere, without the surface file, on one thread and on two, equal to the last bit.

use crate::common;

use common::{Scratch, json, refused};
use serde_json::Value;
use std::path::Path;

/// A film whose every command takes about a second.
const FILM: &str = r#"format = 1
name = "film of its own"
[outline]
rectangle_mm = [150, 150]
edge = "supported"
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 60
[drive]
band_hz = [0, 700]
sample_rate_hz = 16000
limit = 0.1
[[actuator]]
name = "a1"
kind = "force"
at_mm = [22, 31]
[[actuator]]
name = "a2"
kind = "force"
at_mm = [127, 26]
[[actuator]]
name = "a3"
kind = "force"
at_mm = [119, 124]
"#;

/// What depends on the clock, or on where results go, and the record itself.
const OTHERWISE: [&str; 12] = [
    "run",
    "plan_s",
    "drive_s",
    "seconds",
    "fit_s",
    "library",
    "output",
    "path",
    "wall_s",
    "block_work_s",
    "computing_s",
    "making_s",
];

/// A report without that, libraries named without the folder that they are in.
fn figures(mut report: Value, folder: &Path) -> Value {
    fn strip(value: &mut Value, folder: &str) {
        match value {
            Value::Object(map) => {
                map.retain(|key, _| !OTHERWISE.contains(&key.as_str()));
                map.values_mut().for_each(|value| strip(value, folder));
            }
            Value::Array(list) => list.iter_mut().for_each(|value| strip(value, folder)),
            Value::String(text) => *text = text.replace(folder, ""),
            _ => {}
        }
    }
    strip(&mut report, &format!("{}/", folder.display()));
    report
}

/// Runs the program in a folder, on so many threads.
fn run_in(folder: &Path, threads: &str, arguments: &[&str]) -> Value {
    let mut command = crate::common::program();
    let output = command
        .args(arguments)
        .arg("--json")
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", threads)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    common::hold(arguments, &report);
    report
}

/// Commands that compute, as typed in a folder with film.toml, tone.wav, mark.svg, drive.wav and the library `lib`; OUT stands for where
/// results go.
const COMMANDS: [&str; 23] = [
    "check film.toml",
    "design film.toml",
    "modes film.toml --max-hz 600 --accuracy 1e-5",
    "modes film.toml --set sheet.tension_n_per_m=150",
    "place film.toml --count 2 --rim-mm 10,25 --keep a2 --mounting-mm 1 --restarts 3 -o OUT",
    "focus film.toml --at 62,90 -o OUT",
    "focus film.toml --at 62,90 --at 40,40,-0.5 --method concentrate --window-ms 25 --on film.toml --judge-hz 900 -o OUT",
    "focus film.toml --at 62,90 --method robust --bear-tension-percent 1 -o OUT",
    "focus film.toml --at 62,90 --finger 100,40 --finger-aware --losses uniform -o OUT",
    "focus film.toml --shape mark.svg --full-limit -o OUT",
    "focus film.toml --at 62,90,1,20 --duration-ms 200 -o OUT",
    "focus lib --at 60,60 --between nearest -o OUT",
    "focus film.toml --waveform 62,90,tone.wav,2 --silent 40,40 -o OUT",
    "focus film.toml --path line:60,75,65,75 --speed-mm-s 100 -o OUT",
    "field film.toml --drive drive.wav --at 62,90 --frames 0 -o OUT",
    "field lib --drive drive.wav",
    "compare film.toml --at 62,90 --window-ms 20 -o OUT",
    "compare film.toml --vary sheet.tension_n_per_m=150,200 --at 62,90 --method one-bit -o OUT",
    "respond film.toml --grid-mm 50 --length-ms 10 -o OUT",
    "calibrate film.toml --device virtual --unknowns 3 --grid-mm 70 -o OUT",
    "fit film.toml --modes 159,252,319 --free tension,modulus -o OUT",
    "export lib -o OUT",
    "play film.toml --fingers 2 --seconds 1 --keep-drive OUT.wav",
];

/// A folder with all that the commands read.
fn bench(scratch: &Scratch) {
    scratch.file("film.toml", FILM);
    let mark = "<svg xmlns='http://www.w3.org/2000/svg' width='150mm' height='150mm' viewBox='0 0 150 150'><path d='M62 62h4v4h-4z'/></svg>";
    scratch.file("mark.svg", mark);
    let made = run_in(scratch.path(), "2", &["focus", "film.toml", "--at", "62,90", "-o", "made"]);
    assert_eq!(made["run"]["surfaces"][0]["asked"], "film.toml");
    for name in ["drive.wav", "tone.wav"] {
        std::fs::copy(scratch.path().join("made/drive.wav"), scratch.path().join(name)).unwrap();
    }
    run_in(
        scratch.path(),
        "2",
        &["respond", "film.toml", "--grid-mm", "30", "--length-ms", "40", "-o", "lib"],
    );
}

/// The bytes of a file, or of all files of a folder by their names; nothing where there is none.
fn written(folder: &Scratch, name: &str) -> Vec<(String, Vec<u8>)> {
    let path = folder.path().join(name);
    let Ok(entries) = std::fs::read_dir(&path) else {
        return std::fs::read(&path).map(|bytes| (String::new(), bytes)).into_iter().collect();
    };
    let file = |entry: std::io::Result<std::fs::DirEntry>| {
        let entry = entry.unwrap();
        (entry.file_name().into_string().unwrap(), std::fs::read(entry.path()).unwrap())
    };
    let mut files: Vec<(String, Vec<u8>)> = entries.map(file).collect();
    files.sort();
    files
}

#[test]
fn runs_are_repeated_to_the_last_bit() {
    let (scratch, elsewhere) = (Scratch::new("rerun"), Scratch::new("rerun-elsewhere"));
    bench(&scratch);
    let reports: Vec<Value> = COMMANDS
        .iter()
        .enumerate()
        .map(|(i, typed)| {
            let typed = typed.replace("OUT", &format!("out{i}"));
            let arguments: Vec<&str> = typed.split(' ').collect();
            run_in(scratch.path(), "2", &arguments)
        })
        .collect();
    std::fs::remove_file(scratch.path().join("film.toml")).unwrap();
    for (i, (typed, report)) in COMMANDS.iter().zip(&reports).enumerate() {
        let file = elsewhere.file(&format!("report{i}.json"), report.to_string());
        for threads in ["1", "2"] {
            let out = format!("out{i}-{threads}");
            let wav = format!("{out}.wav");
            let mut arguments = vec!["rerun", &file];
            let writes = typed.contains("OUT");
            if writes {
                arguments.extend(["-o", if typed.contains("OUT.wav") { &wav } else { &out }]);
            }
            let again = run_in(elsewhere.path(), threads, &arguments);
            assert_eq!(
                figures(again, scratch.path()),
                figures(report.clone(), scratch.path()),
                "{typed} on {threads} threads"
            );
            let results = |folder: &Scratch, out: &str| {
                ["/drive.wav", "/responses", "/surface.toml", ".wav"]
                    .map(|what| written(folder, &format!("{out}{what}")))
            };
            let (before, after) = (results(&scratch, &format!("out{i}")), results(&elsewhere, &out));
            assert!(before == after, "the drive, library or surface of {typed} on {threads} threads");
        }
    }
}

#[test]
fn the_report_in_the_folder_repeats_the_run() {
    let scratch = Scratch::new("rerun-folder");
    let (film, out, again) = (scratch.file("film.toml", FILM), scratch.join("out"), scratch.join("again"));
    json(&["focus", &film, "--at", "62,90", "-o", &out]);
    let report = format!("{out}/report.json");
    let before: Value = serde_json::from_slice(&std::fs::read(&report).unwrap()).unwrap();
    let run = &before["run"];
    assert_eq!((run["command"].as_str(), run["program"].as_str()), (Some("focus"), Some("unripple")));
    let date = run["date"].as_str().unwrap();
    assert!(date.len() == 20 && date.ends_with('Z') && date.as_bytes()[10] == b'T', "{date}");
    assert!(run["ask"]["surface"]["toml"].as_str().unwrap().contains("film of its own"));
    // The figures of what was repeated are those in the folder, and its record names the surface as it was named at first.
    let printed = json(&["rerun", &report, "-o", &again]);
    assert_eq!(figures(printed, scratch.path()), figures(before.clone(), scratch.path()));
    let after: Value =
        serde_json::from_slice(&std::fs::read(format!("{again}/report.json")).unwrap()).unwrap();
    assert_eq!(after["run"]["ask"]["surface"], run["ask"]["surface"]);
    assert!(common::run(&["rerun", &format!("{again}/report.json")]).status.success());
    // So does the report of a program that did not say which schema it holds to.
    let mut older = before.clone();
    assert_eq!(older["run"].as_object_mut().unwrap().remove("schema"), Some("report-1".into()));
    let older = scratch.file("older.json", older.to_string());
    assert!(common::run(&["rerun", &older]).status.success());
}

#[test]
fn what_was_read_and_has_changed_is_refused() {
    let scratch = Scratch::new("rerun-changed");
    bench(&scratch);
    let field = run_in(scratch.path(), "2", &["field", "film.toml", "--drive", "drive.wav"]);
    let focus = run_in(scratch.path(), "2", &["focus", "lib", "--at", "60,60", "-o", "out"]);
    let (field, focus) =
        (scratch.file("field.json", field.to_string()), scratch.file("focus.json", focus.to_string()));
    assert!(common::run(&["rerun", &field]).status.success());
    let mut drive = std::fs::read(scratch.path().join("drive.wav")).unwrap();
    *drive.last_mut().unwrap() ^= 1;
    scratch.file("drive.wav", &drive);
    let why = refused(&["rerun", &field], 2);
    assert!(why.contains("drive.wav: expected the file as the run read it (SHA-256 "), "{why}");
    std::fs::remove_dir_all(scratch.path().join("lib")).unwrap();
    let why = refused(&["rerun", &focus], 2);
    assert!(why.contains("lib: expected the file as the run read it") && why.contains("found none"), "{why}");
    let (none, other) = (scratch.file("none.json", "{}"), scratch.file("text.json", "text"));
    for file in [none, other, scratch.join("nowhere.json")] {
        let why = refused(&["rerun", &file], 2);
        assert!(why.contains(".json: expected a report"), "{why}");
    }
}
