//! Stepping never allocates: not with loads, fingers that come, move and go, drifting tension, or injected faults.

use assert_no_alloc::{AllocDisabler, assert_no_alloc};
use std::sync::Arc;
use unripple_core::{Edge, Edges, Finger, Point};
use unripple_physics::stepper::{
    Channel, FaultySurface, InjectedFaults, Reading, StepperOptions, VirtualSurface,
};
use unripple_physics::{Circuit, Footprint, Load, Modes, stepper::Plant};

#[path = "../../unripple-plates/tests/modes_common/mod.rs"]
mod modes_common;

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;

const FRAMES: usize = 64;

fn coil(at: Point) -> Channel {
    let circuit = Circuit { force_constant: 1.0, resistance: 6.2, inductance: 1.9e-3 };
    let footprint = Footprint::point(at);
    let load = Load {
        footprint: footprint.clone(),
        mass: 5e-5,
        damping: 0.0,
        stiffness: 0.0,
        circuit: Some(circuit),
        housing: None,
    };
    Channel { footprint, gain: 1.0, load: Some(load), voltage: true }
}

#[test]
fn stepping_allocates_nothing() {
    let mut film = modes_common::film(Edges::All(Edge::Supported));
    film.emission.band = [0.0, 3000.0];
    let modes = Arc::new(Modes::solve(&film, 3000.0, 1e-4).unwrap());
    let plant = Plant::of(&film, modes).unwrap();
    let channels: Vec<Channel> =
        (0..8).map(|i| coil(Point::from_mm(10.0 + 17.0 * f64::from(i), 12.0 + f64::from(i * i)))).collect();
    let options = StepperOptions { max_fingers: 4, ..StepperOptions::default() };
    let mut surface = VirtualSurface::new(&plant, &channels, 48e3, &options).unwrap();
    surface.set_probes(&[(Point::from_mm(62.0, 90.0), Reading::Velocity)]).unwrap();
    let places = [(62.0, 90.0), (40.0, 50.0), (100.0, 70.0)];
    let contacts = places.map(|(x, y)| plant.contact_weights(Point::from_mm(x, y), 5e-3).unwrap());
    let drift = InjectedFaults {
        tension: vec![(0.0, 1.0), (0.1, 1.01)],
        noise: 1e-6,
        latency: 5,
        ..InjectedFaults::default()
    };
    let mut wrong = FaultySurface::new(surface.clone(), drift, FRAMES).unwrap();
    let drive: Vec<f64> = (0..8 * FRAMES).map(|i| (i as f64 * 0.7).sin()).collect();
    let (mut sensors, mut probes) = (vec![0.0; 8 * FRAMES], vec![0.0; FRAMES]);
    assert_no_alloc(|| {
        for block in 0..100 {
            match block {
                5 => surface.touch_on(1, &Finger::default(), &contacts[0]).unwrap(),
                20 => surface.touch_on(2, &Finger::default(), &contacts[1]).unwrap(),
                40 => surface.move_onto(1, &contacts[2]).unwrap(),
                60 => surface.set_tension(1.02).unwrap(),
                80 => surface.lift(1).unwrap(),
                _ => {}
            }
            surface.process(FRAMES, &drive, &mut sensors, &mut probes).unwrap();
            wrong.process(FRAMES, &drive, &mut sensors, &mut probes).unwrap();
        }
    });
    assert!(probes.iter().all(|v| v.is_finite()) && surface.energy() > 0.0);
}
