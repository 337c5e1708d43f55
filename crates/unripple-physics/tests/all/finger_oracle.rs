//! Truth: a finger on a long strip, against the waves of Hudin et al. 2012, section 3.5.

use crate::coupled_common;
use crate::modes_common;
use unripple_linalg::c64;

use coupled_common::*;
use modes_common::*;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::*;
use unripple_physics::design::{Strip, finger_impedance};
use unripple_physics::*;

/// Length of the strip: waves that run to its ends do not come back, losses being a hundredth.
const LENGTH: f64 = 60.0;
/// Width of the contact.
const WIDTH: f64 = 10e-3;
const LOSS: f64 = 0.01;
const SOURCE: f64 = LENGTH / 2.0 - 0.5;

/// τ = 2/(ηω) at every frequency.
fn losses() -> Decay {
    let time = |hz: f64| 2.0 / (LOSS * TAU * hz);
    Decay::Table((0..2000).map(|i| 0.5 * 1.005f64.powi(i)).map(|hz| (hz, time(hz))).collect())
}

/// The sheet's modes with a source and, at mid-span, a finger across the whole width or nothing.
struct Long {
    width: f64,
    bare: Loaded,
    touched: Loaded,
}

impl Long {
    /// On a strip of some width, the finger in proportion.
    fn of(shapes: Arc<dyn Shapes>, poles: &[Pole], width: f64) -> Self {
        let across = |x: f64| Footprint::line(Point::new(x, 0.0), Point::new(x, width), 4);
        let source = Transducer { footprint: across(SOURCE), ..force(Point::default()) };
        let Finger { mass, damping, stiffness, .. } = Finger::default();
        let share = width / WIDTH;
        let finger = load(across(LENGTH / 2.0), share * mass, share * damping, share * stiffness);
        Self {
            width,
            bare: Loaded::new(shapes.clone(), poles, std::slice::from_ref(&source), &[]).unwrap(),
            touched: Loaded::new(shapes, poles, &[source], &[finger]).unwrap(),
        }
    }

    /// Velocity at the finger over that of the wave that comes, and power of that wave per squared amplitude at the finger.
    fn measured(&self, hz: f64) -> (c64, f64) {
        let s = c64::new(0.0, TAU * hz);
        let across = |x: f64| Footprint::line(Point::new(x, 0.0), Point::new(x, self.width), 4);
        let middle = across(LENGTH / 2.0);
        let (incident, felt) = (self.bare.admittance(0, &middle, s), self.touched.admittance(0, &middle, s));
        // The source sends half of its power each way (crest, as the paper counts), and losses take some on the way.
        let at_source = self.bare.admittance(0, &across(SOURCE), s);
        let power = 0.5 * at_source.re * (incident.norm() / at_source.norm()).powi(2);
        (felt / incident, power / (felt.norm() / s.norm()).powi(2) * WIDTH / self.width)
    }
}

const BAND: [f64; 12] =
    [120.0, 200.0, 290.0, 356.0, 450.0, 700.0, 1000.0, 1400.0, 1800.0, 2200.0, 2600.0, 2950.0];

/// Without bending, the paper's equations are what a strip does. All is in proportion to the width, so that a narrow strip will
/// do: across it is still, up to frequencies whose compliance no longer counts.
#[test]
fn a_finger_on_a_long_taut_strip() {
    let mut surface = film(edges("fsfs"));
    let narrow = 0.1e-3;
    surface.outline.shape = Shape::Rectangle { width: LENGTH, height: narrow };
    (surface.sheet.young, surface.sheet.poisson, surface.sheet.decay) = (0.0, 0.0, losses());
    let (shapes, poles) = modes(&surface, 160e3);
    let long = Long::of(shapes, &poles, narrow);
    let strip = Strip::of_sheet(0.0, 1400.0, 0.125e-3, 200.0, WIDTH);
    let mut worst = [0.0f64; 2];
    for hz in BAND {
        let (passed, power) = long.measured(hz);
        let expected = strip.scattering(&Finger::default(), hz).transmission;
        let (wave, finger) = (strip.impedance(0.0), finger_impedance(&Finger::default(), TAU * hz));
        let equation3 = 2.0 * wave / (c64::new(finger.0, finger.1) + 2.0 * wave);
        let equation4 = strip.power(&Finger::default(), strip.wavenumber(hz), 1.0);
        assert!((equation3.norm() / expected - 1.0).abs() < 1e-12);
        let errors = [(passed / equation3 - 1.0).norm(), (power / equation4 - 1.0).abs()];
        println!("{hz} Hz: passed {:.5} {:.5}, power {power:.4e} {equation4:.4e}", passed.norm(), expected);
        worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
    }
    println!("worst errors of equations (3) and (4): {worst:?}");
    assert!(worst[0] < 0.02 && worst[1] < 0.02, "{worst:?}");
}

/// Modes of the film's strip that are even across: sines, with bending.
#[derive(Debug)]
struct Sines(usize);

impl Shapes for Sines {
    fn modes(&self) -> usize {
        self.0
    }

    fn at(&self, p: Point, row: &mut [f64]) {
        let amplitude = (2.0 / (0.175 * WIDTH * LENGTH)).sqrt();
        (1..).zip(row).for_each(|(m, w)| *w = amplitude * (f64::from(m) * PI * p.x / LENGTH).sin());
    }
}

/// With bending a strip answers a force with a near field besides the waves: it is not the paper's Z_S but half of
/// 1/Y = 2(R + 2Dk²)(k/ω)/(1 - jk/κ) that meets the finger.
#[test]
fn a_finger_on_a_long_strip_of_film() {
    let strip = Strip::of_sheet(4e9, 1400.0, 0.125e-3, 200.0, WIDTH);
    let count = 60_000;
    let poles: Vec<Pole> = (1..=count)
        .map(|m| {
            let k = m as f64 * PI / LENGTH;
            let omega = k * strip.celerity(k);
            Pole::new(omega, 0.5 * LOSS * omega)
        })
        .collect();
    let long = Long::of(Arc::new(Sines(count)), &poles, WIDTH);
    for hz in BAND {
        let (passed, power) = long.measured(hz);
        let (k, omega) = (strip.wavenumber(hz), TAU * hz);
        let finger = finger_impedance(&Finger::default(), omega);
        let finger = c64::new(finger.0, finger.1);
        let near = (strip.tension / strip.bending_stiffness + k * k).sqrt();
        let slope = strip.tension + 2.0 * strip.bending_stiffness * k * k;
        let mobility = c64::new(1.0, -k / near) * (omega / (2.0 * k * slope));
        let exact = 1.0 / (finger * mobility + 1.0);
        assert!((passed / exact - 1.0).norm() < 0.02, "{hz}: {passed} {exact}");
        let paper = strip.scattering(&Finger::default(), hz).transmission;
        let printed = strip.power(&Finger::default(), k, 1.0);
        println!(
            "{hz} Hz: passed {:.5}, exact {:.5}, paper {paper:.5} ({:+.1} %), power {:+.1} % of paper's",
            passed.norm(),
            exact.norm(),
            100.0 * (paper / passed.norm() - 1.0),
            100.0 * (power / printed - 1.0)
        );
        // The paper's waves are the strip's as long as tension is what stretches it.
        let bent = strip.bending_stiffness * k * k / strip.tension;
        assert!(bent > 0.012 || (paper / passed.norm() - 1.0).abs() < 0.02, "{hz}: {paper} {passed}");
    }
}
