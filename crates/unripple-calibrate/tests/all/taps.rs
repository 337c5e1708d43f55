//! Taps beside stray masses, taps that bounce, and taps that are hardly heard, with a model fitted to the responses between actuators.

use crate::measured_bench;

use measured_bench::*;
use std::sync::LazyLock;
use unripple_calibrate::measure::*;
use unripple_calibrate::signals::Band;
use unripple_calibrate::{FitOptions, Measured, Verdict, fit};
use unripple_core::{Device, Point, Responses};
use unripple_devices::{Interface, Perturbation, Tap, VirtualOptions};
use unripple_physics::sample;

/// The paper's film with masses of 20 mg at (42.4, 83.6) and (26.4, 96.6) mm.
static FILM: LazyLock<World> =
    LazyLock::new(|| World::new(&Perturbation { seed: 7, ..Perturbation::default() }));

/// A point of the grid of 7.5 mm, from 1 to 361, which also numbers its taps.
fn place(number: usize) -> Point {
    let along = |n: usize| 7.5 * (n + 1) as f64;
    Point::from_mm(along((number - 1) % 19), along((number - 1) / 19))
}

/// Whether one of the two taps at a point bounces more than 2.5 ms later.
fn bounces(number: usize) -> bool {
    (0..2).any(|attempt| Tap::random(number as u64 * 10 + attempt, 48e3).force().len() > 120)
}

/// Gains of the device, and what the calibration is told of them.
#[derive(Default)]
struct Cables {
    interface: Interface,
    scales: Option<Vec<f64>>,
    without: Vec<usize>,
}

/// Share, as amplitude, that differs between measured responses at a place and the true ones but for a gain and a delay; the first
/// millisecond holds what the band takes from the onset.
fn off(world: &World, at: Point, found: &[Vec<f64>], without: &[usize]) -> f64 {
    let Responses::Modal(plant) = &world.plant else { panic!() };
    let samples = found[0].len();
    let real = sample(plant, &[at], samples);
    let like = |late: i32| {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (a, response) in found.iter().enumerate().filter(|(a, _)| !without.contains(a)) {
            for i in 48..samples - 100 {
                let (x, y) = (f64::from(real.response(a, 0)[i]), response[(i as i32 + late) as usize]);
                (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
            }
        }
        xy / (xx * yy).sqrt()
    };
    let best = (-48..48).map(like).fold(-1.0, f64::max);
    (1.0 - best * best).sqrt()
}

/// Two taps at each of some points, as [`off`].
fn tapped(world: &World, fitted: bool, numbers: &[usize], cables: Cables) -> Vec<f64> {
    let Cables { interface, scales, without } = cables;
    let device = world.device_with(&VirtualOptions { interface, ..VirtualOptions::default() });
    let layout = device.layout().clone();
    let wires = Wires::by_name(&world.ports(), &layout, &[]).unwrap();
    let probe = world.session(&device, &MeasureOptions::default());
    let handle = device.handle();
    let mut rig = Hands::new(device, handle);
    let options = MeasureOptions { repeats: 2, without: without.clone(), ..MeasureOptions::default() };
    let scales = scales.unwrap_or(vec![1.0; 8]);
    let mut session =
        TapSession::new(&world.surface, &layout, &wires, world.model.clone(), &options).unwrap();
    session = session.by_scales(scales.clone());
    if fitted {
        let middle = Point::from_mm(75.0, 75.0);
        let sensors = probe.measure(&mut rig, 0, middle, 2, Listen::Sensors).unwrap();
        let pair = |drive: usize, sensor: usize| match without.contains(&drive) || without.contains(&sensor) {
            true => Vec::new(),
            false => sensors[sensor].responses[drive].iter().map(|h| scales[sensor] * h).collect(),
        };
        let pairs = (0..64).map(|n| pair(n / 8, n % 8)).collect();
        let [from, to] = options.swept(&world.surface);
        let measured = Measured::pairs(48e3, pairs, 1e-3).limited_to(Band::within(from, to));
        let fitted = fit(&world.surface, &measured, &FitOptions::default()).unwrap();
        assert_eq!(fitted.verdict, Verdict::Good);
        session = session.by_fitted(&fitted);
    }
    let mut all = Vec::new();
    for number in numbers {
        let at = place(*number);
        let channel = session.measure(&mut rig, *number, at, 0).unwrap();
        all.push(off(world, at, &channel.responses, &without));
        let share = world.share(&world.sampled(&[at], std::slice::from_ref(&channel)), at);
        println!(
            "point {number} at {at}: off by {:.3}, {:.1} % of the contrast",
            all[all.len() - 1],
            100.0 * share
        );
    }
    all
}

#[test]
fn beside_a_mass_and_with_bounces_responses_are_right() {
    let beside = [196, 231, 194, 215, 191];
    let bouncing = [158, 195, 214, 236];
    assert!(bouncing.into_iter().all(bounces));
    let found = tapped(&FILM, true, &[&beside[..], &bouncing[..]].concat(), Cables::default());
    assert!(found.iter().all(|off| *off < 0.13), "{found:?}");
}

/// Before weak taps, noise reaches a tenth of the peak at some sensor.
#[test]
fn weak_taps_do_not_begin_in_the_noise() {
    let found = tapped(&FILM, false, &[240, 215], Cables::default());
    assert!(found.iter().all(|off| *off < 0.5), "{found:?}");
}

/// A sensor with another gain than its actuator's drive tells the response of the drive all the same.
#[test]
fn gains_of_sensors_are_not_those_of_drives() {
    let world = World::new(&Perturbation { gain: 0.15, ..Perturbation::default() });
    let found = tapped(&world, true, &[100, 150, 191], Cables::default());
    assert!(found.iter().all(|off| *off < 0.13), "{found:?}");
}

/// One actuator is dead with its sensor, whose input hums; another's sensor has a reversed and louder input, as the calibration is told.
#[test]
fn dead_actuators_and_scales_of_inputs_are_heeded() {
    let interface = |heard: f64| {
        let (mut drive_gains, mut heard_gains) = (vec![1.0; 8], vec![1.0; 9]);
        (drive_gains[4], heard_gains[4], heard_gains[1]) = (0.0, 0.0, heard);
        let noise = (0..9).map(|input| if input == 4 { 0.02 } else { 0.0 }).collect();
        Interface { drive_gains, heard_gains, noise, ..Interface::default() }
    };
    let mut scales = vec![1.0; 8];
    scales[1] = -1.0 / 3.0;
    let told = || Cables { interface: interface(-3.0), scales: Some(scales.clone()), without: vec![4] };
    let found = tapped(&FILM, true, &[100, 196], told());
    assert!(found.iter().all(|off| *off < 0.13), "{found:?}");
    let plain = Cables { interface: interface(1.0), scales: None, without: vec![4] };
    let [found, expected] = [told(), plain].map(|cables| tapped(&FILM, false, &[100, 196], cables));
    assert!(
        found.iter().zip(&expected).all(|(one, other)| (one - other).abs() < 0.03),
        "{found:?} {expected:?}"
    );
}
