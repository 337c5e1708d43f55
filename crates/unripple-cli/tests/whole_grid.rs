//! A whole grid calibrated, at half a shortest wavelength, killed at random moments: what the library focuses on the true surface.
//!
//! Takes minutes, so `cargo test` leaves it to `./soak 1 calibration`.

mod common;

use common::{Scratch, json, number};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;
use unripple::core::{Drive, Point, Random, Responses};
use unripple::field::{Aim, Field};
use unripple::focus::{Options, Target, focus};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};
use unripple_devices::Unknowns;

#[test]
fn a_whole_grid_focuses_as_the_true_responses_do() {
    let scratch = Scratch::new("calibrate-grid");
    let library = scratch.join("lib");
    let run = ["calibrate", "hudin-2012", "--unknowns", "7", "--grid-mm", "7.5", "-o", &library];
    let mut random = Random::seeded(11);
    for _ in 0..5 {
        let quiet = || Stdio::null();
        let mut child = Command::new(env!("CARGO_BIN_EXE_unripple"));
        let mut child = child.args(run).stdout(quiet()).stderr(quiet()).spawn().unwrap();
        std::thread::sleep(Duration::from_secs_f64(random.between(2.0, 12.0)));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_eq!(number(&json(&run), "/probed"), 361.0);

    let truth = Unknowns { seed: 7, ..Unknowns::default() }.truth(&papers_surface()).unwrap();
    let options = ResponseOptions { accuracy: 1e-4, ..ResponseOptions::default() };
    let Responses::Modal(mut modal) = responses(&truth.surface, &options).unwrap() else { unreachable!() };
    for (a, gain) in truth.drive_gains.iter().enumerate() {
        (0..modal.poles.len()).for_each(|m| modal.input[(a, m)] *= gain);
    }
    let truth = Responses::Modal(modal);
    let folder = scratch.join("out");
    json(&["focus", &library, "--at", "62,90", "--window-ms", "30", "-o", &folder]);
    let wav = unripple_store::read_wav(Path::new(&folder).join("drive.wav")).unwrap();
    let names = truth.ports().iter().map(|port| port.name.clone()).collect();
    let played = Drive::new(wav.rate, names, wav.channels).unwrap();
    let at = Point::from_mm(62.0, 90.0);
    let best = focus(&truth, &[Target::at(at)], &Options::default()).unwrap().drive.as_emitted();
    let contrast = |drive: &Drive| {
        let aim = Aim { points: vec![at], instant: 0.030 };
        Field::new(&truth, drive, 8.0).unwrap().measure(&[aim], None).unwrap().targets[0].contrast.unwrap()
    };
    let share = contrast(&played) / contrast(&best);
    println!("contrast {:.3}, {:.2} % of the true responses'", contrast(&played), 100.0 * share);
    assert!(share >= 0.98);
}
