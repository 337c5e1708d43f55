//! A library of responses beside the matrix product it stands for: `cargo bench -p unripple --bench library`.

mod common;

use common::machine::{introduce, load, product_rate, threads};
use common::table::{Table, none, number};
use common::times::Times;
use common::{Outcome, modal, peers, place, surface};
use std::hint::black_box;
use unripple::core::Point;
use unripple::dsp::ModalSynth;
use unripple::physics::sample;
use unripple_linalg::Par;

/// Points of the library.
const POINTS: usize = 10_000;

/// Samples of a response: 30 ms at 48 kHz, both ends.
const SAMPLES: usize = 1441;

/// Accuracy that the samples of a library have before they are rounded.
const ACCURACY: f64 = 1e-6;

fn main() -> Outcome {
    let modal = modal(&surface())?;
    let (modes, ports) = (modal.poles.len(), modal.ports.len());
    introduce(
        &format!("library: {POINTS} points x {ports} actuators x {SAMPLES} samples, {modes} modes"),
        threads(),
    );
    let rows = POINTS * ports;
    let shape = [rows, modes, SAMPLES];
    let flops = 2.0 * (rows * modes * SAMPLES) as f64;
    let bytes = (rows * SAMPLES * 4) as f64;
    let peak = product_rate([2048, 2048, 2048], Par::rayon(0), 1.0_f32);
    let same = product_rate(shape, Par::rayon(0), 1.0_f32);

    let points: Vec<Point> = (0..POINTS).map(place).collect();
    let times = Times::of(10, |_| {
        black_box(sample(&modal, &points, SAMPLES));
    });
    let mut table =
        Table::new(["", "best s", "median s", "worst s", "Gflop/s", "of the product", "GB/s written"]);
    let equivalent = flops / times.median();
    table.row([
        "unripple, equivalent".into(),
        number(times.best(), 3),
        number(times.median(), 3),
        number(times.worst(), 3),
        number(equivalent / 1e9, 1),
        format!("{:.0} %", equivalent / same * 100.0),
        number(bytes / times.median() / 1e9, 2),
    ]);
    let mut rate = |name: &str, rate: f64, seconds: String| {
        let share = format!("{:.0} %", rate / same * 100.0);
        table.row([name.into(), seconds, none(), none(), number(rate / 1e9, 1), share, none()]);
    };
    rate(&format!("f32 product {rows} x {modes} x {SAMPLES}"), same, number(flops / same, 3));
    rate("f32 product 2048 x 2048 x 2048", peak, none());
    let arguments = shape.map(|size| size.to_string());
    match peers::run("product_numpy.py", &arguments, threads())
        .and_then(|a| Ok(peers::numbers(&a, "rate")?[0]))
    {
        Ok(found) => rate("numpy, f32 product of the same shape", found, number(flops / found, 3)),
        Err(reason) => println!("  numpy skipped: {reason}"),
    }
    table.print();
    let synth = ModalSynth::new(&modal.poles, modal.conditions.rate, SAMPLES, ACCURACY);
    let needed = (rows * synth.operations()) as f64;
    println!(
        "  limit: {:.1} Gflop at 1/{} of the rate instead of {:.1}, {:.3} s at the product's rate: {:.0} % of the \
         median; {:.0} MB written",
        needed / 1e9,
        synth.step(),
        flops / 1e9,
        needed / same,
        needed / same / times.median() * 100.0,
        bytes / 1e6
    );
    println!("  load after {}", load());
    Ok(())
}
