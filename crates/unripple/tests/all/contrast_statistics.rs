//! Contrast predicted by statistics of modes against simulation: five surfaces, actuators at the rim and inside, many numbers and windows.

use unripple_core::*;
use unripple_paper::study::{Bench, CELLS, Compared, Sampling, against_window};
use unripple_physics::Medium;
use unripple_physics::design::{Statistics, papers_surface};

const WINDOWS: [f64; 5] = [0.005, 0.015, 0.030, 0.075, 0.150];
const ACTUATORS: [usize; 4] = [1, 4, 8, 32];

/// A rectangle (m) of a sheet.
fn rectangle(sides: [f64; 2], edge: Edge, sheet: impl Fn(&mut Sheet), top_hz: f64) -> Surface {
    let mut surface = papers_surface();
    let [width, height] = sides;
    surface.outline = Outline::new(Shape::Rectangle { width, height }).with_edges(Edges::All(edge));
    sheet(&mut surface.sheet);
    surface.emission.band = [0.0, top_hz];
    surface
}

fn glass(sheet: &mut Sheet) {
    (sheet.young, sheet.density, sheet.poisson) = (70e9, 2500.0, 0.22);
    (sheet.thickness, sheet.tension, sheet.decay) = (1e-3, 0.0, Decay::LossFactor(0.005));
}

/// Name, surface, least and greatest depth of actuators at the rim (m).
fn surfaces() -> Vec<(&'static str, Surface, [f64; 2])> {
    vec![
        ("film", papers_surface(), [6e-3, 12e-3]),
        ("large film", rectangle([0.4, 0.3], Edge::Clamped, |_| (), 2000.0), [8e-3, 20e-3]),
        (
            "small film, loss factor",
            rectangle([0.08, 0.07], Edge::Clamped, |s| s.decay = Decay::LossFactor(0.01), 6000.0),
            [4e-3, 8e-3],
        ),
        ("glass plate", rectangle([0.3, 0.2], Edge::Clamped, glass, 8000.0), [5e-3, 15e-3]),
        ("small panel", rectangle([0.2, 0.12], Edge::Supported, glass, 4500.0), [8e-3, 16e-3]),
    ]
}

#[test]
fn statistics_follow_simulation() {
    let mut ratios = Vec::new();
    for (name, surface, rim) in surfaces() {
        let bench = Bench::of(&surface, CELLS).unwrap();
        let (width, height) = surface.outline.extent();
        let lambda = bench.conditions().lambda_min;
        for (place, depth) in [("rim", rim), ("inside", [0.15 * width.min(height), 0.45 * width.min(height)])]
        {
            let sampling = Sampling {
                placements: 40,
                targets: 2,
                depth,
                margin: lambda.min(0.2 * width.min(height)),
                seed: 5,
            };
            // The statistics of actuators placed in the same way, with another seed.
            let like = Sampling { placements: 4, seed: 17, ..sampling.clone() };
            let places: Vec<Point> =
                like.draws(&surface.outline, 8).into_iter().flat_map(|draw| draw.actuators).collect();
            let Responses::Modal(modal) = bench.responses(&places) else { unreachable!() };
            let statistics = Statistics::of(&modal, Medium::of(&surface.sheet)).unwrap();
            for row in against_window(&bench, &surface, &WINDOWS, &ACTUATORS, &sampling) {
                let Compared { actuators, varied, simulated, predicted, .. } = row;
                let by_modes = statistics.contrasts(&[actuators as f64], varied)[0];
                let ratio = by_modes / simulated;
                println!(
                    "{name:24} {:3} modes {place:6} N {actuators:2} T {:3.0} ms  simulated {simulated:6.2}  \
                     statistics {ratio:5.3}  cavity {:5.3}",
                    bench.modes(),
                    1e3 * varied,
                    predicted / simulated
                );
                ratios.push(ratio);
            }
        }
    }
    let mut off: Vec<f64> = ratios.iter().map(|ratio| (ratio - 1.0).abs()).collect();
    off.sort_by(f64::total_cmp);
    let (worst, most) = (off[off.len() - 1], off[off.len() * 9 / 10]);
    println!("{} conditions: worst {worst:.3}, nine tenths within {most:.3}", off.len());
    assert!(off.len() >= 96 && worst < 0.15, "{worst}");
}
