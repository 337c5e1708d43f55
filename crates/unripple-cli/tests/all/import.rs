//! Responses and modes from files of other programs: what was exported comes back, quantities and units of one surface make one library,
//! and what is wrong or not said is named.

use crate::common;

use common::{SMALL_FILM, Scratch, json, number, refused};
use serde_json::Value;
use std::f64::consts::PI;
use std::fmt::Write;

/// Samples per second of the film.
const RATE: f64 = 48e3;

/// A film of two actuators, and a library of 4 points of it, 40 ms long.
fn film(scratch: &Scratch) -> (String, String) {
    let (surface, library) = (scratch.file("film.toml", SMALL_FILM), scratch.join("film"));
    json(&["respond", &surface, "--grid-mm", "50", "--length-ms", "40", "-o", &library]);
    (surface, library)
}

/// The values of a point as they lie in its chunk, before the checksum: actuators x samples.
fn stored(library: &str, point: usize) -> Vec<f64> {
    let bytes = std::fs::read(format!("{library}/responses/c.{point}.0.0")).unwrap();
    let (values, _) = bytes[..bytes.len() - 4].as_chunks::<4>();
    values.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes))).collect()
}

/// Holds that the responses of a point are those of another, within a share of the largest; of the longer ones the end is left out.
fn same(one: &[f64], other: &[f64], share: f64) {
    let samples = (one.len() / 2).min(other.len() / 2);
    let peak = one.iter().fold(0.0_f64, |peak, value| peak.max(value.abs()));
    for (a, b) in one.chunks_exact(one.len() / 2).zip(other.chunks_exact(other.len() / 2)) {
        for (n, (x, y)) in a[..samples].iter().zip(&b[..samples]).enumerate() {
            assert!((x - y).abs() <= share * peak, "sample {n}: {x} and {y}, of {peak}");
        }
    }
}

#[test]
fn what_was_exported_comes_back() {
    let scratch = Scratch::new("import-back");
    let (surface, library) = film(&scratch);
    for (n, name) in ["wav", "film.uff", "film.mat"].into_iter().enumerate() {
        let (file, again) = (scratch.join(name), scratch.join(&format!("again-{n}")));
        json(&["export", &library, "-o", &file]);
        let told = json(&["import", &surface, &file, "-o", &again]);
        assert_eq!((number(&told, "/points"), number(&told, "/actuators")), (4.0, 2.0));
        assert_eq!((told["quantity"].as_str(), told["per"].as_str()), (Some("velocity"), Some("N")));
        assert_eq!(told["band_hz"], serde_json::json!([0.0, 700.0]));
        (0..4).for_each(|point| same(&stored(&library, point), &stored(&again, point), 1e-6));
        // A second run finds all points done; another request makes another library.
        json(&["import", &surface, &file, "-o", &again]);
        let error = refused(&["import", &surface, &file, "--band-hz", "50,600", "-o", &again], 1);
        assert!(error.contains("a library of the same plan"), "{error}");
    }
    // The library stands in for the surface.
    let out = scratch.join("focused");
    let again = scratch.join("again-1");
    let focused = json(&["focus", &again, "--at", "50,50", "--window-ms", "20", "--no-figures", "-o", &out]);
    assert!(number(&focused, "/targets/0/contrast") > 1.0, "{focused}");
}

#[test]
fn modes_from_elsewhere_ring_as_they_did() {
    let scratch = Scratch::new("import-modes");
    let (surface, library) = film(&scratch);
    let (modes, again) = (scratch.join("modes.unv"), scratch.join("again"));
    json(&["export", &library, "--format", "uff-modes", "-o", &modes]);
    let told = json(&["import", &surface, &modes, "--length-ms", "40", "-o", &again]);
    assert_eq!(
        (told["kind"].as_str(), number(&told, "/modes"), number(&told, "/points")),
        (Some("modes"), 22.0, 6.0)
    );
    // With frequencies of six digits, the highest mode is off by less than a thousandth of a turn after 40 ms.
    (0..4).for_each(|point| same(&stored(&library, point), &stored(&again, point), 1e-3));
    // By default until the slowest mode has decayed by 60 dB, in 70 ms times ln 1000.
    let whole = json(&["import", &surface, &modes, "-o", &scratch.join("whole")]);
    assert!((number(&whole, "/samples") / RATE - 0.07 * 1000_f64.ln()).abs() < 1e-3, "{whole}");
}

#[test]
fn modes_in_a_table_are_sums_of_oscillations() {
    let scratch = Scratch::new("import-table");
    let surface = scratch.file("film.toml", SMALL_FILM);
    let text = "node,x_mm,y_mm,first,second\nfrequency_hz,,,200,500\ndamping_ratio,,,0.01,0.02\nmodal_mass_kg,,,0.5,1\n\
        shaker,12,31,1,0.5\n2,121,17,-1,0.25\n3,60,70,2,-1\n";
    let (table, again) = (scratch.file("modes.csv", text), scratch.join("again"));
    json(&["import", &surface, &table, "--length-ms", "40", "-o", &again]);
    let row = stored(&again, 2);
    // φ φ / m · e^{-σt} (cos ω_d t - σ/ω_d sin ω_d t), for each mode.
    let velocity = |hz: f64, ratio: f64, t: f64| {
        let omega = 2.0 * PI * hz;
        let damped = omega * (1.0 - ratio * ratio).sqrt();
        (-ratio * omega * t).exp() * ((damped * t).cos() - ratio * omega / damped * (damped * t).sin())
    };
    for n in [0, 1, 100, 1900] {
        let t = n as f64 / RATE;
        let (first, second) = (velocity(200.0, 0.01, t), velocity(500.0, 0.02, t));
        assert!((row[n] - (4.0 * first - 0.5 * second)).abs() < 1e-5, "{n}");
        assert!((row[1921 + n] - (-4.0 * first - 0.25 * second)).abs() < 1e-5, "{n}");
    }
}

/// Responses of a point in the 1920 samples that are a whole number of periods of 25 Hz, and their lines from 50 to 700 Hz.
struct Point {
    samples: [Vec<f64>; 2],
    lines: [Vec<[f64; 2]>; 2],
}

/// Samples of 40 ms, the first line and the number of lines of 25 Hz.
const SAMPLES: usize = 1920;
const FIRST: usize = 2;
const LINES: usize = 27;

impl Point {
    fn of(library: &str) -> Self {
        let row = stored(library, 0);
        let samples = [0, 1].map(|a| row[a * row.len() / 2..][..SAMPLES].to_vec());
        let line = |values: &[f64], k: usize| {
            let turn = |n: usize| 2.0 * PI * ((k * n) % SAMPLES) as f64 / SAMPLES as f64;
            let sum = |f: fn(f64) -> f64| {
                values.iter().enumerate().map(|(n, v)| v * f(turn(n))).sum::<f64>() / RATE
            };
            [sum(f64::cos), -sum(f64::sin)]
        };
        let lines = [0, 1].map(|a: usize| (FIRST..FIRST + LINES).map(|k| line(&samples[a], k)).collect());
        Self { samples, lines }
    }

    /// A table of the lines, each times (iω)^power times a scale.
    fn in_frequency(&self, power: i32, scale: f64) -> String {
        let mut text = "frequency_hz,a1 50 50.re,a1 50 50.im,a2 50 50.re,a2 50 50.im\n".to_owned();
        for k in 0..LINES {
            let hz = 25.0 * (FIRST + k) as f64;
            write!(text, "{hz}").unwrap();
            for lines in &self.lines {
                let [re, im] = lines[k];
                let omega = 2.0 * PI * hz;
                let [re, im] = match power {
                    1 => [-omega * im, omega * re],
                    -1 => [im / omega, -re / omega],
                    _ => [re, im],
                };
                write!(text, ",{:e},{:e}", scale * re, scale * im).unwrap();
            }
            text.push('\n');
        }
        text
    }

    /// A table of the samples, each times a scale.
    fn in_time(&self, scale: f64) -> String {
        let mut text = "time_s,a1 50 50,a2 50 50\n".to_owned();
        for n in 0..SAMPLES {
            let [a, b] = [0, 1].map(|a: usize| scale * self.samples[a][n]);
            writeln!(text, "{:e},{a:e},{b:e}", n as f64 / RATE).unwrap();
        }
        text
    }
}

#[test]
fn quantities_and_units_of_one_surface_make_one_library() {
    let scratch = Scratch::new("import-units");
    let (surface, library) = film(&scratch);
    let point = Point::of(&library);
    let import = |name: &str, text: String, options: &str| -> (Value, Vec<f64>) {
        let (file, out) = (scratch.file(&format!("{name}.csv"), text), scratch.join(name));
        let pattern = ["--pattern", "{actuator} {x_mm} {y_mm}"];
        let options: Vec<&str> = options.split(' ').collect();
        let told = json(&[&["import", &surface, &file, "-o", &out][..], &pattern[..], &options].concat());
        (told, stored(&out, 0))
    };
    let (told, wanted) = import("velocity", point.in_frequency(0, 1.0), "--unit m/s --per newton");
    assert_eq!(
        (told["band_hz"].clone(), told["integrated_from_hz"].clone()),
        (serde_json::json!([50.0, 700.0]), Value::Null)
    );
    assert!(wanted.len() == 2 * SAMPLES && wanted.iter().any(|v| *v != 0.0));
    for (name, text, options) in [
        ("mm", point.in_frequency(0, 1e3), "--unit mm/s --per newton"),
        ("scaled", point.in_frequency(0, 4.0), "--unit 0.25m/s --per newton"),
        ("displacement", point.in_frequency(-1, 1e6), "--unit um --quantity displacement --per newton"),
        ("acceleration", point.in_frequency(1, 1.0), "--unit m/s2 --per newton"),
        ("gravity", point.in_frequency(1, 1.0 / 9.80665), "--unit g --per newton"),
        ("volt", point.in_frequency(1, 2.0), "--unit m/s^2 --per volt --drive-per-reference 2"),
        ("time", point.in_time(1.0), "--kind impulse-responses --unit m/s --per newton --band-hz 50,700"),
        ("filters", point.in_time(1e3 / RATE), "--kind filters --unit mm/s --per newton --band-hz 50,700"),
    ] {
        let (told, found) = import(name, text, options);
        same(&wanted, &found, 1e-6);
        assert_eq!(
            told["integrated_from_hz"].as_f64(),
            told["quantity"].as_str().filter(|q| *q == "acceleration").map(|_| 50.0)
        );
    }
}

#[test]
fn what_files_do_not_say_is_asked_for_by_option() {
    let scratch = Scratch::new("import-asked");
    let (surface, library) = film(&scratch);
    let text = Point::of(&library).in_time(1.0);
    let (file, out) = (scratch.file("taps.csv", text), scratch.join("out"));
    let pattern = "{actuator} {x_mm} {y_mm}";
    let mut options = vec!["import", surface.as_str(), file.as_str(), "-o", out.as_str()];
    for (more, asked) in [
        (["--pattern", pattern], "--table, --pattern: expected a table or a pattern"),
        (["--kind", "impulse-responses"], "--kind: expected `impulse-responses` or `filters`"),
        (["--unit", "mm/s"], "--unit, --per: expected the unit of what was measured"),
        (["--per", "volt"], "--per: expected the unit of the reference"),
        (["--drive-per-reference", "2"], "--drive-per-reference: expected how many N one V makes"),
    ] {
        let error = refused(&options, 2);
        assert!(error.contains(asked), "{error}: {asked}");
        options.extend(more);
    }
    json(&options);
    let with = |more: &[&str]| {
        refused(&[&options[..3], &["-o", &scratch.join("other")], &options[5..], more].concat(), 2)
    };
    assert!(
        with(&["--quantity", "acceleration"]).contains("--quantity: expected velocity, as its unit says")
    );
    assert!(with(&["--without", "a9"]).contains("--without: expected names among a1, a2, found `a9`"));
    assert!(with(&["--band-hz", "10"]).contains("--band-hz 10: expected LOW,HIGH in Hz"));
    assert!(with(&["--length-ms", "70000"]).contains("--length-ms: expected at most 60 s"));
    assert!(with(&["--offset-mm", "200,0"]).contains("expected a point on the surface"));
}

#[test]
fn a_universal_file_says_what_it_means_or_is_asked() {
    let scratch = Scratch::new("import-uff");
    let (surface, library) = film(&scratch);
    let file = scratch.join("film.uff");
    json(&["export", &library, "-o", &file]);
    let text = std::fs::read_to_string(&file).unwrap();
    let import = |name: &str, text: &str, more: &[&str]| {
        let file = scratch.file(&format!("{name}.uff"), text);
        let out = scratch.join(name);
        (
            file.clone(),
            [&["import", &surface, &file, "-o", &out][..], more]
                .concat()
                .iter()
                .map(|s| (*s).to_owned())
                .collect::<Vec<_>>(),
        )
    };
    let error = |name: &str, text: &str, more: &[&str]| {
        let (_, words) = import(name, text, more);
        refused(&words.iter().map(String::as_str).collect::<Vec<_>>(), 2)
    };
    // Without the name of the unit, that of the file counts: dataset 164.
    let nameless = text.replace("m/s ", "    ");
    let (_, words) = import("nameless", &nameless, &[]);
    json(&words.iter().map(String::as_str).collect::<Vec<_>>());
    same(&stored(&library, 3), &stored(&scratch.join("nameless"), 3), 1e-6);
    // Without it too, places come first.
    let end = text.find("  2411").unwrap() - "    -1\n".len();
    let unitless = &nameless[end..];
    assert!(error("unitless", unitless, &[]).contains("--length-unit: expected the unit of the places"));
    assert!(
        error("placed", unitless, &["--length-unit", "m"])
            .contains("--unit: expected the unit of what was measured")
    );
    assert!(
        error("off", &text, &["--offset-mm", "-60,0"]).contains("dataset 3: expected a point on the surface")
    );
    assert!(error("cut", &text[..text.len() - 100], &[]).contains("dataset 10, line"));
    let nan = text.replacen("E-0", "E-x", 1);
    assert!(error("nan", &nan, &[]).contains("a finite number"));
    let stranger =
        text.replace(" a2 ", " zz ").replace("  1.2100000000000000D-01", "  5.2100000000000000D-02");
    assert!(
        error("stranger", &stranger, &[]).contains("--actuator: expected one of a1, a2 by name or place")
    );
    let (_, mut words) = import("renamed", &stranger, &["--actuator", "a2=zz"]);
    json(&words.iter().map(String::as_str).collect::<Vec<_>>());
    words.insert(3, words[2].clone());
    words[5] = scratch.join("twice");
    let twice = refused(&words.iter().map(String::as_str).collect::<Vec<_>>(), 2);
    assert!(twice.contains("expected one response of") && twice.contains("found another in"), "{twice}");
}

#[test]
fn names_of_files_and_tables_place_wav_files() {
    let scratch = Scratch::new("import-wav");
    let (surface, library) = film(&scratch);
    let row = stored(&library, 0);
    let folder = scratch.join("sweeps");
    std::fs::create_dir(&folder).unwrap();
    for (a, values) in row.chunks_exact(row.len() / 2).enumerate() {
        let name = format!("a{}", a + 1);
        let drive = unripple::core::Drive::new(RATE, vec![name.clone()], vec![values.to_vec()]).unwrap();
        unripple_store::write_wav(format!("{folder}/{name}_50_50.wav"), &drive).unwrap();
    }
    let told = ["--kind", "impulse-responses", "--unit", "m/s", "--per", "newton"];
    let (by_name, by_table) = (scratch.join("by-name"), scratch.join("by-table"));
    json(
        &[
            &["import", &surface, &folder, "-o", &by_name, "--pattern", "{actuator}_{x_mm}_{y_mm}.wav"][..],
            &told[..],
        ]
        .concat(),
    );
    let table =
        scratch.file("places.csv", "file;actuator;x_mm;y_mm\na1_50_50.wav;a1;50;50\na2_50_50.wav;a2;50;50\n");
    json(&[&["import", &surface, &folder, "-o", &by_table, "--table", &table][..], &told[..]].concat());
    for library in [&by_name, &by_table] {
        assert_eq!(stored(library, 0), row);
    }
    // One actuator alone is not all; its absence can be said.
    std::fs::remove_file(format!("{folder}/a2_50_50.wav")).unwrap();
    let out = scratch.join("alone");
    let alone = [&["import", &surface, &folder, "-o", &out, "--table", &table][..], &told[..]].concat();
    assert!(refused(&alone, 2).contains("--without: expected responses to all actuators"));
    let told = json(&[&alone[..], &["--without", "a2"]].concat());
    assert_eq!(told["without"], serde_json::json!(["a2"]));
    assert!(stored(&out, 0)[row.len() / 2..].iter().all(|value| *value == 0.0));
}
