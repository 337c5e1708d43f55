//! Truth: air beside a sheet against textbook forms and the paper's first mode.

use crate::modes_common;

use modes_common::*;
use std::f64::consts::{PI, TAU};
use unripple_core::*;
use unripple_plates::*;

const AIRS: [Air; 3] = [Air::None, Air::OneSide, Air::BothSides];

fn first(edge: Edge, air: Air) -> f64 {
    let mut surface = film(Edges::All(edge));
    surface.sheet.air = air;
    Modes::solve(&surface, 300.0, 1e-8).unwrap().frequencies_hz()[0]
}

#[test]
fn the_papers_first_mode() {
    let [supported, clamped] = [Edge::Supported, Edge::Clamped].map(|edge| AIRS.map(|air| first(edge, air)));
    println!("supported {supported:?}, clamped {clamped:?} Hz; measured 150");
    assert!((supported[0] - 159.614).abs() < 1e-3 && (supported[2] - 132.0).abs() < 0.5);
    assert!((clamped[0] - 163.7436).abs() < 1e-3);
    // What was measured lies between air on one side and none.
    for [none, one, both] in [supported, clamped] {
        assert!(both < one && one < 150.0 && 150.0 < none);
    }
}

/// A pane of 0.7 mm glass, supported.
fn pane(air: Air) -> Surface {
    let mut surface = film(Edges::All(Edge::Supported));
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.poisson) = (72e9, 2500.0, 0.22);
    (sheet.thickness, sheet.tension, sheet.decay, sheet.air) = (0.7e-3, 0.0, Decay::Time(0.02), air);
    surface
}

#[test]
fn glass_radiates_above_coincidence() {
    let medium = Medium::of(&pane(Air::None).sheet);
    let coincidence = 343.2f64.powi(2) / TAU * (medium.areal_density / medium.bending_stiffness).sqrt();
    assert!((medium.coincidence_hz().unwrap() / coincidence - 1.0).abs() < 1e-12);
    for (air, sides) in [(Air::OneSide, 1.0), (Air::BothSides, 2.0)] {
        let modes = Modes::solve(&pane(air), 4.0 * coincidence, 1e-6).unwrap();
        let mut above = 0;
        for pole in modes.poles() {
            let radiated = pole.sigma - 50.0;
            let ratio = pole.omega / (TAU * coincidence);
            // n ρ_0 c_0/(2 ρ_s √(1 - f_c/f)), since (k c_0/ω)² = f_c/f.
            let textbook =
                sides * 1.204 * 343.2 / (2.0 * medium.areal_density * (1.0 - 1.0 / ratio).abs().sqrt());
            if ratio < 0.98 {
                assert!(radiated.abs() < 1e-9, "{ratio}: {radiated}");
            } else if ratio > 1.3 {
                above += 1;
                assert!((radiated / textbook - 1.0).abs() < 0.01, "{ratio}: {radiated} {textbook}");
            }
            assert!(radiated < 0.02 * pole.omega, "{ratio}: {radiated}");
        }
        assert!(above > 100);
    }
}

/// Modes are those in vacuum, each shifted, none lost at coincidence.
#[test]
fn no_mode_is_lost_at_coincidence() {
    let medium = Medium::of(&pane(Air::BothSides).sheet);
    let top = 4.0 * medium.coincidence_hz().unwrap();
    let in_air = Modes::solve(&pane(Air::BothSides), top, 1e-6).unwrap().frequencies_hz();
    let in_vacuum = Modes::solve(&pane(Air::None), 1.2 * top, 1e-6).unwrap().frequencies_hz();
    assert!(in_air.windows(2).all(|pair| pair[0] <= pair[1]));
    for (air, vacuum) in in_air.iter().zip(&in_vacuum).filter(|(_, vacuum)| **vacuum > 1e3) {
        assert!((air / vacuum - 1.0).abs() < 0.05, "{air} {vacuum}");
    }
    let expected = (PI * 0.0225 * (medium.wavenumber(TAU * top) / TAU).powi(2)) as usize;
    assert!(in_air.len().abs_diff(expected) < expected / 10, "{} {expected}", in_air.len());
}

/// A film whose waves outrun sound at every frequency (ρ_s c_0² < R) still has modes in air.
#[test]
fn a_membrane_faster_than_sound() {
    let mut surface = film(Edges::All(Edge::Supported));
    (surface.sheet.tension, surface.sheet.air) = (40e3, Air::BothSides);
    let modes = Modes::solve(&surface, 5e3, 1e-6).unwrap();
    assert!(modes.poles().len() > 3);
    assert!(modes.poles().iter().all(|pole| pole.sigma.is_finite() && pole.sigma >= 1.0 / 0.07));
    assert!(modes.poles()[0].sigma > 100.0);
}
