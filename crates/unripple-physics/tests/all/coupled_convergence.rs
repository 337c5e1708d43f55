//! Truth: what loads feel of the modes above the band, against more and more modes one by one.

use crate::coupled_common;
use crate::modes_common;
use unripple_linalg::c64;

use coupled_common::*;
use modes_common::*;
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_physics::*;

/// Transfers in the band from the first actuator to the finger or its place, and elsewhere.
fn transfers(surface: &Surface, contacts: &[Contact], reach: f64) -> Vec<c64> {
    let options = ResponseOptions { contacts: contacts.to_vec(), reach, ..Default::default() };
    let found = modal(surface, &options);
    let read = found.shapes.at_all(&[Point::from_mm(62.0, 90.0), Point::from_mm(110.0, 40.0)]);
    let rows: Vec<Vec<f64>> = (0..2).map(|p| read.row(p).iter().copied().collect()).collect();
    let at = |(row, i): (&Vec<f64>, i32)| {
        modal_transfer(&found.poles, found.input.as_ref(), 0, row, c64::new(3.0, 10.0 * TAU * f64::from(i)))
    };
    rows.iter().flat_map(|row| (1..=100).map(move |i| (row, i))).map(at).collect()
}

fn errors(surface: &Surface, contacts: &[Contact]) -> Vec<f64> {
    let exact = transfers(surface, contacts, 8.0);
    let size: f64 = exact.iter().map(|y| y.norm_sqr()).sum();
    let error = |reach: f64| {
        let found = transfers(surface, contacts, reach);
        (found.iter().zip(&exact).map(|(a, b)| (a - b).norm_sqr()).sum::<f64>() / size).sqrt()
    };
    [1.15, 1.5, 2.0, 3.0].map(error).to_vec()
}

#[test]
fn loads_feel_an_endless_sheet_above_the_modes() {
    let mut surface = film_with_actuators(&[(12.0, 31.0), (95.0, 137.0)]);
    surface.outline.edges = Edges::All(Edge::Supported);
    surface.emission.band = [0.0, 1000.0];
    let at = Point::from_mm(62.0, 90.0);
    let finger =
        |contact_radius| vec![Contact { at, finger: Finger { contact_radius, ..Finger::default() } }];
    let [wide, narrow] = [8e-3, 2e-3].map(|radius| errors(&surface, &finger(radius)));
    for actuator in &mut surface.actuators {
        *actuator = coil(&actuator.name.clone(), actuator.at, CoilDrive::Voltage);
    }
    let coils = errors(&surface, &[]);
    println!("reach 1.15, 1.5, 2, 3: disc of 8 mm {wide:?}, of 2 mm {narrow:?}, coils {coils:?}");
    for errors in [wide, narrow, coils] {
        assert!(errors[1] < 0.05 && errors[3] < 0.02, "{errors:?}");
        assert!(errors[3] < errors[0], "{errors:?}");
    }
}
