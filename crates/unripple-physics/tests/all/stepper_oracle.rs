//! Truth: sums of responses where nothing hangs on the sheet.

use crate::modes_common;
use crate::stepper_common;

use modes_common::film_with_actuators;
use std::sync::Arc;
use stepper_common::*;
use unripple_core::*;
use unripple_physics::stepper::*;
use unripple_physics::{Footprint, Modes, ResponseOptions, responses, sample};

/// The paper's actuators, in mm.
const PLACES: [(f64, f64); 8] = [
    (12.0, 31.0),
    (9.0, 84.0),
    (40.0, 140.0),
    (95.0, 137.0),
    (141.0, 106.0),
    (138.0, 44.0),
    (103.0, 11.0),
    (50.0, 9.0),
];

const FRAMES: usize = 300;

fn film() -> ModalResponses {
    match responses(
        &film_with_actuators(&PLACES),
        &ResponseOptions { accuracy: 1e-5.into(), ..Default::default() },
    ) {
        Ok(Responses::Modal(modal)) => modal,
        other => panic!("{other:?}"),
    }
}

fn probes() -> Vec<Point> {
    [(62.0, 90.0), (12.0, 31.0), (101.0, 20.0), (75.0, 75.0), (3.0, 147.0)].map(|(x, y)| mm(x, y)).to_vec()
}

/// `Σ_j h[i-j] d[j] / rate` at a point, h as a function of the pole and the time.
fn sums(modal: &ModalResponses, drive: &[f64], at: Point, h: impl Fn(&Pole, f64) -> f64) -> Vec<f64> {
    let rate = modal.conditions.rate;
    let mut row = vec![0.0; modal.poles.len()];
    modal.shapes.at(at, &mut row);
    let mut out = vec![0.0; FRAMES];
    for (m, pole) in modal.poles.iter().enumerate() {
        let ringing: Vec<f64> = (0..FRAMES).map(|i| h(pole, i as f64 / rate)).collect();
        let momentum: Vec<f64> = (0..FRAMES)
            .map(|j| (0..8).map(|a| modal.input[(a, m)] * drive[a * FRAMES + j]).sum::<f64>() / rate)
            .collect();
        for (i, out) in out.iter_mut().enumerate() {
            *out += row[m] * (0..=i).map(|j| ringing[i - j] * momentum[j]).sum::<f64>();
        }
    }
    out
}

#[test]
fn an_unloaded_surface_is_the_sum_of_its_responses() {
    let modal = film();
    let channels: Vec<Channel> =
        modal.ports.iter().map(|port| Channel::force(Footprint::point(port.at))).collect();
    let plant = Plant::of_responses(&modal).unwrap();
    let drive = noise(1, 8 * FRAMES);
    // Where nothing hangs on it, steps within a sample change nothing.
    for substeps in [1, 3] {
        let options = StepperOptions { substeps, ..Default::default() };
        let mut surface = VirtualSurface::new(&plant, &channels, 48e3, &options).unwrap();
        let listened: Vec<(Point, Reading)> = (probes().into_iter().map(|p| (p, Reading::Velocity)))
            .chain([(probes()[0], Reading::Displacement)])
            .collect();
        surface.set_probes(&listened).unwrap();
        let (sensors, heard) = run(&mut surface, &drive);
        for (p, at) in probes().into_iter().enumerate() {
            let exact = sums(&modal, &drive, at, |pole, t| pole.velocity(t));
            let error = apart(&heard[p * FRAMES..][..FRAMES], &exact);
            assert!(error < 1e-9, "{p}: {error}");
        }
        let exact = sums(&modal, &drive, probes()[0], |pole, t| pole.displacement(t));
        assert!(apart(&heard[5 * FRAMES..], &exact) < 1e-9);
        let exact = sums(&modal, &drive, modal.ports[0].at, |pole, t| pole.velocity(t));
        assert!(apart(&sensors[..FRAMES], &exact) < 1e-9);
        // Afterwards the whole field is there, as it was heard last.
        let snapshot = surface.snapshot(&probes());
        let last: Vec<f64> = (0..5).map(|p| heard[p * FRAMES + FRAMES - 1]).collect();
        assert!(apart(&snapshot.velocity, &last) < 1e-12);
        assert!((snapshot.displacement[0] - heard[6 * FRAMES - 1]).abs() < 1e-12 * peak(&exact));
    }
}

#[test]
fn an_impulse_gives_the_sampled_response() {
    let modal = film();
    let surface = film_with_actuators(&PLACES);
    let modes = Arc::new(Modes::solve(&surface, 3e3, 1e-5).unwrap());
    let mut virtual_one = VirtualSurface::of(&surface, modes, &StepperOptions::default()).unwrap();
    let listened: Vec<(Point, Reading)> = probes().into_iter().map(|p| (p, Reading::Velocity)).collect();
    virtual_one.set_probes(&listened).unwrap();
    let sampled = sample(&modal, &probes(), FRAMES);
    let mut drive = vec![0.0; 8 * FRAMES];
    drive[2 * FRAMES] = 48e3;
    let (_, heard) = run(&mut virtual_one, &drive);
    for p in 0..5 {
        let exact: Vec<f64> = sampled.response(2, p).iter().map(|x| f64::from(*x)).collect();
        // Responses are sampled in single precision.
        assert!(apart(&heard[p * FRAMES..][..FRAMES], &exact) < 1e-5);
    }
}

#[test]
fn every_regime_of_damping_rings_as_its_pole() {
    let poles = [(0.0, 0.0), (0.0, 9.0), (2e3, 0.0), (2e3, 14.0), (2e3, 2e3), (2e3, 9e3), (3e5, 1.0)]
        .map(|(omega, sigma)| Pole::new(omega, sigma));
    #[derive(Debug)]
    struct One(usize);
    impl Shapes for One {
        fn modes(&self) -> usize {
            self.0
        }
        fn at(&self, _: Point, row: &mut [f64]) {
            row.fill(1.0);
        }
    }
    for pole in poles {
        let plant = Plant::new(&[pole], Arc::new(One(1)), square()).unwrap();
        let mut surface =
            VirtualSurface::new(&plant, &[force(1.0, 1.0)], 48e3, &StepperOptions::default()).unwrap();
        let mut drive = vec![0.0; FRAMES];
        drive[0] = 48e3;
        let (heard, _) = run(&mut surface, &drive);
        let exact: Vec<f64> = (0..FRAMES).map(|i| pole.velocity(i as f64 / 48e3)).collect();
        assert!(apart(&heard, &exact) < 1e-9, "{pole:?}: {}", apart(&heard, &exact));
        let (displacement, velocity) = surface.state();
        let t = (FRAMES - 1) as f64 / 48e3;
        assert!((displacement[0] - pole.displacement(t)).abs() < 1e-9 * pole.displacement(t).abs().max(1e-4));
        assert!((velocity[0] - pole.velocity(t)).abs() < 1e-9);
    }
}

#[test]
fn tension_moves_frequencies_as_dispersion_does() {
    // A supported film: shapes do not depend on tension, so that the first order is all there is.
    let mut surface = film_with_actuators(&PLACES);
    surface.outline.edges = Edges::All(Edge::Supported);
    let modes = |tension: f64| {
        let mut surface = surface.clone();
        surface.sheet.tension = tension;
        Arc::new(Modes::solve(&surface, 2e3, 1e-6).unwrap())
    };
    let stretched = modes(210.0);
    let mut one = VirtualSurface::of(&surface, modes(200.0), &StepperOptions::default()).unwrap();
    one.set_tension(1.05).unwrap();
    let mut other = VirtualSurface::of(&surface, stretched, &StepperOptions::default()).unwrap();
    let count = one.state().0.len().min(other.state().0.len());
    let mut drive = vec![0.0; 8 * 400];
    drive[0] = 1.0;
    run(&mut one, &drive);
    run(&mut other, &drive);
    let sorted = |surface: &VirtualSurface| {
        let (u, v) = surface.state();
        let mut energies: Vec<f64> = u[..count - 8].iter().zip(v).map(|(u, v)| u * u + v * v).collect();
        energies.sort_by(f64::total_cmp);
        energies
    };
    assert!(apart(&sorted(&one), &sorted(&other)) < 1e-9);
}

#[test]
fn refuses_what_cannot_be() {
    let plant = membrane(9, 14.0);
    let options = StepperOptions::default();
    let new = |channels: &[Channel], rate: f64, options: &StepperOptions| {
        VirtualSurface::new(&plant, channels, rate, options).map(|_| ()).unwrap_err().to_string()
    };
    let channel = force(10.0, 10.0);
    assert!(new(std::slice::from_ref(&channel), 0.0, &options).contains("sample rate"));
    assert!(new(std::slice::from_ref(&channel), f64::NAN, &options).contains("sample rate"));
    let none = StepperOptions { substeps: 0, ..options };
    assert!(new(std::slice::from_ref(&channel), 48e3, &none).contains("steps per sample"));
    let long = StepperOptions { fade: -1.0, ..options };
    assert!(new(std::slice::from_ref(&channel), 48e3, &long).contains("come"));
    assert!(new(&[Channel { voltage: true, ..channel.clone() }], 48e3, &options).contains("coil"));
    let heavy = Channel { load: Some(load(1.0, 1.0, [-1.0, 0.0, 0.0], None)), ..channel.clone() };
    assert!(new(&[heavy], 48e3, &options).contains("mass of a load"));
    let off = Channel { footprint: Footprint::point(mm(f64::NAN, 1.0)), ..channel.clone() };
    assert!(new(&[off], 48e3, &options).contains("finite"));

    let mut surface = VirtualSurface::new(&plant, &[channel], 48e3, &options).unwrap();
    assert!(surface.process(4, &[0.0; 3], &mut [], &mut []).is_err());
    assert!(surface.process(4, &[0.0; 4], &mut [0.0; 3], &mut []).is_err());
    assert!(surface.process(4, &[0.0; 4], &mut [], &mut [0.0]).is_err());
    assert!(surface.process(0, &[], &mut [], &mut []).is_ok());
    assert!(surface.set_tension(-1.0).is_err() && surface.set_tension(f64::NAN).is_err());
    assert!(surface.lift(7).is_err() && surface.move_to(7, mm(1.0, 1.0)).is_err());
    let contact = finger(50.0, 50.0, [1e-4, 1.0, 1e3]);
    surface.touch(7, &contact).unwrap();
    assert!(surface.touch(7, &contact).unwrap_err().to_string().contains("not down"));
    assert!(surface.touch(8, &finger(1.0, f64::INFINITY, [1e-4, 1.0, 1e3])).is_err());
    assert!(surface.touch(8, &finger(1.0, 1.0, [-1e-4, 1.0, 1e3])).is_err());
    (8..11).for_each(|id| surface.touch(id, &contact).unwrap());
    assert!(surface.touch(11, &contact).unwrap_err().to_string().contains("fingers at once"));
    assert_eq!(surface.samples(), 0);

    let moved = [Pole::moved(1.0, 1.0)];
    assert!(Plant::new(&moved, Arc::new(Sines(1)), square()).unwrap_err().to_string().contains("strike"));
    assert!(Plant::new(&[], Arc::new(Sines(1)), square()).is_err());
    assert!(Plant::new(&[Pole::new(-1.0, 0.0)], Arc::new(Sines(1)), square()).is_err());
    assert!(membrane(4, 1.0).with_bending_shares(&[0.5; 3]).is_err());
}

#[test]
fn nothing_at_all_is_fine() {
    let plant = membrane(3, 14.0);
    let mut surface = VirtualSurface::new(&plant, &[], 48e3, &StepperOptions::default()).unwrap();
    surface.process(10, &[], &mut [], &mut []).unwrap();
    assert_eq!((surface.samples(), surface.energy()), (10, 0.0));
    surface.touch(1, &finger(30.0, 30.0, [1e-4, 1.0, 1e3])).unwrap();
    surface.process(1000, &[], &mut [], &mut []).unwrap();
    let empty = Plant::new(&[], Arc::new(Sines(0)), square()).unwrap();
    let mut surface =
        VirtualSurface::new(&empty, &[force(1.0, 1.0)], 48e3, &StepperOptions::default()).unwrap();
    let (heard, _) = run(&mut surface, &[1.0; 20]);
    assert_eq!(heard, [0.0; 20]);
    // What is not finite is not taken in.
    let mut surface =
        VirtualSurface::new(&plant, &[force(40.0, 30.0)], 48e3, &StepperOptions::default()).unwrap();
    let (heard, _) = run(&mut surface, &[1.0, f64::NAN, f64::INFINITY, 0.0]);
    assert!(heard.iter().all(|x| x.is_finite()) && heard[3] != 0.0);
}

#[test]
fn a_channel_that_is_moved_strikes_where_it_went() {
    let places = [(40.0, 50.0), (90.0, 33.0)];
    let strip = load(20.0, 70.0, [2e-3, 0.1, 500.0], None);
    let loaded = Channel { load: Some(strip.clone()), ..Channel::force(strip.footprint) };
    let at = |(x, y)| {
        let channels = [loaded.clone(), force(x, y)];
        VirtualSurface::new(&membrane(49, 20.0), &channels, 48e3, &StepperOptions::default()).unwrap()
    };
    let (mut moved, mut there) = (at(places[0]), at(places[1]));
    let contact_weights = moved.plant().contact_weights(mm(90.0, 33.0), 0.0).unwrap();
    assert!(
        moved.move_channel(0, &contact_weights).is_err() && moved.move_channel(2, &contact_weights).is_err()
    );
    moved.move_channel(1, &contact_weights).unwrap();
    let drive = noise(3, 2 * 512);
    let (found, expected) = (run(&mut moved, &drive), run(&mut there, &drive));
    assert!(apart(&found.0, &expected.0) < 1e-12);
    // Under way, what rings already goes on.
    let contact_weights = moved.plant().contact_weights(mm(40.0, 50.0), 0.0).unwrap();
    let energy = moved.energy();
    moved.move_channel(1, &contact_weights).unwrap();
    assert_eq!(moved.energy(), energy);
}
