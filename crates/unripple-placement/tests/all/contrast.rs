//! Contrasts and energies against those of a drive that is computed and evaluated.

use crate::bench::{WINDOW, film};
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Patch, Point, Responses};
use unripple_field::{Aim as Evaluated, MeasureOptions, measure};
use unripple_focus::{Options, Target, focus};
use unripple_physics::{ResponseOptions, accuracy, responses};
use unripple_placement::{Aim, Plant, reached};

const PLACES: [(f64, f64); 3] = [(12.0, 31.0), (95.0, 137.0), (141.0, 106.0)];
const AT: Point = Point::new(62e-3, 90e-3);

/// Contrast, and energy for a peak of 1 m/s, of a drive from actuators like `kind` at the places.
fn driven(kept: &[Actuator], kind: &Actuator) -> [f64; 2] {
    let (mut surface, _) = film(1500.0);
    surface.actuators = kept.to_vec();
    let placed = |(i, (x, y)): (usize, &(f64, f64))| Actuator {
        at: Point::from_mm(*x, *y),
        name: format!("p{i}"),
        ..kind.clone()
    };
    surface.actuators.extend(PLACES.iter().enumerate().map(placed));
    let accuracy = accuracy(&surface);
    let found: Responses =
        responses(&surface, &ResponseOptions { accuracy, ..ResponseOptions::default() }).unwrap();
    let options = Options { window: WINDOW, ..Options::default() };
    let focused = focus(&found, &[Target::at(AT)], &options).unwrap();
    let aims = [Evaluated::at(AT, WINDOW)];
    let options = MeasureOptions { cells: 4.0, ..MeasureOptions::default() };
    let measured = measure(&found, &focused.drive, &aims, &options).unwrap();
    let target = &measured.targets[0];
    [target.contrast.unwrap(), focused.drive.energy() / target.peak_velocity_m_s.powi(2)]
}

/// The same from the sums over actuators.
fn summed(kept: &[Actuator], kind: &Actuator) -> [f64; 2] {
    let (mut surface, _) = film(1500.0);
    surface.actuators = kept.to_vec();
    let plant = Plant::new(surface, kind).unwrap();
    let places = PLACES.map(|(x, y)| Point::from_mm(x, y));
    let found = reached(&[plant], &places, &[Aim { at: AT, weight: 1.0 }], WINDOW).unwrap();
    [found[0].contrast, found[0].energy]
}

fn agree(kept: &[Actuator], kind: &Actuator) {
    let (driven, summed) = (driven(kept, kind), summed(kept, kind));
    for (one, other) in driven.iter().zip(summed) {
        assert!((one / other - 1.0).abs() < 2e-4, "{driven:?} {summed:?}");
    }
}

#[test]
fn forces_reach_what_their_drive_does() {
    let (_, force) = film(1500.0);
    agree(&[], &force);
    agree(&[], &Actuator { contact_radius: 3e-3, ..force });
}

#[test]
fn patches_and_coils_reach_what_their_drives_do() {
    let (_, force) = film(1500.0);
    let patch = ActuatorKind::Piezo { patch: Patch::Round { radius: 4e-3 }, moment: 0.02, mass: 0.0 };
    agree(&[], &Actuator { kind: patch, ..force.clone() });
    let coil = ActuatorKind::MovingMagnet {
        force_constant: 0.7,
        resistance: 8.0,
        inductance: 0.0,
        moving_mass: 0.0,
        driven_by: CoilDrive::Current,
    };
    agree(&[], &Actuator { kind: coil, ..force });
}

#[test]
fn actuators_that_stay_load_the_sheet() {
    let (_, force) = film(1500.0);
    let heavy = ActuatorKind::MovingMagnet {
        force_constant: 0.7,
        resistance: 8.0,
        inductance: 0.1e-3,
        moving_mass: 0.2e-3,
        driven_by: CoilDrive::Voltage,
    };
    let heavy =
        Actuator { name: "stays".into(), at: Point::from_mm(40.0, 30.0), kind: heavy, contact_radius: 3e-3 };
    agree(std::slice::from_ref(&heavy), &force);
}
