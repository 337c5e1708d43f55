//! Pages of PDF, read by other people's renderer: they show what the PNG shows.

use crate::python::python;
use crate::skip::skip;
use std::process::Command;
use unripple_plot::{Axis, Band, Colours, Dash, Figure, Grid, Line, Map, Plot, Points, Trace, Traces};

const DPI: f64 = 150.0;

/// Largest mean difference between both pictures, of 255 levels: what two ways to smooth edges make. A panel that is missing, or upside
/// down, makes five and more.
const NEAR: f64 = 1.5;

/// Every kind of element that figures are drawn with: lines of all patterns, marks, bands, text, images with holes, gradients, clips.
fn figure() -> Figure {
    let x: Vec<f64> = (0..200).map(|i| f64::from(i) * 1e-4).collect();
    let wave = |phase: f64| x.iter().map(|t| (600.0 * t + phase).sin()).collect::<Vec<f64>>();
    let line = |label: &str, phase: f64, dash: Dash| Line {
        x: x.clone(),
        y: wave(phase),
        label: label.into(),
        dash,
        ..Line::default()
    };
    let band =
        Band { x: x.clone(), low: wave(0.0), high: wave(0.6), label: "range".into(), ..Band::default() };
    let points = Points {
        x: vec![0.004, 0.012],
        y: vec![0.2, -0.4],
        error: vec![[0.1, 0.3]; 2],
        label: "found".into(),
        ..Points::default()
    };
    let plot = Plot {
        x: Axis::new("Time (ms)").times(1e3),
        y: Axis::new("Velocity (µm/s)"),
        layers: vec![
            band.into(),
            line("a", 0.0, Dash::Solid).into(),
            line("b", 1.0, Dash::Dashed).into(),
            points.into(),
        ],
        title: "Two waves".into(),
        ..Plot::default()
    };
    let traces = Traces {
        step: 1e-4,
        traces: vec![Trace::new("a1", wave(0.3)), Trace::new("a2", wave(2.0))],
        unit: "N".into(),
        ..Traces::default()
    };
    let mut grid = Grid { columns: 40, rows: 30, first: [1e-3; 2], pitch: [2e-3; 2], ..Grid::default() };
    grid.values = (0..1200)
        .map(|i| {
            let [x, y] = grid.centre(i % 40, i / 40);
            if (x - 0.05).hypot(y - 0.02) < 0.01 { f64::NAN } else { (200.0 * x).sin() + 20.0 * y }
        })
        .collect();
    let outline = vec![vec![[0.0, 0.0], [0.08, 0.0], [0.08, 0.045], [0.06, 0.06], [0.0, 0.06]]];
    let map = Map {
        grid,
        outline,
        colours: Colours { title: "Displacement (µm)".into(), ..Colours::default() },
        ..Map::default()
    };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![plot.into(), traces.into(), map.into()],
        ..Figure::default()
    }
}

#[test]
fn pages_are_the_same_each_time_and_of_the_figures_size() {
    let drawing = figure().draw().unwrap();
    let (page, again) = (drawing.pdf().unwrap(), figure().draw().unwrap().pdf().unwrap());
    assert!(page == again && page.starts_with(b"%PDF-1.7"));
    let [width, height] = drawing.size_pt();
    let text = String::from_utf8_lossy(&page);
    let sizes = text.split("/MediaBox [").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    let sizes: Vec<f64> = sizes.split_whitespace().map(|n| n.parse().unwrap()).collect();
    assert!((sizes[2] - width).abs() < 0.01 && (sizes[3] - height).abs() < 0.01, "{sizes:?}");
}

#[test]
fn another_renderer_shows_what_the_png_shows() {
    let python = match python("peers-pdf", "pymupdf", &["pymupdf>=1.24,<2"]) {
        Ok(python) => python,
        Err(why) => return skip(&format!("pages of PDF in another renderer: {why}")),
    };
    let folder = std::env::temp_dir().join(format!("unripple-pdf-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let drawing = figure().draw().unwrap();
    std::fs::write(folder.join("figure.pdf"), drawing.pdf().unwrap()).unwrap();
    std::fs::write(folder.join("figure.png"), drawing.png(DPI).unwrap()).unwrap();
    let compare = "import sys, pymupdf
page = pymupdf.open(sys.argv[1])[0].get_pixmap(dpi=int(sys.argv[3]), alpha=False)
ours = pymupdf.Pixmap(sys.argv[2])
assert abs(page.width - ours.width) < 2 and abs(page.height - ours.height) < 2, (page, ours)
w, h = min(page.width, ours.width), min(page.height, ours.height)
a, b = page.samples, ours.samples
ink = sum(255 - a[i] for i in range(0, len(a), 97)) / len(range(0, len(a), 97))
total = sum(abs(a[y * page.stride + i] - b[y * ours.stride + i]) for y in range(h) for i in range(0, 3 * w, 5))
print(total / (h * len(range(0, 3 * w, 5))), ink)";
    let [pdf, png] = ["figure.pdf", "figure.png"].map(|name| folder.join(name));
    let found =
        Command::new(python).args(["-c", compare]).args([&pdf, &png]).arg(DPI.to_string()).output().unwrap();
    let errors = String::from_utf8_lossy(&found.stderr);
    assert!(found.status.success(), "{errors}");
    let numbers: Vec<f64> =
        String::from_utf8_lossy(&found.stdout).split_whitespace().map(|n| n.parse().unwrap()).collect();
    let [difference, ink] = numbers[..] else { panic!("{numbers:?}") };
    assert!(difference < NEAR && ink > 10.0, "mean difference {difference}, mean darkness {ink}");
    std::fs::remove_dir_all(folder).unwrap();
}
