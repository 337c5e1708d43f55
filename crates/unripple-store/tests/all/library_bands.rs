//! Quality by thirds of an octave: kept where there is room for it, replaced with its point, told from none.

use crate::library_common;

use library_common::{Folder, filled, plan, quality, samples};
use std::fs;
use unripple_core::Point;
use unripple_store::{BandQuality, Library, LibraryPlan, PointState, StoreError, Take};

const MIDDLES: [f64; 3] = [500.0, 629.960_524_947_436_6, 793.700_525_984_099_8];

/// Values that no other point has; of one band all is noise, and of one actuator nothing repeats.
fn bands(plan: &LibraryPlan, point: usize) -> Vec<Vec<BandQuality>> {
    let one = |port: usize, band: usize| BandQuality {
        signal_to_noise_db: if band == 1 { f64::NEG_INFINITY } else { point as f64 / 3.0 + band as f64 },
        coherence: if port == 0 { f64::NAN } else { 1.0 / (2.0 + point as f64) },
    };
    (0..plan.ports.len()).map(|port| (0..MIDDLES.len()).map(|band| one(port, band)).collect()).collect()
}

fn unknown() -> String {
    told(&[vec![BandQuality::UNKNOWN; 3], vec![BandQuality::UNKNOWN; 3]])
}

fn put(library: &mut Library, point: usize, bands: &[Vec<BandQuality>]) -> Result<(), StoreError> {
    let plan = library.plan().clone();
    let (samples, quality) = (samples(&plan, point), quality(&plan, point));
    let state = PointState::Measured;
    library.put_all(&[Take { point, samples: &samples, quality: &quality, bands, state }])
}

/// What is kept of a point, with what is not known equal to itself.
fn kept(library: &Library, point: usize) -> String {
    format!("{:?}", library.band_quality(point).unwrap().unwrap())
}

fn told(bands: &[Vec<BandQuality>]) -> String {
    format!("{bands:?}")
}

#[test]
fn bands_are_kept_point_by_point_and_told_from_none() {
    let folder = Folder::new("bands");
    let plan = plan(140, 2, 9);
    let mut library = filled(&folder.0, &plan);
    assert!(library.bands().is_none() && library.band_quality(5).unwrap().is_none());
    let error = put(&mut library, 5, &bands(&plan, 5)).unwrap_err();
    assert!(error.to_string().contains("no quality by bands"), "{error}");

    library.hold_bands(&MIDDLES).unwrap();
    for point in [1, 63, 64, 139] {
        put(&mut library, point, &bands(&plan, point)).unwrap();
    }
    let read = Library::open(&folder.0).unwrap();
    assert_eq!(read.bands(), Some(&MIDDLES[..]));
    for point in [1, 63, 64, 139] {
        assert_eq!(kept(&read, point), told(&bands(&plan, point)), "{point}");
    }
    // Measured before there was room, and not measured at all.
    assert_eq!((kept(&read, 5), kept(&read, 0)), (unknown(), unknown()));
    assert!(read.band_quality(140).is_err() && read.verify().is_empty());
    drop(read);

    // Measured again: replaced, or unknown where nothing is said; forgotten: unknown.
    put(&mut library, 63, &bands(&plan, 7)).unwrap();
    library.put(64, &samples(&plan, 64), &quality(&plan, 64)).unwrap();
    library.forget(&[139]).unwrap();
    let read = Library::open(&folder.0).unwrap();
    assert_eq!(kept(&read, 63), told(&bands(&plan, 7)));
    assert_eq!((kept(&read, 64), kept(&read, 139)), (unknown(), unknown()));
    assert_eq!(kept(&read, 1), told(&bands(&plan, 1)));

    // The same room is there already; another is refused, and so is what does not fit, or is none.
    library.hold_bands(&MIDDLES).unwrap();
    assert_eq!(kept(&library, 1), told(&bands(&plan, 1)));
    let error = library.hold_bands(&MIDDLES[..2]).unwrap_err().to_string();
    assert!(error.contains("3 from 500") && error.contains("2 from 500"), "{error}");
    assert!(put(&mut library, 5, &bands(&plan, 5)[..1]).is_err());
    let narrow: Vec<Vec<BandQuality>> = bands(&plan, 5).iter().map(|row| row[..2].to_vec()).collect();
    assert!(put(&mut library, 5, &narrow).is_err());
    let other = Folder::new("bands-none");
    let mut other = filled(&other.0, &plan);
    for wrong in [&[][..], &[0.0][..], &[2.0, 1.0][..], &[f64::NAN][..]] {
        assert!(matches!(other.hold_bands(wrong), Err(StoreError::Content { .. })), "{wrong:?}");
    }
}

#[test]
fn bands_grow_with_their_library() {
    let folder = Folder::new("bands-grow");
    let small = plan(70, 2, 9);
    let mut library = filled(&folder.0, &small);
    library.hold_bands(&MIDDLES).unwrap();
    for point in 1..70 {
        put(&mut library, point, &bands(&small, point)).unwrap();
    }
    drop(library);
    let mut points = small.points.clone();
    points.insert(3, Point::from_mm(1.0, 2.0));
    let large = LibraryPlan { points, ..small.clone() };
    let known: Vec<Option<usize>> = (0..3).map(Some).chain([None]).chain((3..70).map(Some)).collect();
    let grown = Library::grow(&folder.0, &large, &known).unwrap();
    assert_eq!(grown.bands(), Some(&MIDDLES[..]));
    for (new, old) in [(2, 2), (4, 3), (70, 69)] {
        assert_eq!(kept(&grown, new), told(&bands(&small, old)), "{new}");
    }
    assert_eq!(kept(&grown, 3), unknown());
    assert!(grown.verify().is_empty());
}

#[test]
fn damage_to_bands_is_told_and_costs_nothing_else() {
    let folder = Folder::new("bands-damage");
    let plan = plan(70, 2, 9);
    let mut library = filled(&folder.0, &plan);
    library.hold_bands(&MIDDLES).unwrap();
    for point in [2, 65] {
        put(&mut library, point, &bands(&plan, point)).unwrap();
    }
    drop(library);
    let chunk = folder.0.join("bands/c.0.0.0.0");
    let mut bytes = fs::read(&chunk).unwrap();
    bytes[200] ^= 1;
    fs::write(&chunk, bytes).unwrap();
    let mut library = Library::open(&folder.0).unwrap();
    assert!(library.band_quality(2).unwrap_err().to_string().contains("c.0.0.0.0"));
    assert_eq!(kept(&library, 65), told(&bands(&plan, 65)));
    assert_eq!(
        (library.get(2).unwrap(), library.quality(2).unwrap()),
        (samples(&plan, 2), quality(&plan, 2))
    );
    assert_eq!(library.repair().unwrap().len(), 1);
    assert!(library.verify().is_empty() && kept(&library, 2).contains("NaN"));
    drop(library);

    // Values of which nobody knows the frequencies: none, until there is room again.
    let file = folder.0.join("bands/zarr.json");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("500.0", "400.0")).unwrap();
    let mut library = Library::open(&folder.0).unwrap();
    assert!(library.bands().is_none() && library.band_quality(65).unwrap().is_none());
    let damage = library.verify();
    assert!(damage.len() == 1 && damage[0].file.ends_with("bands/zarr.json"), "{damage:?}");
    assert!(library.hold_bands(&MIDDLES).is_err());
    library.repair().unwrap();
    assert!(library.verify().is_empty() && library.bands().is_none());
    library.hold_bands(&MIDDLES).unwrap();
    assert!(kept(&library, 65).contains("NaN") && library.done().len() == 69);
}

#[test]
fn room_that_was_being_made_is_made_anew() {
    let folder = Folder::new("bands-killed");
    let plan = plan(70, 2, 9);
    drop(filled(&folder.0, &plan));
    fs::create_dir(folder.0.join("bands")).unwrap();
    fs::write(folder.0.join("bands/c.0.0.0.0.part"), "x").unwrap();
    let mut library = Library::open(&folder.0).unwrap();
    assert!(library.bands().is_none() && library.verify().is_empty());
    library.hold_bands(&MIDDLES).unwrap();
    put(&mut library, 2, &bands(&plan, 2)).unwrap();
    let read = Library::open(&folder.0).unwrap();
    assert_eq!(kept(&read, 2), told(&bands(&plan, 2)));
    assert!(read.verify().is_empty());
}
