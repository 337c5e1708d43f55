//! Truth: problems solved by hand, and the other route, Woodbury's identity at one frequency.

use crate::coupled_common;
use crate::modes_common;
use unripple_linalg::c64;

use coupled_common::*;
use modes_common::*;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::*;
use unripple_physics::*;

/// A single shape that moves everything alike.
#[derive(Debug)]
struct Piston;

impl Shapes for Piston {
    fn modes(&self) -> usize {
        1
    }

    fn at(&self, _: Point, row: &mut [f64]) {
        row.fill(2.0);
    }
}

/// Shapes that move everything alike, any number of them.
#[derive(Debug)]
struct Alike(usize);

impl Shapes for Alike {
    fn modes(&self) -> usize {
        self.0
    }

    fn at(&self, _: Point, row: &mut [f64]) {
        row.fill(1.0);
    }
}

fn somewhere() -> Footprint {
    Footprint::point(Point::new(0.0, 0.0))
}

fn piston(load: Load) -> Oscillations {
    let loaded =
        Loaded::new(Arc::new(Piston), &[Pole::new(900.0, 30.0)], &[force(Point::new(0.0, 0.0))], &[load]);
    loaded.unwrap().oscillations(1e9, [0.0, 1e9]).unwrap()
}

/// A piston of modal mass 1 and shape 2, hence of mass 1/4, with what is added.
#[test]
fn mass_damper_and_spring_on_one_mode() {
    let (mass, damping, stiffness): (f64, f64, f64) = (0.25 + 0.35, 15.0 + 70.0, 0.25 * 810e3 + 5e4);
    let found = piston(load(somewhere(), 0.35, 70.0, 5e4));
    assert_eq!((found.poles.len(), found.poles[0].onset), (1, Onset::Velocity));
    let pole = found.poles[0];
    assert!((pole.omega / (stiffness / mass).sqrt() - 1.0).abs() < 1e-13);
    assert!((pole.sigma / (damping / (2.0 * mass)) - 1.0).abs() < 1e-13);
    // Struck by a unit impulse, it sets off at 1/mass.
    let read = found.shapes.at_all(&[Point::new(0.0, 0.0)])[(0, 0)];
    assert!((found.input[(0, 0)] * read * mass - 1.0).abs() < 1e-13);
}

#[test]
fn overdamped_on_one_mode() {
    let found = piston(load(somewhere(), 0.0, 4e3, 0.0));
    let exact = Pole::new(900.0, 30.0 + 0.5 * 4.0 * 4e3);
    let read = found.shapes.at_all(&[Point::new(0.0, 0.0)]);
    for t in [0.0, 1e-5, 1e-4, 1e-3, 1e-2] {
        let sum = |f: &dyn Fn(&Pole) -> f64| -> f64 {
            (0..found.poles.len()).map(|m| found.input[(0, m)] * read[(0, m)] * f(&found.poles[m])).sum()
        };
        assert!((sum(&|p| p.velocity(t)) - 4.0 * exact.velocity(t)).abs() < 1e-11);
        assert!((sum(&|p| p.displacement(t)) - 4.0 * exact.displacement(t)).abs() < 1e-14);
    }
}

#[test]
fn a_load_on_more_modes_than_memory_holds_is_refused() {
    let poles: Vec<Pole> = (1..=4000).map(|m| Pole::new(f64::from(m), 0.1)).collect();
    let finger = load(somewhere(), 0.0, 1.0, 0.0);
    let loaded = Loaded::new(Arc::new(Alike(poles.len())), &poles, &[], &[finger]).unwrap();
    let error = loaded.oscillations(1e9, [0.0, 1e3]).unwrap_err();
    let PhysicsError::TooLarge { needed_gib, limit_gib, nearest_hz, .. } = error else { panic!("{error}") };
    assert!(needed_gib > limit_gib && (900.0..1e3).contains(&nearest_hz), "{needed_gib} {nearest_hz}");
}

/// A coil at rest on a mode: three poles, of (s² + 2σs + ω²)(R + Ls) + w²(bl)² s.
#[test]
fn coil_on_one_mode() {
    let circuit = Circuit { force_constant: 3.0, resistance: 6.0, inductance: 2e-3 };
    let own = Load { circuit: Some(circuit), ..load(somewhere(), 0.0, 0.0, 0.0) };
    let driver = Transducer {
        gain: 3.0,
        entry: Entry::Voltage,
        load: Some(own),
        unit: "V",
        ..force(Point::default())
    };
    let loaded = Loaded::new(Arc::new(Piston), &[Pole::new(900.0, 30.0)], &[driver], &[]).unwrap();
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    let read = found.shapes.at_all(&[Point::default()]);
    let read: Vec<f64> = read.row(0).iter().copied().collect();
    for s in [c64::new(0.0, 800.0), c64::new(0.0, 3e3), c64::new(100.0, 950.0), c64::new(2e4, 0.0)] {
        let below = (s * s + s * 60.0 + 810e3) * (s * 2e-3 + 6.0) + s * 36.0;
        let exact = s * 12.0 / below;
        let sum = modal_transfer(&found.poles, found.input.as_ref(), 0, &read, s);
        assert!((sum - exact).norm() < 1e-12 * exact.norm(), "{s}: {sum} {exact}");
        let woodbury = loaded.admittance(0, &somewhere(), s);
        assert!((woodbury - exact).norm() < 1e-12 * exact.norm(), "{s}: {woodbury} {exact}");
    }
    // At first nothing moves: the current has to grow.
    let start: f64 =
        (0..found.poles.len()).map(|m| found.input[(0, m)] * read[m] * found.poles[m].velocity(0.0)).sum();
    let size: f64 = (0..found.poles.len()).map(|m| (found.input[(0, m)] * read[m]).abs()).sum();
    assert!(start.abs() < 1e-12 * size);
}

fn film_loads() -> (Vec<Transducer>, Vec<Load>) {
    let surface = film(Edges::All(Edge::Clamped));
    let mut actuators = vec![
        coil("v1", Point::from_mm(12.0, 31.0), CoilDrive::Voltage),
        coil("i1", Point::from_mm(95.0, 137.0), CoilDrive::Current),
        coil("v2", Point::from_mm(141.0, 106.0), CoilDrive::Voltage),
    ];
    actuators.push(Actuator { kind: ActuatorKind::Force, ..actuators[0].clone() });
    if let ActuatorKind::MovingMagnet { inductance, .. } = &mut actuators[2].kind {
        *inductance = 0.0;
    }
    let transducers = actuators.iter().map(|a| Transducer::of(a, &surface.outline).unwrap()).collect();
    let fingers = [(62.0, 90.0), (75.0, 75.0)]
        .map(|(x, y)| Contact { at: Point::from_mm(x, y), finger: Finger::default() })
        .map(|contact| Load::finger(&contact, &surface.outline));
    (transducers, fingers.to_vec())
}

#[test]
fn poles_against_woodbury_on_the_film() {
    let (transducers, fingers) = film_loads();
    let surface = film(Edges::All(Edge::Clamped));
    let (shapes, poles) = modes(&surface, 1500.0);
    let loaded = Loaded::new(shapes, &poles, &transducers, &fingers).unwrap();
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    assert!(found.poles.windows(2).all(|pair| pair[0].omega <= pair[1].omega));
    for at in [Point::from_mm(62.0, 90.0), Point::from_mm(20.0, 110.0)] {
        let footprint = Footprint::point(at);
        let read = footprint.weights(found.shapes.as_ref());
        for actuator in 0..transducers.len() {
            let of = |hz: f64| loaded.admittance(actuator, &footprint, c64::new(0.0, TAU * hz));
            let size = (1..1500).map(|hz| of(f64::from(hz)).norm()).fold(0.0, f64::max);
            for hz in (1..300).map(|i| 5.013 * f64::from(i)) {
                let s = c64::new(0.0, TAU * hz);
                let sum = modal_transfer(&found.poles, found.input.as_ref(), actuator, &read, s);
                let error = (sum - of(hz)).norm();
                assert!(error < 1e-9 * size, "{at} {actuator} {hz}: {error:e} of {size:e}");
            }
        }
    }
}

/// What is left out above the band is known: combinations of high modes against all of them, one by one.
#[test]
fn high_modes_need_not_be_kept_one_by_one() {
    let (transducers, fingers) = film_loads();
    let surface = film(Edges::All(Edge::Clamped));
    let (shapes, poles) = modes(&surface, 2000.0);
    let loaded = Loaded::new(shapes, &poles, &transducers, &fingers).unwrap();
    let footprint = Footprint::point(Point::from_mm(62.0, 90.0));
    let frequencies: Vec<f64> = (1..100).map(|i| 10.0 * f64::from(i)).collect();
    let worst = |dynamic: f64| {
        let found = loaded.oscillations(dynamic, [0.0, 1e9]).unwrap();
        let read = footprint.weights(found.shapes.as_ref());
        let (mut error, mut size) = (0.0f64, 0.0f64);
        for hz in &frequencies {
            let s = c64::new(0.0, TAU * hz);
            // From the two coils, which excite through their own footprints.
            let exact = loaded.admittance(0, &footprint, s);
            let sum = modal_transfer(&found.poles, found.input.as_ref(), 0, &read, s);
            (error, size) = (error.max((sum - exact).norm()), size.max(exact.norm()));
        }
        error / size
    };
    let errors = [1050.0, 1150.0, 1300.0].map(worst);
    println!("combinations of modes above 1050, 1150, 1300 Hz, up to 1000 Hz: {errors:?}");
    assert!(errors[1] < 1e-3 && errors[2] < errors[1]);
}

#[test]
fn nothing_on_the_film_leaves_it_as_it_is() {
    let surface = film_with_actuators(&[(12.0, 31.0), (95.0, 137.0)]);
    let bare = modal(&surface, &ResponseOptions::default());
    let nothing = Finger { mass: 0.0, damping: 0.0, stiffness: 0.0, contact_radius: 5e-3 };
    let contacts = vec![Contact { at: Point::from_mm(62.0, 90.0), finger: nothing }];
    let loaded = modal(&surface, &ResponseOptions { contacts, ..Default::default() });
    assert_eq!(bare.poles, loaded.poles);
    assert_eq!(bare.input, loaded.input);
}

#[test]
fn a_light_finger_changes_little() {
    let surface = film_with_actuators(&[(12.0, 31.0)]);
    let bare = modal(&surface, &ResponseOptions::default());
    let light = Finger { mass: 1e-12, damping: 1e-9, stiffness: 1e-6, contact_radius: 5e-3 };
    let contacts = vec![Contact { at: Point::from_mm(62.0, 90.0), finger: light }];
    let loaded = modal(&surface, &ResponseOptions { contacts, ..Default::default() });
    let at = [Point::from_mm(33.0, 71.0), Point::from_mm(62.0, 90.0)];
    let (a, b) = (sample(&bare, &at, 1441), sample(&loaded, &at, 1441));
    for p in 0..2 {
        let size = a.response(0, p).iter().fold(0.0f32, |most, h| most.max(h.abs()));
        for (x, y) in a.response(0, p).iter().zip(b.response(0, p)) {
            assert!((x - y).abs() < 1e-4 * size, "{x} {y}");
        }
    }
}

#[test]
fn a_huge_mass_pins_the_place() {
    let surface = film(Edges::All(Edge::Supported));
    let (shapes, poles) = modes(&surface, 1000.0);
    let at = Point::from_mm(62.0, 90.0);
    let rock = load(Footprint::point(at), 1e6, 0.0, 0.0);
    let loaded = Loaded::new(shapes, &poles, &[force(Point::from_mm(20.0, 31.0))], &[rock]).unwrap();
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    let read = found.shapes.at_all(&[at, Point::from_mm(110.0, 40.0)]);
    let motion = |p: usize, t: f64| -> f64 {
        (0..found.poles.len()).map(|m| found.input[(0, m)] * read[(p, m)] * found.poles[m].velocity(t)).sum()
    };
    for t in (1..50).map(|i| 4e-4 * f64::from(i)) {
        assert!(motion(0, t).abs() < 1e-4 * motion(1, 2e-3).abs().max(1.0), "{t}: {}", motion(0, t));
    }
    // Between any two frequencies of the free film that feels it there is one of the pinned film.
    let pinned: Vec<f64> = found.poles.iter().map(|pole| pole.omega).collect();
    assert!(pinned.len() >= poles.len() && pinned[0] < 1.0);
    for pair in poles.windows(2).filter(|pair| pair[1].omega > pair[0].omega * (1.0 + 1e-9)) {
        let inside = |w: &&f64| **w >= pair[0].omega * (1.0 - 1e-9) && **w <= pair[1].omega * (1.0 + 1e-9);
        assert!(pinned.iter().any(|w| inside(&w)), "{pair:?}");
    }
}

/// Springs do not couple modes of one decay time: as many real oscillations as modes.
#[test]
fn a_spring_keeps_modes_real() {
    let surface = film(Edges::All(Edge::Clamped));
    let (shapes, poles) = modes(&surface, 1000.0);
    let spring = load(Footprint::point(Point::from_mm(62.0, 90.0)), 0.0, 0.0, 2e3);
    let loaded = Loaded::new(shapes, &poles, &[force(Point::from_mm(20.0, 31.0))], &[spring]).unwrap();
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    assert_eq!(found.poles.len(), poles.len());
    assert!(found.poles.iter().all(|p| p.onset == Onset::Velocity && (p.sigma * 0.07 - 1.0).abs() < 1e-10));
}

/// A rectangular patch against the series of a supported plate: ∫∇²φ over it is -k² times a product of two integrals of sines.
#[test]
fn a_rectangular_patch_on_a_supported_plate() {
    let mut surface = unit_plate(0.8, 0.3, Edges::All(Edge::Supported));
    surface.sheet.decay = Decay::Time(0.5);
    surface.emission = Emission { band: [0.0, 30.0], rate: 48e3, limit: 1.0, rms_limit: None };
    let (at, [width, height]) = (Point::new(0.31, 0.44), [0.14, 0.09]);
    let patch = Patch::Rectangular { sides: [width, height], angle: 0.0 };
    let kind = ActuatorKind::Piezo { patch, moment: 0.7, mass: 0.0 };
    surface.actuators = vec![Actuator { name: "p".into(), at, kind, contact_radius: 0.0 }];
    let found = modal(&surface, &ResponseOptions::default());
    let mut pairs: Vec<(f64, f64, f64)> = (1..20)
        .flat_map(|m| (1..20).map(move |n| (f64::from(m) * PI, f64::from(n) * PI / 0.8)))
        .map(|(kx, ky)| (kx.hypot(ky), kx, ky))
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let between = |k: f64, from: f64, to: f64| ((k * from).cos() - (k * to).cos()) / k;
    let exact: Vec<f64> = pairs
        .iter()
        .take(found.poles.len())
        .map(|(k, kx, ky)| {
            let along = between(*kx, at.x - 0.5 * width, at.x + 0.5 * width);
            let across = between(*ky, at.y - 0.5 * height, at.y + 0.5 * height);
            -0.7 * k * k * 2.0 / 0.8f64.sqrt() * along * across
        })
        .collect();
    let size = exact.iter().fold(0.0f64, |most, w| most.max(w.abs()));
    for (m, w) in exact.iter().enumerate() {
        let found = found.input[(0, m)];
        assert!((found.abs() - w.abs()).abs() < 1e-7 * size, "{m}: {found} {w}");
    }
}

/// A piezo patch against the series of a supported plate: ∫∇²φ over a disc is -k² times the disc's mean of a wave.
#[test]
fn a_piezo_patch_on_a_supported_plate() {
    let mut surface = unit_plate(0.8, 0.3, Edges::All(Edge::Supported));
    surface.sheet.decay = Decay::Time(0.5);
    surface.emission = Emission { band: [0.0, 30.0], rate: 48e3, limit: 1.0, rms_limit: None };
    let at = Point::new(0.31, 0.44);
    let kind = ActuatorKind::Piezo { patch: Patch::Round { radius: 0.06 }, moment: 0.7, mass: 0.0 };
    surface.actuators = vec![Actuator { name: "p".into(), at, kind, contact_radius: 0.0 }];
    let found = modal(&surface, &ResponseOptions::default());
    let mut exact: Vec<f64> = Vec::new();
    let mut pairs: Vec<(f64, f64, f64)> = (1..20)
        .flat_map(|m| (1..20).map(move |n| (f64::from(m) * PI, f64::from(n) * PI / 0.8)))
        .map(|(kx, ky)| (kx.hypot(ky), kx, ky))
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (k, kx, ky) in pairs.iter().take(found.poles.len()) {
        let shape = 2.0 / 0.8f64.sqrt() * (kx * at.x).sin() * (ky * at.y).sin();
        // The mean of J_0(kr) over the disc by a fine sum.
        let mean: f64 = (0..20000)
            .map(|i| {
                let r = 0.06 * ((f64::from(i) + 0.5) / 20000.0).sqrt();
                let x = k * r;
                let term = |n: &mut (f64, f64)| {
                    n.0 += 1.0;
                    n.1 *= -x * x / 4.0 / (n.0 * n.0);
                    n.1
                };
                let mut state = (0.0, 1.0);
                1.0 + (0..30).map(|_| term(&mut state)).sum::<f64>()
            })
            .sum::<f64>()
            / 20000.0;
        exact.push(-0.7 * k * k * PI * 0.06 * 0.06 * shape * mean);
    }
    let size = exact.iter().fold(0.0f64, |most, w| most.max(w.abs()));
    for (m, w) in exact.iter().enumerate() {
        assert!(
            (found.input[(0, m)].abs() - w.abs()).abs() < 1e-7 * size,
            "{m}: {} {w}",
            found.input[(0, m)]
        );
    }
}
