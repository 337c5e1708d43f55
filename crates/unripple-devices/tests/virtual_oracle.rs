//! The virtual device against the responses of its surface.

mod common;

use common::*;
use unripple_core::*;
use unripple_devices::*;
use unripple_physics::stepper::InjectedFaults;
use unripple_physics::{ResponseOptions, responses, sample};

const SAMPLES: usize = 900;

fn options() -> VirtualOptions {
    VirtualOptions { block: 64, ..Default::default() }
}

fn device(options: &VirtualOptions) -> Virtual {
    Virtual::new(&film(900.0), options).unwrap()
}

/// Responses of the actuators at a point, per unit impulse.
fn exact(at: Point) -> Vec<Vec<f64>> {
    let Ok(Responses::Modal(modal)) = responses(&film(900.0), &ResponseOptions::default()) else { panic!() };
    let sampled = sample(&modal, &[at], SAMPLES);
    (0..8).map(|a| sampled.response(a, 0).iter().map(|x| f64::from(*x)).collect()).collect()
}

fn impulse(channel: usize) -> impl Fn(usize, usize) -> f64 {
    move |output, i| if (output, i) == (channel, 0) { 0.5 } else { 0.0 }
}

#[test]
fn sensors_and_probe_hear_the_responses() {
    let at = Point::from_mm(62.0, 90.0);
    let mut device = device(&VirtualOptions { probe: Some(at), ..options() });
    assert_eq!(device.layout().full_scale, 2.0);
    let heard = play(&mut device, SAMPLES, impulse(4));
    // Half of a full scale of 2 N, over one sample.
    let scaled = |h: &[f64]| h.iter().map(|x| x / 48e3).collect::<Vec<_>>();
    assert!(apart(&heard[8], &scaled(&exact(at)[4])) < 1e-5);
    let there = (9.0, 84.0);
    assert!(apart(&heard[1], &scaled(&exact(Point::from_mm(there.0, there.1))[4])) < 1e-5);
    assert_eq!(device.status(), Status { state: State::Running, blocks: 15, ..Status::default() });
}

#[test]
fn a_tap_is_heard_by_reciprocity_and_taps_superpose() {
    let (here, there) = (Point::from_mm(62.0, 90.0), Point::from_mm(20.0, 33.0));
    let force = [0.3, 1.0, 0.7];
    let mut both = device(&VirtualOptions { taps: 2, ..options() });
    let handle = both.handle();
    handle.tap(&Tap::new(force.to_vec()), here, 10.0 / 48e3).unwrap();
    handle.tap(&Tap::new(vec![2.0]), there, 100.0 / 48e3).unwrap();
    let heard = play(&mut both, SAMPLES, silence);
    let (near, far) = (exact(here), exact(there));
    for a in 0..8 {
        let late = |h: &[f64], i: usize, by: usize| i.checked_sub(by).map_or(0.0, |i| h[i] / 48e3);
        let expected: Vec<f64> = (0..SAMPLES)
            .map(|i| {
                let pulse: f64 = (0..3).map(|k| force[k] * late(&near[a], i, 10 + k)).sum();
                pulse + 2.0 * late(&far[a], i, 100)
            })
            .collect();
        assert!(apart(&heard[a], &expected) < 1e-5, "{a}");
    }
}

#[test]
fn taps_one_after_the_other_share_a_slot_and_more_at_once_are_refused() {
    let device = device(&options());
    let (handle, tap) = (device.handle(), Tap::half_sine(1.0, 1e-3, 48e3));
    let at = Point::from_mm(70.0, 70.0);
    handle.tap(&tap, at, 0.0).unwrap();
    assert!(matches!(handle.tap(&tap, at, 1e-3), Err(DevicesError::Taps { most: 1 })));
    handle.tap(&tap, Point::from_mm(30.0, 70.0), 10e-3).unwrap();
    assert!(handle.tap(&tap, at, -1.0).is_err());
    assert!(handle.tap(&tap, Point::new(f64::NAN, 0.0), 1.0).is_err());
}

#[test]
fn an_interface_scales_reverses_and_delays() {
    let interface = Interface {
        drive_gains: vec![-0.5; 8],
        heard_gains: (0..9).map(|i| 1.0 + f64::from(i)).collect(),
        latency: 37.0,
        ..Default::default()
    };
    let plain = play(&mut device(&options()), SAMPLES, impulse(2));
    let heard = play(&mut device(&VirtualOptions { interface, ..options() }), SAMPLES, impulse(2));
    for i in 0..9 {
        assert!(heard[i][..37].iter().all(|x| *x == 0.0));
        let expected: Vec<f64> =
            plain[i][..SAMPLES - 37].iter().map(|x| -0.5 * (1.0 + i as f64) * x).collect();
        assert!(apart(&heard[i][37..], &expected) < 1e-5, "{i}");
    }
}

#[test]
fn a_device_that_vanishes_is_lost_for_good() {
    let interface = Interface { vanish_after: Some(3), ..Default::default() };
    let mut device = device(&VirtualOptions { interface, ..options() });
    let mut block = || device.exchange(&[0.0; 8 * 64], &mut [0.0; 9 * 64]);
    (0..3).for_each(|_| block().unwrap());
    for _ in 0..2 {
        assert_eq!(block().unwrap_err().to_string(), "device `virtual` is lost: it vanished after 3 blocks");
    }
    assert!(matches!(device.status().state, State::Lost(_)));
    assert_eq!(device.status().blocks, 3);
}

#[test]
fn lost_blocks_are_silent_at_the_probe_too_and_counted() {
    let faults = InjectedFaults { dropped: 0.3, seed: 4, ..Default::default() };
    let mut device = device(&VirtualOptions { faults, ..options() });
    let heard = play(&mut device, 64 * 40, |o, i| ((i + o) as f64 * 0.1).sin());
    let silent = heard[8].chunks(64).filter(|block| block.iter().all(|x| *x == 0.0)).count() as u64;
    assert!(silent > 3);
    assert_eq!(device.status().lost, silent);
}

#[test]
fn clipping_is_of_the_drive_and_not_of_taps() {
    let faults = InjectedFaults { clip: Some(0.1), ..Default::default() };
    let clipped = device(&VirtualOptions { faults, ..options() });
    let (mut clipped, mut plain) = (clipped, device(&options()));
    let at = Point::from_mm(80.0, 33.0);
    for device in [&clipped, &plain] {
        device.handle().tap(&Tap::new(vec![5.0; 20]), at, 0.0).unwrap();
    }
    let expected = play(&mut plain, SAMPLES, |_, i| (i as f64 * 0.03).sin().clamp(-0.05, 0.05));
    let found = play(&mut clipped, SAMPLES, |_, i| (i as f64 * 0.03).sin());
    assert!(apart(&found[8], &expected[8]) < 1e-5);
}

#[test]
fn fingers_and_probe_are_reached_from_outside() {
    let mut device = device(&options());
    let (handle, free) = (device.handle(), Point::from_mm(62.0, 90.0));
    handle.move_probe(free).unwrap();
    let heard = play(&mut device, SAMPLES, impulse(0));
    assert!(apart(&heard[8], &exact(free)[0].iter().map(|x| x / 48e3).collect::<Vec<_>>()) < 1e-5);
    handle.touch(7, &Contact { at: free, finger: Finger::default() }).unwrap();
    handle.move_finger(7, Point::from_mm(60.0, 88.0)).unwrap();
    let under = play(&mut device, SAMPLES, impulse(0));
    assert!(rms(&under[8][400..]) < 0.5 * rms(&heard[8][400..]));
    assert!(handle.finger_motion(7).is_some());
    handle.lift(7).unwrap();
    assert!(handle.lift(7).is_err());
    assert_eq!(handle.samples(), 2 * 15 * 64);
}

#[test]
fn what_cannot_be_is_refused() {
    let refused = |options: VirtualOptions| Virtual::new(&film(300.0), &options).unwrap_err().to_string();
    let of = |interface: Interface| refused(VirtualOptions { interface, ..options() });
    assert!(refused(VirtualOptions { block: 0, ..options() }).contains("block"));
    assert!(of(Interface { noise: vec![1.0; 8], ..Default::default() }).contains("expected 9, found 8"));
    assert!(of(Interface { latency: 3.5, ..Default::default() }).contains("at least 24"));
    assert!(of(Interface { drive_gains: vec![f64::NAN; 8], ..Default::default() }).contains("finite"));
    let spare = InjectedFaults { dead: vec![8], ..Default::default() };
    assert!(refused(VirtualOptions { faults: spare, ..options() }).contains("less than 8"));
}

#[test]
fn a_surface_that_begins_anew_does_the_same_again() {
    let interface = Interface { noise: vec![1e-3; 9], ..Interface::default() };
    let mut device = device(&VirtualOptions { interface, ..options() });
    let handle = device.handle();
    let mut run = |seed: u64| {
        handle.rest(seed);
        handle.tap(&Tap::random(seed, 48e3), Point::from_mm(40.0, 50.0), 1e-3).unwrap();
        play(&mut device, 256, impulse(3))
    };
    let (first, other) = (run(1), run(2));
    assert!(first != other && first == run(1));
}

#[test]
fn what_is_watched_is_the_displacement_of_the_responses() {
    let (here, there) = (Point::from_mm(62.0, 90.0), Point::from_mm(20.0, 33.0));
    let mut device = device(&options());
    let handle = device.handle();
    handle.watch(&[here, there], 2).unwrap();
    play(&mut device, SAMPLES, impulse(4));
    let seen = handle.watched();
    for (trace, at) in seen.iter().zip([here, there]) {
        // Half of a full scale of 2 N over one sample; velocity summed by the trapezium rule is displacement.
        let velocity: Vec<f64> = exact(at)[4].iter().map(|h| h / 48e3).collect();
        let mut moved = 0.0;
        let mut summed = vec![0.0];
        for pair in velocity.windows(2) {
            moved += 0.5 * (pair[0] + pair[1]) / 48e3;
            summed.push(moved);
        }
        let summed: Vec<f64> = summed.into_iter().step_by(2).collect();
        let trace: Vec<f64> = trace.iter().take(summed.len()).map(|u| f64::from(*u)).collect();
        assert!(apart(&trace, &summed) < 0.01, "{}", apart(&trace, &summed));
    }
    // Traces go on where the places move, and a probe stays where it is.
    handle.move_probe(here).unwrap();
    handle.move_watched(&[there, here]).unwrap();
    let heard = play(&mut device, 64, silence);
    assert_eq!(handle.watched()[1].len(), device.layout().block.div_ceil(2));
    assert!(heard[8].iter().any(|v| *v != 0.0));
    assert!(handle.move_watched(&[here]).is_err());
    // What cannot be moved leaves all as it was.
    let nowhere = Point::new(f64::NAN, 0.0);
    assert!(handle.move_watched(&[here, nowhere]).is_err() && handle.move_probe(nowhere).is_err());
    play(&mut device, 64, silence);
    assert!(handle.watched().iter().all(|trace| trace.iter().any(|u| *u != 0.0)));
}
