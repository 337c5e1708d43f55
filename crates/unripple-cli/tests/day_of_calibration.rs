//! A day at the bench: the paper's film calibrated in its whole band by probe and by taps, killed ten times, then fitted, focused and
//! judged on the true surface.
//!
//! Takes long, so `cargo test` leaves it to `./soak 1 calibration`.

mod common;

use common::{Scratch, json, number};
use serde_json::Value;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};
use unripple::core::{Drive, Point, Random, Responses};
use unripple::field::{Aim, Field};
use unripple::focus::{Options, Target, focus};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};
use unripple_devices::Perturbation;

const SEED: u64 = 7;

/// Where foci are judged: points of the grid of 7.5 mm, and places between them.
const POINTS: [[f64; 2]; 3] = [[60.0, 90.0], [105.0, 45.0], [30.0, 120.0]];
const BETWEEN: [[f64; 2]; 3] = [[62.0, 90.0], [101.0, 47.0], [33.0, 118.0]];

/// Largest factor by which interpolation was seen to be off by more than it states, beside stray masses.
const MORE: f64 = 2.6;

/// Runs a command until it is through, killed at so many random moments before.
fn killed(run: &[&str], times: usize, random: &mut Random) -> Value {
    for _ in 0..times {
        let mut child = common::program();
        let mut child = child.args(run).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_secs_f64(random.between(3.0, 15.0)));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    json(run)
}

/// The film as it truly is.
fn truth() -> Responses {
    let truth = Perturbation { seed: SEED, ..Perturbation::default() }.truth(&papers_surface()).unwrap();
    let options = ResponseOptions { accuracy: 1e-4.into(), ..ResponseOptions::default() };
    let Responses::Modal(mut modal) = responses(&truth.surface, &options).unwrap() else { unreachable!() };
    for (a, gain) in truth.drive_gains.iter().enumerate() {
        (0..modal.poles.len()).for_each(|m| modal.input[(a, m)] *= gain);
    }
    Responses::Modal(modal)
}

/// What is said of interpolation at a target, as a share of the responses: 0 at a point of the library.
fn stated(report: &Value) -> f64 {
    let texts = report["notes"].as_array().into_iter().flatten().filter_map(|note| note["text"].as_str());
    let said = texts.filter_map(|text| text.split_once("off by about ")?.1.split_once(" %"));
    said.map(|(percent, _)| percent.parse::<f64>().unwrap() / 100.0).fold(0.0, f64::max)
}

/// Shares of the contrast that true responses give by time reversal, each with the stated error of interpolation.
fn shares(scratch: &Scratch, library: &str, truth: &Responses, targets: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let share = |[x, y]: &[f64; 2]| {
        let (at, text) = (Point::from_mm(*x, *y), format!("{x},{y}"));
        let folder = scratch.join("touch");
        let report = json(&["focus", library, "--at", &text, "--window-ms", "30", "-o", &folder]);
        let wav = unripple_store::read_wav(Path::new(&folder).join("drive.wav")).unwrap();
        let names = truth.ports().iter().map(|port| port.name.clone()).collect();
        let played = Drive::new(wav.rate, names, wav.channels).unwrap();
        let best = focus(truth, &[Target::at(at)], &Options::default()).unwrap().drive.as_emitted();
        let contrast = |drive: &Drive| {
            let aim = Aim { points: vec![at], instant: 0.030 };
            let field = Field::new(truth, drive, 8.0).unwrap();
            field.measure(&[aim], None).unwrap().targets[0].contrast.unwrap()
        };
        [contrast(&played) / contrast(&best), stated(&report)]
    };
    targets.iter().map(share).collect()
}

#[test]
fn a_film_is_calibrated_by_probe_and_by_taps_killed_fitted_and_focused() {
    let scratch = Scratch::new("day-of-calibration");
    let (truth, mut random, begun) = (truth(), Random::seeded(11), Instant::now());
    let seed = SEED.to_string();
    let film = ["calibrate", "hudin-2012", "--unknowns", &seed, "--grid-mm", "7.5"];
    let [probed, tapped, fitted] = ["probed", "tapped", "fitted"].map(|name| scratch.join(name));
    let step = |what: &str, found: &[[f64; 2]]| {
        let told: Vec<String> =
            found.iter().map(|[share, error]| format!("{share:.3} ({:.1} %)", 100.0 * error)).collect();
        let told = if told.is_empty() { String::new() } else { format!(": {}", told.join(", ")) };
        println!("{:7.1} s  {what}{told}", begun.elapsed().as_secs_f64());
    };
    println!("shares of the true contrast, in brackets the stated error of interpolation");
    let mut wrong = Vec::new();
    // At measured points nothing is lost; between them, what interpolation says of itself, and what it was seen to be off by beyond that.
    let mut judged = |library: &str, what: &str, least: f64| {
        let (there, between) =
            (shares(&scratch, library, &truth, &POINTS), shares(&scratch, library, &truth, &BETWEEN));
        step(&format!("focused by {what}, at points"), &there);
        step(&format!("focused by {what}, between them"), &between);
        let enough = |[share, error]: &[f64; 2]| *share >= least / (MORE * error).hypot(1.0);
        if !there.iter().chain(&between).all(enough) {
            wrong.push(what.to_owned());
        }
    };

    let report = killed(&[&film[..], &["-o", &probed]].concat(), 6, &mut random);
    assert_eq!(number(&report, "/probed"), 361.0);
    step("probed at 361 points, killed 6 times", &[]);
    judged(&probed, "probed points", 0.97);

    let taps = ["--by", "tap", "--repeats", "2", "-o", &tapped];
    let report = killed(&[&film[..], &taps].concat(), 4, &mut random);
    assert_eq!(number(&report, "/probed"), 361.0);
    step("tapped at 361 points, killed 4 times", &[]);
    judged(&tapped, "tapped points", 0.97);

    // The model gives responses at any place, so that none need be interpolated.
    let places: Vec<String> =
        BETWEEN.iter().flat_map(|[x, y]| ["--at".to_owned(), format!("{x},{y}")]).collect();
    let fit = ["fit", &probed, "--grid-mm", "7.5", "-o", &fitted].into_iter();
    let report = json(&fit.chain(places.iter().map(String::as_str)).collect::<Vec<_>>());
    step(&format!("fitted: {}, unexplained {:.4}", report["verdict"], number(&report, "/unexplained")), &[]);
    assert_eq!(report["verdict"], "good");
    judged(&fitted, "the fitted model", 0.97);
    assert!(wrong.is_empty(), "{wrong:?}");
}
