//! Truth: modes of a plate with a mass or a coil on it, from the secular equation in Navier's double series, which shares nothing with
//! the program.

use crate::modes_common;

use modes_common::edges;
use std::f64::consts::{PI, TAU};
use unripple_core::*;
use unripple_physics::*;

const SIDES: [f64; 2] = [0.3, 0.2];
const AT: [f64; 2] = [0.11, 0.043];
const RADIUS: f64 = 4e-3;
const MASS: f64 = 6e-3;

/// A supported plate of 1 mm of glass with one magnet in a coil on it, in a band up to 1 kHz.
fn plate(driven_by: CoilDrive, moving_mass: f64) -> Surface {
    let mut surface = modes_common::film(edges("ssss"));
    surface.outline.shape = Shape::Rectangle { width: SIDES[0], height: SIDES[1] };
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.poisson) = (70e9, 2500.0, 0.22);
    (sheet.thickness, sheet.tension, sheet.decay) = (1e-3, 0.0, Decay::Time(10.0));
    surface.emission.band = [0.0, 1000.0];
    let kind = ActuatorKind::MovingMagnet {
        force_constant: 0.5,
        resistance: 5.0,
        inductance: 0.0,
        moving_mass,
        driven_by,
    };
    let at = Point::new(AT[0], AT[1]);
    surface.actuators = vec![Actuator { name: "a1".into(), at, kind, contact_radius: RADIUS }];
    surface
}

/// Average of a plane wave over a disc, 2 J1(x)/x, by its power series: Σ (-x²/4)^k / (k! (k+1)!).
fn disc(x: f64) -> f64 {
    let mut term = 1.0;
    let mut sum = 1.0;
    for k in 1..80 {
        term *= -0.25 * x * x / (f64::from(k) * f64::from(k + 1));
        sum += term;
    }
    sum
}

/// Angular frequencies (rad/s) and shapes averaged over the disc of the contact (1/√kg), for modes of up to `most` half waves a side.
fn series(most: usize) -> Vec<(f64, f64)> {
    let (rho_h, stiffness) = (2.5, 70e9 * 1e-9 / (12.0 * (1.0 - 0.22 * 0.22)));
    let modes = (1..=most).flat_map(|m| (1..=most).map(move |n| (m as f64, n as f64)));
    modes
        .map(|(m, n)| {
            let [kx, ky] = [m * PI / SIDES[0], n * PI / SIDES[1]];
            let k = kx.hypot(ky);
            let shape = 2.0 / (rho_h * SIDES[0] * SIDES[1]).sqrt() * (kx * AT[0]).sin() * (ky * AT[1]).sin();
            // Beyond its main lobes the average over the disc is small, and its series is of no use there.
            let mean = if k * RADIUS < 12.0 { disc(k * RADIUS) } else { 0.0 };
            ((stiffness / rho_h).sqrt() * k * k, shape * mean)
        })
        .collect()
}

/// The frequencies (Hz) up to `top` Hz of the plate with that mass: the roots of 1 = M Σ φ² ω²/(ω_m² - ω²), each between two neighbouring
/// poles, by bisection.
fn with_mass(mass: f64, top: f64) -> Vec<f64> {
    let modes = series(200);
    let mut poles: Vec<f64> =
        modes.iter().map(|(omega, _)| *omega).filter(|omega| *omega < 2.0 * TAU * top).collect();
    poles.sort_by(f64::total_cmp);
    let excess = |omega: f64| {
        let square = omega * omega;
        mass * modes.iter().map(|(own, shape)| shape * shape * square / (own * own - square)).sum::<f64>()
            - 1.0
    };
    let mut below = 0.0;
    let mut found = Vec::new();
    for pole in poles {
        // Just above a pole the sum is -∞, just below the next +∞.
        let (mut low, mut high) = (below * (1.0 + 1e-12), pole * (1.0 - 1e-12));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if excess(middle) < 0.0 { low = middle } else { high = middle }
        }
        found.push(low / TAU);
        below = pole;
    }
    found.retain(|hz| *hz <= top);
    found
}

#[test]
fn a_mass_lowers_every_mode_as_the_secular_equation_says() {
    let surface = plate(CoilDrive::Current, MASS);
    let found = SurfaceModes::solve(&surface, 1000.0, 1e-7).unwrap().loaded.unwrap();
    let expected = with_mass(MASS, 1000.0);
    assert_eq!(found.len(), expected.len());
    let errors: Vec<f64> =
        found.iter().zip(&expected).map(|(pole, hz)| pole.omega / TAU / hz - 1.0).collect();
    let worst = errors.iter().fold(0.0, |worst: f64, error| worst.max(error.abs()));
    println!("{} modes, the first at {:.3} Hz, worst error {worst:.1e}", found.len(), expected[0]);
    assert!(worst < 1e-4, "{errors:?}");
    // The mass matters: without it, the first mode is elsewhere.
    let alone = Modes::solve(&surface, 1000.0, 1e-7).unwrap();
    assert!(expected[0] < 0.98 * alone.frequencies_hz()[0]);
}

#[test]
fn a_coil_on_a_voltage_damps_each_mode_by_its_motion_there() {
    // Without mass: the conductance (Bl)²/R at the contact adds half of itself times the square of the shape to the decay rate, to first order.
    let surface = plate(CoilDrive::Voltage, 0.0);
    let found = SurfaceModes::solve(&surface, 1000.0, 1e-7).unwrap().loaded.unwrap();
    let mut modes = series(30);
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let damping = 0.5 * 0.5 / 5.0;
    for (pole, (omega, shape)) in found.iter().zip(&modes) {
        let expected = 0.1 + 0.5 * damping * shape * shape;
        assert!((pole.omega / omega - 1.0).abs() < 1e-3, "{} Hz, expected {}", pole.omega / TAU, omega / TAU);
        assert!((pole.sigma / expected - 1.0).abs() < 0.02, "{}, expected {expected}", pole.sigma);
    }
}

#[test]
fn a_design_says_both() {
    let surface = plate(CoilDrive::Voltage, MASS);
    let design = design(&surface).unwrap();
    let with = design.with_actuators.as_ref().unwrap();
    assert!((with.first_mode_hz / with_mass(MASS, 1000.0)[0] - 1.0).abs() < 1e-3, "{}", with.first_mode_hz);
    assert!(
        with.first_mode_hz < 0.98 * design.first_mode_hz && with.decay_time_s < 0.9 * design.decay_time_s
    );
    let text = design.to_string();
    assert!(text.contains("with the actuators on it") && text.contains("of the sheet alone"), "{text}");
    // Ideal forces load nothing.
    let mut bare = surface;
    bare.actuators[0].kind = ActuatorKind::Force;
    assert_eq!(unripple_physics::design(&bare).unwrap().with_actuators, None);
}
