//! 350 modes of the paper's membrane, beside scikit-fem and plain numpy: `cargo bench -p unripple --bench modes`.

mod common;

use common::machine::{self, introduce, product_rate};
use common::table::{Table, none, number};
use common::times::Times;
use common::{Outcome, peers, surface};
use std::hint::black_box;
use unripple::core::Surface;
use unripple::physics::{Modes, PhysicsError};
use unripple_linalg::Par;

/// Modes asked for.
const COUNT: usize = 350;

/// Accuracy of the reference.
const CONVERGED: f64 = 1e-9;

/// Frequencies counted from 1 and their known values in Hz, spectrally converged by an independent program.
const KNOWN: [(usize, f64); 8] = [
    (1, 163.7436),
    (2, 259.5112),
    (4, 329.0241),
    (11, 497.3519),
    (51, 1050.6023),
    (101, 1542.4735),
    (201, 2286.7912),
    (301, 2992.414),
];

/// One way to the modes: who, times, frequencies.
struct Entry {
    name: String,
    threads: usize,
    times: Times,
    hz: Vec<f64>,
}

fn main() -> Outcome {
    let surface = surface();
    let (reference, max_hz) = reference(&surface)?;
    introduce(&format!("modes: {COUNT} modes of hudin-2012, below {max_hz:.1} Hz"), machine::threads());
    let known = KNOWN.iter().map(|(n, hz)| (reference[n - 1] / hz - 1.0).abs()).fold(0.0, f64::max);
    println!(
        "  reference: solved to {CONVERGED:.0e}; within {known:.1e} of known values (given to 4 decimals)"
    );

    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut entries = Vec::new();
    for accuracy in [1e-3, 1e-6] {
        entries.push(ours(&surface, max_hz, accuracy, machine::threads())?);
        entries.push(one.install(|| ours(&surface, max_hz, accuracy, 1))?);
    }
    for (name, script, runs) in
        [("numpy Ritz 34²", "modes_numpy.py", "20"), ("scikit-fem BFS 48²", "modes_skfem.py", "2")]
    {
        match peer(name, script, runs) {
            Ok(entry) => entries.push(entry),
            Err(reason) => println!("  {name} skipped: {reason}"),
        }
    }
    print(&entries, &reference);
    limit(&entries);
    println!("  load after {}", machine::load());
    Ok(())
}

/// Converged frequencies, and a top just above the last that is asked for.
fn reference(surface: &Surface) -> Result<(Vec<f64>, f64), PhysicsError> {
    let mut hz = Modes::solve(surface, 3400.0, CONVERGED)?.frequencies_hz();
    let max_hz = hz[COUNT - 1] * (1.0 + 2e-3);
    hz.truncate(COUNT);
    Ok((hz, max_hz))
}

fn ours(surface: &Surface, max_hz: f64, accuracy: f64, threads: usize) -> Result<Entry, PhysicsError> {
    let hz = Modes::solve(surface, max_hz, accuracy)?.frequencies_hz();
    let times = Times::of(30, |_| {
        black_box(Modes::solve(surface, max_hz, accuracy).is_ok());
    });
    Ok(Entry { name: format!("unripple, accuracy {accuracy:.0e}"), threads, times, hz })
}

fn peer(name: &str, script: &str, runs: &str) -> Result<Entry, String> {
    let answer = peers::run(script, &[COUNT.to_string(), runs.into()], machine::threads())?;
    let times = Times::from(peers::numbers(&answer, "seconds")?.to_vec());
    let hz = peers::numbers(&answer, "hz")?.to_vec();
    Ok(Entry { name: name.into(), threads: machine::threads(), times, hz })
}

fn print(entries: &[Entry], reference: &[f64]) {
    let base = entries[0].times.median();
    let mut table = Table::new([
        "",
        "threads",
        "runs",
        "best s",
        "median s",
        "worst s",
        "of the first",
        "modes",
        "largest error",
    ]);
    for Entry { name, threads, times, hz } in entries {
        let error = hz.iter().zip(reference).map(|(f, g)| (f / g - 1.0).abs()).fold(0.0, f64::max);
        let whole = hz.len() >= reference.len();
        table.row([
            name.clone(),
            threads.to_string(),
            times.count().to_string(),
            number(times.best(), 4),
            number(times.median(), 4),
            number(times.worst(), 4),
            format!("{:.2} x", times.median() / base),
            hz.len().to_string(),
            if whole { format!("{error:.1e}") } else { none() },
        ]);
    }
    table.print();
}

/// Four dense symmetric problems of 17² unknowns: reduction, eigenvectors and their transformation back,
/// (4/3 + 4/3) n³ + 2 n² m each.
fn limit(entries: &[Entry]) {
    let (n, m) = (289.0_f64, COUNT as f64 / 4.0);
    let flops = 4.0 * (8.0 / 3.0 * n.powi(3) + 2.0 * n * n * m);
    let rate = product_rate([1024, 1024, 1024], Par::rayon(0), 1.0_f64);
    let least = flops / rate;
    println!(
        "  limit: four dense eigenproblems of 17² unknowns take {:.2} Gflop, {:.1} ms at the f64 matrix product's \
         {:.1} Gflop/s; the first row takes {:.1} times that (half of a reduction is bound by memory, and no product)",
        flops / 1e9,
        least * 1e3,
        rate / 1e9,
        entries[0].times.median() / least
    );
}
