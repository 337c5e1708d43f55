//! Each fault of a wire is found, on a surface that is not the model.

mod common;

use common::*;
use std::sync::{Arc, OnceLock};
use unripple_core::*;
use unripple_devices::*;
use unripple_physics::stepper::InjectedFaults;
use unripple_physics::{Modes, ResponseOptions, responses};

const PROBE_AT: Point = Point::new(0.062, 0.090);

/// How late a truth may seem that is slower than its model, in samples: two masses of 20 mg on 3.94 g of film take 0.5 % of
/// all frequencies, 50 µs of the 10 ms that a window of 20 ms is old on average.
const OFF: f64 = 0.5 * 40e-6 / 3.94e-3 * 10e-3 * 48e3;

/// The true surface, its modes, and what the model says.
fn known() -> &'static (Truth, Arc<Modes>, Expected) {
    static KNOWN: OnceLock<(Truth, Arc<Modes>, Expected)> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let surface = film(1500.0);
        let truth = Perturbation { seed: 5, ..Default::default() }.truth(&surface).unwrap();
        let modes = truth.modes(None).unwrap();
        let options = ResponseOptions { accuracy: 1e-4.into(), ..Default::default() };
        let Ok(Responses::Modal(model)) = responses(&surface, &options) else { panic!() };
        (truth, modes, Expected::of_modes(&model, Some(PROBE_AT), 0.02))
    })
}

fn found(faults: InjectedFaults, interface: Interface) -> WiringReport {
    let (truth, modes, expected) = known();
    let options = VirtualOptions { probe: Some(PROBE_AT), faults, interface, ..Default::default() };
    let mut device = Virtual::of_truth_with_modes(truth, modes.clone(), &options).unwrap();
    check_wiring(&mut device, expected, &WiringOptions::for_band([0.0, 3e3])).unwrap()
}

fn faults(faults: InjectedFaults, interface: Interface) -> Vec<String> {
    found(faults, interface).faults()
}

fn gains(count: usize, changed: &[(usize, f64)]) -> Vec<f64> {
    let mut gains = vec![1.0; count];
    changed.iter().for_each(|(at, gain)| gains[*at] = *gain);
    gains
}

#[test]
fn right_wires_are_right_and_latency_is_found() {
    for latency in [0.0, 1500.0] {
        let report = found(InjectedFaults::default(), Interface { latency, ..Default::default() });
        assert!(report.is_right(), "{report}");
        assert!((report.latency as f64 - latency).abs() <= OFF);
        let least = report.outputs.iter().chain(&report.inputs).map(|l| l.likeness).fold(1.0, f64::min);
        println!("least likeness {least:.3}");
        // Well above the 0.5 below which a channel counts as unlike its model.
        assert!(least > 0.7);
    }
}

#[test]
fn where_the_model_holds_latency_is_exact() {
    let (_, _, expected) = known();
    let interface = Interface { latency: 431.0, ..Default::default() };
    let options =
        VirtualOptions { probe: Some(PROBE_AT), interface, accuracy: 1e-4.into(), ..Default::default() };
    let mut device = Virtual::new(&film(1500.0), &options).unwrap();
    let report = check_wiring(&mut device, expected, &WiringOptions::for_band([0.0, 3e3])).unwrap();
    assert!(report.is_right() && report.latency == 431, "{report:?}");
}

#[test]
fn a_dead_channel_is_silent() {
    let dead = InjectedFaults { dead: vec![2, 6], ..Default::default() };
    assert_eq!(faults(dead, Interface::default()), ["actuator `a3` is silent", "actuator `a7` is silent"]);
    let deaf = Interface { heard_gains: gains(9, &[(8, 0.0)]), ..Default::default() };
    assert_eq!(faults(InjectedFaults::default(), deaf), ["input `probe` is silent"]);
    let mute = Interface { drive_gains: gains(8, &[(1, 0.0)]), ..Default::default() };
    assert_eq!(faults(InjectedFaults::default(), mute), ["output `a2` is silent"]);
}

/// At a ratio of signal to noise at which sweeps measure well, a single burst is hardly heard.
#[test]
fn what_is_in_the_noise_is_listened_for_again() {
    let (truth, modes, expected) = known();
    for (snr_db, gain) in [(40.0, 0.2), (30.0, 0.6)] {
        let noisy = Truth { snr_db, ..truth.clone() };
        // A drive that is weaker than the others, and a sensor that is dead.
        let interface = Interface { drive_gains: gains(8, &[(2, gain)]), ..Default::default() };
        let interface = Interface { heard_gains: gains(9, &[(5, 0.0)]), ..interface };
        let options = VirtualOptions { probe: Some(PROBE_AT), interface, ..Default::default() };
        let mut device = Virtual::of_truth_with_modes(&noisy, modes.clone(), &options).unwrap();
        let report = check_wiring(&mut device, expected, &WiringOptions::for_band([0.0, 3e3])).unwrap();
        println!("{snr_db} dB: {report}");
        assert_eq!(report.faults(), ["input `a6` is silent"], "{snr_db} dB: {report}");
    }
}

#[test]
fn swapped_channels_are_told_apart() {
    let swapped = InjectedFaults { swapped: vec![(0, 4), (2, 3)], ..Default::default() };
    let told: Vec<String> = [("a1", "a5"), ("a3", "a4"), ("a4", "a3"), ("a5", "a1")]
        .iter()
        .map(|(from, to)| format!("actuator `{from}` is wired to `{to}`"))
        .collect();
    assert_eq!(faults(swapped, Interface::default()), told);
    // Three in a ring.
    let ring = InjectedFaults { swapped: vec![(0, 1), (1, 2)], ..Default::default() };
    // The drive's wires go round one way, the sensors' the other.
    let expected = [
        "output `a1` is wired to `a3`",
        "input `a1` is wired to `a2`",
        "output `a2` is wired to `a1`",
        "input `a2` is wired to `a3`",
        "output `a3` is wired to `a2`",
        "input `a3` is wired to `a1`",
    ];
    assert_eq!(faults(ring, Interface::default()), expected);
}

#[test]
fn reversed_channels_are_told_by_side() {
    let both = Interface {
        drive_gains: gains(8, &[(3, -1.0), (5, -1.0)]),
        heard_gains: gains(9, &[(3, -1.0), (7, -1.0)]),
        ..Default::default()
    };
    let expected = ["actuator `a4` is reversed", "output `a6` is reversed", "input `a8` is reversed"];
    assert_eq!(faults(InjectedFaults::default(), both), expected);
}

#[test]
fn all_at_once() {
    let faults = InjectedFaults { dead: vec![7], swapped: vec![(1, 5)], ..Default::default() };
    let interface = Interface { drive_gains: gains(8, &[(0, -1.0)]), latency: 700.0, ..Default::default() };
    let report = found(faults, interface);
    let expected = [
        "output `a1` is reversed",
        "actuator `a2` is wired to `a6`",
        "actuator `a6` is wired to `a2`",
        "actuator `a8` is silent",
    ];
    assert_eq!(report.faults(), expected);
    assert!((report.latency as f64 - 700.0).abs() <= OFF);
}

#[test]
fn another_surface_answers_otherwise() {
    let (_, _, expected) = known();
    let mut other = film(1500.0);
    other.sheet.tension = 90.0;
    let mut device = Virtual::new(&other, &VirtualOptions::default()).unwrap();
    let report = check_wiring(&mut device, expected, &WiringOptions::default()).unwrap();
    assert!(report.faults().iter().any(|fault| fault.contains("does not answer as the model says")));
    let lost = Interface { vanish_after: Some(20), ..Default::default() };
    let mut device = Virtual::new(&other, &VirtualOptions { interface: lost, ..Default::default() }).unwrap();
    assert!(check_wiring(&mut device, expected, &WiringOptions::default()).is_err());
    let options = WiringOptions { frequency: 30e3, ..Default::default() };
    assert!(check_wiring(&mut device, expected, &options).unwrap_err().to_string().contains("frequency"));
}
