//! The true surface that differs from its model: by how much, and with how much noise.

mod common;

use common::*;
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_devices::*;

#[test]
fn a_truth_is_off_by_what_was_asked() {
    let surface = film(3000.0);
    let unknowns = Perturbation { actuator_mass: 5e-6, ..Default::default() };
    let truth = unknowns.truth(&surface).unwrap();
    assert_eq!(truth, unknowns.truth(&surface).unwrap());
    for (there, said) in truth.surface.actuators.iter().zip(&surface.actuators) {
        assert!((there.at.distance(said.at) - 1e-3).abs() < 1e-12);
    }
    let (low, high) = truth.surface.sheet.uneven.tension.as_ref().unwrap().range();
    assert!(
        (low.min(2.0 - high) - 0.99).abs() < 1e-12 && (0.99..1.01).contains(&low) && high <= 1.01 + 1e-12
    );
    assert_eq!(truth.surface.sheet.uneven.scatterers.len(), 10);
    let Decay::Table(table) = &truth.surface.sheet.decay else { panic!() };
    assert_eq!((table[0], table[3].0), ((0.0, 1.15 * 0.07), 3000.0));
    let many: Vec<f64> = (0..200)
        .flat_map(|seed| Perturbation { seed, ..Default::default() }.truth(&surface).unwrap().drive_gains)
        .map(|gain| gain - 1.0)
        .collect();
    assert!((rms(&many) / 0.005 - 1.0).abs() < 0.1);
}

#[test]
fn nothing_unknown_is_the_surface_itself() {
    let surface = film(3000.0);
    let none = Perturbation {
        gain: 0.0,
        misplacement: 0.0,
        tension: 0.0,
        decay: vec![],
        masses: vec![],
        ..Default::default()
    };
    let truth = none.truth(&surface).unwrap();
    assert_eq!((truth.surface, truth.drive_gains), (surface, vec![1.0; 8]));
    let refused = |unknowns: Perturbation| unknowns.truth(&film(3000.0)).unwrap_err().to_string();
    assert!(refused(Perturbation { tension: 1.5, ..none.clone() }).contains("tension"));
    assert!(refused(Perturbation { masses: vec![-1.0], ..none.clone() }).contains("mass"));
    assert!(refused(Perturbation { decay: vec![(0.5, 1.0), (0.2, 1.0)], ..none }).contains("ascending"));
}

/// A plate with a loss factor rings the longer the lower the mode: a straight line from nothing to the middle of the band made it ring for
/// ten seconds.
#[test]
fn another_law_of_damping_follows_the_nominal_one() {
    let mut plate = film(2000.0);
    plate.sheet.tension = 0.0;
    plate.sheet.thickness = 0.012;
    plate.sheet.decay = Decay::LossFactor(0.02);
    let factor = |share: f64| if share < 0.3 { 1.15 - 0.5 * share } else { 1.0 - 0.375 * (share - 0.3) };
    let Decay::Table(table) = Perturbation::default().truth(&plate).unwrap().surface.sheet.decay else {
        panic!()
    };
    let at = |hz: f64| {
        let after = table.partition_point(|(f, _)| *f <= hz);
        let ((f0, t0), (f1, t1)) = (table[after - 1], table[after]);
        t0 + (t1 - t0) * (hz - f0) / (f1 - f0)
    };
    for hz in [20.0, 55.0, 130.0, 340.0, 590.0, 900.0, 1390.0] {
        // On a plate all is bending: τ = 2/(η ω).
        let exact = factor(hz / 2000.0) * 2.0 / (0.02 * TAU * hz);
        assert!((at(hz) / exact - 1.0).abs() < 2e-3, "{hz} Hz: {} s, {exact} s", at(hz));
    }
}

/// A sweep over the band at the drive limit, heard over its length and ringing.
fn sweep(top: f64, samples: usize) -> impl Fn(usize) -> f64 {
    let (start, end) = (50.0, top);
    move |i| {
        let t = i as f64 / 48e3;
        let duration = samples as f64 / 48e3;
        (TAU * (start * t + (end - start) * t * t / (2.0 * duration))).sin()
    }
}

#[test]
fn signal_to_noise_under_a_sweep_is_what_was_asked() {
    let truth = Perturbation { seed: 3, ..Default::default() }.truth(&film(1500.0)).unwrap();
    let modes = truth.modes(None).unwrap();
    let options = VirtualOptions { accuracy: 1e-4.into(), ..Default::default() };
    let (mut sensors, mut probe) = (Vec::new(), Vec::new());
    for actuator in 0..8 {
        let mut device = Virtual::of_truth_with_modes(&truth, modes.clone(), &options).unwrap();
        let at = [(50.0, 60.0), (90.0, 80.0), (70.0, 110.0), (110.0, 45.0)][actuator % 4];
        device.handle().move_probe(Point::from_mm(at.0, at.1)).unwrap();
        let play_on = sweep(1500.0, 24_000);
        let heard = play(&mut device, 24_000, |o, i| if o == actuator { play_on(i) } else { 0.0 });
        sensors.extend(heard[..8].iter().map(|line| rms(line)));
        probe.push(rms(&heard[8]));
    }
    let noise = truth.noise(&modes);
    let db = |lines: &[f64], noise: f64| 20.0 * (rms(lines) / noise).log10();
    let found = [db(&sensors, noise.0), db(&probe, noise.1)];
    println!("signal to noise {found:?} dB, noise {noise:?} m/s");
    assert!(found.iter().all(|db| (db - 50.0).abs() < 2.0), "{found:?}");
    // And that noise is there.
    let mut device = Virtual::of_truth_with_modes(&truth, modes.clone(), &options).unwrap();
    let heard = play(&mut device, 24_000, silence);
    assert!((rms(&heard[3]) / noise.0 - 1.0).abs() < 0.05);
    assert!((rms(&heard[8]) / noise.1 - 1.0).abs() < 0.05);
}
