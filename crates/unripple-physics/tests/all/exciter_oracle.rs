//! Truth: exciters on a supported plate, by their closed forms, by the whole linear system solved directly, and in their limits.

use crate::coupled_common::{force, modal_transfer};
use crate::exciter_common::*;
// The name of an input is one of core's, too.
use crate::exciter_common::PROBE;
use crate::stepper_common;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::*;
use unripple_linalg::{General, Mat, c64, general};
use unripple_physics::stepper::Reading;
use unripple_physics::*;

/// Samples per second of the steps in time.
const RATE: f64 = 96e3;

fn loaded(transducers: &[Transducer]) -> Loaded {
    Loaded::new(Arc::new(Sines), &poles(), transducers, &[]).unwrap()
}

fn all(exciters: &[Exciter]) -> Vec<Transducer> {
    exciters.iter().map(Exciter::transducer).collect()
}

/// All oscillations, what they read at the probe, and the sum of their magnitudes there after an impulse of the first drive.
fn whole(loaded: &Loaded) -> (Oscillations, Vec<f64>, f64) {
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    let read = Footprint::point(PROBE).weights(found.shapes.as_ref());
    let size = (0..found.poles.len()).map(|m| (found.input[(0, m)] * read[m]).abs()).sum();
    (found, read, size)
}

/// The impedance of an exciter, and what of its force acts on a sheet held still.
#[test]
fn an_exciter_alone_by_its_closed_forms() {
    for voltage in [false, true] {
        let exciter = maker(57.0, 45.0, voltage);
        let Housing { mass, damping, stiffness } = exciter.housing;
        let load = exciter.transducer().load.unwrap();
        for s in frequencies() {
            let electric = if voltage { (s * 0.05e-3 + 4.0).inv() * 6.25 } else { c64::new(0.0, 0.0) };
            let tie = s.inv() * stiffness + damping + electric;
            let exact = s * 1.2e-3 + ((s * mass).inv() + tie.inv()).inv();
            assert!((load.impedance(s) - exact).norm() < 1e-11 * exact.norm(), "{s}");
            let share = s * mass / (s * mass + tie);
            assert!((load.transmission(s) - share).norm() < 1e-11 * share.norm(), "{s}");
        }
    }
    // Far below the resonance nothing, as s²; at it the quality factor; well above it all.
    let load = maker(57.0, 45.0, false).transducer().load.unwrap();
    let share = |hz: f64| load.transmission(c64::new(0.0, TAU * hz)).norm();
    assert!((share(0.2) / share(0.1) - 4.0).abs() < 1e-4 && share(0.1) < 1e-6);
    assert!((share(150.0) - 3.0).abs() < 1e-11 && (share(20e3) - 1.0).abs() < 1e-4);
}

#[test]
fn one_exciter_on_a_plate_against_the_whole_system() {
    for voltage in [false, true] {
        let exciters = [maker(57.0, 45.0, voltage)];
        let loaded = loaded(&all(&exciters));
        let (found, read, size) = whole(&loaded);
        for s in frequencies() {
            let exact = Solved::of(&exciters, 0, s).velocity(PROBE);
            let admittance = loaded.admittance(0, &Footprint::point(PROBE), s);
            assert!((admittance - exact).norm() < 1e-9 * exact.norm(), "{s}: {admittance} {exact}");
            let sum = modal_transfer(&found.poles, found.input.as_ref(), 0, &read, s);
            assert!((sum - exact).norm() < 1e-9 * size / s.norm(), "{s}: {sum} {exact}");
        }
    }
}

/// The roots of the characteristic equation: eigenvalues of the first-order system of modes, housing, spring and current, each scaled
/// such that half the sum of squares is the energy without the mass of the coil.
fn roots(exciter: &Exciter) -> Vec<c64> {
    let (w, poles) = (row(exciter.at), poles());
    let Circuit { force_constant, resistance, inductance } = exciter.coil;
    let Housing { mass, damping, stiffness } = exciter.housing;
    let (bl, k, m) = (force_constant / inductance.sqrt(), stiffness.sqrt(), mass.sqrt());
    let (housing, spring, current) = (2 * MODES, 2 * MODES + 1, 2 * MODES + 2);
    let size = if exciter.voltage { current + 1 } else { current };
    let mut matrix = Mat::<f64>::zeros(size, size);
    // Forces on the modes, then rates of change of the rest.
    let mut pull = Mat::<f64>::zeros(MODES, size);
    for (i, pole) in poles.iter().enumerate() {
        matrix[(i, MODES + i)] = pole.omega;
        pull[(i, i)] = -pole.omega;
        (0..MODES).for_each(|j| pull[(i, MODES + j)] = -damping * w[i] * w[j]);
        pull[(i, MODES + i)] -= 2.0 * pole.sigma;
        (pull[(i, housing)], pull[(i, spring)]) = (damping * w[i] / m, -k * w[i]);
        (matrix[(housing, MODES + i)], matrix[(spring, MODES + i)]) = (damping * w[i] / m, k * w[i]);
        if exciter.voltage {
            (pull[(i, current)], matrix[(current, MODES + i)]) = (bl * w[i], -bl * w[i]);
        }
    }
    matrix[(housing, housing)] = -damping / mass;
    (matrix[(housing, spring)], matrix[(spring, housing)]) = (k / m, -k / m);
    if exciter.voltage {
        (matrix[(housing, current)], matrix[(current, housing)]) = (-bl / m, bl / m);
        matrix[(current, current)] = -resistance / inductance;
    }
    // The mass μ of the coil takes its share of each force: (1 + μ w wᵀ)⁻¹ = 1 - μ w wᵀ/(1 + μ w·w).
    let square: f64 = w.iter().map(|w| w * w).sum();
    let heavy = exciter.moving_mass / (1.0 + exciter.moving_mass * square);
    for column in 0..size {
        let sum: f64 = (0..MODES).map(|j| w[j] * pull[(j, column)]).sum();
        (0..MODES).for_each(|i| matrix[(MODES + i, column)] = pull[(i, column)] - heavy * w[i] * sum);
    }
    let General { values, .. } = general(matrix.as_ref()).unwrap();
    values
}

#[test]
fn poles_are_the_roots_of_the_characteristic_equation() {
    let slow = Circuit { force_constant: 2.5, resistance: 4.0, inductance: 5e-3 };
    for exciter in
        [maker(57.0, 45.0, false), maker(57.0, 45.0, true), Exciter { coil: slow, ..maker(95.0, 70.0, true) }]
    {
        let roots = roots(&exciter);
        let (found, ..) = whole(&loaded(&all(&[exciter])));
        // A real pole p is written as an overdamped oscillation with the poles p and 2p.
        let of = |pole: &Pole| match pole.sigma > pole.omega {
            true => c64::new(-pole.omega / 2f64.sqrt(), 0.0),
            false => c64::new(-pole.sigma, ((pole.omega - pole.sigma) * (pole.omega + pole.sigma)).sqrt()),
        };
        let found: Vec<c64> = found.poles.iter().map(of).collect();
        let nearest = |s: c64, all: &[c64]| all.iter().map(|r| (r - s).norm()).fold(f64::INFINITY, f64::min);
        for s in &found {
            assert!(nearest(*s, &roots) < 1e-8 * s.norm(), "{s}");
        }
        for s in roots.iter().filter(|s| s.im >= 0.0) {
            assert!(nearest(*s, &found) < 1e-8 * s.norm(), "{s}: not found");
        }
        // One more oscillation than the plate has modes: that of the housing.
        assert_eq!(roots.iter().filter(|s| s.im > 0.0).count(), MODES + 1, "{roots:?}");
    }
}

/// A housing too heavy to move is the ground; if moreover nothing but the coil ties it to the plate, it leaves a moving magnet.
#[test]
fn heavy_housings_are_the_ground() {
    for voltage in [false, true] {
        let exciter = maker(57.0, 45.0, voltage);
        let Housing { damping, stiffness, .. } = exciter.housing;
        for (damping, stiffness) in [(damping, stiffness), (0.0, 0.0)] {
            let housing = Housing { mass: 1e9, damping, stiffness };
            let heavy = Exciter { housing, ..exciter }.transducer();
            let load = heavy.load.clone().map(|load| Load { housing: None, damping, stiffness, ..load });
            let grounded = loaded(&[Transducer { load, ..heavy.clone() }]);
            let heavy = loaded(&[heavy]);
            let (found, read, size) = whole(&heavy);
            for s in frequencies() {
                let [a, b] = [&heavy, &grounded].map(|one| one.admittance(0, &Footprint::point(PROBE), s));
                assert!((a - b).norm() < 1e-6 * b.norm(), "{voltage} {s}: {a} {b}");
                let sum = modal_transfer(&found.poles, found.input.as_ref(), 0, &read, s);
                assert!(
                    (sum - b).norm() < 1e-6 * b.norm() + 1e-9 * size / s.norm(),
                    "{voltage} {s}: {sum} {b}"
                );
            }
        }
    }
}

/// What b hears of a is what a hears of b, whatever drives them, and nothing gives energy.
#[test]
fn exciters_are_reciprocal_and_passive() {
    for voltages in [[false, false], [false, true], [true, true]] {
        let exciters = [maker(57.0, 45.0, voltages[0]), maker(170.0, 100.0, voltages[1])];
        let mut transducers = all(&exciters);
        transducers.push(force(PROBE));
        let loaded = loaded(&transducers);
        for s in frequencies() {
            let heard = |driven: usize, hears: usize| {
                let moved = loaded.admittance(driven, &Footprint::point(exciters[hears].at), s);
                let load = transducers[hears].load.as_ref().unwrap();
                let closed = load.circuit.map_or(c64::new(1.0, 0.0), |coil| coil.admittance(s));
                moved * closed * load.transmission(s) * exciters[hears].coil.force_constant
            };
            let (there, back) = (heard(0, 1), heard(1, 0));
            assert!((there - back).norm() < 1e-9 * there.norm(), "{voltages:?} {s}: {there} {back}");
            // Against the direct solution, each at itself as well.
            for (driven, hears) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let (exact, size) = Solved::of(&exciters, driven, s).signal(&exciters, hears);
                let error = (heard(driven, hears) - exact).norm();
                assert!(
                    error < 1e-8 * exact.norm() + 1e-10 * size,
                    "{driven} {hears} {s}: {error:e} {exact}"
                );
            }
        }
        // A force beside them does work, on all of it and on each exciter.
        for hz in (1..400).map(|i| 7.0 * f64::from(i)) {
            let s = c64::new(0.0, TAU * hz);
            let y = loaded.admittance(2, &Footprint::point(PROBE), s);
            assert!(y.re > 0.0, "{hz}: {y}");
            let mut loads = transducers.iter().filter_map(|transducer| transducer.load.as_ref());
            assert!(loads.all(|load| load.impedance(s).re > 0.0), "{hz}");
        }
        assert!(whole(&loaded).0.poles.iter().all(|pole| pole.sigma > 0.0));
    }
}

/// The plate with exciters, stepped through time.
fn surface(exciters: &[Exciter; 2]) -> VirtualSurface {
    let outline = Outline::new(Shape::Rectangle { width: SIDES[0], height: SIDES[1] });
    let plant = Plant::new(&poles(), Arc::new(Sines), outline).unwrap();
    let channels: Vec<Channel> = exciters.iter().map(|exciter| exciter.transducer().into()).collect();
    // One step a sample: what is taken off for the half of an impulse that is heard at once (see `stepped`) is exact for that alone.
    let options = StepperOptions { substeps: 1, ..Default::default() };
    let mut surface = VirtualSurface::new(&plant, &channels, RATE, &options).unwrap();
    surface.set_probes(&[(PROBE, Reading::Velocity)]).unwrap();
    surface
}

/// Both sensors and the probe per unit of the first drive in a steady tone.
fn stepped(exciters: &[Exciter; 2], hz: f64) -> [c64; 3] {
    // Of what the beginning makes ring, less than 1e-4 is left after half of this.
    let frames = (0.6 * RATE) as usize;
    let period = (RATE / hz).round() as usize;
    let mut drive = vec![0.0; 2 * frames];
    (0..frames).for_each(|i| drive[i] = (TAU * hz * i as f64 / RATE).cos());
    let (sensors, probes) = stepper_common::run(&mut surface(exciters), &drive);
    let tone = |plane: &[f64]| -> c64 {
        // The last periods, the beginning long died away.
        let last = plane.len() - 8 * period..plane.len();
        let turn = |i: usize| c64::new(0.0, -TAU * hz * i as f64 / RATE).exp();
        last.clone().map(|i| turn(i) * plane[i]).sum::<c64>() * (2.0 / last.len() as f64)
    };
    // Half of what an impulse makes heard at once, since the simulation takes that whole.
    let (at_once, probed) = stepper_common::run(&mut surface(exciters), &[RATE, 0.0]);
    let half = |value: f64| value / (2.0 * RATE);
    [
        tone(&sensors[..frames]) - half(at_once[0]),
        tone(&sensors[frames..]) - half(at_once[1]),
        tone(&probes) - half(probed[0]),
    ]
}

#[test]
fn exciters_in_time_move_and_hear_as_the_whole_system() {
    for voltages in [[false, false], [false, true], [true, true]] {
        let exciters = [maker(57.0, 45.0, voltages[0]), maker(170.0, 100.0, voltages[1])];
        for hz in [100.0, 250.0, 500.0, 1000.0] {
            let solved = Solved::of(&exciters, 0, c64::new(0.0, TAU * hz));
            let [own, other] = [0, 1].map(|e| solved.signal(&exciters, e).0);
            let exact = [own, other, solved.velocity(PROBE)];
            for (what, (found, exact)) in
                ["own", "other", "probe"].iter().zip(stepped(&exciters, hz).into_iter().zip(exact))
            {
                let ratio = found / exact;
                let late = -ratio.arg() / (TAU * hz) * RATE;
                println!("{voltages:?} {hz} Hz {what}: {:.4}, {late:+.3} samples", ratio.norm());
                assert!((ratio.norm() - 1.0).abs() < 0.01 && late.abs() < 0.05, "{voltages:?} {hz} {what}");
            }
        }
    }
}
