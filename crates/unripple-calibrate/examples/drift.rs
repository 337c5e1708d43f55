//! A focus held while the tension drifts: `cargo run --release -p unripple-calibrate --example drift -- DIR [SECONDS]`.

#[path = "../tests/drift_bench/mod.rs"]
mod drift_bench;

use drift_bench::*;
use std::time::Instant;
use unripple_focus::Method;
use unripple_plot::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let seconds = std::env::args().nth(2).map_or(Ok(60.0), |s| s.parse())?;
    let bench = Bench::new(30.0);
    let cases = [
        (Against::Dispersion, "through the dispersion relation"),
        (Against::Stretch, "a uniform stretch"),
        (Against::Nothing, "nothing"),
    ];
    let mut panels = Vec::new();
    for (method, name) in [(Method::TimeReversal, "time reversal"), (Method::Inverse, "inverse")] {
        let still = bench.silent_run(method).0;
        let known = bench.run(method, Against::Knowledge, 0.0, seconds);
        summary(&format!("{name}, tension known"), &known[1..], &known[1..], &still);
        let mut layers: Vec<Layer> = Vec::new();
        for (n, (against, label)) in cases.into_iter().enumerate() {
            let begun = Instant::now();
            let rows = bench.run(method, against, 0.0, seconds);
            summary(&format!("{name}, {label}"), &rows[1..], &known[1..], &still);
            println!("  in {:.1?}", begun.elapsed());
            let x = rows.iter().map(|row| row.time).collect();
            let y = rows.iter().map(|row| row.contrast / still.contrast).collect();
            let dash = [Dash::Solid, Dash::Dashed, Dash::Dotted][n];
            layers.push(Line { x, y, dash, label: label.into(), ..Line::default() }.into());
        }
        panels.push(Plot {
            title: format!("Contrast held by {name}"),
            x: Axis::new("Time (s)"),
            y: Axis::new("Contrast over undrifted"),
            layers,
            ..Plot::default()
        });
    }
    for (plot, name) in panels.into_iter().zip(["reversal", "inverse"]) {
        let drawing = Figure::of(plot).draw()?;
        std::fs::write(format!("{folder}/drift-{name}.svg"), drawing.svg())?;
        std::fs::write(format!("{folder}/drift-{name}.png"), &pngs(&[drawing], PRINT_DPI)?[0])?;
    }
    Ok(())
}

fn summary(name: &str, rows: &[Row], known: &[Row], still: &Row) {
    let least = |f: &dyn Fn(&Row) -> f64| rows.iter().map(f).fold(f64::INFINITY, f64::min);
    let most = |f: &dyn Fn(&Row) -> f64| rows.iter().map(f).fold(0.0, f64::max);
    let beside = |f: &dyn Fn(&Row) -> f64| {
        rows.iter().zip(known).map(|(row, known)| f(row) / f(known)).fold(f64::INFINITY, f64::min)
    };
    println!(
        "{name}: tension off by at most {:.1e} (said {:.1e}), peak at least {:.4}, contrast at least {:.4}; of those with the tension known {:.4} and {:.4}; unexplained {}",
        most(&|r| (r.known - r.tension).abs()),
        most(&|r| r.error),
        least(&|r| r.peak / still.peak),
        least(&|r| r.contrast / still.contrast),
        beside(&|r| r.peak),
        beside(&|r| r.contrast),
        rows.iter().filter(|r| !r.explained).count(),
    );
}
