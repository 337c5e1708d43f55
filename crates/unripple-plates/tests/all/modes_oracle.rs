//! Truth: closed forms, transcendental equations solved here, another discretisation, and published bounds.

use crate::modes_common;

use modes_common::*;
use std::f64::consts::{PI, TAU};
use unripple_core::*;
use unripple_plates::{Medium, Modes, PhysicsError};

fn hz(surface: &Surface, max_hz: f64, accuracy: f64) -> Vec<f64> {
    Modes::solve(surface, max_hz, accuracy).unwrap().frequencies_hz()
}

/// Dimensionless frequencies ω a² √(ρ_s/D) of a plate without tension.
fn parameters(aspect: f64, poisson: f64, sides: &str, top: f64, accuracy: f64) -> Vec<f64> {
    let plate = unit_plate(aspect, poisson, edges(sides));
    Modes::solve(&plate, top / TAU, accuracy).unwrap().poles().iter().map(|pole| pole.omega).collect()
}

#[test]
fn supported_film_is_its_dispersion_relation() {
    let surface = film(Edges::All(Edge::Supported));
    let medium = Medium::of(&surface.sheet);
    let mut exact: Vec<f64> = (1..40)
        .flat_map(|m| (1..40).map(move |n| f64::from(m).hypot(f64::from(n)) * PI / 0.15))
        .map(|k| medium.omega(k) / TAU)
        .filter(|f| *f <= 3000.0)
        .collect();
    exact.sort_by(f64::total_cmp);
    let found = hz(&surface, 3000.0, 1e-6);
    assert_eq!(found.len(), 318);
    for (found, exact) in found.iter().zip(&exact) {
        assert!((found / exact - 1.0).abs() < 1e-13);
    }
    for (found, printed) in found.iter().zip([159.614, 252.963, 252.963, 320.722]) {
        assert!((found - printed).abs() < 5.1e-4);
    }
}

#[test]
fn clamped_film_converged_elsewhere() {
    // Another spectral computation (numpy), to the digits given.
    let found = hz(&film(Edges::All(Edge::Clamped)), 3000.0, 1e-8);
    assert_eq!(found.len(), 306);
    let printed = [
        (1, 163.7436),
        (2, 259.5112),
        (4, 329.0241),
        (11, 497.3519),
        (51, 1050.6023),
        (101, 1542.4735),
        (201, 2286.7912),
        (301, 2992.414),
    ];
    for (number, printed) in printed {
        assert!((found[number - 1] / printed - 1.0).abs() < 4e-7, "{number}: {}", found[number - 1]);
    }
}

#[test]
fn clamped_square_plate_to_every_digit() {
    // Another spectral computation (numpy), converged to the digits given.
    let found = parameters(1.0, 0.3, "cccc", 140.0, 1e-10);
    let printed = [35.98519, 73.39385, 73.39385, 108.21650, 131.58077, 132.20479];
    assert_eq!(found.len(), printed.len());
    for (found, printed) in found.iter().zip(printed) {
        assert!((found - printed).abs() <= 0.5e-5 * 1.000_001, "{found} {printed}");
    }
}

/// Asserts that frequencies agree with a conforming finite element method, whose values fall towards the exact ones from
/// above: not above its fine mesh, and no further below than the fine mesh is below the coarse one.
///
/// The values were computed with scikit-fem 12.0.2, Bogner–Fox–Schmit elements, 24 x 24 and 48 x 48, and scipy 1.17.1.
fn below_finite_elements(found: &[f64], coarse: &[f64], fine: &[f64]) {
    assert_eq!(found.len(), fine.len());
    for ((found, coarse), fine) in found.iter().zip(coarse).zip(fine) {
        // Shift and invert leaves the finite elements an error of a few 1e-7 of their own.
        assert!(*found < fine * (1.0 + 3e-7), "{found} {fine}");
        assert!(fine - found < coarse - fine, "{found} {fine} {coarse}");
    }
}

/// Asserts that frequencies lie at most 1 % below published upper bounds of four figures.
fn just_below(found: &[f64], bounds: &[f64]) {
    for (found, bound) in found.iter().zip(bounds) {
        assert!(*found < bound * 1.0005 && *found > bound * 0.99, "{found} {bound}");
    }
}

#[test]
fn free_square_plate() {
    let found = parameters(1.0, 0.3, "ffff", 78.0, 1e-8);
    assert_eq!(found[..3], [0.0; 3]);
    let coarse = [
        13.468207, 19.596154, 24.270235, 34.800983, 34.800983, 61.093741, 61.093741, 63.686568, 69.265998,
        77.172584,
    ];
    let fine = [
        13.468197, 19.596138, 24.270202, 34.800894, 34.800897, 61.093261, 61.093267, 63.686158, 69.265443,
        77.171749,
    ];
    below_finite_elements(&found[3..], &coarse, &fine);
    // Sheet SDLS01/89 of the Guide VPCS, after Barton, J. Appl. Mech. 18, 129 (1951).
    just_below(&found[3..], &[13.49, 19.79, 24.43, 35.02, 35.02]);
}

#[test]
fn cantilever_square_plate() {
    let coarse = [3.471089, 8.506708, 21.285006, 27.198927, 30.956287, 54.187072];
    let fine = [3.471018, 8.506326, 21.284175, 27.198748, 30.954755, 54.184589];
    for sides in ["cfff", "fcff", "ffcf", "fffc"] {
        let found = parameters(1.0, 0.3, sides, 55.0, 1e-6);
        below_finite_elements(&found, &coarse, &fine);
        // Sheet SDLS01/89 of the Guide VPCS, after Barton, J. Appl. Mech. 18, 129 (1951).
        just_below(&found, &[3.492, 8.525, 21.43, 27.33, 31.11, 54.44]);
    }
}

/// A sheet supported at x = 0 and x = `width`, its other two sides both clamped or both free: the exact frequencies (Hz)
/// below `top_hz`, by Lévy's separation sin(kx) Y(y), roots found by bisection.
///
/// Y is cosh βy and cos αy, or sinh βy and sin αy, about the middle, with β² = k² + s₊, -α² = k² + s₋ and
/// D s² - R s = ρω².
fn levy(surface: &Surface, width: f64, height: f64, free: bool, top_hz: f64) -> Vec<f64> {
    let medium = Medium::of(&surface.sheet);
    let (d, r, nu) = (medium.bending_stiffness, medium.tension, surface.sheet.poisson);
    let half = height / 2.0;
    let determinant = |omega: f64, k: f64, even: bool| {
        let root = (r * r + 4.0 * d * medium.areal_density * omega * omega).sqrt();
        let beta = (k * k + (r + root) / (2.0 * d)).sqrt();
        let square = -(k * k + (r - root) / (2.0 * d));
        let alpha = square.abs().sqrt();
        // cos αh and sin(αh)/α, whichever sign α² has; tanh βh.
        let (c, s) = if square > 0.0 {
            ((alpha * half).cos(), (alpha * half).sin() / alpha)
        } else {
            ((alpha * half).cosh(), (alpha * half).sinh() / alpha)
        };
        let t = (beta * half).tanh();
        let (moment_b, moment_a) = (beta * beta - nu * k * k, square + nu * k * k);
        let shear = (2.0 - nu) * k * k + r / d;
        let (shear_b, shear_a) = (beta * (beta * beta - shear), square + shear);
        match (free, even) {
            (false, true) => square * s + beta * t * c,
            (false, false) => t * c - beta * s,
            (true, true) => moment_b * square * shear_a * s + moment_a * c * shear_b * t,
            (true, false) => -moment_b * t * shear_a * c + moment_a * s * shear_b,
        }
    };
    let steps = 6_000;
    let mut found = Vec::new();
    for m in 1..40 {
        let k = f64::from(m) * PI / width;
        if 0.9 * medium.omega(k) > TAU * top_hz {
            break;
        }
        for even in [true, false] {
            let f = |hz: f64| determinant(TAU * hz, k, even);
            for i in 1..steps {
                let (mut low, mut high) =
                    (top_hz * f64::from(i) / f64::from(steps), top_hz * f64::from(i + 1) / f64::from(steps));
                if f(low) * f(high) > 0.0 {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
                }
                // α² = 0 is a root of the even free determinant, but not a mode.
                let at_edge = medium.omega(k) / TAU;
                if !(free && (low / at_edge - 1.0).abs() < 1e-6) {
                    found.push(low);
                }
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn two_sides_supported_two_clamped_or_free() {
    let sheets = [(0.125e-3, 200.0, 0.3, 1500.0), (0.5e-3, 0.0, 0.2, 1500.0), (0.05e-3, 30.0, 0.45, 700.0)];
    for (thickness, tension, poisson, top_hz) in sheets {
        for (held, free) in [("c", false), ("f", true)] {
            for turned in [false, true] {
                let sides = if turned { format!("s{held}s{held}") } else { format!("{held}s{held}s") };
                let mut surface = film(edges(&sides));
                let (along, across) = (0.15, 0.11);
                let (width, height) = if turned { (across, along) } else { (along, across) };
                surface.outline.shape = Shape::Rectangle { width, height };
                let sheet = &mut surface.sheet;
                (sheet.thickness, sheet.tension, sheet.poisson) = (thickness, tension, poisson);
                let exact = levy(&surface, along, across, free, top_hz);
                let found = hz(&surface, top_hz, 1e-9);
                assert_eq!(found.len(), exact.len(), "{sides} {thickness}");
                assert!(found.len() > 20, "{}", found.len());
                for (found, exact) in found.iter().zip(&exact) {
                    assert!((found / exact - 1.0).abs() < 2e-9, "{sides} {thickness}: {found} {exact}");
                }
            }
        }
    }
}

#[test]
fn membranes_are_sines_and_cosines() {
    for sides in ["cccc", "cfff", "sfcf", "ccff", "fcsc"] {
        let mut surface = film(edges(sides));
        surface.outline.shape = Shape::Rectangle { width: 0.15, height: 0.1 };
        surface.sheet.young = 0.0;
        let held: Vec<bool> = sides.chars().map(|c| c != 'f').collect();
        let halves = |low: bool, high: bool, n: i32| match (low, high) {
            (true, true) => f64::from(n + 1),
            (false, false) => f64::from(n),
            _ => f64::from(n) + 0.5,
        };
        let celerity = (200.0f64 / (1400.0 * 0.125e-3)).sqrt();
        let mut exact: Vec<f64> = (0..60)
            .flat_map(|m| (0..60).map(move |n| (m, n)))
            .map(|(m, n)| {
                let kx = halves(held[3], held[1], m) / 0.15;
                let ky = halves(held[0], held[2], n) / 0.1;
                celerity * kx.hypot(ky) / 2.0
            })
            .filter(|f| *f <= 2000.0)
            .collect();
        exact.sort_by(f64::total_cmp);
        let modes = Modes::solve(&surface, 2000.0, 1e-6).unwrap();
        assert_eq!(modes.error(), 0.0);
        let found = modes.frequencies_hz();
        assert_eq!(found.len(), exact.len(), "{sides}");
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found - exact).abs() < 1e-9, "{sides}: {found} {exact}");
        }
    }
}

#[test]
fn rigid_modes_are_kept() {
    // Sides, rigid modes without and with tension; a side merely supported lets a plate without tension swing.
    for (sides, plate, tensioned) in
        [("ffff", 3, 1), ("sfff", 1, 0), ("ssff", 0, 0), ("cfff", 0, 0), ("sfsf", 0, 0)]
    {
        let mut surface = unit_plate(0.7, 0.3, edges(sides));
        for (tension, expected) in [(0.0, plate), (30.0, tensioned)] {
            surface.sheet.tension = tension;
            let found = hz(&surface, 10.0, 1e-4);
            let rigid = found.iter().filter(|f| **f == 0.0).count();
            assert_eq!(rigid, expected, "{sides} {tension}");
            assert!(found.get(rigid).is_none_or(|f| *f > 0.1), "{sides} {tension}: {found:?}");
        }
    }
}

#[test]
fn tens_of_thousands_of_supported_modes() {
    let mut surface = film(Edges::All(Edge::Supported));
    surface.outline.shape = Shape::Rectangle { width: 1.5, height: 1.5 };
    let modes = Modes::solve(&surface, 3000.0, 1e-6).unwrap();
    // Weyl's law with fixed edges, and the quarter of a mode that corners give back.
    let k = Medium::of(&surface.sheet).wavenumber(TAU * 3000.0);
    let weyl = 1.5f64.powi(2) * k * k / (4.0 * PI) - 6.0 * k / (4.0 * PI) + 0.25;
    assert!(
        (modes.frequencies_hz().len() as f64 - weyl).abs() < 60.0,
        "{} {weyl}",
        modes.frequencies_hz().len()
    );
    let points = [Point::new(0.3, 0.7), Point::new(0.0, 0.2)];
    let all = modes.at_all(&points);
    let mut row = vec![0.0; all.ncols()];
    modes.at(points[0], &mut row);
    assert!(row.iter().enumerate().all(|(m, w)| *w == all[(0, m)]));
    assert!((0..all.ncols()).all(|m| all[(1, m)] == 0.0));
}

#[test]
fn air_lowers_the_film() {
    let in_vacuum = film(Edges::All(Edge::Supported));
    let with = |air| {
        let mut surface = in_vacuum.clone();
        surface.sheet.air = air;
        Modes::solve(&surface, 3000.0, 1e-6).unwrap()
    };
    let [vacuum, one, both] = [Air::None, Air::OneSide, Air::BothSides].map(with);
    let first = both.frequencies_hz()[0];
    assert!((first - 132.0).abs() < 1.0, "{first}");
    let [none, one_side, both_sides] = [&vacuum, &one, &both].map(|modes| modes.poles().len());
    assert!(none <= one_side && one_side <= both_sides && none < both_sides);
    let (k, sheet) = (2f64.sqrt() * PI / 0.15, 0.175);
    for (modes, sides) in [(&one, 1.0), (&both, 2.0)] {
        let omega = modes.poles()[0].omega;
        let layer = sides * 1.204 / (k * k - (omega / 343.2).powi(2)).sqrt();
        let vacuum = vacuum.poles()[0].omega;
        // ω² (ρ_s + layer) = ω_vacuum² ρ_s, and shapes are normalised by the same mass.
        assert!(((omega / vacuum).powi(2) * (sheet + layer) / sheet - 1.0).abs() < 1e-9);
        let mut row = vec![0.0; modes.poles().len()];
        modes.at(Point::new(0.075, 0.075), &mut row);
        assert!((row[0].abs() / (4.0 / ((sheet + layer) * 0.0225)).sqrt() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn only_bending_dissipates() {
    let mut surface = film(Edges::All(Edge::Supported));
    surface.sheet.decay = Decay::LossFactor(0.015);
    let modes = Modes::solve(&surface, 3000.0, 1e-6).unwrap();
    let medium = Medium::of(&surface.sheet);
    for (pole, time) in modes.poles().iter().zip(modes.decay_times()) {
        let k = medium.wavenumber(pole.omega);
        let share = medium.bending_stiffness * k * k / (medium.tension + medium.bending_stiffness * k * k);
        assert!((time * 0.015 * share * pole.omega / 2.0 - 1.0).abs() < 1e-9);
    }
}

#[test]
fn bending_share_is_the_slope_of_the_frequencies() {
    // Hellmann–Feynman: the share of the energy in bending is d ln ω² / d ln D.
    for sides in ["cccc", "scss", "ssff"] {
        let surface = film(edges(sides));
        let stretched = |factor: f64| {
            let mut surface = surface.clone();
            surface.sheet.young *= factor;
            hz(&surface, 620.0, 1e-7)
        };
        let modes = Modes::solve(&surface, 600.0, 1e-7).unwrap();
        let step: f64 = 1e-3;
        let (below, above) = (stretched((-step).exp()), stretched(step.exp()));
        for (m, share) in modes.bending_shares().iter().enumerate() {
            let slope = (above[m] / below[m]).ln() / step;
            assert!((slope - share).abs() < 2e-4, "{sides} {m}: {slope} {share}");
        }
    }
}

#[test]
fn says_what_it_cannot_do() {
    let surface = film(Edges::All(Edge::Clamped));
    match Modes::solve(&surface, 1e6, 1e-6) {
        Err(PhysicsError::TooLarge { needed_gib, limit_gib, nearest_hz, .. }) => {
            assert!(needed_gib > limit_gib && nearest_hz > 3e3 && nearest_hz < 1e6);
        }
        other => panic!("{other:?}"),
    }
    for (max_hz, accuracy) in [
        (f64::NAN, 1e-6),
        (-1.0, 1e-6),
        (f64::INFINITY, 1e-6),
        (1e100, 1e-6),
        (1e300, 1e-6),
        (100.0, 0.0),
        (100.0, f64::NAN),
    ] {
        assert!(matches!(Modes::solve(&surface, max_hz, accuracy), Err(PhysicsError::Range(_))));
    }
    let mut membrane = surface.clone();
    membrane.sheet.young = 0.0;
    match Modes::solve(&membrane, 300e3, 1e-6) {
        Err(PhysicsError::TooLarge { needed_gib, limit_gib, nearest_hz, .. }) => {
            assert!(needed_gib > limit_gib && nearest_hz > 100e3 && nearest_hz < 300e3);
        }
        other => panic!("{other:?}"),
    }
    let changes: [fn(&mut Sheet); 5] = [
        |s| s.tension = -1.0,
        |s| (s.tension, s.young) = (0.0, 0.0),
        |s| s.density = 0.0,
        |s| s.poisson = 1.0,
        |s| s.thickness = f64::NAN,
    ];
    for change in changes {
        let mut surface = surface.clone();
        change(&mut surface.sheet);
        assert!(matches!(Modes::solve(&surface, 100.0, 1e-6), Err(PhysicsError::Range(_))));
    }
}
