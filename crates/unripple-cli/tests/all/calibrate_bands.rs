//! Quality by thirds of an octave: kept for each point as it is measured, by recordings and live, and drawn.

use crate::bench;
use crate::common;
use crate::elsewhere;

use bench::{Bench, FILM};
use common::{Scratch, json, refused, run};
use elsewhere::bring;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use unripple_store::{BandQuality, Library};

/// The third of an octave that noise is in, in Hz: its middle is 500 Hz.
const NOISY: [f64; 2] = [450.0, 555.0];

/// Noise in that band alone, of mean square 1: many tones of random phases.
fn noise(samples: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let tones: Vec<[f64; 2]> = (0..40)
        .map(|i| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            [
                NOISY[0] + (NOISY[1] - NOISY[0]) * f64::from(i) / 39.0,
                (state >> 11) as f64 / (1u64 << 53) as f64,
            ]
        })
        .collect();
    let sample = |i: usize| -> f64 {
        let time = i as f64 / 48e3;
        let tones = tones.iter().map(|[hz, phase]| (TAU * (hz * time + phase)).sin());
        tones.sum::<f64>() / 20f64.sqrt()
    };
    (0..samples).map(sample).collect()
}

/// What is kept of a point, `[actuator][band]`, and the centre frequencies of the bands.
fn kept(library: &str, point: usize) -> (Vec<f64>, Vec<Vec<BandQuality>>) {
    let library = Library::open(library).unwrap();
    (library.bands().unwrap().to_vec(), library.band_quality(point).unwrap().unwrap())
}

#[test]
fn a_noisy_band_of_one_point_is_in_the_library_and_in_the_figure() {
    let repeats = ["--repeats", "2"];
    let mut bench = Bench::new("bands-noisy", 2, &repeats);
    bench.bring_all(2);
    let mut takes = Vec::new();
    for place in 0..2 {
        let again = bench.hear(place, 70 + place as u64);
        bring(&bench.folder, &format!("point-{:03}-2.wav", place + 1), &again);
        takes.push(again);
    }
    let first = bench.hear(1, 3);
    bring(&bench.folder, "point-002.wav", &first);
    let (output, told, said) = bench.calibrate(2, &repeats);
    assert!(output.status.success(), "{said}");
    assert_eq!(told["measured"], 7, "{said}");
    let (middles, clean) = kept(&bench.library, 1);
    let (_, other) = kept(&bench.library, 0);
    let (_, own) = kept(&bench.library, 2);
    assert_eq!((clean.len(), clean[0].len()), (5, middles.len()));
    assert!(clean.iter().flatten().all(|band| band.coherence.is_finite()), "two takes");
    assert!(own.iter().flatten().all(|band| band.coherence.is_nan()), "one take");

    // Both takes of the second point again, with noise of a tenth of what the probe hears, in one third of an octave.
    for (file, take, seed) in [("point-002.wav", &first, 5), ("point-002-2.wav", &takes[1], 6)] {
        let mut noisy = take.clone();
        let power = noisy[5].iter().map(|x| x * x).sum::<f64>() / noisy[5].len() as f64;
        let noise = noise(noisy[5].len(), seed);
        noisy[5].iter_mut().zip(noise).for_each(|(x, noise)| *x += 0.1 * power.sqrt() * noise);
        bring(&bench.folder, file, &noisy);
    }
    let (_, told, said) = bench.calibrate(2, &repeats);
    assert_eq!(told["measured"], 7, "{said}");
    let (_, noisy) = kept(&bench.library, 1);
    for (before, after) in clean.iter().zip(&noisy) {
        for (hz, (before, after)) in middles.iter().zip(before.iter().zip(after)) {
            let lost = before.signal_to_noise_db - after.signal_to_noise_db;
            let thirds = 3.0 * (hz / 500.0).log2().abs();
            if thirds < 0.1 {
                assert!(lost > 12.0, "{hz} Hz: {before:?} {after:?}");
                assert!(before.coherence > 0.999 && after.coherence < 0.99, "{hz} Hz: {before:?} {after:?}");
            } else if thirds > 1.9 {
                assert!(lost.abs() < 1.0, "{hz} Hz: {before:?} {after:?}");
            }
        }
    }
    assert_eq!(format!("{:?}", kept(&bench.library, 0).1), format!("{other:?}"));

    drawn(&bench, &repeats);
}

/// Draws the library of a bench in which nothing is left to measure, and once more in place of the first figure.
fn drawn(bench: &Bench, repeats: &[&str]) {
    let figure = bench.scratch.join("figure");
    for _ in 0..2 {
        let (_, told, said) = bench.calibrate(2, &[repeats, &["--figure", &figure]].concat());
        assert_eq!(told["measured"], 7, "{said}");
        let svg = fs::read_to_string(format!("{figure}/bands.svg")).unwrap();
        for label in
            ["Signal to noise (dB)", "Coherence (0 to 1)", "Frequency (Hz)", "Point", "Sensor of", "a5"]
        {
            assert!(svg.contains(&format!(">{label}</text>")), "{label}");
        }
        assert!(fs::read(format!("{figure}/bands.png")).unwrap().starts_with(b"\x89PNG"));
    }
    let (output, _, said) = bench.calibrate(2, &[repeats, &["--figure", &bench.folder]].concat());
    assert!(output.status.code() == Some(2) && Path::new(&bench.folder).join("play.wav").exists(), "{said}");
}

#[test]
fn a_device_gives_bands_too_and_a_library_without_them_is_told() {
    let scratch = Scratch::new("bands-live");
    let film = scratch.file("film.toml", FILM);
    let (library, figure) = (scratch.join("lib"), scratch.join("figure"));
    let calibrate = ["calibrate", &film, "--unknowns", "5", "--at", "52,47", "-o", &library];
    let drawn = [&calibrate[..], &["--figure", &figure]].concat();
    json(&drawn);
    for point in 0..6 {
        let (middles, bands) = kept(&library, point);
        let whole = Library::open(&library).unwrap().quality(point).unwrap();
        assert!(middles.len() > 9 && bands.len() == 5);
        for (row, whole) in bands.iter().zip(whole) {
            // What is in all bands together lies between the best and the worst of them.
            let levels = || row.iter().map(|band| band.signal_to_noise_db);
            let (worst, best) = (levels().reduce(f64::min).unwrap(), levels().reduce(f64::max).unwrap());
            let all = whole.signal_to_noise_db;
            assert!(worst < all + 3.0 && best > all - 3.0, "point {point}: {worst} {all} {best}");
            assert!(row.iter().all(|band| band.coherence.is_nan()));
        }
    }
    let svg = fs::read_to_string(format!("{figure}/bands.svg")).unwrap();
    assert!(svg.contains(">Point</text>") && !svg.contains("Coherence (0 to 1)"), "nothing was repeated");

    // One of an earlier version: still a library, and nothing is drawn of it.
    fs::remove_dir_all(format!("{library}/bands")).unwrap();
    fs::remove_dir_all(&figure).unwrap();
    json(&calibrate);
    let output = run(&drawn);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && said.contains("found none in"), "{said}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("6 of 6 points measured"));
    assert!(!Path::new(&figure).exists());

    // What is taken out of a response later leaves its bands as they are.
    let late = scratch.join("late");
    run(&["calibrate", &film, "--unknowns", "5", "--at", "52,47", "--probe-delay-ms", "0.2", "-o", &late]);
    let said = Library::open(&late).unwrap().logged_point(0).cloned();
    assert!(said.unwrap()["model"]["delay_s"].as_f64().unwrap().abs() > 1e-4, "responses were moved");
    assert!(kept(&late, 0).1.iter().flatten().all(|band| !band.signal_to_noise_db.is_nan()));

    // Taps say nothing of bands, what actuators hear of each other does.
    let tapped = scratch.join("tapped");
    let calibrate = ["calibrate", &film, "--unknowns", "5", "--at", "52,47", "--by", "tap"];
    run(&[&calibrate[..], &["-o", &tapped, "--figure", &figure]].concat());
    assert!(kept(&tapped, 0).1.iter().flatten().all(|band| band.signal_to_noise_db.is_nan()));
    let svg = fs::read_to_string(format!("{figure}/bands.svg")).unwrap();
    assert!(svg.contains(">Sensor of</text>") && !svg.contains(">Point</text>"));
}

#[test]
fn a_figure_has_a_folder_of_its_own() {
    let scratch = Scratch::new("bands-refused");
    let film = scratch.file("film.toml", FILM);
    let (library, full) = (scratch.join("lib"), scratch.join("full"));
    fs::create_dir(&full).unwrap();
    fs::write(format!("{full}/thesis.tex"), "x").unwrap();
    let with = |figure: &str, status: i32| {
        refused(&["calibrate", &film, "--at", "52,47", "-o", &library, "--figure", figure], status)
    };
    assert!(with(&library, 2).contains("a folder of its own"));
    assert!(with(&full, 1).contains("other things in it"));
    assert!(
        with(&scratch.join(""), 2).contains("no file that this command reads"),
        "that of the surface's file"
    );
    assert!(!Path::new(&library).exists());
    let levels =
        ["calibrate", &film, "--at", "52,47", "-o", &library, "--check-levels", "--figure", &library];
    assert!(refused(&levels, 2).contains("--check-levels"));
}
