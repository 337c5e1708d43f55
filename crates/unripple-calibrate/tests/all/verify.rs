//! Probed points that are what they are said to be, and points that are not.

use crate::{heard_bench, kinds_bench};

use heard_bench::*;
use unripple_calibrate::Measured;
use unripple_calibrate::verify::{Checked, Verified, VerifyOptions, check};
use unripple_core::{ActuatorKind, Point, Surface};
use unripple_devices::Perturbation;
use unripple_physics::sample;

/// Checks the calibration data of a true surface against its surface file.
fn verified(
    truth: &mut Truth,
    believed: &Surface,
    said: &[Point],
    stood: &[Point],
    gains: &[f64],
) -> Verified {
    let (measured, probed) = (truth.pairs(), truth.probed(said, stood, gains));
    check(believed, &measured, &probed, &VerifyOptions::default()).unwrap()
}

fn said(found: &Verified) -> String {
    let doubts: Vec<String> = found.doubts.iter().map(|d| format!("{} {:?}", d.what, d.points)).collect();
    format!("{:?}\nnotes {:#?}\ndoubts {doubts:#?}", found.model, found.notes)
}

/// Clean, at 30 dB, and with another latency, on sheets that ring above their band: nothing is doubted.
#[test]
fn good_points_pass_on_film_plate_and_panel() {
    for surface in [film(), plate(), panel()] {
        let points = places(&surface, 4);
        for (snr, late, rings) in [(60.0, 0.0, 1.47), (30.0, 0.0, 1.47), (60.0, 2.3, 1.0), (20.0, -0.4, 2.0)]
        {
            let mut truth = Truth { snr, late, rings, ..Truth::of(surface.clone()) };
            let found = verified(&mut truth, &surface, &points, &points, &[1.0; 4]);
            println!("{} mm, {snr} dB, late {late}: {}", surface.outline.extent().0 * 1e3, said(&found));
            assert!(matches!(found.model, Checked::Against { .. }), "{}", said(&found));
            assert!(found.doubts.is_empty() && found.probe_delay.is_none(), "{}", said(&found));
            assert!(found.points.iter().all(|p| p.correction.is_none() && p.unexplained < 0.3), "{found:?}");
        }
    }
}

/// A surface file with another tension, thickness and places condemns no good data.
#[test]
fn a_wrong_surface_file_condemns_nothing() {
    for (surface, tension) in [(film(), 0.9), (film(), 1.1), (plate(), 1.0), (panel(), 1.0)] {
        let mut believed = surface.clone();
        believed.sheet.tension *= tension;
        believed.sheet.thickness *= 1.05;
        for (n, actuator) in believed.actuators.iter_mut().enumerate() {
            let angle = 2.4 * n as f64;
            let moved = Point::new(actuator.at.x + 2e-3 * angle.cos(), actuator.at.y + 2e-3 * angle.sin());
            actuator.at = believed.outline.nearest(moved);
        }
        let points = places(&surface, 4);
        let found = verified(&mut Truth::of(surface), &believed, &points, &points, &[1.0; 4]);
        println!("tension x {tension}: {}", said(&found));
        assert!(found.doubts.is_empty(), "{}", said(&found));
        assert!(matches!(found.model, Checked::Against { .. }), "{}", said(&found));
    }
}

#[test]
fn exchanged_recordings_and_copies_are_named() {
    let surface = film();
    let points = places(&surface, 4);
    let stood = [points[1], points[0], points[2], points[3]];
    let found = verified(&mut Truth::of(surface.clone()), &surface, &points, &stood, &[1.0; 4]);
    println!("{}", said(&found));
    let doubted: Vec<usize> = found.doubts.iter().flat_map(|d| d.points.clone()).collect();
    assert_eq!(doubted, [0, 1]);
    assert!(found.doubts.iter().all(|d| d.what.contains("exchanged")), "{}", said(&found));
    // Of two points alone, and with a probe that is late.
    let mut truth = Truth { probe: (3.0, 1e-3), ..Truth::of(surface.clone()) };
    let found = verified(&mut truth, &surface, &points[..2], &stood[..2], &[1.0; 2]);
    println!("{}", said(&found));
    assert_eq!(found.doubts.len(), 2, "{}", said(&found));
    assert!(found.doubts.iter().all(|d| d.what.contains("exchanged")), "{}", said(&found));
    // One file twice.
    let measured = truth.pairs();
    let one = truth.probed(&points[..1], &points[..1], &[1.0]);
    let mut twice = truth.probed(&points[..2], &points[..2], &[1.0; 2]);
    let data: Vec<f32> = (0..2).flat_map(|_| (0..8).flat_map(|a| one.response(a, 0).to_vec())).collect();
    twice = unripple_core::SampledResponses::new(
        twice.ports.clone(),
        twice.points.clone(),
        twice.conditions.clone(),
        twice.samples(),
        data,
    )
    .unwrap();
    for model in [true, false] {
        let options = VerifyOptions { model, ..VerifyOptions::default() };
        let found = check(&surface, &measured, &twice, &options).unwrap();
        println!("{}", said(&found));
        assert!(found.copies.len() == 1 && found.doubts.contains(&found.copies[0]), "{:?}", found.copies);
        assert!(
            found.doubts.iter().any(|d| d.what.contains("copy") && d.points == [0, 1]),
            "{}",
            said(&found)
        );
    }
}

/// Actuators on the axis are heard alike at points that mirror each other; one beside it tells them apart.
#[test]
fn points_that_mirror_each_other_are_no_copies() {
    let mut surface = film();
    for (actuator, y) in surface.actuators.iter_mut().take(4).zip([20.0, 50.0, 90.0, 120.0]) {
        actuator.at = Point::from_mm(75.0, y);
    }
    let points = [Point::from_mm(40.0, 60.0), Point::from_mm(110.0, 60.0)];
    let mut truth = Truth::of(surface.clone());
    let (measured, probed) = (truth.pairs(), truth.probed(&points, &points, &[1.0; 2]));
    let options = VerifyOptions { model: false, ..VerifyOptions::default() };
    let found = check(&surface, &measured, &probed, &options).unwrap();
    assert!(found.doubts.is_empty(), "{}", said(&found));
}

#[test]
fn a_probe_beside_its_place_is_told_how_far() {
    let surface = film();
    let points = places(&surface, 3);
    // A fifth of a wave is less than far, and most of what is heard there is not what the place does.
    for (off, doubtful) in [(10e-3, true), (5e-3, true), (3e-3, false), (1.5e-3, false)] {
        let mut stood = points.clone();
        stood[1].x += off;
        let found = verified(&mut Truth::of(surface.clone()), &surface, &points, &stood, &[1.0; 3]);
        println!("{off}: {}", said(&found));
        assert_eq!(found.doubts.iter().any(|d| d.points == [1]), doubtful, "{}", said(&found));
        assert_eq!(found.doubts.len(), usize::from(doubtful), "{}", said(&found));
        let told =
            found.doubts.iter().map(|d| &d.what).chain(&found.notes).any(|w| w.contains("to the right"));
        assert!(told, "{}", said(&found));
        if let Some((at, _)) = found.points[1].fits {
            assert!(at.distance(stood[1]) < 0.5e-3, "{at} {}", stood[1]);
        }
    }
}

#[test]
fn another_gain_or_sign_is_corrected_or_told() {
    let surface = film();
    let points = places(&surface, 4);
    for gain in [1.42, -1.0, 0.5] {
        let gains = [1.0, 1.0, gain, 1.0];
        let mut truth = Truth { probe: (250.0, 0.0), ..Truth::of(surface.clone()) };
        let found = verified(&mut truth, &surface, &points, &points, &gains);
        println!("{gain}: {}", said(&found));
        assert!(found.doubts.is_empty(), "{}", said(&found));
        let correction = found.points[2].correction.unwrap();
        assert!((correction * gain - 1.0).abs() < 0.05, "{correction}");
        assert!([0, 1, 3].iter().all(|p| found.points[*p].correction.is_none()));
        // Of two points none can be said to be right, unless one is as the sensors are.
        let found = verified(&mut truth, &surface, &points[1..3], &points[1..3], &gains[1..3]);
        assert_eq!(found.doubts.len(), 2, "{}", said(&found));
        let mut truth = Truth::of(surface.clone());
        let found = verified(&mut truth, &surface, &points[1..3], &points[1..3], &gains[1..3]);
        assert!(found.doubts.is_empty() && found.points[1].correction.is_some(), "{}", said(&found));
    }
}

#[test]
fn a_probe_on_an_actuators_channel_is_named() {
    let surface = film();
    let points = places(&surface, 2);
    let stood = [surface.actuators[2].at; 2];
    let found = verified(&mut Truth::of(surface.clone()), &surface, &points, &stood, &[1.0; 2]);
    println!("{}", said(&found));
    assert!(found.doubts.iter().filter(|d| d.what.contains("`a3`")).count() == 2, "{}", said(&found));
}

#[test]
fn the_probes_own_delay_is_found() {
    for (surface, delay) in [(film(), 1e-3), (plate(), 0.3e-3), (panel(), 5e-3), (film(), 0.1e-3)] {
        let points = places(&surface, 3);
        let mut truth = Truth { probe: (1.0, delay), ..Truth::of(surface.clone()) };
        let found = verified(&mut truth, &surface, &points, &points, &[1.0; 3]);
        println!("{}", said(&found));
        assert!(found.doubts.is_empty(), "{}", said(&found));
        let late = found.probe_delay.unwrap();
        println!("{late}");
        assert!((late - delay).abs() < 0.02 / surface.emission.band[1], "{late} {delay}");
    }
}

/// One channel that is wrong does not spoil the model for the others, and is named.
#[test]
fn sensors_on_wrong_channels_are_named() {
    let surface = film();
    let points = places(&surface, 2);
    type Change = dyn Fn(usize, usize, &[Vec<f64>]) -> Vec<f64>;
    let swap = |measured: &mut Measured, change: &Change| {
        let pairs = measured.pairs.as_mut().unwrap();
        let before = pairs.responses.clone();
        pairs.responses = (0..64).map(|n| change(n / 8, n % 8, &before)).collect();
    };
    let reversed = |driven: usize, heard: usize, all: &[Vec<f64>]| {
        let sign = if heard == 3 { -1.0 } else { 1.0 };
        all[driven * 8 + heard].iter().map(|x| sign * x).collect()
    };
    let swapped = |driven: usize, heard: usize, all: &[Vec<f64>]| {
        let from = match heard {
            1 => 5,
            5 => 1,
            other => other,
        };
        all[driven * 8 + from].clone()
    };
    let cases: [(&Change, &[&str]); 2] = [
        (&reversed, &["sensor of `a4` is reversed"]),
        (&swapped, &["sensor of `a2` records motion at `a6`", "sensor of `a6` records motion at `a2`"]),
    ];
    for (change, words) in cases {
        let mut truth = Truth::of(surface.clone());
        let (mut measured, probed) = (truth.pairs(), truth.probed(&points, &points, &[1.0; 2]));
        swap(&mut measured, change);
        let found = check(&surface, &measured, &probed, &VerifyOptions::default()).unwrap();
        println!("{}", said(&found));
        assert_eq!(found.doubts.len(), words.len(), "{}", said(&found));
        assert!(words.iter().all(|w| found.doubts.iter().any(|d| d.what.starts_with(w))), "{}", said(&found));
    }
}

/// Where nothing fits, nothing is checked, and that is said.
#[test]
fn without_a_model_the_answer_says_so() {
    let surface = film();
    let points = places(&surface, 2);
    let mut truth = Truth::of(panel());
    let (measured, mut probed) = (truth.pairs(), truth.probed(&points, &points, &[1.0; 2]));
    probed.points = points.clone();
    let mut believed = surface.clone();
    believed.actuators.truncate(6);
    let found = check(&believed, &measured, &probed, &VerifyOptions::default()).unwrap();
    println!("{}", said(&found));
    assert!(
        matches!(&found.model, Checked::Not { why } if why.contains("not explained")),
        "{}",
        said(&found)
    );
    assert!(found.points.is_empty() && found.doubts.is_empty());
}

/// A film with stray masses that its file does not know, probed all along its rim, where another place differs by little else than a gain.
#[test]
fn what_a_model_misses_beside_a_rim_is_no_other_place_and_no_other_gain() {
    let believed = kinds_bench::film(1500.0, |_| ActuatorKind::Force);
    let truth = Perturbation { seed: 7, ..Perturbation::default() }.truth(&believed).unwrap();
    let modal = kinds_bench::modal(&truth.surface, Some(2200.0), 1e-4);
    let actuators: Vec<Point> = truth.surface.actuators.iter().map(|a| a.at).collect();
    let heard = sample(&modal, &actuators, 4801);
    let signal = |n: usize| heard.response(n / 8, n % 8).iter().map(|v| f64::from(*v)).collect();
    let measured = Measured::pairs(48e3, (0..64).map(signal).collect(), 1e-3);
    let along = (1..20).map(|n| 7.5 * f64::from(n));
    let rim: Vec<Point> = along
        .flat_map(|mm| [(7.5, mm), (142.5, mm), (mm, 7.5), (mm, 142.5)])
        .map(|(x, y)| Point::from_mm(x, y))
        .collect();
    let found = check(&believed, &measured, &sample(&modal, &rim, 4801), &VerifyOptions::default()).unwrap();
    println!("{}", said(&found));
    assert!(found.doubts.is_empty(), "{}", said(&found));
    assert!(found.points.iter().all(|point| point.correction.is_none()), "{}", said(&found));
    // One in twenty may still be told to be a little off.
    assert!(found.notes.len() <= rim.len() / 20, "{}", said(&found));
}
