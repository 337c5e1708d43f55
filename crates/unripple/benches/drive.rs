//! A drive for one new point, beside numpy: `cargo bench -p unripple --bench drive`.

mod common;

use common::machine::{introduce, load, product_rate};
use common::table::{Table, none, number};
use common::times::Times;
use common::{Fault, Outcome, modal, peers, place, surface};
use std::hint::black_box;
use unripple::core::{ModalResponses, Point, Responses, Surface};
use unripple::dsp::ModalSynth;
use unripple::focus::{Focuser, Options, Target};
use unripple_linalg::{Mat, Par};

/// Points, all different.
const POINTS: usize = 4000;

/// Samples of a response: 30 ms at 48 kHz, both ends.
const SAMPLES: usize = 1441;

/// Decay time of the membrane, in seconds.
const DECAY: f64 = 0.07;

fn main() -> Outcome {
    // One core: products and rayon see a pool of one thread.
    rayon::ThreadPoolBuilder::new().num_threads(1).build()?.install(run)
}

fn run() -> Outcome {
    let surface = surface();
    let modal = modal(&surface)?;
    let modes = modal.poles.len();
    introduce(&format!("drive: one new point, {modes} modes, 8 actuators, 30 ms at 48 kHz"), 1);
    let responses = Responses::Modal(modal.clone());
    let focuser = Focuser::new(&responses, &Options::default())?;
    let target = |i: usize| [Target::at(place(i))];
    let whole = Times::of(POINTS, |i| {
        black_box(focuser.focus(black_box(&target(i))).is_ok());
    });
    let ours = focuser.focus(&[Target::at(Point::from_mm(62.0, 90.0))])?;
    let peer = peer(&surface);

    let base = whole.median();
    let mut table = Table::new([
        "",
        "points",
        "best µs",
        "median µs",
        "p99 µs",
        "worst µs",
        "of the first",
        "drive differs by",
    ]);
    let mut row = |name: &str, times: &Times, differs: String| {
        table.row([
            name.into(),
            times.count().to_string(),
            number(times.best() * 1e6, 1),
            number(times.median() * 1e6, 1),
            number(times.quantile(0.99) * 1e6, 1),
            number(times.worst() * 1e6, 1),
            format!("{:.2} x", times.median() / base),
            differs,
        ]);
    };
    row("unripple, whole", &whole, none());
    for (name, times) in parts(&modal)? {
        row(name, &times, none());
    }
    if let Ok((times, drive)) = &peer {
        let channel = &ours.drive.channels()[0];
        row("numpy, whole", times, format!("{:.1e}", difference(channel, drive)));
    }
    table.print();
    if let Err(reason) = peer {
        println!("  numpy skipped: {reason}");
    }
    limit(&modal, base);
    println!("  load after {}", load());
    Ok(())
}

/// The two large steps by themselves.
fn parts(modal: &ModalResponses) -> Result<[(&'static str, Times); 2], Fault> {
    let mut row = vec![0.0; modal.poles.len()];
    let shapes = Times::of(POINTS, |i| modal.shapes.at(black_box(place(i)), black_box(&mut row)));
    let weights = Mat::from_fn(8, row.len(), |a, m| (modal.input[(a, m)] * row[m]) as f32);
    let synth = synth(modal);
    let mut out = vec![0.0_f32; 8 * SAMPLES];
    synth.respond_f32(weights.as_ref(), &mut out)?;
    let responses = Times::of(POINTS, |_| {
        black_box(synth.respond_f32(black_box(weights.as_ref()), black_box(&mut out)).is_ok());
    });
    Ok([("  mode shapes", shapes), ("  responses", responses)])
}

fn synth(modal: &ModalResponses) -> ModalSynth {
    ModalSynth::new(&modal.poles, modal.conditions.rate, SAMPLES, Options::default().accuracy)
}

/// Times and the first channel by numpy.
fn peer(surface: &Surface) -> Result<(Times, Vec<f64>), String> {
    let Surface { emission, actuators, .. } = surface;
    let head = [POINTS as f64, emission.band[1], SAMPLES as f64, emission.rate, DECAY];
    let places = actuators.iter().flat_map(|actuator| [actuator.at.x, actuator.at.y]);
    let arguments: Vec<String> = head.into_iter().chain(places).map(|x| x.to_string()).collect();
    let answer = peers::run("drive_numpy.py", &arguments, 1)?;
    let times = Times::from(peers::numbers(&answer, "seconds")?.to_vec());
    Ok((times, peers::numbers(&answer, "drive")?.to_vec()))
}

/// Rms of the difference, relative to the rms of the first.
fn difference(first: &[f64], second: &[f64]) -> f64 {
    if first.len() != second.len() {
        return f64::NAN;
    }
    let square = |x: f64| x * x;
    let apart: f64 = first.iter().zip(second).map(|(a, b)| square(a - b)).sum();
    (apart / first.iter().map(|a| square(*a)).sum::<f64>()).sqrt()
}

/// What the arithmetic takes at the rate of matrix products of the same shapes.
fn limit(modal: &ModalResponses, median: f64) {
    let modes = modal.poles.len() as f64;
    let synth = synth(modal);
    let (direct, needed) = (8.0 * 2.0 * modes * SAMPLES as f64, 8.0 * synth.operations() as f64);
    // Each of four symmetry classes sums at least as many products of functions as it has modes.
    let shapes = 2.0 * modes * modes / 4.0;
    let single = product_rate([512, 306, SAMPLES], Par::Seq, 1.0_f32);
    let double = product_rate([512, 306, SAMPLES], Par::Seq, 1.0_f64);
    let least = needed / single + shapes / double;
    println!(
        "  limit: responses {:.2} Mflop, at 1/{} of the rate (direct {:.2}), {:.0} Gflop/s in f32; shapes at least \
         {:.3} Mflop, {:.0} Gflop/s in f64: {:.0} µs, {:.0} % of the median",
        needed / 1e6,
        synth.step(),
        direct / 1e6,
        single / 1e9,
        shapes / 1e6,
        double / 1e9,
        least * 1e6,
        least / median * 100.0
    );
    println!(
        "  bytes: {:.0} kB of responses in f32, {:.0} kB of drive in f64, at least {:.0} kB of shape coefficients",
        8.0 * SAMPLES as f64 * 4e-3,
        8.0 * SAMPLES as f64 * 8e-3,
        modes * modes / 4.0 * 8e-3
    );
}
