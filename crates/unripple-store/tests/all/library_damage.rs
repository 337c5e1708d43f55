//! Whatever happens to the files of a library, it is told, and the rest stays readable.

use crate::library_common;

use library_common::{Folder, files, filled, plan, quality, samples};
use proptest::prelude::*;
use std::fs;
use std::path::Path;
use unripple_core::Point;
use unripple_store::{Library, LibraryPlan, StoreError};

fn damaged(plan: &LibraryPlan, name: &str, harm: impl FnOnce(&Path)) -> (Folder, Library) {
    let folder = Folder::new(name);
    drop(filled(&folder.0, plan));
    harm(&folder.0);
    let library = Library::open(&folder.0).unwrap();
    (folder, library)
}

/// Point 3 and nothing else is lost, and its file named.
fn only_three_is_lost(plan: &LibraryPlan, library: &Library, found: &str) {
    let damage = library.verify();
    assert_eq!(damage.len(), 1, "{damage:?}");
    assert!(damage[0].file.ends_with("responses/c.3.0.0") && damage[0].point == Some(3));
    assert!(damage[0].found.contains(found), "{}", damage[0]);
    let error = library.get(3).unwrap_err().to_string();
    assert!(error.contains("c.3.0.0"), "{error}");
    assert_eq!(library.get(2).unwrap(), samples(plan, 2));
    assert!(library.responses().is_err());
    let (kept, lost) = library.intact().unwrap();
    assert_eq!((kept.points.len(), lost.len()), (plan.points.len() - 2, 1));
    assert_eq!(kept.response(0, 2), &samples(plan, 4)[..plan.samples]);
}

#[test]
fn names_the_damaged_chunk() {
    let plan = plan(5, 2, 9);
    let chunk = |root: &Path| root.join("responses/c.3.0.0");
    let flip = |root: &Path| {
        let mut bytes = fs::read(chunk(root)).unwrap();
        bytes[10] ^= 4;
        fs::write(chunk(root), bytes).unwrap();
    };
    only_three_is_lost(&plan, &damaged(&plan, "flip", flip).1, "");
    let shorten =
        |root: &Path| fs::File::options().write(true).open(chunk(root)).unwrap().set_len(30).unwrap();
    only_three_is_lost(&plan, &damaged(&plan, "short", shorten).1, "30 bytes");
    let lengthen =
        |root: &Path| fs::File::options().write(true).open(chunk(root)).unwrap().set_len(1 << 40).unwrap();
    only_three_is_lost(&plan, &damaged(&plan, "long", lengthen).1, "1099511627776 bytes");
    only_three_is_lost(&plan, &damaged(&plan, "gone", |root| fs::remove_file(chunk(root)).unwrap()).1, "");
    let folder = |root: &Path| {
        fs::remove_file(chunk(root)).unwrap();
        fs::create_dir(chunk(root)).unwrap();
    };
    only_three_is_lost(&plan, &damaged(&plan, "folder", folder).1, "something else");
}

#[test]
fn repairs_so_that_lost_points_can_be_taken_again() {
    let plan = plan(300, 1, 4);
    let (folder, mut library) = damaged(&plan, "repair", |root| {
        fs::write(root.join("state/c.1"), "nonsense").unwrap();
        fs::write(root.join("quality/c.0.0.0"), "").unwrap();
        fs::write(root.join("quality/zarr.json"), "{").unwrap();
        fs::remove_file(root.join("responses/c.290.0.0")).unwrap();
        fs::write(root.join("responses/c.5.0.0"), "").unwrap();
    });
    assert_eq!(library.done().len(), 298);
    assert!(library.put(6, &samples(&plan, 6), &quality(&plan, 6)).is_err());
    assert_eq!(library.repair().unwrap().len(), 4);
    assert!(library.verify().is_empty());
    assert_eq!(library.done().len(), 297);
    for point in [0, 5, 290] {
        library.put(point, &samples(&plan, point), &quality(&plan, point)).unwrap();
    }
    drop(library);
    let library = Library::open(&folder.0).unwrap();
    assert_eq!(library.done().len(), 300);
    assert_eq!(library.quality(290).unwrap(), quality(&plan, 290));
    assert!(library.quality(7).unwrap()[0].coherence.is_nan());
}

#[test]
fn refuses_what_cannot_be_made_out() {
    let plan = plan(5, 2, 9);
    let folder = Folder::new("refuse");
    drop(filled(&folder.0, &plan));
    let text = fs::read_to_string(folder.0.join("zarr.json")).unwrap();
    let long = "9".repeat(400);
    let texts = [
        String::new(),
        text[..text.len() / 2].to_owned(),
        text.replace("48000.0", "44100.0"),
        text.replace("\"samples\": 9", &format!("\"samples\": {}", u64::MAX)),
        text.replace("\"samples\": 9", &format!("\"samples\": {long}")),
        text.replace("unripple_library", "ripple_library"),
        text.replace("\"group\"", "\"array\""),
        "[".repeat(100_000),
        "null".to_owned(),
    ];
    for text in texts {
        fs::write(folder.0.join("zarr.json"), &text).unwrap();
        let error = Library::open(&folder.0).unwrap_err();
        assert!(error.to_string().contains("zarr.json"), "{error}");
        assert!(matches!(Library::create(&folder.0, &plan), Err(StoreError::Content { .. })));
    }
    fs::write(folder.0.join("zarr.json"), text).unwrap();
    fs::write(folder.0.join("position/c.0.0"), [0; 20]).unwrap();
    let error = Library::open(&folder.0).unwrap_err().to_string();
    assert!(error.contains("position"), "{error}");
}

/// Absurd sizes under a good checksum cost no memory.
#[test]
fn believes_no_size_that_the_files_do_not_have() {
    let plan = plan(5, 2, 9);
    for (key, value) in
        [("points", 1_u64 << 24), ("points", u64::MAX), ("samples", 1 << 27), ("samples", 1 << 60)]
    {
        let folder = Folder::new("absurd");
        drop(filled(&folder.0, &plan));
        let file = folder.0.join("zarr.json");
        let mut group: serde_json::Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
        group["attributes"]["unripple_library"][key] = value.into();
        let check = crc32c::crc32c(group["attributes"]["unripple_library"].to_string().as_bytes());
        group["attributes"]["crc32c"] = format!("{check:08x}").into();
        fs::write(&file, group.to_string()).unwrap();
        match Library::open(&folder.0) {
            Err(error) => assert!(matches!(error, StoreError::Content { .. }), "{error}"),
            Ok(library) => {
                assert!(library.get(2).is_err() && library.responses().is_err());
                assert!(library.verify().len() > 4 && library.quality(0).is_ok());
            }
        }
    }
}

#[test]
fn a_library_without_room_loses_nothing() {
    // Names that are taken by folders stand for a medium that takes no more: writing fails, for root too.
    let plan = plan(5, 2, 9);
    for blocked in ["responses/c.0.0.0.part", "quality/c.0.0.0.part", "state/c.0.part"] {
        let folder = Folder::new("room");
        let mut library = filled(&folder.0, &plan);
        fs::create_dir(folder.0.join(blocked)).unwrap();
        let error = library.put(0, &samples(&plan, 0), &quality(&plan, 0)).unwrap_err();
        let named = blocked.trim_end_matches(".part");
        assert!(matches!(&error, StoreError::Write { path, .. } if path.ends_with(named)), "{error}");
        assert_eq!(library.done(), [1, 2, 3, 4]);
        drop(library);
        let mut library = Library::open(&folder.0).unwrap();
        assert_eq!(library.done(), [1, 2, 3, 4]);
        assert!(library.verify().is_empty());
        fs::remove_dir(folder.0.join(blocked)).unwrap();
        library.put(0, &samples(&plan, 0), &quality(&plan, 0)).unwrap();
        assert_eq!(Library::open(&folder.0).unwrap().done().len(), 5);
    }
}

/// Everything a reader can learn of a library.
#[derive(Debug, PartialEq)]
struct Told {
    plan: LibraryPlan,
    done: Vec<usize>,
    values: Vec<Vec<f32>>,
    quality: String,
    bands: String,
    reciprocity: Option<f64>,
    nearest: Option<usize>,
}

fn told(folder: &Path) -> Result<Told, StoreError> {
    let library = Library::open(folder)?;
    let done = library.done();
    Ok(Told {
        values: done.iter().map(|point| library.get(*point)).collect::<Result<_, _>>()?,
        quality: format!(
            "{:?}",
            done.iter().map(|point| library.quality(*point)).collect::<Result<Vec<_>, _>>()?
        ),
        bands: format!(
            "{:?} {:?}",
            library.bands(),
            done.iter().map(|point| library.band_quality(*point)).collect::<Result<Vec<_>, _>>()?
        ),
        reciprocity: library.reciprocity_error()?,
        nearest: library.nearest(Point::default()),
        plan: library.plan().clone(),
        done,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn flipped_bytes_are_told_or_change_nothing(
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 1_u8..), 1..3)
    ) {
        let mut plan = plan(4, 2, 6);
        plan.surface = Some(unripple_store::load_surface("hudin-2012").unwrap());
        let folder = Folder::new("flips");
        filled(&folder.0, &plan).hold_bands(&[500.0, 630.0]).unwrap();
        let before = told(&folder.0).unwrap();
        let files = files(&folder.0);
        // The description is the longest of few files: half of all flips go there.
        for (which, at, mask) in flips {
            let path = if mask % 2 == 0 { folder.0.join("zarr.json") } else { which.get(&files).clone() };
            let mut bytes = fs::read(&path).unwrap();
            let at = at.index(bytes.len());
            bytes[at] ^= mask;
            fs::write(&path, bytes).unwrap();
        }
        let sound = Library::open(&folder.0).map(|library| library.verify().is_empty()).unwrap_or(false);
        match told(&folder.0) {
            Ok(after) => prop_assert!(!sound || after == before),
            Err(_) => prop_assert!(!sound),
        }
        // Whatever else was harmed, a value that is given is right.
        if let Ok(library) = Library::open(&folder.0) {
            for point in library.done() {
                if let Ok(values) = library.get(point) {
                    prop_assert_eq!(values, samples(&plan, point));
                }
            }
        }
    }
}
