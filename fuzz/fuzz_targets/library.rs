//! A library with any of its files harmed is read, or refused with a message; a response that is given is the one stored.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::fs;
use std::path::{Path, PathBuf};
use unripple_core::{Conditions, Outline, Point, Port, Shape};
use unripple_store::{Library, LibraryPlan, PointState, Quality, Take};

const POINTS: usize = 3;

fn plan() -> LibraryPlan {
    let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.1 });
    let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.6e-3, outline };
    let port = |name: &str| Port { name: name.into(), at: Point::from_mm(12.0, 31.0) };
    let points = (0..POINTS).map(|i| Point::from_mm(i as f64, 20.0)).collect();
    LibraryPlan::new(vec![port("a1"), port("a2")], points, conditions, 4)
}

fn samples(point: usize) -> Vec<f32> {
    (0..8).map(|i| (10 * point + i) as f32).collect()
}

/// The files of a sound library, by their names in it.
fn sound(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let _ = fs::remove_dir_all(folder);
    let mut library = Library::create(folder, &plan()).expect("a library is made");
    let values: Vec<Vec<f32>> = (0..POINTS).map(samples).collect();
    let quality = [Quality::UNKNOWN; 2];
    let state = PointState::Measured;
    let take = |(point, samples)| Take { point, samples, quality: &quality, bands: &[], state };
    let takes: Vec<Take> = values.iter().map(Vec::as_slice).enumerate().map(take).collect();
    library.put_all(&takes).expect("points are stored");
    library.hold_bands(&[500.0, 630.0]).expect("there is room for bands");
    let names = ["", "responses", "position", "state", "quality", "reciprocity_error", "bands"];
    let items = names.iter().flat_map(|name| fs::read_dir(folder.join(name)).into_iter().flatten().flatten());
    let mut files: Vec<PathBuf> = items.map(|item| item.path()).filter(|path| path.is_file() && !path.ends_with(".lock")).collect();
    files.sort();
    files.into_iter().map(|path| (path.clone(), fs::read(path).unwrap_or_default())).collect()
}

/// Harms a file: 0 puts bytes over it, 1 cuts it, 2 replaces it, 3 removes it. For the description, 4 replaces what its
/// checksum covers, and puts the checksum right.
fn harm(path: &Path, bytes: &[u8], kind: u8, at: usize, with: &[u8]) {
    let at = at % bytes.len().max(1);
    let mut changed = bytes.to_vec();
    match kind % 5 {
        0 => changed.iter_mut().skip(at).zip(with).for_each(|(to, from)| *to = *from),
        1 => changed.truncate(at),
        2 => changed = with.to_vec(),
        3 => {
            let _ = fs::remove_file(path);
            return;
        }
        _ => {
            let text = String::from_utf8_lossy(with);
            let value: String = text.split_whitespace().collect();
            let check = crc32c::crc32c(value.as_bytes());
            let attributes = format!(r#"{{"unripple_library":{value},"crc32c":"{check:08x}"}}"#);
            changed = format!(r#"{{"zarr_format":3,"node_type":"group","attributes":{attributes}}}"#).into_bytes();
        }
    }
    let _ = fs::write(path, changed);
}

thread_local! {
    static SOUND: (PathBuf, Vec<(PathBuf, Vec<u8>)>) = {
        // In memory where there is such a place: thousands of small folders a second.
        let memory = Path::new("/dev/shm");
        let place = if memory.is_dir() { memory.to_path_buf() } else { std::env::temp_dir() };
        let folder = place.join(format!("unripple-fuzz-library-{}", std::process::id()));
        let files = sound(&folder);
        (folder, files)
    };
}

fuzz_target!(|bytes: &[u8]| {
    SOUND.with(|(folder, files)| {
        // Three bytes of what is done, then what is put there, up to 255 bytes; the rest does the next harm.
        let mut rest = bytes;
        let mut forged = false;
        while let [which, kind, at, length, tail @ ..] = rest {
            let (path, sound) = &files[usize::from(*which) % files.len()];
            let wide = if kind % 5 == 4 { 8 } else { 1 };
            let (with, next) = tail.split_at((wide * usize::from(*length)).min(tail.len()));
            forged |= kind % 5 == 4;
            harm(path, sound, *kind, 7 * usize::from(*at), with);
            rest = next;
        }
        if let Ok(mut library) = Library::open(folder) {
            let damage = library.verify();
            for point in library.done() {
                if let Ok(values) = library.get(point) {
                    assert!(forged || values == samples(point));
                }
                let _ = (library.quality(point), library.band_quality(point));
            }
            let _ = (library.nearest(Point::default()), library.reciprocity_error(), library.intact());
            if library.plan() == &plan() {
                assert_eq!(library.responses().is_err(), damage.iter().any(|d| d.point.is_some()));
                assert!(library.repair().is_err() || library.verify().is_empty());
            }
        }
        for (path, sound) in files {
            let _ = fs::write(path, sound);
        }
    });
});
