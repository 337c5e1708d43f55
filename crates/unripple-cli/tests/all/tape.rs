//! Calibration by files: what is written is played on a virtual surface elsewhere, and what that hears is brought back.

use crate::common;
use crate::elsewhere;

use common::{Scratch, json, number, refused, run};
use elsewhere::{Elsewhere, apart, bring, bring_at, response};
use serde_json::Value;
use std::path::Path;
use unripple::core::Point;
use unripple_store::{load_surface, read_wav};

const SEED: u64 = 3;

fn missing(told: &Value) -> Vec<&str> {
    told["tape"]["missing"].as_array().unwrap().iter().map(|file| file.as_str().unwrap()).collect()
}

#[test]
fn played_elsewhere_it_is_the_library_of_the_surface() {
    let scratch = Scratch::new("tape");
    let (folder, library, direct) = (scratch.join("tape"), scratch.join("film"), scratch.join("direct"));
    let points = ["--at=62,90", "--at=100,60"];
    let tape = ["calibrate", "hudin-2012", "--device", "tape", "--tape", &folder, "-o", &library];
    let tape = [&tape[..], &points].concat();

    // First what is to be played; the library is not begun.
    let files = ["actuators.wav", "point-001.wav", "point-002.wav"];
    assert_eq!(missing(&json(&tape)), files);
    let text = String::from_utf8(run(&tape).stdout).unwrap();
    assert!(text.contains("point-002.wav") && text.contains("(100.0000, 60.0000) mm"), "{text}");
    assert!(!Path::new(&library).exists());
    let play = read_wav(format!("{folder}/play.wav")).unwrap();
    assert_eq!((play.rate, play.channels.len()), (48e3, 8));
    assert!(play.channels.iter().flatten().all(|x| x.abs() <= 1.0));

    // Then some of the recordings, each begun when it happened to be.
    let mut elsewhere =
        Elsewhere::new(&load_surface("hudin-2012").unwrap(), SEED, &format!("{folder}/play.wav"));
    let centre = Point::from_mm(75.0, 75.0);
    bring(&folder, files[0], &elsewhere.record(centre, 30_011, 1));
    bring(&folder, files[1], &elsewhere.record(Point::from_mm(62.0, 90.0), 12_345, 2));
    let told = json(&tape);
    assert_eq!((missing(&told), number(&told, "/measured")), (vec![files[2]], 9.0));
    assert!(number(&told, "/reciprocity_error") < 0.02);

    // Then the last, and there is the library.
    let good = elsewhere.record(Point::from_mm(100.0, 60.0), 2_000, 3);
    bring(&folder, files[2], &good);
    let told = json(&tape);
    assert!(missing(&told).is_empty() && told["bad"].as_array().unwrap().is_empty());
    assert_eq!(number(&told, "/measured"), 10.0);

    // The same as measured at once, within the noise of either.
    let same = ["calibrate", "hudin-2012", "--unknowns", "3", "-o", &direct];
    json(&[&same[..], &points].concat());
    for point in 0..10 {
        let [a, b] = [&library, &direct].map(|library| response(library, point));
        let error = apart(&a, &b);
        assert!(error < 0.01, "point {point}: {error}");
    }
    let focus = json(&["focus", &library, "--at", "62,90", "--window-ms", "30", "-o", &scratch.join("out")]);
    assert_eq!(focus["taken_on"], "library");

    wrong(&scratch, &folder, &good);

    // Another calibration does not get into the same folder.
    let other = [&tape[..], &["--sweep-ms", "400"]].concat();
    assert!(refused(&other, 1).contains("another folder"));
    let other =
        ["calibrate", "hudin-2012", "--device", "tape", "--tape", &library, "-o", &folder, "--at=1,1"];
    assert!(refused(&other, 1).contains("other things in it"));
}

/// Recordings that cannot be used, each said to be so, and why.
fn wrong(scratch: &Scratch, before: &str, good: &[Vec<f64>]) {
    let mut silent = good.to_vec();
    silent[8].fill(0.0);
    let peak = good[8].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let mut clipped = good.to_vec();
    clipped[8].iter_mut().for_each(|x| *x = x.clamp(-0.5 * peak, 0.5 * peak));
    let cut = |from: usize, to: usize| good.iter().map(|line| line[from..to].to_vec()).collect::<Vec<_>>();
    let mut swapped = good.to_vec();
    swapped[..8].rotate_left(1);
    // A probe that hears hardly more than noise.
    let mut faint = good.to_vec();
    let mut state = 1_u64;
    faint[8].iter_mut().for_each(|x| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += 0.5 * peak * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0);
    });
    let length = good[0].len();
    let cases = [
        (silent, 48e3, "expected sound in channel 9 (`probe`), found silence"),
        (clipped, 48e3, "channel 9 (`probe`) is clipped"),
        (good.to_vec(), 44.1e3, "expected 48000 Hz, found 44100 Hz"),
        (good[..2].to_vec(), 48e3, "expected 9 channels (a1, a2,"),
        (cut(0, length - 20_000), 48e3, "record until after it has ended"),
        (cut(8_000, length), 48e3, "begin to record first"),
        (swapped, 48e3, "to receive the sweeps"),
        (faint, 48e3, "signal to noise"),
    ];
    let (folder, library) = (scratch.join("wrong"), scratch.join("none"));
    let places: Vec<String> = (0..cases.len() + 1).map(|i| format!("--at={},60", 40 + 10 * i)).collect();
    let tape = ["calibrate", "hudin-2012", "--device", "tape", "--tape", &folder, "-o", &library, "--json"];
    let tape: Vec<&str> = tape.into_iter().chain(places.iter().map(String::as_str)).collect();
    assert!(run(&tape).status.success());
    std::fs::copy(format!("{before}/actuators.wav"), format!("{folder}/actuators.wav")).unwrap();
    for (i, (lines, rate, _)) in cases.iter().enumerate() {
        bring_at(&folder, &format!("point-{:03}.wav", i + 1), lines, *rate);
    }
    let output = run(&tape);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert!(errors.contains("8 recordings cannot be used"), "{errors}");
    for (i, (_, _, said)) in cases.iter().enumerate() {
        let line = errors.lines().find(|line| line.contains(&format!("point-{:03}.wav", i + 1)));
        assert!(line.is_some_and(|line| line.contains(said)), "{said}: {errors}");
    }
    // Nothing is made of them: only the points at the actuators are there.
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((number(&told, "/measured"), missing(&told)), (8.0, vec!["point-009.wav"]));
    assert_eq!(told["tape"]["wrong"].as_array().unwrap().len(), 8);
    assert!(told["bad"].as_array().unwrap().is_empty());
}

#[test]
fn what_makes_no_sense_is_refused() {
    let scratch = Scratch::new("tape-refused");
    let (folder, library) = (scratch.join("tape"), scratch.join("film"));
    let with = |more: &[&str]| {
        let all =
            [&["calibrate", "hudin-2012", "--device", "tape", "-o", &library, "--at=62,90"], more].concat();
        refused(&all, 2)
    };
    assert!(with(&[]).contains("--tape DIR"));
    assert!(with(&["--tape", &folder, "--by", "hammer"]).contains("force=100"));
    assert!(with(&["--tape", &folder, "--by", "hammer", "--input-scale", "1"]).contains("none for `force`"));
    assert!(with(&["--tape", &folder, "--tape-inputs", "a1,a1"]).contains("`a1` twice"));
    assert!(with(&["--tape", &folder, "--tape-inputs", "a1,left"]).contains("called `probe`"));
    assert_eq!(scratch.names(), Vec::<String>::new());
}
