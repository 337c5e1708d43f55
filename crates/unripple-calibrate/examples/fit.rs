//! A model fitted to a surface that is not the model: `cargo run --release -p unripple-calibrate --example fit`.

#[path = "../tests/fit_truth/mod.rs"]
mod truth;

use std::time::Instant;
use truth::*;
use unripple_calibrate::{FitOptions, Fitted, fit};
use unripple_core::Point;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let top = std::env::args().nth(1).map_or(Ok(3000.0), |t| t.parse())?;
    let case = std::env::args().nth(2).unwrap_or_default();
    let mut faults = Faults::default();
    if case.contains('e') {
        faults.uneven = 0.0;
    }
    if case.contains('m') {
        faults.masses.clear();
    }
    let begun = Instant::now();
    let mut truth = Truth::new(&faults, top);
    println!("truth: {:.1?}", begun.elapsed());
    let places: Vec<Point> = targets(8);
    for (name, measured) in [("pairs", truth.pairs(0.25)), ("taps", truth.taps(&places, 0.25))] {
        if !case.contains(&name[..1]) {
            continue;
        }
        let begun = Instant::now();
        let fitted = fit(&truth.nominal, &measured, &FitOptions::default())?;
        println!("{name}: fitted in {:.1?}", begun.elapsed());
        report(&truth, &fitted);
    }
    Ok(())
}

fn report(truth: &Truth, fitted: &Fitted) {
    println!("  tension {:.3?}, bending {:?}", fitted.tension, fitted.bending_stiffness);
    println!("  excess {:.2}, residual {:.4}, {:?}", fitted.excess, fitted.residual, fitted.verdict);
    for (hz, time) in &fitted.decay {
        println!("  decay at {hz:.0} Hz: {:.1} ms ± {:.1}", 1e3 * time.value, 1e3 * time.error);
    }
    for (actuator, fitted) in truth.surface.actuators.iter().zip(&fitted.actuators) {
        let [x, y] = fitted.at;
        let off = Point::new(x.value, y.value).distance(actuator.at);
        println!(
            "  {}: off by {:.3} mm ± {:.3}, mass {:.2} mg ± {:.2}, drive {:.4}",
            actuator.name,
            1e3 * off,
            1e3 * x.error.hypot(y.error),
            1e6 * fitted.mass.value,
            1e6 * fitted.mass.error,
            fitted.drive.value,
        );
    }
    for stray in &fitted.strays {
        let [x, y] = stray.at.map(|c| 1e3 * c.value);
        println!(
            "  stray at {x:.2}, {y:.2} mm: {:.2} mg ± {:.2}",
            1e6 * stray.mass.value,
            1e6 * stray.mass.error
        );
    }
    println!(
        "  time reversal, inverse: {:.3?} of the true",
        truth.shares(&fitted.responses(), &targets(16)[8..])
    );
}
