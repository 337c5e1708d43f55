//! Virtual calibrations of every kind of actuator: no wire told wrong, latency found, and the focus of the true responses.
//!
//! Small bands and every second kind by default. With UNRIPPLE_ALL_KINDS=1 all kinds, on the whole bands and on surfaces that are not as they
//! are told as well, some minutes.

use crate::kinds_bench;

use kinds_bench::*;
use unripple_calibrate::measure::MeasureOptions;
use unripple_calibrate::signals::Sweep;
use unripple_core::{ActuatorKind, CoilDrive, Decay, Outline, Point, Shape, Surface};
use unripple_devices::Perturbation;

const AT: Point = Point::new(0.062, 0.090);
const ON_GLASS: Point = Point::new(0.0617, 0.0553);
const ON_TABLE: Point = Point::new(0.47, 0.33);

/// Tolerances of latency, in samples, and of contrast.
const LATE: f64 = 0.05;
const SHARE: f64 = 0.97;

/// Tolerance of latency with exciters whose housings are strongly damped, as the guide says it: damping between housing and sheet couples the
/// modes, and the model corrects the phases that come of it in part.
const LATE_WHERE_DAMPED: f64 = 0.1;

/// Kinds that each run tries on surfaces as told: each way to drive, with what makes it difficult. Surfaces that are not as told have others.
const FEW: [&str; 5] = [
    "voltage, 1.9 mH, 7 mg",
    "exciter on a current, damped",
    "exciter on a voltage",
    "all kinds on one film",
    "patch, 300 mg",
];

/// Surfaces with every kind of actuator, each with a target and a window (s), to a top frequency of films and of glass.
fn kinds(top: f64, on_glass: f64) -> Vec<(&'static str, Surface, Point, f64)> {
    use CoilDrive::{Current, Voltage};
    let all = |kind: ActuatorKind| film(top, move |_| kind);
    let mixed = move |i: usize| match i % 4 {
        0 => ActuatorKind::Force,
        1 => coil(0.5, 1.9e-3, 7e-6, Current),
        2 => coil(0.5, 1.9e-3, 7e-6, Voltage),
        _ => coil(1.0, 0.0, 2e-6, Voltage),
    };
    let film = |name, surface| (name, surface, AT, 0.03);
    let glass = |name, surface| (name, surface, ON_GLASS, 0.012);
    vec![
        film("force", all(ActuatorKind::Force)),
        film("current, no mass", all(coil(0.5, 1.9e-3, 0.0, Current))),
        film("current, 7 mg", all(coil(0.5, 1.9e-3, 7e-6, Current))),
        film("voltage, no inductance", all(coil(0.5, 0.0, 0.0, Voltage))),
        film("voltage, 0.13 mH", all(coil(0.5, 0.13e-3, 0.0, Voltage))),
        film("voltage, 1.9 mH", all(coil(0.5, 1.9e-3, 0.0, Voltage))),
        film("voltage, 1.9 mH, 7 mg", all(coil(0.5, 1.9e-3, 7e-6, Voltage))),
        film("voltage, 1.9 mH, 6 N/A", all(coil(6.0, 1.9e-3, 7e-6, Voltage))),
        film("exciter on a current", all(exciter(Current, 10.0))),
        film("exciter on a current, damped", all(exciter(Current, 3.0))),
        film("exciter on a voltage", all(exciter(Voltage, 10.0))),
        film("all kinds on one film", kinds_bench::film(top, mixed)),
        glass("patch", kinds_bench::glass(on_glass, 0.0)),
        glass("patch, 300 mg", kinds_bench::glass(on_glass, 300e-6)),
    ]
}

fn told(name: &str, found: &Found) {
    println!(
        "{name:32} faults {}  latency {:+.3} ± {:.3}  reciprocity {:.2} %  contrast {:.2}, {:.1} % of it",
        found.faults.len(),
        found.latency[0],
        found.latency[1],
        100.0 * found.reciprocity,
        found.contrast,
        100.0 * found.share
    );
    found.faults.iter().for_each(|fault| println!("    {fault}"));
}

fn right(name: &str, found: &Found) -> bool {
    let late = if name.ends_with("damped") { LATE_WHERE_DAMPED } else { LATE };
    found.faults.is_empty() && found.latency[0].abs() < late && found.share >= SHARE
}

fn whole() -> bool {
    std::env::var_os("UNRIPPLE_ALL_KINDS").is_some()
}

#[test]
fn every_kind_calibrates_right() {
    let sizes = if whole() { vec![(1000.0, 4000.0), (3000.0, 12e3)] } else { vec![(1000.0, 4000.0)] };
    let mut wrong = Vec::new();
    for (top, on_glass) in sizes {
        for (name, surface, at, window) in kinds(top, on_glass) {
            if !whole() && !FEW.contains(&name) {
                continue;
            }
            let found = calibrate(&surface, None, &MeasureOptions::default(), at, window);
            told(&format!("{name}, to {} Hz", surface.emission.band[1]), &found);
            if !right(name, &found) {
                wrong.push(format!("{name} to {top} Hz"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// The signal of a coil, turned into velocities, is that of a probe at the coil's place, its own sweep included: that response is loudest
/// where what precedes time 0 was cut away.
///
/// Coils have mass here: one without, and little inductance, moves at once with each sample of the virtual drive, and the probe hears
/// images of the band that the coil's current hardly has.
#[test]
fn coils_tell_the_velocity_of_their_own_places() {
    let mut wrong = Vec::new();
    for inductance in [0.0, 0.5e-3, 1.9e-3] {
        let surface = film(1000.0, |_| coil(0.6, inductance, 7e-6, CoilDrive::Voltage));
        let [own, others] = at_an_actuator(&surface, 2);
        println!("{:4.1} mH: off by {own:.4} itself, {others:.4} of others", 1e3 * inductance);
        if own > 0.02 || others > 0.02 {
            wrong.push(inductance);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Surfaces that are not as they are told.
#[test]
fn unknown_surfaces_with_every_kind_calibrate() {
    let (top, on_glass) = if whole() { (3000.0, 12e3) } else { (1000.0, 4000.0) };
    let mut wrong = Vec::new();
    for (name, surface, at, window) in kinds(top, on_glass) {
        if !whole() && !["force", "current, 7 mg", "exciter on a current", "patch"].contains(&name) {
            continue;
        }
        let found =
            calibrate(&surface, Some(&Perturbation::default()), &MeasureOptions::default(), at, window);
        told(&format!("{name}, unknown"), &found);
        if !right(name, &found) {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn sweeps_begin_below_the_lowest_mode() {
    for (surface, highest) in [(table(6), 60.0), (unripple_physics::design::papers_surface(), 60.0)] {
        let model = modal(&surface, None, 1e-4);
        let lowest =
            model.poles.iter().map(|pole| pole.omega / std::f64::consts::TAU).fold(f64::MAX, f64::min);
        let from = MeasureOptions::for_model(&model).start_hz;
        println!("lowest mode {lowest:.1} Hz, swept from {from:.1}");
        assert!(from <= 0.7 * lowest && from <= highest && (lowest < 100.0 || from == highest));
    }
}

/// A sheet that rings for minutes, its only mode in the band near 1 Hz: the sweep ends above where it begins, and is not too long.
#[test]
fn a_slow_sheet_gets_a_sweep_that_can_be_played() {
    let mut slow = film(1.5, |_| ActuatorKind::Force);
    slow.outline = Outline::new(Shape::Rectangle { width: 1.0, height: 1.0 });
    (slow.sheet.tension, slow.sheet.decay, slow.emission.rate) = (0.35, Decay::Time(100.0), 100.0);
    let options = MeasureOptions::for_model(&modal(&slow, None, 1e-4));
    let [from, to] = options.swept(&slow);
    let sweep = Sweep { rate: slow.emission.rate, from, to, seconds: options.sweep, ..Sweep::default() };
    assert!(sweep.stimulus().is_ok(), "{sweep:?}");
    assert!(options.response_length <= 60.0, "{options:?}");
}

/// Its lowest modes ring for a second: the wiring test waits for them, and so do sweeps, which begin below them.
#[test]
fn a_table_calibrates() {
    let unknowns = Perturbation { seed: 3, ..Perturbation::default() };
    let settings = MeasureOptions {
        start_hz: 15.0,
        settle_time: 1.5,
        sweep: 2.0,
        response_length: 0.4,
        ..MeasureOptions::default()
    };
    let mut wrong = Vec::new();
    let unknown = |exciters| (exciters, Some(&unknowns));
    for (exciters, unknowns) in if whole() { vec![(6, None), unknown(16)] } else { vec![unknown(6)] } {
        let found = calibrate(&table(exciters), unknowns, &settings, ON_TABLE, 0.04);
        let name = format!("table, {exciters} exciters, {}", unknowns.map_or("as told", |_| "unknown"));
        told(&name, &found);
        if !found.faults.is_empty() || found.share < 0.95 {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
