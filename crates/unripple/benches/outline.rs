//! 300 modes of a clamped film with an irregular outline, beside scikit-fem on the same kind of mesh:
//! `cargo bench -p unripple --bench outline`.

mod common;

use common::machine::{self, introduce};
use common::table::{Table, number};
use common::times::Times;
use common::{Outcome, peers, surface};
use std::hint::black_box;
use unripple::core::{Outline, Shape, Surface};
use unripple::physics::{Modes, PhysicsError};
use unripple_paper::study::cavities;

/// Modes asked for.
const COUNT: usize = 300;

/// Accuracy of the reference.
const CONVERGED: f64 = 1e-6;

/// Edge lengths of the peer's meshes, in metres.
const SIZES: [&str; 3] = ["0.0085", "0.0075", "0.0065"];

/// One way to the modes.
struct Entry {
    name: String,
    threads: usize,
    times: Times,
    error: f64,
}

fn main() -> Outcome {
    let film = surface();
    let polygon = cavities(film.outline.area()).pop().ok_or("no outline")?.1;
    let film = Surface { outline: polygon, ..film };
    let (reference, max_hz) = reference(&film)?;
    introduce(
        &format!("outline: {COUNT} modes of an irregular hexagon of the paper's film, below {max_hz:.1} Hz"),
        machine::threads(),
    );
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut entries = Vec::new();
    for accuracy in [1e-3, 1e-4, 1e-5] {
        entries.push(ours(&film, max_hz, accuracy, machine::threads(), &reference)?);
        entries.push(one.install(|| ours(&film, max_hz, accuracy, 1, &reference))?);
    }
    for size in SIZES {
        match peer(&film.outline, size, &reference) {
            Ok(entry) => entries.push(entry),
            Err(reason) => println!("  scikit-fem skipped: {reason}"),
        }
    }
    print(&entries);
    if let Some(megabytes) = machine::peak_megabytes() {
        println!("  largest resident memory of this process: {megabytes:.0} MB");
    }
    println!("  load after {}", machine::load());
    Ok(())
}

/// Converged frequencies, and a top just above the last that is asked for.
fn reference(surface: &Surface) -> Result<(Vec<f64>, f64), PhysicsError> {
    let mut hz = Modes::solve(surface, 3100.0, CONVERGED)?.frequencies_hz();
    let max_hz = hz[COUNT - 1] * (1.0 + 1e-3);
    hz.truncate(COUNT);
    Ok((hz, max_hz))
}

fn ours(
    surface: &Surface,
    max_hz: f64,
    accuracy: f64,
    threads: usize,
    reference: &[f64],
) -> Result<Entry, PhysicsError> {
    let error = worst(&Modes::solve(surface, max_hz, accuracy)?.frequencies_hz(), reference);
    let times = Times::of(7, |_| {
        black_box(Modes::solve(surface, max_hz, accuracy).is_ok());
    });
    Ok(Entry { name: format!("unripple, accuracy {accuracy:.0e}"), threads, times, error })
}

fn peer(outline: &Outline, size: &str, reference: &[f64]) -> Result<Entry, String> {
    let Shape::Polygon(vertices) = &outline.shape else { return Err("not a polygon".into()) };
    let mut arguments = vec![COUNT.to_string(), size.to_owned(), "2".to_owned()];
    arguments.extend(vertices.iter().flat_map(|p| [p.x.to_string(), p.y.to_string()]));
    let answer = peers::run("modes_argyris.py", &arguments, machine::threads())?;
    let times = Times::from(peers::numbers(&answer, "seconds")?.to_vec());
    let unknowns = peers::numbers(&answer, "unknowns")?.first().copied().unwrap_or(f64::NAN);
    let error = worst(peers::numbers(&answer, "hz")?, reference);
    let name = format!("scikit-fem Argyris, ARPACK, {unknowns:.0} unknowns");
    Ok(Entry { name, threads: machine::threads(), times, error })
}

/// Largest relative error of all frequencies; infinite if some are missing.
fn worst(hz: &[f64], reference: &[f64]) -> f64 {
    let error = hz.iter().zip(reference).map(|(f, g)| (f / g - 1.0).abs()).fold(0.0, f64::max);
    if hz.len() < reference.len() { f64::INFINITY } else { error }
}

fn print(entries: &[Entry]) {
    let base = entries[0].times.median();
    let mut table =
        Table::new(["", "threads", "runs", "best s", "median s", "worst s", "of the first", "largest error"]);
    for Entry { name, threads, times, error } in entries {
        table.row([
            name.clone(),
            threads.to_string(),
            times.count().to_string(),
            number(times.best(), 4),
            number(times.median(), 4),
            number(times.worst(), 4),
            format!("{:.1} x", times.median() / base),
            format!("{error:.1e}"),
        ]);
    }
    table.print();
}
