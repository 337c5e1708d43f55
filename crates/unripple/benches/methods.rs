//! New targets by every method, after planning, beside numpy: `cargo bench -p unripple --bench methods`.

mod common;

use common::machine::{introduce, load, product_rate};
use common::table::{Table, none, number};
use common::times::Times;
use common::{Outcome, modal, peers, place, surface};
use std::hint::black_box;
use std::time::Instant;
use unripple::core::{Responses, Surface};
use unripple::focus::{Focuser, Method, Options, Target};
use unripple_linalg::Par;

/// Samples of a response: 30 ms at 48 kHz, both ends.
const SAMPLES: usize = 1441;

/// Decay time of the membrane, in seconds.
const DECAY: f64 = 0.07;

/// Drives timed: of those that take a solve, and of those that take many.
const DRIVES: [usize; 2] = [400, 5];

fn main() -> Outcome {
    // One core: products and rayon see a pool of one thread.
    rayon::ThreadPoolBuilder::new().num_threads(1).build()?.install(run)
}

fn run() -> Outcome {
    let surface = surface();
    let responses = Responses::Modal(modal(&surface)?);
    introduce("methods: a drive for new targets, 306 modes, 8 actuators, 30 ms at 48 kHz", 1);
    let peer = peer(&surface);
    let mut table =
        Table::new(["", "targets", "plan s", "median µs", "p99 µs", "worst µs", "numpy µs", "ratio"]);
    for (method, targets) in [
        (Method::TimeReversal, 1),
        (Method::Inverse, 1),
        (Method::Inverse, 10),
        (Method::Concentrate, 1),
        (Method::Concentrate, 10),
        (Method::Felt, 1),
        (Method::Robust, 1),
        (Method::Limited, 1),
    ] {
        let start = Instant::now();
        let focuser = Focuser::new(&responses, &Options { method, ..Options::default() })?;
        let plan = start.elapsed().as_secs_f64();
        let count = DRIVES[usize::from(method == Method::Limited)];
        let asked =
            |i: usize| -> Vec<Target> { (0..targets).map(|k| Target::at(place(i * targets + k))).collect() };
        let times = Times::of(count, |i| {
            black_box(focuser.focus(black_box(&asked(i))).is_ok());
        });
        let name = format!("{method} {targets}");
        let other =
            peer.as_ref().ok().and_then(|answer| peers::numbers(answer, &name.replace(' ', "-")).ok());
        let other = other.map(|seconds| Times::from(seconds.to_vec()).median());
        table.row([
            method.to_string(),
            targets.to_string(),
            number(plan, 3),
            number(times.median() * 1e6, 0),
            number(times.quantile(0.99) * 1e6, 0),
            number(times.worst() * 1e6, 0),
            other.map_or(none(), |seconds| number(seconds * 1e6, 0)),
            other.map_or(none(), |seconds| number(seconds / times.median(), 1)),
        ]);
    }
    table.print();
    if let Err(reason) = peer {
        println!("  numpy skipped: {reason}");
    }
    limit();
    println!("  load after {}", load());
    Ok(())
}

/// Seconds by numpy, by method and count of targets.
fn peer(surface: &Surface) -> Result<peers::Answer, String> {
    let head =
        [DRIVES[0] as f64 / 4.0, surface.emission.band[1], SAMPLES as f64, surface.emission.rate, DECAY];
    let places = surface.actuators.iter().flat_map(|actuator| [actuator.at.x, actuator.at.y]);
    let arguments: Vec<String> = head.into_iter().chain(places).map(|x| x.to_string()).collect();
    peers::run("methods_numpy.py", &arguments, 1)
}

/// What the arithmetic of one new target takes at the rate of a matrix product.
fn limit() {
    let rate = product_rate([306, 306, 200], Par::Seq, 1.0_f64);
    let (modes, cells) = (306.0_f64, 202.0);
    let disc = modes * modes * cells;
    let factor = modes.powi(3) / 3.0;
    println!(
        "  limit: concentrate leaves out a disc ({:.0} Mflop) and factors ({:.0} Mflop): {:.0} µs at {:.0} Gflop/s, the rate \
         of a product of that size",
        disc / 1e6,
        factor / 1e6,
        (disc + factor) / rate * 1e6,
        rate / 1e9
    );
}
