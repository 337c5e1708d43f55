//! A focus held while the tension drifts: `cargo run --release -p unripple-calibrate --example drift -- DIR [SECONDS [model|truth]]`.
//!
//! On a surface that is its model, and on a true one that is known by a fit from its actuators alone.

#[path = "../tests/drift_bench/mod.rs"]
mod drift_bench;

use drift_bench::*;
use std::time::Instant;
use unripple_focus::Method;
use unripple_plot::*;

const CASES: [(Against, &str); 3] = [
    (Against::Dispersion, "through the dispersion relation"),
    (Against::Stretch, "a uniform stretch"),
    (Against::Nothing, "nothing"),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let seconds = std::env::args().nth(2).map_or(Ok(60.0), |s| s.parse())?;
    std::fs::create_dir_all(&folder)?;
    let which = std::env::args().nth(3).unwrap_or_default();
    if which != "truth" {
        println!("The surface is the model:");
        follow(&Bench::new(30.0), seconds, &folder, "drift")?;
    }
    if which != "model" {
        let begun = Instant::now();
        let (bench, fitted) = Bench::truth(3000.0, 30.0);
        println!("A true surface, fitted from its actuators alone ({:.1?}):", begun.elapsed());
        println!(
            "{:?}, excess {:.2}, unexplained {:.2} %",
            fitted.verdict,
            fitted.excess,
            100.0 * fitted.unexplained()
        );
        follow(&bench, seconds, &folder, "drift-true")?;
    }
    Ok(())
}

fn follow(bench: &Bench, seconds: f64, folder: &str, file: &str) -> Result<(), Box<dyn std::error::Error>> {
    let ping = bench.ping();
    let rows = bench.run(Sent::Ping, Against::Dispersion, 0.0, seconds);
    let off = |row: &Row| (row.known - row.tension).abs();
    println!(
        "pings of {:.3}, felt {:.1} dB over threshold at most: tension off by {:.1e} rms, {:.1e} at most (said {:.1e})",
        ping.peak,
        ping.felt_db,
        rms(settled(&rows), off),
        settled(&rows).iter().map(off).fold(0.0, f64::max),
        settled(&rows).iter().map(|r| r.error).fold(0.0, f64::max),
    );
    for (method, name) in [(Method::TimeReversal, "reversal"), (Method::Inverse, "inverse")] {
        let still = bench.silent_run(method).0;
        let mut layers: Vec<Layer> = Vec::new();
        for (n, (against, label)) in CASES.into_iter().enumerate() {
            let begun = Instant::now();
            // The others fail long before the drift is greatest, after a quarter of a minute.
            let seconds = if against == Against::Dispersion { seconds } else { seconds.min(16.0) };
            let rows = bench.run(Sent::Focus(method), against, 0.0, seconds);
            summary(&format!("{method}, {label}, {seconds} s"), &rows, &still);
            println!("  in {:.1?}", begun.elapsed());
            let x = rows.iter().map(|row| row.time).collect();
            let y = rows.iter().map(|row| row.contrast / still.contrast).collect();
            let dash = [Dash::Solid, Dash::Dashed, Dash::Dotted][n];
            layers.push(Line { x, y, dash, label: label.into(), ..Line::default() }.into());
        }
        let drawing = Figure::of(Plot {
            title: format!("Contrast held by {method}"),
            x: Axis::new("Time (s)"),
            y: Axis::new("Contrast over undrifted"),
            layers,
            ..Plot::default()
        })
        .draw()?;
        std::fs::write(format!("{folder}/{file}-{name}.svg"), drawing.svg())?;
        std::fs::write(format!("{folder}/{file}-{name}.png"), &pngs(&[drawing], PRINT_DPI)?[0])?;
    }
    Ok(())
}

/// The first five foci find the drift.
fn settled(rows: &[Row]) -> &[Row] {
    &rows[rows.len().min(5)..]
}

fn rms(rows: &[Row], f: impl Fn(&Row) -> f64) -> f64 {
    (rows.iter().map(|row| f(row).powi(2)).sum::<f64>() / rows.len().max(1) as f64).sqrt()
}

fn summary(name: &str, rows: &[Row], still: &Row) {
    let rows = settled(rows);
    let least = |f: &dyn Fn(&Row) -> f64| rows.iter().map(f).fold(f64::INFINITY, f64::min);
    let most = |f: &dyn Fn(&Row) -> f64| rows.iter().map(f).fold(0.0, f64::max);
    println!(
        "{name}: tension off by {:.1e} rms, {:.1e} at most (said {:.1e}), peak at least {:.4}, contrast at least {:.4} of the undrifted; excess to {:.2}, unexplained {}",
        rms(rows, |r| r.known - r.tension),
        most(&|r| (r.known - r.tension).abs()),
        most(&|r| r.error),
        least(&|r| r.peak / still.peak),
        least(&|r| r.contrast / still.contrast),
        most(&|r| r.excess),
        rows.iter().filter(|r| !r.explained).count(),
    );
}
