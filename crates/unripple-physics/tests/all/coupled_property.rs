//! Truth: what holds for every loaded sheet: reciprocity, passivity, and two routes to one answer.

use crate::coupled_common;
use crate::modes_common;
use unripple_linalg::c64;

use coupled_common::*;
use modes_common::*;
use proptest::prelude::*;
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_physics::*;

const TOP: f64 = 700.0;

/// A supported film with modes of several decay times, most of its frequencies single.
fn sheet(decay: Decay) -> Surface {
    let mut surface = film(Edges::All(Edge::Supported));
    surface.outline.shape = Shape::Rectangle { width: 0.15, height: 0.11 };
    surface.sheet.decay = decay;
    surface
}

fn decay() -> impl Strategy<Value = Decay> {
    prop_oneof![
        Just(Decay::Time(0.07)),
        Just(Decay::Time(f64::INFINITY)),
        Just(Decay::Table(vec![(100.0, 0.1), (600.0, 0.02)])),
        Just(Decay::LossFactor(0.02)),
    ]
}

fn place() -> impl Strategy<Value = Point> {
    (0.005..0.145, 0.005..0.105).prop_map(|(x, y)| Point::new(x, y))
}

fn footprint() -> impl Strategy<Value = Footprint> {
    let outline = sheet(Decay::Time(0.07)).outline;
    prop_oneof![
        place().prop_map(Footprint::point),
        (place(), 1e-3..10e-3).prop_map(move |(at, radius)| Footprint::disc(at, radius, &outline)),
        (place(), place()).prop_map(|(from, to)| Footprint::line(from, to, 6)),
    ]
}

/// Nothing, or something over orders of magnitude.
fn amount(low: f64, high: f64) -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 3 => (low.ln()..high.ln()).prop_map(f64::exp)]
}

fn circuit() -> impl Strategy<Value = Option<Circuit>> {
    let coil =
        (0.1..10.0, 1.0..20.0, amount(1e-5, 1e-2)).prop_map(|(force_constant, resistance, inductance)| {
            Circuit { force_constant, resistance, inductance }
        });
    prop_oneof![2 => Just(None), 1 => coil.prop_map(Some)]
}

fn housing() -> impl Strategy<Value = Option<Housing>> {
    let mass = (1e-3_f64.ln()..1e-1_f64.ln()).prop_map(f64::exp);
    let housing = (mass, amount(1e-3, 1.0), amount(10.0, 1e4))
        .prop_map(|(mass, damping, stiffness)| Housing { mass, damping, stiffness });
    prop_oneof![2 => Just(None), 1 => housing.prop_map(Some)]
}

fn loads() -> impl Strategy<Value = Vec<Load>> {
    let values = (amount(1e-6, 1e-2), amount(1e-3, 10.0), amount(1.0, 1e5));
    let load = (footprint(), values, circuit(), housing()).prop_map(
        |(footprint, (mass, damping, stiffness), circuit, housing)| Load {
            footprint,
            mass,
            damping,
            stiffness,
            circuit,
            housing,
        },
    );
    proptest::collection::vec(load, 1..4)
}

fn loaded(decay: Decay, sources: &[Point], loads: &[Load]) -> Loaded {
    let (shapes, poles) = modes(&sheet(decay), TOP);
    let forces: Vec<Transducer> = sources.iter().map(|at| force(*at)).collect();
    Loaded::new(shapes, &poles, &forces, loads).unwrap()
}

/// All oscillations, and what they read at points.
fn whole(loaded: &Loaded, at: &[Point]) -> (Oscillations, unripple_linalg::Mat<f64>) {
    let found = loaded.oscillations(1e9, [0.0, 1e9]).unwrap();
    let read = found.shapes.at_all(at);
    (found, read)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn sources_and_places_may_be_exchanged(decay in decay(), a in place(), b in place(), loads in loads()) {
        let (found, read) = whole(&loaded(decay, &[a, b], &loads), &[a, b]);
        let size: f64 = (0..found.poles.len()).map(|m| (found.input[(0, m)] * read[(1, m)]).abs()).sum();
        for t in [0.0, 1e-4, 1e-3, 7e-3] {
            let response = |from: usize, to: usize| -> f64 {
                (0..found.poles.len()).map(|m| found.input[(from, m)] * read[(to, m)] * found.poles[m].velocity(t)).sum()
            };
            prop_assert!((response(0, 1) - response(1, 0)).abs() < 1e-9 * size, "{t}");
        }
    }

    #[test]
    fn poles_are_woodburys(decay in decay(), a in place(), b in place(), loads in loads(), hz in 1.0..TOP) {
        let loaded = loaded(decay, &[a], &loads);
        let (found, _) = whole(&loaded, &[]);
        let at = Footprint::point(b);
        let read = at.weights(found.shapes.as_ref());
        let size: f64 = (0..found.poles.len()).map(|m| (found.input[(0, m)] * read[m]).abs()).sum();
        for s in [c64::new(20.0, TAU * hz), c64::new(TAU * hz, 0.0)] {
            let exact = loaded.admittance(0, &at, s);
            let sum = modal_transfer(&found.poles, found.input.as_ref(), 0, &read, s);
            prop_assert!((sum - exact).norm() < 1e-9 * size / s.norm(), "{s}: {sum} {exact}");
        }
    }

    #[test]
    fn nothing_gives_energy(decay in decay(), a in place(), loads in loads(), kicks in proptest::collection::vec((0.0..8e-3, -1.0..1.0), 8)) {
        let loaded = loaded(decay, &[a], &loads);
        let (found, read) = whole(&loaded, &[a]);
        prop_assert!(found.poles.iter().all(|pole| pole.sigma >= 0.0 && pole.omega >= 0.0));
        let h = |t: f64| -> f64 {
            (0..found.poles.len()).map(|m| found.input[(0, m)] * read[(0, m)] * found.poles[m].velocity(t)).sum()
        };
        // Every kick does the work of its strength times the mean of the velocities before and after.
        let mut kicks: Vec<(f64, f64)> = kicks;
        kicks.sort_by(|x, y| x.0.total_cmp(&y.0));
        let (mut work, mut size) = (0.0, 0.0);
        for (i, (t, p)) in kicks.iter().enumerate() {
            let before: f64 = kicks[..i].iter().map(|(u, q)| q * h(t - u)).sum();
            work += p * (before + 0.5 * p * h(0.0));
            size += 0.5 * p * p * h(0.0);
            prop_assert!(work >= -1e-9 * size, "{work} {size}");
        }
        // At every frequency, too.
        for hz in (1..200).map(|i| 5.0 * f64::from(i)) {
            let y = loaded.admittance(0, &Footprint::point(a), c64::new(1e-6, TAU * hz));
            prop_assert!(y.re >= -1e-9 * y.norm(), "{hz}: {y}");
        }
    }

    /// A kick moves nothing at first: where damping couples modes, oscillations that start displaced cancel each other. Without such
    /// damping each of those is rounding alone, which is held against the displacements that all oscillations may reach.
    #[test]
    fn what_is_struck_starts_from_its_place(decay in decay(), a in place(), b in place(), loads in loads()) {
        let (found, read) = whole(&loaded(decay, &[a], &loads), &[b]);
        let (mut start, mut size, mut reached) = (0.0, 0.0, 0.0);
        for (m, pole) in found.poles.iter().enumerate() {
            let velocity = found.input[(0, m)] * read[(0, m)];
            let displaced = velocity * pole.displacement(0.0);
            (start, size) = (start + displaced, size + displaced.abs());
            reached += velocity.abs() / pole.omega.max(pole.sigma);
        }
        prop_assert!(start.abs() <= 1e-9 * size + 1e-13 * reached, "{start} {size} {reached}");
    }

    /// Voltage on a coil moves a place as much as a force there drives current through the shorted coil.
    #[test]
    fn coils_hear_as_they_speak(decay in decay(), a in place(), b in place(), loads in loads(), hz in 20.0..TOP) {
        let surface = sheet(decay.clone());
        let coil = Transducer::of(&coil("c", a, CoilDrive::Voltage), &surface.outline).unwrap();
        let (shapes, poles) = modes(&surface, TOP);
        let loaded = Loaded::new(shapes, &poles, &[coil.clone(), force(b)], &loads).unwrap();
        let (found, _) = whole(&loaded, &[]);
        let s = c64::new(5.0, TAU * hz);
        let spoken = modal_transfer(&found.poles, found.input.as_ref(), 0, &Footprint::point(b).weights(found.shapes.as_ref()), s);
        let heard = loaded.admittance(1, &coil.footprint, s) * 6.0 / (s * 1.9e-3 + 6.2);
        prop_assert!((spoken - heard).norm() < 1e-8 * heard.norm() + 1e-12, "{spoken} {heard}");
    }
}
