//! The modes that drives are evaluated on: up to twice the band unless another frequency is asked for, by every command, and said.

use crate::common;

use common::{Scratch, json, number, refused, run};
use serde_json::Value;
use unripple::core::{Point, Responses};
use unripple::physics::{ResponseOptions, responses};
use unripple_store::{load_surface, read_wav};

/// A film of few modes, whose band ends at 700 Hz.
const FILM: &str = "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
                    thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 700]\n\
                    sample_rate_hz = 16000\n[[actuator]]\nat_mm = [12, 31]\n[[actuator]]\nat_mm = [140, 44]\n\
                    [[actuator]]\nat_mm = [40, 140]\n";

/// Side of the paper's film, in metres.
const SIDE: f64 = 0.15;

/// A report without the record of what was asked for.
fn figures(mut report: Value) -> Value {
    report.as_object_mut().unwrap().remove("run");
    report
}

fn drive(folder: &str) -> Vec<u8> {
    std::fs::read(format!("{folder}/drive.wav")).unwrap()
}

#[test]
fn a_focus_is_evaluated_up_to_twice_the_band() {
    let scratch = Scratch::new("judged-focus");
    let folders = ["usual", "wide", "narrow"].map(|name| scratch.join(name));
    let focus = |folder: &str, more: &[&str]| {
        let common = ["focus", "hudin-2012", "--at", "62,90", "--window-ms", "30", "-o", folder];
        json(&[&common[..], more].concat())
    };
    let [usual, wide, narrow] = &folders;
    let found = focus(usual, &[]);
    assert_eq!(found["judged_on"], "hudin-2012, modes up to 6000 Hz");
    assert_eq!(figures(found), figures(focus(wide, &["--judge-hz", "6000"])));
    assert_eq!(drive(usual), drive(wide));
    // The drive is computed from the modes of the band, whatever it is evaluated on.
    let found = focus(usual, &["--full-limit"]);
    let same = focus(narrow, &["--full-limit", "--judge-hz", "3000"]);
    assert_eq!(same["judged_on"], "hudin-2012, modes up to 3000 Hz");
    assert_eq!(drive(usual), drive(narrow));
    let contrasts = [found, same].map(|report| number(&report, "/targets/0/contrast"));
    assert!((contrasts[0] / contrasts[1] - 1.0).abs() > 1e-4, "{contrasts:?}");
}

#[test]
fn on_its_own_modes_a_drive_looks_better_than_it_is() {
    let scratch = Scratch::new("judged-limited");
    let out = scratch.join("out");
    let contrast = |more: &[&str]| {
        // At the drive limit, where it differs most from `concentrate`.
        let limited = ["focus", "hudin-2012", "--at", "62,90", "--method", "limited", "--full-limit"];
        number(
            &json(&[&limited[..], &["--window-ms", "30", "-o", &out], more].concat()),
            "/targets/0/contrast",
        )
    };
    let (own, usual) = (contrast(&["--judge-hz", "3000"]), contrast(&[]));
    assert!(own > 1.2 * usual, "{own} {usual}");
}

#[test]
fn a_field_is_evaluated_up_to_twice_the_band_with_fingers_too() {
    let scratch = Scratch::new("judged-field");
    let (film, out) = (scratch.file("film.toml", FILM), scratch.join("out"));
    let focus = ["focus", &film, "--at", "62,90", "--window-ms", "30", "-o", &out];
    let wav = format!("{out}/drive.wav");
    let field = ["field", &film, "--drive", &wav, "--at", "62,90", "--at-ms", "30"];
    let free: &[&str] = &[];
    for finger in [free, &["--finger", "100,40"]] {
        for command in [&focus[..], &field] {
            let judged = |more: &[&str]| json(&[command, finger, more].concat());
            let usual = judged(&[]);
            assert_eq!(usual["judged_on"], "A film, modes up to 1400 Hz");
            assert_eq!(usual["fingers"].is_array(), !finger.is_empty());
            assert_eq!(figures(usual.clone()), figures(judged(&["--judge-hz", "1400"])));
            let narrow = judged(&["--judge-hz", "700"]);
            assert_ne!(narrow["targets"], usual["targets"]);
        }
    }
}

/// A rate of three times the band leaves room for modes up to 1.35 times it, one of little more than twice the band for none.
#[test]
fn modes_end_where_samples_no_longer_tell_them_apart() {
    let scratch = Scratch::new("judged-rate");
    for (rate, top) in [(2100, 945.0), (1500, 700.0)] {
        let film = FILM.replace("= 16000", &format!("= {rate}"));
        let (film, out) = (scratch.file("film.toml", film), scratch.join("out"));
        let asked = [film.as_str(), "--at", "62,90", "--window-ms", "30", "-o", &out];
        let focused = json(&[&["focus"], &asked[..]].concat());
        assert_eq!(focused["judged_on"], format!("A film, modes up to {top} Hz"));
        let followed = json(&["focus", &film, "--waveform", "62,90,burst:250,5,1", "-o", &out]);
        assert_eq!(followed["judged_on"], focused["judged_on"]);
        let table = run(&[&["compare"], &asked[..5]].concat()).stdout;
        let table = String::from_utf8(table).unwrap();
        assert!(table.contains(&format!("modes up to {top} Hz")), "{table}");
    }
}

/// Velocity at a target of the paper's film and contrast at the last sample of a drive, and the number of points outside: every mode
/// up to `top` (Hz) as a struck oscillator, at every place of the grid that defines the contrast.
fn summed(channels: &[Vec<f64>], top: f64, at: Point, wavelength: f64) -> (f64, f64, usize) {
    let film = load_surface("hudin-2012").unwrap();
    let options = ResponseOptions { max_hz: Some(top), ..ResponseOptions::default() };
    let Responses::Modal(modal) = responses(&film, &options).unwrap() else { unreachable!() };
    let (rate, last) = (film.emission.rate, channels[0].len() - 1);
    let moves = |(m, pole): (usize, &unripple::core::Pole)| {
        let (omega, sigma) = (pole.omega, pole.sigma);
        let ringing = (omega * omega - sigma * sigma).sqrt();
        let struck = |sample: usize| {
            let forces = channels.iter().enumerate().map(|(a, all)| modal.input[(a, m)] * all[sample]);
            let since = (last - sample) as f64 / rate;
            let (sine, cosine) = (ringing * since).sin_cos();
            forces.sum::<f64>() * (-sigma * since).exp() * (cosine - sigma / ringing * sine)
        };
        (0..=last).map(struck).sum::<f64>() / rate
    };
    let modes: Vec<f64> = modal.poles.iter().enumerate().map(moves).collect();
    let cells = (8.0 * SIDE / wavelength).ceil() as usize;
    let along = |i: usize| (i as f64 + 0.5) * SIDE / cells as f64;
    let grid = (0..cells * cells).map(|cell| Point::new(along(cell % cells), along(cell / cells)));
    let outside = grid.filter(|point| point.distance(at) > 4.0 / 3.0 * wavelength);
    let places: Vec<Point> = std::iter::once(at).chain(outside).collect();
    let shapes = modal.shapes.at_all(&places);
    let velocity = |place: usize| modes.iter().enumerate().map(|(m, v)| shapes[(place, m)] * v).sum::<f64>();
    let squares: f64 = (1..places.len()).map(|place| velocity(place).powi(2)).sum();
    let (peak, count) = (velocity(0), places.len() - 1);
    (peak, peak.abs() / (squares / count as f64).sqrt(), count)
}

#[test]
fn a_frequency_that_samples_do_not_carry_is_refused() {
    let scratch = Scratch::new("judged-carried");
    let out = scratch.join("out");
    for command in [
        vec!["focus", "hudin-2012", "--at", "62,90", "-o", &out],
        vec!["compare", "hudin-2012", "--at", "62,90", "-o", &out],
        vec!["focus", "hudin-2012", "--waveform", "62,90,burst:100,3", "-o", &out],
    ] {
        for hz in ["24000", "1e5", "NaN"] {
            let told = refused(&[&command[..], &["--judge-hz", hz]].concat(), 2);
            assert!(told.contains("24000 Hz, half the sample rate") || hz == "NaN", "{told}");
        }
    }
}

#[test]
fn the_contrast_is_that_of_a_sum_over_these_modes() {
    let scratch = Scratch::new("judged-sum");
    let out = scratch.join("out");
    let focus = ["focus", "hudin-2012", "--at", "62,90", "--window-ms", "30", "-o", &out];
    let tops: [(f64, &[&str]); 2] = [(6000.0, &[]), (4500.0, &["--judge-hz", "4500"])];
    for (top, asked) in tops {
        let report = json(&[&focus[..], asked].concat());
        let channels = read_wav(format!("{out}/drive.wav")).unwrap().channels;
        assert_eq!(channels[0].len(), 1441);
        let wavelength = number(&report, "/lambda_min_m");
        let (peak, contrast, outside) = summed(&channels, top, Point::from_mm(62.0, 90.0), wavelength);
        assert_eq!(number(&report, "/outside_points"), outside as f64);
        for (key, expected) in [("peak_velocity_m_s", peak), ("contrast", contrast)] {
            let found = number(&report, &format!("/targets/0/{key}"));
            assert!((found / expected - 1.0).abs() < 2e-5, "{top} Hz, {key}: {found} {expected}");
        }
    }
}
