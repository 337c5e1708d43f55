//! What goes wrong on request goes wrong as told, and nothing else.

use std::sync::Arc;
use unripple_core::{Edge, Edges, Point};
use unripple_physics::Modes;
use unripple_physics::stepper::{FaultySurface, InjectedFaults, Reading, StepperOptions, VirtualSurface};

use crate::modes_common;

const FRAMES: usize = 64;
const BLOCKS: usize = 12;
const CHANNELS: usize = 3;

fn surface() -> VirtualSurface {
    let mut film = modes_common::film_with_actuators(&[(12.0, 31.0), (95.0, 137.0), (138.0, 44.0)]);
    film.outline.edges = Edges::All(Edge::Supported);
    let modes = Arc::new(Modes::solve(&film, 900.0, 1e-6).unwrap());
    VirtualSurface::of(&film, modes, &StepperOptions::default()).unwrap()
}

/// Drive of channel c at sample i of the whole run.
fn drive(c: usize, i: usize) -> f64 {
    ((i * (c + 2)) as f64 * 0.11).sin() * (1.0 + c as f64)
}

/// Sensors and one probe over the whole run, sample by sample for each channel.
fn run(faults: InjectedFaults, sent: impl Fn(usize, usize) -> f64) -> (Vec<Vec<f64>>, Vec<f64>, usize) {
    let mut surface = surface();
    surface.set_probes(&[(Point::from_mm(62.0, 90.0), Reading::Velocity)]).unwrap();
    let mut wrong = FaultySurface::new(surface, faults, FRAMES).unwrap();
    let (mut heard, mut probe) = (vec![Vec::new(); CHANNELS], Vec::new());
    for block in 0..BLOCKS {
        let planar: Vec<f64> =
            (0..CHANNELS * FRAMES).map(|n| sent(n / FRAMES, block * FRAMES + n % FRAMES)).collect();
        let (mut sensors, mut probes) = (vec![0.0; CHANNELS * FRAMES], vec![0.0; FRAMES]);
        wrong.process(FRAMES, &planar, &mut sensors, &mut probes).unwrap();
        heard.iter_mut().zip(sensors.chunks(FRAMES)).for_each(|(all, new)| all.extend(new));
        probe.extend(probes);
    }
    (heard, probe, wrong.lost())
}

fn none() -> InjectedFaults {
    InjectedFaults::default()
}

#[test]
fn nothing_goes_wrong_unasked() {
    let mut surface = surface();
    let planar: Vec<f64> = (0..CHANNELS * FRAMES).map(|n| drive(n / FRAMES, n % FRAMES)).collect();
    let mut sensors = vec![0.0; CHANNELS * FRAMES];
    surface.process(FRAMES, &planar, &mut sensors, &mut []).unwrap();
    let (heard, ..) = run(none(), drive);
    for (all, line) in heard.iter().zip(sensors.chunks(FRAMES)) {
        assert_eq!(&all[..FRAMES], line);
    }
}

#[test]
fn dead_and_swapped_channels_are_so_both_ways() {
    let (heard, probe, _) = run(InjectedFaults { dead: vec![1], ..none() }, drive);
    let (expected, same, _) = run(none(), |c, i| if c == 1 { 0.0 } else { drive(c, i) });
    assert!(heard[1].iter().all(|v| *v == 0.0));
    assert_eq!((&heard[0], &heard[2], probe), (&expected[0], &expected[2], same));

    let (heard, probe, _) = run(InjectedFaults { swapped: vec![(0, 2)], ..none() }, drive);
    let (expected, same, _) = run(none(), |c, i| drive(2 - c, i));
    assert_eq!((&heard[0], &heard[1], &heard[2], probe), (&expected[2], &expected[1], &expected[0], same));
}

#[test]
fn clipping_limits_the_drive() {
    let (_, clipped, _) = run(InjectedFaults { clip: Some(0.5), ..none() }, drive);
    let (_, expected, _) = run(none(), |c, i| drive(c, i).clamp(-0.5, 0.5));
    assert_eq!(clipped, expected);
}

#[test]
fn latency_makes_sensors_late_and_leaves_probes() {
    for late in [1, 17, 64, 200] {
        let (heard, probe, _) = run(InjectedFaults { latency: late, ..none() }, drive);
        let (expected, same, _) = run(none(), drive);
        assert_eq!(probe, same);
        assert!(heard[0][..late].iter().all(|v| *v == 0.0));
        assert_eq!(heard[0][late..], expected[0][..BLOCKS * FRAMES - late]);
    }
}

#[test]
fn noise_has_the_level_asked_for_and_one_seed_one_noise() {
    let noisy = InjectedFaults { noise: 0.3, ..none() };
    let (heard, probe, _) = run(noisy.clone(), |_, _| 0.0);
    let all: Vec<f64> = heard.concat();
    let rms = (all.iter().map(|v| v * v).sum::<f64>() / all.len() as f64).sqrt();
    assert!((rms / 0.3 - 1.0).abs() < 0.05, "{rms}");
    assert!(probe.iter().all(|v| *v == 0.0));
    assert_eq!(run(noisy.clone(), |_, _| 0.0).0, heard);
    assert_ne!(run(InjectedFaults { seed: 2, ..noisy }, |_, _| 0.0).0, heard);
}

#[test]
fn lost_blocks_are_lost_and_counted() {
    assert_eq!(run(InjectedFaults { dropped: 1.0, ..none() }, drive).2, BLOCKS);
    let (heard, _, lost) = run(InjectedFaults { dropped: 0.4, seed: 5, ..none() }, drive);
    let silent = heard[0].chunks(FRAMES).filter(|block| block.iter().all(|v| *v == 0.0)).count();
    assert!(lost > 0 && lost < BLOCKS);
    assert_eq!(silent, lost);
}

#[test]
fn tension_drifts_as_its_table_says() {
    let held = |factor: f64| {
        let mut surface = surface();
        surface.set_probes(&[(Point::from_mm(62.0, 90.0), Reading::Velocity)]).unwrap();
        surface.set_tension(factor).unwrap();
        let planar: Vec<f64> = (0..CHANNELS * FRAMES).map(|n| drive(n / FRAMES, n % FRAMES)).collect();
        let mut probe = vec![0.0; FRAMES];
        surface.process(FRAMES, &planar, &mut [], &mut probe).unwrap();
        probe
    };
    let table = vec![(0.0, 1.05), (1e3, 1.05)];
    assert_eq!(run(InjectedFaults { tension: table, ..none() }, drive).1[..FRAMES], held(1.05));
    assert_ne!(held(1.05), held(1.0));
}

#[test]
fn faults_that_cannot_be_are_refused() {
    let refused = |faults| FaultySurface::new(surface(), faults, FRAMES).unwrap_err().to_string();
    assert!(refused(InjectedFaults { dead: vec![3], ..none() }).contains("less than 3"));
    assert!(refused(InjectedFaults { dropped: 1.5, ..none() }).contains("between 0 and 1"));
    assert!(refused(InjectedFaults { noise: -1.0, ..none() }).contains("noise"));
    assert!(refused(InjectedFaults { tension: vec![(1.0, 1.0), (1.0, 1.1)], ..none() }).contains("later"));
    let mut wrong = FaultySurface::new(surface(), none(), FRAMES).unwrap();
    assert!(wrong.process(65, &[0.0; 195], &mut [], &mut []).is_err());
}
