//! Fits that begin from surface files that are wrong: back to the true contrast, or doubtful. `UNRIPPLE_BEGINNINGS=10` tries them all.

use crate::fit_truth;

use fit_truth::*;
use unripple_calibrate::{FitOptions, Verdict, fit};
use unripple_core::{Decay, Edge, Edges, Outline, Random, Surface};
use unripple_physics::design::papers_surface;

const TOP: f64 = 800.0;

/// What a surface file says wrong: tension and thickness as ratios, places (m), and whether the true rim gives where it is said to be
/// clamped.
#[derive(Clone, Copy, Debug)]
struct Wrong {
    tension: f64,
    thickness: f64,
    places: f64,
    springs: bool,
}

/// The ten, the hardest first.
fn beginnings() -> Vec<Wrong> {
    let one = |tension, thickness, places, springs| Wrong { tension, thickness, places, springs };
    vec![
        one(1.1, 0.95, 2e-3, false),
        one(1.0, 1.0, 2e-3, true),
        one(0.9, 1.05, 2e-3, false),
        one(0.9, 1.05, 0.0, true),
        one(1.1, 1.0, 0.0, false),
        one(0.9, 1.0, 0.0, false),
        one(1.0, 1.05, 0.0, false),
        one(1.0, 0.95, 1e-3, false),
        one(1.0, 1.0, 2e-3, false),
        one(1.1, 1.05, 2e-3, true),
    ]
}

fn truth(wrong: &Wrong, seed: u64) -> Truth {
    let mut nominal = papers_surface();
    nominal.emission.band[1] = TOP;
    let mut surface: Surface = nominal.clone();
    let mut random = Random::seeded(seed);
    // What is true is off from what is said, so that the file is wrong by the inverse.
    surface.sheet.tension /= wrong.tension;
    surface.sheet.thickness /= wrong.thickness;
    surface.sheet.decay = Decay::Table(vec![(150.0, 0.08), (600.0, 0.07), (1500.0, 0.06)]);
    for actuator in &mut surface.actuators {
        let angle = random.between(0.0, std::f64::consts::TAU);
        actuator.at.x += wrong.places * angle.cos();
        actuator.at.y += wrong.places * angle.sin();
    }
    if wrong.springs {
        // A rim that gives by 2 % of the sheet's width: its springs are as stiff as tension over 3 mm.
        let lift = surface.sheet.tension / 3e-3;
        let held = Edges::All(Edge::Elastic { lift, tilt: 0.1 });
        surface.outline = Outline::new(surface.outline.shape.clone()).with_edges(held);
    }
    let faults = Faults { snr: 50.0, ..Faults::default() };
    Truth::of(nominal, surface, &faults, random)
}

#[test]
fn a_fit_finds_back_from_a_wrong_file_or_says_that_it_does_not() {
    let count = std::env::var("UNRIPPLE_BEGINNINGS").map_or(2, |n| n.parse().unwrap());
    let judged = targets(4);
    println!("| tension | thickness | places | rim | unexplained | verdict | time reversal | inverse |");
    println!("|---|---|---|---|---|---|---|---|");
    let mut failed = Vec::new();
    for (n, wrong) in beginnings().into_iter().take(count).enumerate() {
        let mut truth = truth(&wrong, n as u64 + 1);
        let measured = truth.swept(0.1);
        let fitted =
            fit(&truth.nominal, &measured, &FitOptions { strays: 1, ..FitOptions::default() }).unwrap();
        let [reversal, inverse] = truth.shares(&fitted.responses(), &judged);
        let good = fitted.verdict == Verdict::Good;
        println!(
            "| x {:.2} | x {:.2} | {:.0} mm | {} | {:.1} % | {} | {reversal:.3} | {inverse:.3} |",
            wrong.tension,
            wrong.thickness,
            1e3 * wrong.places,
            if wrong.springs { "springs, said clamped" } else { "clamped" },
            100.0 * fitted.unexplained(),
            if good { "good" } else { "doubtful" },
        );
        if let Verdict::Doubtful { why, .. } = &fitted.verdict {
            println!("  ({why})");
        }
        if good && reversal < 0.98 {
            failed.push(n);
        }
        // What no model is wrong about has to be found back, not only doubted.
        if !wrong.springs && !good {
            failed.push(n);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
