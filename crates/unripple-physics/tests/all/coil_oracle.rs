//! What coils sense of the sheet and of themselves, against the closed solution of the coupled equations at one frequency.
//!
//! L di/dt + R i = V - bl·v and F = bl·i - m dv/dt at each coil, v = Y F with the modal sum Y: nothing of the stepper is in here.

use crate::stepper_common;
use unripple_linalg::{Lu, Mat, c64};

use std::f64::consts::{PI, TAU};
use stepper_common::*;
use unripple_core::*;
use unripple_physics::Circuit;
use unripple_physics::stepper::*;

const RATE: f64 = 48e3;
const MODES: usize = 16;
const SIGMA: f64 = 60.0;
const PLACES: [(f64, f64); 2] = [(31.0, 12.0), (120.0, 84.0)];
const PROBE: (f64, f64) = (62.0, 90.0);

/// Two coils alike but for their force constants, and the mass of the magnets.
fn coils(inductance: f64) -> [Circuit; 2] {
    [0.5, 0.8].map(|force_constant| Circuit { force_constant, resistance: 6.2, inductance })
}

fn surface(inductance: f64, mass: f64) -> VirtualSurface {
    let channels: Vec<Channel> =
        PLACES.iter().zip(coils(inductance)).map(|((x, y), circuit)| coil(*x, *y, mass, circuit)).collect();
    let mut surface =
        VirtualSurface::new(&membrane(MODES, SIGMA), &channels, RATE, &StepperOptions::default()).unwrap();
    surface.set_probes(&[(mm(PROBE.0, PROBE.1), Reading::Velocity)]).unwrap();
    surface
}

/// Both sensors and the probe per volt at the first coil, in a steady tone.
fn heard(inductance: f64, mass: f64, hz: f64) -> [c64; 3] {
    let frames = (0.3 * RATE) as usize;
    let period = (RATE / hz).round() as usize;
    let mut drive = vec![0.0; 2 * frames];
    (0..frames).for_each(|i| drive[i] = (TAU * hz * i as f64 / RATE).cos());
    let (sensors, probes) = run(&mut surface(inductance, mass), &drive);
    let tone = |plane: &[f64]| -> c64 {
        // The last periods, the beginning long died away.
        let last = plane.len() - 8 * period..plane.len();
        let turn = |i: usize| c64::new(0.0, -TAU * hz * i as f64 / RATE).exp();
        last.clone().map(|i| turn(i) * plane[i]).sum::<c64>() * (2.0 / last.len() as f64)
    };
    [tone(&sensors[..frames]), tone(&sensors[frames..]), tone(&probes)]
}

/// The same by the closed solution, and half of what an impulse makes heard at once, since the stepper's definition takes that
/// whole.
fn exact(inductance: f64, mass: f64, hz: f64) -> [c64; 3] {
    let s = c64::new(0.0, TAU * hz);
    let places = [mm(31.0, 12.0), mm(120.0, 84.0), mm(PROBE.0, PROBE.1)];
    let shapes = Sines(MODES);
    let rows = places.map(|at| {
        let mut row = vec![0.0; MODES];
        shapes.at(at, &mut row);
        row
    });
    let omega = |m: usize| {
        let (i, j) = ((m % 4 + 1) as f64, (m / 4 + 1) as f64);
        PI / SIDE * ((i * i + j * j) * 200.0 / 0.175).sqrt()
    };
    let between = |a: usize, b: usize| -> c64 {
        (0..MODES).map(|m| s * rows[a][m] * rows[b][m] / (s * s + s * (2.0 * SIGMA) + omega(m).powi(2))).sum()
    };
    let circuits = coils(inductance);
    let current = |c: usize| (s * circuits[c].inductance + circuits[c].resistance).inv();
    let hung = |c: usize| current(c) * circuits[c].force_constant.powi(2) + s * mass;
    // v = Y (F - Z v), F the force of the first coil at rest.
    let push = current(0) * circuits[0].force_constant;
    let system = Mat::from_fn(2, 2, |i, j| between(i, j) * hung(j) + if i == j { 1.0 } else { 0.0 });
    let right = Mat::from_fn(2, 1, |i, _| between(i, 0) * push);
    let mut moved = right.clone();
    Lu::new(system.as_ref()).solve(moved.as_mut());
    let probe = between(2, 0) * push - (0..2).map(|j| between(2, j) * hung(j) * moved[(j, 0)]).sum::<c64>();
    let sensed = [0, 1].map(|c| current(c) * circuits[c].force_constant * moved[(c, 0)]);
    let mut impulse = [0.0; 2];
    impulse[0] = RATE;
    let (at_once, probed) = run(&mut surface(inductance, mass), &impulse);
    let half = |value: f64| value / (2.0 * RATE);
    [sensed[0] + half(at_once[0]), sensed[1] + half(at_once[1]), probe + half(probed[0])]
}

#[test]
fn coils_hear_the_motion_alone_whatever_their_inductance() {
    for mass in [0.0, 7e-6] {
        // From a current that follows at once over one that takes about a sample to one that takes fifteen.
        for inductance in [0.0, 1e-9, 2e-6, 2e-5, 1.3e-4, 6e-4, 1.9e-3] {
            for hz in [250.0, 500.0, 1000.0] {
                let (found, exact) = (heard(inductance, mass, hz), exact(inductance, mass, hz));
                for (what, (found, exact)) in ["own", "other", "probe"].iter().zip(found.iter().zip(exact)) {
                    let ratio = found / exact;
                    let late = -ratio.arg() / (TAU * hz) * RATE;
                    println!(
                        "{mass:e} kg {inductance:e} H {hz} Hz {what}: {:.4}, {late:+.3} samples",
                        ratio.norm()
                    );
                    assert!((ratio.norm() - 1.0).abs() < 0.01 && late.abs() < 0.05);
                }
            }
        }
    }
}

#[test]
fn no_inductance_is_the_limit_of_little() {
    let response = |inductance: f64| {
        let mut drive = vec![0.0; 2 * 400];
        drive[0] = RATE;
        let (sensors, probes) = run(&mut surface(inductance, 7e-6), &drive);
        [sensors, probes].concat()
    };
    let none = response(0.0);
    for (inductance, most) in [(1e-7, 5e-3), (1e-9, 5e-5), (1e-12, 1e-7)] {
        let off = apart(&response(inductance), &none);
        println!("{inductance:e} H: {off:e}");
        assert!(off < most, "{inductance:e} H: {off:e}");
    }
}
