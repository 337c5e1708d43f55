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

/// Where foci are judged: places that no point of a grid of 7.5 mm is at.
const TARGETS: [[f64; 2]; 3] = [[62.0, 90.0], [101.0, 47.0], [33.0, 118.0]];

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

/// Shares of the contrast that true responses give by time reversal.
fn shares(scratch: &Scratch, library: &str, truth: &Responses) -> Vec<f64> {
    let share = |[x, y]: &[f64; 2]| {
        let (at, text) = (Point::from_mm(*x, *y), format!("{x},{y}"));
        let folder = scratch.join("touch");
        json(&["focus", library, "--at", &text, "--window-ms", "30", "-o", &folder]);
        let wav = unripple_store::read_wav(Path::new(&folder).join("drive.wav")).unwrap();
        let names = truth.ports().iter().map(|port| port.name.clone()).collect();
        let played = Drive::new(wav.rate, names, wav.channels).unwrap();
        let best = focus(truth, &[Target::at(at)], &Options::default()).unwrap().drive.as_emitted();
        let contrast = |drive: &Drive| {
            let aim = Aim { points: vec![at], instant: 0.030 };
            let field = Field::new(truth, drive, 8.0).unwrap();
            field.measure(&[aim], None).unwrap().targets[0].contrast.unwrap()
        };
        contrast(&played) / contrast(&best)
    };
    TARGETS.iter().map(share).collect()
}

#[test]
fn a_film_is_calibrated_by_probe_and_by_taps_killed_fitted_and_focused() {
    let scratch = Scratch::new("day-of-calibration");
    let (truth, mut random, begun) = (truth(), Random::seeded(11), Instant::now());
    let seed = SEED.to_string();
    let film = ["calibrate", "hudin-2012", "--unknowns", &seed, "--grid-mm", "7.5"];
    let [probed, tapped, fitted] = ["probed", "tapped", "fitted"].map(|name| scratch.join(name));
    let step = |what: &str, shares: Option<Vec<f64>>| {
        let shares = shares.map_or(String::new(), |all| format!(", shares of the true contrast {all:.3?}"));
        println!("{:7.1} s  {what}{shares}", begun.elapsed().as_secs_f64());
    };

    let report = killed(&[&film[..], &["-o", &probed]].concat(), 6, &mut random);
    assert_eq!(number(&report, "/probed"), 361.0);
    step("probed at 361 points, killed 6 times", None);
    let by_probe = shares(&scratch, &probed, &truth);
    step("focused by the probed points", Some(by_probe.clone()));

    let taps = ["--by", "tap", "--repeats", "2", "-o", &tapped];
    let report = killed(&[&film[..], &taps].concat(), 4, &mut random);
    assert_eq!(number(&report, "/probed"), 361.0);
    step("tapped at 361 points, killed 4 times", None);
    let by_taps = shares(&scratch, &tapped, &truth);
    step("focused by the tapped points", Some(by_taps.clone()));

    let report = json(&["fit", &probed, "--grid-mm", "7.5", "-o", &fitted]);
    step(&format!("fitted: {}, unexplained {:.4}", report["verdict"], number(&report, "/unexplained")), None);
    assert_eq!(report["verdict"], "good");
    let by_fit = shares(&scratch, &fitted, &truth);
    step("focused by the fitted model", Some(by_fit.clone()));

    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    assert!(by_probe.iter().all(|share| *share >= 0.97), "{by_probe:?}");
    assert!(by_fit.iter().all(|share| *share >= 0.97), "{by_fit:?}");
    assert!(mean(&by_taps) >= 0.95, "{by_taps:?}");
}
