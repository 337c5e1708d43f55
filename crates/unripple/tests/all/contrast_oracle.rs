//! Contrast and size of simulated foci against closed forms.

use std::sync::LazyLock;
use unripple_core::{Decay, Edge, Edges, Outline, Shape, Surface};
use unripple_field::{Aim, MeasureOptions, measure};
use unripple_focus::{Options, Target, focus};
use unripple_paper::study::{
    CELLS, Compared, ContrastModel, Replay, Sampling, against_band, against_noise, against_period,
    against_window, size,
};
use unripple_physics::design::papers_surface;

/// Windows simulated, in s, from too short to longer than the decay, and numbers of actuators, in powers of two.
const WINDOWS: [f64; 8] = [0.005, 0.010, 0.020, 0.030, 0.050, 0.075, 0.100, 0.150];
const ACTUATORS: [usize; 6] = [1, 2, 4, 8, 16, 32];

static PAPER: LazyLock<ContrastModel> =
    LazyLock::new(|| ContrastModel::of(&papers_surface(), CELLS).unwrap());

/// Placements and targets of the paper's membrane: enough for means to hold within a few per cent.
const SAMPLING: Sampling =
    Sampling { placements: 80, targets: 2, depth: [6e-3, 12e-3], margin: 20e-3, seed: 1 };

static ONCE: LazyLock<Vec<Compared>> =
    LazyLock::new(|| against_window(&PAPER, &papers_surface(), &WINDOWS, &ACTUATORS, &SAMPLING));

fn within(rows: &[Compared], tolerance: impl Fn(&Compared) -> f64) {
    for row in rows {
        println!("{row:?} {:.3} {:.3}", row.simulated / row.predicted, row.simulated / row.plain);
    }
    for row in rows {
        let error = row.simulated / row.predicted - 1.0;
        assert!(error.abs() < tolerance(row), "{row:?}: {error:.3}");
    }
}

/// The row of a number of actuators and a window.
fn at(rows: &[Compared], actuators: usize, window: f64) -> Compared {
    *rows.iter().find(|row| row.actuators == actuators && row.varied == window).unwrap()
}

/// Exponents between two rows in something that grows by `factor`: simulated and predicted.
fn exponents(from: Compared, to: Compared, factor: f64) -> (f64, f64) {
    let exponent = |ratio: f64| ratio.ln() / factor.ln();
    (exponent(to.simulated / from.simulated), exponent(to.predicted / from.predicted))
}

#[test]
fn contrast_follows_the_closed_form() {
    within(&ONCE, |row| if row.actuators == 1 { 0.15 } else { 0.10 });
}

#[test]
fn the_plain_form_is_low_by_up_to_a_fifth() {
    for row in ONCE.iter() {
        assert!((1.0..1.2).contains(&(row.simulated / row.plain)), "{row:?}");
    }
}

/// Exponents at every inner point of a row of numbers of actuators or windows, from its two neighbours.
#[test]
fn exponents_follow_the_closed_form() {
    for window in WINDOWS {
        for n in ACTUATORS.windows(3) {
            let (found, expected) = exponents(at(&ONCE, n[0], window), at(&ONCE, n[2], window), 4.0);
            assert!((found - expected).abs() < 0.05, "N {n:?}, T {window}: {found:.3} {expected:.3}");
        }
    }
    for actuators in ACTUATORS {
        for t in WINDOWS.windows(3) {
            let (from, to) = (at(&ONCE, actuators, t[0]), at(&ONCE, actuators, t[2]));
            let (found, expected) = exponents(from, to, t[2] / t[0]);
            assert!((found - expected).abs() < 0.05, "N {actuators}, T {t:?}: {found:.3} {expected:.3}");
        }
    }
}

#[test]
fn square_roots_hold_where_modes_are_many() {
    // A film of 1.4 m by 1.1 m up to 1 kHz: some 3700 modes, n̄ = 3.7 s, and waves that cross it within 40 ms.
    let mut surface = papers_surface();
    surface.outline =
        Outline::new(Shape::Rectangle { width: 1.4, height: 1.1 }).with_edges(Edges::All(Edge::Supported));
    surface.sheet.decay = Decay::Time(2.0);
    surface.emission.band = [0.0, 1000.0];
    surface.emission.rate = 4000.0;
    let model = ContrastModel::of(&surface, 1.0).unwrap();
    let sampling = Sampling { placements: 60, targets: 1, depth: [0.05, 0.2], margin: 0.15, seed: 3 };
    let windows = [0.060, 0.120];
    let rows = against_window(&model, &surface, &windows, &[1, 2, 4, 8], &sampling);
    within(&rows, |_| 0.05);
    for window in windows {
        let (found, expected) = exponents(at(&rows, 1, window), at(&rows, 8, window), 8.0);
        assert!((found - 0.5).abs() < 0.05 && (expected - 0.5).abs() < 0.05, "N: {found} {expected}");
    }
    for actuators in [1, 2, 4, 8] {
        let (found, expected) =
            exponents(at(&rows, actuators, windows[0]), at(&rows, actuators, windows[1]), 2.0);
        assert!((found - 0.5).abs() < 0.05 && (expected - 0.5).abs() < 0.05, "T: {found} {expected}");
    }
}

#[test]
fn repetition_follows_the_closed_form() {
    let (surface, tau) = (papers_surface(), 0.070);
    let periods = [tau / 4.0, tau / 2.0, tau, 2.0 * tau, 4.0 * tau];
    for window in [0.010, 0.030, tau] {
        let rows = against_period(&PAPER, &surface, window, &periods, &ACTUATORS, &SAMPLING);
        within(&rows, |_| 0.15);
    }
}

#[test]
fn bandwidth_follows_the_closed_form() {
    let tops = [1500.0, 2250.0, 3000.0];
    let rows = against_band(&PAPER, &papers_surface(), &tops, (8, 0.030), &SAMPLING).unwrap();
    within(&rows, |_| 0.10);
}

#[test]
fn noise_follows_the_closed_form() {
    let ratios = [0.0, 0.3, 1.0, 3.0, 10.0];
    for setting in [(1, 0.030), (8, 0.030), (8, 0.100)] {
        within(&against_noise(&PAPER, &papers_surface(), &ratios, setting, &SAMPLING), |_| 0.05);
    }
}

#[test]
fn spot_and_pulse_follow_theirs() {
    let sampling = Sampling { placements: 20, targets: 1, ..SAMPLING };
    for setting in [(1, 0.030), (8, 0.030)] {
        let size = size(&PAPER, &papers_surface(), setting, &sampling);
        println!("{size:?}");
        assert!((size.spot_diameter_m / size.spot_predicted_m - 1.0).abs() < 0.15);
        assert!((size.pulse_duration_s / size.pulse_predicted_s - 1.0).abs() < 0.15);
    }
}

#[test]
fn the_algebra_measures_what_the_field_measures() {
    let surface = papers_surface();
    for (draw, (actuators, window)) in
        SAMPLING.draws(&surface.outline, 8).iter().zip([(1, 0.010), (8, 0.030), (3, 0.050)])
    {
        let (places, target) = (&draw.actuators[..actuators], draw.targets[0]);
        let outside = PAPER.outside(target);
        let inputs = PAPER.shapes_at(places);
        let contrast = |replay: &Replay| {
            let states = PAPER.states(replay, inputs.as_ref(), &outside);
            PAPER.contrasts(states.as_ref(), &outside)[actuators - 1]
        };
        let responses = PAPER.responses(places);
        let field = |aimed: Target, period: Option<f64>| {
            let options = Options { window, ..Options::default() };
            let focused = focus(&responses, &[aimed], &options).unwrap();
            let instant = focused.timing[0].instant as f64 / surface.emission.rate;
            let options = MeasureOptions { period, ..MeasureOptions::default() };
            let aim = Aim::at(target, instant);
            measure(&responses, &focused.drive, &[aim], &options).unwrap().targets[0].contrast.unwrap()
        };
        let once = field(Target::at(target), None) / contrast(&PAPER.once(window));
        assert!((once - 1.0).abs() < 1e-6, "once: {once}");
        let period = 0.025;
        let comb = field(Target::at(target).repeated(1.0 / period), Some(period));
        let comb = comb / contrast(&PAPER.repeated(window, period));
        // The drive was switched on a finite time ago.
        assert!((comb - 1.0).abs() < 1e-3, "repeated: {comb}");
    }
}

#[test]
fn plates_follow_the_closed_form_too() {
    // Nothing above is peculiar to films: a slack plate of strengthened glass, supported.
    let surface = glass();
    let model = ContrastModel::of(&surface, CELLS).unwrap();
    let sampling = Sampling { placements: 40, targets: 2, depth: [20e-3, 50e-3], margin: 80e-3, seed: 5 };
    let rows = against_window(&model, &surface, &[0.010, 0.030, 0.100], &[1, 4, 16], &sampling);
    within(&rows, |_| 0.15);
}

fn glass() -> Surface {
    let mut surface = papers_surface();
    surface.outline =
        Outline::new(Shape::Rectangle { width: 0.5, height: 0.4 }).with_edges(Edges::All(Edge::Supported));
    surface.sheet.young = 70e9;
    surface.sheet.density = 2440.0;
    surface.sheet.poisson = 0.22;
    surface.sheet.thickness = 0.5e-3;
    surface.sheet.tension = 0.0;
    surface.sheet.decay = Decay::Time(0.05);
    surface.emission.band = [0.0, 5000.0];
    surface.emission.rate = 32e3;
    surface
}
