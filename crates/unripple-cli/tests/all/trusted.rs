//! Recordings that say less than they seem to: wires, dead actuators, levels without a scale, and what is doubted.

use crate::bench;
use crate::common;
use crate::elsewhere;

use bench::{Bench, FILM, PLACES, SEED};
use common::{Scratch, json, number, refused, run};
use elsewhere::{Elsewhere, apart, bring, response};
use serde_json::Value;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;
use unripple::core::Point;
use unripple_store::{Library, parse_surface, read_wav};

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
    assert_eq!(
        said.matches("actuator `a3` is dead: no sensor receives its sweep (output 3)").count(),
        1,
        "{said}"
    );
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

    // The rest tell of tension all the same.
    let tighter = FILM.replace("tension_n_per_m = 200", "tension_n_per_m = 200.8");
    let known = parse_surface(&tighter, "film.toml").unwrap();
    let mut warm = Elsewhere::new(&known, SEED, &format!("{}/play.wav", bench.folder));
    warm.play[2].fill(0.0);
    let (x, y) = PLACES[1];
    bring(&bench.folder, "point-002.wav", &warm.record(Point::from_mm(x, y), 7_000, 21));
    let (output, told, said) = bench.calibrate(2, &[]);
    assert!(output.status.success(), "{said}");
    assert!(told["notes"].to_string().contains("tension differed by +0."), "{told}");

    // More than half of them are no dead actuators.
    bench.surface.play[0].fill(0.0);
    bench.surface.play[1].fill(0.0);
    bench.bring_all(1);
    let (output, _, said) = bench.calibrate(2, &[]);
    assert!(output.status.code() == Some(1) && said.contains("no sensor receives a1, a2, a3"), "{said}");
}

/// Most of it comes before it should: it was not begun late all the same.
#[test]
fn a_recording_that_lost_many_samples_is_not_said_to_begin_late() {
    let mut bench = Bench::new("takes-lost", 1, &[]);
    bench.bring_all(1);
    let mut heard = bench.surface.record(Point::from_mm(52.0, 47.0), 300, 9);
    for line in &mut heard {
        line.drain(30_000..34_800);
    }
    bring(&bench.folder, "point-001.wav", &heard);
    let (output, _, said) = bench.calibrate(1, &[]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("point-001.wav") && said.contains("4800 lost between"), "{said}");
    // One that was is.
    let mut heard = bench.surface.record(Point::from_mm(52.0, 47.0), 300, 10);
    for line in &mut heard {
        line.drain(..6_000);
    }
    bring(&bench.folder, "point-001.wav", &heard);
    let (_, _, said) = bench.calibrate(1, &[]);
    assert!(said.contains("begins before play.wav"), "{said}");
}

#[test]
fn an_actuator_is_left_out_when_asked() {
    let scratch = Scratch::new("trusted-without");
    let (film, library) = (scratch.file("film.toml", FILM), scratch.join("film"));
    let start = ["calibrate", &film, "--unknowns", "5", "--at=52,47", "-o", &library];
    let with = |more: &'static str| [&start[..], &["--without", more]].concat();
    assert!(refused(&with("a9"), 2).contains("expected one of a1, a2, a3, a4, a5"));
    json(&with("a3"));
    let made = Library::open(&library).unwrap();
    assert_eq!(made.dead(), [2]);
    for point in 0..6 {
        let values = made.get(point).unwrap();
        let each: Vec<&[f32]> = values.chunks(made.plan().samples).collect();
        assert!(each[2].iter().all(|x| *x == 0.0) && each[3].iter().any(|x| *x != 0.0), "point {point}");
    }
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
    for (place, (x, y)) in PLACES.into_iter().enumerate().take(2) {
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
    assert!(String::from_utf8_lossy(&output.stderr).contains("--peak-um: expected a library whose scale"));

    // Nor is anything told of levels where it is played, nor set by them.
    let play = ["play", &bench.library, "--seconds", "0.5", "--fingers", "1"];
    let output = run(&play);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let told = [output.stderr, output.stdout].map(|text| String::from_utf8(text).unwrap()).concat();
    let figures: Vec<&str> = told.lines().filter(|line| !line.starts_with("warning")).collect();
    assert!(figures.iter().all(|line| !line.contains("µm") && !line.contains("dB")), "{told}");
    assert!(told.contains("full level the surface's limit of 1: its displacement is unknown"), "{told}");
    let played = json(&play);
    assert!(played["full_level_db"].is_null() && played["felt"]["level_db_median"].is_null(), "{played}");

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
}

#[test]
fn what_makes_no_sense_of_scales_is_refused() {
    let bench = Bench::new("takes-scales", 2, &[]);
    let direct = bench.scratch.join("direct");
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
fn whoever_is_stopped_leaves_a_library_that_says_so() {
    let scratch = Scratch::new("trusted-stopped");
    let (film, library) = (scratch.file("film.toml", FILM), scratch.join("film"));
    let start = ["calibrate", &film, "--unknowns", "5", "-o", &library];
    let places =
        ["--at=52,47", "--at=70,38", "--at=35,55", "--at=60,60", "--at=30,30", "--at=80,50", "--at=45,70"];
    let with = |more: &[&'static str]| [&start[..], &places, more].concat();
    let mut child = crate::common::program()
        .args(with(&["--without", "a3"]))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let first = Path::new(&library).join("responses/c.0.0.0");
    while !first.exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();

    let stopped = Library::open(&library).unwrap();
    assert_eq!(stopped.dead(), [2]);
    assert!(stopped.logged("scale").is_some() && stopped.logged("own_points").is_some());
    assert!(stopped.doubts().iter().any(|doubt| doubt.check == "unfinished"), "{:?}", stopped.doubts());
    drop(stopped);
    let out = scratch.join("out");
    let output = run(&["focus", &library, "--at", "52,47", "--window-ms", "30", "-o", &out]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("was not finished") && said.contains("without a3"), "{said}");

    // Points that are measured otherwise do not get into it.
    assert!(refused(&with(&[]), 1).contains("left out as when its points were measured (a3), found none"));
    assert!(refused(&with(&["--without", "a4"]), 1).contains("(a3), found a4"));
    let said = refused(&with(&["--without", "a3", "--probe-delay-ms", "1"]), 1);
    assert!(said.contains("(none), found 1.000 ms"), "{said}");
    json(&with(&["--without", "a3"]));
    assert!(Library::open(&library).unwrap().doubts().is_empty());
}

#[test]
fn a_library_of_bad_points_alone_is_no_success() {
    let mut bench = Bench::new("takes-deaf-probe", 2, &[]);
    // The probe's cable is out: its input has nothing but noise.
    bench.bring_changed(2, |mut lines| {
        let quiet = |i: usize| 1e-7 * (((i * 2_654_435_761) >> 7) % 1000) as f64;
        let probe = lines.len() - 1;
        lines[probe].iter_mut().enumerate().for_each(|(i, x)| *x = quiet(i));
        lines
    });
    let (output, told, said) = bench.calibrate(2, &["--any-wiring"]);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert_eq!(told["bad"], serde_json::json!([0, 1]), "{told}");
    assert!(said.contains("2 points measured by the probe are all bad"), "{said}");
}
