//! All figures of a drive, from the field it makes: `cargo bench -p unripple --bench field`.

mod common;

use common::machine::{introduce, load, product_rate, threads};
use common::table::{Table, number};
use common::times::Times;
use common::{Outcome, modal, surface};
use std::hint::black_box;
use unripple::core::{Point, Responses};
use unripple::field::{Aim, Field, MeasureOptions, measure};
use unripple::focus::{Options, Target, focus};
use unripple_linalg::Par;

fn main() -> Outcome {
    let modal = modal(&surface())?;
    let modes = modal.poles.len();
    let responses = Responses::Modal(modal);
    let at = Point::from_mm(62.0, 90.0);
    let focused = focus(&responses, &[Target::at(at)], &Options::default())?;
    let options = MeasureOptions::default();
    let points = Field::new(&responses, &focused.drive, options.cells)?.points().len();
    // Velocity and displacement, samples 0 to 2n.
    let samples = 2 * (focused.drive.samples() - 1) + 1;
    introduce(
        &format!("field: all figures of hudin-2012, {points} points x {modes} modes x {samples} samples"),
        threads(),
    );

    let aims = [Aim::at(at, Options::default().window)];
    measure(&responses, &focused.drive, &aims, &options)?;
    let times = Times::of(15, |_| {
        black_box(measure(&responses, &focused.drive, &aims, &options).is_ok());
    });
    let flops = 2.0 * 2.0 * points as f64 * modes as f64 * samples as f64;
    let rate = product_rate([4096, 306, 4096], Par::rayon(0), 1.0_f32);
    let mut table =
        Table::new(["", "runs", "best ms", "median ms", "worst ms", "Gflop/s", "of the f32 product"]);
    table.row([
        "measure".into(),
        times.count().to_string(),
        number(times.best() * 1e3, 1),
        number(times.median() * 1e3, 1),
        number(times.worst() * 1e3, 1),
        number(flops / times.median() / 1e9, 1),
        format!("{:.0} %", flops / times.median() / rate * 100.0),
    ]);
    table.print();
    println!(
        "  limit: {:.1} Gflop for velocity and displacement everywhere, {:.1} ms at the f32 product's {:.1} Gflop/s",
        flops / 1e9,
        flops / rate * 1e3,
        rate / 1e9
    );
    println!("  load after {}", load());
    Ok(())
}
