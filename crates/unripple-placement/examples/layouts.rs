//! Contrast of placed actuators beside that of random layouts and of the paper's own, on several surfaces.
//!
//! `layouts [SURFACE]...` takes names of the list below; without any, all. Targets on which layouts are judged are not those on which they
//! were placed. Processor time is that of this process, on all its threads.

use std::time::Duration;
use unripple_core::{Actuator, ActuatorKind, CoilDrive, Decay, Edge, Edges, Outline, Point, Shape, Surface};
use unripple_physics::design::papers_surface;
use unripple_placement::{
    Aim, Forms, Objective, PlacementError, Plant, Polish, Rules, Search, figure, reached, reached_each,
    spread,
};

/// Window, in seconds.
const WINDOW: f64 = 30e-3;

fn main() -> Result<(), PlacementError> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    println!(
        "surface | N | random (sd) | own | grid | polished | of random | worst, of random's | energy, of random's | restarts | CPU s"
    );
    for (name, surface, kind) in surfaces() {
        if names.is_empty() || names.iter().any(|wanted| wanted == name) {
            table(name, surface, &kind)?;
        }
    }
    Ok(())
}

/// The surfaces of the table, each with the kind of actuator that is placed.
fn surfaces() -> Vec<(&'static str, Surface, Actuator)> {
    let clamped = papers_surface();
    let force = clamped.actuators[0].clone();
    let with = |edge: Edge| Surface {
        outline: clamped.outline.clone().with_edges(Edges::All(edge)),
        ..clamped.clone()
    };
    let coil = Actuator {
        contact_radius: 2e-3,
        kind: ActuatorKind::MovingMagnet {
            force_constant: 0.2,
            resistance: 8.0,
            inductance: 0.1e-3,
            moving_mass: 20e-6,
            driven_by: CoilDrive::Current,
        },
        ..force.clone()
    };
    let mut stadium = clamped.clone();
    stadium.outline = Outline::new(Shape::Stadium { straight: 0.1, radius: 0.05 });
    stadium.actuators.clear();
    let mut glass = papers_surface();
    glass.outline =
        Outline::new(Shape::Rectangle { width: 0.148, height: 0.21 }).with_edges(Edges::All(Edge::Free));
    glass.sheet.young = 70e9;
    glass.sheet.density = 2500.0;
    glass.sheet.poisson = 0.22;
    glass.sheet.thickness = 0.5e-3;
    glass.sheet.tension = 0.0;
    glass.sheet.decay = Decay::Time(0.02);
    glass.emission.band = [0.0, 20e3];
    glass.emission.rate = 192e3;
    glass.actuators.clear();
    vec![
        ("supported", with(Edge::Supported), force.clone()),
        ("clamped", clamped.clone(), force.clone()),
        ("coils", clamped.clone(), coil),
        ("stadium", stadium, force.clone()),
        ("glass", glass, force),
    ]
}

fn aims(outline: &Outline, from_rim: f64, skip: usize, count: usize) -> Vec<Aim> {
    let rules = Rules { from_rim: [from_rim, f64::INFINITY], ..Rules::default() };
    spread(outline, &rules, skip, count).into_iter().map(|at| Aim { at, weight: 1.0 }).collect()
}

fn table(name: &str, mut surface: Surface, kind: &Actuator) -> Result<(), PlacementError> {
    let own: Vec<Point> = surface.actuators.drain(..).map(|actuator| actuator.at).collect();
    let outline = surface.outline.clone();
    let plants = [Plant::new(surface, kind)?];
    let (trained, tested) = (aims(&outline, 15e-3, 0, 20), aims(&outline, 15e-3, 20, 60));
    let rules = Rules { from_rim: [6e-3, 12e-3], ..Rules::default() };
    let pitch = 2.07e-3;
    let places = rules.grid(&outline, pitch)?;
    let forms = Forms::new(&plants, &places, &trained, WINDOW, 0.0)?;
    println!("{name}: {} places, precomputed by {:.2} s", places.len(), processor().as_secs_f64());
    let search = Search { forms: &forms, at: &places, kept: 0, apart: 0.0, objective: Objective::Mean };
    let measured = |places: &[Point]| reached(&plants, places, &tested, WINDOW);
    for count in [4, 8, 16, 32] {
        let layouts = search.random(count, 20, 1)?;
        let at = |layout: &[usize]| layout.iter().map(|a| places[*a]).collect::<Vec<_>>();
        let drawn: Vec<Vec<Point>> = layouts.iter().map(|layout| at(layout)).collect();
        let random = reached_each(&plants, &drawn, &tested, WINDOW)?;
        let means: Vec<f64> = random.iter().map(|r| figure(r, &tested, Objective::Mean)).collect();
        let worst = random.iter().map(|r| figure(r, &tested, Objective::Worst)).sum::<f64>() / 20.0;
        let mean = means.iter().sum::<f64>() / 20.0;
        let sd = (means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / 19.0).sqrt();
        let energy = random.iter().flatten().map(|r| r.energy).sum::<f64>() / (20.0 * tested.len() as f64);
        let before = processor();
        let found = search.restarts(count, 10, 2)?;
        let best = found.iter().reduce(|a, b| if b.score > a.score { b } else { a });
        let Some(best) = best else { unreachable!("ten restarts") };
        let least = found.iter().map(|found| found.score).fold(f64::INFINITY, f64::min);
        let searched = processor() - before;
        let polish = Polish {
            plants: &plants,
            aims: &trained,
            window: WINDOW,
            mounting: 0.0,
            rules: &rules,
            apart: 0.0,
            objective: Objective::Mean,
        };
        let (polished, _) = polish.polished(at(&best.actuators), pitch)?;
        let polish = processor() - before - searched;
        let (grid, final_) = (measured(&at(&best.actuators))?, measured(&polished)?);
        let own = match own.len() == count {
            true => format!("{:.1}", figure(&measured(&own)?, &tested, Objective::Mean)),
            false => "-".into(),
        };
        let after = figure(&final_, &tested, Objective::Mean);
        println!(
            "{name} | {count} | {mean:.1} ({sd:.1}) | {own} | {:.1} | {after:.1} | {:.2} | {:.2} | {:.2} | {:.1} to {:.1} | {:.2} + {:.2}",
            figure(&grid, &tested, Objective::Mean),
            after / mean,
            figure(&final_, &tested, Objective::Worst) / worst,
            final_.iter().map(|r| r.energy).sum::<f64>() / tested.len() as f64 / energy,
            least,
            best.score,
            searched.as_secs_f64(),
            polish.as_secs_f64(),
        );
    }
    Ok(())
}

/// Processor time of this process.
fn processor() -> Duration {
    let used = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let all = threads.filter_map(|task| std::fs::read_to_string(task.path().join("schedstat")).ok());
    let nanos = |text: &str| text.split(' ').next().and_then(|n| n.parse::<u64>().ok()).unwrap_or(0);
    Duration::from_nanos(all.map(|text| nanos(&text)).sum::<u64>().max(nanos(&used)))
}
