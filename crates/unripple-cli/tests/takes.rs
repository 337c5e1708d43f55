//! Recordings as they come back from a bench: changed, copied, wired otherwise, of other kinds, late, too many and too few.

mod common;
#[path = "common/elsewhere.rs"]
mod elsewhere;

use common::{Scratch, json, number, refused, run};
use elsewhere::{Elsewhere, apart, bring, bring_at, response};
use serde_json::Value;
use std::process::Output;
use unripple::core::Point;
use unripple_store::{Doubt, Library, parse_surface, read_wav};

const SEED: u64 = 5;

/// A small film with five actuators: what is played lasts little.
const FILM: &str = r#"
format = 1
name = "small film"

[outline]
rectangle_mm = [110, 90]
edge = "clamped"

[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 40
air = "none"

[drive]
band_hz = [0, 1500]
sample_rate_hz = 48000
limit = 1.0

[[actuator]]
name = "a1"
at_mm = [12, 31]
kind = "force"

[[actuator]]
name = "a2"
at_mm = [31, 80]
kind = "force"

[[actuator]]
name = "a3"
at_mm = [84, 77]
kind = "force"

[[actuator]]
name = "a4"
at_mm = [98, 29]
kind = "force"

[[actuator]]
name = "a5"
at_mm = [47, 9]
kind = "force"
"#;

const PLACES: [(f64, f64); 3] = [(52.0, 47.0), (70.0, 38.0), (35.0, 55.0)];

/// A bench with its folder, and a surface on it.
struct Bench {
    scratch: Scratch,
    folder: String,
    library: String,
    film: String,
    surface: Elsewhere,
}

impl Bench {
    /// What is to be played is written, for the first so many places.
    fn new(name: &str, places: usize, more: &[&str]) -> Self {
        let scratch = Scratch::new(name);
        let film = scratch.file("film.toml", FILM);
        let (folder, library) = (scratch.join("tape"), scratch.join("film"));
        let planned = run(&Self::command(&film, &folder, &library, places, more)
            .iter()
            .map(String::as_str)
            .collect::<Vec<_>>());
        assert!(planned.status.success(), "{}", String::from_utf8_lossy(&planned.stderr));
        let known = parse_surface(FILM, "film.toml").unwrap();
        let surface = Elsewhere::new(&known, SEED, &format!("{folder}/play.wav"));
        Self { scratch, folder, library, film, surface }
    }

    fn command(film: &str, folder: &str, library: &str, places: usize, more: &[&str]) -> Vec<String> {
        let start = ["calibrate", film, "--device", "tape", "--tape", folder, "-o", library];
        let at = PLACES[..places].iter().map(|(x, y)| format!("--at={x},{y}"));
        let owned = |text: &&str| (*text).to_owned();
        start.iter().map(owned).chain(at).chain(more.iter().map(owned)).collect()
    }

    fn calibrate(&self, places: usize, more: &[&str]) -> (Output, Value, String) {
        let all = [more, &["--json"]].concat();
        let command = Self::command(&self.film, &self.folder, &self.library, places, &all);
        let output = run(&command.iter().map(String::as_str).collect::<Vec<_>>());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let told = serde_json::from_slice(&output.stdout).unwrap_or(Value::Null);
        (output, told, said)
    }

    /// What all channels hear with the probe at a place.
    fn hear(&mut self, place: usize, seed: u64) -> Vec<Vec<f64>> {
        let (x, y) = PLACES[place];
        self.surface.record(Point::from_mm(x, y), 6_000 + 997 * place, seed)
    }

    /// Recordings of the actuators and of the first so many places, as they are.
    fn bring_all(&mut self, places: usize) {
        self.bring_changed(places, |lines| lines);
    }

    fn bring_changed(&mut self, places: usize, change: impl Fn(Vec<Vec<f64>>) -> Vec<Vec<f64>>) {
        let own = self.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1);
        bring(&self.folder, "actuators.wav", &change(own));
        for place in 0..places {
            let heard = self.hear(place, 2 + place as u64);
            bring(&self.folder, &format!("point-{:03}.wav", place + 1), &change(heard));
        }
    }

    fn focus(&self, more: &[&str]) -> Output {
        let out = self.scratch.join("out");
        let start = ["focus", &self.library, "--at", "52,47", "--window-ms", "30", "-o", &out];
        run(&[&start[..], more].concat())
    }
}

#[test]
fn a_take_that_changed_is_measured_again_and_a_copy_is_refused() {
    let mut bench = Bench::new("takes-changed", 2, &[]);
    bench.bring_all(2);
    let (output, told, said) = bench.calibrate(2, &[]);
    assert!(output.status.success() && number(&told, "/measured") == 7.0, "{said}");
    let first = response(&bench.library, 1);

    // The same files again: nothing is done.
    let (output, told, _) = bench.calibrate(2, &[]);
    assert!(output.status.success() && number(&told, "/measured") == 7.0);

    // A copy in place of a take that was good: its point is missing again, and the copy is named.
    let file = |name: &str| format!("{}/{name}", bench.folder);
    std::fs::copy(file("point-001.wav"), file("point-002.wav")).unwrap();
    let (output, told, said) = bench.calibrate(2, &[]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("point-002.wav: has the same samples as point-001.wav"), "{said}");
    assert!(!said.contains("  point-001.wav"), "{said}");
    assert_eq!(number(&told, "/measured"), 6.0);

    // Recorded again, at another place: it is another response.
    let heard = bench.hear(2, 9);
    bench.surface.record(Point::from_mm(35.0, 55.0), 100, 3);
    bring(&bench.folder, "point-002.wav", &heard);
    let (_, told, said) = bench.calibrate(2, &["--no-model"]);
    assert_eq!(number(&told, "/measured"), 7.0, "{said}");
    assert!(apart(&response(&bench.library, 1), &first) > 0.5);
}

#[test]
fn of_two_copies_from_the_beginning_both_are_refused() {
    let mut bench = Bench::new("takes-copied", 2, &[]);
    bench.bring_all(1);
    let file = |name: &str| format!("{}/{name}", bench.folder);
    std::fs::copy(file("point-001.wav"), file("point-002.wav")).unwrap();
    let (output, told, said) = bench.calibrate(2, &[]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("  point-001.wav: has the same samples as point-002.wav"), "{said}");
    assert!(said.contains("  point-002.wav: has the same samples as point-001.wav"), "{said}");
    assert_eq!(number(&told, "/measured"), 5.0, "the actuators' own");
}

#[test]
fn wires_are_tried_on_files_too() {
    let mut bench = Bench::new("takes-wires", 1, &[]);
    type Change = (fn(Vec<Vec<f64>>) -> Vec<Vec<f64>>, [&'static str; 2]);
    let cases: [Change; 3] = [
        (
            |mut lines| {
                lines.swap(2, 5);
                lines
            },
            ["`a3`", "`probe`"],
        ),
        (
            |mut lines| {
                lines.swap(0, 3);
                lines
            },
            ["`a1`", "`a4`"],
        ),
        (
            |mut lines| {
                lines[4].iter_mut().for_each(|x| *x = -*x);
                lines
            },
            ["`a5`", "reversed"],
        ),
    ];
    for (change, named) in cases {
        bench.bring_changed(1, change);
        let (output, _, said) = bench.calibrate(1, &[]);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            said.contains("wiring:") && named.iter().all(|name| said.contains(name)),
            "{named:?}: {said}"
        );
        // Nor without any model.
        let (output, _, said) = bench.calibrate(1, &["--no-model"]);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(named.iter().all(|name| said.contains(name)), "{named:?}: {said}");
    }
    // A reversed one is turned by its scale.
    let (output, told, said) = bench.calibrate(1, &["--input-scale", "a5=-1"]);
    assert!(output.status.success(), "{said}");
    assert_eq!(number(&told, "/measured"), 6.0);
    // Whoever goes on all the same has a library that says so.
    let other = bench.scratch.join("reversed");
    let command = Bench::command(&bench.film, &bench.folder, &other, 1, &["--any-wiring"]);
    let said = run(&command.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(said.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&said.stderr).contains("is doubtful"));
}

#[test]
fn the_others_go_on_without_a_dead_actuator() {
    let mut bench = Bench::new("takes-dead", 2, &[]);
    bench.surface.play[2].fill(0.0);
    // Its coil is broken: it hears nothing either, but for the noise of its input.
    bench.bring_changed(2, |mut lines| {
        let quiet = |i: usize| 1e-7 * (((i * 2_654_435_761) >> 7) % 1000) as f64;
        lines[2].iter_mut().enumerate().for_each(|(i, x)| *x = quiet(i));
        lines
    });
    let (output, told, said) = bench.calibrate(2, &[]);
    assert!(output.status.success(), "{said}");
    assert_eq!(said.matches("actuator `a3` is dead: nobody hears its sweep (output 3)").count(), 1, "{said}");
    assert_eq!((number(&told, "/measured"), &told["bad"]), (6.0, &serde_json::json!([4])));
    assert!(
        told["notes"].as_array().unwrap().iter().any(|note| note.as_str().unwrap().contains("`a3` is dead"))
    );
    assert!(number(&told, "/reciprocity_error") < 0.05);
    assert_eq!(Library::open(&bench.library).unwrap().dead(), [2]);

    let output = bench.focus(&["--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("without a3"), "{said}");
    let drive = read_wav(format!("{}/drive.wav", bench.scratch.join("out"))).unwrap();
    let peak = |line: &Vec<f64>| line.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert_eq!(peak(&drive.channels[2]), 0.0);
    assert!([0, 1, 3, 4].iter().all(|i| peak(&drive.channels[*i]) > 0.1));

    // More than half of them are no dead actuators.
    bench.surface.play[0].fill(0.0);
    bench.surface.play[1].fill(0.0);
    bench.bring_all(1);
    let (output, _, said) = bench.calibrate(2, &[]);
    assert!(output.status.code() == Some(1) && said.contains("nobody hears a1, a2, a3"), "{said}");
}

/// A WAV file of 16 bits, from the format's definition, full scale being `full`.
fn integers(lines: &[Vec<f64>], full: f64) -> Vec<u8> {
    let count = lines.len() as u16;
    let data: Vec<u8> = (0..lines[0].len())
        .flat_map(|i| lines.iter().map(move |line| line[i]))
        .flat_map(|x| ((x / full * 32768.0).round().clamp(-32768.0, 32767.0) as i16).to_le_bytes())
        .collect();
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + data.len() as u32).to_le_bytes());
    bytes.extend(b"WAVEfmt ");
    bytes.extend(16_u32.to_le_bytes());
    bytes.extend(1_u16.to_le_bytes());
    bytes.extend(count.to_le_bytes());
    bytes.extend(48_000_u32.to_le_bytes());
    bytes.extend((48_000 * 2 * u32::from(count)).to_le_bytes());
    bytes.extend((2 * count).to_le_bytes());
    bytes.extend(16_u16.to_le_bytes());
    bytes.extend(b"data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}

#[test]
fn levels_need_a_scale() {
    let mut bench = Bench::new("takes-scale", 2, &[]);
    let own = bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1);
    let most = own.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    // Full scale of the recorder, in m/s.
    let full = 2.0 * most;
    let write = |file: &str, lines: &[Vec<f64>]| {
        std::fs::write(format!("{}/{file}", bench.folder), integers(lines, full)).unwrap();
    };
    write("actuators.wav", &own);
    for place in 0..2 {
        let (x, y) = PLACES[place];
        let heard = bench.surface.record(Point::from_mm(x, y), 6_000, 2 + place as u64);
        write(&format!("point-{:03}.wav", place + 1), &heard);
    }
    let (output, told, said) = bench.calibrate(2, &[]);
    assert!(output.status.success(), "{said}");
    assert!(told["notes"].to_string().contains("level unknown"), "{told}");

    let output = bench.focus(&["--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("--input-scale"), "{said}");
    let focus: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(focus["targets"][0]["peak_velocity_m_s"].is_null(), "{focus}");
    assert!(focus["targets"][0]["peak_displacement_m"].is_null() && focus["felt_outside_db"].is_null());
    assert!(focus["notes"].to_string().contains("level unknown"));
    let text = String::from_utf8(bench.focus(&[]).stdout).unwrap();
    let figures: Vec<&str> = text.lines().filter(|line| !line.starts_with("note")).collect();
    assert!(figures.iter().all(|line| !line.contains("µm") && !line.contains("m/s")), "{text}");
    assert!(text.contains("unknown"), "{text}");
    let output = bench.focus(&["--peak-um", "5"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--peak-um: expected a library whose level"));

    // With both scales it is that of the surface itself.
    let scales = ["--input-scale".to_owned(), full.to_string(), "--output-scale".into(), "1".into()];
    let scales: Vec<&str> = scales.iter().map(String::as_str).collect();
    let (output, told, said) = bench.calibrate(2, &scales);
    assert!(output.status.success() && !told["notes"].to_string().contains("level unknown"), "{said} {told}");
    let direct = bench.scratch.join("direct");
    let seed = SEED.to_string();
    json(&["calibrate", &bench.film, "--unknowns", &seed, "--at=52,47", "--at=70,38", "-o", &direct]);
    for point in 0..7 {
        let error = apart(&response(&bench.library, point), &response(&direct, point));
        assert!(error < 0.02, "point {point}: {error}");
    }
    let output = bench.focus(&["--json"]);
    let focus: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(focus["targets"][0]["peak_velocity_m_s"].is_number());

    // What makes no sense of scales.
    let with = |more: &[&str]| {
        let command = Bench::command(&bench.film, &bench.folder, &bench.library, 2, more);
        refused(&command.iter().map(String::as_str).collect::<Vec<_>>(), 2)
    };
    assert!(with(&["--input-scale", "probe=0"]).contains("a number other than 0"));
    assert!(with(&["--input-scale", "left=1"]).contains("`left`"));
    assert!(with(&["--output-scale", "0.5"]).contains("--level: expected at most 0.500"));
    let told = refused(&["calibrate", &bench.film, "--input-scale", "1", "--at=52,47", "-o", &direct], 2);
    assert!(told.contains("SI units"), "{told}");
}

#[test]
fn other_kinds_of_files_are_read_and_other_rates_when_asked() {
    let mut bench = Bench::new("takes-kinds", 2, &[]);
    bench.bring_all(2);
    let (output, _, said) = bench.calibrate(2, &[]);
    assert!(output.status.success(), "{said}");
    let first = response(&bench.library, 1);

    // At 44.1 kHz, by a resampler of the test's own: each tone of the spectrum where it belongs.
    let at_48 = read_wav(format!("{}/point-002.wav", bench.folder)).unwrap().channels;
    let slow: Vec<Vec<f64>> = at_48.iter().map(|line| interpolated(line, 48.0 / 44.1)).collect();
    bring_at(&bench.folder, "point-002.wav", &slow, 44.1e3);
    let (output, _, said) = bench.calibrate(2, &[]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("point-002.wav: expected 48000 Hz, found 44100 Hz") && said.contains("--resample"),
        "{said}"
    );
    let (output, told, said) = bench.calibrate(2, &["--resample"]);
    assert!(output.status.success() && number(&told, "/measured") == 7.0, "{said}");
    let error = apart(&response(&bench.library, 1), &first);
    assert!(error < 0.01, "{error}");

    // Not a number: told with the channel as it is on the recorder, counted from 1.
    let path = format!("{}/point-001.wav", bench.folder);
    let mut bytes = std::fs::read(&path).unwrap();
    let at = bytes.len() - 4;
    bytes[at..].copy_from_slice(&f32::NAN.to_le_bytes());
    std::fs::write(&path, bytes).unwrap();
    let (output, _, said) = bench.calibrate(2, &["--resample"]);
    assert!(output.status.code() == Some(1) && said.contains("of channel 6"), "{said}");
}

/// A line at other instants, by cubic Hermite interpolation of a line that is oversampled well enough (48 kHz for 1.8 kHz).
fn interpolated(line: &[f64], step: f64) -> Vec<f64> {
    let at = |i: i64| usize::try_from(i).ok().and_then(|i| line.get(i)).copied().unwrap_or(0.0);
    let count = (line.len() as f64 / step) as usize;
    (0..count)
        .map(|i| {
            let t = i as f64 * step;
            let (k, u) = (t.floor() as i64, t.fract());
            // Lagrange's polynomial through six samples.
            (-2..=3)
                .map(|j: i64| {
                    let others = (-2..=3).filter(|m| *m != j);
                    let weight: f64 = others.map(|m| (u - m as f64) / (j - m) as f64).product();
                    weight * at(k + j)
                })
                .sum()
        })
        .collect()
}

#[test]
fn missing_surplus_and_added_takes() {
    let mut bench = Bench::new("takes-count", 2, &["--repeats", "2"]);
    bench.bring_all(2);
    let twice = ["--repeats", "2"];
    let again = bench.hear(0, 71);
    bring(&bench.folder, "point-001-2.wav", &again);
    bring(&bench.folder, "point-009.wav", &again[..2]);
    let (output, told, said) = bench.calibrate(2, &twice);
    assert!(output.status.success(), "{said}");
    assert_eq!(number(&told, "/measured"), 7.0, "what is there is kept: {said}");
    assert_eq!(told["tape"]["missing"], serde_json::json!(["actuators-2.wav", "point-002-2.wav"]));
    assert_eq!(told["tape"]["surplus"], serde_json::json!(["point-009.wav"]));
    assert!(said.contains("point-009.wav"), "{said}");

    // A repeat that is bad is named by its own name.
    let mut noisy = again.clone();
    let mut state = 1_u64;
    let peak = noisy[5].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    noisy[5].iter_mut().for_each(|x| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += peak * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0);
    });
    bring(&bench.folder, "point-001-2.wav", &noisy);
    let (output, _, said) = bench.calibrate(2, &twice);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("  point-001-2.wav: ") && !said.contains("  point-001.wav: "), "{said}");
    bring(&bench.folder, "point-001-2.wav", &again);
    assert!(bench.calibrate(2, &twice).0.status.success());

    // A point more: the plan grows, and what is measured stays.
    let before = response(&bench.library, 0);
    let own = response(&bench.library, 2);
    let (output, told, said) = bench.calibrate(3, &twice);
    assert!(output.status.success(), "{said}");
    assert_eq!((number(&told, "/points"), number(&told, "/measured")), (8.0, 7.0));
    assert!(told["tape"]["missing"].to_string().contains("point-003.wav"));
    assert_eq!(response(&bench.library, 0), before);
    assert_eq!(response(&bench.library, 3), own, "the actuators' own come last");
    let heard = bench.hear(2, 5);
    bring(&bench.folder, "point-003.wav", &heard);
    let (output, told, said) = bench.calibrate(3, &twice);
    assert!(output.status.success() && number(&told, "/measured") == 8.0, "{said}");

    // A plan that differs is told by what differs, whole.
    let (output, _, said) = bench.calibrate(2, &twice);
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("point-003.wav at (35.0000, 55.0000) mm there, not asked for"), "{said}");
    let (output, _, said) = bench.calibrate(3, &["--repeats", "2", "--sweep-ms", "400"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        said.contains("`sweep_s`: 0.5 there, 0.4 asked for") && said.contains("`sweeps_begin_s`: ["),
        "{said}"
    );
    assert!(!said.contains("..."), "{said}");
}

#[test]
fn a_reference_may_hear_one_output_alone() {
    let inputs = ["--tape-inputs", "a1,a2,a3,a4,a5,probe,reference"];
    for output in [0, 3] {
        let mut bench = Bench::new("takes-reference", 1, &inputs);
        let play = bench.surface.play.clone();
        let with = |mut lines: Vec<Vec<f64>>, early: usize| {
            let reference = (0..lines[0].len())
                .map(|i| i.checked_sub(early).and_then(|i| play[output].get(i)).map_or(0.0, |x| 0.3 * x));
            let reference = reference.collect();
            lines.push(reference);
            lines
        };
        let own = with(bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1), 9_000);
        bring(&bench.folder, "actuators.wav", &own);
        let heard = with(bench.hear(0, 2), 6_000);
        bring(&bench.folder, "point-001.wav", &heard);
        let (done, told, said) = bench.calibrate(1, &inputs);
        assert!(done.status.success() && number(&told, "/measured") == 6.0, "output {output}: {said}");
        let direct = bench.scratch.join("direct");
        let seed = SEED.to_string();
        json(&["calibrate", &bench.film, "--unknowns", &seed, "--at=52,47", "-o", &direct]);
        let error = apart(&response(&bench.library, 0), &response(&direct, 0));
        assert!(error < 0.02, "output {output}: {error}");
    }
}

#[test]
fn doubts_are_told_by_every_command() {
    let mut bench = Bench::new("takes-doubts", 1, &[]);
    // Sensors that hear others as well contradict reciprocity, and no exchange of wires mends it.
    bench.bring_changed(1, |mut lines| {
        for (one, other) in [(1, 3), (0, 2)] {
            let other = lines[other].clone();
            lines[one].iter_mut().zip(other).for_each(|(x, y)| *x += 0.8 * y);
        }
        lines
    });
    let (output, told, said) = bench.calibrate(1, &["--no-model"]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("is doubtful") && said.contains("both ways"), "{said}");
    assert!(told["doubtful"].to_string().contains("both ways"), "{told}");
    assert!(number(&told, "/reciprocity_error") > 0.15);
    assert!(told["notes"].to_string().contains("--no-model"), "{told}");

    let output = bench.focus(&["--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && said.contains("doubtful: what actuators hear of each other"),
        "{said}"
    );
    let focus: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(focus["notes"].to_string().contains("both ways"), "{focus}");
    let drive = format!("{}/drive.wav", bench.scratch.join("out"));
    let wav = bench.scratch.join("wav");
    let others = [
        vec!["field", &bench.library, "--drive", &drive, "--at", "52,47"],
        vec!["export", &bench.library, "-o", &wav],
        vec!["play", &bench.library, "--seconds", "0.1"],
    ];
    for command in others {
        let output = run(&[&command[..], &["--json"]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.contains("doubtful: what actuators"), "{command:?}: {said}");
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(told["notes"].to_string().contains("both ways"), "{command:?}: {told}");
    }

    // The log of the measurement is in the library.
    let library = Library::open(&bench.library).unwrap();
    let last = library.logged("runs").unwrap().as_array().unwrap().last().unwrap();
    assert!(last["software"].as_str().unwrap().starts_with("unripple ") && last["device"] == "tape");
    assert!(library.logged("takes").unwrap()["actuators.wav"]["hash"].is_string());
    drop(library);

    // Good recordings make it good again.
    bench.bring_all(1);
    let (output, told, said) = bench.calibrate(1, &[]);
    assert!(output.status.success() && told["doubtful"].as_array().unwrap().is_empty(), "{said}");
    // What is doubted elsewhere is told as well.
    let mut library = Library::open(&bench.library).unwrap();
    library.set_doubts("fit", vec![Doubt::of("fit", "the model contradicts itself")]).unwrap();
    drop(library);
    let said = bench.focus(&[]).stderr;
    assert!(String::from_utf8_lossy(&said).contains("the model contradicts itself"));
}

#[test]
fn levels_are_looked_at_before_the_long_run() {
    let mut bench = Bench::new("takes-levels", 1, &[]);
    let (output, _, said) = bench.calibrate(1, &["--check-levels"]);
    assert!(output.status.code() == Some(1) && said.contains("found none"), "{said}");
    let mut own = bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1);
    let scaled = |line: &mut Vec<f64>, to: f64| {
        let peak = line.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        line.iter_mut().for_each(|x| *x *= to / peak);
    };
    own.iter_mut().for_each(|line| scaled(line, 0.5));
    scaled(&mut own[1], 0.001);
    scaled(&mut own[2], 0.99);
    scaled(&mut own[3], 1.6);
    own[3].iter_mut().for_each(|x| *x = x.clamp(-1.0, 1.0));
    bring(&bench.folder, "actuators.wav", &own);
    let (output, told, said) = bench.calibrate(1, &["--check-levels"]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    let advice: Vec<&str> = told["advice"].as_array().unwrap().iter().map(|a| a.as_str().unwrap()).collect();
    assert_eq!(advice.len(), 3, "{advice:?}");
    assert!(advice[0].contains("channel 2 (`a2`): quiet: turn its gain up by 53 dB"), "{advice:?}");
    assert!(advice[1].contains("channel 3 (`a3`): nearly clipped: turn its gain down by 6 dB"), "{advice:?}");
    assert!(advice[2].contains("channel 4 (`a4`): clipped"), "{advice:?}");

    // Through a device all sweeps are played once; nothing is kept.
    let library = bench.scratch.join("levels");
    let told =
        json(&["calibrate", &bench.film, "--unknowns", "3", "--check-levels", "--at=52,47", "-o", &library]);
    assert_eq!(told["levels"].as_array().unwrap().len(), 6);
    assert!(number(&told, "/levels/5/signal_to_noise_db") > 20.0);
    assert!(!std::path::Path::new(&library).exists());
    let told = json(&[
        "calibrate",
        &bench.film,
        "--unknowns",
        "3",
        "--snr-db",
        "25",
        "--check-levels",
        "--at=52,47",
        "-o",
        &library,
    ]);
    assert!(told["advice"].to_string().contains("--repeats"), "{told}");
}
