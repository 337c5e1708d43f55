//! How long a library of 10 000 points x 8 actuators x 1440 samples takes to write, to open and to read from.
//!
//! `cargo bench -p unripple-store --bench library [-- FOLDER [POINTS]]`; 461 MB are written to FOLDER, by default to one
//! beside the program, and removed again.

use std::path::{Path, PathBuf};
use std::time::Instant;
use unripple_core::{Conditions, Outline, Point, Port, Shape};
use unripple_store::{Library, LibraryPlan, PointState, Quality, StoreError, Take};

const PORTS: usize = 8;
const SAMPLES: usize = 1440;
/// Points written at once.
const BATCH: usize = 256;
const OPENED: usize = 50;
const READ: usize = 2000;

fn main() -> Result<(), StoreError> {
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    let folder = arguments.next().map_or_else(beside_program, PathBuf::from).join("unripple-bench-library");
    let points = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(10_000);
    let plan = plan(points);
    write(&folder, &plan)?;
    let mut times = Vec::new();
    for _ in 0..OPENED {
        let start = Instant::now();
        assert_eq!(Library::open(&folder)?.done().len(), points);
        times.push(start.elapsed().as_secs_f64());
    }
    told("open", &mut times);
    let library = Library::open(&folder)?;
    let mut times = Vec::new();
    for i in 0..READ {
        let start = Instant::now();
        let values = library.get(i * 7919 % points)?;
        times.push(start.elapsed().as_secs_f64());
        assert_eq!(values.len(), PORTS * SAMPLES);
    }
    told("read one point", &mut times);
    let start = Instant::now();
    let all = library.responses()?;
    println!("read all {} points: {:.2} s", all.points.len(), start.elapsed().as_secs_f64());
    drop(all);
    let start = Instant::now();
    assert!(library.verify().is_empty());
    println!("verify: {:.2} s", start.elapsed().as_secs_f64());
    println!("size: {:.1} MB in files", size(&folder) as f64 / 1e6);
    let _ = std::fs::remove_dir_all(&folder);
    Ok(())
}

fn beside_program() -> PathBuf {
    let program = std::env::current_exe().unwrap_or_default();
    program.parent().map_or_else(std::env::temp_dir, Path::to_path_buf)
}

fn plan(points: usize) -> LibraryPlan {
    let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
    let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.6e-3, outline };
    let port = |i: usize| Port { name: format!("a{i}"), at: Point::from_mm(10.0 * i as f64, 31.0) };
    let places = (0..points).map(|i| Point::from_mm((i % 100) as f64 * 1.5, (i / 100) as f64 * 1.5));
    LibraryPlan::new((0..PORTS).map(port).collect(), places.collect(), conditions, SAMPLES)
}

fn write(folder: &Path, plan: &LibraryPlan) -> Result<(), StoreError> {
    let start = Instant::now();
    let mut library = Library::create(folder, plan)?;
    println!("create: {:.3} s", start.elapsed().as_secs_f64());
    let quality = [Quality::UNKNOWN; PORTS];
    let values =
        |point: usize| -> Vec<f32> { (0..PORTS * SAMPLES).map(|i| ((i + point) as f32).sin()).collect() };
    let mut times = Vec::new();
    for point in 0..50.min(plan.points.len()) {
        let samples = values(point);
        let start = Instant::now();
        library.put(point, &samples, &quality)?;
        times.push(start.elapsed().as_secs_f64());
    }
    told("put one point", &mut times);
    let rest = library.in_state(PointState::Missing);
    let mut spent = 0.0;
    for batch in rest.chunks(BATCH) {
        let samples: Vec<Vec<f32>> = batch.iter().map(|point| values(*point)).collect();
        let pairs = batch.iter().zip(&samples);
        let takes: Vec<Take<'_>> = pairs
            .map(|(point, samples)| Take {
                point: *point,
                samples,
                quality: &quality,
                bands: &[],
                state: PointState::Measured,
            })
            .collect();
        let start = Instant::now();
        library.put_all(&takes)?;
        spent += start.elapsed().as_secs_f64();
    }
    println!("put {} points, {BATCH} at once: {spent:.2} s", rest.len());
    Ok(())
}

fn told(what: &str, times: &mut [f64]) {
    times.sort_by(f64::total_cmp);
    let ms = |i: usize| times.get(i).map_or(0.0, |t| t * 1e3);
    println!(
        "{what}: median {:.3} ms, worst {:.3} ms of {}",
        ms(times.len() / 2),
        ms(times.len() - 1),
        times.len()
    );
}

fn size(folder: &Path) -> u64 {
    let items = std::fs::read_dir(folder).into_iter().flatten().flatten();
    items
        .map(|item| match item.metadata() {
            Ok(metadata) if metadata.is_dir() => size(&item.path()),
            Ok(metadata) => metadata.len(),
            Err(_) => 0,
        })
        .sum()
}
