//! How many points are needed: contrast against the pitch of the grid that was measured, in shortest wavelengths, printed
//! and drawn: `cargo run --release -p unripple-calibrate --example pitch -- pitch.svg` (or `.png`).

#[path = "../tests/between_bench/mod.rs"]
mod between_bench;

use between_bench::*;
use unripple_calibrate::{Between, Interpolation};
use unripple_core::{Point, Responses};
use unripple_focus::Method;
use unripple_physics::sample;
use unripple_plot::{Along, Axis, Dash, Figure, Ink, Line, PRINT_DPI, Plot, Rule};

type Failure = Box<dyn std::error::Error>;

const METHODS: [Method; 2] = [Method::TimeReversal, Method::Concentrate];
const PER_WAVELENGTH: [f64; 7] = [1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 4.0];
const SAMPLES: usize = 2401;

fn main() -> Result<(), Failure> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "pitch.svg".to_owned());
    let truth = Truth::papers();
    let places = targets(8, 5);
    let ideals = METHODS.map(|method| mean(&truth.contrasts(&truth.whole, method, &places)));
    println!("true responses: time reversal {:.1}, concentration {:.1}", ideals[0], ideals[1]);
    let all: Vec<Point> = places.iter().copied().chain(grid(truth.lambda() / 2.0)).collect();
    let controls = Responses::Sampled(sample(&truth.modal, &all, SAMPLES));
    let control = mean(&truth.contrasts(&controls, METHODS[1], &places)) / ideals[1];
    println!("true responses on the control grid alone: concentration {control:.3} of that");
    println!("{:>12} {:>7} {:>9} {:>14} {:>12}", "pitch", "points", "way", METHODS[0], METHODS[1]);
    let mut pitches = Vec::new();
    let mut shares: [[Vec<f64>; 2]; 3] = Default::default();
    for per in PER_WAVELENGTH {
        let points = grid(truth.lambda() / per);
        let pitch = 0.15 / (points.len() as f64).sqrt() / truth.lambda();
        pitches.push(pitch);
        let measured = truth.measured(&points, SAMPLES, USUAL, 11);
        for (way, shares) in Interpolation::ALL.into_iter().zip(&mut shares) {
            let between = Between::plan(&measured, told(), &options(way, USUAL))?;
            let known: Responses = onto(&between, &places, truth.lambda() / 2.0);
            for ((method, ideal), shares) in METHODS.into_iter().zip(ideals).zip(shares.iter_mut()) {
                shares.push(mean(&truth.contrasts(&known, method, &places)) / ideal);
            }
            let last = [0, 1].map(|method: usize| shares[method].last().copied().unwrap_or(f64::NAN));
            println!(
                "{:>9.3} λ {:>9} {:>9} {:>14.3} {:>12.3}",
                pitch,
                points.len(),
                way.name(),
                last[0],
                last[1]
            );
        }
    }
    let drawing = figure(&pitches, &shares).draw()?;
    if path.ends_with(".png") {
        std::fs::write(&path, drawing.png(PRINT_DPI)?)?;
    } else {
        std::fs::write(&path, drawing.svg())?;
    }
    Ok(())
}

fn figure(pitches: &[f64], shares: &[[Vec<f64>; 2]; 3]) -> Figure {
    let half = Rule {
        at: 0.5,
        along: Along::Y,
        label: "half a wavelength".into(),
        dash: Dash::Dotted,
        ..Rule::default()
    };
    let mut layers = vec![half.into()];
    for (index, (way, shares)) in Interpolation::ALL.iter().zip(shares).enumerate() {
        for (method, share) in METHODS.iter().zip(shares) {
            let dash = if *method == Method::TimeReversal { Dash::Solid } else { Dash::Dashed };
            let line = Line {
                x: pitches.to_vec(),
                y: share.clone(),
                label: format!("{}, {method}", way.name()),
                ink: Ink::Palette(index),
                dash,
                ..Line::default()
            };
            layers.push(line.into());
        }
    }
    Figure::of(Plot {
        x: Axis::new("Pitch of the points (shortest wavelengths)"),
        y: Axis::new("Contrast over that of true responses"),
        layers,
        ..Plot::default()
    })
}
