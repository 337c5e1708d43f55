//! One figure of each kind, from synthetic data, written to a folder: `cargo run --release -p unripple-plot --example gallery -- DIR`.

use std::f64::consts::PI;
use std::path::Path;
use std::time::Instant;
use unripple_plot::*;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "gallery".to_owned());
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    let figures = [
        ("dispersion", dispersion()),
        ("contrast", contrast()),
        ("annotated", annotated()),
        ("drive", drive()),
        ("five-points", five_points()),
        ("velocity", velocity()),
        ("peak", peak()),
        ("scatter", scatter()),
        ("strip", strip()),
        ("grid", grid_of_four()),
        ("wide", wide()),
        ("cells", cells()),
    ];
    let begun = Instant::now();
    let drawings =
        figures.iter().map(|(_, figure)| figure.draw()).collect::<Result<Vec<Drawing>, PlotError>>()?;
    let drawn = begun.elapsed();
    let pictures = pngs(&drawings, PRINT_DPI)?;
    println!("{} figures: drawn in {drawn:.1?}, with pictures in {:.1?}", figures.len(), begun.elapsed());
    for (((name, _), drawing), picture) in figures.iter().zip(&drawings).zip(&pictures) {
        std::fs::write(folder.join(format!("{name}.svg")), drawing.svg())?;
        std::fs::write(folder.join(format!("{name}.png")), picture)?;
        println!("{name}: SVG {} KiB, PNG {} KiB", drawing.svg().len() / 1024, picture.len() / 1024);
    }
    let begun = Instant::now();
    let animation = movie().apng()?;
    println!("movie: {} KiB in {:.1?}", animation.len() / 1024, begun.elapsed());
    std::fs::write(folder.join("movie.png"), animation)?;
    Ok(())
}

fn span(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count - 1) as f64).collect()
}

fn over(x: &[f64], mut f: impl FnMut(f64) -> f64) -> Vec<f64> {
    x.iter().map(|x| f(*x)).collect()
}

/// Repeatable values between -1 and 1.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as f64 / u64::MAX as f64 * 2.0 - 1.0
    }
}

fn dispersion() -> Figure {
    let hz = span(0.0, 3000.0, 200);
    let phase = over(&hz, |f| 33.8 * (1.0 + 0.09 * (f / 1000.0).powi(2)).sqrt());
    let group = over(&hz, |f| 33.8 * (1.0 + 0.21 * (f / 1000.0).powi(2)).sqrt());
    Figure::of(Plot {
        x: Axis::new("Frequency (kHz)").times(1e-3),
        y: Axis::new("Celerity (m/s)"),
        layers: vec![
            Rule { at: 33.8, along: Along::X, label: "√(R/ρₛ)".into(), ..Rule::default() }.into(),
            Line { x: hz.clone(), y: phase, label: "phase".into(), ..Line::default() }.into(),
            Line { x: hz, y: group, label: "group".into(), ..Line::default() }.into(),
        ],
        ..Plot::default()
    })
}

fn contrast_plot() -> Plot {
    let window = span(0.0, 1.0, 60).iter().map(|t| 5e-3 * 30f64.powf(*t)).collect::<Vec<f64>>();
    let mut layers: Vec<Layer> = Vec::new();
    let mut noise = noise(7);
    for (i, actuators) in [1, 2, 4, 8, 16, 32].into_iter().enumerate() {
        let ink = Ink::Graded(i as f64 / 5.0);
        let law =
            |t: f64| (2.0 * f64::from(actuators) * 3000.0 * 0.07 / (1.0 / (t / 0.07).tanh() + 2.6)).sqrt();
        layers.push(
            Line {
                x: window.clone(),
                y: over(&window, law),
                ink,
                label: format!("N = {actuators}"),
                ..Line::default()
            }
            .into(),
        );
        let x = vec![5e-3, 10e-3, 20e-3, 40e-3, 80e-3, 150e-3];
        let y = over(&x, |t| law(t) * (1.0 + 0.06 * noise()));
        let error = y.iter().map(|y| [0.08 * y, 0.08 * y]).collect();
        layers
            .push(Points { x, y, error, ink, label: format!("N = {actuators}"), ..Points::default() }.into());
    }
    let root = over(&window, |t| 200.0 * t.sqrt());
    layers.push(
        Line {
            x: window,
            y: root,
            dash: Dash::Dotted,
            ink: Ink::Rgb(Rgb::GREY),
            label: "∝ √T".into(),
            width_pt: None,
        }
        .into(),
    );
    Plot { x: Axis::log("Window T (ms)").times(1e3), y: Axis::log("Contrast C"), layers, ..Plot::default() }
}

fn contrast() -> Figure {
    Figure::of(contrast_plot())
}

fn annotated() -> Figure {
    let t = span(-2e-3, 2e-3, 400);
    let pulse = over(&t, |t| (-(t / 4e-4).powi(2)).exp() * (2.0 * PI * 1500.0 * t).cos() * 4.2e-5);
    let gap: Vec<f64> =
        t.iter().zip(&pulse).map(|(t, v)| if (1e-3..1.2e-3).contains(t) { f64::NAN } else { *v }).collect();
    let low = over(&pulse, |v| v - 5e-6);
    let high = over(&pulse, |v| v + 5e-6);
    Figure::of(Plot {
        x: Axis::new("Time from focus t − T (ms)").times(1e3),
        y: Axis::new("Displacement (µm)").times(1e6),
        layers: vec![
            Span { from: -2.2e-4, to: 2.2e-4, label: "pulse".into(), ..Span::default() }.into(),
            Band { x: t.clone(), low, high, label: "±1σ".into(), ink: Ink::Palette(0) }.into(),
            Rule { at: 0.0, label: "focus".into(), ..Rule::default() }.into(),
            Rule { at: 2.1e-5, along: Along::X, label: "half maximum".into(), ..Rule::default() }.into(),
            Line { x: t, y: gap, label: "λ = 15 mm".into(), ink: Ink::Palette(0), ..Line::default() }.into(),
            Note { at: [5.0e-4, -2.4e-5], text: "first trough".into(), ..Note::default() }.into(),
        ],
        title: "A focused pulse".into(),
        ..Plot::default()
    })
}

fn burst(seed: u64, count: usize, rate: f64) -> Vec<f64> {
    let mut noise = noise(seed);
    let tones: Vec<[f64; 3]> = (0..40).map(|_| [1500.0 + 1450.0 * noise(), PI * noise(), noise()]).collect();
    (0..count)
        .map(|i| {
            let t = i as f64 / rate;
            tones.iter().map(|[hz, phase, gain]| gain * (2.0 * PI * hz * t + phase).sin()).sum::<f64>() / 8.0
        })
        .collect()
}

fn drive() -> Figure {
    let traces = (0..8)
        .map(|i| {
            let values = burst(i + 3, 1441, 48e3);
            let values =
                values.iter().enumerate().map(|(k, v)| v * (k as f64 / 1440.0 - 1.0).exp()).collect();
            Trace::new(format!("a{}", i + 1), values)
        })
        .collect();
    Figure::of(Traces {
        x: Axis::new("Time (ms)").times(1e3),
        step: 1.0 / 48e3,
        traces,
        unit: "N".into(),
        ..Traces::default()
    })
}

fn five_traces() -> Traces {
    let traces = ["focus D", "focus E", "at (30, 40) mm", "at (75, 75) mm", "at (120, 25) mm"];
    let traces = traces
        .iter()
        .enumerate()
        .map(|(i, name)| {
            let mut values = burst(i as u64 + 40, 48_000, 48e3);
            values.iter_mut().for_each(|v| *v *= 0.003);
            let every = [9600, 24_000, 0, 0, 0][i];
            for k in (0..48_000).filter(|k| every > 0 && k % every > every - 40) {
                values[k] += 0.04 * (-((every as f64 - 20.0 - (k % every) as f64) / 6.0).powi(2)).exp();
            }
            Trace { ink: Ink::Palette(if i < 2 { 1 } else { 0 }), ..Trace::new(*name, values) }
        })
        .collect();
    Traces {
        x: Axis::new("Time (s)"),
        step: 1.0 / 48e3,
        traces,
        unit: "mm/s".into(),
        multiplier: 1e3,
        rules: vec![Rule { at: 0.3, label: "finger down".into(), ..Rule::default() }],
        ..Traces::default()
    }
}

fn five_points() -> Figure {
    Figure::of(five_traces())
}

fn square() -> Vec<Ring> {
    vec![vec![[0.0, 0.0], [0.15, 0.0], [0.15, 0.15], [0.0, 0.15]]]
}

fn disc() -> Vec<Ring> {
    vec![
        (0..180)
            .map(|i| (f64::from(i) * PI / 90.0).sin_cos())
            .map(|(s, c)| [0.07 + 0.07 * c, 0.07 + 0.07 * s])
            .collect(),
    ]
}

fn field(width: f64, count: usize, value: impl Fn(f64, f64) -> f64) -> Grid {
    let pitch = width / count as f64;
    let mut grid = Grid {
        columns: count,
        rows: count,
        first: [pitch / 2.0; 2],
        pitch: [pitch; 2],
        values: Vec::with_capacity(count * count),
    };
    for i in 0..count * count {
        let [x, y] = grid.centre(i % count, i / count);
        grid.values.push(value(x, y));
    }
    grid
}

/// A converging wave at a time from its focus, over weak noise.
fn wave(x: f64, y: f64, t: f64) -> f64 {
    let r = (x - 0.062).hypot(y - 0.09);
    let k = 2.0 * PI / 0.0175;
    let front = (r - 43.0 * t.abs()) / 0.009;
    let noise = (211.0 * x + 3.0).sin() * (173.0 * y).cos() * 0.06 + (391.0 * y - 120.0 * x).sin() * 0.05;
    let edge = (PI * x / 0.15).sin() * (PI * y / 0.15).sin();
    ((-front * front).exp() * (k * (r - 43.0 * t.abs())).cos() / (1.0 + 60.0 * r) + noise) * edge.powf(0.2)
}

fn markers() -> Vec<Marker> {
    let at = [(12, 31), (9, 84), (40, 140), (95, 137), (141, 106), (138, 44), (103, 11), (50, 9)];
    let actuators = at.iter().enumerate().map(|(i, (x, y))| Marker {
        at: [f64::from(*x) * 1e-3, f64::from(*y) * 1e-3],
        symbol: Symbol::Actuator,
        name: format!("a{}", i + 1),
    });
    let target = |symbol| Marker { at: [0.062, 0.09], symbol, name: String::new() };
    actuators.chain([target(Symbol::Circle(0.0194)), target(Symbol::Target)]).collect()
}

fn velocity_map() -> Map {
    Map {
        grid: field(0.15, 83, |x, y| 0.043 * wave(x, y, 0.0)),
        outline: square(),
        markers: markers(),
        colours: Colours { title: "Velocity (mm/s)".into(), multiplier: 1e3, ..Colours::default() },
        ..Map::default()
    }
}

fn velocity() -> Figure {
    Figure { description: "Velocity at the focal instant".into(), ..Figure::of(velocity_map()) }
}

fn peak_map() -> Map {
    let rim = |x: f64, y: f64| 1.0 - ((x - 0.07).powi(2) + (y - 0.07).powi(2)) / 0.0049;
    let level =
        |x: f64, y: f64| (0.2 + wave(x, y, 0.0).abs() + 0.05 * (500.0 * x).sin().abs()) * rim(x, y).sqrt();
    Map {
        grid: field(0.14, 77, |x, y| if rim(x, y) > 0.0 { 3.1e-5 * level(x, y) } else { f64::NAN }),
        outline: disc(),
        colours: Colours {
            title: "Peak displacement (µm)".into(),
            map: ColourMap::Sequential,
            multiplier: 1e6,
            ..Colours::default()
        },
        ..Map::default()
    }
}

fn peak() -> Figure {
    Figure::of(peak_map())
}

/// The same at the points of a coarse grid.
fn scatter() -> Figure {
    let place = |i: i32| 0.015 * f64::from(i + 1);
    let points: Vec<[f64; 2]> = (0..81).map(|i| [place(i % 9), place(i / 9)]).collect();
    let values = points.iter().map(|[x, y]| 0.043 * wave(*x, *y, 0.0).abs()).collect();
    let colours = Colours {
        title: "Peak velocity (mm/s)".into(),
        map: ColourMap::Sequential,
        multiplier: 1e3,
        ..Colours::default()
    };
    Figure::of(Scatter {
        points,
        values,
        outline: square(),
        markers: markers(),
        colours,
        ..Scatter::default()
    })
}

fn shots(instants: &[f64]) -> Vec<Shot> {
    let shot = |t: &f64| Shot {
        grid: field(0.15, 83, |x, y| 0.043 * wave(x, y, *t)),
        caption: format!("{:.2} ms", 1e3 * t).replace('-', "−"),
    };
    instants.iter().map(shot).collect()
}

fn wave_strip() -> Strip {
    Strip {
        shots: shots(&[-1.5e-3, -0.75e-3, 0.0, 0.75e-3, 1.5e-3]),
        outline: square(),
        markers: markers()
            .into_iter()
            .filter(|m| m.symbol == Symbol::Actuator)
            .map(|m| Marker { name: String::new(), ..m })
            .collect(),
        colours: Colours { title: "Velocity (mm/s)".into(), multiplier: 1e3, ..Colours::default() },
        ..Strip::default()
    }
}

fn strip() -> Figure {
    Figure { width_mm: 178.0, ..Figure::of(wave_strip()) }
}

fn grid_of_four() -> Figure {
    let hz = span(50.0, 10_000.0, 300);
    let reflect = over(&hz, |f| 1.0 / (1.0 + (f / 900.0 - 900.0 / f).powi(2) * 0.3));
    let transmit = over(&reflect, |r| 1.0 - r);
    let finger = Plot {
        x: Axis::log("Frequency (Hz)"),
        y: Axis::new("Share of power"),
        layers: vec![
            Line { x: hz.clone(), y: reflect, label: "reflected".into(), ..Line::default() }.into(),
            Line { x: hz, y: transmit, label: "absorbed".into(), ..Line::default() }.into(),
        ],
        ..Plot::default()
    };
    let x = span(0.0, 1.0, 30);
    let tiny = Plot {
        x: Axis::new("Share of a period"),
        y: Axis::new("Energy (J)"),
        layers: vec![Points { y: over(&x, |x| 3.3e-7 * (1.0 + x * x)), x, ..Points::default() }.into()],
        ..Plot::default()
    };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![contrast_plot().into(), finger.into(), tiny.into(), velocity_map().into()],
        ..Figure::default()
    }
}

fn wide() -> Figure {
    Figure { width_mm: 178.0, panels: vec![wave_strip().into(), five_traces().into()], ..Figure::default() }
}

fn movie() -> Movie {
    Movie {
        shots: shots(&span(-2e-3, 2e-3, 60)),
        outline: square(),
        markers: markers(),
        colours: Colours { title: "Velocity (mm/s)".into(), multiplier: 1e3, ..Colours::default() },
        ..Movie::default()
    }
}

/// Signal to noise of twenty points by thirds of an octave, one of them bad in a band.
fn cells() -> Figure {
    let mut noise = noise(5);
    let mut values: Vec<f64> = (0..20 * 12).map(|i| 30.0 + 0.8 * f64::from(i % 12) + 3.0 * noise()).collect();
    values[12 * 7 + 5] = 9.0;
    values[12 * 13..12 * 14].fill(f64::NAN);
    Figure::of(Cells {
        edges: (0..=12).map(|third| 178.0 * 2f64.powf(f64::from(third) / 3.0)).collect(),
        rows: (1..=20).map(|point| point.to_string()).collect(),
        values,
        x: Axis::log("Frequency (Hz)"),
        label: "Point".into(),
        colours: Colours {
            title: "Signal to noise (dB)".into(),
            map: ColourMap::Sequential,
            ..Colours::default()
        },
        ..Cells::default()
    })
}
