//! Responses of 64 channels heard of one sweep, beside pyfar: `cargo bench -p unripple --bench deconvolve`.

mod common;

use common::machine::{introduce, load, threads};
use common::table::{Table, none, number};
use common::times::Times;
use common::{Outcome, peers};
use std::hint::black_box;
use unripple_calibrate::signals::{Deconvolver, Inversion, Sweep};

/// Channels, and samples of each.
const CHANNELS: usize = 64;
const SAMPLES: usize = 1 << 17;

/// Times that all are deconvolved.
const RUNS: usize = 9;

/// The sweep: seconds, and silence after it up to the samples of a channel.
const SWEEP: Sweep = Sweep {
    rate: 48e3,
    from: 30.0,
    to: 3600.0,
    seconds: 2.0,
    amplitude: 1.0,
    fade_in: 0.03,
    fade_out: 0.002,
    silence: 0.0,
    synchronized: false,
};

fn main() -> Outcome {
    introduce("deconvolve: 64 channels of 2^17 samples, all of every response", threads());
    let stimulus = SWEEP.stimulus()?;
    // Each channel hears the sweep late by its own number of samples.
    let late = |channel: usize| 10 + 7 * channel;
    let mut heard = vec![0.0; CHANNELS * SAMPLES];
    for (channel, heard) in heard.chunks_mut(SAMPLES).enumerate() {
        heard[late(channel)..].iter_mut().zip(stimulus.samples()).for_each(|(to, from)| *to = 0.5 * from);
    }
    let plan = Deconvolver::new(&stimulus, SAMPLES, &Inversion::default())?;
    let mut responses = vec![0.0; heard.len()];
    let arguments = [CHANNELS, SAMPLES, RUNS].map(|x| x.to_string());
    let fields = [SWEEP.rate, SWEEP.from, SWEEP.to, SWEEP.seconds].map(|x| x.to_string());
    let peer = peers::run("deconvolve_pyfar.py", &[&arguments[..], &fields[..]].concat(), 1);
    let seconds = peer.as_ref().ok().and_then(|answer| peers::numbers(answer, "seconds").ok());
    let other = seconds.map(|seconds| Times::from(seconds.to_vec()));
    let mut table = Table::new(["", "threads", "best s", "median s", "worst s", "pyfar over ours"]);
    for count in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build()?;
        let times = pool.install(|| {
            Times::of(RUNS, |_| {
                let done = plan.deconvolve_all(black_box(&heard), &mut responses, SAMPLES);
                assert!(done.is_ok(), "sizes agree");
                black_box(&responses);
            })
        });
        let ratio = other.as_ref().map(|other| other.median() / times.median());
        row(&mut table, "ours", count, &times, ratio);
    }
    if let Some(other) = &other {
        row(&mut table, "pyfar", 1, other, None);
    }
    table.print();
    let largest = |response: &[f64]| (0..SAMPLES).max_by(|&a, &b| response[a].total_cmp(&response[b]));
    let ours: Vec<f64> = responses.chunks(SAMPLES).filter_map(largest).map(|at| at as f64).collect();
    let right = (0..CHANNELS).all(|channel| ours.get(channel) == Some(&(late(channel) as f64)));
    println!("  every response of ours has its peak where it was put: {right}");
    match &peer {
        Ok(answer) => println!("  and pyfar's where ours has: {}", peers::numbers(answer, "peaks")? == ours),
        Err(reason) => println!("  pyfar skipped: {reason}"),
    }
    println!("  load after {}", load());
    Ok(())
}

fn row(table: &mut Table, name: &str, threads: usize, times: &Times, ratio: Option<f64>) {
    let [best, median, worst] = [times.best(), times.median(), times.worst()].map(|t| number(t, 4));
    let ratio = ratio.map_or(none(), |ratio| number(ratio, 1));
    table.row([name.to_owned(), threads.to_string(), best, median, worst, ratio]);
}
