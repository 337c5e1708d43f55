//! Truth: the error that is stated of responses is at least the true one, and not far above it.

use crate::modes_common::{film, film_with_actuators};
use std::f64::consts::{PI, TAU};
use unripple_core::*;
use unripple_linalg::{Mat, c64, product};
use unripple_physics::{
    Medium, ResponseOptions, SAMPLING_ERROR, left_out, response_error, responses, responses_on, sample,
};

/// Length of the responses, in seconds.
const LENGTH: f64 = 0.04;

const ACTUATORS: [(f64, f64); 3] = [(31.0, 40.0), (95.0, 52.0), (62.0, 101.0)];

fn modal(surface: &Surface, accuracy: f64) -> ModalResponses {
    let options = ResponseOptions { accuracy: accuracy.into(), ..ResponseOptions::default() };
    match responses(surface, &options).unwrap() {
        Responses::Modal(modal) => modal,
        Responses::Sampled(_) => panic!("not modal"),
    }
}

/// A film of some shape with three actuators, in a band up to 1 kHz.
fn surface(shape: Shape, decay: Decay) -> Surface {
    let mut surface = film_with_actuators(&ACTUATORS);
    surface.outline = Outline::new(shape);
    surface.emission.band = [0.0, 1000.0];
    surface.sheet.decay = decay;
    surface
}

fn round() -> Shape {
    Shape::Circle { radius: 0.07 }
}

/// A circle that is solved on a mesh.
fn meshed() -> Shape {
    Shape::Stadium { straight: 0.0, radius: 0.07 }
}

fn l() -> Shape {
    let at = [(0.0, 0.0), (150.0, 0.0), (150.0, 70.0), (70.0, 70.0), (70.0, 120.0), (0.0, 120.0)];
    Shape::Polygon(at.iter().map(|(x, y)| Point::from_mm(*x, *y)).collect())
}

/// Difference of all responses at a grid of points, root mean square and relative to the second.
fn apart(found: &ModalResponses, exact: &ModalResponses) -> f64 {
    let inside = |point: &Point| exact.conditions.outline.contains(*point);
    let grid = (0..225).map(|i| Point::from_mm(5.0 + 9.7 * f64::from(i % 15), 4.0 + 9.7 * f64::from(i / 15)));
    let points: Vec<Point> = grid.filter(inside).collect();
    let samples = (LENGTH * 48e3) as usize;
    let [found, exact] = [found, exact].map(|modal| sample(modal, &points, samples));
    let pairs = || found.data().iter().zip(exact.data()).map(|(f, e)| (f64::from(*f), f64::from(*e)));
    let wrong: f64 = pairs().map(|(found, exact)| (found - exact) * (found - exact)).sum();
    (wrong / pairs().map(|(_, exact)| exact * exact).sum::<f64>()).sqrt()
}

#[test]
fn responses_are_as_wrong_as_stated() {
    let (time, loss) = (Decay::Time(0.05), Decay::LossFactor(0.05));
    let mut ratios = Vec::new();
    for (what, found, exact, finest, accuracies) in [
        ("circle", meshed(), round(), 1e-9, [1e-2, 1e-4]),
        ("circle with a loss factor", meshed(), round(), 1e-9, [1e-2, 1e-3]),
        ("L", l(), l(), 1e-5, [1e-2, 1e-3]),
        ("rectangle", rectangle(), rectangle(), 1e-9, [1e-2, 1e-4]),
    ] {
        let decay = if what.contains("loss") { &loss } else { &time };
        let [found, exact] = [found, exact].map(|shape| surface(shape, decay.clone()));
        let exact = modal(&exact, finest);
        let own = response_error(&exact, LENGTH).unwrap();
        for accuracy in accuracies {
            let found = modal(&found, accuracy);
            let stated = response_error(&found, LENGTH).unwrap() + SAMPLING_ERROR;
            let off = apart(&found, &exact);
            println!("{what} at {accuracy:e}: {off:.2e} true, {stated:.2e} stated");
            assert!(off <= stated + own, "{what} at {accuracy:e}: {off:e} true, {stated:e} stated");
            ratios.push(stated / off);
        }
    }
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[ratios.len() / 2] < 30.0, "{ratios:?}");
}

fn rectangle() -> Shape {
    Shape::Rectangle { width: 0.14, height: 0.12 }
}

/// What is stated of a window follows the window, and nothing is stated where loads change the modes.
#[test]
fn errors_grow_with_the_window_and_are_unknown_with_loads() {
    let found = modal(&surface(rectangle(), Decay::Time(0.05)), 1e-4);
    let [short, long] = [0.005, 0.04].map(|window| response_error(&found, window).unwrap());
    // What drifts apart grows with the window; what shapes are wrong by, most of it at this accuracy, does not.
    assert!(short > 0.0 && long > 1.01 * short, "{short:e} {long:e}");
    let mut heavy = surface(rectangle(), Decay::Time(0.05));
    heavy.actuators[0].contact_radius = 2e-3;
    heavy.actuators[0].kind = ActuatorKind::MovingMagnet {
        force_constant: 0.2,
        resistance: 8.0,
        inductance: 0.0,
        moving_mass: 1e-4,
        driven_by: CoilDrive::Current,
    };
    let loaded = modal(&heavy, 1e-4);
    assert_eq!([response_error(&loaded, 0.04), left_out(&heavy, &loaded, 0.04)], [None; 2]);
}

/// Modes of a band that does not begin at 0 have the errors that they have among all modes.
#[test]
fn a_band_has_the_errors_of_its_own_modes() {
    let mut narrow = film_with_actuators(&ACTUATORS);
    narrow.emission.band = [400.0, 1000.0];
    let options = ResponseOptions::default();
    let modes = std::sync::Arc::new(unripple_physics::response_modes(&narrow, &options).unwrap());
    let below = modes.poles().partition_point(|pole| pole.omega < TAU * 400.0);
    let found = responses_on(&narrow, modes.clone(), &options).unwrap();
    let Responses::Modal(found) = found else { panic!("not modal") };
    assert!(below > 0);
    assert_eq!(found.mode_errors, modes.errors()[below..]);
}

/// What is true and what is stated of the motion within a band up to `top` (Hz) that modes above it add to responses, on a supported
/// film of sides `a` and `b` (m), whose modes are sines.
fn above_the_band([a, b]: [f64; 2], top: f64) -> [f64; 2] {
    let mut surface = film(Edges::All(Edge::Supported));
    surface.outline.shape = Shape::Rectangle { width: a, height: b };
    let places: Vec<Point> = (1..13).map(|i| spread(i, [a, b])).collect();
    surface.actuators = film_with_actuators(&[(0.0, 0.0); 12]).actuators;
    surface.actuators.iter_mut().zip(&places).for_each(|(actuator, at)| actuator.at = *at);
    surface.emission.band = [0.0, top];
    let sigma = 1.0 / 0.07;
    let stated = left_out(&surface, &modal(&surface, 1e-6), 0.06).unwrap();
    let modes: Vec<_> = sines(&surface, [a, b]).into_iter().filter(|mode| mode.0 < 5.0 * TAU * top).collect();
    let inside = modes.partition_point(|mode| mode.0 <= TAU * top);
    let shape = |p: usize, m: usize| {
        let (_, i, j) = modes[m];
        (i * PI * places[p].x / a).sin() * (j * PI * places[p].y / b).sin()
    };
    // From each place to each other.
    let pairs: Vec<(usize, usize)> =
        (0..12).flat_map(|p| (0..12).filter(move |q| *q != p).map(move |q| (p, q))).collect();
    let weight = |pair: usize, m: usize| shape(pairs[pair].0, m) * shape(pairs[pair].1, m);
    let ringing = (1.0 - f64::exp(-2.0 * sigma * 0.06)) / (4.0 * sigma);
    let within: f64 = (0..pairs.len())
        .flat_map(|pair| (0..inside).map(move |m| (pair, m)))
        .map(|(pair, m)| weight(pair, m).powi(2) * ringing)
        .sum();
    let steps = 600;
    let step = TAU * top / steps as f64;
    let mobility = |m: usize, i: usize| {
        let omega = (i as f64 + 0.5) * step;
        let square = modes[inside + m].0.powi(2);
        c64::new(0.0, omega) / c64::new(square - omega * omega, 2.0 * sigma * omega)
    };
    let above = modes.len() - inside;
    let weights = Mat::from_fn(pairs.len(), above, |pair, m| c64::new(weight(pair, inside + m), 0.0));
    let motion = product(weights.as_ref(), Mat::from_fn(above, steps, mobility).as_ref());
    let added: f64 = motion.col_iter().map(|column| column.iter().map(|v| v.norm_sqr()).sum::<f64>()).sum();
    [(added * step / PI / within).sqrt(), stated]
}

/// Angular frequency (rad/s) and numbers of half waves of the lowest modes of a supported film, lowest first.
fn sines(surface: &Surface, [a, b]: [f64; 2]) -> Vec<(f64, f64, f64)> {
    let (mass, stiffness) = (0.175, Medium::of(&surface.sheet).bending_stiffness);
    let mut modes: Vec<(f64, f64, f64)> = (1..40)
        .flat_map(|m| (1..40).map(move |n| (f64::from(m), f64::from(n))))
        .map(|(m, n)| {
            let k2 = (m * PI / a).powi(2) + (n * PI / b).powi(2);
            ((k2 * (200.0 + stiffness * k2) / mass).sqrt(), m, n)
        })
        .collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    modes
}

#[test]
fn modes_above_the_band_add_no_more_than_stated() {
    for top in [700.0, 900.0, 1000.0, 1100.0, 1200.0] {
        let [off, stated] = above_the_band([0.15, 0.11], top);
        println!("{top} Hz: {off:.3} true, {stated:.3} stated");
        assert!(off <= stated && stated < 12.0 * off, "{top} Hz: {off} true, {stated} stated");
    }
}

/// The worst case: bands that end just below a mode, or below two of the same frequency.
#[test]
fn modes_just_above_the_band_add_no_more_than_stated() {
    let square = [0.15, 0.15];
    let modes = sines(&film(Edges::All(Edge::Supported)), square);
    // Below the first there are none; of two of a frequency, one after the other, one is enough.
    for pair in modes[..10].windows(2).filter(|pair| pair[1].0 > 1.001 * pair[0].0) {
        let top = pair[1].0 / TAU - 0.1;
        let [off, stated] = above_the_band(square, top);
        println!("{top} Hz: {off:.3} true, {stated:.3} stated");
        assert!(off <= stated && stated < 12.0 * off, "{top} Hz: {off} true, {stated} stated");
    }
}

/// A place of an even sequence over a rectangle.
fn spread(i: u32, [width, height]: [f64; 2]) -> Point {
    let fraction = |step: f64| (f64::from(i) * step).fract();
    Point::new(width * fraction(0.754_877_666_246_692_7), height * fraction(0.569_840_290_998_053_2))
}
