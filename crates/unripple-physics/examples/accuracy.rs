//! The accuracy asked for beside the accuracy reached, on round sheets against exact frequencies and on a polygon against
//! itself: `cargo run --release -p unripple-physics --example accuracy`.

#[path = "../../unripple-plates/tests/round_common/mod.rs"]
mod round_common;

use std::time::Instant;
use unripple_core::{Edge, Edges, Outline, Point, Shape, Surface};
use unripple_physics::design::papers_surface;
use unripple_physics::{Modes, PhysicsError};

const RADIUS: f64 = 0.07;

fn main() -> Result<(), PhysicsError> {
    println!(
        "| sheet | top Hz | modes | accuracy asked | largest error | s |\n|---|---:|---:|---:|---:|---:|"
    );
    for (name, edge) in [("clamped", Edge::Clamped), ("supported", Edge::Supported), ("free", Edge::Free)] {
        for (what, film) in [("film", true), ("glass", false)] {
            let (surface, top) = round(edge, film);
            let exact = round_common::frequencies(&surface.sheet, RADIUS, edge, top);
            rows(&format!("{name} circle, {what}"), &surface, top, &[1e-3, 1e-4, 1e-5], &exact)?;
        }
    }
    let surface = hexagon();
    let fine = Modes::solve(&surface, 3000.0, 1e-7)?.frequencies_hz();
    rows("clamped hexagon, film", &surface, 3000.0, &[1e-3, 1e-4, 1e-5], &fine)
}

/// The paper's film, or glass of 1 mm, cut round; and a top frequency.
fn round(edge: Edge, film: bool) -> (Surface, f64) {
    let outline = Outline::new(Shape::Circle { radius: RADIUS }).with_edges(Edges::All(edge));
    let mut surface = Surface { outline, actuators: Vec::new(), ..papers_surface() };
    if film {
        return (surface, 3000.0);
    }
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.thickness, sheet.tension) = (69e9, 2300.0, 1e-3, 0.0);
    (surface, 40e3)
}

fn hexagon() -> Surface {
    let corners = [(0.0, 40.0), (57.0, 0.0), (159.0, 12.0), (180.0, 100.0), (96.0, 152.0), (18.0, 126.0)];
    let outline = Outline::new(Shape::Polygon(corners.map(|(x, y)| Point::from_mm(x, y)).to_vec()));
    Surface { outline, actuators: Vec::new(), ..papers_surface() }
}

fn rows(
    name: &str,
    surface: &Surface,
    top: f64,
    accuracies: &[f64],
    exact: &[f64],
) -> Result<(), PhysicsError> {
    for accuracy in accuracies {
        let start = Instant::now();
        let modes = Modes::solve(surface, top, *accuracy)?;
        let time = start.elapsed().as_secs_f64();
        let found: Vec<f64> = modes.frequencies_hz().into_iter().filter(|hz| *hz > 0.0).collect();
        let error = found.iter().zip(exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max);
        let count = found.len();
        println!("| {name} | {top:.0} | {count} | {accuracy:.0e} | {error:.1e} | {time:.2} |");
    }
    Ok(())
}
