//! Truth: resonators on a plate against their closed form, the whole quadratic eigenvalue problem, exact transfer matrices of a strip, the
//! dispersion relation of a lattice, and the bare plate in the limit of no mass.

use crate::coupled_common::{force, modal, modal_transfer, transfer};
use crate::exciter_common::{MODES, PROBE, Sines, poles, row};
use crate::stepper_common;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::*;
use unripple_linalg::{General, Mat, c64, general};
use unripple_physics::design::papers_surface;
use unripple_physics::stepper::Reading;
use unripple_physics::*;

fn resonator(x_mm: f64, y_mm: f64, mass: f64, frequency: f64, quality_factor: f64) -> Resonator {
    Resonator { at: Point::from_mm(x_mm, y_mm), mass, frequency, quality_factor }
}

/// An aluminium plate of 300 x 200 x 1 mm, supported, with one force.
fn plate() -> Surface {
    let mut surface = papers_surface();
    let shape = Shape::Rectangle { width: 0.3, height: 0.2 };
    surface.outline = Outline::new(shape).with_edges(Edges::All(Edge::Supported));
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.poisson) = (70e9, 2700.0, 0.33);
    (sheet.thickness, sheet.tension, sheet.decay) = (1e-3, 0.0, Decay::Time(0.5));
    surface.emission.band = [0.0, 500.0];
    surface.actuators.truncate(1);
    surface
}

#[test]
fn a_resonator_reacts_as_its_closed_form_says() {
    let one = resonator(10.0, 10.0, 2e-3, 250.0, 20.0);
    let load = Load::resonator(&one);
    for hz in [10.0, 200.0, 250.0, 251.0, 1000.0] {
        let (x, s) = (hz / 250.0, c64::new(0.0, TAU * hz));
        let lossy = c64::new(0.0, x / 20.0);
        // The force on the sheet per displacement is -s Z(s).
        let exact = (lossy + 1.0) / (lossy + (1.0 - x * x)) * (2e-3 * (TAU * hz).powi(2));
        let found = -s * load.impedance(s);
        assert!((found - exact).norm() < 1e-12 * exact.norm(), "{hz}: {found} {exact}");
    }
}

#[test]
fn resonators_of_vanishing_mass_leave_the_bare_sheet() {
    let mut surface = papers_surface();
    surface.outline = surface.outline.clone().with_edges(Edges::All(Edge::Supported));
    surface.emission.band = [0.0, 1500.0];
    let bare = modal(&surface, &ResponseOptions::default());
    let mut loaded = surface.clone();
    loaded.sheet.uneven.resonators =
        vec![resonator(40.0, 30.0, 1e-18, 701.0, 30.0), resonator(101.0, 77.0, 1e-18, 1204.0, 300.0)];
    let loaded = modal(&loaded, &ResponseOptions::default());
    for pole in &bare.poles {
        let nearest = loaded.poles.iter().map(|other| (other.omega / pole.omega - 1.0).abs());
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9, "{} Hz: {nearest:e}", pole.omega / TAU);
    }
    let at = Footprint::point(Point::from_mm(61.0, 92.0));
    let read = |modal: &ModalResponses| at.weights(modal.shapes.as_ref());
    let (one, other) = (read(&bare), read(&loaded));
    for hz in [100.0, 333.0, 701.0, 1100.0, 1204.0] {
        let s = c64::new(0.0, TAU * hz);
        let exact = modal_transfer(&bare.poles, bare.input.as_ref(), 0, &one, s);
        let found = modal_transfer(&loaded.poles, loaded.input.as_ref(), 0, &other, s);
        let size: f64 = (0..one.len()).map(|m| (bare.input[(0, m)] * one[m]).abs()).sum();
        assert!((found - exact).norm() < 1e-9 * size / s.norm(), "{hz}: {found} {exact}");
    }
}

/// Three resonators, light and heavy, of low and high losses.
fn three() -> [Resonator; 3] {
    [
        resonator(57.0, 45.0, 0.02, 150.0, 5.0),
        resonator(170.0, 100.0, 0.002, 300.0, 50.0),
        resonator(120.0, 33.0, 0.01, 900.0, 200.0),
    ]
}

/// Frequencies and decay rates of all that oscillates, by the quadratic eigenvalue problem of modes and masses in its companion form.
fn brute_force(resonators: &[Resonator]) -> Vec<(f64, f64)> {
    let size = MODES + resonators.len();
    let (mut stiffness, mut damping) = (Mat::<f64>::zeros(size, size), Mat::<f64>::zeros(size, size));
    let mut mass = vec![1.0; size];
    for (m, pole) in poles().iter().enumerate() {
        (stiffness[(m, m)], damping[(m, m)]) = (pole.omega * pole.omega, 2.0 * pole.sigma);
    }
    for (r, one) in resonators.iter().enumerate() {
        let omega = TAU * one.frequency;
        let (k, c) = (one.mass * omega * omega, one.mass * omega / one.quality_factor);
        // Extension of the spring: the mass's displacement less that of the plate.
        let mut extension = row(one.at).iter().map(|w| -w).collect::<Vec<_>>();
        extension.resize(size, 0.0);
        extension[MODES + r] = 1.0;
        mass[MODES + r] = one.mass;
        for i in 0..size {
            for j in 0..size {
                stiffness[(i, j)] += k * extension[i] * extension[j];
                damping[(i, j)] += c * extension[i] * extension[j];
            }
        }
    }
    // Time in units in which all entries are near one or below: in seconds, those of the highest mode would round away what is low.
    let unit = poles().iter().fold(0.0, |unit: f64, pole| unit.max(pole.omega));
    let companion = Mat::from_fn(2 * size, 2 * size, |i, j| match (i < size, j < size) {
        (true, _) => f64::from(u8::from(j == i + size)),
        (false, true) => -stiffness[(i - size, j)] / mass[i - size] / (unit * unit),
        (false, false) => -damping[(i - size, j - size)] / mass[i - size] / unit,
    });
    let General { values, .. } = general(companion.as_ref()).unwrap();
    let mut found: Vec<(f64, f64)> =
        values.iter().filter(|s| s.im > 0.0).map(|s| (unit * s.norm(), -unit * s.re)).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

#[test]
fn modes_with_resonators_against_the_whole_quadratic_problem() {
    let loads: Vec<Load> = three().iter().map(Load::resonator).collect();
    let loaded = Loaded::new(Arc::new(Sines), &poles(), &[force(PROBE)], &loads).unwrap();
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    let exact = brute_force(&three());
    assert_eq!((found.modes.len(), exact.len()), (MODES + 3, MODES + 3));
    for (pole, (omega, sigma)) in found.modes.iter().zip(exact) {
        assert!((pole.omega - omega).abs() < 1e-9 * omega, "{} {omega}", pole.omega);
        assert!((pole.sigma - sigma).abs() < 1e-9 * omega, "{} {sigma}", pole.sigma);
    }
}

/// Length (m), mass per length (kg/m) and bending stiffness (N·m²) of a strip.
const STRIP: [f64; 3] = [0.4, 0.05, 0.12];
/// Modes of the strip: of its compliance at a point 1e-8 is left out.
const ALONG: usize = 240;

/// The sines of a supported strip.
#[derive(Debug)]
struct Strip;

impl Shapes for Strip {
    fn modes(&self) -> usize {
        ALONG
    }

    fn at(&self, p: Point, row: &mut [f64]) {
        let [length, mass, _] = STRIP;
        for (m, row) in row.iter_mut().enumerate() {
            *row = (2.0 / (mass * length)).sqrt() * ((m + 1) as f64 * PI * p.x / length).sin();
        }
    }
}

/// Displacement, slope, curvature and its slope of the strip, carried over a distance (m) at the angular frequency ω, exactly.
fn carried(state: [c64; 4], distance: f64, omega: f64) -> [c64; 4] {
    let [_, mass, stiffness] = STRIP;
    let b = (mass * omega * omega / stiffness).powf(0.25);
    let z = b * distance;
    let even = [z.cosh() + z.cos(), z.cosh() - z.cos()];
    let odd = [z.sinh() + z.sin(), z.sinh() - z.sin()];
    let c = [even[0] / 2.0, odd[0] / (2.0 * b), even[1] / (2.0 * b * b), odd[1] / (2.0 * b.powi(3))];
    let b4 = b.powi(4);
    let rows = [
        [c[0], c[1], c[2], c[3]],
        [b4 * c[3], c[0], c[1], c[2]],
        [b4 * c[2], b4 * c[3], c[0], c[1]],
        [b4 * c[1], b4 * c[2], b4 * c[3], c[0]],
    ];
    rows.map(|row| row.iter().zip(state).map(|(r, x)| x * *r).sum())
}

/// Displacement at `read` per unit force at `driven` (m from the left end) on the strip with resonators (in order of x), by transfer matrices.
fn two_port(resonators: &[Resonator], driven: f64, read: f64, omega: f64) -> c64 {
    let [length, _, stiffness] = STRIP;
    let zero = c64::new(0.0, 0.0);
    // What happens from left to right: a resonator, the force or the reading.
    let mut stops: Vec<(f64, Option<&Resonator>)> = resonators.iter().map(|r| (r.at.x, Some(r))).collect();
    stops.extend([(driven, None), (read, None), (length, None)]);
    stops.sort_by(|a, b| a.0.total_cmp(&b.0));
    let run = |start: [c64; 4], pushed: f64| -> ([c64; 4], c64) {
        let (mut state, mut at, mut seen) = (start, 0.0, zero);
        for (x, stop) in &stops {
            state = carried(state, x - at, omega);
            at = *x;
            if let Some(one) = stop {
                let ratio = omega / (TAU * one.frequency);
                let lossy = c64::new(0.0, ratio / one.quality_factor);
                let reaction = (lossy + 1.0) / (lossy + (1.0 - ratio * ratio)) * (one.mass * omega * omega);
                state[3] += reaction * state[0] / stiffness;
            } else if *x == driven {
                state[3] += pushed / stiffness;
            } else if *x == read {
                seen = state[0];
            }
        }
        (state, seen)
    };
    let unit = |i: usize| {
        let mut start = [zero; 4];
        start[i] = c64::new(1.0, 0.0);
        start
    };
    // Slope and shear at the left end are such that displacement and curvature vanish at the right one.
    let [(slope, a), (shear, b), (forced, c)] = [run(unit(1), 0.0), run(unit(3), 0.0), run([zero; 4], 1.0)];
    let det = slope[0] * shear[2] - slope[2] * shear[0];
    let p = (shear[0] * forced[2] - forced[0] * shear[2]) / det;
    let q = (slope[2] * forced[0] - slope[0] * forced[2]) / det;
    a * p + b * q + c
}

#[test]
fn a_strip_with_resonators_against_exact_transfer_matrices() {
    let [length, mass, stiffness] = STRIP;
    let omega = |m: usize| (stiffness / mass).sqrt() * ((m + 1) as f64 * PI / length).powi(2);
    let poles: Vec<Pole> = (0..ALONG).map(|m| Pole::new(omega(m), 0.0)).collect();
    let resonators = [
        resonator(70.0, 0.0, 1e-3, 120.0, 30.0),
        resonator(210.0, 0.0, 2e-3, 150.0, 20.0),
        resonator(330.0, 0.0, 1e-3, 90.0, 10.0),
    ];
    let loads: Vec<Load> = resonators.iter().map(Load::resonator).collect();
    let [driven, read] = [0.123, 0.287];
    let transducer = force(Point::new(driven, 0.0));
    let loaded = Loaded::new(Arc::new(Strip), &poles, &[transducer], &loads).unwrap();
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    let weights = Footprint::point(Point::new(read, 0.0)).weights(found.shapes.as_ref());
    for hz in [5.0, 33.0, 90.0, 121.0, 333.0, 500.0] {
        let s = c64::new(0.0, TAU * hz);
        let exact = s * two_port(&resonators, driven, read, TAU * hz);
        let sum = modal_transfer(&found.poles, found.input.as_ref(), 0, &weights, s);
        assert!((sum - exact).norm() < 1e-6 * exact.norm(), "{hz} Hz: {sum} {exact}");
    }
}

/// 12 x 8 resonators of 200 Hz on the plate, of half its mass.
fn lattice(quality_factor: f64) -> Lattice {
    Lattice {
        corners: [Point::new(0.0, 0.0), Point::new(0.3, 0.2)],
        cells: [12, 8],
        mass: 0.5 * 2.7 * 0.025 * 0.025,
        frequency: 200.0,
        quality_factor,
        scatter: 0.0,
        seed: 1,
    }
}

/// Bending stiffness of the plate, in N·m.
fn bending() -> f64 {
    70e9 * 1e-9 / 12.0 / (1.0 - 0.33 * 0.33)
}

/// Time reversal of one frequency has the shape of the real part of the mobility between places and the target, whose mean over targets and
/// directions is J0(kr) far from edges. Over so few waves and targets it is that within some per cent.
#[test]
fn a_focus_in_a_lattice_is_as_small_as_its_waves_and_below_the_limit_of_the_bare_plate() {
    let mut surface = plate();
    surface.sheet.uneven.lattices = vec![lattice(30.0)];
    let first = surface.actuators[0].clone();
    let targets: Vec<Point> = [100.0, 125.0, 150.0, 175.0, 200.0]
        .into_iter()
        .flat_map(|x| [80.0, 100.0, 120.0].map(|y| Point::from_mm(x, y)))
        .collect();
    surface.actuators = targets.iter().map(|at| Actuator { at: *at, ..first.clone() }).collect();
    let modal = modal(&surface, &ResponseOptions::default());
    for x in [0.95, 0.97] {
        let omega = TAU * 200.0 * x;
        let s = c64::new(0.0, omega);
        let transfers: Vec<c64> = modal.poles.iter().map(|pole| transfer(pole, s)).collect();
        let mean = |radius: f64| -> f64 {
            let around = |(a, at): (usize, &Point)| -> f64 {
                let turned = |i: u8| f64::from(i) * PI / 4.0;
                let place = |i| Point::new(at.x + radius * turned(i).cos(), at.y + radius * turned(i).sin());
                let places: Vec<Point> = (0..8).map(place).collect();
                let read = modal.shapes.at_all(&places);
                let one = |p: usize| -> f64 {
                    let each = transfers.iter().enumerate();
                    each.map(|(m, t)| t.re * modal.input[(a, m)] * read[(p, m)]).sum()
                };
                (0..8).map(one).sum()
            };
            targets.iter().enumerate().map(around).sum()
        };
        let (mut inside, mut outside, peak) = (0.02, 0.07, mean(0.0));
        for _ in 0..16 {
            let middle = 0.5 * (inside + outside);
            if mean(middle) > 0.5 * peak { inside = middle } else { outside = middle }
        }
        let lossy = c64::new(0.0, x / 30.0);
        let factor = (lossy + 1.0) / (lossy + (1.0 - x * x)) * 0.5 + 1.0;
        let bare = (2.7 * omega * omega / bending()).powf(0.25);
        let wavenumber = bare * factor.sqrt().sqrt().re;
        // J0 is a half at 1.5211.
        assert!((inside * wavenumber / 1.5211 - 1.0).abs() < 0.1, "{x}: {inside} m, {wavenumber} rad/m");
        assert!(inside < 0.7 * 1.5211 / bare, "{x}: {inside} m, bare {} m", 1.5211 / bare);
    }
}

#[test]
fn a_lattice_has_the_modes_and_the_gap_of_its_dispersion_relation() {
    let mut surface = plate();
    let (ratio, frequency) = (0.5, 200.0);
    surface.sheet.uneven.lattices = vec![lattice(1e5)];
    let modes = SurfaceModes::solve(&surface, 500.0, 1e-6).unwrap().loaded.unwrap();
    let stiffness = bending();
    // At the centres of cells sines of different waves are orthogonal, so that each pair of branches is exact.
    for (m, n) in [(1.0, 1.0), (2.0, 1.0), (1.0, 2.0), (3.0, 1.0)] {
        let square = (m * PI / 0.3_f64).powi(2) + (n * PI / 0.2_f64).powi(2);
        let a = stiffness * square * square / (2.7 * (TAU * frequency).powi(2));
        // ω²(1 + μ/(1 - ω²/ω_0²)) = a ω_0².
        let half = 0.5 * (1.0 + ratio + a);
        for y in [half - (half * half - a).sqrt(), half + (half * half - a).sqrt()] {
            let omega = TAU * frequency * y.sqrt();
            if omega > TAU * 500.0 {
                continue;
            }
            let nearest = modes.iter().map(|pole| (pole.omega / omega - 1.0).abs());
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "{m} {n} {} Hz: {nearest:e}", omega / TAU);
        }
    }
    let share = |pole: &Pole| pole.omega / (TAU * frequency);
    assert_eq!(modes.iter().filter(|pole| share(pole) < 1.0 + 1e-6).count(), 96);
    let gap = modes.iter().map(share).filter(|x| (1.0 + 1e-6..1.5_f64.sqrt()).contains(x)).count();
    assert_eq!(gap, 0);
    assert!(modes.iter().any(|pole| share(pole) > 1.5_f64.sqrt()));
}

#[test]
fn resonators_in_time_move_as_their_oscillations_and_give_no_energy() {
    let mut surface = plate();
    surface.sheet.uneven.resonators =
        vec![resonator(70.0, 60.0, 0.02, 180.0, 20.0), resonator(200.0, 130.0, 0.01, 320.0, 40.0)];
    let rate = surface.emission.rate;
    let modes = Arc::new(Modes::solve(&surface, 1000.0, 1e-6).unwrap());
    let probe = Point::from_mm(171.0, 83.0);
    let loaded = Loaded::new(
        modes.clone(),
        modes.poles(),
        &transducers(&surface).unwrap(),
        &resonators(&surface).unwrap(),
    );
    let found = loaded.unwrap().oscillations(1e9, [0.0, 1e9]).unwrap();
    let read = Footprint::point(probe).weights(found.shapes.as_ref());
    let mut stepped = VirtualSurface::of(&surface, modes, &StepperOptions::default()).unwrap();
    stepped.set_probes(&[(probe, Reading::Velocity)]).unwrap();
    let mut drive = vec![0.0; 4800];
    drive[0] = rate;
    let (_, heard) = stepper_common::run(&mut stepped, &drive);
    let exact = |i: usize| -> f64 {
        let time = i as f64 / rate;
        let each = found.poles.iter().enumerate();
        each.map(|(m, pole)| found.input[(0, m)] * read[m] * pole.velocity(time)).sum()
    };
    let exact: Vec<f64> = (0..heard.len()).map(exact).collect();
    let largest = exact.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let worst = heard.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 0.02 * largest, "{worst} of {largest}");
    // Left alone, the sheet and its resonators only lose energy.
    let mut last = stepped.energy();
    for _ in 0..20 {
        stepper_common::run(&mut stepped, &[0.0; 480]);
        let energy = stepped.energy();
        assert!(energy <= last * (1.0 + 1e-12), "{energy} after {last}");
        last = energy;
    }
}
