//! Libraries and folders that tests share.

#![allow(dead_code)]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use unripple_core::{Conditions, Outline, Point, Port, Shape};
use unripple_store::{Library, LibraryPlan, PointState, Quality, Take};

/// A place for a folder, gone with whatever came to be there.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = format!("unripple-library-{name}-{}-{count}", std::process::id());
        let path = std::env::temp_dir().join(folder);
        assert!(!path.exists(), "{} is somebody else's", path.display());
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

pub fn plan(points: usize, ports: usize, samples: usize) -> LibraryPlan {
    let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
    let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.6e-3, outline };
    let port = |i: usize| Port { name: format!("a{}", i + 1), at: Point::from_mm(i as f64, 31.0) };
    let places = (0..points).map(|i| Point::from_mm(0.1 * i as f64, 70.3));
    LibraryPlan::new((0..ports).map(port).collect(), places.collect(), conditions, samples)
}

/// Values that no other point has.
pub fn samples(plan: &LibraryPlan, point: usize) -> Vec<f32> {
    let count = plan.ports.len() * plan.samples;
    (0..count).map(|i| (point * count + i) as f32 * 1e-3 - 1.0).collect()
}

pub fn quality(plan: &LibraryPlan, point: usize) -> Vec<Quality> {
    let one = |port: usize| Quality {
        signal_to_noise_db: 50.0 + point as f64 / 3.0,
        coherence: 0.999,
        distortion: 1e-3 * port as f64,
        decay_time: 0.07,
    };
    (0..plan.ports.len()).map(one).collect()
}

/// A library of which every point but the first is done.
pub fn filled(folder: &Path, plan: &LibraryPlan) -> Library {
    let mut library = Library::create(folder, plan).unwrap();
    let count = plan.points.len();
    let owned: Vec<_> = (1..count).map(|point| (point, samples(plan, point), quality(plan, point))).collect();
    let state = PointState::Measured;
    let takes: Vec<Take<'_>> = owned
        .iter()
        .map(|(point, samples, quality)| Take { point: *point, samples, quality, bands: &[], state })
        .collect();
    library.put_all(&takes).unwrap();
    library
}

/// All files of a folder and those in it, in order.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for item in fs::read_dir(folder).unwrap() {
        let path = item.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.file_name().unwrap() != ".lock" {
            found.push(path);
        }
    }
    found.sort();
    found
}
