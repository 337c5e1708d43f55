//! `listen` and `fit --modes`: from the recording of a knock to a fitted surface file.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;
use std::f64::consts::TAU;
use unripple::core::{Drive, Random};
use unripple_store::{load_surface, write_wav};

/// A copper plate, clamped along one long side (Nemus-Project, magpie-python, `youngcalc`), from a file that says 120 GPa.
const COPPER: &str = r#"format = 1
name = "copper plate"
[outline]
rectangle_mm = [100, 80]
edge = ["clamped", "free", "free", "free"]
[sheet]
material = "copper"
young_gpa = 120
density_kg_m3 = 8765
poisson_ratio = 0.33
thickness_mm = 0.81
loss_factor = 0.001
[drive]
band_hz = [0, 2000]
sample_rate_hz = 48000
[[actuator]]
at_mm = [50, 40]
"#;

/// Its measured frequencies in Hz.
const MEASURED: [f64; 6] = [73.2, 148.0, 376.0, 431.0, 559.0, 910.0];

/// The measured frequencies as they are typed.
const TYPED: &str = "73.2,148,376,431,559,910";

/// A recording of a knock on it, twice: the second time 90 ms after the first, in hum and noise.
fn knock() -> Drive {
    let rate = 16e3;
    let mut random = Random::seeded(11);
    let ring = |t: f64| -> f64 {
        let one = |hz: &f64| 0.1 * (-t * hz / 40.0).exp() * (TAU * hz * t).sin();
        if t < 0.0 { 0.0 } else { MEASURED.iter().map(one).sum() }
    };
    let sample = |n: u32| {
        let t = f64::from(n) / rate;
        ring(t - 0.2) + ring(t - 0.29) + 0.02 * (TAU * 50.0 * t).sin() + 5e-4 * random.normal()
    };
    let sound = (0..32_000).map(sample).collect();
    Drive::new(rate, vec!["microphone".into()], vec![sound]).unwrap()
}

/// Numbers of a list in a report.
fn list(report: &Value, pointer: &str, key: &str) -> Vec<f64> {
    let rows = report.pointer(pointer).and_then(Value::as_array).unwrap();
    rows.iter().map(|row| row[key].as_f64().unwrap()).collect()
}

#[test]
fn a_knock_becomes_a_fitted_surface() {
    let scratch = Scratch::new("knock");
    let (wav, plate) = (scratch.join("knock.wav"), scratch.file("copper.toml", COPPER));
    write_wav(&wav, &knock()).unwrap();
    let (heard_in, fitted_in) = (scratch.join("heard"), scratch.join("fitted"));
    let heard = json(&["listen", &wav, "-o", &heard_in]);
    let hz = list(&heard, "/modes", "frequency_hz");
    assert_eq!(hz.len(), MEASURED.len(), "{heard}");
    assert!(hz.iter().zip(MEASURED).all(|(found, hz)| (found / hz - 1.0).abs() < 2e-3), "{heard}");
    assert!(
        (heard["hits_s"].as_array().unwrap().len(), heard["mains_hz"].as_f64()) == (2, Some(50.0)),
        "{heard}"
    );
    let errors = refused(&["listen", &wav, "--hit", "4"], 2);
    assert!(errors.contains("--hit: expected 1 to 2, found 4"), "{errors}");
    let modes = heard["modes_text"].as_str().unwrap();
    let report = json(&["fit", &plate, "--modes", modes, "--error-percent", "3", "-o", &fitted_in]);
    let young = number(&report, "/quantities/0/value");
    assert!((young / 98e9 - 1.0).abs() < 0.03, "{report}");
    // τ = 40/f, so that 1/(πfτ) = 1/(40π).
    assert!((number(&report, "/losses/loss_factor") * 40.0 * TAU / 2.0 - 1.0).abs() < 0.1, "{report}");
    let written = load_surface(&format!("{fitted_in}/fitted.toml")).unwrap();
    assert_eq!(written.sheet.young, young);
    for (folder, figures) in [(&heard_in, ["recording", "modes"]), (&fitted_in, ["frequencies", "residuals"])]
    {
        for ending in ["svg", "pdf", "png", "csv"] {
            let held =
                |figure: &str| std::path::Path::new(folder).join(format!("{figure}.{ending}")).is_file();
            assert!(figures.into_iter().all(held), "{folder} {ending}");
        }
    }
}

#[test]
fn the_mirror_image_of_a_plate_is_said_with_what_would_tell_it_apart() {
    let scratch = Scratch::new("mirrored");
    let plate = scratch.file("copper.toml", COPPER);
    let output = run(&["fit", &plate, "--modes", TYPED, "--error-percent", "3"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for part in
        ["modulus", "top clamped, left free, a mirror image", "tap, or hold a finger, at", "note (mass)"]
    {
        assert!(text.contains(part), "{part:?} in {text}");
    }
    let alone = json(&["fit", &plate, "--modes", TYPED, "--error-percent", "3", "--sides-known"]);
    assert_eq!(alone["others"].as_array().map(Vec::len), Some(0), "{alone}");
}

#[test]
fn bad_input_is_refused_with_the_option() {
    let scratch = Scratch::new("frequencies-refused");
    let plate = scratch.file("copper.toml", COPPER);
    let out = scratch.join("out");
    for (typed, said) in [
        (&["--modes", "a"][..], "--modes a: expected HZ[:MS]"),
        (&["--modes", "0.01"], "--modes: expected frequencies from 0.1"),
        (&["--modes", "100", "--free", "colour"], "--free: expected one of tension, modulus"),
        (&["--modes", "100", "--free", "tension"], "--free: expected a quantity that the surface has"),
        (&["--modes", "100", "--error-percent", "0"], "--error-percent: expected 0.001 to 20 per cent"),
        (&["--modes", "100", "--strays", "1"], "--strays"),
        (&["--free", "modulus"], "--modes"),
    ] {
        let errors = refused(&[&["fit", &plate, "-o", &out], typed].concat(), 2);
        assert!(errors.contains(said), "{typed:?}: {said:?} in {errors}");
    }
    let silent = scratch.join("silent.wav");
    write_wav(&silent, &Drive::new(16e3, vec!["microphone".into()], vec![vec![0.0; 16_000]]).unwrap())
        .unwrap();
    for (typed, said) in [
        (&["--most", "5"][..], "knock: expected a hit"),
        (&["--channel", "2"], "--channel: expected 1 to 1, found 2"),
        (&["--band-hz", "200,100"], "--band-hz: expected two frequencies"),
        (
            &["--band-hz", "20,30000"],
            "--band-hz: expected at most 6400, four tenths of the sample rate, found 30000",
        ),
        (&["--hit", "0"], "--hit: expected a number from 1"),
        (&["--set", "accuracy=1"], "--accuracy: expected a command that reads a surface file"),
    ] {
        let errors = refused(&[&["listen", &silent, "-o", &out], typed].concat(), 2);
        assert!(errors.contains(said), "{typed:?}: {said:?} in {errors}");
    }
    assert_eq!(scratch.names(), ["copper.toml", "silent.wav"]);
}
