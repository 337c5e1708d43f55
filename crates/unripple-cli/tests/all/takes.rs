//! Recordings as they come back from a bench: changed, copied, of other kinds, at other rates, too many and too few.

use crate::bench;
use crate::common;
use crate::elsewhere;

use bench::{Bench, FILM, SEED};
use common::{Scratch, json, number, run};
use elsewhere::{apart, bring, bring_at, response};
use serde_json::Value;
use unripple::core::Point;
use unripple_store::{Library, read_wav};

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
fn actuators_that_are_recorded_again_are_measured_again_without_any_point() {
    let mut bench = Bench::new("takes-own", 0, &[]);
    bench.bring_all(0);
    let (output, told, said) = bench.calibrate(0, &[]);
    assert!(output.status.success() && number(&told, "/measured") == 5.0, "{said}");
    let first = response(&bench.library, 0);
    assert!(bench.calibrate(0, &[]).0.status.success());
    assert!(response(&bench.library, 0) == first, "the same file is not looked at again");

    let again = bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 77);
    bring(&bench.folder, "actuators.wav", &again);
    let (output, told, said) = bench.calibrate(0, &[]);
    assert!(output.status.success() && number(&told, "/measured") == 5.0, "{said}");
    assert!(response(&bench.library, 0) != first, "another recording has other noise");

    // Neither do they stay as they were when another actuator is left out.
    let (_, _, said) = bench.calibrate(0, &["--without", "a3"]);
    assert!(response(&bench.library, 0).chunks(4801).nth(2).unwrap().iter().all(|h| *h == 0.0), "{said}");
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

/// A line at other instants, by interpolation through six samples: it is oversampled well enough (48 kHz for 1.8 kHz).
fn interpolated(line: &[f64], step: f64) -> Vec<f64> {
    let at = |i: i64| usize::try_from(i).ok().and_then(|i| line.get(i)).copied().unwrap_or(0.0);
    let count = (line.len() as f64 / step) as usize;
    (0..count)
        .map(|i| {
            let t = i as f64 * step;
            let (k, u) = (t.floor() as i64, t.fract());
            // Lagrange's polynomial.
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
    assert!(said.contains("point-003.wav at (35.0000, 55.0000) mm in the folder, not requested"), "{said}");
    let (output, _, said) = bench.calibrate(3, &["--repeats", "2", "--sweep-ms", "400"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        said.contains("\"sweep_s\": 0.5 in the folder, 0.4 requested")
            && said.contains("\"sweeps_begin_s\": ["),
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
fn without_sensors_the_take_that_is_bad_is_named_and_the_others_stay() {
    let inputs = ["--tape-inputs", "probe,reference"];
    let mut bench = Bench::new("takes-one-bad", 3, &inputs);
    let play = bench.surface.play.clone();
    let with = |lines: &[Vec<f64>], early: usize| {
        let sent = |i: usize| -> f64 { play.iter().map(|line| line.get(i).copied().unwrap_or(0.0)).sum() };
        let reference = |i: usize| i.checked_sub(early).map_or(0.0, sent);
        vec![lines[5].clone(), (0..lines[5].len()).map(|i| 0.2 * reference(i)).collect()]
    };
    let own = with(&bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1), 9_000);
    bring(&bench.folder, "actuators.wav", &own);
    for place in 0..3 {
        let heard = with(&bench.hear(place, 2 + place as u64), 6_000 + 997 * place);
        // The first recorder's clock is 250 millionths off.
        let heard = match place {
            0 => heard.iter().map(|line| interpolated(line, 1.00025)).collect(),
            _ => heard,
        };
        bring(&bench.folder, &format!("point-{:03}.wav", place + 1), &heard);
    }
    let (output, told, said) = bench.calibrate(3, &inputs);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("  point-001.wav: ") && !said.contains("actuators.wav: "), "{said}");
    assert_eq!(number(&told, "/measured"), 2.0, "{said}");
}

#[test]
fn a_probes_delay_is_taken_out_once_and_of_all_points() {
    let mut bench = Bench::new("takes-delay", 2, &[]);
    // The probe hears 1 ms later than the sensors.
    let late = |mut lines: Vec<Vec<f64>>| {
        lines[5].rotate_right(48);
        lines[5][..48].fill(0.0);
        lines
    };
    bench.bring_changed(2, late);
    let (output, _, said) = bench.calibrate(2, &["--no-model"]);
    assert!(output.status.success(), "{said}");
    let (raw, chunk) = (response(&bench.library, 0), format!("{}/responses/c.0.0.0", bench.library));
    let bytes = std::fs::read(&chunk).unwrap();
    let taken_out =
        |told: &Value| told["notes"].to_string().contains("ms later than those of the sensors: corrected");
    let (output, told, said) = bench.calibrate(2, &[]);
    assert!(output.status.success() && taken_out(&told), "{said}");
    let mended = response(&bench.library, 0);
    assert!(apart(&mended, &raw) > 0.3);

    // As whoever is stopped between the log and the responses leaves it: they are mended, once.
    std::fs::write(&chunk, bytes).unwrap();
    let (output, told, said) = bench.calibrate(2, &[]);
    assert!(output.status.success() && taken_out(&told), "{said}");
    // The delay is found again, by other noise: to the hundredth of a sample that is not worth another copy.
    let error = apart(&response(&bench.library, 0), &mended);
    assert!(error < 5e-3, "{error}");
    let delay = Library::open(&bench.library).unwrap().logged_point(0).unwrap()["model"]["delay_s"].clone();
    assert!((delay.as_f64().unwrap() - 1e-3).abs() < 5e-5, "{delay}");

    // A point that comes later, without a model, has lost it as well.
    let heard = late(bench.hear(2, 4));
    bring(&bench.folder, "point-003.wav", &heard);
    let (output, told, said) = bench.calibrate(3, &["--no-model"]);
    assert!(output.status.success() && taken_out(&told) && number(&told, "/measured") == 8.0, "{said}");
    let whole = bench.scratch.join("whole");
    let command = Bench::command(&bench.film, &bench.folder, &whole, 3, &[]);
    let output = run(&command.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let error = apart(&response(&bench.library, 2), &response(&whole, 2));
    assert!(error < 0.02, "{error}");

    // What is said of responses that are gone counts for no others.
    let mut library = Library::open(&bench.library).unwrap();
    library.forget(&[0]).unwrap();
    let stale = serde_json::json!({ "model": { "delay_s": 5e-3, "times": 1.0 } });
    library.log_points([(0, stale)].into()).unwrap();
    drop(library);
    let (output, told, said) = bench.calibrate(3, &["--no-model"]);
    assert!(output.status.success() && number(&told, "/measured") == 8.0, "{said}");
    let error = apart(&response(&bench.library, 0), &mended);
    assert!(error < 5e-3, "{error}");
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

    // The probe is not needed yet, nor is anything said of it.
    let mut own = bench.surface.record(Point::from_mm(60.0, 50.0), 9_000, 1);
    own.iter_mut().for_each(|line| scaled(line, 0.5));
    own[5].fill(0.0);
    bring(&bench.folder, "actuators.wav", &own);
    let (output, told, said) = bench.calibrate(1, &["--check-levels"]);
    assert!(output.status.success() && told["advice"].as_array().unwrap().is_empty(), "{said} {told}");
    let mut heard = bench.hear(0, 3);
    heard[5].fill(0.0);
    bring(&bench.folder, "point-001.wav", &heard);
    let (output, _, said) = bench.calibrate(1, &["--check-levels"]);
    assert!(output.status.code() == Some(1) && said.contains("1 channels are clipped or silent"), "{said}");
    std::fs::remove_file(format!("{}/point-001.wav", bench.folder)).unwrap();

    // Through a device all sweeps are played once; nothing is kept.
    let library = bench.scratch.join("levels");
    let told =
        json(&["calibrate", &bench.film, "--unknowns", "3", "--check-levels", "--at=52,47", "-o", &library]);
    assert_eq!(told["levels"].as_array().unwrap().len(), 6);
    assert!(number(&told, "/levels/5/signal_to_noise_db") > 20.0);
    assert!(!std::path::Path::new(&library).exists());
    // It is listened to once: how many repeats are asked for changes nothing of what is advised.
    let loud = |repeats: &str| {
        let start = ["calibrate", &bench.film, "--unknowns", "3", "--snr-db", "25", "--at=52,47"];
        json(&[&start[..], &["--check-levels", "--repeats", repeats, "-o", &library]].concat())
    };
    let (told, again) = (loud("1"), loud("4"));
    assert_eq!(told["advice"], again["advice"]);
    assert!(told["advice"].to_string().contains("--repeats"), "{told}");
}

#[test]
fn responses_may_be_as_long_as_is_asked() {
    let scratch = Scratch::new("takes-long");
    let film = scratch.file("film.toml", FILM);
    for (ms, samples) in [("350", 16_801), ("1000", 48_001)] {
        let library = scratch.join(ms);
        let told = json(&["calibrate", &film, "--at=52,47", "--response-ms", ms, "-o", &library]);
        assert_eq!(number(&told, "/measured"), 6.0);
        assert_eq!(Library::open(&library).unwrap().plan().samples, samples);
    }
}
