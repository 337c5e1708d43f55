//! Truth: the error that is stated of a decay time is at least the true one, and not far above it.

use crate::modes_common::film;
use crate::round_common::{frequencies, of_order};
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_linalg::c64;
use unripple_plates::Modes;

const RADIUS: f64 = 0.07;

/// The films' loss factor.
const ETA: f64 = 0.02;

/// Step of the logarithm of the bending stiffness from one sheet to the next whose frequencies continue those of a real stiffness to a
/// complex one: a fifth of it, and their rounding errors would count, five times as much, and the sixth derivative would.
const STEP: f64 = 0.05;

fn surface(shape: Shape, edge: Edge, decay: Decay) -> Surface {
    let mut surface = film(Edges::All(edge));
    surface.outline = Outline::new(shape).with_edges(Edges::All(edge));
    surface.sheet.decay = decay;
    surface
}

/// A circle, in Bessel functions if `plain`, else on a mesh.
fn circle(plain: bool, edge: Edge, decay: Decay) -> Surface {
    let round = Shape::Circle { radius: RADIUS };
    let shape = if plain { round } else { Shape::Stadium { straight: 0.0, radius: RADIUS } };
    surface(shape, edge, decay)
}

/// The value at `x` of the polynomial through five values at -2, -1, 0, 1, 2.
fn continued(values: [f64; 5], x: c64) -> c64 {
    let one = |real: f64| c64::new(real, 0.0);
    (0..5).fold(one(0.0), |sum, i| {
        let others = (0..5).filter(|j| *j != i);
        let share = |product: c64, j: usize| product * (x - one(j as f64 - 2.0)) / one(i as f64 - j as f64);
        sum + others.fold(one(values[i]), share)
    })
}

/// Frequencies (Hz) and decay times (s) of all modes of a round film of complex bending stiffness D (1 + jη), ascending, each with nodal
/// diameters twice: from exact frequencies for five real stiffnesses around D.
fn exact(surface: &Surface, edge: Edge, max_hz: f64) -> Vec<(f64, f64)> {
    let x = c64::new(1.0, ETA).ln() / c64::new(STEP, 0.0);
    let mut all = Vec::new();
    for order in 0.. {
        let of = |i: i32| {
            let mut sheet = surface.sheet.clone();
            sheet.young *= (f64::from(i) * STEP).exp();
            of_order(&sheet, RADIUS, edge, order, 1.2 * max_hz)
        };
        let found = [-2, -1, 0, 1, 2].map(of);
        let inside = found[2].partition_point(|hz| *hz <= max_hz);
        if inside == 0 && order > 2 {
            break;
        }
        for m in 0..inside {
            let squares = found.each_ref().map(|hz| (TAU * hz[m]).powi(2));
            let mode = (found[2][m], 1.0 / continued(squares, x).sqrt().im);
            all.extend(std::iter::repeat_n(mode, if order == 0 { 1 } else { 2 }));
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

/// Holds the decay times (s) found to exact ones, and gives the ratios of stated and true errors, ascending. True errors up to `told` are
/// not told from those of the reference.
fn ratios(modes: &Modes, exact: &[f64], told: f64) -> Vec<f64> {
    let found = modes.decay_times();
    assert_eq!(found.len(), exact.len());
    let mut ratios = Vec::new();
    for (m, (found, exact)) in found.iter().zip(exact).enumerate() {
        let (stated, off) = (modes.errors()[m].decay.unwrap(), (found / exact - 1.0).abs());
        assert!(off <= stated + told, "mode {m}: {stated:e} stated, {off:e} true");
        ratios.extend((off > told).then_some(stated / off));
    }
    ratios.sort_by(f64::total_cmp);
    ratios
}

/// Fails where the median of these ratios is above thirty, or too few of them are known.
fn close(what: &str, ratios: &[f64], least: usize) {
    assert!(ratios.len() >= least, "{what}: {} ratios", ratios.len());
    let median = ratios[ratios.len() / 2];
    println!("{what}: least {:.2}, median {median:.1}, largest {:.0}", ratios[0], ratios[ratios.len() - 1]);
    assert!(median < 30.0, "{what}: {median}");
}

#[test]
fn films_of_complex_stiffness_decay_as_stated() {
    for edge in [Edge::Clamped, Edge::Supported] {
        let round = circle(true, edge, Decay::LossFactor(ETA));
        let exact: Vec<f64> = exact(&round, edge, 1490.0).iter().map(|mode| mode.1).collect();
        let meshed = circle(false, edge, Decay::LossFactor(ETA));
        for (what, surface, accuracy) in [
            ("Bessel functions", &round, 1e-3),
            ("Bessel functions", &round, 1e-8),
            ("a mesh", &meshed, 1e-2),
            ("a finer mesh", &meshed, 1e-4),
        ] {
            let ratios = ratios(&Modes::solve(surface, 1490.0, accuracy).unwrap(), &exact, 1e-7);
            // Supported, without a boundary layer, modes hardly couple, as far as the estimate may tell.
            if edge == Edge::Clamped {
                close(what, &ratios, 30);
            }
        }
    }
}

/// With a decay time that falls steeply with frequency, what is wrong of a frequency is what is wrong of the time.
#[test]
fn decay_times_from_a_table_are_as_good_as_frequencies() {
    let table = Decay::Table(vec![(100.0, 1.0), (3000.0, 0.01)]);
    let meshed = circle(false, Edge::Clamped, table);
    let exact: Vec<f64> = frequencies(&meshed.sheet, RADIUS, Edge::Clamped, 2000.0)
        .iter()
        .map(|hz| 1.0 - 0.99 * (hz - 100.0) / 2900.0)
        .collect();
    for accuracy in [1e-2, 1e-4] {
        let modes = Modes::solve(&meshed, 2000.0, accuracy).unwrap();
        close("a table", &ratios(&modes, &exact, 1e-10), 30);
    }
    // One time for all modes is known, whatever the frequencies.
    let modes = Modes::solve(&circle(false, Edge::Clamped, Decay::Time(0.1)), 1000.0, 1e-2).unwrap();
    assert!(modes.error() > 0.0 && modes.errors().iter().all(|error| error.decay == Some(0.0)));
}

/// A clamped L, whose re-entrant corner is singular, against a finer mesh.
#[test]
fn an_l_decays_as_stated() {
    let at = [(0.0, 0.0), (150.0, 0.0), (150.0, 70.0), (70.0, 70.0), (70.0, 120.0), (0.0, 120.0)];
    let shape = Shape::Polygon(at.iter().map(|(x, y)| Point::from_mm(*x, *y)).collect());
    let l = surface(shape, Edge::Clamped, Decay::LossFactor(ETA));
    let fine = Modes::solve(&l, 1000.0, 1e-4).unwrap();
    let coarse = Modes::solve(&l, 1000.0, 1e-2).unwrap();
    // The part that both have in common is not seen.
    let told = 2.0 * ETA * ETA;
    for (m, (coarse_time, fine_time)) in coarse.decay_times().iter().zip(fine.decay_times()).enumerate() {
        let (stated, off) = (coarse.errors()[m].decay.unwrap(), (coarse_time / fine_time - 1.0).abs());
        assert!(off <= stated, "mode {m}: {stated:e} stated, {off:e} true");
        assert!(stated < 30.0 * off + told, "mode {m}: {stated:e} stated, {off:e} true");
        assert!(fine.errors()[m].decay.unwrap() < 0.3 * stated);
    }
    assert_eq!(coarse.decay_times().len(), fine.decay_times().len());
}

/// Where nothing couples modes, second order is exact; where nothing bends, nothing decays.
#[test]
fn pure_bending_and_pure_tension() {
    let mut pane = circle(true, Edge::Clamped, Decay::LossFactor(ETA));
    pane.sheet.tension = 0.0;
    let modes = Modes::solve(&pane, 500.0, 1e-6).unwrap();
    // The root of 1 + jη, and nothing else but the frequency's error.
    let exact: Vec<f64> =
        modes.frequencies_hz().iter().map(|hz| 1.0 / (TAU * hz * c64::new(1.0, ETA).sqrt().im)).collect();
    let ratios = ratios(&modes, &exact, 1e-9);
    assert!(ratios.len() > 3 && ratios.iter().all(|ratio| (1.0..1.1).contains(ratio)), "{ratios:?}");
    let mut drum = circle(true, Edge::Clamped, Decay::LossFactor(ETA));
    drum.sheet.young = 0.0;
    let drum = Modes::solve(&drum, 1000.0, 1e-6).unwrap();
    assert!(drum.decay_times().iter().all(|time| time.is_infinite()));
    assert!(drum.errors().iter().all(|error| error.decay == Some(0.0)));
}
