//! The accuracy asked for beside the error that is true and the one that is stated, on sheets whose frequencies are known by another
//! route: `cargo run --release -p unripple-physics --example accuracy`.

#[path = "../../unripple-plates/tests/round_common/mod.rs"]
mod round_common;
#[path = "../../unripple-plates/tests/truth_common/mod.rs"]
mod truth_common;

use std::time::Instant;
use truth_common::cases::{self, Case};
use unripple_core::{Edge, Edges, Outline, Shape, Surface};
use unripple_physics::design::papers_surface;
use unripple_physics::{Modes, PhysicsError};

/// Radius of the circles of film and glass, in metres.
const RADIUS: f64 = 0.07;

/// The accuracies asked for.
const ASKED: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

fn main() {
    println!("| sheet | modes | {} |", ASKED.map(|a| format!("asked {a:.0e}")).join(" | "));
    println!("|---|---:|{}", "---:|".repeat(ASKED.len()));
    for (name, edge) in [("clamped", Edge::Clamped), ("supported", Edge::Supported), ("free", Edge::Free)] {
        for (what, film) in [("film", true), ("glass", false)] {
            row(&round(format!("{name} circle, {what}"), edge, film));
        }
    }
    cases::all().iter().for_each(row);
}

/// The paper's film, or glass of 1 mm, cut round.
fn round(name: String, edge: Edge, film: bool) -> Case {
    let outline = Outline::new(Shape::Circle { radius: RADIUS }).with_edges(Edges::All(edge));
    let mut surface = Surface { outline, actuators: Vec::new(), ..papers_surface() };
    let sheet = &mut surface.sheet;
    if !film {
        (sheet.young, sheet.density, sheet.thickness, sheet.tension) = (69e9, 2300.0, 1e-3, 0.0);
    }
    let top_hz = if film { 3000.0 } else { 40e3 };
    let known = round_common::frequencies(sheet, RADIUS, edge, top_hz);
    Case { name, surface, top_hz, known, all: true, finest: cases::FINEST, told: cases::TOLD }
}

/// The true and the stated error, and the time in s, for each accuracy.
fn row(case: &Case) {
    let cells = ASKED.map(|accuracy| {
        if accuracy < case.finest {
            return "–".to_owned();
        }
        let start = Instant::now();
        let found = Modes::solve(&case.surface, case.top_hz, accuracy);
        let time = start.elapsed().as_secs_f64();
        match found {
            Ok(modes) => {
                format!("{:.1e} / {:.1e} ({time:.1})", case.error(&modes.frequencies_hz()), modes.error())
            }
            Err(PhysicsError::NotConverged { found, .. }) => format!("refused at {found:.1e} ({time:.1})"),
            Err(error) => error.to_string(),
        }
    });
    println!("| {} | {} | {} |", case.name, case.known.len(), cells.join(" | "));
}
