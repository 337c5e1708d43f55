//! One search for the best places of actuators, beside which `python/benches/placement.py` puts the same in numpy.
//!
//! `search N RESTARTS` places N actuators 6 to 12 mm from the rim of the paper's film with supported edges, for the mean contrast at 20
//! targets: from a greedy layout and from RESTARTS random ones, each improved by exchange. Prints the largest mean contrast that was found
//! and the processor time of this process, in seconds.

use std::error::Error;
use std::time::Duration;
use unripple_core::{Edge, Edges};
use unripple_physics::design::papers_surface;
use unripple_placement::{Aim, Chosen, Forms, Objective, Plant, Rules, Search, spread};

/// Window, in seconds.
const WINDOW: f64 = 30e-3;

/// Pitch of the grid of places, in metres.
const PITCH: f64 = 2.07e-3;

/// Seed of the random layouts, also of those in numpy.
const SEED: u64 = 1;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |usual: usize| arguments.next().map_or(Ok(usual), |text| text.parse());
    let (count, restarts) = (number(8)?, number(10)?);
    let mut surface = papers_surface();
    let kind = surface.actuators[0].clone();
    surface.actuators.clear();
    surface.outline = surface.outline.clone().with_edges(Edges::All(Edge::Supported));
    let outline = surface.outline.clone();
    let plants = [Plant::new(surface, &kind)?];
    let places = Rules { from_rim: [6e-3, 12e-3], ..Rules::default() }.grid(&outline, PITCH)?;
    let inside = Rules { from_rim: [15e-3, f64::INFINITY], ..Rules::default() };
    let aims: Vec<Aim> =
        spread(&outline, &inside, 0, 20).into_iter().map(|at| Aim { at, weight: 1.0 }).collect();
    let forms = Forms::new(&plants, &places, &aims, WINDOW, 0.0)?;
    let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
    let from_greedy = search.exchanged(greedy(&forms, count));
    let from_random = search.restarts(count, restarts, SEED)?;
    let best = from_random.iter().map(|found| found.score).fold(from_greedy.score, f64::max);
    println!("{best} {}", processor().as_secs_f64());
    Ok(())
}

/// A layout to which the best place is added, one at a time.
fn greedy(forms: &Forms, count: usize) -> Vec<usize> {
    let mut layout: Vec<usize> = Vec::new();
    for _ in 0..count {
        let scores = Chosen::new(forms, layout.clone()).with_each(Objective::Mean);
        let free = (0..scores.len()).filter(|place| !layout.contains(place));
        let best = free.reduce(|best, place| if scores[place] > scores[best] { place } else { best });
        layout.extend(best);
    }
    layout
}

/// Processor time of this process.
fn processor() -> Duration {
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let all = threads.filter_map(|task| std::fs::read_to_string(task.path().join("schedstat")).ok());
    let nanos = |text: String| text.split(' ').next().and_then(|n| n.parse::<u64>().ok()).unwrap_or(0);
    Duration::from_nanos(all.map(nanos).sum())
}
